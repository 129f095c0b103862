"""Connections: every way in which a node can fail is one line that says what to do, and never shows a key."""

from __future__ import annotations

import pickle
import re
import threading
from typing import Any

import pytest

from nodes import Reply, failure, free_port, result, serving
from shackled.chain import Connection
from shackled.chain._connection import read_all
from shackled.chain._failures import retry_after, revert_data
from shackled.errors import (
    ChainError,
    InputError,
    NodeBusyError,
    NodeError,
    NodeTimeoutError,
    NodeUnreachableError,
    OutOfGasError,
    RevertError,
    TooLargeError,
    WrongChainError,
)

SECRET = "0123456789abcdefsecret"


def ask(reply: Reply, timeout: float = 20, attempts: int = 1) -> Any:
    """What a connection makes of a reply."""
    with serving(lambda _: reply) as url:
        return Connection(f"{url}/v3/{SECRET}", timeout, attempts).request("eth_call", {}, "latest")


def check(error: ChainError) -> None:
    """One line, with the name of the node, and without the key."""
    assert "\n" not in str(error)
    assert SECRET not in str(error)
    assert "node 127.0.0.1:" in str(error) or isinstance(error, RevertError)


def test_an_answer() -> None:
    with serving(lambda request: result([request["method"], request["params"], request["jsonrpc"]])) as url:
        connection = Connection(url)
        assert connection.request("eth_call", {"to": "0x1"}, "latest") == ["eth_call", [{"to": "0x1"}, "latest"], "2.0"]
        assert connection.request("eth_chainId") == ["eth_chainId", [], "2.0"]
        assert connection.name == f"node {url.removeprefix('http://')}"


@pytest.mark.parametrize(
    ("reply", "kind", "words"),
    [
        (Reply(b"<html>hello</html>"), NodeUnreachableError, "an answer that is not JSON"),
        (Reply(b""), NodeUnreachableError, "an empty answer"),
        (Reply(b'{"jsonrpc": "2.0", "id": 0, "resu'), NodeUnreachableError, "an answer that is not JSON"),
        (Reply(b"[" * 100_000), NodeUnreachableError, "an answer that is not JSON"),
        (Reply(b"[]"), NodeUnreachableError, "JSON that is not JSON-RPC"),
        (Reply(b'{"jsonrpc": "2.0", "id": 0}'), NodeUnreachableError, "JSON that is not JSON-RPC"),
        (Reply(b'{"jsonrpc": "2.0", "id": 999, "result": "0x"}'), NodeUnreachableError, "answered a different request"),
        (Reply(b'{"jsonrpc": "2.0", "id": null, "result": 5}' + b" " * 99, cut=20), NodeUnreachableError, "closed the"),
        (Reply(b"x" * 99, cut=0), NodeUnreachableError, "closed the"),
        (Reply(b"", 429, {"Retry-After": "7"}), NodeBusyError, "try again in 7 s"),
        (Reply(b"", 429), NodeBusyError, "limits the rate of requests (HTTP status 429); try again later, or"),
        (Reply(b"", 503), NodeBusyError, "HTTP status 503: it is not available now"),
        (Reply(b"", 503, {"Retry-After": "2.5"}), NodeBusyError, "requests (HTTP status 503); try again in 3 s"),
        (Reply(b"<h1>no</h1>", 413), TooLargeError, "of this size (no): use a smaller `size`"),
        (Reply(b"", 413), TooLargeError, "answer of this size: use a smaller `size`"),
        *[(Reply(b"", code), NodeUnreachableError, f"{code}: it is temporarily unavail") for code in (500, 502, 599)],
        *[(Reply(b"", code), NodeTimeoutError, f"{code}: it took too long") for code in (408, 504, 522, 524)],
        *[(Reply(b"", code), NodeError, f"status {code}: it needs a key") for code in (401, 403, 407)],
        *[(Reply(b"", code), NodeError, f"status {code}: there is no node at this path") for code in (404, 405)],
        *[(Reply(b"", code), NodeError, f"status {code}: it redirects requests") for code in (300, 301, 399)],
        *[(Reply(b"", code), NodeError, f"status {code}; check its address") for code in (299, 400, 499)],
        (
            Reply(b'{"jsonrpc": "2.0", "id": 999, "error": {"code": -32600, "message": "authenticate"}}', 401),
            NodeError,
            "HTTP status 401: it needs a key",
        ),
        (failure("invalid project id", -32002, status=401), NodeError, "answered: invalid project id"),
        (Reply(b"\xff no", 418), NodeError, "(\ufffd no)"),
        (Reply(b"teapot", 418), NodeError, "HTTP status 418 (teapot); check its address"),
        (Reply(b"<p>a  <b>tea</b>\n pot" + b"!" * 99, 418), NodeError, f"(a tea pot{'!' * 91}...); check"),
        (Reply(b"x" * 100, 418), NodeError, f"({'x' * 100}); check"),
        (Reply(b"<i" + b" " * 1990 + b">" + b"late" * 9, 418), NodeError, "(latelat); check"),
        (failure("daily limit", 429, status=429), NodeBusyError, "limits the rate"),
        (failure("invalid project id", -32000, status=400), NodeError, "answered: invalid project id"),
    ],
)
def test_answers_over_http_that_are_none(reply: Reply, kind: type[ChainError], words: str) -> None:
    with pytest.raises(kind, match=re.escape(words)) as error:
        ask(reply)
    assert type(error.value) is kind
    check(error.value)


