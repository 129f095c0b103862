"""Transactions that reveal tokens: they prove the headers of the blocks whose randomness determines the seeds."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ..deploy import Quote, Transactor, make_quotes
from ..errors import InputError, NodeError
from ..ethereum import encode_header
from ._collection import Collection
from ._contract import call_of, plan

#: Maximum number of rounds in a transaction.
ROUNDS_AT_ONCE = 40
#: Gas of a transaction, of each round in it, and of each header in one that proves an older block.
FIRST_GAS, REVEAL_GAS, HEADER_GAS = 45_000, 50_000, 25_000
#: Maximum number of headers in a transaction: each has about 600 bytes, and nodes accept 128 kB.
HEADERS_AT_ONCE = 150
#: Number of recent blocks whose hashes are available (EIP-2935), less a margin until a transaction is mined.
KNOWN_BLOCKS = 8191 - 64
#: The same on a chain without EIP-2935.
KNOWN_BLOCKS_BEFORE = 256 - 16
#: Number of tokens per call of `hiddenRounds`.
TOKENS_AT_ONCE = 256


@dataclass(frozen=True)
class Round:
    """A round of minting, whose tokens share the randomness of `block`."""

    number: int
    block: int


def hidden_rounds(collection: Collection) -> list[Round]:
    """Return the rounds with tokens that are not revealed."""
    minted = collection.minted()
    numbers: list[int] = []
    for first in range(0, minted, TOKENS_AT_ONCE):
        last = min(first + TOKENS_AT_ONCE, minted) - 1
        numbers += collection.contract.call("hiddenRounds", first, last)
    return [Round(number, collection.contract.call("blockOf", number)) for number in sorted(set(numbers))]


def latest_block(collection: Collection) -> int:
    """Return the number of the latest block."""
    return collection.connection.number("eth_blockNumber")


@dataclass(frozen=True)
class RevealCall:
    """A call that reveals tokens or proves old blocks. gas: approximate gas of its transaction."""

    function: str
    arguments: tuple[Any, ...]
    gas: int


def reveal_calls(collection: Collection, rounds: list[Round]) -> list[RevealCall]:
    """Return the calls that reveal rounds whose blocks are mined, in order.

    If block hashes are no longer available on the chain, the first calls prove them.
    """
    calls = list(_proofs(collection, [each.block for each in rounds if not _hash_known(collection, each.block)]))
    for first in range(0, len(rounds), ROUNDS_AT_ONCE):
        some = rounds[first : first + ROUNDS_AT_ONCE]
        headers = [header_of(collection, each.block) for each in some]
        calls.append(
            RevealCall("reveal", ([each.number for each in some], headers), FIRST_GAS + REVEAL_GAS * len(some))
        )
    return calls


def price_calls(transactor: Transactor, collection: Collection, calls: Sequence[RevealCall]) -> list[Quote]:
    """Return the quotes of one or more calls. Raises RevertError, with an explanation, if the first would revert."""
    first, *rest = calls
    contract = collection.contract
    quote = plan(transactor, contract, first.function, *first.arguments, gas=first.gas)
    later = [
        call_of(contract.interface, contract.address, each.function, *each.arguments, gas=each.gas) for each in rest
    ]
    return [quote, *make_quotes(transactor.connection, later, quote.fees, [quote], transactor.address)]


def header_of(collection: Collection, number: int) -> bytes:
    """Return the RLP header of a block, checked against its hash."""
    block = collection.connection.block(number)
    try:
        return encode_header(block)
    except InputError:
        raise
    except (OverflowError, TypeError, ValueError):
        raise NodeError(
            f"the {collection.connection.name} returned invalid fields of block {number:,}: {block!r:.60}"
        ) from None


def _proofs(collection: Collection, old: list[int]) -> Iterator[RevealCall]:
    """Yield calls that go back, header by header, from a block whose hash is available to each of the old ones."""
    if not old:
        return
    latest = latest_block(collection)
    starts = (max(latest - back, 1) for back in (KNOWN_BLOCKS, KNOWN_BLOCKS_BEFORE))
    known = next((number for number in starts if _hash_known(collection, number)), None)
    if known is None:
        raise NodeError(f"the collection does not know the hash of any block before {latest:,}")
    for block in sorted(old, reverse=True):
        while known > block:
            count = min(HEADERS_AT_ONCE, known - block)
            headers = [header_of(collection, number) for number in range(known, known - count, -1)]
            yield RevealCall("keepHash", (known, headers), FIRST_GAS + HEADER_GAS * count)
            # the block whose hash the contract has stored then
            known -= count


def _hash_known(collection: Collection, block: int) -> bool:
    return any(collection.contract.call("hashOf", block))
