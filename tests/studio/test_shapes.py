"""The shapes and letters with which contracts build meshes."""

from __future__ import annotations

import math
import string
from typing import Any

import numpy as np
import pytest
from tools import lettering
from tools.ledger import call_data

from compiler import needs_compiler
from probes import Probe
from shackled import Mesh, RenderError
from shackled.scene._mesh import vertex_normals
from shackled.scene._packed import NORMAL_UNIT, unpack
from shackled.scene._staging import is_closed

CENTER = np.array([10, 20, 30])
SPHERE, CYLINDER, CONE, RING = range(4)
MANY = 1 << 200

pytestmark = needs_compiler


class ShapesProbe(Probe):
    """The contract that makes shapes."""

    def round(self, which: int, radius: int, size: int, segments: int, rings: int) -> tuple[Mesh, Mesh]:
        """A shape without normals, and with them."""
        flat, smooth = self.ask(["bytes", "bytes"], ROUND, which, radius, size, segments, rings)
        return unpack(flat), unpack(smooth)


@pytest.fixture(scope="module")
def probe() -> ShapesProbe:
    return ShapesProbe("tests/studio/ShapesProbe.sol")


def extent(mesh: Mesh) -> list[list[int]]:
    """The lowest and the highest coordinates, from the middle."""
    return [(p - CENTER).astype(int).tolist() for p in (mesh.positions.min(axis=0), mesh.positions.max(axis=0))]


def said_of(error: str, *values: int) -> set[str]:
    """What is said of an error of a library and its values: its data, or its text if an artifact has such an error."""
    decoded = {f"{error.partition('(')[0]}({label}={values[0]})" for label in ("count", "size") if values}
    return {f"error 0x{call_data(error, *values).hex()}", *decoded}


ROUND, STAR = "round(uint256,int256,int256,uint256,uint256)", "star(int256,int256,uint256)"
BOX, TEXT = "box(int256[6])", "text(string,int256,int256)"


@pytest.mark.parametrize("swapped", range(8))
def test_boxes_have_any_two_opposite_corners(probe: ShapesProbe, swapped: int) -> None:
    ends = [(-10, 40), (-20, 50), (-30, 60)]
    ends = [(b, a) if swapped >> axis & 1 else (a, b) for axis, (a, b) in enumerate(ends)]
    mesh = probe.mesh(BOX, [*(e[0] for e in ends), *(e[1] for e in ends)])
    assert is_closed(mesh)
    assert (len(mesh.positions), len(mesh.faces)) == (8, 12)
    assert extent(mesh) == [[-20, -40, -60], [30, 30, 30]]
    assert (mesh.colors == (0x10, 0x20, 0x30)).all()


def test_a_box_without_thickness_is_a_sheet_with_two_sides(probe: ShapesProbe) -> None:
    mesh = probe.mesh(BOX, [0, 5, 0, 10, 5, 10])
    a, b, c = (mesh.positions[mesh.faces[:, corner]] for corner in range(3))
    areas = np.cross(b - a, c - a) / 2
    assert areas.sum(axis=0).tolist() == [0, 0, 0]
    assert np.abs(areas).sum(axis=0).tolist() == [0, 200, 0]


@pytest.mark.parametrize(
    ("arguments", "counts", "box"),
    [
        ((SPHERE, 100, 0, 16, 12), (178, 352), [[-100] * 3, [100] * 3]),
        ((SPHERE, 100, 0, 3, 2), (5, 6), [[-87, -100, -50], [87, 100, 100]]),
        ((CYLINDER, 80, 160, 8, 0), (34, 32), [[-80, 0, -80], [80, 160, 80]]),
        ((CYLINDER, 80, -160, 8, 0), (34, 32), [[-80, -160, -80], [80, 0, 80]]),
        ((CONE, 90, 180, 12, 0), (26, 24), [[-90, 0, -90], [90, 180, 90]]),
        ((CONE, 90, -180, 12, 0), (26, 24), [[-90, -180, -90], [90, 0, 90]]),
        ((RING, 100, 30, 12, 8), (96, 192), [[-130, -30, -130], [130, 30, 130]]),
        ((RING, 40, 40, 12, 8), (96, 192), [[-80, -40, -80], [80, 40, 80]]),
    ],
)
def test_round_shapes(
    probe: ShapesProbe, arguments: tuple[int, int, int, int, int], counts: tuple[int, int], box: list[list[int]]
) -> None:
    """They are closed, look outward, and have the vertices and the normals that they should."""
    flat, smooth = probe.round(*arguments)
    if arguments[:3] != (RING, 40, 40):
        assert (len(flat.positions), len(flat.faces)) == counts
    assert is_closed(flat)
    assert extent(flat) == box
    assert flat.faces.tolist() == smooth.faces.tolist()
    assert (flat.positions == smooth.positions).all()
    assert smooth.normals is not None
    # whole numbers, and half a step that `unpack` may add
    assert np.abs(smooth.normals - vertex_normals(flat.positions, flat.faces) * NORMAL_UNIT).max() < 1.5


