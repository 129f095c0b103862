"""Minting a token of a collection in the address book by the visitor's own wallet, which also reads from the chain."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from typing import Any

from ...artifacts import artifact
from ...chain import AddressBook
from ...datasets import require
from ...errors import InputError
from ...ethereum import checksum_address, ether, to_hex
from ...tokens import KINDS, PHASES, CollectionKind, minted_tokens
from .._state import Source
from .wallet import AT_ONCE, Tell, UnknownChainError, Wallet, WalletError, chain_name

OPEN_FOR_ALL = 2
#: Number of icons of a collection that are read.
MOST_ICONS = 1000


@dataclass(frozen=True)
class Offer:
    """A token that can be minted. places: addresses of the collection by chain ID."""

    kind: CollectionKind
    source: Source
    places: dict[int, bytes]

    @property
    def words(self) -> str:
        """Description of the token, in one or two sentences."""
        where = ", ".join(chain_name(each) for each in self.places)
        if self.kind.hidden:
            return f"A token of {self.kind.title} ({where}). The piece is chosen at random after minting."
        return f"The icon as stored in {self.kind.title} ({where}), without your changes."


def offer_of(source: Source) -> Offer | None:
    """Return what can be minted of a source; None if the address book has no collection of it."""
    kind = KINDS.get(source.name.partition("/")[0]) if source.kind == "piece" else None
    if kind is None or (not kind.hidden and not require(source.name).commercial):
        return None
    places = AddressBook().places(kind.contract)
    return Offer(kind, source, places) if places else None


async def mint(offer: Offer, wallet: Wallet, tell: Tell) -> str:
    """Mint one token; return a sentence that names it. tell: called with a sentence on each step.

    InputError if it cannot be minted; WalletError or VerificationError if the wallet refuses or its answer is invalid.
    """
    await tell("Waiting for the wallet …")
    account = await wallet.account()
    chain = await wallet.number("eth_chainId")
    if chain not in offer.places:
        chain = next(iter(offer.places))
        await tell(f"Asking the wallet to switch to {chain_name(chain)} …")
        try:
            await wallet.request("wallet_switchEthereumChain", {"chainId": hex(chain)})
        except UnknownChainError:
            raise WalletError(
                f"the wallet does not know {chain_name(chain)} (chain ID {chain}): add it to the networks of the"
                " wallet, with the address of a node, and mint again"
            ) from None
        if await wallet.number("eth_chainId") != chain:
            raise InputError(f"the wallet must be on {chain_name(chain)}")
    sale = _Sale(offer, wallet, checksum_address(offer.places[chain]))
    data, price = await sale.order()
    await tell(f"The price is {ether(price)}. Confirm it in the wallet …")
    transaction = {"from": account, "to": sale.address, "data": to_hex(data), "value": hex(price)}
    receipt = await wallet.send(transaction, tell, chain)
    tokens = minted_tokens(receipt.get("logs") or (), sale.address)
    if not tokens:
        raise WalletError("the transaction succeeded, but its receipt names no new token")
    return f"Minted: token {tokens[0]} of {offer.kind.title}, at {sale.address}"


class _Sale:
    """The collection, read through the wallet."""

    def __init__(self, offer: Offer, wallet: Wallet, address: str) -> None:
        self.address = address
        self._offer, self._wallet = offer, wallet
        self._interface = artifact(offer.kind.contract).interface

    async def order(self) -> tuple[bytes, int]:
        """Return the calldata that mints one token, and the price in wei. InputError if it is not on sale."""
        phase = await self._read("phase")
        if phase >= len(PHASES):
            raise WalletError(f"the wallet reports an invalid phase of the sale: {phase}")
        if phase != OPEN_FOR_ALL:
            raise InputError(f"the sale is {PHASES[phase]}")
        if self._offer.kind.hidden:
            (left, price), arguments = await asyncio.gather(self._read("left"), self._read("price")), [1]
        else:
            icon, price = await self._icon()
            left, arguments = await self._read("left", icon), [icon, 1]
        if not left:
            raise InputError("it is sold out")
        return self._interface.encode("mint", *arguments), price

    async def _icon(self) -> tuple[int, int]:
        """Return number and price of the icon, which the collection knows by its name."""
        name = self._offer.source.name
        known = {name, name.partition("/")[2], require(name).title}
        count = min(await self._read("iconCount"), MOST_ICONS)
        for begin in range(0, count, AT_ONCE):
            numbers = range(begin, min(begin + AT_ONCE, count))
            icons = await asyncio.gather(*(self._read("iconAt", number) for number in numbers))
            for number, icon in zip(numbers, icons, strict=True):
                if icon[0] in known:
                    return number, icon[3]
        raise InputError(f"there is no {require(name).title} in the collection")

    async def _read(self, function: str, *arguments: Any) -> Any:
        return await self._wallet.read(self._offer.kind.contract, self.address, function, *arguments)
