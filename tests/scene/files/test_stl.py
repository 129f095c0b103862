import struct
from pathlib import Path

import numpy as np
import pytest

import mesh_files
from mesh_files import corner_colors, corner_positions
from shackled.scene._mesh import DEFAULT_COLOR, Mesh

POINTS = ((0, 0, 0), (1, 0, 0), (0, 1, 0))
ASCII_STL = "solid s\nfacet normal 0 0 1\nouter loop\n{}endloop\nendfacet\nendsolid s\n"
ONE = ASCII_STL.format("".join(f"vertex {x} {y} {z}\n" for x, y, z in POINTS))


def binary(declared: int, attributes: tuple[int, ...] = (0,), header: bytes = b"") -> bytes:
    """A triangle for each attribute, and what the header says of their number."""
    content = header.ljust(80, b"\0") + struct.pack("<I", declared)
    for number, attribute in enumerate(attributes):
        content += struct.pack("<12fH", 0, 0, 1, 0, 0, number, 1, 0, number, 0, 1, number, attribute)
    return content


def read_with_notes(folder: Path, content: bytes) -> tuple[Mesh, list[str]]:
    return mesh_files.read_with_notes(folder / "model.stl", content)


def test_equal_corners_are_one_vertex(tmp_path: Path) -> None:
    mesh, _ = read_with_notes(tmp_path, ONE.encode() + ONE.replace("vertex 1 0 0", "vertex 2 0 0").encode())
    assert (mesh.triangles, len(mesh.positions), mesh.normals) == (2, 4, None)


def test_line_ends_of_an_old_mac_and_names_of_any_words(tmp_path: Path) -> None:
    text = ONE.replace("vertex", "VERTEX").replace("solid s", "solid a vertex 1 2 3 endfacet").replace("\n", "\r")
    mesh, _ = read_with_notes(tmp_path, text.encode())
    assert corner_positions(mesh) == [[list(p) for p in POINTS]]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"\x00\x01garbage!" * 10, "it is not text, and with 100 bytes too short for a triangle of a binary STL file"),
        (binary(9)[:-3], "it is not text, and with 131 bytes too short for a triangle of a binary STL file"),
        (
            ONE.replace("1 0 0", "1 zero 0").encode(),
            "facet 1 has a vertex that is not three numbers: [['0', '0', '0'], ['1', 'zero', '0'], ['0', '1', '0']]",
        ),
        (ONE.replace("vertex 0 1 0\n", "").encode(), "facet 1 has 2 vertices, not 3"),
        (b"solid of nothing\nendsolid\n", "it has no triangles"),
        (ONE.replace("1 0 0", "1 nan 0").encode(), "none of its facets has finite coordinates"),
    ],
)
def test_broken_stl_is_told_in_one_line(tmp_path: Path, content: bytes, message: str) -> None:
    assert mesh_files.refusal(tmp_path / "model.stl", content) == message


SAYS = "its header says {}; there are 2, which are read"
TWO = (0, 0)


@pytest.mark.parametrize(
    ("content", "notes"),
    [
        (binary(2, TWO, b"solid made by a program"), []),
        (binary(2, TWO)[:-1], []),
        (binary(3, (0, 0, 0))[:-3], [SAYS.format("3 facets"), "what is behind its facets is left out: 47 bytes"]),
        (binary(2, TWO) + b"a thumbnail" * 9, ["what is behind its facets is left out: 99 bytes"]),
    ],
)
def test_wrong_lengths_of_binary_files(tmp_path: Path, content: bytes, notes: list[str]) -> None:
    """A count that is wrong, or other bytes behind the facets, is told; an attribute that is cut off is no loss."""
    mesh, told = read_with_notes(tmp_path, content)
    assert mesh.positions[mesh.faces].tolist() == [[[x, y, z] for x, y, _ in POINTS] for z in (0, 1)]
    assert told == notes


def test_facets_that_are_not_finite_are_left_out(tmp_path: Path) -> None:
    note = "facets with coordinates that are not finite numbers are left out: 1"
    content = bytearray(binary(2, (31 | 1 << 15, 31 << 10 | 1 << 15)))
    content[84 + 12 : 84 + 16] = struct.pack("<f", np.nan)
    mesh, told = read_with_notes(tmp_path, bytes(content))
    assert (corner_colors(mesh), told) == ([[[255, 0, 0]] * 3], [note])


# ---- colours ----

#: Five bits of each, from the lowest: 31, 16 and 1; the colours of the conventions are these, and the reverse.
BITS = 31 | 16 << 5 | 1 << 10
LOW, HIGH = [255, 132, 8], [8, 132, 255]
OWN = 1 << 15


def test_colors_of_viscam_and_solidview(tmp_path: Path) -> None:
    """Red is above; a facet whose highest bit is not set has no colour."""
    mesh, told = read_with_notes(tmp_path, binary(2, (BITS | OWN, 0)))
    assert (corner_colors(mesh), told) == ([[HIGH] * 3, [list(DEFAULT_COLOR)] * 3], [])
    assert mesh.opacities is None
    mesh, told = read_with_notes(tmp_path, binary(3, (BITS | OWN, 0, BITS)))
    assert corner_colors(mesh) == [[HIGH] * 3, *[[list(DEFAULT_COLOR)] * 3] * 2]
    assert told == ["attributes of facets that are no colours are left out: 1"]


@pytest.mark.parametrize(("alpha", "opacity"), [(255, 255), (102, 102), (0, 255)])
def test_colors_of_magics(tmp_path: Path, alpha: int, opacity: int) -> None:
    """Red is below; a facet whose highest bit is set has the colour of the header, with its alpha unless that is 0."""
    header = b"made by hand COLOR=" + bytes([1, 2, 3, alpha])
    mesh, told = read_with_notes(tmp_path, binary(2, (BITS, BITS | OWN), header))
    assert mesh.rgba[mesh.faces].tolist() == [[[*LOW, 255]] * 3, [[1, 2, 3, opacity]] * 3]
    assert told == []
    mesh, told = read_with_notes(tmp_path, binary(2, (OWN, OWN), header + b",MATERIAL=" + bytes(12)))
    assert (corner_colors(mesh), told) == ([[[1, 2, 3]] * 3] * 2, [])
    _, told = read_with_notes(tmp_path, binary(2, (OWN, OWN), header + b",MATERIAL=" + bytes([9] * 12)))
    assert told == ["the material of its header is left out; of STL files only colours are read"]


@pytest.mark.parametrize("alpha", [b" ", bytes([255])])
def test_the_color_of_a_header_without_colors_of_facets(tmp_path: Path, alpha: bytes) -> None:
    """As in the models of pybullet, whose program writes a space for the alpha and leaves all attributes 0."""
    header = b"COLOR=" + bytes([1, 2, 3]) + alpha + b"MATERIAL=" + 3 * (bytes([1, 2, 3]) + b" ")
    mesh, _ = read_with_notes(tmp_path, binary(2, (0, 0), header))
    assert mesh.rgba[mesh.faces].tolist() == [[[1, 2, 3, 255]] * 3] * 2
    mesh, _ = read_with_notes(tmp_path, binary(2, (0, OWN), header))
    assert corner_colors(mesh) == [[[0, 0, 0]] * 3, [[1, 2, 3]] * 3]


def test_a_header_that_is_cut_off_behind_the_word(tmp_path: Path) -> None:
    mesh, _ = read_with_notes(tmp_path, binary(1, (BITS | OWN,), b"COLOR=".rjust(77)))
    assert corner_colors(mesh) == [[HIGH] * 3]
