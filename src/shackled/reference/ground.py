"""Fade a ground into what is behind it, by the distance from its position: opacity = (R^2 - d^2) / (R^2 - r^2)."""

from __future__ import annotations

from . import layout
from .effect_records import GROUND, radii
from .layout import IS_BLENDED
from .registers import Registers
from .words import MASK, divide, signed


def set_object(index: int, r: Registers) -> None:
    """Set the registers of an object."""
    content = r.records.get((GROUND, index))
    r.fade_range = 0
    if content is None or r.object_mode & IS_BLENDED:
        return
    inner, outer = radii(content)
    r.fade_square, r.fade_range = outer * outer, outer * outer - inner * inner
    clip = r.matrix_t & MASK
    w = signed(clip) >> layout.CLIP_W_AT
    x = (clip & layout.CLIP_X_MASK) - layout.CLIP_HALF
    y = (clip >> layout.CLIP_Y_AT & layout.CLIP_Y_MASK) - layout.CLIP_HALF
    if r.frame_is_orthographic:
        r.fade_place = r.ray_left + (x * r.ray_step >> 40), r.ray_top + (y * r.ray_step >> 40), w
    else:
        r.fade_place = (
            r.ray_left * w + (x * r.ray_step >> 8) >> 24,
            r.ray_top * w + (y * r.ray_step >> 8) >> 24,
            w,
        )


def opacity_at(depth: int, x: int, y: int, r: Registers) -> int:
    """Return how much of a ground is left at a fragment, Q24; parameters as for `color_at`."""
    z = r.depth_scale << 8
    if r.frame_is_orthographic:
        z -= depth
    else:
        z = divide(z, depth)
        x, y = x * z >> 24, y * z >> 24
    i, j, k = (a - b for a, b in zip((x, y, z), r.fade_place, strict=True))
    left = r.fade_square - i * i - j * j - k * k
    return min((max(left, 0) << 24) // r.fade_range, 1 << 24)
