"""Fetching models, from a server on this machine."""

from __future__ import annotations

import errno
import hashlib
import io
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
from shackled.datasets import PieceCost, cost, require
from shackled.datasets.common import fetch, take
from shackled.datasets.common._fetch import checksum
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
    model = Model("ball", "A ball", "Somebody", "for looking at", False, address, digest, len(obj))
    monkeypatch.setattr("shackled.datasets.common._models.models", lambda: {"ball": model})
    return model


def files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*") if path.is_file())


def test_a_model_is_fetched_once(ball: Model, server: Server, cache: Path) -> None:
    with pytest.raises(InputError, match=r"^ball has not been fetched; run: shackled datasets fetch ball$"):
        shackled.load("ball")
    seen: list[int] = []
    assert fetch(ball, progress=lambda here, _: seen.append(here))
    assert seen[-1] == ball.size
    (o,) = shackled.load("ball").objects
    assert np.linalg.norm(o.mesh.positions, axis=1).max() == pytest.approx(1)
    assert np.abs(o.mesh.positions.min(axis=0) + o.mesh.positions.max(axis=0)).max() < 1e-6
    assert 900 < o.mesh.triangles <= 1198
    assert o.cull  # it is still closed
    assert not fetch(ball)
    assert fetch(ball, again=True)
    assert server.requests == 1  # its file was in the cache
    assert files(cache) == [ball.original.name, ball.prepared().name]
    ball.original.write_bytes(b"damaged")
    fetch(ball, again=True)
    assert server.requests == 2
    assert checksum(ball.original.read_bytes(), ball.checksum) == ball.checksum


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"checksum": f"sha256:{'0' * 64}"}, r"ball\.obj sends is not the file that was expected: its checksum is sha"),
        ({"checksum": f"git-blob:{'0' * 40}"}, "not the file that was expected: its checksum is git-blob:"),
        ({"address": "http://127.0.0.1:1/a.obj"}, r"^ball: 127\.0\.0\.1:1 cannot be reached .*is there a network\?"),
        ({"address": "missing.obj"}, r"missing\.obj answers 404 Not Found"),
        ({"size": 1000}, "sends more than the 1,000 bytes expected"),
        ({"cut_after": 10_000}, r"^ball: the connection was cut after 8,192 bytes; run it again$"),
        ({"stall": 0.6, "cut_after": 10_000}, "the connection was cut after"),
    ],
)
def test_what_is_not_the_file_leaves_nothing(
    ball: Model, server: Server, cache: Path, monkeypatch: pytest.MonkeyPatch, changes: dict[str, Any], message: str
) -> None:
    monkeypatch.setattr("shackled.datasets.common._fetch.TIMEOUT", (1, 0.2))
    if "address" in changes and "//" not in changes["address"]:
        changes = {"address": ball.address.replace("ball.obj", changes["address"])}
    for name in ("cut_after", "stall"):
        setattr(server, name, changes.pop(name, getattr(server, name)))
    with pytest.raises(FetchError, match=message):
        fetch(replace(ball, **changes))
    assert files(cache) == []
    server.cut_after, server.stall = None, 0.0
    assert fetch(ball)


def test_ids_of_git(ball: Model, obj: bytes) -> None:
    sha = hashlib.sha1(f"blob {len(obj)}\0".encode() + obj).hexdigest()
    assert fetch(replace(ball, checksum=f"git-blob:{sha}", size=None))


