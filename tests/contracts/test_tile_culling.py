"""Faces that a tile does not show are left out before the engine is called; pixels and counts know nothing of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from attrs import evolve

from made_scenes import flat, teapot_scene
from picture import read
from pictures import call, call_data, chain, covered, draw, dynamic
from shackled import Background, Camera, Material, Mesh, Object, RenderError, Scene
from shackled.image import decode_bmp
from shackled.parallel._tiles import grid
from shackled.scene._codec import Rectangle
from shackled.scene._in_range import in_range

SIDE, ACROSS = 80, 4


def ready(scene: Scene, **changes: Any) -> Scene:
    """With whole coordinates, and a near plane."""
    return in_range(evolve(scene, width=SIDE, height=SIDE, **changes))


def objects(scene: Scene, **changes: Any) -> Scene:
    return evolve(scene, objects=[evolve(o, **changes) for o in scene.objects])


def inside(scene: Scene) -> Scene:
    """The eye in the middle of the teapot: faces on all sides of it, behind it, and across the near plane."""
    middle = scene.objects[0].mesh.positions.mean(axis=0) + np.asarray(scene.objects[0].position)
    camera = evolve(scene.camera, eye=np.add(middle, (0.1, 0.2, 0.3)), target=np.add(middle, (5, 1, -2)), near=0.01)
    return objects(evolve(scene, camera=camera), cull=False)


def through(scene: Scene) -> Scene:
    """Very near, so that most vertices have to be clipped."""
    return evolve(scene, camera=evolve(scene.camera, half_height=scene.camera.half_height / 60))


def above(scene: Scene) -> Scene:
    return evolve(scene, camera=Camera(projection="orthographic", half_height=2.0, eye=(0, 6, 0.01), target=(0, 0, 0)))


SCENES: dict[str, Callable[[], Scene]] = {
    "smooth": lambda: ready(teapot_scene(1)),
    "wires": lambda: ready(objects(teapot_scene(1), wireframe=True, cull=False)),
    "glass, inverted": lambda: ready(objects(flat(teapot_scene(4)), opacity=0.5, cull=False), invert=True),
    "from inside": lambda: ready(inside(flat(teapot_scene(1)))),
    "magnified": lambda: ready(through(flat(teapot_scene(1)))),
    "orthographic": lambda: ready(above(teapot_scene(1))),
}


def tiles() -> list[Rectangle]:
    return list(grid(SIDE, SIDE, SIDE // ACROSS, SIDE // ACROSS))


@pytest.mark.parametrize("name", SCENES)
def test_tiles_are_parts_and_their_counts_are_right(name: str) -> None:
    scene = SCENES[name]()
    whole = draw(scene)
    assert len(np.unique(whole.reshape(-1, 3), axis=0)) > 1
    shown = covered(evolve(scene, background=Background("black"), invert=False))
    sums = np.zeros(2, int)
    for tile in [Rectangle(0, 0, SIDE, SIDE), *tiles()]:
        output = call("renderTileCounted", scene, tile).output
        pixels = decode_bmp(dynamic(output), tile.width, tile.height)
        assert (pixels == whole[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]).all(), tile
        found, lit = (int.from_bytes(output[at : at + 32], "big") for at in (32, 64))
        surely, maybe = triangles_of(scene, tile)
        assert surely <= found <= surely + maybe, tile
        sums += surely, maybe
        assert lit == shown[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width].sum(), tile
    assert name in NEAR or sums[0] > 3 * sums[1]


#: Scenes of which the near plane clips many faces.
NEAR = ("from inside", "magnified")


def triangles_of(scene: Scene, tile: Rectangle) -> tuple[int, int]:
    """How many faces a tile counts by float64, and how many more it may: those that are nearly beyond an edge of it,
    nearly seen edge-on, or that the near plane clips.
    """
    world = read(call_data("render", scene))
    surely = maybe = 0
    low = np.array([tile.x, tile.y])
    high = low + np.array([tile.width, tile.height])
    for solid in world.objects:
        corners = world.camera.seen(solid.points[solid.faces])
        near = corners[..., 2] < world.camera.near
        with np.errstate(all="ignore"):
            a, b, c = np.moveaxis(world.camera.project(corners), 1, 0)
            area = (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1]) - (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1])
            inside = np.minimum(np.maximum.reduce([a, b, c]) - low, high - np.minimum.reduce([a, b, c])).min(axis=1)
        facing = area if solid.culls else np.abs(area)
        clipped = near.any(axis=1)
        counts = ~clipped & (facing > 0.1) & (inside > 0.6)
        surely += int(counts.sum())
        maybe += int((~near.all(axis=1) & ~counts & (clipped | ((facing > -0.1) & (inside > -0.6)))).sum())
    return surely, maybe


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("rows", [2, 29, 90])
def test_counts_of_strips_that_share_a_row(name: str, rows: int) -> None:
    """Without those of the shared rows they are the counts of the whole."""
    scene = SCENES[name]()
    total = np.zeros(2, int)
    for top in range(0, SIDE - 1, rows - 1):
        total += chain().count(scene, Rectangle(0, top, SIDE, min(rows, SIDE - top)))
        total -= chain().count(scene, Rectangle(0, top, SIDE, 1)) if top else (0, 0)
    assert tuple(total) == chain().count(scene)


def moved(scene: Scene, *places: tuple[float, float, float]) -> Scene:
    """The first object, at other places too."""
    (thing, *_) = scene.objects
    return evolve(scene, objects=[evolve(thing, position=thing.position + place) for place in places])


def word(data: bytes, position: int) -> int:
    return int.from_bytes(data[position : position + 32], "big")


#: Words of a scene, and the bytes of a call before it.
OBJECTS, EXTENSIONS, HEAD = 19, 20, 4 + 5 * 32


def object_positions(data: bytes) -> list[int]:
    """Where in a call of `renderTile` the objects are."""
    objects = HEAD + word(data, HEAD + 32 * OBJECTS)
    return [objects + 32 + word(data, objects + 32 * (1 + i)) for i in range(word(data, objects))]


def test_objects_that_share_the_bytes_of_a_mesh() -> None:
    scene = ready(moved(flat(teapot_scene(1)), (0, 0, 0), (1.5, -0.5, 0.3)))
    whole = draw(scene)
    for tile in tiles():
        data = call_data("renderTile", scene, tile)
        first, second = object_positions(data)
        shared = second + word(data, second) - first
        data = data[:first] + shared.to_bytes(32, "big") + data[first + 32 :]
        pixels = decode_bmp(dynamic(chain().call("Renderer", data).output), tile.width, tile.height)
        assert (pixels == whole[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]).all(), tile


def test_a_call_without_padding_at_its_end() -> None:
    """What is written behind the last face of the last mesh belongs to nobody."""
    first, second = moved(flat(teapot_scene(1)), (0, 0, 0), (0.5, 0, 0)).objects
    mesh = second.mesh
    for faces in (200, 203, 206):
        few = evolve(second, mesh=evolve(mesh, faces=mesh.faces[:faces]))
        scene = ready(evolve(flat(teapot_scene(1)), objects=[first, few]))
        whole = draw(scene)
        tile = Rectangle(20, 30, 20, 20)
        data = call_data("renderTile", scene, tile)
        # the extensions, which are empty, come last; they may be told to stand anywhere where there is a 0
        place = object_positions(data)[1]
        mesh_at = place + word(data, place)
        cut = data[: mesh_at + 32 + word(data, mesh_at)]
        zero = next(at for at in range(HEAD + 32 * (EXTENSIONS + 1), len(cut) - 32) if word(cut, at) == 0)
        extensions = HEAD + 32 * EXTENSIONS
        cut = cut[:extensions] + (zero - HEAD).to_bytes(32, "big") + cut[extensions + 32 :]
        pixels = decode_bmp(dynamic(chain().call("Renderer", cut).output), tile.width, tile.height)
        assert (pixels == whole[30:50, 20:40]).all()


def test_the_number_of_a_bad_object_counts_those_that_are_left_out() -> None:
    square = Mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    good = ready(moved(flat(teapot_scene(1)), (100, 0, 0)))
    # in_range() refuses what is wrong, so the number is changed in the call
    scene = evolve(good, objects=[*good.objects, Object(square, material=Material("unlit"))])
    tile = Rectangle(0, 0, 8, 8)
    data = call_data("renderTile", scene, tile)
    place = object_positions(data)[1]
    mesh_at = place + word(data, place)
    end = mesh_at + 32 + word(data, mesh_at)
    data = data[: end - 2] + b"\0\4" + data[end:]
    with pytest.raises(RenderError, match=r"IndexOutOfRange\(object=1, face=1, vertexCount=4\)"):
        chain().call("Renderer", data)


#: Gas of a tile that shows nothing: of a call with a background of 20 x 20 pixels, of a vertex, of a face.
CALL, VERTEX, FACE = 110_000, 230, 25


def test_a_tile_that_shows_nothing_costs_little() -> None:
    for name in ("smooth", "wires"):
        scene = SCENES[name]()
        mesh = scene.objects[0].mesh
        gas = call("renderTile", scene, Rectangle(0, 0, 20, 20)).gas
        assert gas <= CALL + VERTEX * len(mesh.positions) + FACE * len(mesh.faces), name
