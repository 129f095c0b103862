"""Fetching models, from a server on this machine."""

from __future__ import annotations

import errno
import gzip
import hashlib
import io
import socket
import tarfile
import threading
import time
import zipfile
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import numpy as np
import pytest

import shackled
from shackled.cli.app import run
from shackled.datasets import PieceCost, cost, find
from shackled.datasets.common import fetch, take
from shackled.datasets.common._fetch import checksum
from shackled.datasets.common._models import Model
from shackled.datasets.common.shapes import icosphere
from shackled.errors import FetchError, InputError
from shackled.scene import write_obj


class Server(ThreadingHTTPServer):
    """Serves one file, and misbehaves as it is told."""

    daemon_threads = True

    def __init__(self, content: bytes) -> None:
        super().__init__(("127.0.0.1", 0), Handler)
        self.content = content
        self.ranges = True
        self.cut_after: int | None = None
        self.stall = 0.0
        self.requests: list[tuple[str, str | None]] = []

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self.server_address[1]}"


class Handler(BaseHTTPRequestHandler):
    server: Server

    def do_GET(self) -> None:
        server, wanted = self.server, self.headers.get("Range")
        server.requests.append((self.path, wanted))
        if self.path.startswith("/missing"):
            self.send_error(404)
            return
        start = int(wanted.removeprefix("bytes=").rstrip("-")) if wanted and server.ranges else 0
        if start >= len(server.content):
            self.send_error(416)
            return
        self.send_response(206 if start else 200)
        if start:
            self.send_header("Content-Range", f"bytes {start}-{len(server.content) - 1}/{len(server.content)}")
        self.send_header("Content-Length", str(len(server.content) - start))
        self.end_headers()
        end = len(server.content) if server.cut_after is None else server.cut_after
        self.wfile.write(server.content[start:end])
        self.wfile.flush()
        time.sleep(server.stall)

    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture(scope="module")
