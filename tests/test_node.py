"""A real node: the contracts deployed from their artifacts, called as an outside client would.

Needs anvil, which `npm ci` in contracts/ installs on Linux (x86-64); elsewhere one on the path is taken.
"""

from __future__ import annotations

import base64
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from web3 import HTTPProvider, Web3
from web3.contract import Contract
from web3.types import Wei

from nodes import anvil, needs_anvil
from shackled import Background, Camera, Light, Material, Mesh, Object, Scene
from shackled.artifacts import artifact
from shackled.chain import Connection, ContractChain, open_chain
from shackled.datasets import teapot
from shackled.ethereum import intrinsic_gas
from shackled.scene import SHADINGS, Rectangle, encode, fit, pack
from shackled.scene._codec import LIGHTS, PROJECTIONS, extensions

PATIENCE = 30
GAS_LIMIT = 1_000_000_000

pytestmark = needs_anvil

POT = teapot(2)
SQUARE = Mesh(
    [[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]],
    [[0, 1, 2], [0, 2, 3]],
    [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]],
)
CAMERA = Camera(eye=(2, 4, 8), target=(0, 1.5, 0))
SCENES = {
    "smooth": Scene(
        [Object(POT, rotation=(0, 0.3, 0, 1), material=Material("smooth"), cull=False)],
        CAMERA,
        [Light("point", (3, 6, 5)), Light("directional", (-1, 0.5, 0), (90, 60, 30))],
        Background("#102040", "#a0b0c0"),
        width=40,
        height=28,
    ),
    "flat, clipped, beside a wireframe": Scene(
        [Object(SQUARE, (0, 0, 2), scale=1.5, cull=False), Object(POT, wireframe=True, material=Material("unlit"))],
        Camera(eye=(1, 1, 2.5), target=(0, 1, 0), near=0.25),
        [Light("directional", (1, 1, 1))],
        invert=True,
        width=33,
        height=21,
    ),
    "orthographic": Scene(
        [Object(POT)],
        Camera((5, 5, 5), (0, 1, 0), (0, 1, 0), "orthographic", 2.5),
        [Light("directional", (1, 2, 3))],
        width=24,
        height=24,
    ),
    "empty": Scene([], width=5, height=3),
}


class Node:
    """The contracts on a node."""

    def __init__(self, connection: Connection) -> None:
        self.w3 = Web3(HTTPProvider(connection.url, {"timeout": PATIENCE}, exception_retry_configuration=None))
        self.sender = self.w3.eth.accounts[0]
        self.contracts: dict[str, Contract] = {}
        for name in (*artifact("Renderer").parts, "Renderer", "Original"):
            self.contracts[name] = self.deploy(name)

    def deploy(self, name: str) -> Contract:
        """A contract, by its creation code and the addresses of those below it."""
        built = artifact(name)
        factory = self.w3.eth.contract(abi=built.abi, bytecode=built.creation)
        parts = [self.contracts[part].address for part in built.parts]
        receipt = self.send(factory.constructor(*parts).data_in_transaction)
        address = receipt["contractAddress"]
        assert len(self.w3.eth.get_code(address)) == len(built.runtime)
        deployed: Contract = self.w3.eth.contract(address=address, abi=built.abi)
        return deployed

    def call(self, name: str, data: bytes) -> bytes:
        """An eth_call with data of our own making."""
        return bytes(self.w3.eth.call({"to": self.contracts[name].address, "data": data, "gas": GAS_LIMIT}))

    def send(self, data: Any, to: Any = b"") -> Any:
        """The receipt of a transaction that succeeds; without an address it creates a contract."""
        sent = self.w3.eth.send_transaction(
            {"from": self.sender, "to": to, "data": data, "gas": GAS_LIMIT, "gasPrice": Wei(0)}
        )
        receipt = self.w3.eth.wait_for_transaction_receipt(sent, timeout=PATIENCE, poll_latency=0.02)
        assert receipt["status"] == 1
        return receipt


@pytest.fixture(scope="module")
def node() -> Iterator[Node]:
    # the rules of the embedded EVM; the gas of a transaction has no floor there
    rules = ["--hardfork", "cancun", "--gas-limit", str(GAS_LIMIT), "--base-fee", "0", "--no-request-size-limit"]
    with anvil(*rules) as running:
        yield Node(running.connection)


@pytest.fixture(scope="module")
def embedded() -> ContractChain:
    return open_chain()


