"""Quotes: transactions with the most that each may cost. They are told first, and nothing above them is ever signed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from ..chain import Connection, quantity
from ..errors import ChainError, NoAnswerError, NodeError, TransactionError
from ..ethereum import GWEI, to_hex

#: What the gas of a transaction is multiplied by for its limit, since the chain moves on: 21 / 20.
MARGIN = (21, 20)
#: A tip for those who make blocks, where a node suggests none, in wei.
TIP = GWEI
#: The highest tip that is paid unless `max_fee` is given, in wei.
MOST_TIP = 3 * GWEI
#: How many times the gas that is counted here a node may estimate unless `max_fee` is given.
MOST_TIMES = 10


@dataclass(frozen=True)
class Fees:
    """Prices of gas in wei. likely: what is probably paid. most: what is paid at most. tip: None on a chain without the
    fees of EIP-1559, where `most` is the price. named: whether `most` is what somebody named (`max_fee`).
    """

    likely: int
    most: int
    tip: int | None
    named: bool = False

    @property
    def fields(self) -> dict[str, int]:
        """Of a transaction."""
        if self.tip is None:
            return {"gasPrice": self.most}
        return {"maxFeePerGas": self.most, "maxPriorityFeePerGas": self.tip, "type": 2}


@dataclass(frozen=True)
class Call:
    """A transaction that is wanted. to: None creates a contract. ours: its gas as it is counted here. value: in wei.
    needs: the code, by address, of contracts that are not on the chain yet and will be by then.
    """

    to: bytes | None
    data: bytes
    ours: int
    value: int = 0
    needs: Mapping[bytes, bytes] = field(default_factory=dict)

    def request(self, sender: bytes | None = None) -> dict[str, str]:
        """Return the fields of the transaction as JSON-RPC has them."""
        parts = {"from": sender, "to": self.to, "data": self.data}
        return {key: to_hex(part) for key, part in parts.items() if part is not None} | {"value": hex(self.value)}


@dataclass(frozen=True)
class Quote:
    """A transaction and its price. Gas, fees, value and type are those that are signed, whatever a node says later.

    gas: the limit. expected: the gas that it probably uses. estimate: the node's; None if it could not tell yet.
    """

    call: Call
    fees: Fees
    gas: int
    expected: int
    estimate: int | None

    @property
    def likely(self) -> int:
        """What is probably paid, in wei, value included."""
        return self.expected * self.fees.likely + self.call.value

    @property
    def ceiling(self) -> int:
        """What is paid at most, in wei, value included."""
        return self.gas * self.fees.most + self.call.value


def current_fees(connection: Connection, max_fee: int | None = None) -> Fees:
    """Return what gas costs on a chain now, with headroom for a base fee that doubles.

    max_fee: the highest price of a gas that may be paid, in wei.

    Raises TransactionError if it costs more than that; without a `max_fee`, if the node suggests a tip above 3 gwei, or
    tells no base fee, so that nothing would bound the price.
    """
    base = base_fee(connection)
    if base is None:
        price = connection.number("eth_gasPrice")
        if max_fee is None:
            raise TransactionError(
                f"the {connection.name} tells no base fee, and asks {price / GWEI:,.12g} gwei for a gas, which nothing "
                "bounds: if its chain is one without EIP-1559, say how much a gas may cost, `max_fee`"
            )
        _require(price, max_fee)
        return Fees(price, price, None, True)
    try:
        tip = connection.number("eth_maxPriorityFeePerGas")
    except NoAnswerError:
        raise
    except ChainError:
        tip = TIP
    if max_fee is None:
        if tip > MOST_TIP:
            raise TransactionError(
                f"the {connection.name} suggests a tip of {tip / GWEI:,.12g} gwei for a gas, and "
                f"{MOST_TIP // GWEI} at most are paid unasked: if so much is right, say how much a gas may cost, "
                "`max_fee`"
            )
        # the base may rise by an eighth each block
        return Fees(base + tip, 2 * base + tip, tip)
    _require(base, max_fee)
    return Fees(min(base + tip, max_fee), max_fee, min(tip, max_fee), True)


def base_fee(connection: Connection) -> int | None:
    """Return the base fee of the last block, in wei; None on a chain without EIP-1559."""
    block = connection.block()
    try:
        return None if block.get("baseFeePerGas") is None else quantity(block["baseFeePerGas"])
    except ValueError:
        raise NodeError(f"the {connection.name} answered with what is no block: {block!r:.60}") from None


def make_quote(name: str, call: Call, fees: Fees, estimate: int | None, rate: float = 1.0) -> Quote:
    """Return a quote. name: of the node. rate: what to multiply our count by where the node gives no estimate.

    TransactionError if the estimate is more than 10 times our count, and nobody named a price.
    """
    if estimate is not None and estimate > MOST_TIMES * call.ours and not fees.named:
        raise TransactionError(
            f"the {name} estimates {estimate:,} gas for a transaction that takes about {call.ours:,} as counted here, "
            f"more than {MOST_TIMES} times as much: if its chain counts like that, say how much a gas may cost, "
            "`max_fee`"
        )
    expected = int(call.ours * rate) if estimate is None else estimate
    limit = max(call.ours, expected) * MARGIN[0] // MARGIN[1]
    return Quote(call, fees, limit, expected, estimate)


def make_quotes(
    connection: Connection,
    calls: Sequence[Call],
    fees: Fees,
    known: Iterable[Quote] = (),
    sender: bytes | None = None,
) -> list[Quote]:
    """Quotes of transactions that follow each other, with the node's estimates of those that it can tell now.

    The others are as dear, against our count, as the dearest of those and of the quotes in `known`.
    TransactionError as `make_quote` has it.
    """
    estimates = [_estimate(connection, call, sender) for call in calls]
    pairs = [(each.estimate, each.call.ours) for each in known]
    pairs += [(estimate, call.ours) for estimate, call in zip(estimates, calls, strict=True)]
    rate = max([1.0, *(estimate / ours for estimate, ours in pairs if estimate is not None)])
    return [
        make_quote(connection.name, call, fees, estimate, rate) for call, estimate in zip(calls, estimates, strict=True)
    ]


def _estimate(connection: Connection, call: Call, sender: bytes | None) -> int | None:
    """Return the gas that a node estimates; None if it cannot tell, since what is called is not there yet."""
    plain: list[Any] = [call.request(sender)]
    overrides = {to_hex(place): {"code": to_hex(code)} for place, code in call.needs.items()}
    # nodes that know no overrides refuse them
    for parameters in [[*plain, "latest", overrides], plain] if overrides else [plain]:
        try:
            estimate = connection.number("eth_estimateGas", *parameters)
        except NoAnswerError:
            raise
        except ChainError:
            continue
        # a call of what is not there does nothing, for almost nothing
        return estimate if 2 * estimate >= call.ours else None
    return None


def _require(price: int, max_fee: int) -> None:
    if price > max_fee:
        raise TransactionError(
            f"a gas costs {price / GWEI:,.12g} gwei now, above the {max_fee / GWEI:,.12g} of `max_fee`: wait until "
            "it is cheaper, or raise it"
        )
