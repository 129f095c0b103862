"""Whether the blocks of a chain have randomness that nobody knows before, and headers that reveal it."""

from __future__ import annotations

from typing import Any

from ..chain import Connection, quantity
from ..errors import ChainError, InputError, NodeError, RevertError, TransactionError
from ..ethereum import encode_header, to_hex

#: Ethereum, its test networks Sepolia and Hoodi, and development nodes.
CHAINS = (1, 11155111, 560048, 31337, 1337)
#: Blocks that are looked at.
BLOCKS = 16
#: A program that says the hash of the block of a number: PUSH8 number BLOCKHASH PUSH0 MSTORE PUSH1 32 PUSH0 RETURN.
HASH = ("67", "405f5260205ff3")


def check_randomness(connection: Connection, any_chain: bool = False) -> None:
    """Check by the last blocks of a chain that seeds drawn there are known to nobody before, and can be revealed.

    any_chain: for chains that nobody here knows as well. InputError if the chain is unknown; TransactionError if it
    gives the same randomness twice, or headers that contracts cannot read.
    """
    chain = connection.chain_id
    if chain not in CHAINS and not any_chain:
        raise InputError(
            f"chain {chain} is neither Ethereum nor one of its test networks (chains {CHAINS[0]}, {CHAINS[1]} and "
            f"{CHAINS[2]}): on many others seeds are known before the mint, or can never be revealed; `any_chain` "
            "deploys all the same"
        )
    latest = connection.number("eth_blockNumber")
    # the first block of all is made by whoever begins the chain
    blocks = [connection.block(number) for number in range(max(1, latest - BLOCKS + 1), latest + 1)]
    randomness = [block.get("mixHash") for block in blocks]
    if len(set(randomness)) < len(blocks):
        raise TransactionError(
            f"the last {len(blocks)} blocks of chain {chain} do not each have a randomness (mixHash) of their own: "
            "seeds would be known before the mint, so a Genesis collection must not be deployed there"
        )
    # the hash of the last block can be read from the next one on
    for block in blocks[-2:-1]:
        _check_header(connection, block)


def _check_header(connection: Connection, block: dict[str, Any]) -> None:
    """Raise TransactionError if a header is none that `reveal` would take."""
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
        return  # not every node makes calls without a receiver
    except ChainError as error:
        if type(error) is NodeError:
            return
        raise
    if to_hex(found) != str(block.get("hash")).lower():
        raise TransactionError(
            f"tokens could never be revealed on chain {chain}: its contracts see 0x{found.hex()} as the hash of block "
            f"{number:,}, whose header has {block.get('hash')!s:.66}"
        )
