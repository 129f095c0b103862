"""Compute the colour of a triangle at any place.

Interpolated colours, correct in perspective, times diffuse light, and highlights (Blinn-Phong).
"""

from __future__ import annotations

from .layout import IS_DIFFUSE, IS_LIT, IS_ORTHOGRAPHIC, IS_SMOOTH, IS_STEEP, LANES_24, NORMAL_BIAS, ONES
from .registers import LightRecord, Registers
from .roots import sqrt
from .words import MASK, divide, divide_signed, signed

#: Keeps colours (Q34) positive, whatever the weights are, by a bit that is taken away in the end. It stands above
#: the brightest that a flat face may have before its highlights, 20 * 255 levels, at three corners.
WEIGHTED_BIAS = ((1 << 48) + (1 << 18)) * ONES


def color_at(depth: int, s: int, t: int, x: int, y: int, r: Registers) -> int:
    """Return the colour at a place: signed lanes of 85 bits, Q10, not clamped to 0..255.

    depth, s, t: the depth (with 8 more bits than in a vertex) and the barycentric coordinates on the screen, Q24; these
    may be negative, or above 1, outside the triangle. x, y: the ray through the place, Q24; the place itself, Q32, for
    an orthographic camera.
    """
    s, t = corrected(depth, s, t, r)
    if r.mode & IS_ORTHOGRAPHIC:
        r.fragment_place_x, r.fragment_place_y = x >> 16, y >> 16
        x = y = 0
    # each lane has 2^24 too much, so that it is positive
    color = ((r.color_0 + r.color_1 * s + r.color_2 * t) & MASK) >> 24
    normal_ray = r.face_n_dot_ray + (signed(r.face_n_dot_ray_slope * depth) >> 94)
    glossy = 0
    if r.mode & IS_LIT and r.mode & IS_DIFFUSE == 0:
        color += highlights(normal_ray, x, y, r)
    elif r.mode & IS_LIT:
        if r.mode & IS_SMOOTH:
            interpolate_normal(s, t, x, y, r)
        else:
            r.fragment_normal_ray = normal_ray
        glossy = light_of(depth, x, y, r)
    lanes = 0
    for channel in range(3):
        value = ((color >> (56 * channel)) & 0xFFFFFFFF) - (1 << 24)
        if r.mode & IS_DIFFUSE:
            # colours of Q10 times light of Q40
            value = value * ((r.fragment_light >> (56 * channel + 24)) & 0xFFFFFFFF) >> 16
            value += (glossy >> (56 * channel)) & 0xFFFFFF
        lanes += value << (85 * channel)
    return lanes


def corrected(depth: int, s: int, t: int, r: Registers) -> tuple[int, int]:
    """Return barycentric coordinates on the screen as those of the surface, Q24: correct in perspective."""
    if r.mode & IS_ORTHOGRAPHIC == 0:
        s, t = divide_signed(s * r.depth_1, depth), divide_signed(t * r.depth_2, depth)
        if r.mode & IS_STEEP:
            # rounding counts much where a near vertex meets a far fragment
            s, t = min(s, 1 << 24), min(t, 1 << 24)
    return s, t