def test_a_full_disk_and_a_cache_that_is_no_folder(ball: Model, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    for place in ("_fetch.keep", "_models.keep"):
        with monkeypatch.context() as patch:
            patch.setattr(f"shackled.datasets.common.{place}", full)
            with pytest.raises(FetchError, match=r"^ball: the cache .* cannot be used: No space left on device$"):
                fetch(ball)
    assert files(cache) == [ball.original.name]
    ball.original.unlink()
    ball.original.parent.rmdir()
    cache.rmdir()
    cache.write_text("a file")
    with pytest.raises(FetchError, match=r"^ball: the cache .* cannot be used: "):
        fetch(ball)


def test_a_kept_mesh_that_is_damaged(ball: Model) -> None:
    fetch(ball)
    ball.prepared().write_bytes(b"PK\3\4 and no more")
    with pytest.raises(InputError, match="run: shackled datasets fetch --again ball"):
        shackled.load("ball")
    assert cost(ball.piece()) == PieceCost(None, None)
    fetch(ball, again=True)
    assert shackled.load("ball").objects


def test_a_file_of_ones_own(ball: Model, server: Server, tmp_path: Path, obj: bytes) -> None:
    published, own = tmp_path / "published.obj", tmp_path / "own.obj"
    published.write_bytes(obj)
    own.write_bytes(obj + b"v 900 0 0\nv 900 1 0\nv 901 0 0\nf -1 -2 -3\n")

    def terms() -> tuple[str, bool, str]:
        piece = require("ball")
        return piece.licence, piece.commercial, piece.credit

    assert take(ball, published)
    assert terms() == ("for looking at", False, "Somebody")
    assert not take(ball, own)
    assert terms() == ("that of your own file", False, "")
    assert server.requests == 0
    fetch(ball, again=True)  # the published one takes its place again
    assert terms() == ("for looking at", False, "Somebody")


def packed(kind: str, obj: bytes) -> bytes:
    stream = io.BytesIO()
    rows = [line.split() for line in obj.decode().splitlines() if line]
    vertices = "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*row[1:]) for row in rows if row[0] == "v")
    faces = [[int(number) - 1 for number in row[1:]] for row in rows if row[0] == "f"]
    triangles = "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*face) for face in faces)
    members: dict[str, str | bytes] = {
        "readme.txt": "nothing " * 10**5,
        "small.obj": "v 0 0 0\n",
        "folder/ball.obj": obj,
    }
    if kind == "3mf":
        members["3D/3dmodel.model"] = (
            '<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1">'
            f"<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object></resources></model>"
        )
    with zipfile.ZipFile(stream, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)
    return stream.getvalue()


@pytest.mark.parametrize("kind", ["zip", "3mf"])
def test_archives(ball: Model, tmp_path: Path, cache: Path, obj: bytes, kind: str) -> None:
    whole, path = packed(kind, obj), tmp_path / f"ball.obj.{kind}"
    for length in (5, 100, len(whole) // 2):
        path.write_bytes(whole[:length])
        with pytest.raises(InputError) as caught:
            take(ball, path)
        assert str(caught.value).startswith(str(path))
        assert "\n" not in str(caught.value)
    assert files(cache) == []
    path.write_bytes(whole)
    assert not take(ball, path)
    own = shackled.render("ball").pixels
    fetch(ball, again=True)
    assert (own == shackled.render("ball").pixels).all()


def test_archives_without_a_mesh(ball: Model, tmp_path: Path) -> None:
    path = tmp_path / "texts.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("readme.txt", "nothing")
    with pytest.raises(InputError, match=r"texts\.zip contains no mesh file; known are \.obj"):
        take(ball, path)


def test_the_command(ball: Model, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    notice = "ball: A ball by Somebody; licence: for looking at; not for commercial use\n"
    assert run(["datasets", "fetch", "ball", "--cache", str(tmp_path / "elsewhere")]) == 0
    output, messages = capsys.readouterr()
    assert output.startswith("ball: ")
    assert output.endswith(" gas; shackled render ball\n")
    assert messages == notice
    assert (tmp_path / "elsewhere" / "originals" / ball.original.name).is_file()
    assert run(["render", "ball", "-o", str(tmp_path / "ball.png"), "--size", "16"]) == 0
    assert notice in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("bal", "there is no model 'bal' to fetch; there are ball"),
        ("ball ball --from x.obj", "--from needs exactly one NAME"),
        ("ball --from x.obj", "x.obj does not exist; a mesh file or archive is needed"),
        ("ball --from .", ". is no file; a mesh file or archive is needed"),
        ("ball", "127.0.0.1"),
    ],
)
@pytest.mark.usefixtures("ball")
def test_mistakes_are_one_line(
    server: Server, capsys: pytest.CaptureFixture[str], arguments: str, message: str
) -> None:
    server.cut_after = 5
    assert run(["datasets", "fetch", *arguments.split()]) == (1 if arguments == "ball" else 2)
    output, messages = capsys.readouterr()
    assert output == ""
    assert messages.splitlines()[-1].startswith("shackled: ")
    assert message in messages.splitlines()[-1]