#: As nodes and hosts word them.
WORDINGS = [
    # geth, erigon and those made of it
    (OutOfGasError, -32000, "out of gas"),
    (OutOfGasError, -32000, "err: intrinsic gas too low: have 21000, want 3000000 (supplied gas 21000)"),
    (OutOfGasError, -32000, "err: insufficient gas for floor data gas cost: have 5, want 9 (supplied gas 5)"),
    (TooLargeError, -32000, "max initcode size exceeded: code size 60000, limit 49152"),
    (NodeTimeoutError, -32002, "request timed out"),
    (NodeBusyError, -32000, "header not found"),
    (NodeBusyError, -32000, "missing trie node 45e9 (path )"),
    (WrongChainError, -32000, "invalid opcode: MCOPY"),
    # nethermind
    (OutOfGasError, -32015, "OutOfGas"),
    # besu
    (OutOfGasError, -32000, "Intrinsic gas exceeds gas limit"),
    (OutOfGasError, -32603, "INSUFFICIENT_GAS"),
    # anvil and hardhat
    (OutOfGasError, -32003, "CallGasCostMoreThanGasLimit { initial_gas: 21000, gas_limit: 5 }"),
    (OutOfGasError, -32000, "Transaction requires at least 30000 gas but got 21000"),
    (WrongChainError, -32603, "EVM error NotActivated"),
    # hosts
    (NodeBusyError, 429, "Your app has exceeded its compute units per second capacity."),
    (NodeBusyError, -32005, "daily request count exceeded, request rate limited"),
    (NodeBusyError, -32007, "50/second request limit reached - reduce calls per second"),
    (TooLargeError, -32602, "response size exceeded"),
    (RevertError, -32000, "execution reverted"),
]

#: Single words of them, each in a message where no other word tells.
WORDS = {
    OutOfGasError: [
        *("gas required exceeds 9", "not enough gas", "tx gas too low", "gas limit too low", "gas limit below 53000"),
        *("floor data gas above the limit", "gas floor more than gas limit", "MemoryOOG", "memory limit reached"),
        *("gas limit is too high", "gas limit too high", "gas too high", "exceeds block gas limit"),
        *("exceeds the gas limit", "greater than block gas limit", "exceeds allowance", "above the RPC gas cap"),
    ],
    TooLargeError: [
        *("response size should not be greater than 10000", "response size is larger than 150MB", "response too large"),
        *("response is too big", "response exceeded 10 MB", "response too big", "oversized response"),
        *("request is too big", "request too large", "request too big", "oversized request"),
        *("request entity too large", "request size exceeded", "request body too large", "content length too large"),
        *("payload too large", "length limit exceeded", "body limit of 5 MB", "initcode limit of 49152"),
        "initcode too large",
    ],
    NodeBusyError: [
        *("rate limit", "request rate exceeded", "too many requests", "request count exceeded"),
        *("out of compute units", "capacity exceeded", "you have exceeded its compute", "throttled"),
        *("quota exceeded", "credits exceeded", "too many connections", "the server is busy", "server busy"),
        *("overloaded", "temporarily unavailable", "block not found", "unknown block", "not synced", "still syncing"),
    ],
    NodeTimeoutError: ["timeout", "context deadline exceeded", "execution aborted"],
    WrongChainError: ["opcode not found", "bad instruction", "undefined instruction"],
}
WORDINGS += [(kind, -32000, words) for kind, all_words in WORDS.items() for words in all_words]


