"""Pictures from nodes: however a node gets the contracts, they are those of the embedded EVM, for the same gas."""

from __future__ import annotations

import zlib
from bisect import bisect_left
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from random import Random
from typing import Any

import pytest
from tools.anvil import Anvil

from made_scenes import POT, SMALL_SCENES
from nodes import Reply, anvil, failure, forward, geth, needs_anvil, replying, result, without_overrides
from shackled import Camera, Material, Mesh, Nodes, Object, Scene, render
from shackled.artifacts import RENDERER, artifact
from shackled.chain import open_chain, open_node
from shackled.chain._address_book import AddressBook
from shackled.chain._chain import Drawing
from shackled.chain._embedded import EmbeddedChain
from shackled.chain._node import MAX_INIT_CODE, NodeChain
from shackled.errors import (
    InputError,
    NodeError,
    OutOfGasError,
    RenderError,
    RevertError,
    WrongChainError,
)
from shackled.ethereum._encoding import checksum_address
from shackled.gas import render_call, search, suffices
from shackled.scene._codec import Rectangle

pytestmark = needs_anvil

SHARD = Mesh([[-1, 0, 0], [2, 0, 1], [0, 2, 0]], [[0, 1, 2]], normals=[[0, 0, 1]] * 3)
CAMERA = Camera(eye=(2, 4, 8), target=(0, 1.5, 0))
SCENES = {
    "smooth": SMALL_SCENES["smooth"],
    "empty": SMALL_SCENES["empty"],
    "antialiased": Scene([Object(POT, material=Material("smooth"))], CAMERA, width=20, height=14, antialias=True),
    "three antialiased engines": Scene(
        [Object(SHARD, material=Material("smooth")), Object(SHARD, (1, 1, 1)), Object(SHARD, wireframe=True)],
        CAMERA,
        width=20,
        height=14,
        antialias=True,
    ),
}
TILE = Rectangle(7, 3, 20, 11)
#: What the first access to an account costs more than a later one.
FIRST_ACCESS = 2500


@pytest.fixture(scope="module")
def embedded() -> EmbeddedChain:
    return open_chain()


@pytest.fixture(scope="module")
def bare() -> Iterator[Anvil]:
    """With nothing deployed, at its default limits."""
    with anvil() as node:
        yield node


def put(node: Anvil, address: bytes, code: bytes) -> None:
    node.rpc("anvil_setCode", "0x" + address.hex(), "0x" + code.hex())


@pytest.fixture(scope="module")
def deployed(embedded: EmbeddedChain) -> Iterator[Anvil]:
    """With the contracts where `shackled deploy` puts them."""
    with anvil() as node:
        for name in RENDERER:
            put(node, embedded.address(name), embedded.code(name))
        yield node


def agree(found: Drawing, expected: Drawing, is_created: bool = True) -> None:
    """The same picture for the same gas; of a creation call with the access to all its engines, even if one draws."""
    assert found.gas is not None
    assert expected.gas is not None
    assert found.gas - expected.gas in ((0, FIRST_ACCESS, 2 * FIRST_ACCESS) if is_created else (0,))
    assert replace(found, gas=expected.gas) == expected


def check(node: NodeChain, embedded: EmbeddedChain, way: str) -> None:
    """All that can be asked of it."""
    is_created = way == "creation call"
    assert "(" not in node.name
    for scene in SCENES.values():
        agree(node.draw(scene), embedded.draw(scene), is_created)
        assert node.count(scene) == embedded.count(scene)
    assert node.name == f"{node.connection.name} ({way})"
    agree(node.draw(SCENES["smooth"], TILE), embedded.draw(SCENES["smooth"], TILE), is_created)
    assert node.count(SCENES["smooth"], TILE) == embedded.count(SCENES["smooth"], TILE)
    # what the contract refuses, and what takes too much gas
    data = bytearray(render_call(SCENES["empty"]))
    data[4 + 32 : 4 + 64] = bytes(32)
    with pytest.raises(RenderError, match=r"^the contract refused: CanvasSize\(width=0, height=3\)$"):
        node.call("Renderer", bytes(data))
    for limit in (0, 2_000, 50_000):
        with pytest.raises(OutOfGasError, match=f"{limit:,} gas is not enough"):
            node.call("Renderer", render_call(SCENES["smooth"]), limit)
    # neither is taken for the other
    with pytest.raises(RenderError, match="not a scene") as refused:
        node.call("Renderer", b"nothing")
    assert not isinstance(refused.value, OutOfGasError)


def test_nothing_deployed(bare: Anvil, embedded: EmbeddedChain) -> None:
    check(open_node(bare.url), embedded, "state override")


