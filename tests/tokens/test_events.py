"""Events in receipts, also in those of nodes that lie."""

from __future__ import annotations

from typing import Any

import pytest

from shackled.errors import VerificationError
from shackled.ethereum._encoding import keccak256, to_hex, word
from shackled.tokens._contract import minted_tokens, withdrawn
from shackled.tokens._editions import added_number

HERE, ELSEWHERE = "0x" + "aB" * 20, "0x" + "cd" * 20
ADDED = "EditionAdded(uint256,address,address,string,uint256,bool,uint256,uint256,uint256)"


def log(signature: str, *topics: int, data: bytes = b"", address: str = HERE) -> dict[str, Any]:
    """An event as JSON-RPC has it."""
    words = [keccak256(signature.encode()), *map(word, topics)]
    return {"address": address.lower(), "topics": [*map(to_hex, words)], "data": to_hex(data)}


def transfer(token: int, **more: Any) -> dict[str, Any]:
    return log("Transfer(address,address,uint256)", 0, 7, token, **more)


def test_events_of_others_are_ignored() -> None:
    logs = [transfer(3), transfer(4, address=ELSEWHERE), transfer(5), log("Approval(address,address,uint256)", 0, 7, 6)]
    assert minted_tokens(logs, HERE) == [3, 5]
    # an event may be anonymous
    assert minted_tokens([{"address": HERE, "topics": [], "data": "0x"}, transfer(3)], HERE) == [3]


def test_sums_of_withdrawals() -> None:
    for event in (
        log("Withdrawn(address,uint256)", 7, data=word(5)),
        log("Withdrawn(address,address,uint256)", 7, 8, data=word(5)),
    ):
        assert withdrawn([event], HERE) == 5
        for logs in ([], [event, event], [event | {"address": ELSEWHERE}]):
            with pytest.raises(VerificationError, match="does not say what was withdrawn"):
                withdrawn(logs, HERE)


def test_a_new_edition_is_named_once() -> None:
    event = log(ADDED, 2**24 - 1, 7, 8, data=bytes(8 * 32))
    assert added_number([event, transfer(3)], HERE) == 2**24 - 1
    for logs in ([], [event, event]):
        with pytest.raises(VerificationError, match="names no new edition"):
            added_number(logs, HERE)


@pytest.mark.parametrize(
    "logs",
    [
        *(7, [7], ["zz"], [{}], [{"address": HERE}]),
        [transfer(3) | {"data": "0xzz"}],
        [transfer(3) | {"topics": transfer(3)["topics"][:3]}],
        [transfer(3) | {"topics": [*transfer(3)["topics"][:3], "-0x1"]}],
        [transfer(3) | {"topics": [*transfer(3)["topics"][:3], "0x1" + "00" * 32]}],
    ],
)
def test_invalid_events(logs: Any) -> None:
    with pytest.raises(VerificationError, match="the transaction succeeded, but its receipt has invalid events: "):
        minted_tokens(logs, HERE)