def ray_length(x: int, y: int, r: Registers) -> int:
    """Return the length of the ray (x, y, 1), Q24."""
    square = x * x + y * y + (1 << 48)
    length = r.length_at_0 + (square * r.length_slope >> 48)
    for _ in range(r.length_steps + 1):
        length = (length + square // length) >> 1
    return length


def specular(square: int, r: Registers) -> int:
    """Return the highlight, Q16, from the square of its cosine, Q24."""
    if r.specular_root:
        return (r.specular_root * sqrt(min(square, 1 << 24) << 24)) >> 24
    if square <= r.specular_begin:
        return 0
    square = min(((square - r.specular_begin) * r.specular_scale) & MASK, 1 << 46)
    entry = r.specular_table[square >> 40]
    return (entry >> 128) + ((entry & 0xFFFFFFFF) * ((square >> 24) & 0xFFFF) >> 16)


def highlights(normal_ray: int, x: int, y: int, r: Registers) -> int:
    """Return the highlights of directional lights, whose diffuse light is in the colour: lanes of Q10."""
    length = ray_length(x, y, r)
    total = 0
    for record in r.lights:
        if record.n_dot_l > 0:
            # |L| = 1, |V| = length: (N.H)^2 = (N.L * length - N.V)^2 / (2 * length * (length - L.V))
            n_dot_h = record.n_dot_l * length - normal_ray
            if n_dot_h > 0:
                light_ray = record.x * x + record.y * y + (record.z << 24)
                square = divide(n_dot_h * n_dot_h, (length << 1) * ((length << 24) - light_ray))
                total += record.color * specular(square, r)
    return (total >> 6) & LANES_24


def cone(light: LightRecord, x: int, y: int, z: int, distance: int) -> int:
    """Return the share of a light that reaches a fragment through its cone, Q16; x, y, z: from the fragment to the
    light.
    """
    if not light.cone:
        return 1 << 16
    cosine = -divide_signed(light.axis_x * x + light.axis_y * y + light.axis_z * z, distance)
    strength = min((max(cosine - light.cos_outer, 0) << 16) // light.cone, 1 << 16)
    return strength * strength >> 16


def light_of(depth: int, x: int, y: int, r: Registers) -> int:
    """Add up the diffuse light of lights of both kinds; return the highlights, lanes of Q10."""
    length = ray_length(x, y, r)
    r.fragment_light = r.ambient << 24
    is_smooth = r.mode & IS_SMOOTH
    total = 0
    for light in r.lights:
        lx, ly, lz = light.x, light.y, light.z
        distance = 1 << 24
        if light.is_point:
            # from the fragment to the light, Q16
            if r.mode & IS_ORTHOGRAPHIC == 0:
                distance = divide(r.depth_scale << 8, depth)
                lx -= x * distance >> 40
                ly -= y * distance >> 40
                lz -= distance >> 16
            else:
                lx -= r.fragment_place_x
                ly -= r.fragment_place_y
                lz -= ((r.depth_scale << 8) - depth) >> 16
            distance = sqrt(lx * lx + ly * ly + lz * lz)
        strength = cone(light, lx, ly, lz, distance)
        # N.L
        if is_smooth:
            n_dot_l = r.fragment_normal_x * lx + r.fragment_normal_y * ly + r.fragment_normal_z * lz
        else:
            n_dot_l = light.n_dot_l << 24
        if n_dot_l > 0:
            cosine = divide(n_dot_l << 24, distance * r.fragment_normal_length)
            r.fragment_light += light.diffuse * (cosine * strength >> 16)
            # with d = |L|, l = |V|: (N.H)^2 = (N.L * l - N.V * d)^2 / (N^2 * 2 * d * l * (d * l - L.V))
            n_dot_l = n_dot_l * length - distance * r.fragment_normal_ray
            if n_dot_l > 0:
                light_ray = lx * x + ly * y + (lz << 24)
                divisor = distance * (length << 1) * (distance * length - light_ray)
                value = specular(divide((n_dot_l * n_dot_l) << 24, r.fragment_square * divisor), r)
                total += light.color * (value * strength >> 16)
    # colours of lights are Q10 with effects
    return (total >> (16 if r.has_effects else 6)) & LANES_24


def interpolate_normal(s: int, t: int, x: int, y: int, r: Registers) -> None:
    """Interpolate the normal of a fragment, Q24."""
    s, t = (s & MASK) >> 8, (t & MASK) >> 8
    lanes = r.normals.at_0 + r.normals.to_1 * s + r.normals.to_2 * t + NORMAL_BIAS
    r.fragment_normal_x = nx = ((lanes >> 12) & 0x7FFFFFF) - 0x4000000
    r.fragment_normal_y = ny = ((lanes >> 97) & 0x7FFFFFF) - 0x4000000
    r.fragment_normal_z = nz = ((lanes & MASK) >> 182) - 0x4000000
    r.fragment_square = nx * nx + ny * ny + nz * nz
    r.fragment_normal_ray = nx * x + ny * y + (nz << 24)
    r.fragment_normal_length = sqrt(r.fragment_square)