@pytest.mark.parametrize("refuse", [True, False])
def test_a_node_without_overrides(bare: Anvil, embedded: EmbeddedChain, refuse: bool) -> None:
    with without_overrides(bare.url, refuse) as url:
        check(open_node(url), embedded, "creation call")


def test_deployed(deployed: Anvil, embedded: EmbeddedChain) -> None:
    check(open_node(deployed.url), embedded, "deployed")
    check(open_node(deployed.url, checksum_address(embedded.address("Renderer"))), embedded, "deployed")


def test_gas_where_the_caller_has_code(embedded: EmbeddedChain) -> None:
    """The account in whose name a node makes calls may delegate to a contract (EIP-7702): its code takes no part."""
    with anvil() as node:
        # GAS POP, 100 times
        put(node, b"\xc0" * 20, bytes.fromhex("5a50") * 100)
        (account, *_) = node.rpc("eth_accounts")
        put(node, bytes.fromhex(account[2:]), bytes.fromhex("ef0100") + b"\xc0" * 20)
        node.rpc("anvil_impersonateAccount", account)

        def name_it(request: dict[str, Any]) -> Reply:
            request["params"][0].setdefault("from", account)
            return forward(node.url, request)

        with replying(node.url, eth_call=name_it) as url:
            assert open_node(url).draw(SCENES["smooth"]) == embedded.draw(SCENES["smooth"])


def test_deployed_on_a_node_without_overrides(deployed: Anvil, embedded: EmbeddedChain) -> None:
    with without_overrides(deployed.url) as url:
        check(open_node(url), embedded, "deployed")


def test_deployed_on_a_node_that_only_calls(deployed: Anvil, embedded: EmbeddedChain) -> None:
    """Then no gas is told."""

    def refuse(request: dict[str, Any]) -> Reply | None:
        only_calls = len(request["params"]) == 2 and "to" in request["params"][0]
        return None if only_calls else failure("not here", -32601)

    with replying(deployed.url, eth_call=refuse) as url:
        node = open_node(url)
        drawing = node.draw(SCENES["smooth"])
        assert (drawing.bmp, drawing.gas) == (embedded.draw(SCENES["smooth"]).bmp, None)
        assert node.gas_limit < 30_000_000
        with pytest.raises(OutOfGasError, match="50,000 gas is not enough"):
            node.call("Renderer", render_call(SCENES["smooth"]), 50_000)


def test_the_search_for_gas_agrees(bare: Anvil, deployed: Anvil, embedded: EmbeddedChain) -> None:
    data = render_call(SCENES["smooth"])
    expected = search(suffices(embedded, "Renderer", data)).gas
    with without_overrides(bare.url) as url:
        for place in (bare.url, url, deployed.url):
            found = search(suffices(open_node(place), "Renderer", data)).gas
            assert found - expected in ((0, FIRST_ACCESS) if place == url else (0,))


def test_another_contract(bare: Anvil, embedded: EmbeddedChain) -> None:
    """Of whatever others: of three that build on one another the last."""
    call = artifact("Genesis").selectors["render"] + (7).to_bytes(32, "big") + (24).to_bytes(32, "big")
    here = embedded.call("Genesis", call)
    with without_overrides(bare.url) as url:
        for place in (bare.url, url):
            node = open_node(place).call("Genesis", call)
            assert node.output == here.output
            assert node.gas is not None
            assert node.gas - here.gas in ((0, FIRST_ACCESS) if place == url else (0,))


def test_addresses_of_other_deployments(bare: Anvil, embedded: EmbeddedChain) -> None:
    """A renderer may stand anywhere, with its engines anywhere."""
    places = {name: bytes([number]) * 20 for number, name in enumerate(RENDERER, 0x11)}
    fragments, renderer = places["FragmentEngine"], places["Renderer"]
    try:
        code = embedded.code("Renderer")
        for name, place in places.items():
            put(bare, place, embedded.code(name))
            code = code.replace(embedded.address(name).rjust(32, b"\0"), place.rjust(32, b"\0"))
        put(bare, renderer, code)
        check(open_node(bare.url, checksum_address(renderer)), embedded, "deployed")
        AddressBook().write(bare.connection.chain_id, places)
        check(open_node(bare.url), embedded, "deployed")
        # a book that is out of date is passed over
        put(bare, fragments, b"")
        check(open_node(bare.url), embedded, "state override")
        with pytest.raises(RenderError, match="is not the renderer of this version of shackled"):
            open_node(bare.url, checksum_address(renderer)).draw(SCENES["empty"])
    finally:
        AddressBook().path.unlink(missing_ok=True)
        for address in places.values():
            put(bare, address, b"")


