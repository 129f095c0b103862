from ._arithmetic import euler, from_euler, rotate
from ._camera import Camera, Projection
from ._canvas import as_shown
from ._codec import WIREFRAME, Rectangle, encode, encode_scene, has_effects, render_call
from ._decode import decode, read_call
from ._effects import Background, Fog, Hemisphere, Rim, Tone
from ._files.beside import is_inside
from ._files.content import MAX_BYTES, format_of, is_pipe, read_pipe, stored
from ._files.gltf.animation import animation_length, animations_of
from ._files.gltf.view import read_view
from ._files.link import Link, link_of
from ._files.mesh_file import GLTF, READERS, read_mesh, read_model
from ._files.model import MeshPart, is_visible
from ._files.picture import CHUNK, DIGEST, PICTURE, SceneChunk, scene_chunk, shows_scene
from ._files.scene_file import SCENES, read_scene
from ._files.signatures import format_by_name
from ._files.table import about
from ._fit import fit
from ._from_others import mesh_of
from ._from_trimesh import objects_of, part_of
from ._ground import Ground
from ._light import INNER_ANGLE, LIGHT_KINDS, WHITE, Light
from ._look import look_at, resize, stage
from ._mesh import Mesh, faces_of_all, is_trimesh, vertex_normals, weld, without_slivers
from ._object import Material, Object
from ._packed import NORMAL_UNIT, NORMALS, WIDE, pack
from ._presets import PRESETS
from ._scene import Scene
from ._settings import ALL, SETTINGS, Kind, LookOptions, Setting, checked_look, settings_of, size_of
from ._simplify import GENTLE, simplify, simplify_scene
from ._staging import MAX_SIDE, MESH_STAGING, contrasting, is_closed, painted, view_axes
from ._texture import Texture
from ._turning import frame_count, full_turn
from ._upright import Axis, axis_of_file, axis_of_format, base_axis, upright

__all__ = [
    "ALL",
    "CHUNK",
    "DIGEST",
    "GENTLE",
    "GLTF",
    "INNER_ANGLE",
    "LIGHT_KINDS",
    "MAX_BYTES",
    "MAX_SIDE",
    "MESH_STAGING",
    "NORMALS",
    "NORMAL_UNIT",
    "PICTURE",
    "PRESETS",
    "READERS",
    "SCENES",
    "SETTINGS",
    "WHITE",
    "WIDE",
    "WIREFRAME",
    "Axis",
    "Background",
    "Camera",
    "Fog",
    "Ground",
    "Hemisphere",
    "Kind",
    "Light",
    "Link",
    "LookOptions",
    "Material",
    "Mesh",
    "MeshPart",
    "Object",
    "Projection",
    "Rectangle",
    "Rim",
    "Scene",
    "SceneChunk",
    "Setting",
    "Texture",
    "Tone",
    "about",
    "animation_length",
    "animations_of",
    "as_shown",
    "axis_of_file",
    "axis_of_format",
    "base_axis",
    "checked_look",
    "contrasting",
    "decode",
    "encode",
    "encode_scene",
    "euler",
    "faces_of_all",
    "fit",
    "format_by_name",
    "format_of",
    "frame_count",
    "from_euler",
    "full_turn",
    "has_effects",
    "is_closed",
    "is_inside",
    "is_pipe",
    "is_trimesh",
    "is_visible",
    "link_of",
    "look_at",
    "mesh_of",
    "objects_of",
    "pack",
    "painted",
    "part_of",
    "read_call",
    "read_mesh",
    "read_model",
    "read_pipe",
    "read_scene",
    "read_view",
    "render_call",
    "resize",
    "rotate",
    "scene_chunk",
    "settings_of",
    "shows_scene",
    "simplify",
    "simplify_scene",
    "size_of",
    "stage",
    "stored",
    "upright",
    "vertex_normals",
    "view_axes",
    "weld",
    "without_slivers",
]
