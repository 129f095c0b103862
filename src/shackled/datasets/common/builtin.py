"""Common objects that need no file, each with a suitable pose and look."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from ...scene._camera import Camera
from ...scene._effects import Background
from ...scene._look import stage
from ...scene._mesh import Mesh
from ...scene._object import Material, Object
from ...scene._scene import Scene
from ...scene._staging import painted
from .._pieces import Piece
from .._teapot import teapot
from . import shapes
from ._cornell_box import cornell_box

LICENCE = "MIT"
CORNELL = "the Cornell University Program of Computer Graphics, who measured it"

SMOOTH = Material("smooth", 0.25, 0.75, 0.5, 32)
GLAZE = Material("smooth", 0.3, 0.85, 0.6, 30)
FLAT = Material("flat", 0.3, 0.75, 0.25, 16)
UNLIT = Material("unlit")

NIGHT = Background((24, 26, 38), (70, 74, 98))
PAPER = Background((243, 236, 222), (203, 190, 170))
MIST = Background((222, 229, 236), (162, 176, 192))
BLACK = Background((0, 0, 0))

#: Gradients, and the axis of one that does not go upward.
FLAME, SUNSET = ("#e0457b", "#f6c244", (1, 1, 0)), ("#2ec4b6", "#ff9f1c", (1, 0, 0))
SEA, SHELL, WOOD = ("#2f6690", "#8fd3c8"), ("#d9735b", "#f7e3c9"), ("#a86b32", "#f0b860")

WIRES: dict[str, Any] = {"wireframe": True, "cull": False}


def pieces() -> list[Piece]:
    """Return all built-in pieces, the scenes of the paper first."""
    pot, ball = partial(teapot, 4), partial(shapes.icosphere, 1)
    return [
        _piece("teapot", "Utah teapot", pot, GLAZE, PAPER, "#c8553d", view=(12, 24), cull=True, margin=0.06),
        Piece("cornell-box", "common", "Cornell box", LICENCE, cornell_box, credit=CORNELL),
        _piece("wireframe-cube", "Cube, wireframe", shapes.cube, UNLIT, BLACK, "white", view=(28, 22), **WIRES),
        _piece("wireframe-icosphere", "Icosphere, wireframe", ball, UNLIT, BLACK, "#7fe0c8", view=(9, 20), **WIRES),
        Piece("first-render", "common", "The first render, two triangles", LICENCE, first_render),
        _piece("cube", "Cube, coloured by its corners", shapes.cube, UNLIT, NIGHT, view=(35, 30)),
        _piece("tetrahedron", "Tetrahedron", shapes.tetrahedron, FLAT, MIST, "#e4572e", view=(20, 24)),
        _piece("octahedron", "Octahedron", shapes.octahedron, FLAT, MIST, "#f3a712", view=(22, 18)),
        _piece("dodecahedron", "Dodecahedron", shapes.dodecahedron, FLAT, MIST, "#29a389", view=(20, 24)),
        _piece("icosahedron", "Icosahedron", shapes.icosahedron, FLAT, MIST, "#4d7ee0", view=(12, 20)),
        _piece("icosphere", "Icosphere", shapes.icosphere, FLAT, MIST, "#d9594c"),
        _piece("uv-sphere", "Sphere", shapes.sphere, SMOOTH, NIGHT, "#3f8fd2"),
        _piece("cylinder", "Cylinder", shapes.cylinder, SMOOTH, PAPER, "#2f9c95", view=(30, 28)),
        _piece("cone", "Cone", shapes.cone, SMOOTH, PAPER, "#e8842c", view=(30, 24)),
        _piece("torus", "Torus", shapes.torus, SMOOTH, MIST, "#d1495b", view=(30, 38)),
        _piece("torus-knot", "Torus knot", shapes.torus_knot, SMOOTH, NIGHT, FLAME, view=(0, 0)),
        _piece("spring", "Spring", shapes.spring, SMOOTH, MIST, "#8a94a6", view=(-50, 18)),
        _piece("moebius-strip", "Möbius strip", shapes.moebius_strip, SMOOTH, NIGHT, SUNSET, view=(-60, 42), cull=True),
        _piece("klein-bottle", "Klein bottle", shapes.klein_bottle, SMOOTH, PAPER, SEA, view=(25, 12), cull=True),
        _piece("superellipsoid", "Superellipsoid", shapes.superellipsoid, SMOOTH, MIST, "#7b5ea7", view=(32, 26)),
        _piece("seashell", "Seashell", shapes.seashell, SMOOTH, NIGHT, SHELL, view=(20, 14), cull=False),
        _piece("menger-sponge", "Menger sponge", shapes.menger_sponge, FLAT, NIGHT, WOOD, view=(28, 26)),
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


def _piece(
    name: str,
    title: str,
    mesh: Callable[[], Mesh],
    material: Material,
    background: Background,
    color: str | tuple[Any, ...] | None = None,
    view: tuple[float, float] = (30, 20),
    **look: Any,
) -> Piece:
    """Return the piece of a mesh. color: also what `shapes.shaded` takes; None for those of the mesh. view: azimuth and
    elevation. look: of `stage`.
    """
    chosen = {"margin": 0.12, "half_height": 0.3, "azimuth": view[0], "elevation": view[1], **look}

    def make() -> Scene:
        shown = mesh()
        if color is not None:
            shown = painted(shown, color) if isinstance(color, str) else shapes.shaded(shown, *color)
        return stage(shown, material=material, background=background, **chosen)

    return Piece(name, "common", title, LICENCE, make)
