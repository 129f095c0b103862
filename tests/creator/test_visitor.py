"""What a visitor is sent, by a pool that the test holds in its hands."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Coroutine
from dataclasses import dataclass, field
from typing import Any, cast

import pytest

pytest.importorskip("starlette", reason="the page needs starlette")

from shackled.creator import ACTIONS, DRAFT, KEYS, Facts, Frame, Pool, Reveal, Source, State, Visitor, act, describe
from shackled.datasets import require
from shackled.errors import InputError, RenderError

SOURCE = Source("piece", "icons/diamond")


def facts_of(source: Source) -> Facts:
    return describe(source, require(source.name).make(), source.name)


@dataclass
class Asked:
    state: State
    longest: int | None
    answer: asyncio.Future[Frame | None]


@dataclass
class SlowPool:
    """Answers when the test says so. asked: pictures that are wanted, without those of the looks."""

    asked: list[Asked] = field(default_factory=list)
    left: list[str] = field(default_factory=list)
    absent: set[Source] = field(default_factory=set)

    async def render(self, visitor: str, state: State, longest: int | None = None, count: bool = True) -> Frame | None:
        if visitor.endswith("looks"):
            return None
        self.asked.append(Asked(state, longest, asyncio.get_running_loop().create_future()))
        return await self.asked[-1].answer

    async def open(self, source: Source, visitor: str = "") -> Facts:
        if source in self.absent:
            raise InputError("it is not here")
        return facts_of(source)

    def leave(self, visitor: str) -> None:
        self.left.append(visitor)


def frame(side: int = 8) -> Frame:
    return Frame(b"bmp", side, side, 1_234_567, 21_000, 3, 40, 500, 0.01, ())


class Page:
    """What was sent to the page."""

    def __init__(self) -> None:
        self.messages: list[dict[str, Any]] = []
        self.pictures: list[dict[str, Any]] = []

    async def send(self, message: dict[str, Any] | bytes) -> None:
        if isinstance(message, bytes):
            length = int.from_bytes(message[:4], "big")
            self.pictures.append(json.loads(message[4 : 4 + length]))
            assert message[4 + length :] == b"bmp"
        else:
            self.messages.append(message)

    def said(self, kind: str) -> list[Any]:
        return [message[kind] for message in self.messages if kind in message]


async def turn() -> None:
    for _ in range(10):
        await asyncio.sleep(0)


def play(story: Any, source: Source = SOURCE) -> None:
    async def run() -> None:
        pool, page = SlowPool(), Page()
        visitor = Visitor("v", cast(Pool, pool), State(source), facts_of(source))
        await visitor.join(page.send)
        await turn()
        await cast(Coroutine[Any, Any, None], story(visitor, pool, page))
        visitor.leave(page.send)

    asyncio.run(run())


async def answer(asked: Asked, picture: Frame | None = None) -> None:
    asked.answer.set_result(picture or frame())
    await turn()


ORBIT = {"do": "orbit", "x": 0.1, "y": 0.0}


def test_who_joins_is_sent_everything() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        first = page.messages[0]
        assert first["values"]["camera.azimuth"]["changed"] is False
        assert first["link"].startswith("/?p=")
        assert first["attributes"]["undo"] == {"disabled": ""}
        await answer(pool.asked[0])
        assert page.pictures[0]["draft"] is False
        assert page.pictures[0]["show"]["texts"]["gas"] == "1,234,567"

    play(story)


CAMERA = {"do": "camera", "azimuth": 200.0, "elevation": 99, "distance": 4.5, "target": [0.1, 0, 0], "stamp": 3}


def test_a_movement_that_the_page_drew_is_one_picture_and_one_step() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        await answer(pool.asked[0])
        before = visitor.state
        await act(visitor, CAMERA)
        await turn()
        assert [each.longest for each in pool.asked] == [None, None]
        camera = visitor.state.camera
        assert camera is not None
        assert (camera.azimuth, camera.elevation, camera.distance, camera.target) == (-160, 90, 4.5, (0.1, 0, 0))
        await answer(pool.asked[1])
        first, second = (each["view"] for each in page.pictures)
        assert (first["stamp"], second["stamp"]) == (0, 3)
        assert first["key"] == second["key"]
        assert second["camera"]["distance"] == 4.5
        await act(visitor, {"do": "undo"})
        assert visitor.state == before

    play(story)


def test_another_scene_has_another_key() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        keys = [visitor.view["key"]]
        for path, value in (("camera.roll", 20), ("surface.color", "#123456"), ("lights_follow", True)):
            await act(visitor, {"do": "put", "path": path, "value": value})
            keys.append(visitor.view["key"])
        assert len(set(keys)) == 4

    play(story)


@pytest.mark.parametrize(
    "wrong",
    [
        {"target": [1, 2]},
        {"target": None},
        {"target": [0, "1", 0]},
        {"distance": None},
        {"azimuth": 1e400},
        {"stamp": "x"},
    ],
)
def test_a_wrong_camera_changes_nothing(wrong: dict[str, Any]) -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        before = visitor.state
        await act(visitor, CAMERA | wrong)
        assert visitor.state == before
        assert page.said("alert")

    play(story)


def test_of_many_movements_the_last_is_drawn() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        await answer(pool.asked[0])
        for _ in range(20):
            await act(visitor, ORBIT)
            await turn()
        assert len(pool.asked) == 2
        await answer(pool.asked[1])
        assert len(pool.asked) == 3
        assert pool.asked[2].state == visitor.state
        assert all(each.longest is not None for each in pool.asked[1:])
        await answer(pool.asked[2])
        assert len(pool.asked) == 3
        assert [each["moves"] for each in page.pictures] == [0, 1, 20]

    play(story)


def test_when_it_rests_it_is_drawn_in_full() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        await answer(pool.asked[0])
        await act(visitor, ORBIT)
        await turn()
        await act(visitor, {"do": "rest"})
        await answer(pool.asked[1])
        assert pool.asked[2].longest is None
        assert pool.asked[2].state == visitor.state
        await answer(pool.asked[2])
        assert [each["draft"] for each in page.pictures] == [False, True, False]

    play(story)


def test_it_rests_by_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.creator._web.visitor.REST", 0.01)

    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        await answer(pool.asked[0])
        await act(visitor, ORBIT)
        await turn()
        await answer(pool.asked[1])
        await asyncio.sleep(0.05)
        assert pool.asked[-1].longest is None

    play(story)


def test_a_full_picture_gives_way_to_a_movement() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        await act(visitor, ORBIT)  # the first picture is still in work
        await turn()
        assert pool.asked[1].longest == DRAFT
        await answer(pool.asked[0])  # too late
        assert page.pictures == []
        await answer(pool.asked[1])
        assert len(page.pictures) == 1

    play(story)


def test_a_drag_is_one_step_of_undo() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        before = visitor.state
        for _ in range(5):
            await act(visitor, ORBIT)
        await act(visitor, {"do": "rest"})
        await act(visitor, ORBIT)
        await act(visitor, {"do": "undo"})
        await act(visitor, {"do": "undo"})
        assert visitor.state == before
        assert not visitor.history.can_undo

    play(story)


def test_what_is_not_here_any_more_is_not_undone() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        await act(visitor, {"do": "piece", "name": "icons/heart"})
        now = visitor.state
        pool.absent.add(SOURCE)
        await act(visitor, {"do": "undo"})
        assert page.said("alert") == ["it is not here"]
        assert visitor.state == now
        assert visitor.facts.source == now.source
        pool.absent.clear()
        await act(visitor, {"do": "undo"})
        assert visitor.state == State(SOURCE)

    play(story)


def test_what_a_contract_refuses_is_told() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        pool.asked[0].answer.set_exception(RenderError("too much gas"))
        await turn()
        assert page.said("alert") == ["too much gas"]
        await act(visitor, {"do": "cycle", "path": "invert"})
        await turn()
        await answer(pool.asked[1])
        assert len(page.pictures) == 1

    play(story)


def test_who_leaves_is_drawn_nothing() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        visitor.leave(page.send)
        assert "v" in pool.left
        await act(visitor, ORBIT)
        await turn()
        assert len(pool.asked) == 1
        assert page.pictures == []

    play(story)


@pytest.mark.parametrize(
    "message",
    [
        None,
        [],
        "orbit",
        {},
        {"do": None},
        {"do": ["orbit"]},
        {"do": "nothing"},
        {"do": "orbit"},
        {"do": "orbit", "x": float("nan"), "y": 0},
        {"do": "orbit", "x": "1", "y": 0},
        {"do": "orbit", "x": True, "y": 0},
        {"do": "put", "path": "camera.azimuth", "value": 10**400},
        {"do": "put", "path": "lights.0.azimuth", "value": -(10**400)},
        {"do": "put"},
        {"do": "put", "path": "camera.fov", "value": "wide"},
        {"do": "put", "path": "camera.fov", "value": None},
        {"do": "put", "path": "camera.fov", "value": [1]},
        {"do": "put", "path": "camera.projection", "value": "oblique"},
        {"do": "put", "path": "surface.color", "value": "red"},
        {"do": "put", "path": "lights.3.azimuth", "value": 1},
        {"do": "put", "path": "source", "value": 1},
        {"do": "put", "path": "__class__", "value": 1},
        {"do": "lamp", "number": 9, "x": 0, "y": 0},
        {"do": "remove-lamp", "number": -1},
        {"do": "reset", "path": "nothing"},
        {"do": "reset-group", "group": "nothing"},
        {"do": "look", "name": "nothing"},
        {"do": "piece", "name": "../../etc/passwd"},
        {"do": "piece", "name": 7},
        {"do": "seed", "text": "<script>"},
        {"do": "size", "side": -3},
        {"do": "cycle", "path": "camera.fov"},
        {"do": "cycle", "path": "lights.3.kind"},
        {"do": "gif", "frames": None, "scale": 1},
        {"do": "mint", "wallet": 0},
        {"do": "wallets", "names": [1]},
        {"do": "answer", "id": [], "result": 1},
    ],
)
def test_what_strangers_send_changes_nothing(message: object) -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        before = visitor.state
        await act(visitor, message)
        assert visitor.state == before
        assert all("\n" not in words for words in page.said("alert"))

    play(story)


@pytest.mark.parametrize(
    "message",
    [
        {"do": "orbit", "x": 10**400, "y": -(10**400)},
        {"do": "zoom", "notches": 10**400},
        {"do": "put", "path": "camera.fov", "value": 10**400},
        {"do": "put", "path": "camera.target.x", "value": -(10**400)},
    ],
)
def test_a_number_of_400_digits_counts_as_the_largest(message: dict[str, Any]) -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        before = visitor.state
        await act(visitor, message)
        assert page.said("alert") == []
        assert visitor.state != before

    play(story)


def test_where_objects_differ_no_value_is_shown_as_theirs() -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        await turn()
        first = visitor.facts.defaults.surface.shading
        assert page.said("values")[0]["surface.shading"] == {"value": first, "changed": False, "mixed": True}
        await answer(pool.asked[0])
        await act(visitor, {"do": "put", "path": "surface.shading", "value": first})
        await turn()
        await answer(pool.asked[1])
        # that of the first object is another picture, for the others had another one
        assert page.pictures[-1]["show"]["values"]["surface.shading"] == {"value": first, "changed": True}
        await act(visitor, {"do": "reset", "path": "surface.shading"})
        await turn()
        await answer(pool.asked[2])
        assert page.pictures[-1]["show"]["values"]["surface.shading"]["mixed"] is True

    play(story, Source("piece", "icons/coin"))


MINT = {"do": "mint", "wallet": 0}


def at_the_wallet(visitor: Visitor, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Whoever mints asks the wallet for a transaction, and for nothing else; the outcomes."""
    outcomes: list[str] = []

    async def mint(offer: Any, wallet: Any, tell: Any) -> str:
        outcomes.append(await wallet.request("eth_sendTransaction", {}))
        return "Minted"

    monkeypatch.setattr("shackled.creator._web.dialogs.mint", mint)
    monkeypatch.setattr("shackled.creator._web.actions.offer_of", lambda source: object())
    visitor.wallets = ["Toy"]
    return outcomes