def test_spheres_are_round_and_cylinders_have_sharp_edges(probe: ShapesProbe) -> None:
    _, mesh = probe.round(SPHERE, 1000, 0, 24, 16)
    outward = (mesh.positions - CENTER) / 1000
    assert np.abs(np.linalg.norm(outward, axis=1) - 1).max() < 1e-3
    assert mesh.normals is not None
    assert ((mesh.normals * outward).sum(axis=1) / NORMAL_UNIT > math.cos(math.radians(2.5))).all()
    _, mesh = probe.round(CYLINDER, 80, 160, 16, 0)
    assert mesh.normals is not None
    upright = np.abs(mesh.normals[:, 1]) / NORMAL_UNIT
    assert ((upright < 0.01) | (upright > 0.99)).all()
    assert (upright < 0.01).sum() == 32


DISCS = ("0,0 50,0", "50,0 0,0")
LATHE = "lathe(string,uint256)"


@pytest.mark.parametrize(
    ("profile", "closed"),
    [
        ("0,0 50,10 20,80 0,90", True),
        ("0,90 20,80 50,10 0,0", True),
        ("0,0 50,0 50,0 50,100 40,100 40,10 0,10", True),
        ("20,-5 30,-5 30,5 20,5 20,-5", True),
        ("20,-5 20,5 30,5 30,-5 20,-5", True),
        ("30,0 50,100", False),
        ("50,100 30,0", False),
        *((disc, False) for disc in DISCS),
    ],
)
def test_lathes(probe: ShapesProbe, profile: str, closed: bool) -> None:
    """Whichever way the profile goes, the outside is outside."""
    mesh = probe.mesh(LATHE, profile, 12)
    a, b, c = (mesh.positions[mesh.faces[:, corner]] - CENTER for corner in range(3))
    assert is_closed(mesh) == closed
    if profile in DISCS:
        assert (np.cross(b - a, c - a)[:, 1] > 0).all(), "a disc faces up"
    elif not closed:
        assert ((np.cross(b - a, c - a) * (a + b + c))[:, [0, 2]].sum(axis=1) > 0).all()


EXTRUSION = "extrusion(string,int256,int256)"
#: A comb, a spiral, and a frame, the way to whose hole is a line there and back.
OUTLINES = {
    "comb": "0,0 90,0 90,50 80,50 80,10 50,10 50,50 40,50 40,10 10,10 10,50 0,50",
    "spiral": "0,0 100,0 100,100 20,100 20,40 60,40 60,60 40,60 40,80 80,80 80,20 0,20",
    "frame": "0,0 90,0 90,90 0,90 0,0 20,20 20,70 70,70 70,20 20,20",
    "line": "0,0 1,0 2,0 3,0 0,3 0,2 0,1",
}


