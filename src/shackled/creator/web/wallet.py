"""The wallet of a visitor, in the visitor's browser (EIP-1193), asked through the wire of the page.

The server has no key, and asks no node: whatever is read from a chain for a visitor, their wallet reads.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from ...errors import RenderError

if TYPE_CHECKING:
    from .visitor import Visitor

#: Seconds that a visitor may think before they confirm.
PATIENCE = 300


class WalletError(RenderError):
    """A wallet refused, or does not answer. One line."""


class Wallet:
    """One of the wallets that the page has found. number: its place among them."""

    def __init__(self, visitor: Visitor, number: int) -> None:
        """Nothing is asked yet."""
        self._visitor = visitor
        self._number = number

    async def request(self, method: str, *parameters: Any) -> Any:
        """What the wallet answers. WalletError if it refuses, or the visitor does."""
        identity, answer = self._visitor.waiting.open()
        question = {"id": identity, "wallet": self._number, "method": method, "params": list(parameters)}
        await self._visitor.tell({"wallet": question})
        try:
            async with asyncio.timeout(PATIENCE):
                return await answer
        except TimeoutError:
            raise WalletError("the wallet does not answer") from None
        finally:
            self._visitor.waiting.close(identity)

    async def number(self, method: str, *parameters: Any) -> int:
        """The answer as a number, which chains write as "0x..."."""
        value = await self.request(method, *parameters)
        try:
            return int(str(value), 16)
        except ValueError:
            raise WalletError(f"the wallet answered {method} with {value!r:.60}, not with a number") from None

    async def data(self, method: str, *parameters: Any) -> bytes:
        """The answer as bytes."""
        value = await self.request(method, *parameters)
        try:
            return bytes.fromhex(str(value).removeprefix("0x"))
        except ValueError:
            raise WalletError(f"the wallet answered {method} with {value!r:.60}, not with bytes") from None


class Waiting:
    """Questions to the page that are not answered yet."""

    def __init__(self) -> None:
        """None so far."""
        self._next = 0
        self._open: dict[int, asyncio.Future[Any]] = {}

    def open(self) -> tuple[int, asyncio.Future[Any]]:
        """A new question: its number, and where its answer will be."""
        self._next += 1
        self._open[self._next] = asyncio.get_running_loop().create_future()
        return self._next, self._open[self._next]

    def close(self, identity: int) -> None:
        """Nobody waits for the answer any more."""
        self._open.pop(identity, None)

    def answer(self, identity: object, result: Any, error: object) -> None:
        """What the page answered; an answer to nothing is passed over."""
        waiting = self._open.get(identity) if isinstance(identity, int) else None
        if waiting is None or waiting.done():
            return
        if error is not None:
            waiting.set_exception(WalletError(f"the wallet says: {' '.join(str(error).split())[:200]}"))
        else:
            waiting.set_result(result)
