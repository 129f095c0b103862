"""Unpack meshes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

NORMALS = 1
WIDE = 2


@dataclass(frozen=True)
class Mesh:
    """The numbers of a packed mesh; rows of plain Python integers.

    positions: n rows of 3, signed. colors: n rows of 3, 0..255. normals: n rows of 3, -512..511, or None.
    faces: m rows of 3 vertex numbers.
    """

    positions: list[list[int]]
    colors: list[list[int]]
    normals: list[list[int]] | None
    faces: list[list[int]]


def open_mesh(data: bytes) -> Mesh:
    """Unpack a mesh that `checks.check_mesh` has checked."""
    kind = data[0]
    vertex_count, face_count = int.from_bytes(data[1:3], "big"), int.from_bytes(data[3:5], "big")
    size = 3 if kind & WIDE else 2
    stride = 3 * size + (7 if kind & NORMALS else 3)
    rows = np.frombuffer(data, np.uint8, vertex_count * stride, 5).reshape(vertex_count, stride)
    positions = _big_endian(rows[:, : 3 * size].reshape(vertex_count, 3, size))
    normals = None
    if kind & NORMALS:
        packed = _big_endian(rows[:, 3 * size + 3 :].reshape(vertex_count, 1, 4))
        # shifted up to the sign and down again
        normals = (((packed >> np.array([22, 12, 2])) & 1023) ^ 512) - 512
    faces = np.frombuffer(data, ">u2", face_count * 3, 5 + vertex_count * stride).reshape(face_count, 3)
    return Mesh(
        (positions - ((positions >> (8 * size - 1)) << (8 * size))).tolist(),
        rows[:, 3 * size : 3 * size + 3].tolist(),
        None if normals is None else normals.tolist(),
        faces.tolist(),
    )


def _big_endian(digits: NDArray[np.uint8]) -> NDArray[np.int64]:
    """Return numbers from their bytes, which lie along the last axis."""
    result = np.zeros(digits.shape[:-1], np.int64)
    for place in range(digits.shape[-1]):
        result = (result << 8) | digits[..., place]
    return result
