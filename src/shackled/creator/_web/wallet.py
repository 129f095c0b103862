"""The visitor's own wallet, in the visitor's browser (EIP-1193).

The server has no key and asks no node: the page passes its requests to the wallet, which also reads from the chain.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any

from ...artifacts import artifact
from ...errors import ChainError, InputError
from ...ethereum import to_hex

#: Error codes of wallets (EIP-1193, EIP-3326, WalletConnect): the user rejected; the chain is unknown.
REFUSED, UNKNOWN_CHAIN = (4001, 5000), 4902
#: Seconds that a visitor may take to confirm.
PATIENCE = 300
#: Names of well-known chains.
CHAINS = {1: "Ethereum", 11155111: "Sepolia", 560048: "Hoodi", 31337: "a development chain"}
#: Seconds between two requests for the receipt, and the largest number of requests.
PAUSE, TRIES = 1.0, 240
#: Number of requests at a time.
AT_ONCE = 16

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


def chain_name(chain: int) -> str:
    """Return the name of a chain, or "chain" and its ID."""
    return CHAINS.get(chain, f"chain {chain}")
