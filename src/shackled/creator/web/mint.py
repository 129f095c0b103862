"""Minting through the visitor's own wallet, where a collection is known to the address book."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from ...artifacts import artifact
from ...chain import AddressBook
from ...datasets import require
from ...errors import InputError
from ...ethereum import checksum_address, ether
from ...tokens import KINDS, PHASES, CollectionKind
from ..state import Source
from .waiting import UnknownChainError, WalletError
from .wallet import Wallet

#: Names of chains that many know.
CHAINS = {1: "Ethereum", 11155111: "Sepolia", 17000: "Holesky", 31337: "a development chain"}
OPEN_FOR_ALL = 2
#: Seconds between two looks for the transaction, and how often it is looked for.
PAUSE, LOOKS = 1.0, 240
#: Icons of a collection that are looked at, and how many at once: a node is asked for each of them.
MOST_ICONS, AT_ONCE = 1000, 16
#: Of the event Transfer(address,address,uint256).
TRANSFER = "0xddf252ad1be2c89b69c2b068fc378daa952ba7f163c4a11628f55a4df523b3ef"

Tell = Callable[[str], Awaitable[None]]


@dataclass(frozen=True)
class Offer:
    """What may be minted of an object. places: addresses of its collection, by chain."""

    kind: CollectionKind
    source: Source
    places: dict[int, bytes]

    @property
    def words(self) -> str:
        """What one gets, for people."""
        where = ", ".join(chain_name(each) for each in self.places)
        if self.kind.hidden:
            return f"A token of {self.kind.title} ({where}). Which piece it is, chance decides once it is minted."
        return f"The icon as it stands in {self.kind.title} ({where}); changes made here are not in it."


def chain_name(chain: int) -> str:
    """A chain, for people."""
    return CHAINS.get(chain, f"chain {chain}")


def offer_of(source: Source, chains: AddressBook | None = None) -> Offer | None:
    """What may be minted of a source; None if there is no collection of it anywhere."""
    kind = KINDS.get(source.name.partition("/")[0]) if source.kind == "piece" else None
    if kind is None or (not kind.hidden and not require(source.name).commercial):
        return None
    places = (chains or AddressBook()).places(kind.contract)
    return Offer(kind, source, places) if places else None


async def mint(offer: Offer, wallet: Wallet, tell: Tell) -> str:
    """Mints one token; a sentence that says which. `tell` is told what goes on.

    InputError where it cannot be had; WalletError where the wallet refuses.
    """
    await tell("Waiting for the wallet …")
    accounts = await wallet.request("eth_requestAccounts")
    if not isinstance(accounts, list) or not accounts or not isinstance(accounts[0], str):
        raise WalletError("the wallet names no account")
    chain = await wallet.number("eth_chainId")
    if chain not in offer.places:
        chain = next(iter(offer.places))
        await tell(f"Asking the wallet to change to {chain_name(chain)} …")
        try:
            await wallet.request("wallet_switchEthereumChain", {"chainId": hex(chain)})
        except UnknownChainError:
            raise WalletError(
                f"the wallet does not know {chain_name(chain)} (chain ID {chain}): add it to the networks of the"
                " wallet, with the address of a node of yours, and mint again"
            ) from None
        if await wallet.number("eth_chainId") != chain:
            raise InputError(f"the wallet must be on {chain_name(chain)} for this")
    sale = _Sale(offer, wallet, checksum_address(offer.places[chain]))
    data, price = await sale.order()
    await tell(f"The price is {ether(price)}. Confirm it in the wallet …")
    transaction = {"from": accounts[0], "to": sale.address, "data": "0x" + data.hex(), "value": hex(price)}
    sent = await wallet.request("eth_sendTransaction", transaction)
    await tell(f"Sent: {sent}. Waiting until it is part of the chain …")
    for _ in range(LOOKS):
        receipt = await wallet.request("eth_getTransactionReceipt", sent)
        if isinstance(receipt, dict):
            return _minted(offer, receipt, sale.address)
        await asyncio.sleep(PAUSE)
    raise WalletError(f"the transaction {sent} is not part of the chain yet; look for it later")


class _Sale:
    """The collection, as the wallet reads it."""

    def __init__(self, offer: Offer, wallet: Wallet, address: str) -> None:
        self.address = address
        self._offer, self._wallet = offer, wallet
        self._interface = artifact(offer.kind.contract).interface

    async def order(self) -> tuple[bytes, int]:
        """The data that mints one token, and the price in wei. InputError if the sale is not open, or sold out."""
        phase = await self._read("phase")
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
        """The number and the price of the icon, which the collection knows by its name."""
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
        call = {"to": self.address, "data": "0x" + self._interface.encode(function, *arguments).hex()}
        answer = await self._wallet.data("eth_call", call, "latest")
        try:
            return self._interface.decode(function, answer)
        except ValueError as error:
            raise WalletError(f"the collection could not be read: {error}") from None


def _minted(offer: Offer, receipt: dict[str, Any], address: str) -> str:
    if receipt.get("status") != "0x1":
        raise WalletError("the transaction failed: the collection refused it")
    for log in receipt.get("logs", ()):
        topics = log.get("topics", ())
        if str(log.get("address", "")).lower() == address.lower() and len(topics) == 4 and topics[0] == TRANSFER:
            return f"Minted: token {int(topics[3], 16)} of {offer.kind.title}, at {address}"
    return f"Minted, in {offer.kind.title} at {address}"
