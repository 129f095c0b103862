"""Contracts of tests/studio that call libraries as they are asked."""

from __future__ import annotations

from typing import Any

from eth_abi.abi import decode
from tools.examples import compile_example
from tools.ledger import World, call_data

from shackled.scene._mesh import Mesh
from shackled.scene._packed import unpack
from shackled.studio._storage import scene_struct

SCENE_STRUCT = scene_struct()


class Probe:
    """A contract in a world of its own."""

    def __init__(self, path: str) -> None:
        self.world = World()
        self.address = self.world.deploy(compile_example(path)[0])

    def run(self, signature: str, *values: object) -> bytes:
        """Call it."""
        return self.world.run(self.address, call_data(signature, *values))

    def ask(self, kinds: list[str], signature: str, *values: object) -> tuple[Any, ...]:
        """Return its answer, decoded."""
        return tuple(decode(kinds, self.run(signature, *values)))

    def mesh(self, signature: str, *values: object) -> Mesh:
        """Return a packed mesh of its answer."""
        return unpack(self.ask(["bytes"], signature, *values)[0])

    def scene(self, signature: str, *values: object) -> Any:
        """Return a scene of its answer, as a struct."""
        return self.ask([SCENE_STRUCT], signature, *values)[0]

    def render(self, scene: object) -> bytes:
        """Have the Renderer draw the struct of a scene; return the BMP file."""
        call = call_data(f"render({SCENE_STRUCT})", scene)
        return bytes(decode(["bytes"], self.world.run(self.world.address("Renderer"), call))[0])
