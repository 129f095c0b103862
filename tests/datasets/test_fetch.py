"""Fetching models, from a server on this machine."""

from __future__ import annotations

import errno
import hashlib
import re
import threading
import time
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import shackled
from shackled.cli.app import run
from shackled.datasets._drawing import PieceCost, cost
from shackled.datasets._pieces import require
from shackled.datasets.common._fetch import fetch
from shackled.datasets.common._models import Model
from shackled.errors import FetchError, InputError


class Server(ThreadingHTTPServer):
    """Serves one file, and misbehaves as it is told."""

    daemon_threads = True

    def __init__(self, content: bytes) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.content = content
        self.cut_after: int | None = None
        self.stall = 0.0
        self.requests = 0


class Handler(BaseHTTPRequestHandler):
    server: Server

    def do_GET(self) -> None:
        self.server.requests += 1
        if self.path.startswith("/missing"):
            self.send_error(404)
            return
        self.send_response(200)
        self.send_header("Content-Length", str(len(self.server.content)))
        self.end_headers()
        self.wfile.write(self.server.content[: self.server.cut_after])
        self.wfile.flush()
        time.sleep(self.server.stall)

    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture(scope="module")
def obj(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A ball, in another place and of another size than it will have."""
    path = tmp_path_factory.mktemp("ball") / "ball.obj"
    trimesh.creation.icosphere(3, 40).apply_translation((7, 7, 7)).export(path)
    return path.read_bytes()


@pytest.fixture
def server(obj: bytes) -> Iterator[Server]:
    with Server(obj) as server:
        threading.Thread(target=server.serve_forever, args=(0.01,)).start()
        yield server
        server.shutdown()


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("SHACKLED_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def ball(server: Server, cache: Path, obj: bytes, monkeypatch: pytest.MonkeyPatch) -> Model:
    """A model of the server, in the place of all others."""
    address = f"http://127.0.0.1:{server.server_address[1]}/ball.obj"
    digest = f"sha256:{hashlib.sha256(obj).hexdigest()}"
    model = Model("ball", "A ball", "Somebody", "for looking at", False, address, digest)
    monkeypatch.setattr("shackled.datasets.common._models.models", lambda: {"ball": model})
    return model


def files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*") if path.is_file())


def test_a_model_is_fetched_once(ball: Model, server: Server, cache: Path) -> None:
    with pytest.raises(InputError, match=r"^ball has not been fetched; run: shackled datasets fetch ball$"):
        shackled.load("ball")
    fetch(ball)
    (o,) = shackled.load("ball").objects
    assert np.linalg.norm(o.mesh.positions, axis=1).max() == pytest.approx(1)
    assert np.abs(o.mesh.positions.min(axis=0) + o.mesh.positions.max(axis=0)).max() < 1e-6
    assert 900 < o.mesh.triangles <= 1198
    assert o.cull  # it is still closed
    fetch(ball)
    assert server.requests == 1
    assert files(cache) == [ball.kept.name]
    piece = require("ball")
    assert (piece.licence, piece.commercial, piece.credit) == ("for looking at", False, "Somebody")


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"checksum": f"sha256:{'0' * 64}"}, r"ball\.obj sends is not the file that was expected: its checksum is sha"),
        ({"checksum": f"git-blob:{'0' * 40}"}, "not the file that was expected: its checksum is git-blob:"),
        ({"address": "http://127.0.0.1:1/a.obj"}, r"^ball: http.*a\.obj cannot be downloaded \(ConnectionError\); is"),
        ({"address": "missing.obj"}, r"missing\.obj cannot be downloaded \(404 Client Error: Not Found for url: "),
        ({"cut_after": 10_000}, r"^ball: http.*/ball\.obj cannot be downloaded \(ChunkedEncodingError\)"),
        ({"stall": 0.6, "cut_after": 10_000}, r"cannot be downloaded \(ConnectionError\)"),
        ({"most": 10_000}, r"^ball: http.*/ball\.obj sends more than 0 MB$"),
    ],
)
def test_what_is_not_the_file_leaves_nothing(
    ball: Model, server: Server, cache: Path, monkeypatch: pytest.MonkeyPatch, changes: dict[str, Any], message: str
) -> None:
    monkeypatch.setattr("shackled.datasets.common._fetch.TIMEOUT", (1, 0.2))
    monkeypatch.setattr("shackled.datasets.common._fetch.MAX_BYTES", changes.pop("most", 10**6))
    if "address" in changes and "//" not in changes["address"]:
        changes = {"address": ball.address.replace("ball.obj", changes["address"])}
    for name in ("cut_after", "stall"):
        setattr(server, name, changes.pop(name, getattr(server, name)))
    with pytest.raises(FetchError, match=message):
        fetch(replace(ball, **changes))
    assert files(cache) == []


def test_ids_of_git(ball: Model, obj: bytes) -> None:
    sha = hashlib.sha1(f"blob {len(obj)}\0".encode() + obj).hexdigest()
    fetch(replace(ball, checksum=f"git-blob:{sha}"))
    assert ball.kept.is_file()


def test_a_full_disk_and_a_cache_that_is_no_folder(ball: Model, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr("shackled.datasets.common._models.keep", full)
        with pytest.raises(FetchError, match=r"^ball: the cache .* cannot be used: No space left on device$"):
            fetch(ball)
    cache.write_text("a file")
    with pytest.raises(FetchError, match=r"^ball: the cache .* cannot be used: "):
        fetch(ball)


def test_a_kept_mesh_that_is_damaged(ball: Model) -> None:
    fetch(ball)
    ball.kept.write_bytes(b"PK\3\4 and no more")
    with pytest.raises(InputError, match="; delete it and run: shackled datasets fetch ball"):
        shackled.load("ball")
    assert cost(ball.piece()) == PieceCost(None, None)


def test_a_copy_of_the_published_file(ball: Model, server: Server, cache: Path, tmp_path: Path, obj: bytes) -> None:
    copy = tmp_path / "copy.obj"
    with pytest.raises(InputError, match=r"copy\.obj cannot be read: No such file or directory$"):
        fetch(ball, copy)
    copy.write_bytes(obj + b"v 900 0 0\n")
    with pytest.raises(InputError, match=r"copy\.obj is not the published file of ball: its checksum is sha256:"):
        fetch(ball, copy)
    assert files(cache) == []
    copy.write_bytes(obj)
    fetch(ball, copy)
    assert server.requests == 0
    assert shackled.load("ball").objects


def test_a_3mf_file(ball: Model, tmp_path: Path, obj: bytes) -> None:
    fetch(ball)
    expected = shackled.load("ball")
    rows = [line.split() for line in obj.decode().splitlines() if line]
    vertices = "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*row[1:]) for row in rows if row[0] == "v")
    faces = [[int(number) - 1 for number in row[1:]] for row in rows if row[0] == "f"]
    triangles = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*face) for face in faces)
    path = tmp_path / "ball.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("3D/3dmodel.model", f"<mesh><vertices>{vertices}</vertices>{triangles}</mesh>")
    digest = f"sha256:{hashlib.sha256(path.read_bytes()).hexdigest()}"
    fetch(replace(ball, address="https://example.org/ball.3mf", checksum=digest), path)
    assert shackled.load("ball") == expected


@pytest.mark.usefixtures("ball")
def test_the_command(server: Server, capsys: pytest.CaptureFixture[str]) -> None:
    notice = "ball: A ball by Somebody; licence: for looking at; not for commercial use\n"
    server.cut_after = 5
    assert run(["datasets", "fetch", "ball"]) == 1
    output, messages = capsys.readouterr()
    assert output == ""
    assert re.fullmatch(f"{notice}shackled: ball: http://.*\n", messages)
    server.cut_after = None
    assert run(["datasets", "fetch", "ball"]) == 0
    output, messages = capsys.readouterr()
    assert re.fullmatch(r"ball: [\d,]+ triangles, [\d,]+ gas; shackled render ball\n", output)
    assert messages == notice
