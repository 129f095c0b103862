"""The registers: values that every vertex, triangle and fragment needs, such as the uniforms.

The names are those of the contract's registers. Signed registers hold Python integers of either sign, packed ones hold
words whose lanes may have borrowed from one another.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .extensions import Records
from .layout import IS_BLENDED, IS_DEPTH_PASS
from .quadratic import Differences
from .shadow_table import Entry, Table
from .structs import Rectangle

#: The modes of objects that are drawn in two passes.
IS_IN_PASSES = IS_BLENDED | IS_DEPTH_PASS


@dataclass(slots=True)
class LightRecord:
    """A light in camera space and in the space of the mesh, and its values for the current face."""

    is_point: bool = False
    x: int = 0
    y: int = 0
    z: int = 0
    #: the direction, or the position (below), in the space of the mesh
    mesh_lanes: int = 0
    mesh_x: int = 0
    mesh_y: int = 0
    mesh_z: int = 0
    color: int = 0
    diffuse: int = 0
    n_dot_l: int = 0
    axis_x: int = 0
    axis_y: int = 0
    axis_z: int = 0
    cos_outer: int = 0
    cone: int = 0


@dataclass(slots=True)
class Normals:
    """The normals of a smooth triangle: at the first vertex, Q36, and the differences to the others, Q20."""

    at_0: int
    to_1: int
    to_2: int


@dataclass(slots=True)
class Registers:
    """All registers, and the picture: rows from the top of the tile, depth (64 bits) and colour (blue, green, red)."""

    tile: Rectangle
    depth: NDArray[np.uint64]
    image: NDArray[np.uint8]
    #: the extension records of the scene, which the contracts read from the call
    records: Records
    #: whether each pixel has four samples: their depths (height, width, 4), with two bits below that tell passes, and
    #: colours (height, width, 4, 3)
    antialiased: bool
    sample_depths: NDArray[np.uint64]
    sample_colors: NDArray[np.uint8]
    #: whether the scene has hemisphere light, a rim, fog or a tone
    has_effects: bool
    #: what depths of samples are less than those of accumulators, and by how many bits they are shifted
    sample_base: int = 0
    sample_shift: int = 0
    set_back: int = 0

    # frame
    frame_is_orthographic: bool = False
    near: int = 0
    depth_scale: int = 0
    tile_left: int = 0
    tile_span: int = 0
    tile_top: int = 0
    tile_rows: int = 0
    round_top: int = 0
    round_bottom: int = 0
    band_top: int = 0
    band_bottom: int = 0
    column_begin: int = 0
    column_end: int = 0
    ray_left: int = 0
    ray_top: int = 0
    ray_step: int = 0
    length_at_0: int = 0
    length_slope: int = 0
    length_steps: int = 0
    lights: list[LightRecord] = field(default_factory=list)
    rim_color: int = 0
    rim_power: int = 0
    fog_color: int = 0
    fog_near: int = 0
    fog_range: int = 0
    exposure: int = 1 << 16
    tone_flags: int = 0
    up_x: int = 0
    up_y: int = 0
    up_z: int = 0

    #: what one light does not reach, and its colour where it does
    shadows: Table | None = None
    shadow_color: int = 0

    # object
    matrix_x: int = 0
    matrix_y: int = 0
    matrix_z: int = 0
    matrix_t: int = 0
    normal_x: int = 0
    normal_y: int = 0
    normal_z: int = 0
    eye_x: int = 0
    eye_y: int = 0
    eye_z: int = 0
    scale: int = 0
    scale_per_near: int = 0
    ambient: int = 0
    specular_begin: int = 0
    specular_scale: int = 0
    specular_offset: int = 0
    specular_root: int = 0
    specular_table: list[int] = field(default_factory=list)
    object_mode: int = 0
    opacity: int = 0
    reach: int = 0
    smooth_reach: int = 0
    smooth_reach_3: int = 0
    half_slope: int = 0
    far_from_highlight: int = 0
    hemisphere_sky: int = 0
    hemisphere_ground: int = 0
    up_in_mesh: int = 0

    #: what is shaded of its faces
    shadow_faces: list[Entry] = field(default_factory=list)
    shadow_diffuse: int = 0
    fade_square: int = 0
    fade_range: int = 0
    fade_place: tuple[int, int, int] = (0, 0, 0)

    # triangle
    mode: int = 0
    shadow: Entry = 0
    color_0: int = 0
    color_1: int = 0
    color_2: int = 0
    albedo_0: int = 0
    albedo_1: int = 0
    albedo_2: int = 0
    face_up: int = 0
    depth_1: int = 0
    depth_2: int = 0
    nearest: int = 0
    face_light_40: int = 0
    face_n_dot_ray: int = 0
    face_n_dot_ray_slope: int = 0
    face_normal: int = 0
    face_square: int = 0
    face_normal_x: int = 0
    face_normal_y: int = 0
    face_normal_z: int = 0
    face_corner_x: int = 0
    face_corner_y: int = 0
    face_corner_z: int = 0
    attribute_0: int = 0
    attribute_1: int = 0
    attribute_2: int = 0
    lane_bias: int = 0
    patch_size: int = 0
    patch: Differences = field(default_factory=lambda: Differences(0, 0, 0, 0, 0, 0))
    patch_weight: int = 0
    #: the row at which the differences of the patch begin
    patch_row: int = 0
    start: int = 0
    dx: int = 0
    dy: int = 0
    normals: Normals = field(default_factory=lambda: Normals(0, 0, 0))
    quadratic: Differences = field(default_factory=lambda: Differences(0, 0, 0, 0, 0, 0))

    # fragment
    fragment_place_x: int = 0
    fragment_place_y: int = 0
    fragment_square: int = 0
    fragment_normal_x: int = 0
    fragment_normal_y: int = 0
    fragment_normal_z: int = 0
    fragment_normal_length: int = 0
    fragment_normal_ray: int = 0
    fragment_light: int = 0

    #: the content of the record TEXTURE of the object
    texture: bytes | None = None
    #: texture coordinates of the vertices of a triangle, Q16
    uvs: list[tuple[int, ...]] = field(default_factory=list)

    #: the content of the record OPACITIES of the object, the opacity of the object itself, Q24, and opacities of the
    #: vertices of a triangle, 0..255 as Q16
    opacities: bytes | None = None
    object_opacity: int = 0
    opacity_0: int = 0
    opacity_1: int = 0
    opacity_2: int = 0
