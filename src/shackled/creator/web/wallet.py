"""The wallet of a visitor, in the visitor's browser (EIP-1193), asked through the wire of the page.

The server has no key, and asks no node: whatever is read from a chain for a visitor, their wallet reads.
"""

from __future__ import annotations

import asyncio
from typing import Any

from .visitor import Visitor
from .waiting import WalletError

#: Seconds that a visitor may think before they confirm.
PATIENCE = 300


class Wallet:
    """One of the wallets that the page has found. number: its place among them."""

    def __init__(self, visitor: Visitor, number: int) -> None:
        """Nothing is asked yet."""
        self._visitor = visitor
        self._number = number

    async def request(self, method: str, *parameters: Any) -> Any:
        """What the wallet answers. WalletError if it refuses, or the visitor does."""
        question, answer = self._visitor.waiting.open(self._number, method, list(parameters))
        await self._visitor.tell({"wallet": question})
        try:
            async with asyncio.timeout(PATIENCE):
                return await answer
        except TimeoutError:
            raise WalletError("the wallet does not answer") from None
        finally:
            self._visitor.waiting.close(question)

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
