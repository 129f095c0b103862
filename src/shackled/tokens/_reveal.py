"""Transactions that reveal tokens by the headers of blocks, and a check that the blocks of a chain are fit for that."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ..base.values import plural
from ..chain._connection import Connection, quantity
from ..deploy._quote import Call, Fees, Quote, make_quotes
from ..errors import InputError, NoAnswerError, NodeError, RevertError, TransactionError
from ..ethereum._encoding import encode_header, keccak256, to_hex
from ._collection import Collection
from ._contract import simulate

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

    def missing_blocks(self, latest: int) -> int:
        """Return how many blocks must follow the latest one until the round can be revealed.

        Contracts read the hashes of earlier blocks only, and nodes simulate calls in the latest one: so one block must
        follow that of the round.
        """
        return max(0, self.block + 1 - latest)


def hidden_rounds(collection: Collection) -> list[Round]:
    """Return the rounds with tokens that are not revealed."""
    minted = collection.minted()
    numbers: list[int] = []
    for first in range(0, minted, TOKENS_AT_ONCE):
        last = min(first + TOKENS_AT_ONCE, minted) - 1
        numbers += collection.contract.call("hiddenRounds", first, last)
    return [Round(number, collection.contract.call("blockOf", number)) for number in sorted(set(numbers))]


def reveal_calls(collection: Collection, rounds: list[Round]) -> dict[str, Call]:
    """Return the transactions that reveal rounds whose blocks are not missing, in order, by their purpose.

    If block hashes are no longer available on the chain, the first ones prove them. Every header is compared with the
    hash that the collection has of its block, or proves. Raises NodeError if one differs.
    """
    hashes = {each.block: _hash_of(collection, each.block) for each in rounds}
    calls = dict(_proofs(collection, hashes))
    for first in range(0, len(rounds), ROUNDS_AT_ONCE):
        some = rounds[first : first + ROUNDS_AT_ONCE]
        numbers = [each.number for each in some]
        headers = [header_of(collection, each.block, hashes[each.block]) for each in some]
        purpose = f"reveal {plural(len(some), 'round')}, {', '.join(map(str, numbers))}"
        gas = FIRST_GAS + REVEAL_GAS * len(some)
        calls[purpose] = collection.contract.prepare("reveal", numbers, headers, gas=gas)
    return calls


def price_calls(connection: Connection, calls: Sequence[Call], fees: Fees, sender: bytes | None = None) -> list[Quote]:
    """Return the quotes of one or more transactions that follow each other. sender: None if a wallet sends them.

    Raises RevertError, with an explanation, if the first would revert.
    """
    simulate(connection, calls[0], sender)
    return make_quotes(connection, calls, fees, sender=sender)


def header_of(collection: Collection, number: int, expected: bytes) -> bytes:
    """Return the RLP header of a block from the node. Raises NodeError if it is invalid.

    expected: the hash of the block that the collection has.
    """
    name = collection.connection.name
    try:
        header = encode_header(collection.connection.block(number))
    except InputError as error:
        raise NodeError(f"the {name} returned an invalid block {number:,}: {error}") from None
    found = keccak256(header)
    if found != expected:
        raise NodeError(
            f"the {name} returned a wrong header of block {number:,}: its hash is {to_hex(found)}, and that of the "
            f"block is {to_hex(expected)}, as the collection reads it on the chain"
        )
    return header


def _proofs(collection: Collection, hashes: dict[int, bytes]) -> Iterator[tuple[str, Call]]:
    """Yield transactions that go back, header by header, from a block whose hash is available to each of the old ones.

    hashes: by block; those of the old ones are zeros, and are replaced by what the transactions prove.
    """
    old = sorted((block for block, known in hashes.items() if not any(known)), reverse=True)
    if not old:
        return
    latest = collection.connection.number("eth_blockNumber")
    starts = (max(latest - back, 1) for back in (KNOWN_BLOCKS, KNOWN_BLOCKS_BEFORE))
    number, expected = next(
        ((start, known) for start in starts if any(known := _hash_of(collection, start))), (0, bytes(32))
    )
    if number == 0:
        raise NodeError(f"the collection has no hash of a block before {latest:,}")
    for block in old:
        if block > number:
            raise NodeError(f"the collection cannot read the hash of block {block:,} yet: run the command again")
        while number > block:
            first, headers = number, list[bytes]()
            while number > block and len(headers) < HEADERS_AT_ONCE:
                headers.append(header_of(collection, number, expected))
                # a header begins with three bytes of its length, one of the next, and the hash of the block before
                expected = headers[-1][4:36]
                number -= 1
            # the contract then stores the hash of block `number`
            gas = FIRST_GAS + HEADER_GAS * len(headers)
            yield f"prove blocks before {first}", collection.contract.prepare("keepHash", first, headers, gas=gas)
        hashes[block] = expected


def _hash_of(collection: Collection, block: int) -> bytes:
    """Return the hash of a block that the collection can read or has stored; zeros if it has none."""
    return bytes(collection.contract.call("hashOf", block))


#: Ethereum, its test networks Sepolia and Hoodi, and development nodes.
CHAINS = (1, 11155111, 560048, 31337, 1337)
#: Number of blocks to check.
CHECKED_BLOCKS = 16


def check_randomness(connection: Connection, any_chain: bool = False) -> None:
    """Check, with the last blocks of a chain, that seeds are unpredictable there, and can be revealed.

    any_chain: accept unknown chains. Raises InputError if the chain is unknown; TransactionError if two blocks have the
    same randomness, or if contracts cannot verify its headers.
    """
    chain = connection.chain_id
    if chain not in CHAINS and not any_chain:
        raise InputError(
            f"chain {chain} is neither Ethereum nor one of its test networks (chains {CHAINS[0]}, {CHAINS[1]} and "
            f"{CHAINS[2]}): on many others seeds are predictable, or can never be revealed; `any_chain` deploys "
            "nevertheless"
        )
    latest = connection.number("eth_blockNumber")
    # without the genesis block
    blocks = [connection.block(number) for number in range(max(1, latest - CHECKED_BLOCKS + 1), latest + 1)]
    randomness = [str(block.get("mixHash")) for block in blocks]
    if len(set(randomness)) < len(blocks):
        raise TransactionError(
            f"some of the last {len(blocks)} blocks of chain {chain} have the same randomness (mixHash): seeds would "
            "be predictable, so a Genesis collection must not be deployed there"
        )
    # a block hash is available from the next block on
    for block in blocks[-2:-1]:
        _check_header(connection, block)


def _check_header(connection: Connection, block: dict[str, Any]) -> None:
    """Raise TransactionError if the function `reveal` would refuse a header."""
    never = f"tokens could never be revealed on chain {connection.chain_id}"
    try:
        number = quantity(block.get("number"))
        # PUSH8 number BLOCKHASH PUSH0 MSTORE PUSH1 32 PUSH0 RETURN: a program that returns the hash of the block
        program = b"\x67" + number.to_bytes(8, "big") + bytes.fromhex("405f5260205ff3")
        found = to_hex(keccak256(encode_header(block)))
    except (OverflowError, ValueError) as error:
        raise TransactionError(f"{never}, whose headers are not Ethereum's: {error}") from None
    if found != str(block.get("hash")).lower():
        raise TransactionError(
            f"{never}, whose headers have other fields than Ethereum's: that of block {number:,} has the hash {found}, "
            f"not {block.get('hash')!s:.66}"
        )
    try:
        seen = to_hex(connection.data("eth_call", {"data": to_hex(program)}, "latest"))
    except NoAnswerError:
        raise
    except (NodeError, RevertError):
        return  # some nodes refuse calls without a receiver
    if seen != found:
        raise TransactionError(f"{never}: its contracts see {seen} as the hash of block {number:,}, which has {found}")
