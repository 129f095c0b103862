"""What a node says when it fails, in its many wordings, as errors."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from typing import Any

from ..errors import (
    ChainError,
    NodeBusyError,
    NodeError,
    NodeTimeoutError,
    NodeUnreachableError,
    OutOfGasError,
    RevertError,
    TooLargeError,
    WrongChainError,
)
from ..untrusted import plain

#: How nodes word it, in small letters and without anything but letters. The first group with a word that fits is taken.
TOO_LITTLE_GAS = (
    # geth, erigon, besu, hardhat; anvil and nethermind as one word
    "outofgas",
    "gasrequiredexceeds",
    "insufficientgas",
    "notenoughgas",
    # what is paid before the execution does not fit
    "intrinsicgas",
    "gastoolow",
    "gaslimittoolow",
    "gaslimitbelow",
    "floordatagas",
    "gasfloor",
    "callgascost",
    "requiresatleastgas",
    # reth and anvil, for memory
    "memoryoog",
    "memorylimit",
    # more was asked for than the node gives to one call
    "gaslimitistoohigh",
    "gaslimittoohigh",
    "gastoohigh",
    "exceedsblockgaslimit",
    "exceedsthegaslimit",
    "greaterthanblockgaslimit",
    "exceedsallowance",
    "gascap",
)
TOO_LARGE = (
    "responsesizeexceed",
    "responsesizeshould",
    "responsesizeis",
    "responsetoolarge",
    "responseistoobig",
    "responseexceed",
    "responsetoobig",
    "oversizedresponse",
    "requesttoolarge",
    "requestistoobig",
    "requesttoobig",
    "oversizedrequest",
    "requestentitytoolarge",
    "requestsizeexceed",
    "requestbodytoolarge",
    "contentlengthtoolarge",
    "payloadtoolarge",
    "lengthlimitexceeded",
    "bodylimit",
    "initcodesize",
    "initcodelimit",
    "initcodetoolarge",
)
TOO_OFTEN = (
    "ratelimit",
    "ratelimited",
    "requestrateexceeded",
    "toomanyrequests",
    "requestlimit",
    "requestcountexceeded",
    "computeunits",
    "capacityexceeded",
    "exceededitscompute",
    "throttl",
    "quotaexceeded",
    "creditsexceeded",
    "toomanyconnections",
    "serverisbusy",
    "serverbusy",
    "overloaded",
    "temporarilyunavailable",
)
NOT_READY = ("headernotfound", "missingtrienode", "blocknotfound", "unknownblock", "notsynced", "stillsyncing")
TOO_SLOW = ("timeout", "timedout", "deadlineexceeded", "executionaborted")
OLD_CHAIN = ("invalidopcode", "opcodenotfound", "notactivated", "badinstruction", "undefinedinstruction")

#: What JSON-RPC servers mean by their numbers, where the words say nothing.
REQUEST_TOO_BIG, RESPONSE_TOO_BIG, LIMIT_EXCEEDED, NO_METHOD = -32007, -32008, -32005, -32601


def http_failure(name: str, status: int, headers: Mapping[str, str], body: bytes) -> NodeError:
    """Return the error of an answer with an HTTP status that is not 200."""
    said = f"the {name} answered with HTTP status {status}"
    if status == 429 or (status == 503 and retry_after(headers) is not None):
        return too_often(name, retry_after(headers), f" (HTTP status {status})")
    if status == 413:
        return too_large(name, len(body) and _words(body))
    if status in (408, 504, 522, 524):
        return NodeTimeoutError(f"{said}: it took too long; take a smaller `size`, or another node")
    if status in (401, 403, 407):
        return NodeError(f"{said}: it lets nobody in without the right key; check its address")
    if status in (404, 405):
        return NodeError(f"{said}: there is no node at this path; check its address")
    if status == 503:
        return NodeBusyError(f"{said}: it is not available now; try again later, or take another node")
    if status >= 500:
        return NodeUnreachableError(f"{said}: it is out of order; try again later, or take another node")
    if 300 <= status < 400:
        return NodeError(f"{said}: it sends callers elsewhere; give the address where it really is")
    return NodeError(f"{said}{_quote(_words(body))}; check its address")


def rpc_failure(name: str, error: Any) -> ChainError:
    """Return the error that a node gave in place of a result, by its words, its number and its data."""
    fields = error if isinstance(error, dict) else {"message": error}
    message, code, data = str(fields.get("message", error)), fields.get("code"), fields.get("data")
    reverted = revert_data(data)
    letters = re.sub("[^a-z]", "", f"{message} {data if reverted is None else ''}".lower())

    def says(group: tuple[str, ...]) -> bool:
        return any(words in letters for words in group)

    if reverted or code == 3:
        return RevertError(f"the call was reverted: {_shorten(message)}", reverted or b"")
    if says(TOO_LARGE):
        return too_large(name, message)
    if says(TOO_OFTEN) or code == 429:
        return too_often(name, None, _quote(message))
    if says(TOO_LITTLE_GAS):
        return OutOfGasError(
            f"the {name} allows a call too little gas for this: take a smaller `size`, or raise its limit"
        )
    if says(OLD_CHAIN):
        return WrongChainError(
            f"the chain of the {name} does not know an instruction of the contracts: they need the rules of Cancun"
        )
    if says(NOT_READY):
        return NodeBusyError(f"the {name} is not ready{_quote(message)}; try again later, or take another node")
    if says(TOO_SLOW):
        return NodeTimeoutError(
            f"the {name} gave up a call that took too long{_quote(message)}; take a smaller `size`, or another node"
        )
    if "revert" in letters:
        return RevertError(f"the call was reverted: {_shorten(message)}")
    # numbers of which each host has its own understanding
    if code in (REQUEST_TOO_BIG, RESPONSE_TOO_BIG):
        return too_large(name, message)
    if code == LIMIT_EXCEEDED:
        return too_often(name, None, _quote(message))
    if code == NO_METHOD:
        return NodeError(f"the {name} does not offer what is needed{_quote(message)}; take another node")
    return NodeError(f"the {name} says: {_shorten(message)}")


def too_often(name: str, seconds: float | None, said: str = "") -> NodeBusyError:
    """Return the error of a node that wants to be asked less often."""
    when = "later" if seconds is None else f"in {math.ceil(seconds)} s"
    return NodeBusyError(
        f"the {name} asks to be called less often{said}; try again {when}, or take another node", seconds
    )


def too_large(name: str, said: object = "") -> TooLargeError:
    """Return the error of a node that takes no request, or gives no answer, of this size."""
    return TooLargeError(
        f"the {name} does not take a request or give an answer of this size{_quote(str(said or ''))}: "
        "take a smaller `size` or `max_triangles`, or raise its limit"
    )


def retry_after(headers: Mapping[str, str]) -> float | None:
    """Return the seconds that the header Retry-After asks for, given as such or as a date."""
    value = headers.get("Retry-After", "").strip()
    if not value:
        return None
    try:
        seconds = float(value)
    except ValueError:
        try:
            moment = parsedate_to_datetime(value)
        except ValueError:
            return None
        if moment.tzinfo is None:
            moment = moment.replace(tzinfo=UTC)
        seconds = (moment - datetime.now(UTC)).total_seconds()
    return max(0.0, seconds) if math.isfinite(seconds) else None


def revert_data(data: Any) -> bytes | None:
    """Find the bytes of a revert: nodes put them bare, behind a word, or in an object. None if there are none."""
    if isinstance(data, dict):
        for key in ("data", "result", "output", "return"):
            found = revert_data(data.get(key))
            if found is not None:
                return found
        return None
    match = re.search(r"(?:^|\s)0x((?:[0-9a-fA-F]{2})*)$", data.strip()) if isinstance(data, str) else None
    return bytes.fromhex(match[1]) if match else None


def _quote(said: str) -> str:
    return f" ({_shorten(said)})" if said.strip() else ""


def _shorten(said: str, most: int = 200) -> str:
    line = plain(" ".join(said.split()))
    return line if len(line) <= most else f"{line[:most]}..."


def _words(body: bytes) -> str:
    """Return the text of a page, without its tags."""
    return _shorten(re.sub(r"<[^>]*>", " ", body[:2000].decode(errors="replace")), 100)
