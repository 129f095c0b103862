"""Workers of a dask cluster."""

from __future__ import annotations

import json
import re
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import trimesh
from attrs import evolve
from tools.children import child
from tools.cluster import cluster

from nodes import Reply, serving
from shackled import ChainError, Cluster, InputError, Scene, load
from shackled.chain._chain import Drawing
from shackled.cli.app import run
from shackled.parallel import Listener, _cluster
from shackled.parallel._cluster import ClusterBackend
from shackled.parallel._job import render_frames
from shackled.parallel.places import RenderOptions
from shackled.scene._codec import Rectangle
from shackled.scene._turning import full_turn

Client = pytest.importorskip("distributed").Client
SCENE = evolve(load("teapot"), width=48, height=48)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """A cluster of two workers."""
    with cluster(2) as (found, process):
        yield found
    assert process.returncode == 0


def test_a_turntable_on_two_workers(address: str) -> None:
    frames = full_turn(SCENE, 36)
    there, here = render_frames(frames, RenderOptions(Cluster(address))), render_frames(frames)
    assert there == [evolve(image, made_by=there[0].made_by) for image in here]
    assert there[0].made_by.endswith("2 workers")


def test_tiles(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Workers have our contracts, so a lie is found only if that is asked for."""
    draw, where = ClusterBackend.render, RenderOptions(Cluster(address), tile=(48, 16))
    right = render_frames([SCENE])[0].bmp
    assert render_frames([SCENE], where)[0].bmp == right

    def lie(place: ClusterBackend, scene: Scene, tile: Rectangle) -> Drawing:
        piece = draw(place, scene, tile)
        return replace(piece, bmp=piece.bmp[:-1] + b"\x7f") if tile.y == 32 else piece

    monkeypatch.setattr(ClusterBackend, "render", lie)
    assert render_frames([SCENE], where)[0].bmp != right
    with pytest.raises(ChainError, match=r"^the dask cluster.* wrongly for the tile of 48 x 16 .* \(0, 32\): its"):
        render_frames([SCENE], evolve(where, on=Cluster(address, verify="all")))


def test_a_folder_is_drawn_in_whole_inputs(address: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """For the same gas as here; one that fails does not stop the others."""
    for number in range(5):
        trimesh.creation.icosphere(subdivisions=1, radius=1 + number).export(tmp_path / f"{number}.stl")
    (tmp_path / "bad.obj").write_text("nothing")
    command = ["render", str(tmp_path), "--size", "64", "--json"]
    reports = []
    for where in ("", "--cluster"):
        assert run([*command, "-o", f"{tmp_path}/out{where}/", *([where, address] if where else [])]) == 1
        said = capsys.readouterr()
        reports.append({each["input"]: each for each in map(json.loads, said.out.splitlines())})
        assert "5 rendered, 1 failed, in " in said.err
    here, there = reports
    assert len(here) == 6
    for name in here:
        for same in ("sha256", "gas", "intrinsic_gas", "calls", "triangles", "lit_pixels", "fits", "error"):
            assert here[name].get(same) == there[name].get(same)
    assert there[str(tmp_path / "0.stl")]["chain"].endswith(", 2 workers")
    assert run([*command, "-o", f"{tmp_path}/out--cluster/", "--skip-existing", "--cluster", address]) == 1
    assert "0 rendered, 5 skipped, 1 failed, in " in capsys.readouterr().err


def test_the_gas_of_tiles_says_so(address: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One picture is shared among the workers."""
    assert run(["render", "teapot", "--size", "64", "-o", f"{tmp_path}/x.png", "--cluster", address]) == 0
    calls = re.search(r"\ngas +[\d,]+ in (\d+) calls \(and", capsys.readouterr().out)
    assert calls is not None
    assert int(calls[1]) > 1


def dask(kind: str, *arguments: str) -> AbstractContextManager[subprocess.Popen[str]]:
    command = (sys.executable, "-m", f"distributed.cli.dask_{kind}", "--no-dashboard", *arguments)
    return child(*command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


@pytest.fixture(scope="module")
def scheduler() -> Iterator[str]:
    """The address of a scheduler without workers."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        host, port = free.getsockname()
    with dask("scheduler", "--host", host, "--port", str(port)):
        yield f"tcp://{host}:{port}"


@pytest.mark.parametrize("is_folder", [False, True])
def test_workers_that_are_lost(
    is_folder: bool,
    scheduler: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Each is told, and where none is left, the command does not wait for ever."""
    connected, told = threading.Event(), threading.Event()
    greet, check = ClusterBackend._greet_workers, ClusterBackend.check

    def greeted(place: ClusterBackend) -> set[str]:
        found = greet(place)
        monkeypatch.setattr(_cluster, "PATIENCE", 2)
        connected.set()
        return found

    def checked(place: ClusterBackend) -> list[str]:
        found = check(place)
        if found:
            told.set()
        return found

    monkeypatch.setattr(ClusterBackend, "_greet_workers", greeted)
    monkeypatch.setattr(ClusterBackend, "check", checked)
    names = [str(tmp_path / f"{number}.obj") for number in range(40 if is_folder else 1)]
    for name in names:
        trimesh.creation.icosphere(subdivisions=3).export(name)
    size = ["--size", "192"] if is_folder else ["--size", "1024", "--tile", "32"]
    with ExitStack() as stack:
        workers = [stack.enter_context(dask("worker", scheduler, "--nthreads", "1", "--no-nanny")) for _ in range(2)]
        with Client(scheduler, timeout=60, set_as_default=False) as client:
            client.wait_for_workers(2, timeout=60)

        def kill() -> None:
            for worker, event in zip(workers, (connected, told), strict=True):
                event.wait(60)
                worker.kill()

        thread = threading.Thread(target=kill)
        thread.start()
        assert run(["render", *names, *size, "-o", f"{tmp_path}/out/", "--cluster", scheduler]) == 1
        thread.join()
    said = capsys.readouterr().err
    for then in ("others draw its parts", "no other is left; waiting 2 s for one"):
        assert len(re.findall(rf"the worker tcp://\S+ has left the cluster: {then}", said)) == 1
    assert "shackled: the dask cluster has had no worker for 2 s: start one, and run this again\n" in said


def test_what_a_worker_says_is_told(address: str) -> None:
    with pytest.raises(ChainError, match=r"gas is not enough even for a tile of .*; raise `gas_limit`"):
        render_frames([SCENE], RenderOptions(Cluster(address), gas_limit=100_000))


def test_something_else_than_a_cluster() -> None:
    """Nothing but one line, and at once."""
    program = (
        "import sys; from shackled.cli.app import run; from shackled.parallel import _cluster; _cluster.PATIENCE = 2; "
        "print([run(['render', 'cube', '--size', '8', '--cluster', each]) for each in sys.argv[1:]])"
    )
    with serving(lambda request: Reply(b"?")) as url:
        wrong = (url.replace("http", "tcp"), "nowhere:port", "tcp://127.0.0.1:1")
        told = subprocess.run([sys.executable, "-c", program, *wrong], capture_output=True, text=True, timeout=90)
    assert (told.returncode, told.stdout) == (0, "[1, 1, 1]\n")
    for address, line in zip(wrong, told.stderr.splitlines(), strict=True):
        assert line.startswith(f"shackled: no dask scheduler answers at {address}: ")


def test_a_cluster_that_goes_away(capfd: pytest.CaptureFixture[str]) -> None:
    class Breaker(Listener):
        def advanced(self, pixels: int) -> None:
            process.kill()

    with cluster(1) as (address, process):
        with pytest.raises(ChainError, match=r"^the cluster failed: its scheduler cannot be reached any more; is it"):
            render_frames(full_turn(SCENE, 200), RenderOptions(Cluster(address), listener=Breaker()))
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
        render_frames([SCENE], RenderOptions(Cluster("tcp://127.0.0.1:1")))
