"""Failures of nodes and contracts as errors: HTTP status, messages of JSON-RPC in their many wordings, reverts."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from ..artifacts import known_errors
from ..base.untrusted import plain
from ..errors import (
    ChainError,
    NodeBusyError,
    NodeError,
    NodeTimeoutError,
    NodeUnreachableError,
    OutOfGasError,
    RenderError,
    RevertError,
    TooLargeError,
    WrongChainError,
)
from ..ethereum._abi import Errors, decode_error
from ..ethereum._encoding import to_hex

#: Phrases of nodes, as lower-case letters only. The first group with a phrase that occurs in the message applies.
TOO_LITTLE_GAS = """
    # geth, erigon, besu, hardhat; anvil and nethermind as one word
    outofgas | gasrequiredexceeds | insufficientgas | notenoughgas
    # the intrinsic gas exceeds the limit
    | intrinsicgas | gastoolow | gaslimittoolow | gaslimitbelow | floordatagas | gasfloor | callgascost
    | requiresatleastgas
    # reth and anvil, for memory
    | memoryoog | memorylimit
    # the limit exceeds the node's own
    | gaslimitistoohigh | gaslimittoohigh | gastoohigh | exceedsblockgaslimit | exceedsthegaslimit
    | greaterthanblockgaslimit | exceedsallowance | gascap
"""
TOO_LARGE = """
    responsesizeexceed | responsesizeshould | responsesizeis | responsetoolarge | responseistoobig | responseexceed
    | responsetoobig | oversizedresponse
    | requesttoolarge | requestistoobig | requesttoobig | oversizedrequest | requestentitytoolarge | requestsizeexceed
    | requestbodytoolarge | contentlengthtoolarge | payloadtoolarge | lengthlimitexceeded | bodylimit
    | initcodesize | initcodelimit | initcodetoolarge
"""
TOO_OFTEN = """
    ratelimit | requestrateexceeded | toomanyrequests | requestlimit | requestcountexceeded | computeunits
    | capacityexceeded | exceededitscompute | throttl | quotaexceeded | creditsexceeded | toomanyconnections
    | serverisbusy | serverbusy | overloaded | temporarilyunavailable
