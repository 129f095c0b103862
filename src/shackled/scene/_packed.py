"""Packed meshes and textures, in the formats of contracts/src/scene/Mesh.sol and effects/EffectRecords.sol."""

from __future__ import annotations

import struct

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..base.checks import Floats
from ..errors import InputError
from ._arithmetic import units
from ._mesh import MAX_FACES, MAX_VERTICES, Mesh, vertex_normals
from ._records import TEXTURE_BILINEAR, TEXTURE_CLAMP
from ._texture import Texture

NORMALS = 1
WIDE = 2
#: Bytes before the vertices.
HEADER = 5

#: The largest coordinates, of 16 and of 24 bits.
MAX_SHORT = 2**15 - 1
MAX_WIDE = 2**23 - 1

#: A unit normal is sent as a vector of this length.
NORMAL_UNIT = 511


def pack(mesh: Mesh, smooth: bool = False) -> bytes:
    """Return the bytes of a mesh with whole coordinates, of 16 bits if all fit, else 24; with normals if `smooth`."""
    positions, faces = mesh.positions, mesh.faces
    if len(positions) > MAX_VERTICES or len(faces) > MAX_FACES:
        found = f"{len(positions):,} vertices and {len(faces):,} triangles"
        most = f"{MAX_VERTICES:,} and {MAX_FACES:,}"
        raise InputError(f"a mesh has {found}; a contract takes {most}: simplify it with `max_triangles`")
    if (bits := bits_of(positions)) is None:
        raise InputError(f"a packed mesh needs whole coordinates from {-MAX_WIDE - 1:,} to {MAX_WIDE:,}")
    coordinates = np.ascontiguousarray(positions, dtype=">i4")
    octets = coordinates.view(np.uint8).reshape(len(positions), 3, 4)[:, :, 4 - bits // 8 :]
    columns = [octets.reshape(len(positions), -1), mesh.colors]
    if smooth:
        normals = vertex_normals(positions, faces) if mesh.normals is None else units(mesh.normals)
        columns.append(_pack_normals(normals))
    header = struct.pack(">BHH", WIDE * (bits == 24) + NORMALS * smooth, len(positions), len(faces))
    return header + np.hstack(columns).tobytes() + faces.astype(">u2").tobytes()


def unpack(packed: bytes) -> Mesh:
    """Return the mesh of bytes of `pack`, which makes the same of it again. InputError where none can be read."""
    kind, vertices, faces = struct.unpack(">BHH", packed[:HEADER].ljust(HEADER, b"\0"))
    size = 3 if kind & WIDE else 2
    stride = 3 * size + (7 if kind & NORMALS else 3)
    expected = HEADER + vertices * stride + faces * 6
    if len(packed) != expected:
        raise InputError(
            f"a packed mesh of {vertices} vertices and {faces} faces has {expected} bytes, not {len(packed)}"
        )
    rows = np.frombuffer(packed, np.uint8, vertices * stride, HEADER).reshape(vertices, stride)
    octets = np.zeros((vertices, 3, 4), np.uint8)
    octets[:, :, :size] = rows[:, : 3 * size].reshape(vertices, 3, size)
    # shifted down with the sign
    positions = octets.view(">i4")[:, :, 0] >> (32 - 8 * size)
    corners = np.frombuffer(packed, ">u2", 3 * faces, HEADER + vertices * stride).reshape(faces, 3)
    normals = _unpack_normals(rows[:, -4:]) if kind & NORMALS else None
    return Mesh(positions, corners, np.array(rows[:, 3 * size : 3 * size + 3]), normals)


def bits_of(positions: Floats) -> int | None:
    """Return how many bits each coordinate takes in a packed mesh, 16 or 24; None if one is no such whole number."""
    low, high = positions.min(), positions.max()
    sizes = [bits for bits, most in ((16, MAX_SHORT), (24, MAX_WIDE)) if -most - 1 <= low and high <= most]
    return sizes[0] if sizes and (positions % 1 == 0).all() else None


def _pack_normals(normals: Floats) -> NDArray[np.uint8]:
    """Return unit vectors, (n, 3), as (n, 4) bytes: three numbers of 10 bits, then two zero bits."""
    x, y, z = (np.rint(normals * NORMAL_UNIT).astype(np.int64) & 1023).T
    words = np.asarray(x << 22 | y << 12 | z << 2, dtype=">u4")
    return words.view(np.uint8).reshape(-1, 4)


def _unpack_normals(octets: NDArray[np.uint8]) -> Floats:
    """Return vectors, (n, 3), that `_pack_normals` rounds to the same numbers, although it makes them unit vectors.

    Those do not always round to themselves at a length of exactly `NORMAL_UNIT`. Between them and a corner of the cube
    of half a step around them, the nearest to the origin or the farthest from it, there is a point of that length: a
    corner never has it, since the sum of three odd squares is 3 modulo 8. Numbers of other lengths stay as they are.
    """
    words = np.ascontiguousarray(octets).view(">u4").astype(np.int64)
    numbers = ((words >> np.array([22, 12, 2]) & 1023 ^ 512) - 512).astype(np.float64)
    excess = (numbers**2).sum(axis=1) - NORMAL_UNIT**2
    outward = np.where(numbers < 0, -0.5, 0.5)
    way = np.where(excess[:, None] > 0, np.where(numbers == 0, 0, -outward), outward)
    # |numbers + t way| = NORMAL_UNIT
    a, b = (way**2).sum(axis=1), np.abs((numbers * way).sum(axis=1))
    with np.errstate(invalid="ignore", divide="ignore"):
        t = np.abs(excess) / (b + np.sqrt(b**2 - a * excess))
    return np.asarray(numbers + np.where(t < 1, t, 0)[:, None] * way)


#: Bytes before the palette: flags, width - 1, height - 1, bits of a texel.
TEXTURE_HEADER = 4
#: Bits of a texel that is the number of a colour in a palette of 2^bits colours, and of one that is a colour.
INDEX_BITS = (1, 2, 4, 8)
COLOR_BITS = 24
#: The unit of texture coordinates, and the bytes of one.
UV_STEP = 2.0**-16
UV_SIZE = 3
#: Texture coordinates are from -LARGEST_UV to below LARGEST_UV.
LARGEST_UV = 128


def pack_texture(texture: Texture, uvs: Floats) -> bytes:
    """Return the words of a texture with the coordinates of vertices, (n, 2). InputError for those out of range."""
    return _in_words(_pack_image(texture, texture.pixels) + _pack_uvs(uvs))


def pack_alpha(texture: Texture) -> bytes:
    """Return the bytes of the record ALPHA of a texture that has an alpha, in whole words of 32 bytes."""
    assert texture.alpha is not None
    return _in_words(bytes([texture.cutoff]) + _pack_image(texture, np.repeat(texture.alpha[..., None], 3, axis=2)))


def _in_words(content: bytes) -> bytes:
    return content + bytes(-len(content) % 32)


def _pack_image(texture: Texture, pixels: NDArray[np.uint8]) -> bytes:
    """Return header, palette and texels of an image, (h, w, 3), with the filter and the wrap of a texture."""
    flags = TEXTURE_BILINEAR * (texture.filter == "bilinear") + TEXTURE_CLAMP * (texture.wrap == "clamp")
    texels = pixels.reshape(-1, 3)
    colors, numbers = np.unique(texels, axis=0, return_inverse=True)
    bits = next((each for each in INDEX_BITS if len(colors) <= 1 << each), COLOR_BITS)
    header = bytes([flags, texture.width - 1, texture.height - 1, bits])
    if bits == COLOR_BITS:
        return header + texels.tobytes()
    digits = np.unpackbits(numbers.reshape(-1, 1).astype(np.uint8), axis=1)[:, 8 - bits :]
    return header + colors.tobytes().ljust(3 << bits, b"\0") + np.packbits(digits).tobytes()


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
    """Return the texture, and the coordinates of vertices, (n, 2), of `pack_texture`. InputError as `unpack`."""
    texture, begin = _unpack_image(packed, 2 * UV_SIZE * vertices)
    octets = np.zeros((2 * vertices, 4), np.uint8)
    octets[:, :UV_SIZE] = np.frombuffer(packed, np.uint8)[begin:][: 2 * UV_SIZE * vertices].reshape(-1, UV_SIZE)
    return texture, (octets.view(">i4")[:, 0] >> 8).astype(np.float64).reshape(-1, 2) * UV_STEP


def unpack_alpha(packed: bytes, texture: Texture) -> Texture:
    """Return the texture with the alpha of `pack_alpha`. InputError as `unpack`."""
    image, _ = _unpack_image(packed[1:], 0, before=1)
    return evolve(texture, alpha=image.pixels[..., 2], cutoff=packed[0])


def _unpack_image(packed: bytes, more: int, before: int = 0) -> tuple[Texture, int]:
    """Return the texture of header, palette and texels, and where they end. before, more: bytes of the record."""
    flags, width, height, bits = packed[:TEXTURE_HEADER].ljust(TEXTURE_HEADER, b"\0")
    if bits not in (*INDEX_BITS, COLOR_BITS):
        raise InputError(f"a packed texture must have 1, 2, 4, 8 or 24 bits, not {bits}")
    width, height = width + 1, height + 1
    palette = 0 if bits == COLOR_BITS else 3 << bits
    texels = (width * height * bits + 7) // 8
    begin = TEXTURE_HEADER + palette
    expected = begin + texels + more
    expected += -(expected + before) % 32
    if len(packed) != expected:
        raise InputError(f"a packed texture of {width} x {height} texels has {expected} bytes, not {len(packed)}")
    data = np.frombuffer(packed, np.uint8)
    if palette:
        digits = np.unpackbits(data[begin : begin + texels])[: width * height * bits].reshape(-1, bits)
        numbers = np.packbits(digits, axis=1)[:, 0] >> (8 - bits)
        colors = data[TEXTURE_HEADER:begin].reshape(-1, 3)[numbers]
    else:
        colors = data[begin : begin + texels]
    texture = Texture(
        colors.reshape(height, width, 3),
        "bilinear" if flags & TEXTURE_BILINEAR else "nearest",
        "clamp" if flags & TEXTURE_CLAMP else "repeat",
    )
    return texture, begin + texels
