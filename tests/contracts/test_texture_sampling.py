"""Colours of textures: those of the formulas of OpenGL, in floats."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from eth_abi.abi import decode
from numpy.typing import NDArray
from tools.examples import compile_example
from tools.ledger import World, call_data

from compiler import needs_compiler
from shackled import Texture
from shackled.scene._fields import FILTERS, WRAPS
from shackled.scene._packed import pack_texture

NO_UVS = np.zeros((0, 2))
ONE = 1 << 24
#: Of a channel in the word of a colour.
LANE = (1 << 56) - 1
#: Sides and numbers of colours.
SHAPES = ((1, 1, 1), (1, 7, 2), (5, 3, 3), (4, 4, 16), (13, 16, 17), (31, 9, 256), (20, 20, 400))


def texture_of(height: int, width: int, colors: int, filter: Any, wrap: Any) -> Texture:
    rng = np.random.default_rng([height, width, colors])
    palette = rng.integers(0, 256, (colors, 3), dtype=np.uint8)
    return Texture(palette[rng.integers(0, colors, (height, width))], filter, wrap)


def places_of(texture: Texture) -> NDArray[np.int64]:
    """Coordinates, Q24: anywhere, and at the borders and the centres of texels."""
    rng = np.random.default_rng(1)
    random = rng.integers(-3 * ONE, 3 * ONE, (40, 2))
    sides = np.array([texture.width, texture.height])
    exact = (rng.integers(-2, 2 * sides.max(), (40, 2)) * ONE) // (2 * sides)
    corners = np.array([(u, v) for u in (-1, 0, ONE, -ONE) for v in (0, ONE - 1, ONE, -ONE - 1)])
    far = rng.integers(-128 * ONE, 128 * ONE, (8, 2))
    return np.concatenate([random, exact, exact + 1, exact - 1, corners, far])


def by_opengl(texture: Texture, u: float, v: float) -> NDArray[np.float64]:
    """Section 8.14 of the specification of OpenGL 4.6."""
    pixels = texture.pixels.astype(float)
    height, width = pixels.shape[:2]

    def at(i: int, j: int) -> NDArray[np.float64]:
        if texture.wrap == "repeat":
            return np.asarray(pixels[j % height, i % width])
        return np.asarray(pixels[min(max(j, 0), height - 1), min(max(i, 0), width - 1)])

    if texture.filter == "nearest":
        return at(int(np.floor(u * width)), int(np.floor(v * height)))
    x, y = u * width - 0.5, v * height - 0.5
    i, j = int(np.floor(x)), int(np.floor(y))
    a, b = x - i, y - j
    mixed: NDArray[np.float64] = (1 - b) * ((1 - a) * at(i, j) + a * at(i + 1, j)) + b * (
        (1 - a) * at(i, j + 1) + a * at(i + 1, j + 1)
    )
    return mixed


@needs_compiler
def test_the_contract_is_opengl() -> None:
    world = World()
    probe = world.deploy(compile_example("tests/support/TextureProbe.sol")[0])
    for shape, filter, wrap in product(SHAPES, FILTERS, WRAPS):
        texture = texture_of(*shape, filter, wrap)
        places = places_of(texture).tolist()
        answer = world.run(probe, call_data("sample(bytes,int256[2][])", pack_texture(texture, NO_UVS), places))
        for (u, v), lanes in zip(places, decode(["uint256[]"], answer)[0], strict=True):
            levels = np.array([lanes >> shift & LANE for shift in (112, 56, 0)]) * 255 / 65536
            difference = np.abs(levels - by_opengl(texture, u / ONE, v / ONE))
            assert difference.max() < 0.2, (shape, filter, wrap, u, v)
