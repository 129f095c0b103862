"""Set up the map from the vertices of an object to the screen."""

from __future__ import annotations

from . import layout
from .registers import Registers
from .structs import Object, Rectangle
from .vector import Matrix, Vector, scale, subtract
from .view import View
from .words import divide_signed


def set_matrix(view: View, obj: Object, rotation: Matrix, registers: Registers) -> None:
    """Combine rotation, scale, position, camera and viewport into one affine map from the mesh to clip coordinates."""
    registers.matrix_x = clip_lanes(view, scale(view.to_camera(rotation[0]), obj.scale), 0)
    registers.matrix_y = clip_lanes(view, scale(view.to_camera(rotation[1]), obj.scale), 0)
    registers.matrix_z = clip_lanes(view, scale(view.to_camera(rotation[2]), obj.scale), 0)
    registers.matrix_t = clip_lanes(view, view.to_camera(subtract(obj.position, view.eye)), 1 << 32) + layout.CLIP_BIAS


def clip_lanes(view: View, v: Vector, w: int) -> int:
    """Return one column of the map; `w` is its last coordinate."""
    if not view.orthographic:
        w = v[2]
    x = ((view.focal * v[0]) >> 32) + ((view.center_x * w) >> 1)
    y = ((view.focal * v[1]) >> 32) + ((view.center_y * w) >> 1)
    return x + (y << layout.CLIP_Y_AT) + (v[2] << layout.CLIP_W_AT)


def set_normal_matrix(view: View, rotation: Matrix, registers: Registers) -> None:
    """Set the rotation of normals into camera space, divided by the 511 of the mesh format."""
    registers.normal_x = normal_lanes(view.to_camera(rotation[0]))
    registers.normal_y = normal_lanes(view.to_camera(rotation[1]))
    registers.normal_z = normal_lanes(view.to_camera(rotation[2]))


def normal_lanes(v: Vector) -> int:
    """Return a vector as lanes of Q20."""
    x, y, z = (divide_signed(component, 4096 * 511) for component in v)
    return x + (y << layout.MIDDLE_85_AT) + (z << layout.UPPER_85_AT)


def set_rounding(tile: Rectangle, wireframe: bool, registers: Registers) -> None:
    """Set how rows and columns are rounded to pixels.

    For a face these are the pixel centres from it on, for a line the pixels nearest to it.
    """
    before, beyond = (128, -1) if wireframe else (255, 255)
    down, up = (layout.HALF_PIXEL, layout.HALF_PIXEL + 256) if wireframe else (layout.SUBPIXEL_MASK,) * 2
    if registers.antialiased:
        # to the outermost samples, and for a line, which is a pixel wide, half a pixel farther
        before, beyond = (255, 255) if wireframe else (128, -1)
        down = layout.SUBPIXEL_MASK - layout.OUTERMOST_SAMPLE - (layout.HALF_PIXEL if wireframe else 0)
        up = 2 * layout.SUBPIXEL_MASK - down
    registers.tile_left = ((tile.x + layout.PIXEL_BIAS) << 8) - before
    registers.tile_span = (tile.width << 8) + beyond
    registers.tile_top = ((tile.y + layout.PIXEL_BIAS) << 8) - before
    registers.tile_rows = (tile.height << 8) + beyond
    registers.round_top = down << layout.SCREEN_ROW_AT
    registers.round_bottom = up << layout.SCREEN_ROW_AT
