from ._arithmetic import cosine, sine, tangent
from ._background import Background
from ._camera import DEFAULT_HALF_HEIGHT, Camera, Projection, half_height_of
from ._canvas import as_shown
from ._codec import (
    CULL_BACKFACES,
    LIGHTS,
    ONE,
    PROJECTIONS,
    SHADINGS,
    TWO_SIDED,
    WIREFRAME,
    Rectangle,
    encode,
    encode_scene,
    extensions,
    render_call,
)
from ._crease import creased, shaded
from ._decode import decode, read_call
from ._effects import EXPOSURES, POWERS, Fog, Hemisphere, Rim, Tone
from ._files.colors import sample
from ._files.content import MAX_BYTES
from ._files.gltf.animation import animation_length, animations_of
from ._files.gltf.view import read_view
from ._files.link import Link, link_of
from ._files.mesh_file import GLTF, READERS, read_mesh, read_model
from ._files.model import TEXTURED, MeshPart
from ._files.obj import write_obj
from ._files.original import original_scene
from ._files.picture import CHUNK, LONGEST_TEXT, PICTURE, SceneChunk, scene_chunk
from ._files.polygons import cut, fans
from ._files.scene_file import SCENES, encode_scene_file, read_scene, write_scene
from ._files.table import about
from ._files.weld import weld
from ._fit import EXACT_SIZES, MAX_COORDINATE, fit, fit_factor, near_plane
from ._from_trimesh import is_trimesh, mesh_of, objects_of, part_of
from ._ground import Ground
from ._light import INNER_ANGLE, LIGHT_KINDS, OUTER_ANGLE, WHITE, Light, LightKind
from ._look import (
    ALL,
    MOST_TWO_SIDED,
    SETTINGS,
    Kind,
    LookOptions,
    Setting,
    checked_look,
    look_at,
    resize,
    settings_of,
    size_of,
    stage,
)
from ._material import Material, Shading
from ._mesh import DEFAULT_COLOR, Mesh, components, faces_of_all, vertex_normals, without_slivers
from ._object import Object
from ._packed_mesh import NORMAL_UNIT, NORMALS, WIDE, pack, unpack
from ._packed_texture import pack_texture, unpack_texture
from ._presets import PRESETS, Lamp, Preset
from ._records import ANTIALIAS, FOG, HEMISPHERE, LONG_KINDS, OPACITY_OF, RECORD_HEADER, RIM, SPOT, TONE
from ._rotation import euler, from_axis_angle, from_euler, multiply, rotate
from ._scene import MAX_LIGHTS, MAX_SIDE, Scene
from ._simplify import FORCEFUL, GENTLE, simplify, simplify_scene
from ._staging import (
    BACKGROUND,
    MESH_STAGING,
    Viewpoint,
    contrasting,
    frame,
    is_closed,
    painted,
    painted_object,
    signed_volume,
    view_axes,
)
from ._texture import FILTERS, MAX_TEXTURE_SIDE, WRAPS, Texture
from ._turning import FILLED, frame_count, full_turn, middle, turn
from ._upright import AXES, Axis, axis_of_file, axis_of_format, base_axis, upright
from ._winding import wound

__all__ = [
    "ALL",
    "ANTIALIAS",
    "AXES",
    "BACKGROUND",
    "CHUNK",
    "CULL_BACKFACES",
    "DEFAULT_COLOR",
    "DEFAULT_HALF_HEIGHT",
    "EXACT_SIZES",
    "EXPOSURES",
    "FILLED",
    "FILTERS",
    "FOG",
    "FORCEFUL",
    "GENTLE",
    "GLTF",
    "HEMISPHERE",
    "INNER_ANGLE",
    "LIGHTS",
    "LIGHT_KINDS",
    "LONGEST_TEXT",
    "LONG_KINDS",
    "MAX_BYTES",
    "MAX_COORDINATE",
    "MAX_LIGHTS",
    "MAX_SIDE",
    "MAX_TEXTURE_SIDE",
    "MESH_STAGING",
    "MOST_TWO_SIDED",
    "NORMALS",
    "NORMAL_UNIT",
    "ONE",
    "OPACITY_OF",
    "OUTER_ANGLE",
    "PICTURE",
    "POWERS",
    "PRESETS",
    "PROJECTIONS",
    "READERS",
    "RECORD_HEADER",
    "RIM",
    "SCENES",
    "SETTINGS",
    "SHADINGS",
    "SPOT",
    "TEXTURED",
    "TONE",
    "TWO_SIDED",
    "WHITE",
    "WIDE",
    "WIREFRAME",
    "WRAPS",
    "Axis",
    "Background",
    "Camera",
    "Fog",
    "Ground",
    "Hemisphere",
    "Kind",
    "Lamp",
    "Light",
    "LightKind",
    "Link",
    "LookOptions",
    "Material",
    "Mesh",
    "MeshPart",
    "Object",
    "Preset",
    "Projection",
    "Rectangle",
    "Rim",
    "Scene",
    "SceneChunk",
    "Setting",
    "Shading",
    "Texture",
    "Tone",
    "Viewpoint",
    "about",
    "animation_length",
    "animations_of",
    "as_shown",
    "axis_of_file",
    "axis_of_format",
    "base_axis",
    "checked_look",
    "components",
    "contrasting",
    "cosine",
    "creased",
    "cut",
    "decode",
    "encode",
    "encode_scene",
    "encode_scene_file",
    "euler",
    "extensions",
    "faces_of_all",
    "fans",
    "fit",
    "fit_factor",
    "frame",
    "frame_count",
    "from_axis_angle",
    "from_euler",
    "full_turn",
    "half_height_of",
    "is_closed",
    "is_trimesh",
    "link_of",
    "look_at",
    "mesh_of",
    "middle",
    "multiply",
    "near_plane",
    "objects_of",
    "original_scene",
    "pack",
    "pack_texture",
    "painted",
    "painted_object",
    "part_of",
    "read_call",
    "read_mesh",
    "read_model",
    "read_scene",
    "read_view",
    "render_call",
    "resize",
    "rotate",
    "sample",
    "scene_chunk",
    "settings_of",
    "shaded",
    "signed_volume",
    "simplify",
    "simplify_scene",
    "sine",
    "size_of",
    "stage",
    "tangent",
    "turn",
    "unpack",
    "unpack_texture",
    "upright",
    "vertex_normals",
    "view_axes",
    "weld",
    "without_slivers",
    "wound",
    "write_obj",
    "write_scene",
]
