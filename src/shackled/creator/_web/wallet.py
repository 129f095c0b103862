"""Minting through the visitor's own wallet, in the visitor's browser (EIP-1193).

The server has no key and asks no node: the page passes its requests to the wallet, which also reads from the chain.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from ...artifacts import artifact
from ...chain import AddressBook
from ...datasets import require
from ...errors import ChainError, InputError
from ...ethereum import checksum_address, ether, to_hex
from ...tokens import KINDS, PHASES, CollectionKind
from .._state import Source

#: Error codes of wallets (EIP-1193, EIP-3326, WalletConnect): the user rejected; the chain is unknown.
REFUSED, UNKNOWN_CHAIN = (4001, 5000), 4902
#: Seconds that a visitor may take to confirm.
PATIENCE = 300
#: Names of well-known chains.
CHAINS = {1: "Ethereum", 11155111: "Sepolia", 560048: "Hoodi", 31337: "a development chain"}
OPEN_FOR_ALL = 2
#: Seconds between two requests for the receipt, and the largest number of requests.
PAUSE, TRIES = 1.0, 240
#: Number of icons of a collection that are read, and of requests at a time.
MOST_ICONS, AT_ONCE = 1000, 16
#: Topic of the event Transfer(address,address,uint256).
TRANSFER = "0xddf252ad1be2c89b69c2b068fc378daa952ba7f163c4a11628f55a4df523b3ef"

Tell = Callable[[str], Awaitable[None]]


class WalletError(ChainError):
    """A wallet refused a request or does not answer. One line."""


class DeclinedError(WalletError):
    """The visitor rejected a request in the wallet."""


class UnknownChainError(WalletError):
    """The wallet does not know the chain to which it was asked to switch."""


class Waiting:
    """The requests to the wallets of a visitor that are not answered yet, by number."""

    def __init__(self) -> None:
        """Begin without requests."""
        self._next = 0
        self._open: dict[int, tuple[dict[str, Any], asyncio.Future[Any]]] = {}

    def open(self, wallet: int, method: str, parameters: list[Any]) -> tuple[dict[str, Any], asyncio.Future[Any]]:
        """Add a request; return it as sent to the page, and the future of its answer. wallet: place in the list."""
        self._next += 1
        question = {"id": self._next, "wallet": wallet, "method": method, "params": parameters}
        self._open[self._next] = question, asyncio.get_running_loop().create_future()
        return self._open[self._next]

    def close(self, question: dict[str, Any]) -> None:
        """Remove a request."""
        self._open.pop(question["id"], None)

    @property
    def questions(self) -> list[dict[str, Any]]:
        """Unanswered requests; a page that reconnects is sent them again, and asks its wallet only once."""
        return [question for question, answer in self._open.values() if not answer.done()]

    def answer(self, identity: object, result: Any, error: object, code: object = None) -> None:
        """Take an answer from the page; unknown ones are ignored. error, code: of the wallet, None if there is none."""
        _, waiting = self._open.get(identity, (None, None)) if isinstance(identity, int) else (None, None)
        if waiting is None or waiting.done():
            return
        if error is None:
            waiting.set_result(result)
            return
        kind = DeclinedError if code in REFUSED else UnknownChainError if code == UNKNOWN_CHAIN else WalletError
        waiting.set_exception(kind(f"the wallet reports: {' '.join(str(error).split())[:200]}"))


class Wallet:
    """One of the wallets that the page has found."""

    def __init__(self, waiting: Waiting, send: Callable[[dict[str, Any]], Awaitable[None]], number: int) -> None:
        """Take one of the wallets.

        waiting: requests of the visitor. send: sends a message to the page. number: place in the list of wallets.
        """
        self._waiting = waiting
        self._send = send
        self._number = number

    async def request(self, method: str, *parameters: Any) -> Any:
        """Return the answer of the wallet. WalletError if the wallet or the visitor refuses."""
        question, answer = self._waiting.open(self._number, method, list(parameters))
        await self._send({"wallet": question})
        try:
            async with asyncio.timeout(PATIENCE):
                return await answer
        except TimeoutError:
            raise WalletError("the wallet does not answer") from None
        finally:
            self._waiting.close(question)

    async def number(self, method: str, *parameters: Any) -> int:
        """Return the answer as an int; chains write numbers as "0x..."."""
        value = await self.request(method, *parameters)
        try:
            return int(str(value), 16)
        except ValueError:
            raise WalletError(f"the wallet answered {method} with {value!r:.60}, which is not a number") from None

    async def data(self, method: str, *parameters: Any) -> bytes:
        """Return the answer as bytes."""
        value = await self.request(method, *parameters)
        try:
            return bytes.fromhex(str(value).removeprefix("0x"))
        except ValueError:
            raise WalletError(f"the wallet answered {method} with {value!r:.60}, which is not bytes") from None

    async def read(self, contract: str, address: str, function: str, *arguments: Any) -> Any:
        """Call a function of a contract, by the name of its artifact; return its value, or a tuple of several."""
        interface = artifact(contract).interface
        call = {"to": address, "data": to_hex(interface.encode(function, *arguments))}
        answer = await self.data("eth_call", call, "latest")
        try:
            return interface.decode(function, answer)
        except ValueError as error:
            raise WalletError(f"the collection could not be read: {error}") from None

    async def account(self) -> str:
        """Ask for an account of the visitor; return its address."""
        accounts = await self.request("eth_requestAccounts")
        if not isinstance(accounts, list) or not accounts or not isinstance(accounts[0], str):
            raise WalletError("the wallet has no account")
        return accounts[0]

    async def send(self, transaction: dict[str, Any], tell: Tell, chain: int) -> dict[str, Any]:
        """Send a transaction to a chain, and return its receipt. WalletError if it failed, or takes too long.

        InputError if the wallet is on another chain: there the address has other code, or none, and keeps the ether.
        """
        found = await self.number("eth_chainId")
        if found != chain:
            raise InputError(f"the wallet is on {chain_name(found)} now, not on {chain_name(chain)}: switch it back")
        sent = await self.request("eth_sendTransaction", transaction | {"chainId": hex(chain)})
        await tell(f"Sent: {sent}. Waiting until it is included in a block …")
        for _ in range(TRIES):
            receipt = await self.request("eth_getTransactionReceipt", sent)
            if isinstance(receipt, dict):
                if receipt.get("status") != "0x1":
                    raise WalletError("the transaction failed: the contract refused it")
                return receipt
            await asyncio.sleep(PAUSE)
        raise WalletError(f"the transaction {sent} is not included in a block yet; check it later")


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


def chain_name(chain: int) -> str:
    """Return the name of a chain, or "chain" and its ID."""
    return CHAINS.get(chain, f"chain {chain}")


def offer_of(source: Source) -> Offer | None:
    """Return what can be minted of a source; None if the address book has no collection of it."""
    kind = KINDS.get(source.name.partition("/")[0]) if source.kind == "piece" else None
    if kind is None or (not kind.hidden and not require(source.name).commercial):
        return None
    places = AddressBook().places(kind.contract)
    return Offer(kind, source, places) if places else None


async def mint(offer: Offer, wallet: Wallet, tell: Tell) -> str:
    """Mint one token; return a sentence that names it. tell: called with a sentence on each step.

    InputError if it cannot be minted, WalletError if the wallet refuses.
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
    tokens = minted_tokens(await wallet.send(transaction, tell, chain), sale.address)
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
            raise WalletError(f"the wallet says that the sale has the phase {phase}, which there is not")
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


def minted_tokens(receipt: dict[str, Any], address: str) -> list[int]:
    """Return the tokens of a collection that a receipt names. WalletError if its events are not valid."""
    return [topics[3] for topics in events(receipt, address, TRANSFER)]


def events(receipt: dict[str, Any], address: str, kind: str) -> list[list[int]]:
    """Return the four topics of each event of a contract in a receipt. kind: the first topic."""
    found = []
    try:
        for log in receipt.get("logs") or ():
            topics = log["topics"]
            if log["address"].lower() == address.lower() and len(topics) == 4 and topics[0] == kind:
                found.append([int(topic, 16) for topic in topics])
                if not all(0 <= topic < 1 << 256 for topic in found[-1]):
                    raise ValueError(topics)
    except (AttributeError, KeyError, TypeError, ValueError):
        raise WalletError("the transaction succeeded, but the wallet returned an invalid receipt of it") from None
    return found
