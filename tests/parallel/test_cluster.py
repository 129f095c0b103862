"""Workers of a dask cluster."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from attrs import evolve
from tools.cluster import cluster

from nodes import Reply, serving
from shackled import ChainError, Cluster, InputError, Scene, load
from shackled._on import Bounds
from shackled.chain import Drawing
from shackled.parallel import Listener, render_frames
from shackled.parallel._cluster import ClusterBackend
from shackled.scene import Rectangle, full_turn

pytest.importorskip("distributed")
SCENE = evolve(load("teapot"), width=48, height=48)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """A cluster of two workers."""
    with cluster(2) as (found, process):
        yield found
    assert process.returncode == 0


def test_a_turntable_on_two_workers(address: str) -> None:
    frames = full_turn(SCENE, 36)
    there, here = render_frames(frames, Cluster(address)), render_frames(frames)
    assert there == [evolve(image, made_by=there[0].made_by) for image in here]
    assert there[0].made_by.endswith("2 workers")


def test_tiles(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Workers have our contracts, so a lie is found only if that is asked for."""
    draw, where = ClusterBackend.render, Bounds(tile=(48, 16))
    right = render_frames([SCENE])[0].bmp
    assert render_frames([SCENE], Cluster(address), where)[0].bmp == right

    def lie(place: ClusterBackend, scene: Scene, tile: Rectangle) -> Drawing:
        piece = draw(place, scene, tile)
        return replace(piece, bmp=piece.bmp[:-1] + b"\x7f") if tile.y == 32 else piece

    monkeypatch.setattr(ClusterBackend, "render", lie)
    assert render_frames([SCENE], Cluster(address), where)[0].bmp != right
    with pytest.raises(ChainError, match=r"^the dask cluster.* wrongly for the tile of 48 x 16 .* \(0, 32\): its"):
        render_frames([SCENE], Cluster(address, verify="all"), where)


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
        for wrong in (url.replace("http", "tcp"), "nowhere:port", "tcp://127.0.0.1:1"):
            told = subprocess.run([sys.executable, "-c", program % wrong], capture_output=True, text=True, timeout=60)
            assert told.returncode == 1
            assert told.stderr.startswith(f"shackled: no dask scheduler answers at {wrong}: ")
            assert told.stderr.count("\n") == 1


def test_a_cluster_that_goes_away(capfd: pytest.CaptureFixture[str]) -> None:
    class Breaker(Listener):
        def advanced(self, pixels: int) -> None:
            process.kill()

    with cluster(1) as (address, process):
        with pytest.raises(ChainError, match=r"^the cluster failed: its scheduler cannot be reached any more; is it"):
            render_frames(full_turn(SCENE, 200), Cluster(address), listener=Breaker())
        # dask is quiet about it
        assert capfd.readouterr().err == ""


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
        place._greet_workers()


def test_without_the_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'shackled\[cluster\]'"):
        render_frames([SCENE], Cluster("tcp://127.0.0.1:1"))
