"""Shadows of one light, and a ground that catches them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve

from judge import judge
from pictures import chain, draw
from shackled import Camera, Ground, InputError, Light, Material, Mesh, Object, RenderError, Scene, load
from shackled.artifacts import artifact
from shackled.datasets.common import shapes
from shackled.scene import Rectangle, encode_scene, encode_scene_file, fit, painted
from shackled.scene._codec import extensions

SIZE = 40


def still_life(**changes: Any) -> Scene:
    """A smooth torus and a flat box on a ground."""
    ring, ball = shapes.torus(across=14, down=7), shapes.sphere(10, 7)
    objects = [
        Object(painted(ring, "#d0803a"), (0, 0.4, 0), material=Material("smooth", specular=0.4)),
        Object(painted(ball, "#4a90d0"), (0.2, 1.1, 0), scale=0.4, material=Material("flat")),
    ]
    scene = Scene(
        objects,
        Camera((3.4, 3.0, 5.0), (0.2, 0.4, 0), half_height=0.33),
        [Light("directional", (-0.6, 1.0, 0.5), (255, 243, 226), shadow=True), Light("point", (3, 2, 4), "#405060")],
        ("#24292f", "#6c7586"),
        width=SIZE,
        height=SIZE,
        ground="#b9b4a8",
    )
    return evolve(scene, **changes)


def is_right(scene: Scene) -> bool:
    """Whether the judge finds no wrong pixel."""
    return judge("shadows", scene).faults == []


SUN, LAMP = Light("directional", (-0.6, 1.0, 0.5), shadow=True), Light("point", (2, 3, 2), shadow=True)


def test_large_picture() -> None:
    """Pictures of several bands and engines' runs."""
    scene = still_life(width=160, height=160)
    first, second = scene.objects
    assert is_right(scene)
    glass = evolve(scene, objects=[first, evolve(second, opacity=0.5)])
    assert (draw(fit(glass), Rectangle(60, 70, 30, 20)) == draw(fit(glass))[70:90, 60:90]).all()


def test_a_ground_fades() -> None:
    """It hides the background in its middle only, and nothing of it is left at its radius."""
    floor = Ground("#ffffff", height=0.0, radius=2.0)
    camera = Camera((0, 10, 0.001), (0, 0, 0), half_height=3, projection="orthographic")
    scene = Scene([], camera, [SUN], "#000000", ground=floor, width=61, height=61)
    row = draw(fit(scene))[30, :, 0].astype(int)
    assert row[30] > 200
    assert (np.diff(row[:31]) >= 0).all()
    assert row[9] == 0 < row[12]


def test_scene_files(tmp_path: Path) -> None:
    scene = still_life(ground=Ground("#b9b4a8", -0.5, 7))
    path = tmp_path / "scene.json"
    path.write_bytes(encode_scene_file(scene))
    assert load(path) == scene
    assert load(path, shadow=False, ground="none") == evolve(
        scene, ground=None, lights=[evolve(light, shadow=False) for light in scene.lights]
    )


def test_wrong_values() -> None:
    with pytest.raises(InputError, match="one light of a scene may cast shadows"):
        still_life(lights=[SUN, LAMP])
    with pytest.raises(InputError, match="radius of a ground must be above 0"):
        Ground("red", radius=0)
    with pytest.raises(InputError, match="must be below the second"):
        Object(Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), fade=(2, 1))


@pytest.mark.parametrize(
    ("record", "error"),
    [
        (bytes([10, 0, 0, 0, 0]), "ExtensionSize"),
        (bytes([10, 0, 2, 0, 1]) + (1).to_bytes(32, "big"), "ExtensionIndex"),
        (bytes([10, 0, 0, 0, 1]) + (4).to_bytes(32, "big"), "ShadowRuleOutOfRange"),
        (2 * (bytes([10, 0, 0, 0, 1]) + (1).to_bytes(32, "big")), "SeveralShadows"),
        (bytes([11, 0, 0, 0, 1]) + bytes(32), "GroundOutOfRange"),
        (bytes([14, 0, 0, 0, 0]), "UnknownExtension"),
    ],
)
def test_wrong_records(record: bytes, error: str) -> None:
    if error == "SeveralShadows":
        # the second belongs to the second light
        record = record[:39] + b"\x01" + record[40:]
    scene = fit(still_life(ground=None, lights=[evolve(SUN, shadow=False), evolve(LAMP, shadow=False)]))
    data = artifact("Renderer").selectors["render"] + (32).to_bytes(32, "big") + encode_scene(scene)
    # the extensions are last
    assert not extensions(scene)
    data = data[:-32] + len(record).to_bytes(32, "big") + record + bytes(-len(record) % 32)
    with pytest.raises(RenderError, match=error):
        chain().call("Renderer", data)
