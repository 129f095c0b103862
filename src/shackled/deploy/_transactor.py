"""Transactions: signed here, sent to a node, followed until they are in a block."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..chain import Connection, quantity, refusal
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
from ..ethereum import GWEI, checksum_address, rounded, to_hex
from ._quote import Call, Fees, Quote, base_fee, current_fees, make_quote

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

#: Seconds that a transaction may take to come into a block.
PATIENCE = 180.0
#: Seconds after which it is told what is waited for.
LATE = 1.0
#: Said of a transaction whose fate is not known.
LOOK_FIRST = "do not send it again before you know what became of it"


@dataclass(frozen=True)
class Receipt:
    """A transaction that succeeded. gas: used in all. fee: paid, in wei. logs: as the node has them."""

    hash: str
    block: int
    gas: int
    fee: int
    logs: tuple[dict[str, Any], ...] = ()


class Transactor:
    """Makes the transactions of one account, one after the other. TransactionError says why one failed."""

    def __init__(
        self,
        connection: Connection,
        account: LocalAccount,
        patience: float = PATIENCE,
        max_fee: int | None = None,
    ) -> None:
        """patience: seconds to wait for a receipt. max_fee: see `current_fees`."""
        self.connection, self.patience, self.max_fee = connection, patience, max_fee
        self._account = account
        #: Told, if there is anyone, what is waited for, as soon as it takes more than a second.
        self.late: Callable[[str], None] | None = None
        #: Hosts have many nodes, and the next may not have heard of the last transaction yet.
        self._nonce = 0
        self.address = bytes.fromhex(str(account.address)[2:])

    @property
    def name(self) -> str:
        """The account, for people."""
        return f"the account {checksum_address(self.address)}"

    def balance(self) -> int:
        """Return the balance of the account, in wei."""
        return self.connection.balance(self.address)

    def fees(self) -> Fees:
        """Return what gas costs now; TransactionError as `current_fees` has it."""
        return current_fees(self.connection, self.max_fee)

    def quote(self, call: Call) -> Quote:
        """Return a quote for what can be sent now; TransactionError if it would fail, or as `make_quote` has it."""
        return make_quote(self.connection.name, call, self.fees(), self.estimate(call))

    def estimate(self, call: Call) -> int:
        """Return the gas that a transaction needs, as the node estimates it; TransactionError if it would fail."""
        try:
            return self.connection.number("eth_estimateGas", call.request(self.address))
        except RevertError as error:
            raise TransactionError(f"the transaction would fail: {_why(error.data)}") from None
        except OutOfGasError:
            raise TransactionError("the transaction would fail: it needs more gas than the chain allows one") from None
        except NodeError as error:
            raise self._rejected(error, call.value) from None

    def send(self, quote: Quote) -> Receipt:
        """Sends a transaction as it was quoted, and waits for its receipt.

        TransactionError if the node wants more by now than the quote allows; then nothing is sent.
        """
        call = quote.call
        needed = self.estimate(call)
        if needed > quote.gas:
            raise TransactionError(
                f"the {self.connection.name} now estimates {needed:,} gas for a transaction whose price was told for "
                f"{quote.gas:,} at most: it was not sent; run the same again for a new price"
            )
        base = base_fee(self.connection)
        if base is not None and base > quote.fees.most:
            raise TransactionError(
                f"gas has become more expensive meanwhile, {base / GWEI:,.12g} gwei, and at most "
                f"{quote.fees.most / GWEI:,.12g} were told: the transaction was not sent; run the same again"
            )
        nonce = self.connection.number("eth_getTransactionCount", to_hex(self.address), "pending")
        if nonce >= 1 << 64:
            raise NodeError(f"the {self.connection.name} says that {self.name} has made {nonce:,} transactions")
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
        receipt = self.send_signed(bytes(signed.raw_transaction), digest, quote.ceiling, transaction)
        self._nonce = transaction["nonce"] + 1
        return receipt

    def send_signed(self, raw: bytes, digest: str, cost: int = 0, transaction: dict[str, Any] | None = None) -> Receipt:
        """Sends what is signed, and waits for its receipt. cost: what the account must have, in wei, for messages."""
        try:
            self.connection.request("eth_sendRawTransaction", to_hex(raw))
        except NodeError as error:
            said = str(error).lower()
            # it may have come through before; whether it did shows when it is asked for
            known = any(words in said for words in ("already known", "known transaction", "already imported"))
            if not known and not isinstance(error, NodeTimeoutError | NodeUnreachableError):
                raise self._rejected(error, cost) from None
        except OutOfGasError:
            raise OutOfGasError("the transaction was refused: its gas is not what the chain allows one") from None
        try:
            return self._follow(digest, transaction)
        except TransactionError:
            raise
        except ChainError as error:
            error.args = (f"the transaction {digest} was sent, {LOOK_FIRST}: {error}",)
            raise

    def offer(self, raw: bytes) -> None:
        """Sends what somebody else signed and cannot pay yet.

        TransactionError if the node would not take it then, OutOfGasError if its gas would not do.
        """
        try:
            self.connection.request("eth_sendRawTransaction", to_hex(raw))
        except OutOfGasError:
            raise
        except NodeError as error:
            if _unbound(error):
                raise self._rejected(error, 0) from None
        except ChainError:
            pass

    def settle(self) -> None:
        """Waits until all transactions of the account are in blocks."""

        def waiting() -> int:
            count = [
                self.connection.number("eth_getTransactionCount", to_hex(self.address), block)
                for block in ("pending", "latest")
            ]
            return count[0] - count[1]

        if not self.wait(lambda: waiting() <= 0 or None, f"transactions of {self.name} that are in no block yet"):
            raise TransactionError(
                f"{self.name} has {waiting()} transactions that are in no block after {self.patience:g} s: "
                "wait for them, or replace them, then try again"
            )

    def _follow(self, digest: str, transaction: dict[str, Any] | None) -> Receipt:
        what = f"a block that takes the transaction {digest}"
        receipt = self.wait(lambda: self.connection.request("eth_getTransactionReceipt", digest), what)
        if receipt is None:
            raise TransactionError(
                f"the transaction {digest} is in no block after {self.patience:g} s: it was sent, and may still come; "
                f"{LOOK_FIRST}"
            )
        try:
            status, gas, block = (quantity(receipt[key]) for key in ("status", "gasUsed", "blockNumber"))
            price = quantity(receipt.get("effectiveGasPrice") or "0x0")
        except (AttributeError, TypeError, LookupError, ValueError):
            raise NodeError(f"the {self.connection.name} answered with what is no receipt: {receipt!r:.60}") from None
        if status != 1:
            raise TransactionError(f"the transaction {digest} failed{self._reason(transaction, block)}")
        logs = receipt.get("logs") or []
        if not _are_logs(logs):
            raise TransactionError(
                f"the transaction {digest} succeeded, so do not send it again; but the {self.connection.name} tells "
                f"events that are none: {logs!r:.60}"
            )
        return Receipt(digest, block, gas, gas * price, tuple(logs))

    def _reason(self, transaction: dict[str, Any] | None, block: int) -> str:
        """Return why a transaction failed, by making it again as a call."""
        if transaction is None:
            return ""
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
        """Ask until the answer is not None, and return it; None if it takes too long. A node that fails is asked again.

        what: is waited for, for people.
        """
        started, pause, told = time.monotonic(), 0.05, False
        end = started + self.patience
        while True:
            failure: NodeError | None = None
            try:
                answer = ask()
                if answer is not None:
                    return answer
            except NoAnswerError as error:
                failure = error
            if self.late is not None and not told and time.monotonic() - started > LATE:
                told = True
                self.late(f"waiting for {what}")
            if time.monotonic() + pause > end:
                if failure is not None:
                    raise failure
                return None
            time.sleep(pause)
            pause = min(2.0, pause * 1.5)

    def _rejected(self, error: NodeError, cost: int) -> ChainError:
        """Return what a node says against a transaction, with what to do."""
        said = str(error).lower()
        if "insufficient funds" in said or "not enough funds" in said or "insufficient balance" in said:
            return TransactionError(
                f"{self.name} has {rounded(self.balance())} ether, a transaction may cost {rounded(cost)}: send it some"
            )
        if "nonce" in said:
            return TransactionError(f"{self.name} was used by another program meanwhile ({error}): run the same again")
        if "underpriced" in said or "less than block base fee" in said or "fee cap" in said or "gas price" in said:
            return TransactionError(f"gas has become more expensive meanwhile ({error}): run the same again")
        if _unbound(error):
            return TransactionError(
                f"the {self.connection.name} refuses transactions that are not bound to a chain, as the one that "
                "deploys the proxy: take another node of the same chain for that"
            )
        if type(error) is NodeError:
            return TransactionError(f"the transaction was refused: {error}")
        return error


def _unbound(error: NodeError) -> bool:
    """Return whether a node takes only transactions that are bound to a chain (EIP-155)."""
    said = str(error).lower()
    return any(words in said for words in ("replay-protected", "replay protected", "eip-155", "eip155"))


def _are_logs(logs: Any) -> bool:
    """Return whether these are events as a receipt has them."""
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
    """Return what a contract that reverted a transaction said."""
    return str(refusal(data, gas)) if data else "the contract refused, and gave no reason"
