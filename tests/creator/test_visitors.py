"""Which visitors are remembered."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any, ClassVar, cast

import pytest

pytest.importorskip("starlette", reason="the page needs starlette")

from shackled.creator import ABSENCE, Facts, Pool, Source, State, Visitor, Visitors, live, to_link
from shackled.errors import InputError

SOURCE, OTHER = Source("piece", "cube"), Source("upload", "ab" * 32)


class KnowsCubes:
    """A pool that has no uploads."""

    def leave(self, visitor: str) -> None:
        pass

    async def open(self, source: Source) -> Facts:
        await asyncio.sleep(0)
        if source != SOURCE:
            raise InputError("it is not here")
        return cast(Facts, None)


def play(story: Callable[[Visitors], Awaitable[None]]) -> None:
    asyncio.run(cast(Any, story(Visitors(cast(Pool, KnowsCubes()), SOURCE))))


def test_names_differ_and_are_long() -> None:
    async def story(visitors: Visitors) -> None:
        names = {(await visitors.add()).name for _ in range(50)}
        assert len(names) == 50
        assert min(map(len, names)) >= 24
        assert visitors.find("") is None

    play(story)


def test_a_link_is_restored_or_its_error_shown() -> None:
    async def story(visitors: Visitors) -> None:
        assert (await visitors.add()).state == State(SOURCE)
        linked = await visitors.add(to_link(State(SOURCE, invert=True)))
        assert (linked.state.invert, linked.greeting, linked.wanted) == (True, "", None)
        for damaged in ("<script>", "1x", to_link(State(Source("piece", "no-such-piece")))):
            visitor = await visitors.add(damaged)
            assert visitor.state == State(SOURCE)
            assert visitor.greeting
            assert visitor.wanted is None
        absent = State(OTHER, invert=True)
        visitor = await visitors.add(to_link(absent))
        assert (visitor.state, visitor.wanted) == (State(SOURCE), absent)
        assert visitor.greeting == "it is not here, and the picture is restored"

    play(story)


def test_who_is_gone_makes_room(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.creator._web.live.MAX_VISITORS", 3)

    async def story(visitors: Visitors) -> None:
        first, *others = [await visitors.add() for _ in range(3)]
        for each in others:
            each._send = cast(Any, print)
        last = await visitors.add()
        assert visitors.find(first.name) is None
        assert visitors.find(others[0].name) is others[0]
        last._send = cast(Any, print)
        with pytest.raises(InputError, match="3 visitors"):
            await visitors.add()

    play(story)


def test_visitors_who_come_at_once_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.creator._web.live.MAX_VISITORS", 3)

    async def story(visitors: Visitors) -> None:
        async def come() -> bool:
            try:
                (await visitors.add())._send = cast(Any, print)
            except InputError:
                return False
            return True

        assert sum(await asyncio.gather(*(come() for _ in range(10)))) == 3

    play(story)


class StuckSocket:
    """A connection that takes nothing, and on which nothing comes."""

    query_params: ClassVar[dict[str, str]] = {}
    url = "ws://127.0.0.1/live"

    async def accept(self) -> None:
        pass

    async def send_text(self, text: str) -> None:
        await asyncio.Event().wait()

    async def receive_text(self) -> str:
        await asyncio.Event().wait()
        raise AssertionError


@pytest.mark.parametrize("joins", [True, False], ids=["joining", "later"])
def test_who_takes_nothing_is_disconnected(joins: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.creator._web.live.MAX_SENDING", 0.05)

    async def join(visitor: Visitor, send: Any) -> None:
        visitor._send = send
        if joins:
            await send({"note": "welcome"})

    monkeypatch.setattr(Visitor, "join", join)

    async def story(visitors: Visitors) -> None:
        connection = asyncio.create_task(live(cast(Any, StuckSocket()), visitors))
        await asyncio.sleep(0.01)
        (visitor,) = visitors._all.values()
        assert visitor.present
        await visitor.tell({"note": "hello"})
        await asyncio.wait_for(connection, 5)
        assert not visitor.present

    play(story)


def test_who_is_gone_for_long_is_forgotten() -> None:
    async def story(visitors: Visitors) -> None:
        gone, here, back = [await visitors.add() for _ in range(3)]
        here._send = cast(Any, print)
        for each in (gone, here):
            each.seen -= ABSENCE + 1
        for each in (gone, here, back):
            visitors.drop(each)
        assert visitors.find(gone.name) is None
        assert visitors.find(here.name) is here
        assert visitors.find(back.name) is back
        back.seen -= ABSENCE + 1
        await visitors.add()
        assert visitors.find(back.name) is None

    play(story)
