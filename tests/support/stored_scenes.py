"""Scenes in the Studio of a `World`: stored, drawn with changes, and turned as it turns them."""

from __future__ import annotations

from typing import Any

import numpy as np
from attrs import evolve
from eth_abi.abi import decode
from numpy.typing import NDArray
from tools.ledger import World, call_data

from shackled import Scene
from shackled.scene._arithmetic import multiply, rotate
from shackled.studio import store_scene
from shackled.studio._storage import scene_struct

Pixels = NDArray[np.uint8]

SCENE_STRUCT = scene_struct()
CHANGES = "(uint256,(int256,int256,int256,int256),uint256,(uint256,uint256),uint256,(uint256,uint256))"
NO_CHANGES = {"fields": 0, "turn": (0, 0, 0, 1 << 32), "color": 0, "background": (0, 0), "invert": 0, "canvas": (0, 0)}


def stored(world: World, scene: Scene) -> str:
    """The pointer of a scene that is stored as the commands do it."""
    for storing in store_scene(scene, world.address("Studio")):
        assert world.run(world.address("Studio"), storing.data, created=True)[12:32] == storing.pointer
    return "0x" + storing.pointer.hex()


def kept(world: World, struct: tuple[Any, ...]) -> str:
    """The pointer of a struct that is stored as it is."""
    return "0x" + world.store(f"storeScene({SCENE_STRUCT})", struct).hex()


def struct_of(world: World, pointer: str) -> Any:
    """The struct of a stored scene, decoded."""
    return decode([SCENE_STRUCT], world.run(world.address("Studio"), call_data("scene(address)", pointer)))[0]


def changes(**changed: object) -> tuple[object, ...]:
    """The struct Changes."""
    return tuple((NO_CHANGES | changed).values())


def turned(scene: Scene, quaternion: NDArray[np.float64]) -> Scene:
    """The scene with its objects turned about the middle of the box around the balls that hold them."""
    low, high = [], []
    for o in scene.objects:
        ends = o.mesh.positions.min(axis=0), o.mesh.positions.max(axis=0)
        place = o.position + rotate(o.rotation, sum(ends) / 2 * o.scale)
        radius = o.scale * np.linalg.norm(ends[1] - ends[0]) / 2
        low.append(place - radius)
        high.append(place + radius)
    center = (np.min(low, axis=0) + np.max(high, axis=0)) / 2
    objects = [
        evolve(
            o,
            position=center + rotate(quaternion, o.position - center),
            rotation=multiply(quaternion, o.rotation),
        )
        for o in scene.objects
    ]
    return evolve(scene, objects=objects)
