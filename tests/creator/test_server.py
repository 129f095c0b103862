"""The server of the page: what it refuses, and what it tells."""

from __future__ import annotations

import asyncio
import json
import re
import socket
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from tools.page_server import Started, creator

from shackled import render
from shackled.cli.app import run

pytest.importorskip("starlette", reason="the page needs starlette")

from starlette.types import Message
from websockets.sync.client import connect

from shackled.creator import (
    Facts,
    Pool,
    Source,
    Upload,
    Visitors,
    first_source,
    make_app,
    unpack_upload,
)
from shackled.datasets import require
from shackled.errors import InputError
from shackled.scene import decode
from shackled.serving import open_in_browser
from shackled.web import asset


@pytest.fixture(scope="module")
def server() -> Iterator[Started]:
    with creator("tetrahedron") as started:
        yield started


def ask(
    server: Started, path: str, headers: dict[str, str] | None = None, data: bytes | None = None
) -> tuple[int, dict[str, str], bytes]:
    request = urllib.request.Request(server.address + path, data, headers or {})
    try:
        with urllib.request.urlopen(request, timeout=20) as answer:
            return answer.status, {name.lower(): value for name, value in answer.headers.items()}, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, {name.lower(): value for name, value in error.headers.items()}, error.read()


@contextmanager
def visitor(server: Started, query: str = "") -> Iterator[str]:
    """The name of a visitor who has the page open."""
    with connect(f"{server.address.replace('http', 'ws', 1)}live{query}") as socket:
        yield json.loads(socket.recv())["visitor"]


def packed(*files: tuple[str, bytes]) -> bytes:
    head = json.dumps([[name, len(data)] for name, data in files]).encode()
    return len(head).to_bytes(4, "big") + head + b"".join(data for _, data in files)


def test_it_listens_on_this_machine_only(server: Started) -> None:
    assert server.address.startswith("http://127.0.0.1:")
    port = int(server.address.rsplit(":", 1)[1].strip("/"))
    found = {str(each[4][0]) for each in socket.getaddrinfo(socket.gethostname(), port, socket.AF_INET)}
    for address in found:
        if not address.startswith("127."):
            with socket.socket() as other:
                other.settimeout(2)
                assert other.connect_ex((address, port)) != 0


def test_pages_of_others_are_refused(server: Started) -> None:
    host = server.address.split("/")[2]
    assert ask(server, "", {"Origin": f"http://{host}"})[0] == 200
    assert ask(server, "", {"Origin": "http://evil.example"})[0] == 403
    assert ask(server, "", {"Origin": "null"})[0] == 403
    # a name of somebody else that leads to this machine
    assert ask(server, "", {"Host": "evil.example"})[0] == 403
    assert ask(server, "", {"Origin": "http://["})[0] == 403
    assert _upgrade(server, "live", "http://evil.example") == 403
    assert _upgrade(server, "live", f"http://{host}") == 101


FETCH = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "no-cors", "Sec-Fetch-Dest": "image"}
GOING = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"}


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        (FETCH, 403),
        (FETCH | {"Sec-Fetch-Site": "same-site"}, 403),
        (GOING | {"Sec-Fetch-Dest": "iframe"}, 403),
        (GOING, 200),
        (FETCH | {"Sec-Fetch-Site": "same-origin"}, 200),
        (GOING | {"Sec-Fetch-Site": "none"}, 200),
        ({}, 200),
    ],
    ids=["image", "neighbour", "frame", "link", "own", "typed", "program"],
)
def test_pages_of_others_make_no_work(server: Started, headers: dict[str, str], status: int) -> None:
    assert ask(server, "", headers)[0] == status
    if headers == GOING:
        assert ask(server, "", headers, b"x")[0] == 403