def test_one_request_to_a_wallet_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        outcomes = at_the_wallet(visitor, monkeypatch)
        for _ in range(3):
            await act(visitor, MINT)
            await turn()
        (question,) = page.said("wallet")
        assert len(page.said("alert")) == 2
        assert "a token is being minted" in page.said("alert")[0]
        await act(visitor, {"do": "answer", "id": question["id"], "result": "0x1"})
        await turn()
        assert outcomes == ["0x1"]
        await act(visitor, MINT)  # and another one after it
        await turn()
        assert len(page.said("wallet")) == 2

    play(story)


def test_what_a_wallet_was_asked_outlives_the_wire(monkeypatch: pytest.MonkeyPatch) -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        outcomes = at_the_wallet(visitor, monkeypatch)
        await act(visitor, MINT)
        await turn()
        (question,) = page.said("wallet")
        visitor.leave(page.send)
        await turn()
        again = Page()
        await visitor.join(again.send)
        await act(visitor, MINT)
        assert "a token is being minted" in again.said("alert")[0]
        assert again.said("wallet") == [question]  # of the same number: the page asks its wallet but once
        await act(visitor, {"do": "answer", "id": question["id"], "result": "0x2"})
        await turn()
        assert outcomes == ["0x2"]
        visitor.leave(again.send)

    play(story)


