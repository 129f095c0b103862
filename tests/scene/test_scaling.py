"""The work between a scene and its call is in proportion to the number of objects, records and vertices."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from attrs import evolve

from shackled import Light, Material, Mesh, Object, Scene, Texture, load
from shackled.datasets.common import shapes
from shackled.scene import decode
from shackled.scene._codec import render_call
from shackled.scene._crease import creased
from shackled.scene._mesh import components
from shackled.scene._simplify import simplify_scene
from shackled.scene._turning import full_turn

#: How many times as much is asked for, and how many times as many calls that may take, which is 64 where each object
#: looks at all others.
FACTOR, MOST = 8, 12


def calls(work: Callable[[], object]) -> int:
    """How many functions are called, those of NumPy included: the same number every time."""
    count = 0

    def profile(_frame: object, event: str, _what: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(profile)
    try:
        work()
    finally:
        sys.setprofile(before)
    return count


def boxes(count: int) -> list[Object]:
    """Boxes of all kinds: flat, smooth, of glass, textured, with opacities, closed or not."""
    rng = np.random.default_rng(1)
    texture = Texture(rng.integers(0, 256, (4, 4, 3)))
    box = shapes.cube()
    return [
        Object(
            evolve(
                box,
                positions=box.positions * rng.uniform(0.1, 2),
                uvs=rng.uniform(size=(8, 2)),
                opacities=rng.uniform(size=8) if number % 3 == 0 else None,
            ),
            rng.normal(size=3) * 10,
            rng.normal(size=4),
            material=Material(("flat", "smooth")[number % 2], texture=texture if number % 5 == 0 else None),
            opacity=0.5 if number % 4 == 0 else 1,
        )
        for number in range(count)
    ]


def scene_of(count: int) -> Scene:
    light = evolve(Light.spot((9, 9, 9), (-1, -1, -1)), shadow=True)
    return Scene(boxes(count), lights=[light], ground="tomato", fog=("grey", 5, 50))


WORK: dict[str, Callable[[Scene], object]] = {
    "encode": render_call,
    "decode": lambda scene: decode(render_call(scene)),
    "look": lambda scene: load(scene, azimuth=3, fog="red", shadow=True, crease=30),
    "scene file": Scene.encode,
    "turn": lambda scene: full_turn(scene, 3),
    "simplify": lambda scene: simplify_scene(scene, 8),
}


@pytest.mark.parametrize("work", WORK.values(), ids=WORK)
def test_objects(work: Callable[[Scene], object]) -> None:
    few, many = scene_of(10), scene_of(10 * FACTOR)
    work(few)  # what is only done once
    assert calls(lambda: work(many)) < MOST * calls(lambda: work(few))


def test_records() -> None:
    """The bytes of the extensions are read once, not again for every record."""

    class Counted(bytes):
        copied = 0

        def __getitem__(self, key: Any) -> Any:
            part = super().__getitem__(key)
            if not isinstance(part, bytes):
                return part
            Counted.copied += len(part)
            return Counted(part)

    triangle = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    call = Counted(render_call(Scene([Object(triangle, opacity=0.5)] * 2000)))
    assert len(decode(call).objects) == 2000
    # 16 times, if each record copied all that follow
    assert Counted.copied < 5 * len(call)


def test_chains_of_vertices() -> None:
    """Of any order."""

    def path(count: int) -> Callable[[], object]:
        order = np.random.default_rng(2).permutation(count)
        links = np.stack([order[:-1], order[1:]], axis=1)
        assert not components(links, count).any()
        return lambda: components(links, count)

    assert calls(path(16_000)) < 2 * calls(path(2000))


def test_long_creases() -> None:
    def ridge(count: int) -> Mesh:
        """A roof whose ridge, a weak crease, ends in the surface, before both gables."""
        x = np.arange(count + 1.0)
        height = np.where((x == 0) | (x == count), 0, 0.45)
        rows = [np.stack([x, 0 * x + y, -abs(y) * height], axis=1) for y in range(-2, 3)]
        i = np.arange(count)
        faces = [
            np.stack([row + i + a, row + i + b, row + i + c], axis=1)
            for row in range(0, 4 * (count + 1), count + 1)
            for a, b, c in ((0, 1, count + 1), (1, count + 2, count + 1))
        ]
        return Mesh(np.concatenate(rows), np.concatenate(faces))

    def seconds(mesh: Mesh) -> float:
        times = []
        for _ in range(3):
            start = time.process_time()
            creased(mesh)
            times.append(time.process_time() - start)
        return min(times)

    # the ridge, a crease, is smooth: no vertex of it is there twice
    assert len(creased(ridge(300)).positions) == len(ridge(300).positions)
    assert seconds(ridge(8000)) < 3 * FACTOR * seconds(ridge(1000))
