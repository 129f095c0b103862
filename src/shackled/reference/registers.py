"""The values that every vertex, triangle and fragment needs; in the words of graphics interfaces, the uniforms.

The names are those of the contract's registers. Signed registers hold Python integers of either sign, packed ones hold
words whose lanes may have borrowed from one another.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .structs import Rectangle

#: Pixel columns and rows are counted from here, so that everything inside the guard band is positive.
PIXEL_BIAS = 1536
#: Bits of a sub-pixel coordinate inside the guard band.
GUARD_BITS = 20

#: Bits of the mode: how fragments are shaded.
IS_LINEAR = 1
IS_LIT = 2
IS_DIFFUSE = 4
HAS_SPECULAR = 8
IS_SMOOTH = 16
IS_ORTHOGRAPHIC = 32
IS_BARYCENTRIC = 64
IS_FLAT = 128
IS_CROSSING = 256
IS_BLOCKED = 0x200
IS_VARYING = 0x400
IS_STEEP = 0x800
IS_GREY = 0x1000
IS_DEEP = 0x2000


@dataclass(slots=True)
class LightRecord:
    """A light in camera space and in the space of the mesh, and how it meets the face that is drawn."""

    is_point: bool = False
    x: int = 0
    y: int = 0
    z: int = 0
    mesh_x: int = 0
    mesh_y: int = 0
    mesh_z: int = 0
    color: int = 0
    diffuse: int = 0
    facing: int = 0


@dataclass(slots=True)
class Varying:
    """A vector interpolated by smooth triangles: at the first vertex, Q36, and what it changes to the others, Q20."""

    at_0: int
    to_1: int
    to_2: int


@dataclass(slots=True)
class Registers:
    """All registers, and the picture: rows from the top of the tile, depth (64 bits) and colour (blue, green, red)."""

    tile: Rectangle
    depth: NDArray[np.uint64]
    image: NDArray[np.uint8]

    # frame
    frame_is_orthographic: bool = False
    near: int = 0
    depth_scale: int = 0
    tile_left: int = 0
    tile_span: int = 0
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
    specular_root: int = 0
    specular_table: list[int] = field(default_factory=list)
    object_mode: int = 0
    reach: int = 0
    varying_reach: int = 0
    half_reach: int = 0

    # triangle
    mode: int = 0
    color_0: int = 0
    color_1: int = 0
    color_2: int = 0
    depth_1: int = 0
    depth_2: int = 0
    face_light: int = 0
    face_light_40: int = 0
    face_facing: int = 0
    face_facing_slope: int = 0
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
    block: int = 0
    start: int = 0
    dx: int = 0
    dy: int = 0
    normals: Varying = field(default_factory=lambda: Varying(0, 0, 0))
    reversed: Varying = field(default_factory=lambda: Varying(0, 0, 0))
    to_light: Varying = field(default_factory=lambda: Varying(0, 0, 0))
    half: Varying = field(default_factory=lambda: Varying(0, 0, 0))
    half_reversed: Varying = field(default_factory=lambda: Varying(0, 0, 0))

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
