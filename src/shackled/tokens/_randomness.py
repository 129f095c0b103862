"""Check that the blocks of a chain have unpredictable randomness, and headers that contracts can verify."""

from __future__ import annotations

from typing import Any

from ..chain import Connection, quantity
from ..errors import ChainError, InputError, NodeError, RevertError, TransactionError
from ..ethereum import encode_header, to_hex

#: Ethereum, its test networks Sepolia and Hoodi, and development nodes.
CHAINS = (1, 11155111, 560048, 31337, 1337)
#: Number of blocks to check.
BLOCKS = 16
#: A program that returns the hash of a block: PUSH8 number BLOCKHASH PUSH0 MSTORE PUSH1 32 PUSH0 RETURN.
HASH = ("67", "405f5260205ff3")


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
    blocks = [connection.block(number) for number in range(max(1, latest - BLOCKS + 1), latest + 1)]
    randomness = [block.get("mixHash") for block in blocks]
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
    chain = connection.chain_id
    try:
        encode_header(block)
        number = quantity(block.get("number"))
    except (OverflowError, TypeError, ValueError) as error:
        raise TransactionError(
            f"tokens could never be revealed on chain {chain}, whose headers are not Ethereum's: {error}"
        ) from None
    program = HASH[0] + number.to_bytes(8, "big").hex() + HASH[1]
    try:
        found = connection.data("eth_call", {"data": "0x" + program}, "latest")
    except RevertError:
        return  # some nodes refuse calls without a receiver
    except ChainError as error:
        if type(error) is NodeError:
            return
        raise
    if to_hex(found) != str(block.get("hash")).lower():
        raise TransactionError(
            f"tokens could never be revealed on chain {chain}: its contracts see 0x{found.hex()} as the hash of block "
            f"{number:,}, whose header has {block.get('hash')!s:.66}"
        )
