"""Questions to the wallet of a visitor that are not answered yet."""

from __future__ import annotations

import asyncio
from typing import Any

from ...errors import ChainError

#: Codes of wallets (EIP-1193, EIP-3326, WalletConnect): the visitor refused; the wallet does not know the chain.
REFUSED, UNKNOWN_CHAIN = (4001, 5000), 4902


class WalletError(ChainError):
    """A wallet refused, or does not answer. One line."""


class DeclinedError(WalletError):
    """The visitor said no to the wallet."""


class UnknownChainError(WalletError):
    """The wallet does not know the chain that it was to change to."""


class Waiting:
    """The questions, by their number."""

    def __init__(self) -> None:
        """None so far."""
        self._next = 0
        self._open: dict[int, tuple[dict[str, Any], asyncio.Future[Any]]] = {}

    def open(self, wallet: int, method: str, parameters: list[Any]) -> tuple[dict[str, Any], asyncio.Future[Any]]:
        """A new question, as the page is sent it, and where its answer will be."""
        self._next += 1
        question = {"id": self._next, "wallet": wallet, "method": method, "params": parameters}
        self._open[self._next] = question, asyncio.get_running_loop().create_future()
        return self._open[self._next]

    def close(self, question: dict[str, Any]) -> None:
        """Nobody waits for the answer any more."""
        self._open.pop(question["id"], None)

    @property
    def questions(self) -> list[dict[str, Any]]:
        """Those that are not answered; a page that was away is sent them again, and asks its wallet but once."""
        return [question for question, answer in self._open.values() if not answer.done()]

    def answer(self, identity: object, result: Any, error: object, code: object = None) -> None:
        """What the page answered; an answer to nothing is passed over. code: of the error, as the wallet gave it."""
        _, waiting = self._open.get(identity, (None, None)) if isinstance(identity, int) else (None, None)
        if waiting is None or waiting.done():
            return
        if error is None:
            waiting.set_result(result)
            return
        kind = DeclinedError if code in REFUSED else UnknownChainError if code == UNKNOWN_CHAIN else WalletError
        waiting.set_exception(kind(f"the wallet says: {' '.join(str(error).split())[:200]}"))
