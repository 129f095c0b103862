"""Scenes that need several engines look as the judge says; the judge knows no runs."""

from __future__ import annotations

import base64
import re
from itertools import permutations
from typing import Any

import numpy as np
import pytest
from attrs import evolve

from judge import judge
from pictures import call, call_data, chain, counts, covered, draw, dynamic, words
from shackled import Background, Camera, Light, Material, Mesh, Object, RenderError, Scene
from shackled.parallel._tiles import grid
from shackled.scene._codec import Rectangle

SQUARE = Mesh(
    [[-50, -50, 0], [50, -50, 0], [50, 50, 0], [-50, 50, 0]],
    [[0, 1, 2], [0, 2, 3]],
    [[255, 80, 20]] * 4,
    [[0, 0, 1]] * 4,
)
KINDS: dict[str, dict[str, Any]] = {
    "flat": {"material": Material("flat", 0.2, 0.7, 0.3, 20)},
    "smooth": {"material": Material("smooth", 0.2, 0.7, 0.5, 30)},
    "wire": {"material": Material("unlit"), "wireframe": True},
    "blended": {"material": Material("flat", 0.2, 0.7, 0.3, 20), "opacity": 0.5},
}
CAMERA = Camera((0, 0, 300), (0, 0, 0), near=1)
LIGHTS = [Light("point", (80, 90, 200), (255, 240, 200)), Light("directional", (-1, 1, 2), (60, 80, 120))]
#: Changes of a scene by which smooth objects have an engine of their own.
FOUR_SAMPLES = {"antialias": True, "lights": LIGHTS[:1]}


def colored(red: int, green: int, blue: int) -> Mesh:
    return evolve(SQUARE, colors=[[red, green, blue]] * 4)


def piece(kind: str, place: int, **changes: Any) -> Object:
    mesh = colored(60 + 40 * (place % 5), 220 - 30 * (place % 7), 40 + 23 * (place % 9))
    turned = Object(
        mesh, (13 * (place % 4) - 20, 9 * (place % 6) - 25, 0), (0.2, 0.1 * (place % 5), 0.1, 1), cull=False
    )
    return evolve(turned, **KINDS[kind] | changes)


def scene_of(*objects: Object, **changes: Any) -> Scene:
    backdrop = Background((10, 20, 60), (90, 80, 70))
    return evolve(Scene(list(objects), CAMERA, LIGHTS, backdrop, width=32, height=24), **changes)


def check(scene: Scene) -> None:
    """The picture is right, and the counts are those of its objects, drawn alone."""
    assert judge("runs", scene).faults == []
    output = call("renderCounted", scene).output
    assert dynamic(output) == dynamic(call("render", scene).output)
    alone = [evolve(scene, objects=[o], background=Background((0, 0, 0)), invert=False) for o in scene.objects]
    lit = [covered(each) for each in alone if each.objects[0].opacity > 0]
    assert output[32:96] == words(sum(counts(each)[0] for each in alone), int(np.any(lit, axis=0).sum()))


@pytest.mark.parametrize("changes", [{}, FOUR_SAMPLES], ids=["plain", "antialiased"])
@pytest.mark.parametrize("order", list(permutations(KINDS)))
def test_kinds_in_any_order(order: tuple[str, ...], changes: dict[str, Any]) -> None:
    scene = scene_of(*(piece(kind, place) for place, kind in enumerate(order)), invert=order[0] == "wire", **changes)
    check(scene)
    assert (draw(scene, Rectangle(5, 3, 17, 11)) == draw(scene)[3:14, 5:22]).all()


@pytest.mark.parametrize("order", list(permutations(KINDS, 2)))
def test_of_equal_depths_the_first_opaque_one_is_seen(order: tuple[str, str]) -> None:
    """Which engine draws it makes no difference; and what is not opaque comes last."""
    unlit, colors = {"material": Material("unlit"), "cull": False}, ((250, 0, 0), (0, 0, 250))
    objects = [Object(colored(*color), **KINDS[kind] | unlit) for kind, color in zip(order, colors, strict=True)]
    scene = scene_of(*objects, background=Background((0, 0, 0)))
    check(scene)
    if "wire" not in order and "blended" not in order:
        assert tuple(draw(scene)[12, 16]) == (250, 0, 0)


