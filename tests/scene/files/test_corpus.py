"""STL, PLY and OFF files as programs write them, right or not: all are one square, as far as they are read."""

from __future__ import annotations

import re
import struct
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mesh_files import read_with_notes, refusal
from shackled.scene import read_mesh
from shackled.scene._mesh import DEFAULT_COLOR

SQUARE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
TRIANGLES = ((0, 1, 2), (0, 2, 3))
GREY, RED, BLUE = (*DEFAULT_COLOR, 255), (255, 0, 0, 255), (0, 0, 255, 255)
PALE = (255, 0, 0, 128)
NAN = float("nan")


def text_stl(end: str = "") -> bytes:
    facets = (
        "facet normal 0 0 1\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*SQUARE[k]) for k in face)
        + "endloop\nendfacet\n"
        for face in TRIANGLES
    )
    return f"solid a\n{''.join(facets)}endsolid a\n{end}".encode()


def binary_stl(count: int = 2, header: bytes = b"", attributes: tuple[int, int] = (0, 0), more: bytes = b"") -> bytes:
    content = header.ljust(80, b"\0") + struct.pack("<I", count)
    for face, attribute in zip(TRIANGLES, attributes, strict=True):
        content += struct.pack("<12fH", 0, 0, 1, *(x for k in face for x in SQUARE[k]), attribute)
    return content + more


def ply(
    vertex: str = "", behind: str = "", face: str = "", of_face: str = "", more: str = "", comment: str = ""
) -> bytes:
    properties = "".join(f"property float {axis}\n" for axis in "xyz") + vertex
    rows = "".join(f"{x} {y} {z} {behind.format(x=x, y=y)}\n" for x, y, z in SQUARE)
    return (
        f"ply\nformat ascii 1.0\n{comment}element vertex 4\n{properties}element face 1\n"
        f"property list uchar int vertex_indices\n{face}{more and 'element edge 1'}\n"
        f"{more and 'property int a'}\nend_header\n{rows}4 0 1 2 3 {of_face}\n{more}"
    ).encode()


def floats(*names: str) -> str:
    return "".join(f"property float {name}\n" for name in names)


def off(header: str = "OFF", behind: str = "", of_face: str = "", more: str = "") -> bytes:
    rows = "".join(f"{x} {y} {z} {behind}\n" for x, y, z in SQUARE)
    return f"{header}\n4 1 0\n{rows}4 0 1 2 3 {of_face}\n{more}".encode()


BYTES = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue", "alpha"))
STRIP = ply().replace(b"element face", b"element tristrips").replace(b"4 0 1 2 3", b"5 0 1 3 2 -1")
TEXTURE = "comment TextureFile blue.png\n"
BEHIND = "what is behind its facets is left out: {}"
SAYS = "its header says {}; there are 2, which are read"

