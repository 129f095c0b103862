"""Shade the fragments of scenes with effects: hemisphere light, rim, fog, tone.

    radiance = albedo * (light + hemisphere) + highlights + rim * (1 - max(N.V, 0))^power
    hemisphere = ambient coefficient * (ground + (sky - ground) * (1 + N.up) / 2)
    colour = tone(radiance * exposure), mixed with that of the fog by the distance along the line of sight

In linear light (gamma) the albedo is decoded from sRGB, and the colour is encoded; the colours of lights are decoded
before. The filmic tone is x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), the fit of the ACES curve by Krzysztof
Narkowicz.
"""

from __future__ import annotations

from collections.abc import Iterator

from . import gamma, texture
from .effect_records import TONE_FILMIC, TONE_GAMMA
from .fragment_light import WEIGHTED_BIAS, color_at, corrected, ray_length
from .layout import IS_LIT, IS_ORTHOGRAPHIC, IS_SMOOTH
from .registers import Registers
from .shadow_table import dark_samples
from .words import MASK, divide, divide_signed, signed

ONE = 1 << 24
#: 255 levels, Q10.
WHITE = 255 << 10
#: Radiance above 2^30 levels, and values of the filmic curve above 64 (Q16), are as good as white.
BRIGHTEST_FILMIC = 1 << 22


def set_albedo(r: Registers) -> None:
    """Keep the colours of a prepared triangle, so that `color_at` returns highlights alone."""
    r.albedo_0, r.albedo_1, r.albedo_2 = r.color_0, r.color_1, r.color_2
    r.color_0, r.color_1, r.color_2 = WEIGHTED_BIAS, 0, 0


def parts(seen: list[int], column: int, row: int, r: Registers) -> Iterator[list[int]]:
    """Yield the samples of a fragment that are in shadow, and the others; the light that casts shadows is off or on."""
    if r.shadows is None:
        yield seen
        return
    dark = dark_samples(r.shadow, column, row)
    light = r.lights[r.shadows.light]
    for is_dark in (True, False):
        light.color, light.diffuse = (0, 0) if is_dark else (r.shadow_color, r.shadow_diffuse)
        if part := [i for i in seen if dark[i] == is_dark]:
            yield part


def surface_color(depth: int, s: int, t: int, x: int, y: int, r: Registers) -> int:
    """Return the colour of a fragment, lanes of 85 bits, Q10, 0..255; parameters as for `color_at`."""
    albedo = albedo_at(depth, s, t, r)
    highlights = rim = 0
    is_lit = r.mode & IS_LIT
    if is_lit:
        highlights = color_at(depth, s, t, x, y, r)
        add_hemisphere(r)
        rim = rim_at(x, y, r) if r.rim_color else 0
    fog = fog_at(depth, r) if r.fog_range else 0
    color = 0
    for i in range(3):
        channel = albedo[i]
        if is_lit:
            light = r.fragment_light >> (56 * i) & ((1 << 56) - 1)
            channel = channel * (light >> 24) >> 16
            channel += highlights >> (85 * i) & ((1 << 85) - 1)
            channel += (r.rim_color >> (56 * i) & 0xFFFFFF) * rim >> 24
        channel = toned(channel, r)
        if fog:
            channel = channel * ((1 << 16) - fog) + ((r.fog_color >> (56 * i) & 0xFF) << 10) * fog >> 16
        color |= channel << (85 * i)
    return color


def albedo_at(depth: int, s: int, t: int, r: Registers) -> list[int]:
    """Return the colour of the surface itself: blue, green, red, Q10, 0..255."""
    s, t = corrected(depth, s, t, r)
    color = ((r.albedo_0 + r.albedo_1 * s + r.albedo_2 * t) & MASK) >> 24
    channels = [min(max((color >> (56 * i) & 0xFFFFFFFF) - ONE, 0), WHITE) for i in range(3)]
    if r.texture is not None:
        levels = reversed(texture.color_at(s, t, r))
        channels = [value * level >> 16 for value, level in zip(channels, levels, strict=True)]
    return [gamma.decode(value) for value in channels] if r.tone_flags & TONE_GAMMA else channels


def add_hemisphere(r: Registers) -> None:
    """Add the light from above and below to the light of the fragment, lanes of Q40."""
    if not r.hemisphere_sky | r.hemisphere_ground:
        return
    up = r.face_up
    if r.mode & IS_SMOOTH:
        product = r.fragment_normal_x * r.up_x + r.fragment_normal_y * r.up_y + r.fragment_normal_z * r.up_z
        up = divide_signed(product, r.fragment_normal_length)
    up = (ONE + min(max(up, -ONE), ONE)) >> 1
    r.fragment_light += r.hemisphere_sky * up + r.hemisphere_ground * (ONE - up)


def rim_at(x: int, y: int, r: Registers) -> int:
    """Return how strong the rim is at a fragment, Q24."""
    length = r.fragment_normal_length * (ONE if r.mode & IS_ORTHOGRAPHIC else ray_length(x, y, r))
    # 1 - N.V, where V = -ray
    part = min(max(ONE + divide_signed(r.fragment_normal_ray << 24, length), 0), ONE)
    strength = ONE
    for _ in range(r.rim_power):
        strength = strength * part >> 24
    return strength


def fog_at(depth: int, r: Registers) -> int:
    """Return how much the fog hides at a depth, Q16."""
    scale = r.depth_scale << 8
    distance = scale - depth if r.mode & IS_ORTHOGRAPHIC else divide(scale, depth)
    return min((max(signed(distance) - r.fog_near, 0) << 16) // r.fog_range, 1 << 16)


def toned(channel: int, r: Registers) -> int:
    """Return a channel, Q10, as it is shown: 0..255, Q10."""
    channel = channel * r.exposure >> 16
    if not r.tone_flags:
        return min(channel, WHITE)
    # Q16, where 1 is white
    value = (channel << 6) // 255
    if r.tone_flags & TONE_FILMIC:
        value = min(value, BRIGHTEST_FILMIC)
        divisor = value * (243 * value + (59 << 16)) + (14 << 32)
        value = (value * (251 * value + (3 << 16)) << 16) // divisor
    value = min(value, 1 << 16)
    return gamma.encode(value) << 2 if r.tone_flags & TONE_GAMMA else value * 255 >> 6
