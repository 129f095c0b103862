"""Revealing tokens: showing a collection the headers of the blocks whose randomness their seeds are made of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ..deploy import Quote, Transactor, make_quotes
from ..errors import InputError, NodeError
from ..ethereum import encode_header
from ._actions import call_of, plan
from ._collection import Collection

#: Rounds in a transaction.
ROUNDS_AT_ONCE = 40
#: What a transaction takes, each round in it, and each header of one that proves an older block.
FIRST_GAS, REVEAL_GAS, HEADER_GAS = 45_000, 50_000, 25_000
#: Headers in a transaction that proves an old block: each has about 600 bytes, and nodes take 128 kB.
HEADERS_AT_ONCE = 150
#: How far back the chain knows hashes by itself (EIP-2935), with a margin for the time until a transaction is mined.
KNOWN_BLOCKS = 8191 - 64
#: The same on a chain without EIP-2935.
KNOWN_BLOCKS_BEFORE = 256 - 16
#: Tokens asked for at once.
TOKENS_AT_ONCE = 256


@dataclass(frozen=True)
class Round:
    """Blocks that share a randomness. block: whose it is."""

    number: int
    block: int


def hidden_rounds(collection: Collection) -> list[Round]:
    """Return the rounds of all tokens that are not revealed, each once."""
    minted = collection.minted()
    numbers: list[int] = []
    for first in range(0, minted, TOKENS_AT_ONCE):
        last = min(first + TOKENS_AT_ONCE, minted) - 1
        numbers += collection.contract.call("hiddenRounds", first, last)
    return [Round(number, collection.contract.call("blockOf", number)) for number in sorted(set(numbers))]


def latest_block(collection: Collection) -> int:
    """Return the number of the last block of the chain."""
    return collection.connection.number("eth_blockNumber")


@dataclass(frozen=True)
class Step:
    """A transaction that reveals: function and arguments. gas: about what it takes."""

    function: str
    arguments: tuple[Any, ...]
    gas: int


def steps(collection: Collection, rounds: list[Round]) -> list[Step]:
    """Return the transactions that reveal rounds whose blocks are there, in this order.

    Where rounds are so late that the chain has forgotten their blocks, the hashes of these are proven first.
    """
    made = list(_proofs(collection, [each.block for each in rounds if not _hash_known(collection, each.block)]))
    for first in range(0, len(rounds), ROUNDS_AT_ONCE):
        some = rounds[first : first + ROUNDS_AT_ONCE]
        headers = [header_of(collection, each.block) for each in some]
        made.append(Step("reveal", ([each.number for each in some], headers), FIRST_GAS + REVEAL_GAS * len(some)))
    return made


def price_steps(transactor: Transactor, collection: Collection, todo: Sequence[Step]) -> list[Quote]:
    """Return the prices of one or more steps. Raises RevertError, in words, if the first would be refused."""
    first, *rest = todo
    contract = collection.contract
    quote = plan(transactor, contract, first.function, *first.arguments, ours=first.gas)
    calls = [
        call_of(contract.interface, contract.address, each.function, *each.arguments, ours=each.gas) for each in rest
    ]
    return [quote, *make_quotes(transactor.connection, calls, quote.fees, [quote], transactor.address)]


def header_of(collection: Collection, number: int) -> bytes:
    """Return the header of a block, whose hash the node says and we check."""
    block = collection.connection.block(number)
    try:
        return encode_header(block)
    except InputError:
        raise
    except (OverflowError, TypeError, ValueError):
        raise NodeError(
            f"the {collection.connection.name} tells a block {number:,} with fields that are none: {block!r:.60}"
        ) from None


def _proofs(collection: Collection, forgotten: list[int]) -> Iterator[Step]:
    """Transactions that go back, header by header, from a block that the chain knows to each of some older ones."""
    if not forgotten:
        return
    latest = latest_block(collection)
    starts = (max(latest - back, 1) for back in (KNOWN_BLOCKS, KNOWN_BLOCKS_BEFORE))
    known = next((number for number in starts if _hash_known(collection, number)), None)
    if known is None:
        raise NodeError(f"the collection does not know the hash of any block before {latest:,}")
    for block in sorted(forgotten, reverse=True):
        while known > block:
            count = min(HEADERS_AT_ONCE, known - block)
            headers = [header_of(collection, number) for number in range(known, known - count, -1)]
            yield Step("keepHash", (known, headers), FIRST_GAS + HEADER_GAS * count)
            # this is the block whose hash is kept then
            known -= count


def _hash_known(collection: Collection, block: int) -> bool:
    return any(collection.contract.call("hashOf", block))
