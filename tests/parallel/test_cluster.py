"""Workers of a dask cluster."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from attrs import evolve

from nodes import Reply, serving
from shackled import ChainError, Cluster, InputError, Processes, Scene, load
from shackled._on import Bounds
from shackled.chain import Drawing
from shackled.parallel import Listener, render_frames
from shackled.parallel._cluster import ClusterBackend
from shackled.scene import Rectangle, full_turn

pytest.importorskip("distributed")
SCENE = evolve(load("teapot"), width=48, height=48)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """A cluster of two workers that somebody else has started."""
    command = [sys.executable, "-m", "shackled.parallel._cluster", "2"]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        assert process.stdout is not None
        yield process.stdout.readline().strip()
        process.communicate(timeout=60)
    assert process.returncode == 0


def test_a_turntable_on_two_workers(address: str) -> None:
    frames = full_turn(SCENE, 36)
    there = render_frames(frames, Cluster(address))
    here = render_frames(frames)
    two = render_frames(frames, Processes(2))
    assert [image.bmp for image in there.images] == [image.bmp for image in here.images]
    assert [image.bmp for image in two.images] == [image.bmp for image in here.images]
    assert [image.gas for image in there.images] == [image.gas for image in here.images]
    assert len({image.bmp for image in here.images}) == 36
    assert there.images[0].made_by.endswith("2 workers")


def test_a_lie_of_a_cluster_is_found_if_it_is_asked_for(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its workers have our contracts: without being asked for, nothing is compared."""
    draw, tile = ClusterBackend.render, (48, 16)

    def lie(place: ClusterBackend, slot: int, scene: Scene, tile: Rectangle) -> Drawing:
        piece = draw(place, slot, scene, tile)
        return replace(piece, bmp=piece.bmp[:-1] + b"\x7f") if tile.y == 32 else piece

    monkeypatch.setattr(ClusterBackend, "render", lie)
    wrong = render_frames([SCENE], Cluster(address), Bounds(tile=tile))
    assert wrong.images[0].bmp != render_frames([SCENE], None, Bounds(tile=tile)).images[0].bmp
    with pytest.raises(ChainError, match=r"^the dask cluster.* wrongly for the tile of 48 x 16 .* \(0, 32\): its"):
        render_frames([SCENE], Cluster(address, verify="all"), Bounds(tile=tile))


def test_tiles_on_a_cluster_of_our_own() -> None:
    large = evolve(SCENE, width=100, height=100)
    job = render_frames([large], Cluster(jobs=2), Bounds(tile=(100, 9)))
    (image,) = render_frames([large]).images
    assert job.images[0].bmp == image.bmp
    assert (job.images[0].triangles, job.images[0].covered_pixels) == (image.triangles, image.covered_pixels)


def test_what_a_worker_says_is_told(address: str) -> None:
    with pytest.raises(ChainError, match=r"gas is not enough even for a tile of .*; raise `gas_limit`"):
        render_frames([SCENE], Cluster(address), Bounds(gas_limit=100_000))


def test_something_else_than_a_cluster() -> None:
    """Nothing but one line, and at once."""
    program = (
        "import sys; from shackled.cli.app import run; from shackled.parallel import _cluster; _cluster.PATIENCE = 2; "
        "sys.exit(run(['render', 'cube', '--size', '8', '--cluster', %r]))"
    )
    with serving(lambda request: Reply(b"?")) as url:
        for wrong in (url.replace("http", "tcp"), "nowhere:port"):
            told = subprocess.run([sys.executable, "-c", program % wrong], capture_output=True, text=True, timeout=60)
            assert told.returncode == 1
            assert told.stderr.startswith(f"shackled: no dask scheduler answers at {wrong}: ")
            assert told.stderr.count("\n") == 1


def test_a_cluster_that_goes_away(capfd: pytest.CaptureFixture[str]) -> None:
    command = [sys.executable, "-m", "shackled.parallel._cluster", "1"]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        assert process.stdout is not None
        address = process.stdout.readline().strip()

        class Breaker(Listener):
            def advanced(self, pixels: int) -> None:
                process.kill()

        with pytest.raises(ChainError, match=r"^the cluster failed: its scheduler cannot be reached any more; is it"):
            render_frames(full_turn(SCENE, 200), Cluster(address), listener=Breaker())
    # dask is quiet about it
    assert capfd.readouterr().err == ""


def test_a_cluster_that_is_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.parallel._cluster.PATIENCE", 1)
    with pytest.raises(ChainError, match=r"no dask scheduler answers at tcp://127.0.0.1:1: "):
        render_frames([SCENE], Cluster("tcp://127.0.0.1:1"))


class Workers:
    """A cluster whose workers say this of themselves."""

    def __init__(self, found: str | None) -> None:
        self.found = found

    def wait_for_workers(self, count: int, timeout: float) -> None:
        pass

    def run(self, function: Any) -> dict[str, Any]:
        return {"tcp://1.2.3.4:5": function(), "tcp://1.2.3.4:6": self.found}


@pytest.mark.parametrize(
    ("found", "message"),
    [
        (None, "the worker tcp://1.2.3.4:6 lacks shackled: pip install"),
        ("00" * 32, "the worker tcp://1.2.3.4:6 has other contracts: install the same version"),
    ],
)
def test_workers_that_do_not_fit(found: str | None, message: str) -> None:
    place = ClusterBackend.__new__(ClusterBackend)
    place._client = Workers(found)  # type: ignore[assignment]
    with pytest.raises(InputError, match=message):
        place._check()


def test_without_the_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'shackled\[cluster\]'"):
        render_frames([SCENE], Cluster())
