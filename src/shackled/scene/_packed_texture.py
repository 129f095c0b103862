"""Packed textures, in the format of the records TEXTURE and ALPHA of contracts/src/effects/EffectRecords.sol."""

from __future__ import annotations

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..checks import Floats
from ..errors import InputError
from ._records import TEXTURE_BILINEAR, TEXTURE_CLAMP
from ._texture import Texture

#: Bytes before the palette: flags, width - 1, height - 1, bits of a texel.
HEADER = 4
#: Bits of a texel that is the number of a colour in a palette of 2^bits colours, and of one that is a colour.
INDEX_BITS = (1, 2, 4, 8)
COLOR_BITS = 24
#: The unit of texture coordinates, and the bytes of one.
UV_STEP = 2.0**-16
UV_SIZE = 3
#: Texture coordinates are from -LARGEST_UV to below LARGEST_UV.
LARGEST_UV = 128


def pack_texture(texture: Texture, uvs: Floats) -> bytes:
    """Return the bytes of a texture with the coordinates of vertices, (n, 2), in whole words of 32 bytes.

    An image of up to 256 colours has a palette. InputError for coordinates out of range.
    """
    content = _pack_image(texture, texture.pixels) + _pack_uvs(uvs)
    return content + bytes(-len(content) % 32)


def pack_alpha(texture: Texture) -> bytes:
    """Return the bytes of the record ALPHA of a texture that has an alpha, in whole words of 32 bytes."""
    assert texture.alpha is not None
    content = bytes([texture.cutoff]) + _pack_image(texture, np.repeat(texture.alpha[..., None], 3, axis=2))
    return content + bytes(-len(content) % 32)


def _pack_image(texture: Texture, pixels: NDArray[np.uint8]) -> bytes:
    """Return header, palette and texels of an image, (h, w, 3), with the filter and the wrap of a texture."""
    flags = TEXTURE_BILINEAR * (texture.filter == "bilinear") + TEXTURE_CLAMP * (texture.wrap == "clamp")
    texels = pixels.reshape(-1, 3)
    colors, numbers = np.unique(texels, axis=0, return_inverse=True)
    bits = next((each for each in INDEX_BITS if len(colors) <= 1 << each), COLOR_BITS)
    content = texels.tobytes() if bits == COLOR_BITS else _indexed(colors, numbers.reshape(-1), bits)
    return bytes([flags, texture.width - 1, texture.height - 1, bits]) + content


def _indexed(colors: NDArray[np.uint8], numbers: NDArray[np.int64], bits: int) -> bytes:
    palette = np.zeros((1 << bits, 3), np.uint8)
    palette[: len(colors)] = colors
    digits = np.unpackbits(numbers.astype(np.uint8)[:, None], axis=1)[:, 8 - bits :]
    return palette.tobytes() + np.packbits(digits).tobytes()


def _pack_uvs(uvs: Floats) -> bytes:
    bad = np.flatnonzero(~((uvs >= -LARGEST_UV) & (uvs <= LARGEST_UV - UV_STEP)).all(axis=1))
    if len(bad):
        u, v = uvs[bad[0]].tolist()
        raise InputError(
            f"the texture coordinates of vertex {bad[0]} must be from {-LARGEST_UV} to below {LARGEST_UV},"
            f" not ({u:g}, {v:g})"
        )
    return np.ascontiguousarray(np.rint(uvs / UV_STEP), ">i4").view(np.uint8).reshape(-1, 4)[:, 1:].tobytes()


def unpack_texture(packed: bytes, vertices: int) -> tuple[Texture, Floats]:
    """Return the texture and the coordinates, (n, 2), of packed bytes, such that `pack_texture` makes the same again.

    InputError for any others.
    """
    texture, begin = _unpack_image(packed, 2 * UV_SIZE * vertices)
    octets = np.zeros((2 * vertices, 4), np.uint8)
    octets[:, :UV_SIZE] = np.frombuffer(packed, np.uint8)[begin:][: 2 * UV_SIZE * vertices].reshape(-1, UV_SIZE)
    uvs = (octets.view(">i4")[:, 0] >> 8).astype(np.float64).reshape(-1, 2) * UV_STEP
    if pack_texture(texture, uvs) != packed:
        raise InputError(_OTHER)
    return texture, uvs


def unpack_alpha(packed: bytes, texture: Texture) -> Texture:
    """Return the texture with the alpha of a record ALPHA, such that `pack_alpha` makes the same again.

    InputError for any others.
    """
    image, _ = _unpack_image(packed[1:], 0, before=1)
    if image.pixels.shape != texture.pixels.shape:
        raise InputError("the alpha of a texture must have the size of its colours")
    whole = evolve(texture, alpha=image.pixels[..., 2], cutoff=packed[0])
    if pack_alpha(whole) != packed:
        raise InputError(_OTHER)
    return whole


_OTHER = "a packed texture must have the palette and the bits that its colours need, in ascending order"


def _unpack_image(packed: bytes, more: int, before: int = 0) -> tuple[Texture, int]:
    """Return the texture of header, palette and texels, and where they end; `more` bytes and zeros to words follow.

    before: the bytes of the record before them.
    """
    if (
        len(packed) < HEADER
        or packed[0] > TEXTURE_BILINEAR + TEXTURE_CLAMP
        or packed[3] not in (*INDEX_BITS, COLOR_BITS)
    ):
        raise InputError("a packed texture must begin with flags from 0 to 3, two sides, and 1, 2, 4, 8 or 24 bits")
    width, height, bits = packed[1] + 1, packed[2] + 1, packed[3]
    palette = 0 if bits == COLOR_BITS else 3 << bits
    texels = (width * height * bits + 7) // 8
    begin = HEADER + palette
    expected = begin + texels + more
    expected += -(expected + before) % 32
    if len(packed) != expected:
        raise InputError(
            f"a packed texture of {width} x {height} texels of {bits} bits with {more // (2 * UV_SIZE):,} coordinates"
            f" has {expected:,} bytes, not {len(packed):,}"
        )
    data = np.frombuffer(packed, np.uint8)
    if palette:
        digits = np.unpackbits(data[begin : begin + texels])[: width * height * bits].reshape(-1, bits)
        numbers = np.packbits(digits, axis=1)[:, 0] >> (8 - bits)
        colors = data[HEADER:begin].reshape(-1, 3)[numbers]
    else:
        colors = data[begin : begin + texels]
    texture = Texture(
        colors.reshape(height, width, 3),
        "bilinear" if packed[0] & TEXTURE_BILINEAR else "nearest",
        "clamp" if packed[0] & TEXTURE_CLAMP else "repeat",
    )
    return texture, begin + texels