def test_addresses_that_are_wrong(bare: Anvil) -> None:
    with pytest.raises(RenderError, match=r"^there is no contract at 0x3333.* on chain 31337 \(the node 127"):
        open_node(bare.url, "0x" + 40 * "3").draw(SCENES["empty"])
    proxy = "0x4e59b44847b379578588920cA78FbF26c0B4956C"
    with pytest.raises(RenderError, match=r"^the contract at 0x4e59.* is not the renderer of this version"):
        open_node(bare.url, proxy).draw(SCENES["empty"])
    with pytest.raises(InputError, match="`address` must be an address, 0x and 40 hexadecimal digits, not '0x12'"):
        open_node(bare.url, "0x12")
    with pytest.raises(InputError, match="`address` has an invalid checksum"):
        open_node(bare.url, proxy.replace("cA78F", "Ca78F"))


def large_scene(triangles: int) -> Scene:
    """Of a mesh whose bytes say nothing, so that they can hardly be packed."""
    random = Random(1)
    vertices = [[random.uniform(-9, 9) for _ in range(3)] for _ in range(triangles // 2)]
    faces = [random.sample(range(len(vertices)), 3) for _ in range(triangles)]
    return Scene([Object(Mesh(vertices, faces), scale=0.1)], width=16, height=16)


def test_a_mesh_that_has_to_be_packed(bare: Anvil, embedded: EmbeddedChain) -> None:
    scene = large_scene(1400)
    size = len(render_call(scene))
    assert size + sum(len(artifact(name).creation) for name in RENDERER) > MAX_INIT_CODE
    with without_overrides(bare.url) as url:
        agree(open_node(url).draw(scene), embedded.draw(scene))


def test_a_mesh_that_is_too_large_for_a_creation(bare: Anvil) -> None:
    with without_overrides(bare.url) as url, pytest.raises(NodeError, match=r"too large for a creation call.*49,152"):
        open_node(url).draw(large_scene(6000))


def test_a_node_that_keeps_back_what_is_reverted(bare: Anvil) -> None:
    def keep_back(request: dict[str, Any]) -> Reply | None:
        probes = len(request["params"]) == 2 and len(request["params"][0]["data"]) <= 100
        return None if probes else failure("execution reverted", 3)

    words = "does not return the data of a reverted creation call"
    with replying(bare.url, eth_call=keep_back) as url, pytest.raises(NodeError, match=words):
        open_node(url).draw(SCENES["empty"])


def test_rules_that_are_too_old() -> None:
    with anvil("--hardfork", "shanghai") as node, pytest.raises(WrongChainError, match="need the rules of Cancun"):
        open_node(node.url).draw(SCENES["empty"])


@pytest.mark.parametrize("output", ["0x", "0x" + 31 * "00", "0x" + 64 * "ff"])
def test_answers_that_hold_no_picture(bare: Anvil, output: str) -> None:
    def call(request: dict[str, Any]) -> Reply | None:
        return result(output) if "data" in request["params"][0] else None

    with replying(bare.url, eth_call=call) as url, pytest.raises(RenderError, match=r"do not hold a picture"):
        open_node(url).draw(SCENES["empty"])


def test_limits_are_those_of_the_node(bare: Anvil, embedded: EmbeddedChain) -> None:
    cap = 50_000_000
    with geth(bare.url, cap) as url:
        node = open_node(url)
        assert 0.97 * cap < node.gas_limit < cap
        drawing = node.draw(SCENES["smooth"])
        assert drawing == embedded.draw(SCENES["smooth"])
    # what is promised is there, and not much more: a picture that just fits
    need = (drawing.gas or 0) + (drawing.intrinsic_gas or 0)
    for cap in range(need, need + need // 10, need // 100):
        with geth(bare.url, cap) as url:
            node = open_node(url)
            if need <= node.gas_limit:
                assert node.draw(SCENES["smooth"]) == drawing
                break
    else:
        pytest.fail("the limit that is told is too low by a tenth")


def test_too_little_gas_on_a_node(bare: Anvil) -> None:
    with (
        geth(bare.url, 300_000) as url,
        pytest.raises(OutOfGasError, match="allows a call too little gas for this: use a smaller `size`"),
    ):
        open_node(url).draw(SCENES["smooth"])


@pytest.mark.parametrize("cap", [300_000, 3_000_000, 10_000_000])
def test_too_little_gas_to_bring_the_contracts_along(bare: Anvil, cap: int) -> None:
    """That is what is told, and no smaller picture is advised, since none would do."""
    scene = large_scene(1400)
    words = r"allows a call too little gas for this: [\d,]+, and it has no state overrides: creating the"
    with geth(bare.url, cap) as url, without_overrides(url) as other:
        assert open_node(other).gas_limit == 0
        for draw in (open_node(other).draw, lambda scene: render(scene, on=Nodes(other))):
            with pytest.raises(OutOfGasError, match=words) as error:
                draw(scene)
            assert "run shackled deploy" in str(error.value)
            assert "`size`" not in str(error.value)


def test_a_node_without_overrides_and_creation_calls(bare: Anvil) -> None:
    def call(request: dict[str, Any]) -> Reply | None:
        if len(request["params"]) > 2:
            return failure("too many arguments, want at most 2", -32602)
        return None if "to" in request["params"][0] else failure("missing to address", -32602)

    words = (
        "missing to address: it has no state overrides, and the contracts .*; run shackled deploy, or use another node"
    )
    with replying(bare.url, eth_call=call) as url, pytest.raises(NodeError, match=words):
        open_node(url).draw(SCENES["smooth"])


#: Code that returns the data of a call, and what creates it.
ECHO = bytes.fromhex("66365f5f37365ff35f5260076019f3")


def unpacked(node: Anvil, packed: bytes) -> bytes:
    """What the creation call makes of a deflated stream that begins with `ECHO`."""
    arguments = b"".join(value.to_bytes(32, "big") for value in (0, 1, 96, len(packed))) + packed
    data = artifact("CreationCall").creation + arguments + bytes(-len(arguments) % 32)
    with pytest.raises(RevertError) as error:
        node.rpc("eth_call", {"data": "0x" + data.hex()}, "latest")
    assert error.value.data[:32] == (1).to_bytes(32, "big")
    return error.value.data[64:]


SAMPLES = {
    "nothing": b"",
    "a byte": b"x",
    "zeros": bytes(5000),
    "a pattern": b"abc" * 2000,
    "noise": Random(2).randbytes(9000),
    "words": b"".join(n.to_bytes(32, "big") for n in range(700)),
    "code": artifact("Renderer").creation,
    "far repeats": Random(3).randbytes(15000) * 2,
    "all lengths": b"".join(bytes([n]) * (n + 2) + Random(n).randbytes(3) for n in range(256)),
}


@pytest.mark.parametrize("name", SAMPLES)
def test_what_was_packed_is_unpacked(bare: Anvil, name: str) -> None:
    data = SAMPLES[name]
    stream = len(ECHO).to_bytes(4, "big") + bytes(8) + ECHO + data
    ways = [(level, zlib.Z_DEFAULT_STRATEGY) for level in (0, 1, 6, 9)]
    ways += [(9, strategy) for strategy in (zlib.Z_FIXED, zlib.Z_HUFFMAN_ONLY, zlib.Z_RLE)]
    for level, strategy in ways:
        deflate = zlib.compressobj(level, zlib.DEFLATED, -15, 9, strategy)
        packed = deflate.compress(stream[:1000]) + deflate.flush(zlib.Z_FULL_FLUSH)
        packed += deflate.compress(stream[1000:]) + deflate.flush()
        if len(packed) < MAX_INIT_CODE - 6000:
            assert unpacked(bare, packed) == data


@pytest.mark.parametrize("triangles", [200, 1400])
def test_the_limit_of_a_creation_call_is_kept(bare: Anvil, embedded: EmbeddedChain, triangles: int) -> None:
    """What it costs to bring the contracts along is subtracted, even if they and a large mesh have to be unpacked."""
    scene = large_scene(triangles)
    drawing = embedded.draw(scene)
    need = (drawing.gas or 0) + (drawing.intrinsic_gas or 0)
    caps = range(need, need + 10**8, 500_000)

    @contextmanager
    def capped(cap: int) -> Iterator[NodeChain]:
        with geth(bare.url, cap) as url, without_overrides(url) as other:
            yield open_node(other)

    def told(cap: int) -> int:
        with capped(cap) as node:
            return node.gas_limit

    # the least of these with which the limit that is told is enough
    with capped(caps[bisect_left(caps, need, key=told)]) as node:
        agree(node.draw(scene), drawing)


def test_several_threads_at_once(bare: Anvil, embedded: EmbeddedChain) -> None:
    tiles = [Rectangle(x, y, 8, 7) for y in range(0, 28, 7) for x in range(0, 40, 8)]
    expected = [embedded.draw(SCENES["smooth"], tile) for tile in tiles]
    with without_overrides(bare.url) as url:
        for place in (bare.url, url):
            node = open_node(place)
            with ThreadPoolExecutor(8) as pool:
                found = list(pool.map(lambda tile, node=node: node.draw(SCENES["smooth"], tile), tiles))
            for drawing, other in zip(found, expected, strict=True):
                agree(drawing, other, place == url)
