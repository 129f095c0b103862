"""A connection to a node, through which all requests go."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar
from urllib.parse import SplitResult, unquote, urlsplit

from ..base.checks import number
from ..errors import ChainError, InputError, NoAnswerError, NodeBusyError, NodeError, WrongChainError
from ..ethereum._encoding import to_hex
from ._failures import rpc_failure

#: Default and maximum timeout of an answer, in seconds.
PATIENCE, MOST_PATIENCE = 120.0, 86_400.0
#: A label of a host name that looks like a key: some hosts put one there.
_KEY = re.compile("(?=[a-z]*[0-9])[0-9a-z]{20,}", re.IGNORECASE)
#: The longest pause before a retry, in seconds.
LONGEST_PAUSE = 20.0
#: Maximum number of concurrent requests, and of those that wait for a thread.
MAX_REQUESTS, MAX_WAITING = 6, 96
#: Called with the number of what is read, and that of all.
Report = Callable[[int, int], None]

Value = TypeVar("Value")
Read = TypeVar("Read")


class Connection:
    """A JSON-RPC client, safe for several threads. No message shows a key that is part of the URL."""

    def __init__(self, url: str, timeout: float = PATIENCE, attempts: int = 1) -> None:
        """Prepare requests; nothing is sent yet.

        timeout: seconds for a whole answer. attempts: how often a request to a busy node is tried.
        Raises InputError if the URL is invalid.
        """
        from ._transport import Transport

        self.url, self.timeout, self.attempts = url.strip(), check_timeout(timeout), attempts
        parts, host, port = check_url(self.url, "`url`")
        self.name = f"node {f'[{host}]' if ':' in host else _masked(host)}" + (f":{port}" if port else "")
        local = host in ("localhost", "::1") or host.startswith("127.")
        pieces = [parts.username, parts.password, *parts.path.split("/"), *parts.query.replace("=", "&").split("&")]
        long = [piece for piece in pieces if piece and len(piece) >= 8]
        long += [label for label in host.split(".") if _KEY.fullmatch(label)]
        self._secrets = {*long, *map(unquote, long)}
        self._transport = Transport(self.url, self.name, timeout, local)
        self._chain_id: int | None = None

    def request(self, method: str, *parameters: Any) -> Any:
        """Return the result of a method.

        Raises NodeError or a subclass if the node fails, RevertError or OutOfGasError if the requested call does.
        """
        pause = 0.5
        for attempt in range(self.attempts):
            try:
                return self._request(method, parameters)
            except NodeBusyError as error:
                pause = 2 * pause if error.retry_after is None else error.retry_after
                if attempt + 1 == self.attempts or pause > LONGEST_PAUSE:
                    raise
                time.sleep(pause)
        raise ValueError(f"attempts must be 1 or more, not {self.attempts}")

    def number(self, method: str, *parameters: Any) -> int:
        """Return the result of a method as a number of at most 256 bits."""
        result = self.request(method, *parameters)
        try:
            return quantity(result)
        except ValueError:
            raise NodeError(f"the {self.name} returned an invalid number for {method}: {result!r:.60}") from None

    def number_if_known(self, method: str, *parameters: Any) -> int | None:
        """Return the result of `number`; None if the node refuses it. Raises NoAnswerError."""
        try:
            return self.number(method, *parameters)
        except NoAnswerError:
            raise
        except ChainError:
            return None

    def data(self, method: str, *parameters: Any) -> bytes:
        """Return the result of a method as bytes."""
        result = self.request(method, *parameters)
        try:
            if isinstance(result, str) and result.startswith("0x"):
                return bytes.fromhex(result[2:])
        except ValueError:
            pass
        raise NodeError(f"the {self.name} returned invalid bytes for {method}: {result!r:.60}")

    def code(self, address: bytes) -> bytes:
        """Return the code at an address; empty if there is none."""
        return self.data("eth_getCode", to_hex(address), "latest")

    def balance(self, address: bytes) -> int:
        """Return the balance of an account, in wei."""
        return self.number("eth_getBalance", to_hex(address), "latest")

    def block(self, number: int | None = None) -> dict[str, Any]:
        """Return a block, by default the latest, without transactions. Raises NodeError if the node lacks it."""
        which = "latest" if number is None else hex(number)
        block = self.request("eth_getBlockByNumber", which, False)
        if block is None and number is not None:
            raise NodeError(f"the {self.name} does not have block {number:,}; use one that keeps all blocks")
        if not isinstance(block, dict):
            raise NodeError(f"the {self.name} returned an invalid block: {block!r:.60}")
        return block

    def block_field(self, field: str) -> int | None:
        """Return a number of the latest block, such as its base fee; None if it has none."""
        block = self.block()
        try:
            return None if block.get(field) is None else quantity(block[field])
        except ValueError:
            raise NodeError(f"the {self.name} returned an invalid block: {block!r:.60}") from None

    def block_gas_limit(self) -> int:
        """Return the gas that all transactions of a block may use."""
        limit = self.block_field("gasLimit")
        if limit is None:
            raise NodeError(f"the {self.name} returned a block without a gasLimit")
        return limit

    @property
    def chain_id(self) -> int:
        """The id of the chain, requested once."""
        if self._chain_id is None:
            self._chain_id = self.number("eth_chainId")
        return self._chain_id

    def expect_chain(self, chain_id: int | None) -> None:
        """Raise WrongChainError if the node belongs to another chain. None accepts any."""
        if chain_id is not None and self.chain_id != chain_id:
            raise WrongChainError(f"the {self.name} belongs to chain {self.chain_id}, not to chain {chain_id}")

    def _request(self, method: str, parameters: tuple[Any, ...]) -> Any:
        try:
            answer = self._transport.send(method, parameters)
            if answer.get("error"):
                raise rpc_failure(self.name, answer["error"])
            return answer["result"]
        except ChainError as error:
            # some nodes repeat the URL of the request in their messages
            error.args = tuple(self._clean(str(each)) for each in error.args)
            raise

    def _clean(self, text: str) -> str:
        for secret in self._secrets:
            text = text.replace(secret, "***")
        return text


def read_all(read: Callable[[Value], Read], values: Sequence[Value], report: Report | None = None) -> Iterator[Read]:
    """Yield what `read` returns of each value, in order; several are read concurrently."""
    with ThreadPoolExecutor(MAX_REQUESTS) as pool:
        for begin in range(0, len(values), MAX_WAITING):
            some = values[begin : begin + MAX_WAITING]
            for done, found in enumerate(pool.map(read, some), begin + 1):
                if report is not None:
                    report(done, len(values))
                yield found


def quantity(value: Any) -> int:
    """Parse a number of JSON-RPC, such as "0x2a", of at most 256 bits. Raises ValueError if it is invalid."""
    if isinstance(value, str) and re.fullmatch("0x[0-9a-fA-F]{1,64}", value):
        return int(value, 16)
    raise ValueError("it must be 0x and 1 to 64 hexadecimal digits")


def check_url(url: str, name: str) -> tuple[SplitResult, str, int | None]:
    """Return the parts of the address of a node, its host and its port. InputError, without keys, for anything else."""
    from ._transport import is_address

    try:
        parts = urlsplit(url.strip())
        host, port = parts.hostname, parts.port
    except ValueError:
        parts, host, port = urlsplit(""), None, None
    if parts.scheme not in ("http", "https") or not host or not is_address(url.strip()):
        shown = _without_key(url)
        raise InputError(f"{name} must be the address of a node, such as http://127.0.0.1:8545, not {shown!r}")
    return parts, host, port


def check_timeout(seconds: float) -> float:
    """Return the time limit of an answer. InputError if it is none."""
    if not 0 < number(seconds, "`timeout`") <= MOST_PATIENCE:
        raise InputError(f"`timeout` must be more than 0 seconds and at most {MOST_PATIENCE:,.0f}, not {seconds:g}")
    return seconds


def _without_key(url: str) -> str:
    """Return the part of a URL that holds no key."""
    scheme, mark, rest = url.partition("://")
    if not mark:
        scheme, rest = "", url
    host = rest.split("/")[0].split("?")[0].rpartition("@")[2]
    return f"{scheme}{mark}{_masked(host)}" + ("/..." if len(host) < len(rest) else "")


def _masked(host: str) -> str:
    return ".".join("***" if _KEY.fullmatch(label) else label for label in host.split("."))
