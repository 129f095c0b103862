"""A 3D renderer whose every computation runs inside Ethereum smart contracts."""

from importlib.metadata import PackageNotFoundError, version

from .animation import Animation
from .errors import ChainError, InputError, OutputError, RenderError, ShackledError
from .image import Image
from .load import load
from .render import render, turntable
from .scene.background import Background
from .scene.camera import Camera
from .scene.light import Light
from .scene.material import Material
from .scene.mesh import Mesh
from .scene.object import Object
from .scene.scene import Scene

try:
    __version__ = version("shackled")
except PackageNotFoundError:  # from a source tree that was not installed
    __version__ = "0+unknown"

__all__ = [
    "Animation",
    "Background",
    "Camera",
    "ChainError",
    "Image",
    "InputError",
    "Light",
    "Material",
    "Mesh",
    "Object",
    "OutputError",
    "RenderError",
    "Scene",
    "ShackledError",
    "__version__",
    "load",
    "render",
    "turntable",
]