@pytest.mark.parametrize(
    ("kind", "code", "words"),
    [
        (TooLargeError, -32007, "answer of this size (no)"),
        (TooLargeError, -32008, "answer of this size (no)"),
        (NodeBusyError, -32005, "limits the rate of requests (no); try again later"),
        (NodeBusyError, 429, "limits the rate of requests (no); try again later"),
        (NodeError, -32601, "does not support a method that is needed (no); use another node"),
        (RevertError, 3, "the call was reverted: no"),
        *[(NodeError, code, "answered: no") for code in (-32009, -32006, -32004, -32600, -32602, 2, 4, 428, 430, None)],
    ],
)
def test_numbers_tell_where_words_do_not(kind: type[ChainError], code: int, words: str) -> None:
    with pytest.raises(kind, match=re.escape(words)) as error:
        ask(failure("no", code))
    assert type(error.value) is kind


@pytest.mark.parametrize(("kind", "code", "message"), WORDINGS)
def test_what_nodes_say(kind: type[ChainError], code: int, message: str) -> None:
    with pytest.raises(kind) as error:
        ask(failure(message, code))
    assert type(error.value) is kind
    check(error.value)


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        ("0x", b""),
        (None, None),
        ("Reverted 0x1234abcd", b"\x12\x34\xab\xcd"),
        (" 0xABcd ", b"\xab\xcd"),
        ("0x1234 56", None),
        ("10x12", None),
        ("0x123", None),
        (b"0x12", None),
        ({"message": "0x12"}, None),
        *[({"other": "0x34", key: "0x12"}, b"\x12") for key in ("data", "result", "output", "return")],
        ({"data": "no", "output": {"return": "0x12"}}, b"\x12"),
        ({"data": "0x12", "result": "0x34"}, b"\x12"),
    ],
)
def test_the_bytes_of_a_revert(data: Any, expected: bytes | None) -> None:
    """They tell more than words."""
    assert revert_data(data) == expected
    if expected:
        with pytest.raises(RevertError) as error:
            ask(failure("execution reverted: out of gas is not what it is", -32000, data))
        assert error.value.data == expected


def test_reverts_whose_words_are_of_something_else() -> None:
    """The contract may say anything: its data tells, then the number, and only then words."""
    with pytest.raises(RevertError) as error:
        ask(failure("request timed out", 3))
    assert error.value.data == b""
    # words in what is no data of a revert tell as well; no data is none
    with pytest.raises(OutOfGasError):
        ask(failure("transaction failed", -32000, "out of gas"))
    with pytest.raises(NodeError, match=r"answered: failed$"):
        ask(failure("failed", -32000, "0x"))
    with pytest.raises(NodeError, match=r"answered: failed$"):
        ask(failure("failed", -32000, {"message": "out of gas", "data": "0x"}))
    with pytest.raises(RevertError):
        ask(failure("VM Exception: revert", -32000, {"why": "later"}))


@pytest.mark.parametrize("size", [200, 201])
def test_long_messages_are_cut(size: int) -> None:
    with pytest.raises(NodeError) as error:
        ask(failure("n" * size))
    assert str(error.value).endswith(": " + "n" * 200 + "..." * (size > 200))


def test_an_error_that_is_no_object() -> None:
    with pytest.raises(NodeError, match=r"answered: plainly no$"):
        ask(Reply(b'{"jsonrpc": "2.0", "id": null, "error": "plainly no"}'))
    with pytest.raises(NodeError, match=r"answered: \{'code': -1\}$"):
        ask(Reply(b'{"jsonrpc": "2.0", "id": null, "error": {"code": -1}}'))


def test_a_node_that_repeats_the_address() -> None:
    with pytest.raises(NodeError, match=r"no such project: /v3/\*\*\*$") as error:
        ask(failure(f"no such project: /v3/{SECRET}"))
    check(error.value)


@pytest.mark.parametrize("url", [f"http://user:{SECRET}@127.0.0.1:1", f"http://127.0.0.1:1/?key={SECRET}"])
def test_keys_elsewhere_in_the_address(url: str) -> None:
    connection = Connection(url)
    assert connection.name == "node 127.0.0.1:1"
    with pytest.raises(NodeUnreachableError) as error:
        connection.request("eth_chainId")
    check(error.value)


