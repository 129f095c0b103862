import struct
from pathlib import Path

import pytest

from shackled.errors import InputError
from shackled.scene import DEFAULT_COLOR, Mesh, read_mesh

POINTS = ((0, 0, 0), (1, 0, 0), (0, 1, 0))
ASCII_STL = "solid s\nfacet normal 0 0 1\nouter loop\n{}endloop\nendfacet\nendsolid s\n"


def corner_colors(mesh: Mesh) -> list[list[list[int]]]:
    colors: list[list[list[int]]] = mesh.colors[mesh.faces].tolist()
    return colors


def corner_positions(mesh: Mesh) -> list[list[list[float]]]:
    positions: list[list[list[float]]] = mesh.positions[mesh.faces].tolist()
    return positions


def test_stl_in_binary(tmp_path: Path) -> None:
    path = tmp_path / "model.stl"
    triangle = struct.pack("<12fH", 0, 0, 1, *(float(c) for point in POINTS for c in point), 0)
    path.write_bytes(bytes(80) + struct.pack("<I", 2) + 2 * triangle)
    mesh = read_mesh(path)
    assert corner_positions(mesh) == [[list(p) for p in POINTS]] * 2
    assert len(mesh.positions) == 3
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3] * 2
    assert mesh.normals is None


def test_stl_as_text_with_two_solids(tmp_path: Path) -> None:
    path = tmp_path / "model.STL"
    one = ASCII_STL.format("".join(f"vertex {x} {y} {z}\n" for x, y, z in POINTS))
    path.write_text(one + one.replace("vertex 1 0 0", "vertex 2 0 0"))
    mesh = read_mesh(path)
    assert mesh.triangles == 2
    assert len(mesh.positions) == 4


def test_line_ends_of_an_old_mac_and_names_of_any_words(tmp_path: Path) -> None:
    path = tmp_path / "model.stl"
    text = ASCII_STL.format("".join(f"VERTEX {x} {y} {z}\n" for x, y, z in POINTS))
    path.write_bytes(text.replace("solid s", "solid a vertex 1 2 3 endfacet").replace("\n", "\r").encode())
    assert corner_positions(read_mesh(path)) == [[list(p) for p in POINTS]]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            b"\x00\x01garbage" * 20,
            ": it is neither text nor as long as a binary STL file of so many triangles would be",
        ),
        (
            ASCII_STL.format("vertex 0 0 0\nvertex 1 zero 0\nvertex 0 1 0\n").encode(),
            ": facet 1 has a vertex that is not three numbers: [['0', '0', '0'], ['1', 'zero', '0'], ['0', '1', '0']]",
        ),
        (ASCII_STL.format("vertex 0 0 0\nvertex 1 0 0\n").encode(), ": facet 1 has 2 vertices, not 3"),
        (b"solid of nothing\nendsolid\n", ": it has no triangles"),
        (bytes(84), ": it has no triangles"),
        (bytes(80) + struct.pack("<I", 9) + bytes(50), ": it is neither text nor as long as a binary STL"),
        (ASCII_STL.format("vertex 0 0 0\nvertex 1 nan 0\nvertex 0 1 0\n").encode(), "not a finite number"),
    ],
)
def test_broken_stl_is_told_in_one_line(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "model.stl"
    path.write_bytes(content)
    with pytest.raises(InputError) as error:
        read_mesh(path)
    assert str(error.value).startswith(str(path))
    assert message in str(error.value)
    assert "\n" not in str(error.value)
