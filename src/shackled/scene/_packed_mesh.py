"""Packed meshes, in the format of contracts/src/scene/Mesh.sol."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ._arithmetic import length
from ._mesh import MAX_FACES, MAX_VERTICES, Mesh, vertex_normals

NORMALS = 1
WIDE = 2

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