def test_who_lets_others_in_is_known_by_their_own_names(server: Started) -> None:
    with creator("tetrahedron", "--host", "0.0.0.0", "--name", "Shackled.example") as open_to_all:
        port = open_to_all.address.rsplit(":", 1)[1].strip("/")
        local = Started(f"http://127.0.0.1:{port}/", open_to_all.at, open_to_all.process)
        for name in ("evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "[", ""):
            assert ask(local, "", {"Host": f"{name}:{port}", "Origin": f"http://{name}:{port}"})[0] in (400, 403)
        for name in ("192.0.2.7", "[2001:db8::7]", "localhost", socket.gethostname(), "shackled.example"):
            assert ask(local, "", {"Host": f"{name}:{port}"})[0] == 200


def test_a_page_that_nobody_opens_takes_no_memory(server: Started) -> None:
    """It is the same for all visitors, who begin with their connection."""
    pages = {ask(server, path)[2] for path in ("", "?p=1abc", "")}
    assert len(pages) == 1


def test_who_connects_again_is_the_same_visitor(server: Started) -> None:
    with visitor(server) as name:
        pass
    with visitor(server, f"?visitor={name}") as again:
        assert again == name
    with visitor(server, "?visitor=nobody") as other:
        assert other not in (name, "nobody")


def test_what_is_not_there_is_no_page(server: Started) -> None:
    status, headers, body = ask(server, "nothing-of-that-name")
    assert status == 404
    assert headers["content-type"].startswith("text/plain")
    assert len(body) < 100


def _upgrade(server: Started, path: str, origin: str) -> int:
    host = server.address.split("/")[2]
    with socket.create_connection((host.split(":")[0], int(host.split(":")[1])), timeout=20) as connection:
        connection.sendall(
            f"GET /{path} HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
            "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n".encode()
        )
        return int(connection.recv(1000).split()[1])


def test_the_page_lets_no_script_of_others_in(server: Started) -> None:
    _, headers, body = ask(server, "")
    policy = dict(each.strip().split(" ", 1) for each in headers["content-security-policy"].split(";"))
    assert (policy["default-src"], policy["script-src"], policy["style-src"]) == (
        "'none'",
        "'self' 'wasm-unsafe-eval'",
        "'self'",
    )
    assert policy["worker-src"] == "blob:"
    assert policy["frame-ancestors"] == "'none'"
    assert "unsafe" not in headers["content-security-policy"].replace("'wasm-unsafe-eval'", "")
    # and it needs none: all scripts are files, and nothing has a style or a handler of its own
    html = body.decode()
    assert all("src=" in script for script in re.findall("<script[^>]*>", html))
    assert not re.search(r"<style|\s(style|on\w+)=", html)
    refused: dict[str, str] = {"Host": "evil.example"}
    for path, sent in (("", {}), ("assets/creator.js", {}), ("nothing", {}), ("take/nobody/png", {}), ("", refused)):
        headers = ask(server, path, sent)[1]
        assert headers["content-security-policy"]
        assert headers["cache-control"] == "no-cache"
        for name, value in (("x-content-type-options", "nosniff"), ("referrer-policy", "no-referrer")):
            assert headers[name] == value


def test_the_call_of_a_picture_is_for_its_visitor(server: Started) -> None:
    with visitor(server) as name:
        status, headers, body = ask(server, f"call/{name}")
        length = int.from_bytes(body[:4], "big")
        head = json.loads(body[4 : 4 + length])
        assert (status, headers["cache-control"]) == (200, "no-store")
        assert set(head) == {"key", "camera", "follow", "radius"}
        assert (
            render(decode(body[4 + length :])).pixels.tobytes()
            == render(require("tetrahedron").make()).pixels.tobytes()
        )
        assert ask(server, f"call/{name}", {"Origin": "http://evil.example"})[0] == 403
    assert ask(server, "call/nobody")[0] == 404


def test_what_draws_in_the_browser_is_served(server: Started) -> None:
    for name in ("live.js", "evm.wasm", "contracts.json"):
        status, headers, body = ask(server, f"web/{name}")
        assert (status, body) == (200, asset(name))
        assert ask(server, f"web/{name}", {"If-None-Match": headers["etag"]})[0] == 304
    for name in ("_bundle.py", "view.js", "..%2fevm%2fevm.wasm"):
        assert ask(server, f"web/{name}")[0] == 404


def test_responses_to_failures_have_the_headers_too() -> None:
    async def send(message: Message) -> None:
        sent.append(message)

    async def receive() -> Message:
        return {"type": "http.request", "body": b"", "more_body": False}

    sent: list[Message] = []
    app = make_app(cast(Visitors, SimpleNamespace(pool=None, open_page=None)), "<html>", local=True)
    scope = {
        "type": "http",
        "method": "GET",
        "path": "/thumbnail/cube.png",
        "raw_path": b"",
        "query_string": b"",
        "headers": [(b"host", b"127.0.0.1")],
    }

    async def fail() -> None:
        with pytest.raises(AttributeError):
            await app(scope, receive, send)

    asyncio.run(fail())
    assert sent[0]["status"] == 500
    assert (b"x-content-type-options", b"nosniff") in sent[0]["headers"]


def test_nothing_is_given_to_who_is_not_known(server: Started) -> None:
    for path in ("take/nobody/png", "upload/nobody"):
        assert ask(server, path, data=b"x" if path.startswith("upload") else None)[0] == 404
    assert ask(server, "thumbnail/nothing.png")[0] == 404
    assert ask(server, "thumbnail/..%2f..%2fetc%2fpasswd.png")[0] == 404
    for path in ("..%2fserver.py", "../server.py", "%2e%2e/templates/page.html"):
        assert ask(server, f"assets/{path}")[0] == 404


def test_what_is_taken_is_a_download(server: Started) -> None:
    with visitor(server) as name:
        status, headers, body = ask(server, f"take/{name}/svg")
        assert status == 200
        assert headers["content-disposition"] == 'attachment; filename="tetrahedron.svg"'
        assert body.startswith(b"<svg")
        assert ask(server, f"take/{name}/png?scale=99")[0] == 400
        assert ask(server, f"take/{name}/png?scale=x")[0] == 400
        assert ask(server, f"take/{name}/nothing")[0] == 400
        assert ask(server, f"take/{name}/turntable")[0] == 404


def test_too_large_a_file_is_refused_before_it_is_kept(server: Started) -> None:
    with visitor(server) as name:
        status, _, body = ask(server, f"upload/{name}", data=bytes(12 * 2**20))
    assert status == 413
    assert b"MB" in body


def test_one_upload_of_a_visitor_at_a_time(server: Started) -> None:
    host = server.address.split("/")[2]
    with visitor(server) as name, socket.create_connection((host.split(":")[0], int(host.split(":")[1]))) as slow:
        slow.sendall(f"POST /upload/{name} HTTP/1.1\r\nHost: {host}\r\nContent-Length: 999\r\n\r\nx".encode())
        status = until(lambda: ask(server, f"upload/{name}", data=b"x")[0], 429)
        slow.close()
        assert status == 429
        assert until(lambda: ask(server, f"upload/{name}", data=b"x")[0], 400) == 400


def until(ask: Callable[[], int], wanted: int) -> int:
    """The answer, as soon as it is the wanted one."""
    for _ in range(100):
        if ask() == wanted:
            return wanted
        time.sleep(0.05)
    return 0


def test_a_link_that_is_none_opens_the_page(server: Started) -> None:
    link = "?p=%3Cscript%3Ealert(1)%3C/script%3E"
    status, _, body = ask(server, link)
    assert status == 200
    assert b"alert(1)" not in body
    with connect(f"{server.address.replace('http', 'ws', 1)}live{link}") as socket:
        assert json.loads(socket.recv())["texts"]["title"]
        assert "characters" in json.loads(socket.recv())["alert"]


def test_files_of_an_upload() -> None:
    assert unpack_upload(packed(("a.obj", b"v 0 0 0"))) == ("a.obj", b"v 0 0 0")
    name, data = unpack_upload(packed(("a.obj", b"1"), ("../b.mtl", b"2")))
    assert name is None
    assert unpack_upload(packed(("../b.mtl", b"2"), ("a.obj", b"1"))) == (name, data)  # it is the bytes that links name
    assert data.startswith(b"PK")
    assert b"b.mtl" in data
    assert b".." not in data


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"\xff\xff\xff\xff",
        packed(),
        packed(("a", b"1"))[:-1],
        packed(("a", b"1")) + b"2",
        b"\0\0\0\x0a[[[[[[[[[[",
        b'\0\0\0\x0c[["a", -1]]  ',
        b"\0\0\0\x04null",
    ],
)
def test_what_is_no_upload(body: bytes) -> None:
    with pytest.raises(InputError, match="malformed"):
        unpack_upload(body)


