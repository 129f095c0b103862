"""Several nodes at once, and nodes that misbehave: the picture is right, or the error is clear."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from attrs import evolve

import shackled
from nodes import Reply, anvil, failure, forward, free_port, geth, needs_anvil, serving
from proxies import always, at, each_third, proxy
from shackled import ChainError, Image, Nodes, load
from shackled.chain import open_chain
from shackled.errors import NodeError
from shackled.ethereum._encoding import PROXY
from shackled.parallel import Listener
from shackled.parallel._job import render_frames
from shackled.parallel._scheduler import Outline
from shackled.parallel.places import RenderOptions
from shackled.scene._turning import full_turn

SCENE = evolve(load("cube"), width=64, height=60)
TILE = (64, 5)
PARTS = 12
#: A turntable, of which there are so many tiles of 64 x 16 pixels that can be lied about.
SPIN = full_turn(evolve(load("cube"), width=64, height=64), 2)
LIES = 8


pytestmark = needs_anvil


class Notes(Listener):
    def __init__(self) -> None:
        self.warnings: list[str] = []
        self.outlines = 0

    def planned(self, outline: Outline) -> None:
        self.outlines += 1

    def warned(self, text: str) -> None:
        self.warnings.append(text)


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.parallel._scheduler.PAUSE", 0.01)


@pytest.fixture(scope="module")
def node() -> Iterator[str]:
    with anvil() as node:
        yield node.url


@pytest.fixture(scope="module")
def right() -> Image:
    return shackled.render(SCENE)


@pytest.fixture(scope="module")
def spun() -> list[Image]:
    return render_frames(SPIN)


def test_two_nodes_make_one_picture(node: str, right: Image) -> None:
    with anvil() as other:
        (image,) = render_frames([SCENE], RenderOptions(Nodes(node, other.url, node), tile=TILE))
    assert image.bmp == right.bmp
    assert (image.triangles, image.covered_pixels) == (right.triangles, right.covered_pixels)
    assert image.calls == PARTS
    assert image.made_by.startswith("2 nodes: 127.0.0.1:")


@pytest.mark.parametrize("manner", ["kill", "429", "half"])
def test_a_node_that_fails_now_and_then(node: str, right: Image, manner: str) -> None:
    asked: list[str] = []
    with proxy(node, each_third(manner), asked) as url:
        (image,) = render_frames([SCENE], RenderOptions(Nodes(url), tile=TILE))
    assert image.bmp == right.bmp
    # a call for each part, and one more for each that failed: of three calls, two are right
    assert asked.count(manner) >= PARTS // 2


@pytest.mark.parametrize(
    ("manner", "message"),
    [
        ("kill", "closed the connection"),
        ("429", "limits the rate|asked later|too many|busy"),
        ("wrong", "for the tile of 64 x 5 pixels at .*: its picture is not what the contracts draw"),
        ("empty", "answers wrongly for .*: the contract returned 0 bytes"),
        ("junk", "answers wrongly for .*: the contract returned 468 bytes"),
        ("lie", "answers wrongly for .*: the contract refused: error 0x1212"),
    ],
)
def test_a_node_that_always_fails(node: str, right: Image, manner: str, message: str) -> None:
    with proxy(node, always(manner)) as url:
        with pytest.raises(ChainError, match=message) as error:
            render_frames([SCENE], RenderOptions(Nodes(url), tile=TILE))
        assert "\n" not in str(error.value)
        # with another one beside it, the picture is made
        notes = Notes()
        (image,) = render_frames([SCENE], RenderOptions(Nodes(url, node), tile=TILE, listener=notes))
    assert image.bmp == right.bmp
    assert all("it is left out" in warning for warning in notes.warnings)
    # whoever did nothing for it is not named
    assert not notes.warnings or image.made_by.startswith("node ")


@pytest.mark.parametrize("lie", range(LIES))
def test_a_lie_in_any_tile_is_found(node: str, spun: list[Image], lie: int) -> None:
    """Of a turntable of two frames in four tiles each. Alone it is an error that names node and tile; with another node
    beside it the tile is rendered there.
    """
    where = f"the tile of 64 x 16 pixels at (0, {lie % 4 * 16}) of frame {lie // 4}"
    with proxy(node, at(lie, "wrong")) as url:
        with pytest.raises(ChainError) as error:
            render_frames(SPIN, RenderOptions(Nodes(url), tile=(64, 16)))
        name = f"the node {url.removeprefix('http://')} "
        assert str(error.value).startswith(name)
        assert f"answers wrongly for {where}: its picture is not what the contracts draw" in str(error.value)
    notes = Notes()
    with proxy(node, at(lie // 2, "wrong")) as url:
        job = render_frames(SPIN, RenderOptions(Nodes(url, node), tile=(64, 16), listener=notes))
    assert [image.bmp for image in job] == [image.bmp for image in spun]
    for warning in notes.warnings:
        assert re.search("answers wrongly for the tile .*; it is left out, and 1 part is rendered again", warning)


def test_what_is_not_compared_may_be_wrong(node: str, spun: list[Image]) -> None:
    with proxy(node, at(3, "wrong")) as url:
        job = render_frames(SPIN, RenderOptions(Nodes(url, verify="none"), tile=(64, 16)))
    assert [job[n].bmp == spun[n].bmp for n in (0, 1)] == [False, True]


def test_a_large_picture_is_compared_in_samples(node: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """And that is told, unless it was asked for."""
    monkeypatch.setattr("shackled.parallel._job.COMPARED_GAS", 1)
    for verify, told in ((None, 1), ("some", 0), ("all", 0)):
        notes = Notes()
        render_frames([SCENE], RenderOptions(Nodes(node, verify=verify), tile=TILE, listener=notes))
        assert len(notes.warnings) == told
        assert all("`verify` all verifies every part" in warning for warning in notes.warnings)


def test_a_node_that_does_not_answer_in_time(node: str, right: Image) -> None:
    with proxy(node, always("stuck")) as url:
        (image,) = render_frames([SCENE], RenderOptions(Nodes(url, node, timeout=1.0), tile=TILE, listener=Notes()))
        assert image.bmp == right.bmp
    with proxy(node, always("stuck")) as url, pytest.raises(NodeError, match=r"did not answer within 0.2 seconds"):
        render_frames([evolve(SCENE, width=12, height=10)], RenderOptions(Nodes(url, timeout=0.2)))


def test_a_node_that_is_busy_at_first(node: str, right: Image) -> None:
    asked: list[str] = []

    def answer(request: dict[str, Any]) -> Reply:
        asked.append(request["method"])
        return Reply(status=429, headers={"Retry-After": "0"}) if len(asked) in (1, 2, 4) else forward(node, request)

    with serving(answer) as url:
        (image,) = render_frames([SCENE], RenderOptions(Nodes(url), tile=TILE))
    assert image.bmp == right.bmp


def test_a_wrong_address_is_told_before_anything_is_rendered(node: str) -> None:
    notes = Notes()
    for address, message in (
        (b"\x77" * 20, "^there is no contract at"),
        (PROXY, "^the contract at .* is not the rend"),
    ):
        with pytest.raises(ChainError, match=message):
            render_frames([SCENE], RenderOptions(Nodes(node, address=f"0x{address.hex()}"), tile=TILE, listener=notes))
    assert notes.outlines == 0


def test_answers_that_are_too_long(node: str, right: Image) -> None:
    """The picture is halved until it fits, and no further."""

    def answer(request: dict[str, Any]) -> Reply:
        reply = forward(node, request)
        return failure("response size exceeded", -32008) if len(reply.body) > 8000 else reply

    with serving(answer) as url:
        # 64 x 60 in halves of 30, 15, and 8 and 7 rows
        (image,) = render_frames([SCENE], RenderOptions(Nodes(url), tile=(64, 60)))
    assert image.bmp == right.bmp
    assert image.calls == 4


def test_a_node_that_caps_the_gas_of_a_call(node: str) -> None:
    scene = evolve(load("cube"), width=128, height=128)
    with geth(node, 1_500_000) as url:
        (image,) = render_frames([scene], RenderOptions(Nodes(url)))
    assert image.calls > 1
    assert image.bmp == open_chain().draw(scene).bmp


def test_a_node_with_little_gas(right: Image) -> None:
    with anvil("--gas-limit", "3000000") as little:
        (image,) = render_frames([SCENE], RenderOptions(Nodes(little.url)))
    assert image.bmp == right.bmp
    assert image.gas is None or image.gas >= (right.gas or 0)


def test_nodes_that_are_not_there(node: str, right: Image) -> None:
    gone = f"http://127.0.0.1:{free_port()}"
    notes = Notes()
    (image,) = render_frames([SCENE], RenderOptions(Nodes(gone, node), listener=notes))
    assert image.bmp == right.bmp
    assert len(notes.warnings) == 1
    assert "cannot be reached" in notes.warnings[0]
    with pytest.raises(NodeError, match="cannot be reached"):
        render_frames([SCENE], RenderOptions(Nodes(gone)))
