"""Quotes: transactions with their maximum cost. No transaction that could cost more is ever signed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from ..chain._connection import Connection, read_all
from ..errors import TransactionError
from ..ethereum._amounts import GWEI
from ..ethereum._encoding import to_hex, word

#: Numerator and denominator of the margin of gas limits, since the chain's state changes: 5 %.
MARGIN = (21, 20)
#: The tip for block producers if the node suggests none, in wei.
TIP = GWEI
#: The maximum tip unless `max_fee` is given, in wei.
MOST_TIP = 3 * GWEI
#: The maximum ratio of a node's estimate to the gas counted here, unless `max_fee` is given.
MOST_TIMES = 10

#: The contract of rollups of the OP stack that tells which fees they take besides gas (GasPriceOracle).
ORACLE = bytes.fromhex("420000000000000000000000000000000000000f")
#: Its functions: getL1FeeUpperBound, of the bytes of an unsigned transaction, and getOperatorFee, of its gas.
L1_FEE, OPERATOR_FEE = bytes.fromhex("f1c7a58b"), bytes.fromhex("275aedd2")
#: The most bytes of an unsigned transaction besides its data.
FIELDS = 128
#: How often as much as now these fees may be, at most, when the transaction is mined.
ROLLUP_TIMES = 2


@dataclass(frozen=True)
class Fees:
    """Prices of a unit of gas, in wei.

    likely: the expected price. most: the maximum. tip: None on a chain without EIP-1559, where `most` is the price.
    named: whether the user set the maximum (`max_fee`). is_rollup: whether the chain takes fees besides gas (`ORACLE`).
    """

    likely: int
    most: int
    tip: int | None
    named: bool = False
    is_rollup: bool = False

    @property
    def fields(self) -> dict[str, int]:
        """Fields of a transaction with these prices."""
        if self.tip is None:
            return {"gasPrice": self.most}
        return {"maxFeePerGas": self.most, "maxPriorityFeePerGas": self.tip, "type": 2}


@dataclass(frozen=True)
class Call:
    """A transaction before it is quoted.

    to: receiver; None creates a contract. gas: of the whole transaction, as counted here. value: in wei.
    needs: code, by address, of contracts that earlier transactions will have deployed.
    """

    to: bytes | None
    data: bytes
    gas: int
    value: int = 0
    needs: Mapping[bytes, bytes] = field(default_factory=dict)

    def request(self, sender: bytes | None = None) -> dict[str, str]:
        """Return the fields of the transaction as JSON-RPC has them."""
        parts = {"from": sender, "to": self.to, "data": self.data}
        return {key: to_hex(part) for key, part in parts.items() if part is not None} | {"value": hex(self.value)}


@dataclass(frozen=True)
class Quote:
    """A transaction and its price. It is signed with exactly this gas limit, these fees and this value.

    gas: the gas limit. expected: the gas that it probably uses. estimate: the node's; None if it gave none.
    rollup_fee: the most that the chain takes besides gas, in wei, twice what it takes now; None if it tells no bound.
    """

    call: Call
    fees: Fees
    gas: int
    expected: int
    estimate: int | None
    rollup_fee: int | None = 0

    @property
    def likely(self) -> int:
        """Likely cost, in wei, value included."""
        return self.expected * self.fees.likely + self.call.value + (self.rollup_fee or 0) // ROLLUP_TIMES

    @property
    def ceiling(self) -> int:
        """Maximum cost, in wei, value included; without the fees of a rollup that tells no bound of them."""
        return self.gas * self.fees.most + self.call.value + (self.rollup_fee or 0)


def current_fees(connection: Connection, max_fee: int | None = None) -> Fees:
    """Return the current prices of gas, with a maximum of twice the base fee plus the tip.

    max_fee: the maximum price of a unit of gas, in wei. Raises TransactionError if gas costs more; without `max_fee`,
    if the node suggests a tip above 3 gwei, or reports no base fee, so that nothing would limit the price.
    """
    base, is_rollup = connection.block_field("baseFeePerGas"), bool(connection.code(ORACLE))
    if base is None:
        price = connection.number("eth_gasPrice")
        if max_fee is None:
            raise TransactionError(
                f"the {connection.name} reports no base fee, and asks for {price / GWEI:,.12g} gwei per unit of gas, "
                "which nothing limits: if its chain has no EIP-1559, set a maximum with `max_fee`"
            )
        _require(price, max_fee)
        return Fees(price, price, None, True, is_rollup)
    suggested = connection.number_if_known("eth_maxPriorityFeePerGas")
    tip = TIP if suggested is None else suggested
    if max_fee is None:
        if tip > MOST_TIP:
            raise TransactionError(
                f"the {connection.name} suggests a tip of {tip / GWEI:,.12g} gwei per unit of gas, more than "
                f"{MOST_TIP // GWEI}: if that is right, set a maximum price with `max_fee`"
            )
        # the base fee can rise by an eighth in each block
        return Fees(base + tip, 2 * base + tip, tip, False, is_rollup)
    _require(base, max_fee)
    return Fees(min(base + tip, max_fee), max_fee, min(tip, max_fee), True, is_rollup)


def make_quote(name: str, call: Call, fees: Fees, estimate: int | None, rate: float = 1.0) -> Quote:
    """Return the quote of a transaction.

    name: of the node. rate: factor for the gas counted here where there is no estimate. Raises TransactionError if the
    estimate is more than 10 times the gas counted here and the user set no maximum price.
    """
    if estimate is not None and estimate > MOST_TIMES * call.gas and not fees.named:
        raise TransactionError(
            f"the {name} estimates {estimate:,} gas for a transaction that takes about {call.gas:,} as counted here, "
            f"more than {MOST_TIMES} times as much: if that is right on its chain, set a maximum price with `max_fee`"
        )
    expected = int(call.gas * rate) if estimate is None else estimate
    limit = max(call.gas, expected) * MARGIN[0] // MARGIN[1]
    return Quote(call, fees, limit, expected, estimate)


def make_quotes(
    connection: Connection,
    calls: Sequence[Call],
    fees: Fees,
    known: Iterable[Quote] = (),
    sender: bytes | None = None,
) -> list[Quote]:
    """Return quotes of transactions that follow each other.

    Where the node cannot give an estimate yet, the gas counted here is multiplied by the highest ratio of estimate to
    count among the others and the quotes in `known`. Raises TransactionError as `make_quote`.
    """
    estimates = list(read_all(partial(_estimate, connection, sender), calls))
    pairs = [(each.estimate, each.call.gas) for each in known]
    pairs += [(estimate, call.gas) for estimate, call in zip(estimates, calls, strict=True)]
    rate = max([1.0, *(estimate / counted for estimate, counted in pairs if estimate is not None)])
    named = partial(make_quote, connection.name, fees=fees, rate=rate)
    quotes = [named(call, estimate=estimate) for call, estimate in zip(calls, estimates, strict=True)]
    return with_rollup_fees(connection, quotes)


def with_rollup_fees(connection: Connection, quotes: Sequence[Quote]) -> list[Quote]:
    """Return quotes with what the chain takes besides gas."""
    now = read_all(partial(rollup_fee, connection), quotes)
    return [
        replace(each, rollup_fee=None if fee is None else ROLLUP_TIMES * fee)
        for each, fee in zip(quotes, now, strict=True)
    ]


def rollup_fee(connection: Connection, quote: Quote) -> int | None:
    """Return the most that the chain would take besides gas now, in wei; None if it tells no bound."""
    if not quote.fees.is_rollup:
        return 0
    bound = _ask_oracle(connection, L1_FEE, len(quote.call.data) + FIELDS)
    # chains without that function take no such fee
    return None if bound is None else bound + (_ask_oracle(connection, OPERATOR_FEE, quote.gas) or 0)


def _ask_oracle(connection: Connection, function: bytes, number: int) -> int | None:
    call = {"to": to_hex(ORACLE), "data": to_hex(function + word(number))}
    return connection.number_if_known("eth_call", call, "latest")


def _estimate(connection: Connection, sender: bytes | None, call: Call) -> int | None:
    """Return the gas that a node estimates; None if it cannot, as for a contract that is not deployed yet."""
    plain: list[Any] = [call.request(sender)]
    overrides = {to_hex(place): {"code": to_hex(code)} for place, code in call.needs.items()}
    # nodes without state overrides refuse them
    for parameters in [[*plain, "latest", overrides], plain] if overrides else [plain]:
        estimate = connection.number_if_known("eth_estimateGas", *parameters)
        if estimate is not None:
            # a call of a missing contract succeeds and uses little gas
            return estimate if 2 * estimate >= call.gas else None
    return None


def _require(price: int, max_fee: int) -> None:
    if price > max_fee:
        raise TransactionError(
            f"a unit of gas costs {price / GWEI:,.12g} gwei now, more than the {max_fee / GWEI:,.12g} of `max_fee`: "
            "wait until it is cheaper, or raise it"
        )