def obj(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A ball, in another place and of another size than it will have."""
    path = tmp_path_factory.mktemp("ball") / "ball.obj"
    ball = icosphere(3)
    write_obj(shackled.Mesh(40 * ball.positions + 7, ball.faces), path)
    return path.read_bytes()


@pytest.fixture
def server(obj: bytes) -> Iterator[Server]:
    server = Server(obj)
    thread = threading.Thread(target=server.serve_forever, args=(0.01,))
    thread.start()
    yield server
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "cache"
    monkeypatch.setenv("SHACKLED_CACHE", str(folder))
    return folder


@pytest.fixture
def ball(server: Server, cache: Path, obj: bytes, monkeypatch: pytest.MonkeyPatch) -> Model:
    """A model of the server, in the place of all others."""
    model = Model(
        "ball",
        "A ball",
        "Somebody",
        "for looking at",
        commercial=False,
        addresses=[f"{server.address}/ball.obj"],
        checksum=f"sha256:{hashlib.sha256(obj).hexdigest()}",
        size=len(obj),
    )
    register(model, monkeypatch)
    return model


def register(model: Model, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.datasets.common._models.models", lambda: {model.name: model})


def changed(model: Model, monkeypatch: pytest.MonkeyPatch, **fields: object) -> Model:
    model = Model(**{**vars(model), **fields})
    register(model, monkeypatch)
    return model


def files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*") if path.is_file())


def test_a_model_is_fetched_once(ball: Model, server: Server, cache: Path) -> None:
    with pytest.raises(InputError, match=r"^ball has not been fetched; run: shackled datasets fetch ball$"):
        shackled.load("ball")
    assert fetch(ball)
    scene = shackled.load("ball")
    positions = np.asarray(scene.objects[0].mesh.positions)
    assert np.linalg.norm(positions, axis=1).max() == pytest.approx(1)
    assert np.abs(positions.min(axis=0) + positions.max(axis=0)).max() < 1e-6
    assert 900 < len(scene.objects[0].mesh.faces) <= 1198
    assert scene.objects[0].cull  # it is still closed
    assert (shackled.render("ball").covered_pixels or 0) > 5000
    assert not fetch(ball)
    assert len(server.requests) == 1
    assert fetch(ball, again=True)
    assert len(server.requests) == 1  # its file was in the cache
    assert files(cache) == [ball.original.name, ball.prepared().name]


def test_a_wrong_checksum_leaves_nothing(ball: Model, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = changed(ball, monkeypatch, checksum=f"sha256:{'0' * 64}")
    with pytest.raises(FetchError, match=r"ball\.obj sends is not the file that was expected: its checksum is sha256:"):
        fetch(wrong)
    assert files(cache) == []


def test_a_file_of_the_cache_that_is_damaged_is_fetched_again(ball: Model, server: Server) -> None:
    fetch(ball)
    ball.original.write_bytes(b"something else")
    fetch(ball, again=True)
    assert len(server.requests) == 2
    assert checksum(ball.original, ball.checksum) == ball.checksum


def test_a_connection_that_is_cut_goes_on_later(ball: Model, server: Server, cache: Path) -> None:
    server.cut_after = 10_000
    with pytest.raises(FetchError, match=r"^ball: the connection was cut after 8,192 of [\d,]+ bytes; run it again"):
        fetch(ball)
    assert files(cache) == [f"{ball.original.name}.part"]
    server.cut_after = None
    seen: list[int] = []
    fetch(ball, progress=lambda here, _: seen.append(here))
    assert server.requests[-1] == ("/ball.obj", "bytes=8192-")
    assert seen[0] > 8192
    assert seen[-1] == ball.size
    assert files(cache) == [ball.original.name, ball.prepared().name]


def test_a_server_without_ranges_sends_all_of_it_again(ball: Model, server: Server) -> None:
    server.cut_after = 10_000
    with pytest.raises(FetchError):
        fetch(ball)
    server.cut_after, server.ranges = None, False
    assert fetch(ball)
    assert shackled.load("ball").objects


@pytest.mark.parametrize("rest", [b"not the beginning of it", b"x" * 10**6])
def test_what_is_left_of_another_file_does_no_harm(ball: Model, server: Server, rest: bytes) -> None:
    part = ball.original.with_name(f"{ball.original.name}.part")
    part.parent.mkdir(parents=True)
    part.write_bytes(rest[: ball.size])
    if len(rest) > len(server.content):
        part.write_bytes(rest)
        with pytest.raises(FetchError, match="run it again"):
            fetch(ball)
    assert fetch(ball)
    assert checksum(ball.original, ball.checksum) == ball.checksum


def test_no_network(ball: Model, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with socket.socket() as unused:
        unused.bind(("127.0.0.1", 0))
        port = unused.getsockname()[1]
    away = changed(ball, monkeypatch, addresses=[f"http://127.0.0.1:{port}/ball.obj"])
    with pytest.raises(FetchError, match=rf"^ball: 127\.0\.0\.1:{port} cannot be reached; is there a network\?"):
        fetch(away)
    assert files(cache) == []


def test_no_such_file_there(ball: Model, server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    missing = f"{server.address}/missing.obj"
    with pytest.raises(FetchError, match=r"missing\.obj answers 404 Not Found"):
        fetch(changed(ball, monkeypatch, addresses=[missing]))
    assert fetch(changed(ball, monkeypatch, addresses=[missing, *ball.addresses]))
    assert [path for path, _ in server.requests] == ["/missing.obj", "/missing.obj", "/ball.obj"]


def test_a_server_that_falls_silent(ball: Model, server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.datasets.common._fetch.TIMEOUT", (1, 0.2))
    server.cut_after, server.stall = 5_000, 0.6
    with pytest.raises(FetchError, match="the connection was cut after"):
        fetch(ball)


def test_a_file_that_does_not_end(ball: Model, cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(FetchError, match="sends more than the 1,000 bytes expected"):
        fetch(changed(ball, monkeypatch, size=1000))
    assert files(cache) == []


@pytest.mark.parametrize("where", ["download", "result"])
def test_a_full_disk(ball: Model, cache: Path, monkeypatch: pytest.MonkeyPatch, where: str) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(f"shackled.datasets.common.{'_fetch._write' if where == 'download' else '_models.keep'}", full)
        with pytest.raises(FetchError, match=r"^ball: the disk is full: no space for it in "):
            fetch(ball)
    assert files(cache) == ([] if where == "download" else [ball.original.name])
    assert fetch(ball)


def test_a_cache_that_is_no_folder(ball: Model, cache: Path) -> None:
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


def test_ids_of_git(ball: Model, server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    sha = hashlib.sha1(f"blob {len(server.content)}\0".encode() + server.content).hexdigest()
    assert fetch(changed(ball, monkeypatch, checksum=f"git-blob:{sha}", size=None))
    with pytest.raises(FetchError, match="not the file that was expected"):
        fetch(changed(ball, monkeypatch, checksum=f"git-blob:{'0' * 40}", size=None), again=True)


def test_a_file_of_ones_own(ball: Model, server: Server, tmp_path: Path, obj: bytes) -> None:
    published, own = tmp_path / "published.obj", tmp_path / "own.obj"
    published.write_bytes(obj)
    own.write_bytes(obj + b"v 900 0 0\nv 900 1 0\nv 901 0 0\nf -1 -2 -3\n")
    assert take(ball, published)
    piece = find("ball")
    assert piece is not None
    assert (piece.licence, piece.commercial, piece.credit) == ("for looking at", False, "Somebody")
    assert not take(ball, own)
    piece = find("ball")
    assert piece is not None
    assert (piece.licence, piece.commercial, piece.credit) == ("that of your own file", False, "")
    assert server.requests == []
    fetch(ball, again=True)  # the published one takes its place again
    piece = find("ball")
    assert piece is not None
    assert piece.licence == "for looking at"


def packed(kind: str, obj: bytes) -> bytes:
    stream = io.BytesIO()
    if kind == "zip":
        with zipfile.ZipFile(stream, "w") as archive:
            archive.writestr("readme.txt", "nothing " * 10**5)
            archive.writestr("small.obj", "v 0 0 0\n")
            archive.writestr("folder/ball.obj", obj)
    elif kind == "gz":
        stream.write(gzip.compress(obj))
    elif kind == "3mf":
        vertices, triangles = [], []
        for line in obj.decode().splitlines():
            word, *numbers = line.split()
            if word == "v":
                vertices.append('<vertex x="{}" y="{}" z="{}"/>'.format(*numbers))
            elif word == "f":
                triangles.append('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*(int(n) - 1 for n in numbers)))
        with zipfile.ZipFile(stream, "w") as archive:
            archive.writestr(
                "3D/3dmodel.model",
                '<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1">'
                f"<mesh><vertices>{''.join(vertices)}</vertices><triangles>{''.join(triangles)}</triangles></mesh>"
                "</object></resources></model>",
            )
    else:
        with tarfile.open(fileobj=stream, mode=f"w:{kind.removeprefix('tar').removeprefix('.')}") as tar:  # type: ignore[call-overload]
            info = tarfile.TarInfo("folder/ball.obj")
            info.size = len(obj)
            tar.addfile(info, io.BytesIO(obj))
    return stream.getvalue()


@pytest.mark.parametrize("kind", ["zip", "gz", "3mf", "tar", "tar.gz", "tar.xz", "tar.bz2"])
def test_archives(ball: Model, tmp_path: Path, obj: bytes, kind: str) -> None:
    path = tmp_path / f"ball.obj.{kind}"
    path.write_bytes(packed(kind, obj))
    assert not take(ball, path)
    own = shackled.render("ball").pixels
    fetch(ball, again=True)
    assert (own == shackled.render("ball").pixels).all()


@pytest.mark.parametrize("kind", ["zip", "gz", "3mf", "tar.gz", "tar.xz"])
def test_broken_archives(ball: Model, cache: Path, tmp_path: Path, obj: bytes, kind: str) -> None:
    whole, path = packed(kind, obj), tmp_path / f"ball.obj.{kind}"
    for length in (5, 100, len(whole) // 2):
        path.write_bytes(whole[:length])
        with pytest.raises(InputError) as caught:
            take(ball, path)
        assert str(caught.value).startswith(str(path))
        assert "\n" not in str(caught.value)
    assert files(cache) == []


def test_archives_without_a_mesh(ball: Model, tmp_path: Path) -> None:
    path = tmp_path / "texts.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("readme.txt", "nothing")
    with pytest.raises(InputError, match=r"texts\.zip contains no mesh file; known are \.obj"):
        take(ball, path)


def test_the_command(ball: Model, server: Server, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert run(["datasets", "fetch", "ball", "--cache", str(tmp_path / "elsewhere")]) == 0
    output, messages = capsys.readouterr()
    assert output.startswith("ball: ")
    assert output.endswith(" gas; shackled render ball\n")
    assert messages == "ball: A ball by Somebody; licence: for looking at; not for commercial use\n"
    assert (tmp_path / "elsewhere" / "originals" / ball.original.name).is_file()
    assert run(["render", "ball", "-o", str(tmp_path / "ball.png"), "--size", "16"]) == 0
    assert "ball: A ball by Somebody; licence: for looking at; not for commercial use\n" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["fetch", "bal"], 2, "there is no model 'bal' to fetch; there are ball"),
        (["fetch", "ball", "ball", "--from", "x.obj"], 2, "--from needs exactly one NAME"),
        (["fetch", "ball", "--from", "x.obj"], 2, "x.obj does not exist; a mesh file or archive is needed"),
        (["fetch", "ball", "--from", "."], 2, ". is no file; a mesh file or archive is needed"),
        (["fetch", "ball"], 1, "the connection was cut after 0 of"),
    ],
)
def test_mistakes_are_one_line(
    ball: Model,
    server: Server,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    arguments: list[str],
    code: int,
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    server.cut_after = 5
    assert run(["datasets", *arguments]) == code
    output, messages = capsys.readouterr()
    assert output == ""
    assert messages.splitlines()[-1].startswith("shackled: ")
    assert message in messages.splitlines()[-1]