#: By the name of the file: its content, the colours of its two triangles, and the notes.
FILES: dict[str, tuple[bytes, tuple[tuple[int, ...], ...], list[str]]] = {
    "text.stl": (text_stl(), (GREY, GREY), []),
    "nul.stl": (text_stl("\0\0"), (GREY, GREY), []),
    "crlf.stl": (text_stl().replace(b"\n", b"\r\n"), (GREY, GREY), []),
    "nan-facet.stl": (
        text_stl(text_stl().decode().replace("1 1 0", "1 nan 0")),
        (GREY, GREY),
        ["facets with coordinates that are not finite numbers are left out: 2"],
    ),
    "solid.stl": (binary_stl(header=b"solid"), (GREY, GREY), []),
    "count-0.stl": (binary_stl(0), (GREY, GREY), [SAYS.format("0 facets")]),
    "count-1.stl": (binary_stl(1), (GREY, GREY), [SAYS.format("1 facet")]),
    "count-max.stl": (binary_stl(2**32 - 1), (GREY, GREY), [SAYS.format("4,294,967,295 facets")]),
    "cut.stl": (binary_stl()[:-2], (GREY, GREY), []),
    "line-end.stl": (binary_stl(more=b"\r\n"), (GREY, GREY), [BEHIND.format("2 bytes")]),
    "viscam.stl": (binary_stl(attributes=(0xFC00, 0x801F)), (RED, BLUE), []),
    "magics.stl": (binary_stl(header=b"COLOR=\0\0\xff\xff", attributes=(0x001F, 0x8000)), (RED, BLUE), []),
    "plain.ply": (ply(), (GREY, GREY), []),
    "alpha.ply": (ply(BYTES, "255 0 0 128"), (PALE, PALE), []),
    "of-face.ply": (ply(face=BYTES, of_face="0 0 255 255"), (BLUE, BLUE), []),
    "strip.ply": (STRIP, (GREY, GREY), []),
    "nan-normals.ply": (
        ply(floats("nx", "ny", "nz"), "nan nan nan"),
        (GREY, GREY),
        ["normals that are not finite numbers are computed: 4"],
    ),
    "texture.ply": (ply(floats("s", "t"), "{x} {y}", comment=TEXTURE), (BLUE, BLUE), []),
    "corners.ply": (
        ply(face="property list uchar float texcoord\n", of_face="8 0 0 1 0 1 1 0 1", comment=TEXTURE),
        (BLUE, BLUE),
        [],
    ),
    "lost-texture.ply": (
        ply(comment=TEXTURE.replace("blue", "lost")),
        (GREY, GREY),
        ["a texture is left out: {folder}/lost.png does not exist"],
    ),
    "more.ply": (
        ply(floats("confidence"), "1", more="7\n"),
        (GREY, GREY),
        ["of its elements are left out: edge (1), confidence of vertex"],
    ),
    "plain.off": (off(), (GREY, GREY), []),
    "mesh-lab.off": (off("NCOFF", "255 0 0 255 0 0 1"), (RED, RED), []),
    "geomview.off": (off("CNOFF", "0 0 1 1.0 0 0 1.0"), (RED, RED), []),
    "alpha.off": (off("COFF", "255 0 0 128"), (PALE, PALE), []),
    "alpha-of-face.off": (off(of_face="1.0 0 0 0.5"), (PALE, PALE), []),
    "st.off": (
        off("STOFF", "0.5 0.5"),
        (GREY, GREY),
        ["its texture coordinates are left out, for an OFF file names no texture"],
    ),
    "index.off": (off(of_face="7"), (GREY, GREY), ["numbers behind faces that are no colours are left out: 1"]),
    "edges.off": (off(more="0 1\n"), (GREY, GREY), ["the lines behind its faces are left out: 1"]),
}  # fmt: skip


@pytest.mark.parametrize("name", FILES)
def test_files_as_people_have_them(tmp_path: Path, name: str) -> None:
    content, colors, notes = FILES[name]
    Image.new("RGB", (2, 2), BLUE[:3]).save(tmp_path / "blue.png")
    mesh, told = read_with_notes(tmp_path / name, content)
    assert told == [note.replace("{folder}", str(tmp_path)) for note in notes]
    a, b, c = np.moveaxis(mesh.positions[mesh.faces], 1, 0)
    assert (np.cross(b - a, c - a) / 2).tolist() == [[0, 0, 0.5]] * 2
    assert sorted(map(tuple, np.unique(mesh.positions, axis=0).tolist())) == sorted(SQUARE)
    assert mesh.rgba[mesh.faces].tolist() == [[list(color)] * 3 for color in colors]


#: An arrow head, from a corner that does not see all of it.
ARROW = "0 2 0\n-1 0 0\n0 1 0\n1 0 0\n"
CONCAVE = {
    "obj": re.sub("(?m)^", "v ", ARROW.strip()) + "\nf 2 3 4 1\n",
    "ply": ply().decode().partition("end_header")[0] + f"end_header\n{ARROW}4 1 2 3 0\n",
    "off": f"OFF\n4 1 0\n{ARROW}4 1 2 3 0\n",
}


@pytest.mark.parametrize("extension", CONCAVE)
def test_a_concave_polygon_is_filled_as_it_is(tmp_path: Path, extension: str) -> None:
    path = tmp_path / f"arrow.{extension}"
    path.write_text(CONCAVE[extension])
    mesh = read_mesh(path)
    a, b, c = np.moveaxis(mesh.positions[mesh.faces], 1, 0)
    assert sorted((np.cross(b - a, c - a)[:, 2] / 2).tolist()) == [0.5, 0.5]


@pytest.mark.parametrize("size", [1e-300, 1e-9, 1, 1e9, 1.5e308])
def test_areas_of_any_size(tmp_path: Path, size: float) -> None:
    """A line is one though its points are rounded, and a narrow triangle has an area."""
    path = tmp_path / "a.obj"
    points = (np.outer([0, 1, 1 / 3], [1, 1 / 7, 0.3]) * size).astype(np.float64)
    rows = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points.tolist())
    assert refusal(path, rows + "f 1 2 3\n") == "there is nothing to see: its 1 triangle has no area"
    path.write_text(f"v {-size!r} 0 0\nv {size!r} 0 0\nv 0 {size * 1e-5!r} 0\nf 1 2 3\n")
    assert read_mesh(path).triangles == 1