def q32(values: Any) -> Any:
    """Fixed-point numbers with 32 fraction bits."""
    return [round(float(value) * 2**32) for value in values] if np.ndim(values) else round(float(values) * 2**32)


def rgb(color: Any) -> int:
    red, green, blue = (int(channel) for channel in color)
    return red << 16 | green << 8 | blue


def struct(scene: Scene) -> tuple[Any, ...]:
    """A scene in the words of the ABI, as contracts/src/scene/Scene.sol has them."""
    scene = fit(scene)
    camera = scene.camera
    return (
        (scene.width, scene.height),
        (
            q32(camera.eye),
            q32(camera.target),
            q32(camera.up),
            PROJECTIONS[camera.projection],
            q32(camera.half_height),
            q32(camera.near),
        ),
        (rgb(scene.background.top), rgb(scene.background.bottom)),
        int(scene.invert),
        rgb(scene.ambient_light),
        [(LIGHTS[light.kind], q32(light.vector), rgb(light.color)) for light in scene.lights],
        [
            (
                pack(o.mesh, smooth=o.material.shading == "smooth"),
                q32(o.position),
                q32(o.rotation),
                q32(o.scale),
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
def test_a_node_makes_the_same_picture(node: Node, embedded: ContractChain, name: str) -> None:
    scene = SCENES[name]
    selector = artifact("Renderer").selectors["render"]
    bmp = embedded.draw(scene).bmp
    assert node.call("Renderer", encode(selector, scene)) == embedded.call("Renderer", encode(selector, scene)).output
    # and as a client that knows nothing but the ABI
    renderer = node.contracts["Renderer"].functions
    assert renderer.render(struct(scene)).call() == bmp
    counted = renderer.renderCounted(struct(scene)).call()
    assert counted == [bmp, *embedded.count(scene)]
    uri = f"data:image/bmp;base64,{base64.b64encode(bmp).decode()}"
    assert renderer.renderDataURI(struct(scene)).call() == uri
    assert uri in renderer.renderSVG(struct(scene)).call()


def test_a_node_draws_tiles(node: Node, embedded: ContractChain) -> None:
    tile = Rectangle(7, 3, 20, 11)
    renderer = node.contracts["Renderer"].functions
    part = renderer.renderTile(struct(SCENES["smooth"]), (tile.x, tile.y, tile.width, tile.height)).call()
    assert part == embedded.draw(SCENES["smooth"], tile).bmp


@pytest.mark.parametrize("name", SCENES)
def test_a_transaction_uses_the_same_gas(node: Node, embedded: ContractChain, name: str) -> None:
    data = encode(artifact("Renderer").selectors["render"], SCENES[name])
    receipt = node.send(data, node.contracts["Renderer"].address)
    assert receipt["gasUsed"] - intrinsic_gas(data) == embedded.draw(SCENES[name]).gas


def test_both_codecs_agree(node: Node) -> None:
    for scene in SCENES.values():
        data = node.contracts["Renderer"].encode_abi("render", [struct(scene)])
        assert data == "0x" + encode(artifact("Renderer").selectors["render"], scene).hex()


@pytest.mark.parametrize("lit", [False, True])
def test_the_interface_of_the_original(node: Node, embedded: ContractChain, lit: bool) -> None:
    lighting = (lit, 0, 2000, 3000, 10, [0, 0, 50], [255, 255, 255], [255, 255, 255], [0, 0, 0])
    parameters = (
        [[0, 1, 2]],
        [[-60, -60, 0], [60, -60, 0], [0, 60, 0]],
        [[255, 0, 0], [0, 255, 0], [0, 0, 255]],
        [0, 0, -250],
        1,
        [[0, 0, 40], [0, 0, 160]],
        lighting,
        True,
        True,
        False,
        False,
    )
    original = node.contracts["Original"]
    uri = original.functions.render(parameters, 32, False).call()
    bmp = base64.b64decode(uri.removeprefix("data:image/bmp;base64,"), validate=True)
    assert len(bmp) == 54 + 32 * 32 * 3
    data = bytes.fromhex(original.encode_abi("render", [parameters, 32, False]).removeprefix("0x"))
    here = embedded.call("Original", data)
    assert here.output == node.call("Original", data)
    receipt = node.send(data, original.address)
    assert receipt["gasUsed"] - intrinsic_gas(data) == here.gas
