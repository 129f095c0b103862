"""Many visitors, few workers, and all that can go wrong with these."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager, suppress
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pytest
from PIL import Image as PillowImage

from nodes import anvil, needs_anvil
from shackled import ChainError, InputError, render
from shackled.creator import Limits, Pool, PoolError, Queue, Size, Source, State, Tasks, set_value, to_scene
from shackled.datasets import require
from shackled.gas import STAGES
from shackled.scene import full_turn
from strange_tasks import StrangeTasks

Result = TypeVar("Result")

TETRAHEDRON = State(Source("piece", "tetrahedron"), size=Size(32, 32))


@asynccontextmanager
async def queue(workers: int = 1, seconds: float = 20, grace: float = 0, waiting: int = 100) -> AsyncIterator[Queue]:
    """A queue whose workers can misbehave."""
    made = Queue("test", workers, Limits(waiting=waiting), seconds, grace, make_tasks=StrangeTasks)
    try:
        yield made
    finally:
        await made.close()
        assert made.processes == []


def with_queue(test: Callable[[Queue], Awaitable[None]], **settings: Any) -> None:
    async def run() -> None:
        async with queue(**settings) as made:
            await test(made)

    asyncio.run(asyncio.wait_for(run(), 60))


def with_pool(test: Callable[[Pool], Awaitable[Result]], limits: Limits | None = None, **settings: Any) -> Result:
    async def run() -> Result:
        async with Pool(1, limits, **settings) as pool:
            return await test(pool)

    return asyncio.run(asyncio.wait_for(run(), 120))


async def soon(condition: Callable[[], bool]) -> None:
    """Waits until something holds."""
    while not condition():
        await asyncio.sleep(0.005)


# ---- the line ----


def test_visitors_are_served_in_turn() -> None:
    async def test(line: Queue) -> None:
        done: list[str] = []

        async def ask(visitor: str, number: int) -> None:
            done.append(await line.ask(visitor, f"c{number}", "work", (0.01, f"{visitor}{number}")))

        tasks = [asyncio.create_task(ask("a", number)) for number in range(6)]
        await asyncio.sleep(0)
        tasks += [asyncio.create_task(ask(visitor, 0)) for visitor in "bcd"]
        await asyncio.gather(*tasks)
        assert set(done[:5]) >= {"b0", "c0", "d0"}
        assert done[-4:] == ["a2", "a3", "a4", "a5"]

    with_queue(test)


def test_who_asks_for_much_waits_longer() -> None:
    async def test(line: Queue) -> None:
        await line.warm()
        done: list[str] = []

        async def ask(visitor: str, count: int, seconds: float) -> None:
            for _ in range(count):
                done.append(await line.ask(visitor, "x", "work", (seconds, visitor)))

        await asyncio.gather(ask("heavy", 3, 0.5), ask("a", 8, 0.01), ask("b", 8, 0.01))
        assert done[0] == "heavy"
        assert sorted(done[1:17]) == ["a"] * 8 + ["b"] * 8

    with_queue(test)


def test_what_comes_to_nothing_counts_as_well() -> None:
    async def test(line: Queue) -> None:
        await line.warm()
        done: list[str] = []

        async def fail() -> None:
            for _ in range(2):
                with pytest.raises(PoolError):
                    await line.ask("bad", "x", "wait", (60, 0))
                done.append("bad")

        async def ask(visitor: str) -> None:
            for _ in range(8):
                done.append(await line.ask(visitor, "x", "work", (0.01, "good")))

        await asyncio.gather(fail(), ask("a"), ask("b"))
        assert done[0] == "bad"
        assert done[1:16] == ["good"] * 15

    with_queue(test, seconds=0.5)


def test_nobody_is_behind_for_long(monkeypatch: pytest.MonkeyPatch) -> None:
    """Who has had much waits for a bounded while, however little the others ask for."""
    monkeypatch.setattr("shackled.creator._queue.BEHIND", 0.1)

    async def test(line: Queue) -> None:
        await line.warm()
        done: list[str] = []

        async def ask(visitor: str, count: int, seconds: float) -> None:
            for _ in range(count):
                done.append(await line.ask(visitor, "x", "work", (seconds, visitor)))

        await asyncio.gather(ask("heavy", 2, 0.4), ask("a", 15, 0.02), ask("b", 15, 0.02))
        assert done[0] == "heavy"
        assert 3 <= done.index("heavy", 1) <= 20

    with_queue(test)


def test_who_stays_away_saves_nothing_up() -> None:
    async def test(line: Queue) -> None:
        for _ in range(3):
            await line.ask("a", "x", "work", (0.1, 0))
        done: list[str] = []

        async def ask(visitor: str) -> None:
            for _ in range(3):
                done.append(await line.ask(visitor, "x", "work", (0.05, visitor)))

        await asyncio.gather(ask("a"), ask("new"))
        assert done[:2] in (["a", "new"], ["new", "a"])
        assert "a" in done[:3]

    with_queue(test)


def test_the_newest_takes_the_place_of_what_waits() -> None:
    async def test(line: Queue) -> None:
        tasks = [asyncio.create_task(line.ask("a", "live", "wait", (0.1, number), newest=True)) for number in range(5)]
        other = asyncio.create_task(line.ask("b", "live", "wait", (0.0, "b"), newest=True))
        assert list(await asyncio.gather(*tasks)) == [0, None, None, None, 4]
        assert await other == "b"

    with_queue(test, grace=20)


def test_what_is_at_work_for_too_long_gives_way() -> None:
    async def test(line: Queue) -> None:
        first = asyncio.create_task(line.ask("a", "live", "wait", (30, "old"), newest=True))
        await soon(lambda: bool(line._running))
        assert await line.ask("a", "live", "wait", (0, "new"), newest=True) == "new"
        assert await first is None

    with_queue(test, grace=0.05)


def test_two_visitors_do_not_replace_each_other() -> None:
    async def test(line: Queue) -> None:
        asked = [line.ask(visitor, "live", "wait", (0.01, visitor), newest=True) for visitor in "abc"]
        assert await asyncio.gather(*asked) == ["a", "b", "c"]

    with_queue(test)


def test_a_visitor_who_leaves_frees_the_worker() -> None:
    async def test(line: Queue) -> None:
        running = asyncio.create_task(line.ask("a", "x", "wait", (30, 1)))
        waiting = asyncio.create_task(line.ask("a", "y", "wait", (30, 2)))
        other = asyncio.create_task(line.ask("b", "x", "wait", (0, 3)))
        await soon(lambda: bool(line._running))
        line.leave("a")
        line.leave("nobody")
        assert list(await asyncio.gather(running, waiting, other)) == [None, None, 3]

    with_queue(test)


def test_a_cancelled_wait_frees_the_worker() -> None:
    async def test(line: Queue) -> None:
        running = asyncio.create_task(line.ask("a", "x", "wait", (30, 1)))
        waiting = asyncio.create_task(line.ask("b", "x", "wait", (30, 2)))
        await soon(lambda: bool(line._running))
        for task in (waiting, running):
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task
        assert await line.ask("c", "x", "wait", (0, 3)) == 3
        assert not line._waiting

    with_queue(test)


def test_the_line_has_an_end() -> None:
    async def test(line: Queue) -> None:
        tasks = [asyncio.create_task(line.ask(f"v{number}", "x", "wait", (30, 0))) for number in range(4)]
        await asyncio.sleep(0)
        with pytest.raises(PoolError, match="too many visitors are waiting"):
            await line.ask("late", "x", "wait", (0, 0))
        for number in range(4):
            line.leave(f"v{number}")
        await asyncio.gather(*tasks)

    with_queue(test, waiting=3)


def test_one_visitor_does_not_fill_the_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.creator._queue.MAX_OF_ONE", 3)

    async def test(line: Queue) -> None:
        tasks = [asyncio.create_task(line.ask("a", f"x{number}", "wait", (30, 0))) for number in range(4)]
        await asyncio.sleep(0)
        with pytest.raises(PoolError, match="too many of your requests"):
            await line.ask("a", "y", "wait", (0, 0))
        other = asyncio.create_task(line.ask("b", "x", "wait", (0, 7)))
        await asyncio.sleep(0)
        line.leave("a")
        assert await other == 7
        await asyncio.gather(*tasks)

    with_queue(test)


# ---- workers that fail ----


@pytest.mark.parametrize(
    ("task", "arguments", "message"),
    [
        ("vanish", (), "the worker process of the test ended"),
        ("eat", (), "the test needs more memory than the limit"),
        ("stumble", (), r"the test failed with an internal error \(ZeroDivisionError\)"),
    ],
)
def test_a_worker_that_fails_costs_one_error(task: str, arguments: tuple[Any, ...], message: str) -> None:
    async def test(line: Queue) -> None:
        for _ in range(2):
            with pytest.raises(PoolError, match=message) as error:
                await line.ask("a", "x", task, arguments)
            assert "secret" not in str(error.value)
        assert await line.ask("a", "x", "wait", (0, "well")) == "well"

    with_queue(test)


def test_a_worker_that_hangs_is_replaced() -> None:
    async def test(line: Queue) -> None:
        await line.warm()
        with pytest.raises(PoolError, match="the test took longer than the limit of 0\\.5 seconds"):
            await line.ask("a", "x", "wait", (60, 0))
        assert await line.ask("a", "x", "pid", ()) in line.processes

    with_queue(test, seconds=0.5)


def test_a_worker_that_ended_while_idle_is_not_missed() -> None:
    async def test(line: Queue) -> None:
        pid = await line.ask("a", "x", "pid", ())
        os.kill(pid, signal.SIGKILL)
        assert await line.ask("a", "x", "pid", ()) != pid

    with_queue(test)


def test_progress_is_told_in_order() -> None:
    async def test(line: Queue) -> None:
        told: list[tuple[int, int]] = []
        assert await line.ask("a", "x", "count", (5,), progress=lambda *each: told.append(each)) == "counted"
        await soon(lambda: len(told) == 5)
        assert told == [(number, 5) for number in range(1, 6)]

    with_queue(test)


def test_after_the_end_nothing_is_begun() -> None:
    async def test() -> None:
        async with queue() as line:
            busy = asyncio.create_task(line.ask("a", "x", "wait", (30, 0)))
            await soon(lambda: bool(line._running))
        assert await busy is None
        with pytest.raises(PoolError, match="being closed"):
            await line.ask("a", "x", "wait", (0, 0))

    asyncio.run(asyncio.wait_for(test(), 30))


# ---- pictures ----


def test_a_picture_is_that_of_the_command_line() -> None:
    async def test(pool: Pool) -> None:
        facts = await pool.open(TETRAHEDRON.source)
        state = set_value(TETRAHEDRON, facts, "camera.azimuth", 100)
        image = render(to_scene(state, require("tetrahedron").make()))
        frame = await pool.render("a", state)
        assert frame is not None
        assert frame.bmp == image.bmp
        assert (frame.gas, frame.intrinsic_gas) == (image.gas, image.intrinsic_gas)
        assert (frame.triangles, frame.lit_pixels) == (image.triangles, image.covered_pixels)
        assert (np.asarray(PillowImage.open(BytesIO(frame.png))) == image.pixels).all()
        assert all(fit.fits for fit in frame.fits)
        quick = await pool.render("a", replace(state, size=Size(64, 32)), longest=16, count=False)
        assert quick is not None
        assert (quick.width, quick.height, quick.triangles) == (16, 8, None)

    with_pool(test)


def test_of_a_picture_that_passes_by_no_file_is_made(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*arguments: Any, **settings: Any) -> None:
        raise AssertionError("it is shown as it came")

    tasks = Tasks(Limits(), lambda done, total: None)
    monkeypatch.setattr(PillowImage.Image, "save", fail)
    monkeypatch.setattr("hashlib.sha256", fail)
    frame = tasks.picture(TETRAHEDRON, 16, count=False)
    assert frame.bmp.startswith(b"BM")


def test_a_large_picture_does_not_stand_in_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.creator._pool.LARGE", 100 * 100)

    async def test(pool: Pool) -> None:
        large = replace(TETRAHEDRON, size=Size(200, 100))
        frame = await pool.render("a", large)
        assert frame is not None
        assert (frame.width, frame.height) == (200, 100)
        assert len(pool._slow.processes) == 1
        # a newer one, of another size, takes its place
        old = asyncio.create_task(pool.render("a", replace(TETRAHEDRON, size=Size(1024, 1024))))
        await soon(lambda: bool(pool._slow._running))
        new = await pool.render("a", large, longest=50)
        assert new is not None
        assert new.width == 50
        assert await old is None

    with_pool(test)


def test_what_is_wrong_is_said() -> None:
    async def test(pool: Pool) -> None:
        with pytest.raises(InputError, match="there is no piece 'teapott'; did you mean teapot"):
            await pool.render("a", State(Source("piece", "teapott")))
        with pytest.raises(InputError, match="is not in the memory of this server: open it again"):
            await pool.render("a", State(Source("upload", "ab" * 32)))
        with pytest.raises(ChainError, match="ran out of gas: 100,000 gas is not enough"):
            await pool.render("a", TETRAHEDRON)
        with pytest.raises(InputError, match="no node to compare with"):
            await pool.compare("a", TETRAHEDRON)
        with pytest.raises(InputError, match="a GIF has 2 to 120 frames, not 1"):
            await pool.turntable("a", TETRAHEDRON, frames=1)
        with pytest.raises(InputError, match="the GIF would have 125,829,120 pixels"):
            await pool.turntable("a", replace(TETRAHEDRON, size=Size(1024, 1024)), frames=120)

    with_pool(test, Limits(gas=100_000))


def test_a_turntable_goes_round() -> None:
    async def test(pool: Pool) -> None:
        told: list[tuple[int, int]] = []
        film = await pool.turntable("a", TETRAHEDRON, 4, 50, scale=2, progress=lambda *each: told.append(each))
        assert told == [(0, 4), (1, 4), (2, 4), (3, 4), (4, 4)]
        with PillowImage.open(BytesIO(film)) as picture:
            assert picture.n_frames == 4  # type: ignore[attr-defined]
            assert picture.size == (64, 64)
            assert picture.info["loop"] == 0
            frames = []
            for number in range(4):
                picture.seek(number)
                frames.append(np.asarray(picture.convert("RGB")).astype(int))
        turned = full_turn(to_scene(TETRAHEDRON, require("tetrahedron").make()), 4)
        for frame, scene in zip(frames, turned, strict=True):
            assert np.abs(frame - render(scene).pixels.repeat(2, axis=0).repeat(2, axis=1)).mean() < 3
        assert np.abs(frames[0] - frames[1]).mean() > 3

    with_pool(test)


def test_a_turntable_can_be_cancelled() -> None:
    async def test(pool: Pool) -> None:
        told: list[int] = []
        state = replace(TETRAHEDRON, size=Size(128, 128))
        film = asyncio.create_task(pool.turntable("a", state, 100, progress=lambda done, _: told.append(done)))
        await soon(lambda: len(told) > 2)
        film.cancel()
        with pytest.raises(asyncio.CancelledError):
            await film
        seen = len(told)
        assert await pool.render("a", TETRAHEDRON) is not None
        assert await pool.turntable("b", TETRAHEDRON, 2)
        assert len(told) == seen < 100

    with_pool(test)


def test_stages_and_their_gas() -> None:
    async def test(pool: Pool) -> None:
        stages = await pool.stages("a", TETRAHEDRON)
        gas = await pool.stage_gas("a", TETRAHEDRON)
        frame = await pool.render("a", TETRAHEDRON)
        assert frame is not None
        assert [stage.name[0] for stage in stages] == list("123456")
        assert (np.asarray(PillowImage.open(BytesIO(stages[5].png))) == PillowImage.open(BytesIO(frame.png))).all()
        assert tuple(gas) == STAGES
        assert sum(gas.values()) == frame.gas

    with_pool(test)


def test_workers_end_with_their_parent(tmp_path: Any) -> None:
    """However it ends."""
    (tmp_path / "parent.py").write_text(
        "import asyncio, os, signal\n"
        "from shackled.creator import Pool\n"
        "async def main():\n"
        "    async with Pool(2) as pool:\n"
        "        print(*pool._live.processes, flush=True)\n"
        "        os.kill(os.getpid(), signal.SIGKILL)\n"
        "if __name__ == '__main__':\n"
        "    asyncio.run(main())\n"
    )
    ended = subprocess.run([sys.executable, tmp_path / "parent.py"], check=False, capture_output=True, text=True)
    pids = [int(word) for word in ended.stdout.split()]
    assert len(pids) == 2
    deadline = time.monotonic() + 20
    while any(map(is_running, pids)) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not any(map(is_running, pids))


def is_running(pid: int) -> bool:
    try:
        return "\nState:\tZ" not in Path(f"/proc/{pid}/status").read_text()
    except (FileNotFoundError, ProcessLookupError):
        return False


def test_files_to_take_away() -> None:
    async def test(pool: Pool) -> None:
        data = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
        upload = await pool.upload("a", "one.obj", data)
        state = State(upload.source, size=Size(16, 16))
        frame = await pool.render("a", state)
        assert frame is not None
        assert (await pool.take("a", state, "bmp")).data == frame.bmp
        assert (await pool.take("a", state, "file")).data == data
        program = (await pool.take("a", state, "python", link="http://a/\nb")).data.decode()
        assert program.startswith("# http://a/ b\nimport hashlib\n")
        assert 'shackled.load("one.obj")' in program
        with pytest.raises(InputError, match="no download of the kind 'x'"):
            await pool.take("a", state, "x")
        taking = asyncio.create_task(pool.take("b", state, "solidity"))
        await asyncio.sleep(0)
        pool.leave("b")
        with pytest.raises(PoolError, match="the job was dropped"):
            await taking

    with_pool(test)


@needs_anvil
def test_the_picture_of_a_node_is_compared() -> None:
    async def test(pool: Pool) -> None:
        assert pool.has_node
        comparison = await pool.compare("a", TETRAHEDRON)
        assert comparison.same
        assert comparison.node.startswith("node 127.0.0.1")
        assert comparison.seconds > 0

    with anvil() as node:
        with_pool(test, node=node.url)
    with pytest.raises(ChainError, match=r"127\.0\.0\.1"):
        with_pool(test, node=node.url)


def test_a_thumbnail(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SHACKLED_CACHE", str(tmp_path))

    async def test(pool: Pool) -> bytes:
        return await pool.thumbnail("icons/coin")

    png = with_pool(test)
    assert (np.asarray(PillowImage.open(BytesIO(png))) == render(require("icons/coin").make()).pixels).all()


def test_an_upload_reaches_workers_that_never_saw_it() -> None:
    async def test(pool: Pool) -> None:
        upload = await pool.upload("a", "one.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        state = State(upload.source, size=Size(16, 16))
        first = await pool.render("a", state)
        os.kill(pool._live.processes[0], signal.SIGKILL)
        second = await pool.render("b", state)
        assert first is not None
        assert second is not None
        assert first.bmp == second.bmp
        assert await pool.stages("a", state)

    with_pool(test)
