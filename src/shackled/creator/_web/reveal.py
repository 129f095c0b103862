"""Revealing tokens of Genesis by the visitor's own wallet, which also reads from the chain.

`find_reveal` makes the transaction, which the page shows, and `send_reveal` has the wallet send it. Nothing that the
wallet reports is trusted: each header is compared with the hash that the collection has of its block.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterable
from dataclasses import dataclass
from typing import Any, TypeVar

from ...artifacts import artifact
from ...chain import AddressBook
from ...errors import InputError
from ...ethereum import checksum_address, parse_address, to_hex
from ...tokens import (
    KINDS,
    KNOWN_BLOCKS_BEFORE,
    ROUNDS_AT_ONCE,
    TOKENS_AT_ONCE,
    Round,
    checked_header,
    reveal_call,
)
from ...values import plural
from .wallet import AT_ONCE, DeclinedError, Tell, Wallet, WalletError, chain_name

KIND = KINDS["genesis"]
#: Seconds between two requests for the latest block, and how many in a row may fail.
PAUSE, TRIES = 4.0, 10
#: The largest number of tokens of a collection.
MOST_TOKENS = 1024
COMMAND = "shackled token reveal"

Value = TypeVar("Value")
Read = TypeVar("Read")


@dataclass(frozen=True)
class Reveal:
    """A transaction that reveals rounds of a collection.

    wallet: its place in the list of wallets. randomness: of each round. gas: as counted here. later: a sentence about
    rounds that the transaction does not reveal, or "".
    """

    wallet: int
    chain: int
    collection: str
    rounds: tuple[Round, ...]
    randomness: tuple[bytes, ...]
    data: bytes
    gas: int
    later: str

    @property
    def words(self) -> str:
        """Description of the rounds and of the collection, in one phrase."""
        return f"{plural(len(self.rounds), 'round')} of {KIND.title}, at {self.collection} on {chain_name(self.chain)}"


def known_collection() -> str:
    """Return the address of a collection in the address book, or ""."""
    return next((checksum_address(each) for each in AddressBook().places(KIND.contract).values()), "")


def parse_collection(fields: Any) -> str:
    """Return the address of the collection from the fields of the page. InputError if it is wrong."""
    text = fields.get("collection") if isinstance(fields, dict) else None
    if not isinstance(text, str) or len(text) > 200:
        raise InputError("the collection must be a short text")
    return checksum_address(parse_address(text, "the collection"))


async def find_reveal(address: str, wallet: Wallet, number: int, tell: Tell) -> Reveal | None:
    """Return the transaction that reveals what can be revealed; None if everything is revealed.

    If no block of a hidden round is mined yet, wait for the first. number: of the wallet. tell: called with a sentence
    on each step. InputError if there is no collection, or if the hashes of all the blocks are no longer available;
    WalletError or NodeError if the wallet refuses, or returns an invalid answer.
    """
    await tell("Waiting for the wallet …")
    account = await wallet.account()
    chain = await wallet.number("eth_chainId")
    collection = _Collection(wallet, address)
    await collection.check(chain)
    await tell("Reading the collection …")
    rounds = await collection.hidden_rounds()
    latest = await wallet.number("eth_blockNumber")
    while rounds and rounds[0].missing_blocks(latest):
        latest = await _wait(wallet, rounds[0], latest, tell)
        await _require_chain(wallet, chain)
        rounds = await collection.hidden_rounds()
    if not rounds:
        return None
    mined = [each for each in rounds if not each.missing_blocks(latest)]
    hashes = await _all(lambda each: collection.read("hashOf", each.block), mined)
    known = [(each, found) for each, found in zip(mined, hashes, strict=True) if any(found)]
    later = _later(rounds, mined, len(known))
    if not known:
        if any(latest - each.block < KNOWN_BLOCKS_BEFORE for each in mined):
            raise WalletError("the collection cannot read the hash of the block yet: try again")
        raise InputError(later)
    chosen = known[:ROUNDS_AT_ONCE]
    headers = [await _header(wallet, each.block, found) for each, found in chosen]
    call = reveal_call([each for each, _ in chosen], headers)
    data = artifact(KIND.contract).interface.encode(call.function, *call.arguments)
    try:
        await wallet.data("eth_call", {"from": account, "to": address, "data": to_hex(data)}, "latest")
    except DeclinedError:
        raise
    except WalletError as error:
        raise WalletError(f"the collection would refuse the transaction: {error}") from None
    fields = tuple(each for each, _ in chosen), tuple(map(_randomness, headers))
    return Reveal(number, chain, address, *fields, data, call.gas, later)


async def send_reveal(reveal: Reveal, wallet: Wallet, tell: Tell) -> str:
    """Have the wallet send the transaction, and return a sentence that says what it revealed.

    InputError if it would reveal nothing any more, WalletError if the wallet refuses or returns an invalid answer.
    """
    await tell("Waiting for the wallet …")
    account = await wallet.account()
    await _require_chain(wallet, reveal.chain)
    collection = _Collection(wallet, reveal.collection)
    if all(map(any, await collection.randomness(reveal.rounds))):
        raise InputError("these tokens are revealed already")
    await tell("Confirm it in the wallet …")
    transaction = {"from": account, "to": reveal.collection, "data": to_hex(reveal.data), "value": "0x0"}
    await wallet.send(transaction, tell, reveal.chain)
    if tuple(await collection.randomness(reveal.rounds)) != reveal.randomness:
        raise WalletError("the transaction succeeded, but the collection does not have the randomness of the blocks")
    return f"Revealed: {reveal.words}. {reveal.later}".strip()


class _Collection:
    """The collection, read through the wallet."""

    def __init__(self, wallet: Wallet, address: str) -> None:
        self._wallet, self._address = wallet, address

    async def read(self, function: str, *arguments: Any) -> Any:
        return await self._wallet.read(KIND.contract, self._address, function, *arguments)

    async def check(self, chain: int) -> None:
        """Raise InputError if there is no such collection on the chain of the wallet."""
        try:
            name = await self.read("name")
        except DeclinedError:
            raise
        except WalletError:
            name = None
        if name != KIND.title:
            raise InputError(
                f"there is no {KIND.title} collection at {self._address} on {chain_name(chain)}: check the address, or "
                "switch the wallet to the chain of the collection"
            )

    async def hidden_rounds(self) -> list[Round]:
        """Return the rounds with tokens that are not revealed, in order."""
        minted = await self.read("totalSupply")
        if minted > MOST_TOKENS:
            raise WalletError(
                f"the wallet reports that the collection has {minted:,} tokens, more than {MOST_TOKENS:,}"
            )
        numbers: set[int] = set()
        for first in range(0, minted, TOKENS_AT_ONCE):
            numbers.update(await self.read("hiddenRounds", first, min(first + TOKENS_AT_ONCE, minted) - 1))
        blocks = await _all(lambda each: self.read("blockOf", each), sorted(numbers))
        return [Round(*each) for each in zip(sorted(numbers), blocks, strict=True)]

    async def randomness(self, rounds: Iterable[Round]) -> list[bytes]:
        """Return the randomness of rounds; zeros for those that are not revealed."""
        return await _all(lambda each: self.read("randomnessOf", each.number), rounds)


async def _wait(wallet: Wallet, first: Round, latest: int, tell: Tell) -> int:
    """Wait until a round can be revealed; return the number of the latest block."""
    failures = 0
    while missing := first.missing_blocks(latest):
        await tell(
            f"The seeds come from block {first.block:,}; the round can be revealed in {plural(missing, 'block')}. "
            "The page checks automatically, and then shows the transaction."
        )
        await asyncio.sleep(PAUSE)
        try:
            latest, failures = await wallet.number("eth_blockNumber"), 0
        except DeclinedError:
            raise
        except WalletError:
            # its node may fail now and then while the page waits for half an hour
            failures += 1
            if failures == TRIES:
                raise
    return latest


async def _header(wallet: Wallet, number: int, expected: bytes) -> bytes:
    block = await wallet.request("eth_getBlockByNumber", hex(number), False)
    if not isinstance(block, dict):
        raise WalletError(f"the node of the wallet does not have block {number:,}: use another one")
    return checked_header(block, number, expected, "node of the wallet")


def _randomness(header: bytes) -> bytes:
    """Return the PREVRANDAO of a header."""
    import rlp

    return bytes(rlp.decode(header)[13])


def _later(rounds: list[Round], mined: list[Round], known: int) -> str:
    """Return a sentence about the rounds that cannot be revealed now, or that do not fit in; "" if there are none.

    known: number of those whose block hashes the collection has.
    """
    words = []
    if known > ROUNDS_AT_ONCE:
        words.append(f"{plural(known - ROUNDS_AT_ONCE, 'more round')} can be revealed: search again afterwards.")
    if len(mined) > known:
        words.append(
            f"{plural(len(mined) - known, 'round')} cannot be revealed from this page, because the chain keeps no "
            f"hashes of such old blocks: the command `{COMMAND}` proves them, with --calldata FILE for a wallet."
        )
    if len(rounds) > len(mined):
        coming = rounds[len(mined)].block
        words.append(
            f"{plural(len(rounds) - len(mined), 'round')} cannot be revealed yet; the next one needs block {coming:,}."
        )
    return " ".join(words)


async def _require_chain(wallet: Wallet, chain: int) -> None:
    found = await wallet.number("eth_chainId")
    if found != chain:
        raise InputError(
            f"the wallet is on {chain_name(found)} now, and the tokens are on {chain_name(chain)}: switch it back"
        )


async def _all(read: Callable[[Value], Awaitable[Read]], values: Iterable[Value]) -> list[Read]:
    """Return what `read` returns of each value; some are read at a time."""
    wanted, found = list(values), list[Read]()
    for begin in range(0, len(wanted), AT_ONCE):
        found += await asyncio.gather(*map(read, wanted[begin : begin + AT_ONCE]))
    return found