def test_bad_input_is_told_in_one_line(capsys: pytest.CaptureFixture[str], server: Started) -> None:
    port = server.address.rsplit(":", 1)[1].strip("/")
    for arguments, words in (
        (["--port", port], "cannot be used"),
        (["--port", "70000"], "65535"),
        (["--host", "no.such.name.invalid"], "--host"),
        (["--host", "192.0.2.1"], "--host must be an address of this machine"),
        (["--rpc", "ftp://node"], "--rpc"),
        (["no-such-piece"], "no-such-piece"),
        (["absent.obj"], "absent.obj"),
    ):
        assert run(["creator", "--no-browser", *arguments]) == 2
        error = capsys.readouterr().err
        assert words in error
        assert error.count("\n") == 1


def test_what_was_done_to_the_first_file_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.obj").write_text("v 0 0 0\n")
    facts = cast(Facts, SimpleNamespace(source=Source("upload", "ab" * 32)))

    class Reader:
        async def upload(self, visitor: str, name: str, data: bytes) -> Upload:
            return Upload(facts.source, facts, ("One thing was left out.", "Another as well."))

        async def open(self, source: Source) -> Facts:
            return facts

    assert asyncio.run(first_source(cast(Pool, Reader()), tmp_path / "a.obj")) == facts.source
    assert capsys.readouterr().err == "One thing was left out.\nAnother as well.\n"


def test_without_a_browser_the_address_is_said(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("webbrowser.open", lambda address: False)
    open_in_browser("http://127.0.0.1:1/")
    assert "open http://127.0.0.1:1/" in capsys.readouterr().err


def test_without_the_extra_it_is_said_how_to_get_it(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("shackled.cli.creator.find_spec", lambda name: None)
    assert run(["creator"]) == 2
    error = capsys.readouterr().err
    assert "pip install 'shackled[creator]'" in error
    assert error.count("\n") == 1
