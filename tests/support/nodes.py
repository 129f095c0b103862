"""Nodes for tests: real ones, and servers that behave as nodes should not."""

from __future__ import annotations

import http.server
import json
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from typing import Any

import pytest
import requests
from tools.anvil import Anvil, find_anvil
from web3 import HTTPProvider, Web3

from shackled.artifacts import artifact

ANVIL = find_anvil()
#: Skipped without anvil: see tests/conftest.py. Tests that use the fixture `node` have this mark.
needs_anvil = pytest.mark.node

#: Of the first account that anvil gives ether to, as its documentation has it. It is worth nothing anywhere else.
KEY = "0xac0974bec39a17e36ba4a6b4d238ff944bacb478cbed5efcae784d7bf4f2ff80"
#: Limits as a public node has them: geth's default for calls, on a chain with the main network's blocks.
PUBLIC = ("--gas-limit", "50000000")


class Node(Anvil):
    """An anvil, with what tests ask of it."""

    @property
    def accounts(self) -> list[str]:
        """Those to which it gives ether."""
        return [str(account) for account in self.web3.eth.accounts]

    @property
    def web3(self) -> Web3:
        """web3.py, which knows nothing of ours."""
        return Web3(HTTPProvider(self.url, {"timeout": 60}, exception_retry_configuration=None))

    def contract(self, name: str, address: str) -> Any:
        """A contract of ours as web3.py sees it."""
        return self.web3.eth.contract(address=Web3.to_checksum_address(address), abi=artifact(name).abi)

    def transact(self, function: Any, sender: str, value: int = 0) -> Any:
        """Send a transaction of web3.py; return its receipt."""
        receipt = self.web3.eth.wait_for_transaction_receipt(function.transact({"from": sender, "value": value}))
        assert receipt["status"] == 1
        return receipt

    def mine(self, blocks: int) -> None:
        """Make so many blocks."""
        self.rpc("anvil_mine", hex(blocks))

    def balance(self, account: str | bytes) -> int:
        """In wei."""
        return int(self.web3.eth.get_balance(Web3.to_checksum_address(account)))


def anvil(*options: str) -> Node:
    """A node, to be used as a context; several may run at once. Tests that call this have the mark of needs_anvil."""
    assert ANVIL is not None
    return Node(ANVIL, *options)


@dataclass(frozen=True)
class Reply:
    """What a server sends. cut: so many bytes of the body are sent, then the connection is closed. delay: seconds
    before anything is sent. drip: seconds between single bytes of the body.
    """

    body: bytes = b""
    status: int = 200
    headers: dict[str, str] = field(default_factory=dict)
    cut: int | None = None
    delay: float = 0.0
    drip: float = 0.0


def result(value: Any) -> Reply:
    """A node's answer; `serving` puts in the number of the request."""
    return Reply(json.dumps({"jsonrpc": "2.0", "id": None, "result": value}).encode())


def failure(message: str, code: int = -32000, data: Any = None, status: int = 200) -> Reply:
    """A node's refusal."""
    error = {"code": code, "message": message} | ({} if data is None else {"data": data})
    return Reply(json.dumps({"jsonrpc": "2.0", "id": None, "error": error}).encode(), status)


def forward(url: str, request: dict[str, Any]) -> Reply:
    """What a real node says."""
    answer = requests.post(url, json=request, timeout=60)
    return Reply(answer.content, answer.status_code)


@contextmanager
def serving(answer: Callable[[dict[str, Any]], Reply]) -> Iterator[str]:
    """The address of a server that answers each request as the function says."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            request = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            reply = answer(request)
            body = reply.body
            if reply.status == 200 and b'"id": null' in body and b'"result"' in body:
                body = body.replace(b'"id": null', b'"id": ' + json.dumps(request["id"]).encode(), 1)
            time.sleep(reply.delay)
            try:
                self.send_response(reply.status)
                for name, value in {"Content-Length": str(len(body)), **reply.headers}.items():
                    self.send_header(name, value)
                self.end_headers()
                if reply.drip:
                    for each in body:
                        self.wfile.write(bytes([each]))
                        time.sleep(reply.drip)
                else:
                    self.wfile.write(body[: reply.cut])
            except OSError:
                pass
            if reply.cut is not None:
                self.close_connection = True
                self.connection.shutdown(socket.SHUT_RDWR)

        def do_OPTIONS(self) -> None:
            """Allow pages to ask; whether they may read the answer is said there."""
            self.send_response(204)
            for name in ("Origin", "Headers"):
                self.send_header(f"Access-Control-Allow-{name}", "*")
            self.end_headers()

        def log_message(self, *_: Any) -> None:
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    server.block_on_close = False
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{server.server_port}"
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


def replying(target: str, **replies: Reply | Callable[[dict[str, Any]], Reply | None]) -> AbstractContextManager[str]:
    """A node in front of another, with replies of its own to some methods, or from a request; None passes it on."""

    def answer(request: dict[str, Any]) -> Reply:
        reply = replies.get(request["method"])
        own = reply if reply is None or isinstance(reply, Reply) else reply(request)
        return forward(target, request) if own is None else own

    return serving(answer)


def geth(url: str, cap: int) -> AbstractContextManager[str]:
    """A node in front of another that gives calls no more gas than `cap`, and says nothing of it."""

    def call(request: dict[str, Any]) -> Reply:
        fields = request["params"][0]
        fields["gas"] = hex(min(int(fields.get("gas", hex(cap)), 16), cap))
        return forward(url, request)

    return replying(url, eth_call=call)


@contextmanager
def without_overrides(url: str, refuse: bool = True) -> Iterator[str]:
    """A node in front of another that refuses state overrides, or takes no notice of them, as old ones do."""

    def answer(request: dict[str, Any]) -> Reply:
        if len(request.get("params", [])) > 2:
            if refuse:
                return failure("too many arguments, want at most 2", -32602)
            request = request | {"params": request["params"][:2]}
        return forward(url, request)

    with serving(answer) as found:
        yield found


def free_port() -> int:
    """A port on which nobody listens."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])