def test_a_reveal_is_sent_once(monkeypatch: pytest.MonkeyPatch) -> None:
    look = {"do": "reveal", "wallet": 0, "fields": {"collection": "0x" + "c0" * 20}}

    async def found(address: str, wallet: Any, number: int, tell: Any) -> Reveal:
        return Reveal(number, 1, address, (), (), b"data", 95_000, "")

    async def sent(reveal: Reveal, wallet: Any, tell: Any) -> str:
        return str(await wallet.request("eth_sendTransaction", {}))

    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        await act(visitor, {"do": "reveal-send"})
        await act(visitor, look)
        said = page.said("alert")
        assert [words.partition(":")[0] for words in said] == [
            "there is no transaction to send",
            "there is no such wallet",
        ]
        await act(visitor, {"do": "wallets", "names": ["Toy"]})
        await act(visitor, look)
        await turn()
        assert visitor.status["reveal"].startswith("Ready: the transaction below reveals")
        await act(visitor, {"do": "wallets", "names": []})  # what a page says it has may change
        await act(visitor, {"do": "reveal-send"})
        await turn()
        for message in ({"do": "reveal-send"}, look | {"wallet": 0}):
            visitor.wallets = ["Toy"]
            await act(visitor, message)
            assert "tokens are being revealed: answer in your wallet" in page.said("alert")[-1]
        (question,) = page.said("wallet")
        await act(visitor, {"do": "answer", "id": question["id"], "result": "Revealed"})
        await turn()
        assert visitor.status["reveal"] == "Revealed"
        assert visitor.reveal is None

    monkeypatch.setattr("shackled.creator._web.dialogs.find_reveal", found)
    monkeypatch.setattr("shackled.creator._web.dialogs.send_reveal", sent)
    play(story)


def test_every_key_does_something_that_there_is() -> None:
    for key in KEYS:
        assert "open" in key.does or key.does["do"] in ACTIONS
    names = [name for key in KEYS for name in key.names]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("key", [key for key in KEYS if key.does.get("do") not in (None, "stages", "takeaway", "node")])
def test_every_key_is_understood(key: Any) -> None:
    async def story(visitor: Visitor, pool: SlowPool, page: Page) -> None:
        await act(visitor, key.does)
        assert page.said("alert") == []

    play(story)
