"""The light and the colour of points of a surface: docs/look.md and docs/light.md.

    radiance = surface * (ambient * A + sum_i diffuse * max(0, N.L_i) * C_i)
             + sum_i specular * max(0, N.H_i)^shininess * C_i + emission

C_i is the colour of a light, times what its cone lets through; highlights are where N.L_i > 0. Of objects with two
sides, N is turned where the face is seen from behind. A hemisphere adds ground + (sky - ground) * (1 + N.y) / 2 to A, a
rim its colour * (1 - max(0, N.V))^power to the sum. With gamma, surface, A, C_i, emission, hemisphere and rim are
decoded from sRGB. The sum times the exposure, clamped or compressed by the filmic curve, and encoded with gamma, is the
colour. Fog covers it by the distance along the line of sight.
"""

from __future__ import annotations

import numpy as np

from .calldata import FLAT, UNLIT, Array, Effects, Integers, Surface, World, unit
from .textures import alpha_at, color_at

#: A highlight ends where N.L is zero: it may or may not be there where N.L is this near to zero.
GRAZING = 0.004


def colors(
    world: World, surface: Surface, face: Integers, weights: Array, places: Array | None = None
) -> tuple[Array, Array, Array]:
    """Return the colours (3, n, 3), 0..255, of points of a surface: the least, the likely and the most; lit by all
    lights, and where the light with shadows does not reach. And their opacities (n,).

    face, weights: (n,) and (n, 3) say which points. places: (n, 2) of the canvas, in pixels, where lines of sight and
    to lights begin, at the depths of the points.
    """
    frame, effects = world.frame, world.effects
    corners = surface.faces[face]
    point = mix(surface.positions[corners], weights)
    base = mix(surface.colors[corners], weights)
    if surface.texture is not None and surface.uvs is not None:
        base = base * color_at(surface.texture, mix(surface.uvs[corners], weights)) / 255
    distance = frame.to_camera(point)[:, 2:]
    beside = point if places is None else frame.unproject(places, distance)
    radiance = _radiance(world, surface, corners, weights, point, beside, _light(effects, base))
    emission = _light(effects, surface.emission)
    lit, dark = (_fogged(effects, _toned(effects, each + emission), distance) for each in radiance)
    opacity = np.clip(mix(surface.opacities[corners][..., None], weights)[:, 0], 0, 1)
    if surface.texture is not None and surface.uvs is not None:
        opacity = opacity * alpha_at(surface.texture, mix(surface.uvs[corners], weights))[:, 0]
    if surface.fade is not None:
        inner, outer = surface.fade
        away = ((point - surface.center) ** 2).sum(axis=1)
        opacity = opacity * np.clip((outer**2 - away) / (outer**2 - inner**2), 0, 1)
    return lit, dark, opacity


def _radiance(
    world: World, surface: Surface, corners: Integers, weights: Array, point: Array, beside: Array, base: Array
) -> tuple[Array, Array]:
    """The light of points, 0..1 and brighter, (3, n, 3): of all lights, and without that of which there are shadows.

    beside: where lines of sight and to lights begin; how far the eye and lights are before a flat face is that of
    `point`.
    """
    effects, frame = world.effects, world.frame
    if surface.shading == UNLIT:
        alone = np.broadcast_to(base, (3, *base.shape))
        return alone, alone
    a, b, c = surface.positions[corners].transpose(1, 0, 2)
    across = np.cross(b - a, c - a)
    normal = unit(across if surface.shading == FLAT else mix(surface.normals[corners], weights))
    if surface.two_sided and not surface.is_wire:
        normal = np.where(_dot(across, frame.to_eye(a)) < 0, -normal, normal)
    rise = _dot(normal, beside - point) * (surface.shading == FLAT)
    view = unit(frame.to_eye(beside))
    seen = _dot(normal, view) + (rise / _length(frame.eye - beside) if frame.perspective else 0)
    sky, ground = _light(effects, effects.sky), _light(effects, effects.ground)
    hemisphere = ground + (sky - ground) * (1 + normal[:, 1:2]) / 2
    modulate = surface.ambient * (_light(effects, world.ambient) + hemisphere)
    rim = _light(effects, effects.rim) * (1 - np.clip(seen, 0, 1)) ** effects.power
    dark = np.repeat((base * modulate + rim)[None], 3, axis=0)
    shaded = np.zeros_like(dark)
    for number, lamp in enumerate(world.lamps):
        toward = unit(lamp.toward(beside))
        facing = _dot(normal, toward) + (rise / _length(lamp.vector - beside) if lamp.is_point else 0)
        hue = _light(effects, lamp.color) * (1.0 if lamp.cone is None else _through(lamp.cone, toward))
        gloss = np.clip((facing + seen) / _length(toward + view), 0, 1) ** surface.shininess
        reached = facing > np.array([GRAZING, 0, -GRAZING])[:, None, None]
        light = hue * (base * surface.diffuse * np.maximum(0, facing) + surface.specular * gloss * reached)
        if world.shadow is not None and number == world.shadow[0]:
            shaded = shaded + light
        else:
            dark = dark + light
    return dark + shaded, dark


def _light(effects: Effects, color: Array) -> Array:
    """A colour 0..255 as light 0..1."""
    x = color / 255
    if not effects.gamma:
        return x
    x = np.maximum(x, 0)
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


def _toned(effects: Effects, radiance: Array) -> Array:
    """The colour 0..255 of light 0..1."""
    x = radiance * effects.exposure
    if effects.filmic:
        x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
    x = np.clip(x, 0, 1)
    if effects.gamma:
        x = np.where(x <= 0.0031308, x * 12.92, 1.055 * x ** (1 / 2.4) - 0.055)
    return np.asarray(255 * x)


def _fogged(effects: Effects, color: Array, distance: Array) -> Array:
    if effects.fog is None:
        return color
    hue, near, far = effects.fog
    return np.asarray(color + (hue - color) * np.clip((distance - near) / max(far - near, 2.0**-32), 0, 1))


def _through(cone: Array, toward: Array) -> Array:
    """What a spot light lets through its cone, by glTF's KHR_lights_punctual; `toward` the light."""
    inner, outer = cone[3], cone[4]
    part = (_dot(-unit(cone[:3]), toward) - outer) / max(inner - outer, 2.0**-10)
    return np.asarray(np.clip(part, 0, 1) ** 2)


def mix(values: Array, weights: Array) -> Array:
    """Return (n, 3, k) values of corners as (n, k) values of points."""
    return np.asarray(np.einsum("nij,ni->nj", values, weights))


def _length(vectors: Array) -> Array:
    return np.asarray(np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-300))


def _dot(a: Array, b: Array) -> Array:
    return np.asarray((a * b).sum(axis=-1, keepdims=True))
