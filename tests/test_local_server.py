"""The server of pages for the browser of the user."""

from __future__ import annotations

import http.client
from collections.abc import Iterator
from contextlib import closing
from email.message import Message
from threading import Thread

import pytest

from shackled import InputError
from shackled.base.local_server import Answer, is_trusted, listen, type_of


@pytest.fixture(scope="module")
def port() -> Iterator[int]:
    def answer(path: str) -> Answer | None:
        if path == "/parts":
            return Answer((part for part in (b"a", b"b")), "text/plain")
        return Answer(path.encode(), type_of(path), {"X-Own": "1"}) if path.startswith("/a") else None

    with listen(answer, 0, 0) as server:
        Thread(target=server.serve_forever, daemon=True).start()
        yield server.server_port
        server.shutdown()


def ask(port: int, path: str, method: str = "GET", **headers: str) -> tuple[int, bytes, Message]:
    given = {name.replace("_", "-"): value for name, value in headers.items()}
    with closing(http.client.HTTPConnection("127.0.0.1", port, timeout=10)) as connection:
        connection.request(method, path, headers={"Host": f"127.0.0.1:{port}"} | given)
        answer = connection.getresponse()
        return answer.status, answer.read(), answer.headers


def test_answers(port: int) -> None:
    status, body, headers = ask(port, "/a%20b.js?query")
    assert (status, body) == (200, b"/a b.js")
    assert (headers["Content-Type"], headers["X-Own"]) == ("text/javascript", "1")
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert (ask(port, "/other")[0], ask(port, "/a", "POST")[0]) == (404, 501)
    assert ask(port, "/parts")[:2] == (200, b"ab")
    assert ask(port, "/a", "HEAD")[:2] == (200, b"")


def test_requests_of_other_sites_are_refused(port: int) -> None:
    own = f"localhost:{port}"
    refused: list[dict[str, str]] = [
        *({"Host": each} for each in ("evil.example", f"evil.example:{port}", "127.0.0.1", f"{own}.evil.example")),
        {"Origin": "http://evil.example"},
        {"Sec_Fetch_Site": "cross-site", "Sec_Fetch_Mode": "no-cors"},
        {"Sec_Fetch_Site": "cross-site", "Sec_Fetch_Mode": "navigate", "Sec_Fetch_Dest": "iframe"},
    ]
    for headers in refused:
        assert ask(port, "/a", **headers)[0] == 403, headers
    allowed: list[dict[str, str]] = [
        {"Host": own, "Origin": f"http://{own}", "Sec_Fetch_Site": "same-origin"},
        {"Sec_Fetch_Site": "cross-site", "Sec_Fetch_Mode": "navigate", "Sec_Fetch_Dest": "document"},
    ]
    for headers in allowed:
        assert ask(port, "/a", **headers)[0] == 200, headers


def test_the_usual_port_is_left_out() -> None:
    for host, is_own in (("127.0.0.1", True), ("localhost", True), ("evil.example", False), ("127.0.0.1:8080", False)):
        headers = Message()
        headers["Host"], headers["Origin"] = host, f"http://{host}"
        assert is_trusted(headers, 80) == is_own


def test_a_port_that_is_taken(port: int) -> None:
    with pytest.raises(InputError, match=f"port {port} of 127.0.0.1 cannot be used: .*; choose another `port`"):
        listen(lambda path: None, port, 0)
    with listen(lambda path: None, None, port) as other:
        assert other.server_port not in (0, port)
