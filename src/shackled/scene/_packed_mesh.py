"""Packed meshes, in the format of contracts/src/scene/Mesh.sol."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ._arithmetic import length
from ._mesh import MAX_FACES, MAX_VERTICES, Mesh, vertex_normals

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
    """Return the bytes of a mesh whose coordinates are whole numbers, -2^23..2^23-1; with normals if `smooth`.

    Coordinates take 16 bits where all fit, else 24.
    """
    positions, faces = mesh.positions, mesh.faces
    if len(positions) > MAX_VERTICES or len(faces) > MAX_FACES:
        raise InputError(
            f"a mesh has {len(positions):,} vertices and {len(faces):,} triangles; a contract takes {MAX_VERTICES:,}"
            f" and {MAX_FACES:,}: simplify it with `max_triangles`"
        )
    if not is_integral(positions):
        raise InputError(f"a packed mesh needs whole coordinates from {-MAX_WIDE - 1:,} to {MAX_WIDE:,}")
    coordinates = np.ascontiguousarray(positions, dtype=">i4")
    wide = not fits(positions, MAX_SHORT)
    octets = coordinates.view(np.uint8).reshape(len(positions), 3, 4)[:, :, 1 if wide else 2 :]
    columns = [octets.reshape(len(positions), -1), mesh.colors]
    if smooth:
        columns.append(_pack_normals(_normals(mesh)))
    header = np.array([len(positions), len(faces)], dtype=">u2").tobytes()
    kind = bytes([WIDE * wide + NORMALS * smooth])
    return kind + header + np.hstack(columns).tobytes() + faces.astype(">u2").tobytes()


def unpack(packed: bytes) -> Mesh:
    """Return the mesh of packed bytes, such that `pack` makes the same bytes of it again. InputError for any others."""
    if len(packed) < HEADER or packed[0] > NORMALS + WIDE:
        raise InputError("a packed mesh must begin with a format from 0 to 3 and two counts")
    vertices, faces = (int.from_bytes(packed[at : at + 2], "big") for at in (1, 3))
    size = 3 if packed[0] & WIDE else 2
    stride = 3 * size + (7 if packed[0] & NORMALS else 3)
    expected = HEADER + vertices * stride + faces * 6
    if len(packed) != expected:
        raise InputError(
            f"a packed mesh of {vertices:,} vertices and {faces:,} triangles has {expected:,} bytes,"
            f" not {len(packed):,}"
        )
    rows = np.frombuffer(packed, np.uint8, vertices * stride, HEADER).reshape(vertices, stride)
    octets = np.zeros((vertices, 3, 4), np.uint8)
    octets[:, :, :size] = rows[:, : 3 * size].reshape(vertices, 3, size)
    # shifted down with the sign
    positions = octets.view(">i4")[:, :, 0] >> (32 - 8 * size)
    corners = np.frombuffer(packed, ">u2", 3 * faces, HEADER + vertices * stride).reshape(faces, 3)
    normals = _unpack_normals(rows[:, -4:]) if packed[0] & NORMALS else None
    return Mesh(positions, corners, np.array(rows[:, 3 * size : 3 * size + 3]), normals)


def is_integral(positions: NDArray[np.float64]) -> bool:
    """Return whether all coordinates are whole numbers that a packed mesh can hold."""
    return fits(positions, MAX_WIDE) and bool((positions % 1 == 0).all())


def fits(positions: NDArray[np.float64], largest: int) -> bool:
    """Return whether all coordinates lie in -largest-1..largest."""
    return bool((positions <= largest).all() and (positions >= -largest - 1).all())


def _normals(mesh: Mesh) -> NDArray[np.float64]:
    if mesh.normals is None:
        return vertex_normals(mesh.positions, mesh.faces)
    normals = mesh.normals
    lengths = length(normals)[:, None]
    unit: NDArray[np.float64] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    return unit


def _pack_normals(normals: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return unit vectors, (n, 3), as (n, 4) bytes: three numbers of 10 bits, then two zero bits."""
    x, y, z = (np.rint(normals * NORMAL_UNIT).astype(np.int64) & 1023).T
    words = np.asarray(x << 22 | y << 12 | z << 2, dtype=">u4")
    return words.view(np.uint8).reshape(-1, 4)


def _unpack_normals(octets: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Return vectors, (n, 3), that `_pack_normals` rounds to the same numbers, although it makes them unit vectors.

    Those numbers do not always round to themselves at a length of exactly `NORMAL_UNIT`. Between them and a corner of
    the cube of half a step around them, the nearest to the origin or the farthest from it, there is a point of that
    length: the length of a corner never equals it, since the sum of three odd squares is 3 modulo 8. Numbers of other
    lengths, which `_pack_normals` does not make, stay as they are.
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
