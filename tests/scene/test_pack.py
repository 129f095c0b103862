"""Meshes as the bytes that a contract reads, by hand."""

from __future__ import annotations

import struct

import numpy as np
import pytest

from shackled.errors import InputError
from shackled.scene import Mesh, pack

FACES = [[0, 1, 2]]
COLORS = [[1, 2, 3], [4, 5, 6], [7, 8, 255]]


def triangle(*numbers: float) -> Mesh:
    """One with these coordinates, the others 0."""
    positions = np.zeros(9)
    positions[: len(numbers)] = numbers
    return Mesh(positions.reshape(3, 3), FACES, COLORS)


def test_a_mesh_in_16_bits() -> None:
    vertices = [(1, -2, 3, *COLORS[0]), (-(2**15), 2**15 - 1, 0, *COLORS[1]), (256, 255, -256, *COLORS[2])]
    mesh = Mesh([vertex[:3] for vertex in vertices], [[0, 1, 2], [2, 1, 0]], COLORS)
    expected = bytes([0]) + struct.pack(">HH", 3, 2)
    expected += b"".join(struct.pack(">hhhBBB", *vertex) for vertex in vertices) + struct.pack(">6H", 0, 1, 2, 2, 1, 0)
    assert pack(mesh) == expected


@pytest.mark.parametrize("number", [2**15, -(2**15) - 1, 2**23 - 1, -(2**23)])
def test_a_mesh_in_24_bits(number: int) -> None:
    """As soon as one coordinate needs them."""
    packed = pack(triangle(0, number, -1))
    places = [b"\0" * 3 + number.to_bytes(3, "big", signed=True) + b"\xff" * 3, bytes(9), bytes(9)]
    vertices = b"".join(place + bytes(color) for place, color in zip(places, COLORS, strict=True))
    assert packed == bytes([2]) + struct.pack(">HH", 3, 1) + vertices + struct.pack(">HHH", 0, 1, 2)


@pytest.mark.parametrize("number", [2**23, -(2**23) - 1, 0.5, 2.0**60])
def test_coordinates_that_cannot_be_packed(number: float) -> None:
    with pytest.raises(InputError, match=r"^a packed mesh needs whole coordinates from -8,388,608 to 8,388,607$"):
        pack(triangle(0, 0, number))


def test_normals_are_three_numbers_of_ten_bits() -> None:
    """Of unit length times 511, rounded, however long they were; what has no length points nowhere."""
    normals = [[0.6, -0.8, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 0.0]]
    packed = pack(Mesh(np.eye(3), FACES, COLORS, normals), smooth=True)
    assert packed[0] == 1
    rows = [packed[5 + 13 * vertex :][:13] for vertex in range(3)]
    assert [row[6:9] for row in rows] == [bytes(color) for color in COLORS]
    words = [int.from_bytes(row[9:], "big") for row in rows]
    assert words == [307 << 22 | (1024 - 409) << 12, 511 << 12, 0]
    assert len(packed) == 5 + 3 * 13 + 6
    turned = pack(Mesh(np.eye(3), FACES, COLORS, [[0.0, 0.6, -0.8], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]]), smooth=True)
    words = [int.from_bytes(turned[5 + 13 * vertex + 9 :][:4], "big") for vertex in range(3)]
    assert words == [307 << 12 | (1024 - 409) << 2, 511 << 2, (1024 - 511) << 22]


def test_a_mesh_without_normals_is_given_them() -> None:
    flat = triangle(0, 0, 0, 9, 0, 0, 0, 9)
    assert pack(flat, smooth=True) == pack(Mesh(flat.positions, FACES, COLORS, [[0, 0, 5]] * 3), smooth=True)
    wide = triangle(0, 0, 0, 2**20, 0, 0, 0, 9)
    assert pack(wide, smooth=True)[0] == 3


def test_the_largest_meshes() -> None:
    corners = np.zeros((65535, 3))
    faces = np.tile(FACES, (65535, 1))
    assert pack(Mesh(corners, faces))[1:5] == b"\xff" * 4
    words = r"has {} vertices and {} triangles; a contract takes 65,535 and 65,535: simplify it with `max_triangles`$"
    with pytest.raises(InputError, match=words.format("65,536", "1")):
        pack(Mesh(np.zeros((65536, 3)), FACES))
    with pytest.raises(InputError, match=words.format("65,535", "65,536")):
        pack(Mesh(corners, np.tile(FACES, (65536, 1))))
