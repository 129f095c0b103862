"""The server of the page: what it refuses, and what it tells."""

from __future__ import annotations

import asyncio
import json
import re
import socket
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import cast

import pytest
from tools.page_server import Started, creator

from shackled.cli.app import run

pytest.importorskip("nicegui", reason="the page needs nicegui")

from nicegui import Client
from nicegui.page import page

from shackled.creator.picture import Upload
from shackled.creator.pool import Pool
from shackled.creator.scene import Facts
from shackled.creator.state import Source
from shackled.creator.web import unmet
from shackled.creator.web.headers import numbered
from shackled.creator.web.server import _browse, _first, unpack
from shackled.creator.web.unmet import MOST
from shackled.errors import InputError


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


def visitor(server: Started) -> str:
    found = re.search(rb'"visitor":"([\w-]+)"', ask(server, "")[2])
    assert found
    return found[1].decode()


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
    for path in (f"live/{visitor(server)}", "_nicegui_ws/socket.io/?EIO=4&transport=websocket"):
        assert _upgrade(server, path, "http://evil.example") == 403
        assert _upgrade(server, path, f"http://{host}") == 101


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


def test_pages_that_nobody_opens_are_few(server: Started) -> None:
    names = [visitor(server) for _ in range(MOST + 12)]
    # who asks for what there is not, is told by whether their page is still kept
    kept = [ask(server, f"take/{name}/nothing")[0] == 400 for name in names]
    assert kept == [False] * (len(names) - sum(kept)) + [True] * sum(kept)
    assert MOST / 2 < sum(kept) <= MOST + 1


def test_pages_that_nobody_opens_are_soon_forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(unmet, "PATIENCE", 0.05)

    async def story() -> list[int]:
        counts = []
        for _ in range(4):
            Client(page(""))
            unmet.bound_pages()
            counts.append(len(Client.instances))
        await asyncio.sleep(0.3)
        return [*counts, len(Client.instances)]

    before = len(Client.instances)
    assert [count - before for count in asyncio.run(story())] == [1, 2, 3, 4, 0]


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
    policy = headers["content-security-policy"]
    assert "unsafe-eval" not in policy
    assert "unsafe-inline" not in policy.split("style-src")[0]
    assert "frame-ancestors 'none'" in policy
    nonce = re.search(r"'nonce-([\w-]+)'", policy)
    assert nonce
    scripts = re.findall(rb"<script[^>]*>", body)
    assert scripts
    assert all(f'nonce="{nonce[1]}"'.encode() in script for script in scripts)
    assert nonce[1] != re.search(r"'nonce-([\w-]+)'", ask(server, "")[1]["content-security-policy"])[1]  # type: ignore[index]
    for name, value in (("x-content-type-options", "nosniff"), ("referrer-policy", "no-referrer")):
        assert headers[name] == value


def test_scripts_are_numbered() -> None:
    assert numbered(b"<script>a</script><script src=b>", "7") == b'<script nonce="7">a</script><script nonce="7" src=b>'


def test_nothing_is_given_to_who_is_not_known(server: Started) -> None:
    for path in ("take/nobody/png", "upload/nobody"):
        assert ask(server, path, data=b"x" if path.startswith("upload") else None)[0] == 404
    assert ask(server, "thumbnail/nothing.png")[0] == 404
    assert ask(server, "thumbnail/..%2f..%2fetc%2fpasswd.png")[0] == 404
    assert ask(server, "assets/..%2fserver.py")[0] == 404


def test_what_is_taken_is_a_download(server: Started) -> None:
    name = visitor(server)
    status, headers, body = ask(server, f"take/{name}/svg")
    assert status == 200
    assert headers["content-disposition"] == 'attachment; filename="tetrahedron.svg"'
    assert body.startswith(b"<svg")
    assert ask(server, f"take/{name}/png?scale=99")[0] == 400
    assert ask(server, f"take/{name}/png?scale=x")[0] == 400
    assert ask(server, f"take/{name}/nothing")[0] == 400


def test_too_large_a_file_is_refused_before_it_is_kept(server: Started) -> None:
    status, _, body = ask(server, f"upload/{visitor(server)}", data=bytes(12 * 2**20))
    assert status == 413
    assert b"MB" in body


def test_a_link_that_is_none_opens_the_page(server: Started) -> None:
    status, _, body = ask(server, "?p=%3Cscript%3Ealert(1)%3C/script%3E")
    assert status == 200
    assert b"alert(1)" not in body


def test_files_of_an_upload() -> None:
    assert unpack(packed(("a.obj", b"v 0 0 0"))) == ("a.obj", b"v 0 0 0")
    name, data = unpack(packed(("a.obj", b"1"), ("../b.mtl", b"2")))
    assert name is None
    assert unpack(packed(("../b.mtl", b"2"), ("a.obj", b"1"))) == (name, data)  # it is the bytes that links name
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
    with pytest.raises(InputError, match="no upload"):
        unpack(body)


def test_bad_input_is_told_in_one_line(capsys: pytest.CaptureFixture[str], server: Started) -> None:
    port = server.address.rsplit(":", 1)[1].strip("/")
    for arguments, words in (
        (["--port", port], "cannot be had"),
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

    assert asyncio.run(_first(cast(Pool, Reader()), tmp_path / "a.obj")) == facts.source
    assert capsys.readouterr().err == "One thing was left out.\nAnother as well.\n"


def test_without_a_browser_the_address_is_said(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("webbrowser.open", lambda address: False)
    _browse("http://127.0.0.1:1/")
    assert "open http://127.0.0.1:1/" in capsys.readouterr().err


def test_without_the_extra_it_is_said_how_to_get_it(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("shackled.cli.creator.find_spec", lambda name: None)
    assert run(["creator"]) == 2
    error = capsys.readouterr().err
    assert "pip install 'shackled[creator]'" in error
    assert error.count("\n") == 1
