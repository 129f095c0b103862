"""Scenes and meshes from files."""

from .load import load
from .mesh_file import read_mesh
from .obj import write_obj
from .scene_file import write_scene

__all__ = ["load", "read_mesh", "write_obj", "write_scene"]