def test_hidden_surfaces_of_both_engines() -> None:
    """Depths are handed on: what another engine drew before hides what is behind it, pixel by pixel."""
    unlit = Object(colored(250, 0, 0), material=Material("unlit"), cull=False)
    smooth = Object(colored(0, 0, 250), material=Material("smooth", 1, 0, 0, 1), cull=False)
    near, far = evolve(unlit, position=(0, 0, 10)), evolve(smooth, position=(20, 0, -30), scale=1.4)
    for first, second, seen in (
        (unlit, smooth, (250, 0, 0)),
        (smooth, unlit, (0, 0, 250)),
        (near, far, (250, 0, 0)),
        (far, near, (250, 0, 0)),
    ):
        scene = scene_of(first, second)
        check(scene)
        assert tuple(draw(scene)[12, 16]) == seen


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_not_seen_at_all_is_not_counted(kind: str) -> None:
    seen = scene_of(piece("flat", 0), piece("smooth", 1))
    hidden = piece(kind, 2, opacity=0.0)
    for objects in ((hidden, *seen.objects), (seen.objects[0], hidden, seen.objects[1]), (*seen.objects, hidden)):
        scene = scene_of(*objects)
        check(scene)
        assert counts(scene) == counts(seen)
        assert (draw(scene) == draw(seen)).all()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("opacity", [0.0, None])
def test_errors_name_the_object(kind: str, opacity: float | None) -> None:
    """Each engine counts from the first object of the scene. What is not seen is checked, too."""
    changes = {} if opacity is None else {"opacity": opacity}
    for place in range(4):
        objects = [piece("smooth" if number % 2 else "flat", number) for number in range(4)]
        objects[place] = piece(kind, place, **changes)
        scene = scene_of(*objects)
        check(scene)
        broken = wrong_index(scene, place)
        with pytest.raises(RenderError, match=rf"IndexOutOfRange\(object={place}, face=1, vertexCount=4\)$"):
            chain().call("Renderer", broken)


def wrong_index(scene: Scene, place: int) -> bytes:
    """The call with a face of this object that names a vertex that is not there."""
    marked = evolve(SQUARE, faces=[[0, 1, 2], [3, 2, 1]])
    objects = list(scene.objects)
    before = call_data("render", scene)
    objects[place] = evolve(objects[place], mesh=evolve(marked, colors=objects[place].mesh.colors))
    after = call_data("render", evolve(scene, objects=objects))
    (first, *_) = [at for at in range(len(before)) if before[at] != after[at]]
    return after[:first] + b"\xff" + after[first + 1 :]


@pytest.mark.parametrize("changes", [{}, FOUR_SAMPLES], ids=["plain", "antialiased"])
@pytest.mark.parametrize("size", [(200, 130), (20, 900)])
def test_large_pictures_equal_their_tiles(size: tuple[int, int], changes: dict[str, Any]) -> None:
    """Several engines draw them band by band."""
    kinds = [*KINDS, "smooth", "flat"]
    objects = [piece(kind, place) for place, kind in enumerate(kinds)]
    scene = scene_of(*objects, width=size[0], height=size[1], **changes)
    check(scene)
    whole = draw(scene)
    for tile in grid(*size, size[0] // 2 + 1, size[1] // 3 + 1):
        assert (draw(scene, tile) == whole[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]).all()


@pytest.mark.parametrize("count", [40, 300])
def test_hundreds_of_objects_that_alternate(count: int) -> None:
    """What the Renderer allocates from run to run does not grow into the call behind it."""
    objects = [piece(("flat", "smooth", "wire", "blended")[place % 4], place, scale=0.2) for place in range(count)]
    check(scene_of(*objects, width=9, height=7))


@pytest.mark.parametrize("size", [(1, 1), (32, 24), (181, 91)])
def test_texts_of_mixed_scenes(size: tuple[int, int]) -> None:
    """There is room before the pixels for what the encoders allocate, whoever drew them."""
    for kinds in (("flat",), ("smooth",), ("smooth", "flat", "wire", "blended") * 4):
        scene = scene_of(*(piece(kind, place) for place, kind in enumerate(kinds)), width=size[0], height=size[1])
        for function in ("renderDataURI", "renderSVG"):
            text = dynamic(call(function, scene).output).decode()
            (encoded,) = re.findall(r"data:image/bmp;base64,([0-9A-Za-z+/=]+)", text)
            assert base64.b64decode(encoded) == dynamic(call("render", scene).output)
        check(scene)
