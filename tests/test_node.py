"""A real node: the contracts deployed from their artifacts, called as an outside client would.

Needs anvil, which `npm ci` in contracts/ installs on Linux (x86-64); elsewhere one on the path is taken.
"""

from __future__ import annotations

import base64
import http.server
import os
import re
import shutil
import socket
import subprocess
import threading
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from web3 import HTTPProvider, Web3
from web3.contract import Contract
from web3.types import Wei

from shackled import Background, Camera, Light, Material, Mesh, Object, Scene
from shackled.artifacts import artifact
from shackled.chain import ContractChain, open_chain, open_node, open_place
from shackled.chain.embedded import intrinsic_gas
from shackled.datasets.teapot import teapot
from shackled.errors import InputError, OutOfGasError, RenderError
from shackled.gas.search import search, suffices
from shackled.scene.codec import LIGHTS, PROJECTIONS, SHADINGS, Rectangle, encode
from shackled.scene.fit import fit
from shackled.scene.packed_mesh import pack

BINARIES = Path(__file__).resolve().parent.parent / "contracts" / "node_modules" / ".bin"
ANVIL = shutil.which("anvil", path=f"{BINARIES}{os.pathsep}{os.environ.get('PATH', '')}")
PATIENCE = 30
GAS_LIMIT = 1_000_000_000

pytestmark = pytest.mark.skipif(ANVIL is None, reason="anvil is not installed: npm ci in contracts/")

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

    def __init__(self, w3: Web3) -> None:
        self.w3 = w3
        self.sender = w3.eth.accounts[0]
        self.contracts: dict[str, Contract] = {}
        for name in ("Engine", "Renderer", "Original"):
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
def node(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Node]:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port = found.getsockname()[1]
    log = tmp_path_factory.mktemp("anvil") / "log"
    # the rules of the embedded EVM; the gas of a transaction has no floor there
    rules = ["--hardfork", "cancun", "--gas-limit", str(GAS_LIMIT), "--base-fee", "0", "--no-request-size-limit"]
    with log.open("wb") as output:
        process = subprocess.Popen(
            [str(ANVIL), "--host", "127.0.0.1", "--port", str(port), *rules], stdout=output, stderr=subprocess.STDOUT
        )
        try:
            url = f"http://127.0.0.1:{port}"
            wait_for(url, process, log)
            yield Node(Web3(HTTPProvider(url, {"timeout": PATIENCE}, exception_retry_configuration=None)))
        finally:
            process.terminate()
            try:
                process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def wait_for(url: str, process: subprocess.Popen[bytes], log: Path) -> None:
    """Returns when something answers at the address."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end and process.poll() is None:
        try:
            with urllib.request.urlopen(url, timeout=1):
                return
        except urllib.error.HTTPError:
            return
        except OSError:
            time.sleep(0.05)
    pytest.fail(f"anvil does not answer: {log.read_text(errors='replace')[-1000:]}")


@pytest.fixture(scope="module")
def embedded() -> ContractChain:
    chain = open_chain()
    assert isinstance(chain, ContractChain)
    return chain


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


@pytest.fixture
def url(node: Node) -> str:
    assert isinstance(node.w3.provider, HTTPProvider)
    return str(node.w3.provider.endpoint_uri)


@pytest.mark.parametrize("name", SCENES)
def test_pictures_with_nothing_deployed(url: str, embedded: ContractChain, name: str) -> None:
    """No code stands at the addresses that are called: each call brings it along."""
    place = open_place(None, url)
    scene = SCENES[name]
    assert place.draw(scene).bmp == embedded.draw(scene).bmp
    assert place.draw(scene).gas is None
    assert place.count(scene) == embedded.count(scene)


def test_the_search_for_gas_agrees_with_the_embedded_one(url: str, embedded: ContractChain) -> None:
    data = encode(artifact("Renderer").selectors["render"], SCENES["orthographic"])
    place = open_node(url)
    found = [search(suffices(each, "Renderer", data), upper=5_000_000).gas for each in (place, embedded)]
    assert found[0] == found[1]


def test_what_a_contract_refuses_on_a_node(url: str) -> None:
    data = bytearray(encode(artifact("Renderer").selectors["render"], SCENES["empty"]))
    data[4 + 32 : 4 + 64] = bytes(32)
    place = open_node(url)
    with pytest.raises(RenderError, match=r"^the contract refused: CanvasSize\(width=0, height=3\)$"):
        place.call("Renderer", bytes(data))
    with pytest.raises(OutOfGasError, match="50,000 did not suffice"):
        place.call("Renderer", bytes(encode(artifact("Renderer").selectors["render"], SCENES["smooth"])), 50_000)


class Answers(http.server.BaseHTTPRequestHandler):
    """A server that is no node: it says what its class is told to."""

    status, body = 200, b""

    def do_POST(self) -> None:
        self.rfile.read(int(self.headers["Content-Length"]))
        self.send_response(self.status)
        self.send_header("Content-Length", str(len(self.body)))
        self.end_headers()
        self.wfile.write(self.body)

    def log_message(self, *_: Any) -> None:
        pass


@pytest.mark.parametrize(
    ("status", "body", "message"),
    [
        (200, b"<html>hello</html>", "what is not JSON-RPC"),
        (200, b'{"jsonrpc": "2.0", "id": 1, "result": "0x123"}', "what is no result of a call"),
        (200, b'{"jsonrpc": "2.0", "id": 1, "error": {"code": -1, "message": "no overrides"}}', "says: no overrides"),
        (429, b"", "HTTP status 429; it asks to be called less often"),
        (500, b"", "HTTP status 500"),
    ],
)
def test_answers_that_are_none(status: int, body: bytes, message: str) -> None:
    handler = type("Handler", (Answers,), {"status": status, "body": body})
    with http.server.HTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            with pytest.raises(RenderError, match=re.escape(message)) as error:
                open_place(None, f"http://127.0.0.1:{server.server_port}/key").draw(SCENES["empty"])
            assert "\n" not in str(error.value)
            assert "key" not in str(error.value)
        finally:
            server.shutdown()


def test_a_node_that_is_not_there() -> None:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port = found.getsockname()[1]
    with pytest.raises(RenderError, match="cannot be reached"):
        open_place(None, f"http://127.0.0.1:{port}").draw(SCENES["empty"])
    with pytest.raises(InputError, match="must be the address of a node"):
        open_place(None, "localhost:8545")
    with pytest.raises(InputError, match="leave out --chain"):
        open_place("pyrevm", "http://127.0.0.1:8545")
