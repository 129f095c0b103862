"""Scenes turned about their middle."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve

from pictures import projected
from shackled import Camera, InputError, Light, Object, Scene
from shackled.datasets.common import shapes
from shackled.scene._arithmetic import from_euler, rotate
from shackled.scene._turning import FILLED, full_turn, middle

#: A bar that points at the viewer: turned, it is much wider.
BAR = evolve(shapes.cube(), positions=np.sign(shapes.cube().positions) * (0.1, 0.1, 2))


def scene(**camera: object) -> Scene:
    view = Camera(eye=(1, 2, 9), target=(1, 2, -3), half_height=0.2, **camera)  # type: ignore[arg-type]
    return Scene([Object(BAR, (1, 2, -3))], view)


def test_the_meshes_are_left_to_the_contract() -> None:
    start = scene()
    turned = full_turn(start, 8)
    assert len(turned) == 8
    for step, each in enumerate(turned):
        assert each.objects[0].mesh is start.objects[0].mesh
        expected = rotate(from_euler((0, 45 * step, 0)), (1, 0, 0))
        assert np.allclose(rotate(each.objects[0].rotation, (1, 0, 0)), expected)
        assert (each.lights, each.background, each.camera) == (start.lights, start.background, turned[0].camera)


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_a_margin_stays_around_what_turns(projection: str) -> None:
    """The widest of all frames fills as much of the picture as may be filled, or as the first one did."""
    start = scene(projection=projection)
    start = evolve(start, camera=evolve(start.camera, half_height=0.1 if projection == "perspective" else 1.0))
    filled = np.abs(projected(start)).max()
    tight = evolve(start, camera=evolve(start.camera, half_height=start.camera.half_height * filled / 0.97))
    for each, share in ((start, FILLED), (tight, 0.97)):
        assert max(np.abs(projected(turned)).max() for turned in full_turn(each, 16)) == pytest.approx(share, abs=1e-9)


def test_a_camera_that_sees_enough_stays() -> None:
    start = evolve(scene(), camera=evolve(scene().camera, half_height=0.7))
    far = evolve(start, camera=evolve(start.camera, eye=(1, 2, 60)))
    wide = full_turn(evolve(far, objects=[evolve(far.objects[0], rotation=from_euler((0, 90, 0)))]), 4)
    assert wide[0].camera is far.camera
    inside = evolve(start, camera=evolve(start.camera, eye=(1, 2, -3.05)))
    assert full_turn(inside, 3)[0].camera is inside.camera
    empty = evolve(start, objects=[])
    assert full_turn(empty, 2) == [empty, empty]


def test_several_objects_turn_together() -> None:
    things = [Object(BAR, (0, 0, 0)), Object(BAR, (4, 0, 0))]
    start = Scene(things, Camera((2, 0, 20), (2, 0, 0)), [Light("directional", (0, 0, 1))])
    assert np.allclose(middle(start), (2, 0, 0))
    _, half = full_turn(start, 2)
    assert np.allclose(half.objects[0].position, (4, 0, 0))
    assert np.allclose(half.objects[1].position, (0, 0, 0))


@pytest.mark.parametrize("frames", [1, 0, 721, 2.5, "many"])
def test_frames_that_make_no_turn(frames: object) -> None:
    with pytest.raises(InputError, match="the number of frames of a turntable must be"):
        full_turn(scene(), frames)  # type: ignore[arg-type]
