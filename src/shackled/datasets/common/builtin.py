"""Common objects that need no file, each with a suitable pose and look."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...scene import Background, Camera, Material, Mesh, Object, Scene, painted, stage
from .. import Piece, teapot
from . import shapes
from ._cornell_box import cornell_box

LICENCE = "MIT"

SMOOTH = Material("smooth", 0.25, 0.75, 0.5, 32)
GLAZE = Material("smooth", 0.3, 0.85, 0.6, 30)
FLAT = Material("flat", 0.3, 0.75, 0.25, 16)
UNLIT = Material("unlit")

NIGHT = Background((24, 26, 38), (70, 74, 98))
PAPER = Background((243, 236, 222), (203, 190, 170))
MIST = Background((222, 229, 236), (162, 176, 192))
BLACK = Background((0, 0, 0))


def pieces() -> list[Piece]:
    """Return all built-in pieces, the scenes of the paper first."""
    return [
        _piece(
            "teapot",
            "Utah teapot",
            _posed(_teapot, GLAZE, PAPER, color="#c8553d", azimuth=12, elevation=24, cull=True, margin=0.06),
        ),
        Piece(
            "cornell-box",
            "common",
            "Cornell box",
            LICENCE,
            cornell_box,
            credit="the Cornell University Program of Computer Graphics, who measured it",
        ),
        _piece("wireframe-cube", "Cube, wireframe", _wires(_white(shapes.cube), azimuth=28, elevation=22)),
        _piece("wireframe-icosphere", "Icosphere, wireframe", _wires(lambda: _icosphere("#7fe0c8", 1), azimuth=9)),
        _piece("first-render", "The first render, two triangles", first_render),
        _piece("cube", "Cube, coloured by its corners", _posed(shapes.cube, UNLIT, NIGHT, azimuth=35, elevation=30)),
        _piece("tetrahedron", "Tetrahedron", _solid(shapes.tetrahedron, "#e4572e", azimuth=20, elevation=24)),
        _piece("octahedron", "Octahedron", _solid(shapes.octahedron, "#f3a712", azimuth=22, elevation=18)),
        _piece("dodecahedron", "Dodecahedron", _solid(shapes.dodecahedron, "#29a389", azimuth=20, elevation=24)),
        _piece("icosahedron", "Icosahedron", _solid(shapes.icosahedron, "#4d7ee0", azimuth=12, elevation=20)),
        _piece("icosphere", "Icosphere", _posed(lambda: _icosphere("#d9594c", 2), FLAT, MIST)),
        _piece("uv-sphere", "Sphere", _posed(shapes.sphere, SMOOTH, NIGHT, color="#3f8fd2")),
        _piece("cylinder", "Cylinder", _posed(shapes.cylinder, SMOOTH, PAPER, color="#2f9c95", elevation=28)),
        _piece("cone", "Cone", _posed(shapes.cone, SMOOTH, PAPER, color="#e8842c", elevation=24)),
        _piece("torus", "Torus", _posed(shapes.torus, SMOOTH, MIST, color="#d1495b", elevation=38)),
        _piece("torus-knot", "Torus knot", _posed(_knot, SMOOTH, NIGHT, azimuth=0, elevation=0)),
        _piece("spring", "Spring", _posed(shapes.spring, SMOOTH, MIST, color="#8a94a6", azimuth=-50, elevation=18)),
        _piece("moebius-strip", "Möbius strip", _posed(_moebius, SMOOTH, NIGHT, azimuth=-60, elevation=42, cull=True)),
        _piece("klein-bottle", "Klein bottle", _posed(_klein, SMOOTH, PAPER, azimuth=25, elevation=12, cull=True)),
        _piece("superellipsoid", "Superellipsoid", _posed(_superellipsoid, SMOOTH, MIST, azimuth=32, elevation=26)),
        _piece("seashell", "Seashell", _posed(_seashell, SMOOTH, NIGHT, azimuth=20, elevation=14, cull=False)),
        _piece("menger-sponge", "Menger sponge", _posed(_menger, FLAT, NIGHT, azimuth=28, elevation=26)),
    ]


def first_render() -> Scene:
    """Return the first picture of the contracts of 2021: the two triangles in the appendix of their paper."""
    points = [(-1, 0, 0), (-1, 2, 0), (0, 2, 0), (1, 0, 5), (1, -2, 5), (0, -2, 5)]
    colors = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0), (0, 255, 255), (255, 0, 255)]
    return Scene(
        [Object(Mesh(points, [(0, 1, 2), (3, 4, 5)], colors), material=UNLIT, cull=False)],
        camera=Camera((0, 0, 10), (0, 0, 0), projection="orthographic", half_height=3),
        background=BLACK,
    )


def _piece(name: str, title: str, make: Callable[[], Scene]) -> Piece:
    return Piece(name, "common", title, LICENCE, make)


def _posed(mesh: Callable[[], Mesh], material: Material, background: Background, **look: Any) -> Callable[[], Scene]:
    chosen = {"margin": 0.12, "half_height": 0.3, **look}
    return lambda: stage(mesh(), material=material, background=background, **chosen)


def _solid(mesh: Callable[[], Mesh], color: str, **look: Any) -> Callable[[], Scene]:
    return _posed(mesh, FLAT, MIST, color=color, **look)


def _wires(mesh: Callable[[], Mesh], **look: Any) -> Callable[[], Scene]:
    return _posed(mesh, UNLIT, BLACK, wireframe=True, cull=False, **look)


def _white(mesh: Callable[[], Mesh]) -> Callable[[], Mesh]:
    return lambda: painted(mesh(), "#ffffff")


def _teapot() -> Mesh:
    return teapot(4)


def _icosphere(color: str, halvings: int) -> Mesh:
    return painted(shapes.icosphere(halvings), color)


def _knot() -> Mesh:
    return shapes.shaded(shapes.torus_knot(), "#e0457b", "#f6c244", axis=(1, 1, 0))


def _moebius() -> Mesh:
    return shapes.shaded(shapes.moebius_strip(), "#2ec4b6", "#ff9f1c", axis=(1, 0, 0))


def _klein() -> Mesh:
    return shapes.shaded(shapes.klein_bottle(), "#2f6690", "#8fd3c8")


def _superellipsoid() -> Mesh:
    return painted(shapes.superellipsoid(), "#7b5ea7")


def _seashell() -> Mesh:
    return shapes.shaded(shapes.seashell(), "#d9735b", "#f7e3c9")


def _menger() -> Mesh:
    return shapes.shaded(shapes.menger_sponge(2), "#a86b32", "#f0b860")
