"""Numbers that were not multiplied by 2^32, which the Studio refuses in scenes that are passed to it."""

from __future__ import annotations

from typing import Any

import pytest
from tools.ledger import World

from shackled import Mesh, RenderError
from shackled.scene._packed import pack
from shackled.studio._compact_mesh import compact
from shackled.studio._storage import scene_struct

ONE = 1 << 32
SCENE_STRUCT = scene_struct()
DRAW = f"drawPNG({SCENE_STRUCT},uint256)"
MESH = pack(Mesh([[-100, -100, 0], [100, -100, 0], [0, 100, 0]], [[0, 1, 2]]))
WIDE = pack(Mesh([[-(1 << 23), -100, 0], [(1 << 23) - 1, -100, 0], [0, 100, 0]], [[0, 1, 2]]))
FLAT = (1, ONE // 4, ONE // 2, 0, 1)


def scene(
    *objects: tuple[Any, ...], eye: tuple[int, int, int] = (0, 0, 300 * ONE), lens: tuple[int, int] = (0, ONE // 2)
) -> tuple[Any, ...]:
    camera = (eye, (0, 0, 0), (0, ONE, 0), *lens, 1)
    return ((8, 8), camera, (0, 0), 0, 0xFFFFFF, [], list(objects), b"")


def thing(scale: int = ONE, material: tuple[int, ...] = FLAT, mesh: bytes = MESH, x: int = 0) -> tuple[Any, ...]:
    return (mesh, (x, 0, 0), (0, 0, 0, ONE), scale, material, 0)


@pytest.mark.parametrize(
    ("scene", "error"),
    [
        (scene(thing(), thing(1)), "ScaleLooksUnscaled(object=1, scale=1)"),
        (scene(thing(100)), "ScaleLooksUnscaled(object=0, scale=100)"),
        (scene(thing(1, mesh=compact(MESH))), "ScaleLooksUnscaled(object=0, scale=1)"),
        (scene(thing(1), lens=(1, 200 * ONE)), "ScaleLooksUnscaled(object=0, scale=1)"),
        (scene(thing(), eye=(0, 0, -300)), "CameraLooksUnscaled(eyeX=0, eyeY=0, eyeZ=-300)"),
        # the camera is where `fit` puts it for such an object
        (scene(thing(), thing(1), eye=(0, 0, 300)), "ScaleLooksUnscaled(object=1, scale=1)"),
        (scene(thing(material=(1, 1, 2, 0, 9))), "MaterialLooksUnscaled(object=0, coefficient=2)"),
    ],
)
def test_numbers_without_their_unit(world: World, scene: tuple[Any, ...], error: str) -> None:
    for function, values in ((DRAW, (scene, 1)), (f"storeScene({SCENE_STRUCT})", (scene,))):
        with pytest.raises(RenderError) as refused:
            world.call("Studio", function, *values)
        assert str(refused.value) == f"the contract refused: {error}"


@pytest.mark.parametrize(
    "scene",
    [
        scene(thing(0)),
        scene(thing(1 << 10)),
        scene(thing(), thing(material=(0, 0, 1, 0, 1))),
        scene(thing(material=(1, 0, 0, 0, 1))),
        scene(thing(), eye=(0, 0, 1), lens=(1, 200 * ONE)),
        # small, and seen from near: the object is 70 pixels high
        scene(thing(1000, mesh=WIDE), eye=(0, 0, 4 * ONE)),
        scene(thing(500, x=ONE // 1000), eye=(0, 0, ONE // 1000)),
    ],
)
def test_scenes_that_are_meant(world: World, scene: tuple[Any, ...]) -> None:
    world.call("Studio", DRAW, scene, 1)
    world.store(f"storeScene({SCENE_STRUCT})", scene)


def test_the_eye_at_the_target_has_its_own_error(world: World) -> None:
    with pytest.raises(RenderError, match="NoViewDirection"):
        world.call("Studio", DRAW, scene(thing(), eye=(0, 0, 0)), 1)
