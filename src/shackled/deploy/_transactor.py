"""Transactions: signed here, sent to a node, and followed until they are mined."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..chain._connection import Connection, quantity
from ..chain._failures import revert_error
from ..errors import (
    ChainError,
    NoAnswerError,
    NodeError,
    NodeTimeoutError,
    NodeUnreachableError,
    OutOfGasError,
    RevertError,
    TransactionError,
)
from ..ethereum._amounts import GWEI, rounded
from ..ethereum._encoding import checksum_address, to_hex
from ._quote import Call, Fees, Quote, current_fees, make_quote, rollup_fee, with_rollup_fees

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

#: Seconds that a transaction may take to be mined.
PATIENCE = 180.0
#: Seconds of waiting after which `on_delay` is called.
DELAY = 1.0
#: Seconds for which the nonce of a transaction must be used, and its receipt missing, until it counts as replaced.
SETTLED = 2.0
#: Advice about a transaction whose outcome is unknown.
CHECK_FIRST = "check what became of it before you send it again"


@dataclass(frozen=True)
class Receipt:
    """A transaction that succeeded.

    gas: used. fee: paid, in wei, with that for data on L1. logs: events as JSON-RPC returns them.
    """

    hash: str
    block: int
    gas: int
    fee: int
    logs: tuple[dict[str, Any], ...] = ()


class Transactor:
    """Sends the transactions of one account, one after the other. Failures raise TransactionError."""

    def __init__(
        self, connection: Connection, account: LocalAccount, patience: float = PATIENCE, max_fee: int | None = None
    ) -> None:
        """Take the account that signs. patience: seconds to wait for a receipt. max_fee: see `current_fees`."""
        self.connection, self.patience, self.max_fee = connection, patience, max_fee
        self._account = account
        #: Called with a message once, if waiting takes more than a second.
        self.on_delay: Callable[[str], None] | None = None
        # a host has many nodes, and the next one may not know the last transaction yet
        self._nonce = 0
        self.address = bytes.fromhex(str(account.address)[2:])

    @property
    def name(self) -> str:
        """Description of the account for messages."""
        return f"the account {checksum_address(self.address)}"

    def balance(self) -> int:
        """Return the balance of the account, in wei."""
        return self.connection.balance(self.address)

    def fees(self) -> Fees:
        """Return the current prices of gas. Raises TransactionError as `current_fees`."""
        return current_fees(self.connection, self.max_fee)

    def quote(self, call: Call) -> Quote:
        """Return the quote of a transaction. Raises TransactionError if it would fail, or as `make_quote`."""
        quote = make_quote(self.connection.name, call, self.fees(), self.estimate(call))
        return with_rollup_fees(self.connection, [quote])[0]

    def estimate(self, call: Call) -> int:
        """Return the gas of a transaction, as the node estimates it. Raises TransactionError if it would fail."""
        try:
            return self.connection.number("eth_estimateGas", call.request(self.address))
        except RevertError as error:
            raise TransactionError(f"the transaction would fail: {_why(error.data)}") from None
        except OutOfGasError:
            raise TransactionError("the transaction would fail: it needs more gas than the chain allows") from None
        except NodeError as error:
            raise self._rejected(error, call.value) from None

    def send(self, quote: Quote) -> Receipt:
        """Send a transaction as it was quoted, and wait for its receipt.

        Raises TransactionError, and sends nothing, if the transaction would now cost more than the quote.
        """
        if risen := self._risen(quote):
            raise TransactionError(f"{risen} were quoted: the transaction was not sent; run the command again")
        call = quote.call
        nonce = self._count("pending")
        if nonce >= 1 << 64:
            raise NodeError(f"the {self.connection.name} reports an impossible nonce of {self.name}: {nonce:,}")
        transaction: dict[str, Any] = {
            "chainId": self.connection.chain_id,
            "nonce": max(self._nonce, nonce),
            "gas": quote.gas,
            "value": call.value,
            "data": to_hex(call.data),
            **quote.fees.fields,
        }
        if call.to is not None:
            transaction["to"] = checksum_address(call.to)
        signed = self._account.sign_transaction(transaction)
        digest = to_hex(bytes(signed.hash))
        try:
            self.connection.request("eth_sendRawTransaction", to_hex(bytes(signed.raw_transaction)))
        except NodeError as error:
            # the node may have it nevertheless, which its receipt shows
            known = re.search("already known|known transaction|already imported", str(error).lower())
            if not known and not isinstance(error, NodeTimeoutError | NodeUnreachableError):
                raise self._rejected(error, quote.ceiling) from None
        except OutOfGasError:
            raise OutOfGasError("the transaction was refused: its gas limit is out of the chain's range") from None
        try:
            receipt = self._follow(digest, transaction)
        except TransactionError:
            raise
        except ChainError as error:
            error.args = (f"the transaction {digest} was sent, {CHECK_FIRST}: {error}",)
            raise
        self._nonce = transaction["nonce"] + 1
        return receipt

    def _risen(self, quote: Quote) -> str:
        """Return what costs more now than was quoted; or nothing."""
        needed, base = self.estimate(quote.call), self.connection.block_field("baseFeePerGas")
        if needed > quote.gas:
            return f"the {self.connection.name} now estimates {needed:,} gas for this, and at most {quote.gas:,}"
        if base is not None and base > quote.fees.most:
            most = f"{quote.fees.most / GWEI:,.12g}"
            return f"the price of gas has risen to {base / GWEI:,.12g} gwei, and at most {most}"
        fee = None if quote.rollup_fee is None else rollup_fee(self.connection, quote)
        # no field of a transaction limits it; it can rise by an eighth before the next block of the other chain
        if quote.rollup_fee is not None and (fee is None or 9 * fee > 8 * quote.rollup_fee):
            now = "no bound of it any more" if fee is None else f"{rounded(fee)} ether"
            return f"the fee for data on L1 has risen: the chain tells {now}, and at most {rounded(quote.rollup_fee)}"
        return ""

    def wait_for_pending(self) -> None:
        """Wait until all transactions of the account are mined. Raises TransactionError if it takes too long."""

        def pending() -> int:
            return self._count("pending") - self._count("latest")

        if not self.wait(lambda: pending() <= 0 or None, f"pending transactions of {self.name}"):
            raise TransactionError(
                f"{self.name} still has {pending()} pending transactions after {self.patience:g} s: wait for them, or "
                "replace them, then try again"
            )

    def _count(self, block: str) -> int:
        return self.connection.number("eth_getTransactionCount", to_hex(self.address), block)

    def _follow(self, digest: str, transaction: dict[str, Any]) -> Receipt:
        replaced_since: float | None = None

        def ask() -> Any:
            nonlocal replaced_since
            receipt = self.connection.request("eth_getTransactionReceipt", digest)
            if receipt is not None:
                return receipt
            if self._count("latest") <= transaction["nonce"]:
                replaced_since = None
                return None
            replaced_since = replaced_since or time.monotonic()
            # it may have been mined since the first request, or another node of the host may have answered the second
            if time.monotonic() - replaced_since < SETTLED:
                return None
            raise TransactionError(
                f"the transaction {digest} was replaced: another one of {self.name} with the same nonce, "
                f"{transaction['nonce']:,}, was mined, so this one never will be; run the command again"
            )

        receipt = self.wait(ask, f"the transaction {digest} to be mined")
        if receipt is None:
            what = f"the transaction {digest} was sent, and is not mined after {self.patience:g} s; it may still be"
            raise TransactionError(f"{what}: {CHECK_FIRST}")
        try:
            status, gas, block = (quantity(receipt[key]) for key in ("status", "gasUsed", "blockNumber"))
            price, l1_fee = (quantity(receipt.get(key) or "0x0") for key in ("effectiveGasPrice", "l1Fee"))
        except (AttributeError, TypeError, LookupError, ValueError):
            raise NodeError(f"the {self.connection.name} returned an invalid receipt: {receipt!r:.60}") from None
        if status != 1:
            raise TransactionError(f"the transaction {digest} failed{self._reason(transaction, block)}")
        logs = receipt.get("logs") or []
        if not _are_logs(logs):
            raise TransactionError(
                f"the transaction {digest} succeeded, so do not send it again; but the {self.connection.name} returned "
                f"invalid events: {logs!r:.60}"
            )
        return Receipt(digest, block, gas, gas * price + l1_fee, tuple(logs))

    def _reason(self, transaction: dict[str, Any], block: int) -> str:
        """Return why a transaction failed, by repeating it as a call."""
        call = {"from": to_hex(self.address), "data": transaction["data"], "value": hex(transaction["value"])}
        call |= {"gas": hex(transaction["gas"])} | ({"to": transaction["to"]} if "to" in transaction else {})
        try:
            self.connection.request("eth_call", call, hex(max(0, block - 1)))
        except RevertError as error:
            return f": {_why(error.data, transaction['gas'])}"
        except ChainError as error:
            return f": {error}"
        return ""

    def wait(self, ask: Callable[[], Any], what: str = "the node") -> Any:
        """Call `ask`, again if a node does not answer, until it returns something; None after `patience` seconds."""
        started, pause, reported = time.monotonic(), 0.05, False
        end = started + self.patience
        while True:
            try:
                answer = ask()
                if answer is not None or time.monotonic() + pause > end:
                    return answer
            except NoAnswerError:
                if time.monotonic() + pause > end:
                    raise
            if self.on_delay is not None and not reported and time.monotonic() - started > DELAY:
                reported = True
                self.on_delay(f"waiting for {what}")
            time.sleep(pause)
            pause = min(2.0, pause * 1.5)

    def _rejected(self, error: NodeError, cost: int) -> ChainError:
        """Return an error with advice, for a node's refusal of a transaction."""
        said = str(error).lower()
        if re.search("insufficient funds|not enough funds|insufficient balance", said):
            return TransactionError(
                f"{self.name} has {rounded(self.balance())} ether, a transaction may cost {rounded(cost)}: send it some"
            )
        if "nonce" in said:
            return TransactionError(
                f"{self.name} was used by another program meanwhile ({error}): run the command again"
            )
        if re.search("underpriced|less than block base fee|fee cap|gas price", said):
            return TransactionError(f"the price of gas has risen meanwhile ({error}): run the command again")
        return TransactionError(f"the transaction was refused: {error}") if type(error) is NodeError else error


def _are_logs(logs: Any) -> bool:
    return isinstance(logs, list) and all(
        isinstance(log, dict)
        and _is_hex(log.get("address"), 20)
        and isinstance(log.get("topics"), list)
        and all(_is_hex(topic, 32) for topic in log["topics"])
        for log in logs
    )


def _is_hex(value: Any, size: int) -> bool:
    return isinstance(value, str) and re.fullmatch(f"0x[0-9a-fA-F]{{{2 * size}}}", value) is not None


def _why(data: bytes, gas: int = 0) -> str:
    return str(revert_error(data, gas)) if data else "the contract gave no reason"
