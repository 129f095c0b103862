"""Events of a collection in the receipt of a transaction."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ..errors import VerificationError
from ..ethereum import keccak256, to_hex

TRANSFER = "Transfer(address,address,uint256)"
#: Of collections with an owner, and of editions.
WITHDRAWN = ("Withdrawn(address,uint256)", "Withdrawn(address,address,uint256)")


def find_events(logs: Iterable[Any], address: str, signature: str) -> list[list[int]]:
    """Return the words of each event of a contract, as numbers: those of its topics, then those of its data.

    logs: of a receipt, as JSON-RPC returns them. Raises VerificationError if an event is invalid.
    """
    kind, count = to_hex(keccak256(signature.encode())), signature.count(",") + 1
    found = []
    try:
        for log in logs:
            if log["address"].lower() != address.lower() or log["topics"][:1] != [kind]:
                continue
            data = bytes.fromhex(log.get("data", "").removeprefix("0x"))
            words = [int(topic, 16) for topic in log["topics"][1:]]
            words += [int.from_bytes(data[at : at + 32], "big") for at in range(0, len(data), 32)]
            if len(words) < count or not all(0 <= word < 1 << 256 for word in words):
                raise ValueError(log)
            found.append(words)
    except (AttributeError, LookupError, TypeError, ValueError):
        raise VerificationError(
            f"the transaction succeeded, but its receipt has invalid events: {logs!r:.60}"
        ) from None
    return found


def minted_tokens(logs: Iterable[Any], address: str) -> list[int]:
    """Return the tokens of a collection that a transaction minted or transferred. Errors as `find_events`."""
    return [token for _, _, token, *_ in find_events(logs, address, TRANSFER)]


def withdrawn(logs: Iterable[Any], address: str) -> int:
    """Return what a transaction withdrew from a collection, in wei. Raises VerificationError if no event says so."""
    amounts = [words[-1] for each in WITHDRAWN for words in find_events(logs, address, each)]
    if len(amounts) != 1:
        raise VerificationError("the transaction succeeded, but its receipt does not say what was withdrawn")
    return amounts[0]