@pytest.mark.parametrize("name", OUTLINES)
@pytest.mark.parametrize("backward", [False, True])
def test_extrusions(probe: ShapesProbe, name: str, backward: bool) -> None:
    points = OUTLINES[name].split()
    x, y = np.array([point.split(",") for point in points], int).T
    area = abs(int((x * np.roll(y, -1) - y * np.roll(x, -1)).sum())) / 2
    mesh = probe.mesh(EXTRUSION, " ".join(points[::-1] if backward else points), *((5, -5) if backward else (-5, 5)))
    assert is_closed(mesh)
    assert (len(mesh.positions), len(mesh.faces)) == (4 * len(points), 4 * len(points) - 4)
    a, b, c = (mesh.positions[mesh.faces[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a) / 2
    front = (a[:, 2] == 5) & (b[:, 2] == 5) & (c[:, 2] == 5)
    assert normals[front].sum(axis=0).tolist() == [0, 0, area]
    assert (normals[front][:, 2] > 0).all()


def test_outlines_that_cross_themselves_are_refused(probe: ShapesProbe) -> None:
    def side(a: Any, b: Any, p: Any) -> int:
        return int(np.sign((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])))

    random, crossed, simple = np.random.default_rng(7), 0, 0
    for _ in range(150):
        points = random.integers(0, 50, (random.integers(4, 8), 2)).tolist()
        edges = list(zip(points, points[1:] + points[:1], strict=True))
        crosses = any(
            side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0 for a, b in edges for c, d in edges
        )
        crossed += crosses
        text = " ".join(f"{x},{y}" for x, y in points)
        if crosses:
            with pytest.raises(RenderError):
                probe.mesh(EXTRUSION, text, 0, 1)
        elif all(side(a, b, p) for a, b in edges for p in points if p not in (a, b)):
            assert is_closed(probe.mesh(EXTRUSION, text, 0, 1))
            simple += 1
    assert crossed > 50
    assert simple > 20


def test_stars_and_polygons(probe: ShapesProbe) -> None:
    star, square = probe.ask(["int256[2][]", "int256[2][]"], STAR, 100, 50, 4)
    assert square == ((0, 100), (-100, 0), (0, -100), (100, 0))
    assert star[::2] == square
    assert star[1] == (-35, 35)


@pytest.mark.parametrize(
    ("signature", "values", "error", "said"),
    [
        (ROUND, (SPHERE, 0, 0, 9, 9), "SizeOutOfRange(int256)", (0,)),
        (ROUND, (SPHERE, 9, 0, 2, 9), "SegmentsOutOfRange(uint256,uint256)", (2, 3)),
        (ROUND, (SPHERE, 9, 0, MANY, 9), "SegmentsOutOfRange(uint256,uint256)", (MANY, 3)),
        (ROUND, (SPHERE, 9, 0, 9, 1), "SegmentsOutOfRange(uint256,uint256)", (1, 2)),
        (ROUND, (SPHERE, 9, 0, 9, MANY), "SegmentsOutOfRange(uint256,uint256)", (MANY, 2)),
        (ROUND, (SPHERE, 9, 0, 300, 300), "TooManyVertices(uint256)", (65535,)),
        (ROUND, (CYLINDER, 9, 0, 9, 0), "SizeOutOfRange(int256)", (0,)),
        (ROUND, (CONE, MANY, 9, 9, 0), "SizeOutOfRange(int256)", (MANY,)),
        (ROUND, (RING, 9, 10, 9, 9), "SizeOutOfRange(int256)", (9,)),
        (ROUND, (RING, 9, 5, 9, MANY), "SegmentsOutOfRange(uint256,uint256)", (MANY, 3)),
        (LATHE, ("0,0", 9), "TooFewPoints(uint256,uint256)", (1, 2)),
        (LATHE, ("0,0 -1,0", 9), "SizeOutOfRange(int256)", (-1,)),
        (LATHE, ("0,0 1;0", 9), "NotPoints(uint256)", (5,)),
        (LATHE, ("0,0  1,0", 9), "NotPoints(uint256)", (4,)),
        (LATHE, ("0,0 1,", 9), "NotPoints(uint256)", (6,)),
        (LATHE, ("", 9), "NotPoints(uint256)", (0,)),
        (LATHE, ("0,0 65536,0", 9), "NotPoints(uint256)", (4,)),
        (EXTRUSION, ("0,0 1,0", 0, 1), "TooFewPoints(uint256,uint256)", (2, 3)),
        (EXTRUSION, ("0,0 1,0 1,0", 0, 1), "TooFewPoints(uint256,uint256)", (2, 3)),
        (EXTRUSION, ("0,0 1,0 2,0", 0, 1), "NotAnOutline()", ()),
        (EXTRUSION, ("0,0 90,90 90,0 0,60", 0, 1), "NotAnOutline()", ()),
        (STAR, (9, 9, 2), "SegmentsOutOfRange(uint256,uint256)", (2, 3)),
        (STAR, (9, 9, MANY), "SegmentsOutOfRange(uint256,uint256)", (MANY, 2)),
        (TEXT, ("A\x7f", 9, 9), "NoSuchLetter(uint256,uint256)", (1, 127)),
        (TEXT, ("é", 9, 9), "NoSuchLetter(uint256,uint256)", (0, 0xC3)),
        (TEXT, ("A", 0, 9), "SizeOutOfRange(int256)", (0,)),
    ],
)
def test_what_is_refused(
    probe: ShapesProbe, signature: str, values: tuple[object, ...], error: str, said: tuple[int, ...]
) -> None:
    with pytest.raises(RenderError) as refused:
        probe.ask([], signature, *values)
    assert str(refused.value).removeprefix("the contract refused: ") in said_of(error, *said)


def lettered(probe: ShapesProbe, text: str, height: int = 112) -> tuple[Mesh, int]:
    packed, width = probe.ask(["bytes", "int256"], TEXT, text, height, 20)
    return unpack(packed), width


def test_every_stroke_of_every_letter_is_closed(probe: ShapesProbe) -> None:
    letters = "".join(sorted(set(string.printable) - set(string.whitespace)))
    mesh, _ = lettered(probe, letters)
    counts = [[len(set(s)) if s[0] == s[-1] else len(s) for s in lettering.strokes(each)] for each in letters]
    dots = sum(len(s) == 1 for each in letters for s in lettering.strokes(each))
    assert len(mesh.positions) == 4 * (sum(map(sum, counts)) + dots)
    begin = 0
    for each in letters:
        for stroke in lettering.strokes(each):
            vertices = 4 * (2 if len(stroke) == 1 else len(stroke) - (len(stroke) > 1 and stroke[0] == stroke[-1]))
            own = mesh.faces[(mesh.faces[:, 0] >= begin) & (mesh.faces[:, 0] < begin + vertices)]
            assert is_closed(Mesh(mesh.positions, own)), each
            begin += vertices
    assert begin == len(mesh.positions)


def test_text_stands_where_it_should(probe: ShapesProbe) -> None:
    """Capitals have the height that is given, lines are below each other, and the width is what it is said to be."""
    mesh, width = lettered(probe, "HE")
    assert extent(mesh) == [[0, 0, 0], [width, 112, 20]]
    two, wider = lettered(probe, "H E H\nE")
    assert extent(two)[0] == [0, -179, 0]
    assert extent(two)[1] == [wider, 112, 20]
    assert probe.ask(["bytes", "int256"], TEXT, " \n", 112, 20) == (bytes(5), 0)