"""
NOT_READY = "headernotfound | missingtrienode | blocknotfound | unknownblock | notsynced | stillsyncing"
TOO_SLOW = "timeout | timedout | deadlineexceeded | executionaborted"
OLD_CHAIN = "invalidopcode | opcodenotfound | notactivated | badinstruction | undefinedinstruction"

#: Codes of JSON-RPC errors, for messages without a known phrase.
REQUEST_TOO_BIG, RESPONSE_TOO_BIG, LIMIT_EXCEEDED, NO_METHOD = -32007, -32008, -32005, -32601

#: What the other phrases say of a node.
SAID: dict[str, tuple[type[ChainError], str]] = {
    TOO_LITTLE_GAS: (OutOfGasError, "allows a call too little gas for this: use a smaller `size`, or raise its limit"),
    OLD_CHAIN: (WrongChainError, "does not know an instruction of the contracts: they need the rules of Cancun"),
    NOT_READY: (NodeBusyError, "is not ready{}; try again later, or use another node"),
    TOO_SLOW: (NodeTimeoutError, "aborted a call that took too long{}; use a smaller `size`, or another node"),
}

#: What the codes of `Panic` mean (the documentation of Solidity: "Panic via assert and Error via require").
PANICS = {
    0x01: "assertion failed",
    0x11: "arithmetic overflow",
    0x12: "division by zero",
    0x21: "value not in the enum",
    0x22: "damaged bytes in the storage",
    0x31: "pop of an empty array",
    0x32: "index out of range",
    0x41: "too much memory",
    0x51: "call of a function that is not set",
}


def http_failure(name: str, status: int, headers: Mapping[str, str], body: bytes) -> NodeError:
    """Return the error for an HTTP status other than 200."""
    said = f"the {name} answered with HTTP status {status}"
    if status == 429 or (status == 503 and retry_after(headers) is not None):
        return too_often(name, retry_after(headers), f" (HTTP status {status})")
    if status == 413:
        return too_large(name, len(body) and _words(body))
    if status in (408, 504, 522, 524):
        return NodeTimeoutError(f"{said}: it took too long; use a smaller `size`, or another node")
    if status in (401, 403, 407):
        return NodeError(f"{said}: it needs a key; check its address")
    if status in (404, 405):
        return NodeError(f"{said}: there is no node at this path; check its address")
    if status == 503:
        return NodeBusyError(f"{said}: it is not available now; try again later, or use another node")
    if status >= 500:
        return NodeUnreachableError(f"{said}: it is temporarily unavailable; try again later, or use another node")
    if 300 <= status < 400:
        return NodeError(f"{said}: it redirects requests; give the address to which it redirects")
    return NodeError(f"{said}{_quote(_words(body))}; check its address")


def rpc_failure(name: str, error: Any) -> ChainError:
    """Return the error for a JSON-RPC error, by its message, its code and its data."""
    fields = error if isinstance(error, dict) else {"message": error}
    message, code, data = str(fields.get("message", error)), fields.get("code"), fields.get("data")
    reverted = revert_data(data)
    letters = re.sub("[^a-z]", "", f"{message} {data if reverted is None else ''}".lower())

    def says(phrases: str) -> bool:
        return re.search(phrases, letters, re.VERBOSE) is not None

    if reverted or code == 3:
        return RevertError(f"the call was reverted: {_shorten(message)}", reverted or b"")
    if says(TOO_LARGE):
        return too_large(name, message)
    if says(TOO_OFTEN) or code == 429:
        return too_often(name, None, _quote(message))
    for phrases, (kind, text) in SAID.items():
        if says(phrases):
            return kind(f"the {name} {text.replace('{}', _quote(message))}")
    if "revert" in letters:
        return RevertError(f"the call was reverted: {_shorten(message)}")
    # codes that hosts use in different ways
    if code in (REQUEST_TOO_BIG, RESPONSE_TOO_BIG):
        return too_large(name, message)
    if code == LIMIT_EXCEEDED:
        return too_often(name, None, _quote(message))
    if code == NO_METHOD:
        return NodeError(f"the {name} does not support a method that is needed{_quote(message)}; use another node")
    return NodeError(f"the {name} answered: {_shorten(message)}")


def too_often(name: str, seconds: float | None, said: str) -> NodeBusyError:
    """Return the error for a node that limits the rate of requests."""
    when = "later" if seconds is None else f"in {math.ceil(seconds)} s"
    return NodeBusyError(
        f"the {name} limits the rate of requests{said}; try again {when}, or use another node", seconds
    )


def too_large(name: str, said: object = "") -> TooLargeError:
    """Return the error for a request or an answer that is too large for a node."""
    return TooLargeError(
        f"the {name} refuses a request or an answer of this size{_quote(str(said or ''))}: "
        "use a smaller `size` or `max_triangles`, or raise its limit"
    )


def retry_after(headers: Mapping[str, str]) -> float | None:
    """Return the seconds of the header Retry-After; None if it has none, or a date."""
    try:
        seconds = float(headers.get("Retry-After", ""))
    except ValueError:
        return None
    return max(0.0, seconds) if math.isfinite(seconds) else None


def revert_data(data: Any) -> bytes | None:
    """Return the data of a revert, which nodes send bare, after a word, or in an object; None if there is none."""
    if isinstance(data, dict):
        found = (revert_data(data.get(key)) for key in ("data", "result", "output", "return"))
        return next((each for each in found if each is not None), None)
    match = re.search(r"(?:^|\s)0x((?:[0-9a-fA-F]{2})*)$", data.strip()) if isinstance(data, str) else None
    return bytes.fromhex(match[1]) if match else None


def revert_error(data: bytes, gas_limit: int) -> ChainError:
    """Return the error for a reverted call. data: of the revert. gas_limit: of the call, for an OutOfGasError."""
    description = describe_revert(data)
    return out_of_gas(gas_limit) if description == "OutOfGas()" else RenderError(f"the contract refused: {description}")


def describe_revert(data: bytes, errors: Errors | None = None) -> str:
    """Write the data of a revert as text, such as "CanvasSize(width=0, height=17)". errors: by selector; None: ours."""
    if not data:
        return "the data of the call is not a scene that is encoded correctly"
    found = decode_error(data, known_errors() if errors is None else errors)
    if found is None:
        return f"error {to_hex(data[:68])}"
    name, values = found
    if name == "Error":
        return str(values["message"])
    if name == "Panic":
        return f"{PANICS.get(values['code'], 'panic')} (Panic {values['code']:#x})"
    return f"{name}({', '.join(f'{key}={_shown(value)}' for key, value in values.items())})"


def _shown(value: Any) -> str:
    """Write a value of an error: bytes as hexadecimal digits, structs and arrays in parentheses."""
    if isinstance(value, tuple):
        return f"({', '.join(map(_shown, value))})"
    return to_hex(value) if isinstance(value, bytes) else str(value)


def out_of_gas(limit: int) -> OutOfGasError:
    """Return the error for a call that ran out of gas."""
    error = OutOfGasError(f"the call ran out of gas: {limit:,} gas is not enough")
    error.limit = limit
    return error


def _quote(said: str) -> str:
    return f" ({_shorten(said)})" if said.strip() else ""


def _shorten(said: str, most: int = 200) -> str:
    line = plain(" ".join(said.split()))
    return line if len(line) <= most else f"{line[:most]}..."


def _words(body: bytes) -> str:
    """Return the text of an HTML page, shortened."""
    return _shorten(re.sub(r"<[^>]*>", " ", body[:2000].decode(errors="replace")), 100)
