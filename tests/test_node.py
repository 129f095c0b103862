"""A real node: the contracts deployed from their artifacts, called as an outside client would.

Needs anvil, which `npm ci` in contracts/ installs on Linux (x86-64); elsewhere one on the path is taken.
"""

from __future__ import annotations

import base64
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from tools.anvil import AnvilChain
from web3 import HTTPProvider, Web3

from made_scenes import POT, SMALL_SCENES
from nodes import ANVIL, needs_anvil
from shackled import Camera, Light, Object, Scene
from shackled.artifacts import artifact
from shackled.chain import open_chain
from shackled.scene import encode
from shackled.scene._codec import LIGHTS, PROJECTIONS, SHADINGS, Rectangle, extensions
from shackled.scene._in_range import in_range
from shackled.scene._packed import pack

pytestmark = needs_anvil

SCENES = SMALL_SCENES | {
    "orthographic": Scene(
        [Object(POT)],
        Camera((5, 5, 5), (0, 1, 0), (0, 1, 0), "orthographic", 2.5),
        [Light("directional", (1, 2, 3))],
        width=24,
        height=24,
    )
}


@pytest.fixture(scope="module")
def node() -> Iterator[AnvilChain]:
    """With the rules of the embedded EVM."""
    assert ANVIL is not None
    with AnvilChain(ANVIL) as running:
        yield running


def contract(node: AnvilChain, name: str) -> Any:
    """A contract as web3.py sees it, which knows nothing but its ABI."""
    provider = HTTPProvider(node.node.url, {"timeout": 30}, exception_retry_configuration=None)
    address = Web3.to_checksum_address(node.address(name))
    return Web3(provider).eth.contract(address=address, abi=artifact(name).abi)


def q32(values: Any) -> Any:
    """Fixed-point numbers with 32 fraction bits."""
    return [round(float(value) * 2**32) for value in values] if np.ndim(values) else round(float(values) * 2**32)


def rgb(color: Any) -> int:
    red, green, blue = (int(channel) for channel in color)
    return red << 16 | green << 8 | blue


def struct(scene: Scene) -> tuple[Any, ...]:
    """A scene in the words of the ABI, as contracts/src/scene/Scene.sol has them."""
    scene = in_range(scene)
    camera = scene.camera
    return (
        (scene.width, scene.height),
        (
            *(q32(each) for each in (camera.eye, camera.target, camera.up)),
            PROJECTIONS[camera.projection],
            *(q32(each) for each in (camera.half_height, camera.near)),
        ),
        (rgb(scene.background.top), rgb(scene.background.bottom)),
        int(scene.invert),
        rgb(scene.ambient_light),
        [(LIGHTS[light.kind], q32(light.vector), rgb(light.color)) for light in scene.lights],
        [
            (
                pack(o.mesh, smooth=o.material.shading == "smooth"),
                *(q32(each) for each in (o.position, o.rotation, o.scale)),
                (
                    SHADINGS[o.material.shading],
                    *(q32(k) for k in (o.material.ambient, o.material.diffuse, o.material.specular)),
                    o.material.shininess,
                ),
                1 * o.cull + 2 * o.wireframe,
            )
            for o in scene.objects
        ],
        extensions(scene),
    )


@pytest.mark.parametrize("name", SCENES)
def test_a_node_makes_the_same_picture_for_the_same_gas(node: AnvilChain, name: str) -> None:
    scene, embedded = SCENES[name], open_chain()
    data = encode(artifact("Renderer").selectors["render"], scene)
    assert node.call("Renderer", data) == embedded.call("Renderer", data)
    # and as a client that knows nothing but the ABI
    web3 = contract(node, "Renderer")
    assert web3.encode_abi("render", [struct(scene)]) == "0x" + data.hex()
    bmp = embedded.draw(scene).bmp
    assert web3.functions.render(struct(scene)).call() == bmp
    assert web3.functions.renderCounted(struct(scene)).call() == [bmp, *embedded.count(scene)]
    uri = f"data:image/bmp;base64,{base64.b64encode(bmp).decode()}"
    assert web3.functions.renderDataURI(struct(scene)).call() == uri
    assert uri in web3.functions.renderSVG(struct(scene)).call()


def test_a_node_draws_tiles(node: AnvilChain) -> None:
    part = contract(node, "Renderer").functions.renderTile(struct(SCENES["smooth"]), (7, 3, 20, 11)).call()
    assert part == open_chain().draw(SCENES["smooth"], Rectangle(7, 3, 20, 11)).bmp
