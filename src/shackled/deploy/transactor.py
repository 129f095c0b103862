"""Transactions: signed here, sent to a node, followed until they are in a block."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..chain.addresses import show_address
from ..chain.connection import Connection
from ..chain.refusal import refusal
from ..errors import (
    NodeBusyError,
    NodeError,
    NodeTimeoutError,
    NodeUnreachableError,
    OutOfGasError,
    RenderError,
    RevertError,
    TransactionError,
)

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

ETHER = 10**18
GWEI = 10**9
#: Seconds that a transaction may take to come into a block.
PATIENCE = 180.0
#: Seconds after which it is told what is waited for.
LATE = 1.0
#: What an estimate of gas is multiplied by, since the chain moves on: 21 / 20.
MARGIN = (21, 20)
#: A tip for those who make blocks, where a node suggests none, in wei.
TIP = GWEI


@dataclass(frozen=True)
class Fees:
    """Prices of gas in wei. likely: what is probably paid. most: what is paid at most. tip: None on a chain without the
    fees of EIP-1559, where `most` is the price.
    """

    likely: int
    most: int
    tip: int | None

    @property
    def fields(self) -> dict[str, int]:
        """Of a transaction."""
        if self.tip is None:
            return {"gasPrice": self.most}
        return {"maxFeePerGas": self.most, "maxPriorityFeePerGas": self.tip, "type": 2}


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

    def __init__(self, connection: Connection, account: LocalAccount, patience: float = PATIENCE) -> None:
        """patience: seconds to wait for a receipt."""
        self.connection, self.patience = connection, patience
        self._account = account
        #: Told, if there is anyone, what is waited for, as soon as it takes more than a second.
        self.late: Callable[[str], None] | None = None
        #: Hosts have many nodes, and the next may not have heard of the last transaction yet.
        self._nonce = 0
        self.address = bytes.fromhex(str(account.address)[2:])

    @property
    def name(self) -> str:
        """The account, for people."""
        return f"the account {show_address(self.address)}"

    def balance(self) -> int:
        """In wei."""
        return self.connection.number("eth_getBalance", _hex(self.address), "latest")

    def fees(self) -> Fees:
        """What gas costs now."""
        return current_fees(self.connection)

    def estimate(self, to: bytes | None, data: bytes = b"", value: int = 0) -> int:
        """The gas that a transaction needs, as the node estimates it; TransactionError if it would fail."""
        try:
            return self.connection.number("eth_estimateGas", self._call(to, data, value))
        except RevertError as error:
            raise TransactionError(f"the transaction would fail: {_why(error.data)}") from None
        except OutOfGasError:
            raise TransactionError("the transaction would fail: it needs more gas than the chain allows one") from None
        except NodeError as error:
            raise self._rejected(error, value) from None

    def send(
        self, to: bytes | None, data: bytes = b"", value: int = 0, gas: int | None = None, agreed: Fees | None = None
    ) -> Receipt:
        """Sends a transaction and waits for its receipt.

        to: None creates a contract. value: in wei. gas: the limit; None takes the estimate and a little more. agreed:
        fees that were told before, whose tip is kept, whatever the node suggests now.
        """
        if gas is None:
            gas = self.estimate(to, data, value) * MARGIN[0] // MARGIN[1]
        fees = self.fees()
        if agreed is not None and agreed.tip is not None and fees.tip is not None and fees.tip > agreed.tip:
            fees = Fees(fees.likely - fees.tip + agreed.tip, fees.most - fees.tip + agreed.tip, agreed.tip)
        transaction: dict[str, Any] = {
            "chainId": self.connection.chain_id,
            "nonce": max(self._nonce, self.connection.number("eth_getTransactionCount", _hex(self.address), "pending")),
            "gas": gas,
            "value": value,
            "data": _hex(data),
            **fees.fields,
        }
        if to is not None:
            transaction["to"] = show_address(to)
        signed = self._account.sign_transaction(transaction)
        cost = gas * fees.most + value
        receipt = self.send_signed(bytes(signed.raw_transaction), "0x" + bytes(signed.hash).hex(), cost, transaction)
        self._nonce = transaction["nonce"] + 1
        return receipt

    def send_signed(self, raw: bytes, digest: str, cost: int = 0, transaction: dict[str, Any] | None = None) -> Receipt:
        """Sends what is signed, and waits for its receipt. cost: what the account must have, in wei, for messages."""
        try:
            self.connection.request("eth_sendRawTransaction", _hex(raw))
        except NodeError as error:
            said = str(error).lower()
            # it may have come through before; whether it did shows when it is asked for
            known = any(words in said for words in ("already known", "known transaction", "already imported"))
            if not known and not isinstance(error, NodeTimeoutError | NodeUnreachableError):
                raise self._rejected(error, cost) from None
        except OutOfGasError:
            raise TransactionError("the transaction was refused: its gas is not what the chain allows one") from None
        return self._follow(digest, transaction)

    def offer(self, raw: bytes) -> None:
        """Sends what somebody else signed and cannot pay yet. TransactionError if the node would not take it then."""
        try:
            self.connection.request("eth_sendRawTransaction", _hex(raw))
        except NodeError as error:
            if _unbound(error):
                raise self._rejected(error, 0) from None
        except RenderError:
            pass

    def settle(self) -> None:
        """Waits until all transactions of the account are in blocks."""

        def waiting() -> int:
            count = [
                self.connection.number("eth_getTransactionCount", _hex(self.address), block)
                for block in ("pending", "latest")
            ]
            return count[0] - count[1]

        if not self.wait(lambda: waiting() <= 0 or None, f"transactions of {self.name} that are in no block yet"):
            raise TransactionError(
                f"{self.name} has {waiting()} transactions that are in no block after {self.patience:g} s: "
                "wait for them, or replace them, then try again"
            )

    def _call(self, to: bytes | None, data: bytes, value: int) -> dict[str, str]:
        call = {"from": _hex(self.address), "data": _hex(data), "value": hex(value)}
        return call if to is None else call | {"to": _hex(to)}

    def _follow(self, digest: str, transaction: dict[str, Any] | None) -> Receipt:
        what = f"a block that takes the transaction {digest}"
        receipt = self.wait(lambda: self.connection.request("eth_getTransactionReceipt", digest), what)
        if receipt is None:
            raise TransactionError(
                f"the transaction {digest} is in no block after {self.patience:g} s: run the same again later, "
                "it takes up where it stopped"
            )
        try:
            status, gas, block = (int(receipt[key], 16) for key in ("status", "gasUsed", "blockNumber"))
            price = int(receipt.get("effectiveGasPrice") or "0x0", 16)
        except (TypeError, LookupError, ValueError):
            raise NodeError(f"the {self.connection.name} answered with what is no receipt: {receipt!r:.60}") from None
        if status != 1:
            raise TransactionError(f"the transaction {digest} failed{self._reason(transaction, block)}")
        return Receipt(digest, block, gas, gas * price, tuple(receipt.get("logs") or ()))

    def _reason(self, transaction: dict[str, Any] | None, block: int) -> str:
        """Why a transaction failed, by making it again as a call."""
        if transaction is None:
            return ""
        call = self._call(None, bytes.fromhex(transaction["data"][2:]), transaction["value"])
        call |= {"gas": hex(transaction["gas"])} | ({"to": transaction["to"]} if "to" in transaction else {})
        try:
            self.connection.request("eth_call", call, hex(block - 1))
        except RevertError as error:
            return f": {_why(error.data, transaction['gas'])}"
        except RenderError as error:
            return f": {error}"
        return ""

    def wait(self, ask: Callable[[], Any], what: str = "the node") -> Any:
        """What is answered as soon as it is not None; None if it takes too long. A node that fails is asked again.

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
            except (NodeBusyError, NodeTimeoutError, NodeUnreachableError) as error:
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

    def _rejected(self, error: NodeError, cost: int) -> RenderError:
        """What a node says against a transaction, with what to do."""
        said = str(error).lower()
        if "insufficient funds" in said or "not enough funds" in said or "insufficient balance" in said:
            return TransactionError(
                f"{self.name} has {ether(self.balance())} ether, a transaction may cost {ether(cost)}: send it some"
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
    """Whether a node takes only transactions that are bound to a chain (EIP-155)."""
    said = str(error).lower()
    return any(words in said for words in ("replay-protected", "replay protected", "eip-155", "eip155"))


def block_gas(connection: Connection) -> int:
    """The gas that all transactions of a block may use."""
    block = connection.request("eth_getBlockByNumber", "latest", False)
    try:
        return int(block["gasLimit"], 16)
    except (TypeError, LookupError, ValueError):
        raise NodeError(f"the {connection.name} answered with what is no block: {block!r:.60}") from None


def current_fees(connection: Connection) -> Fees:
    """What gas costs on a chain now."""
    block = connection.request("eth_getBlockByNumber", "latest", False)
    base = block.get("baseFeePerGas") if isinstance(block, dict) else None
    if base is None:
        price = connection.number("eth_gasPrice")
        return Fees(price, price, None)
    try:
        tip = connection.number("eth_maxPriorityFeePerGas")
    except (NodeBusyError, NodeTimeoutError, NodeUnreachableError):
        raise
    except RenderError:
        tip = TIP
    # the base may rise by an eighth each block
    return Fees(int(base, 16) + tip, 2 * int(base, 16) + tip, tip)


def _why(data: bytes, gas: int = 0) -> str:
    """What a contract that reverted a transaction said."""
    return str(refusal(data, gas)) if data else "the contract refused, and gave no reason"


def ether(wei: int) -> str:
    """As many ether, for people."""
    text = f"{wei / ETHER:.6f}".rstrip("0").rstrip(".")
    return text if wei == 0 or float(text) else f"{wei / ETHER:.2g}"


def _hex(data: bytes) -> str:
    return "0x" + data.hex()
