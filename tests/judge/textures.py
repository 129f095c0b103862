"""The colour of a texture, as OpenGL defines it: docs/light.md."""

from __future__ import annotations

import numpy as np

from .calldata import Array, Integers, Texture


def color_at(texture: Texture, uvs: Array) -> Array:
    """Return the colours (n, 3), 0..255, at coordinates (n, 2); (0, 0) is the upper left corner."""
    return _at(texture, texture.texels, uvs)


def alpha_at(texture: Texture, uvs: Array) -> Array:
    """Return the opacities (n, 1), 0..1, at coordinates (n, 2)."""
    if texture.alpha is None:
        return np.ones((len(uvs), 1))
    alpha = _at(texture, texture.alpha, uvs)
    return alpha / 255 if texture.cutoff == 0 else (alpha >= texture.cutoff - 1e-6).astype(np.float64)


def _at(texture: Texture, texels: Array, uvs: Array) -> Array:
    place = uvs * texture.texels.shape[1::-1]
    if not texture.bilinear:
        return _texel(texture, texels, np.floor(place).astype(np.int64))
    first = np.floor(place - 0.5)
    part = (place - 0.5 - first)[:, None]
    u, v = np.arange(2), np.arange(2)[:, None]
    found = np.zeros((len(uvs), texels.shape[2]))
    for du, dv in np.broadcast(u, v):
        share = np.where(du, part[..., 0], 1 - part[..., 0]) * np.where(dv, part[..., 1], 1 - part[..., 1])
        found += share * _texel(texture, texels, first.astype(np.int64) + np.array([du, dv]))
    return found


def _texel(texture: Texture, texels: Array, at: Integers) -> Array:
    size = np.array(texture.texels.shape[1::-1])
    at = np.clip(at, 0, size - 1) if texture.clamps else at % size
    return np.asarray(texels[at[:, 1], at[:, 0]])