def test_a_key_that_is_a_part_of_the_host() -> None:
    key = "0123456789abcdef0123456789abcdef"
    connection = Connection(f"http://{key}.node.invalid:1")
    assert connection.name == "node ***.node.invalid:1"
    with pytest.raises(NodeUnreachableError) as error:
        connection.request("eth_chainId")
    assert key not in str(error.value)
    with pytest.raises(InputError, match=r"not 'ws://\*\*\*\.node\.invalid/\.\.\.'") as wrong:
        Connection(f"ws://{key}.node.invalid/path")
    assert key not in str(wrong.value)
    assert Connection("http://ec2-12-34-56-78-some-long-name.node.invalid").name.startswith("node ec2-12")


@pytest.mark.parametrize(
    "url",
    [
        *("", "localhost:8545", "ftp://127.0.0.1", "http://", "http://[", "http://a:b:c/key0123456"),
        *("http://a b/key0123456", "http://a..b/key0123456", "http://a%zz/key0123456", "http://<a>/key0123456"),
    ],
)
def test_addresses_that_are_none(url: str) -> None:
    words = r"`url` must be the address of a node, such as http://127\.0\.0\.1:8545"
    with pytest.raises(InputError, match=words) as error:
        Connection(url)
    assert "key0123456" not in str(error.value)


def test_nobody_there() -> None:
    with pytest.raises(NodeUnreachableError, match="cannot be reached; is it running, and is its address right"):
        Connection(f"http://127.0.0.1:{free_port()}").request("eth_chainId")
    with pytest.raises(NodeUnreachableError, match="cannot be reached"):
        Connection("http://nobody.invalid").request("eth_chainId")


@pytest.mark.parametrize("reply", [Reply(delay=5), Reply(b"x" * 100, drip=0.05)])
def test_too_slow(reply: Reply) -> None:
    """It ends in time even if a byte comes now and then."""
    with pytest.raises(NodeTimeoutError, match=r"did not answer within 0.3 seconds.* `timeout`"):
        ask(reply, timeout=0.3)


def test_a_busy_node_is_asked_again() -> None:
    replies = iter([Reply(b"", 429, {"Retry-After": "0"}), failure("rate limit", -32005), result("0x7")])
    with serving(lambda _: next(replies)) as url:
        assert Connection(url, attempts=3).chain_id == 7


def test_a_busy_node_is_not_waited_for_too_long() -> None:
    with pytest.raises(NodeBusyError) as error:
        ask(Reply(b"", 429, {"Retry-After": "3600"}), attempts=3)
    assert error.value.retry_after == 3600
    assert pickle.loads(pickle.dumps(error.value)).retry_after == 3600


@pytest.mark.parametrize(
    ("value", "seconds"), [(" 1.5 ", 1.5), ("-3", 0), ("soon", None), ("nan", None), ("inf", None), (" ", None)]
)
def test_when_to_try_again(value: str, seconds: float | None) -> None:
    assert retry_after({"Retry-After": value}) == seconds
    assert retry_after({}) is None


def test_the_wrong_chain() -> None:
    with serving(lambda _: result("0x1")) as url:
        connection = Connection(url)
        connection.expect_chain(None)
        connection.expect_chain(1)
        with pytest.raises(WrongChainError, match="belongs to chain 1, not to chain 10"):
            connection.expect_chain(10)


@pytest.mark.parametrize("value", ["0x" + 65 * "1f", "0x" + 65 * "1", "0x1_0", " 0x1", "12", 7, None, ["0x1"], "0xzz"])
def test_results_of_another_type(value: Any) -> None:
    with serving(lambda _: result(value)) as url:
        if value != "0x" + 65 * "1f":
            with pytest.raises(NodeError, match="returned invalid bytes"):
                Connection(url).data("eth_call", {})
        with pytest.raises(NodeError, match="returned an invalid number"):
            _ = Connection(url).chain_id
    with serving(lambda _: result("0x" + 64 * "f")) as url:
        assert Connection(url).number("eth_gasPrice") == 2**256 - 1


def test_the_order_and_the_progress() -> None:
    reported: list[tuple[int, int]] = []
    found = list(read_all(lambda value: 2 * value, range(200), lambda done, total: reported.append((done, total))))
    assert found == [2 * value for value in range(200)]
    assert reported == [(done, 200) for done in range(1, 201)]


def test_several_are_read_at_a_time() -> None:
    together = threading.Barrier(4, timeout=20)
    list(read_all(lambda _: together.wait(), range(4)))


def test_an_endless_list_is_not_held() -> None:
    """A node may say that there are any number of things."""
    asked: list[int] = []

    def fail(value: int) -> None:
        asked.append(value)
        raise LookupError(value)

    with pytest.raises(LookupError):
        list(read_all(fail, range(2**62)))
    assert len(asked) < 100
