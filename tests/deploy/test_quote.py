"""Quotes: what a transaction may cost at most is bounded by what is known here, whatever a node says."""

from __future__ import annotations

from contextlib import AbstractContextManager
from typing import Any

import pytest

from nodes import Reply, failure, result, serving
from shackled.chain import Connection
from shackled.deploy._quote import Call, Fees, Quote, current_fees, make_quotes
from shackled.errors import NoAnswerError, NodeError, TransactionError
from shackled.ethereum._amounts import GWEI

SENDER, PLACE = b"\x11" * 20, b"\x22" * 20
FEES = Fees(likely=3, most=7, tip=1)
UNKNOWN = failure("the method does not exist", -32601)


def market(base: int | None, tip: Reply | int = 0, price: int = 0) -> AbstractContextManager[str]:
    """A node with these prices, in wei; `base` is None on a chain without EIP-1559."""
    answers = {
        "eth_getBlockByNumber": result({} if base is None else {"baseFeePerGas": hex(base)}),
        "eth_maxPriorityFeePerGas": tip if isinstance(tip, Reply) else result(hex(tip)),
        "eth_gasPrice": result(hex(price)),
        "eth_getCode": result("0x"),
    }
    return serving(lambda request: answers[request["method"]])


def fees(base: int | None, tip: Reply | int = 0, price: int = 0, max_fee: int | None = None) -> Fees:
    with market(base, tip, price) as url:
        return current_fees(Connection(url), max_fee)


@pytest.mark.parametrize(
    ("base", "tip", "max_fee", "expected"),
    [
        (10 * GWEI, 2 * GWEI, None, Fees(12 * GWEI, 22 * GWEI, 2 * GWEI)),
        (GWEI, 3 * GWEI, None, Fees(4 * GWEI, 5 * GWEI, 3 * GWEI)),
        (5 * GWEI, UNKNOWN, None, Fees(6 * GWEI, 11 * GWEI, GWEI)),
        # a price that was named is the most
        (10, 2, 100, Fees(12, 100, 2, named=True)),
        (10, 2, 11, Fees(11, 11, 2, named=True)),
        (10, 2, 10, Fees(10, 10, 2, named=True)),
        (1, 9 * GWEI, 5 * GWEI, Fees(5 * GWEI, 5 * GWEI, 5 * GWEI, named=True)),
    ],
)
def test_prices(base: int, tip: Reply | int, max_fee: int | None, expected: Fees) -> None:
    """The base fee may double."""
    assert fees(base, tip, max_fee=max_fee) == expected


def test_prices_that_are_refused() -> None:
    words = r"suggests a tip of 3\.000000001 gwei per unit of gas, more than 3: .*`max_fee`"
    with pytest.raises(TransactionError, match=words):
        fees(GWEI, 3 * GWEI + 1)
    with pytest.raises(NoAnswerError):
        fees(5 * GWEI, Reply(status=500))
    # nothing bounds what a node without a base fee asks for, so somebody has to
    with pytest.raises(TransactionError, match=r"reports no base fee, and asks for 2\.5 gwei .*`max_fee`$"):
        fees(None, price=5 * GWEI // 2)
    assert fees(None, price=7, max_fee=7) == fees(None, price=7, max_fee=9) == Fees(7, 7, None, named=True)
    for base in (None, 3 * GWEI // 2 + 1):
        with pytest.raises(TransactionError, match=r"costs 1\.500000001 gwei now, more than the 1\.5 of `max_fee`: "):
            fees(base, 0, 3 * GWEI // 2 + 1, max_fee=3 * GWEI // 2)


def test_what_is_signed_and_its_price() -> None:
    assert FEES.fields == {"maxFeePerGas": 7, "maxPriorityFeePerGas": 1, "type": 2}
    assert Fees(3, 5, None).fields == {"gasPrice": 5}
    whole = {"from": "0x" + "11" * 20, "to": "0x" + "22" * 20, "data": "0xabcd", "value": "0x10"}
    assert Call(PLACE, b"\xab\xcd", 1, value=16).request(SENDER) == whole
    assert Call(None, b"\xab\xcd", 1).request() == {"data": "0xabcd", "value": "0x0"}
    quote = Quote(Call(PLACE, b"", 100, value=1000), FEES, gas=210, expected=200, estimate=None)
    assert (quote.likely, quote.ceiling) == (200 * 3 + 1000, 210 * 7 + 1000)


class Estimates:
    """A node that estimates, by the data of a call; None fails. It notes the parameters of each request."""

    def __init__(self, by_data: dict[str, int | None], knows_overrides: bool = True) -> None:
        self.by_data, self.knows_overrides = by_data, knows_overrides
        self.asked: list[list[Any]] = []

    def answer(self, request: dict[str, Any]) -> Reply:
        assert request["method"] == "eth_estimateGas"
        self.asked.append(request["params"])
        estimate = self.by_data[request["params"][0]["data"]]
        if estimate is None or (len(request["params"]) > 1 and not self.knows_overrides):
            return failure("too many arguments, want at most 2", -32602)
        return result(hex(estimate))

    def quotes(self, *calls: Call, fees: Fees = FEES, known: tuple[Quote, ...] = ()) -> list[Quote]:
        with serving(self.answer) as url:
            return make_quotes(Connection(url), calls, fees, known, SENDER)


def call(data: int, ours: int = 100_000, needs: bool = False) -> Call:
    return Call(PLACE, bytes([data]), ours, needs={b"\x33" * 20: b"\x60\x01"} if needs else {})


def limits(quotes: list[Quote]) -> list[tuple[int, int, int | None]]:
    return [(quote.gas, quote.expected, quote.estimate) for quote in quotes]


def test_the_limit_is_a_twentieth_above_the_larger_count() -> None:
    node = Estimates({"0x01": 200_000, "0x02": 100_000, "0x03": 80_000})
    assert limits(node.quotes(call(1))) == [(210_000, 200_000, 200_000)]
    assert limits(node.quotes(call(2))) == [(105_000, 100_000, 100_000)]
    assert limits(node.quotes(call(3))) == [(105_000, 80_000, 80_000)]


def test_an_estimate_of_ten_times_our_count_is_believed_and_no_more() -> None:
    assert limits(Estimates({"0x01": 1_000_000}).quotes(call(1))) == [(1_050_000, 1_000_000, 1_000_000)]
    above = Estimates({"0x01": 1_000_001})
    words = r"estimates 1,000,001 gas for .* about 100,000 as counted here, more than 10 times .*`max_fee`$"
    with pytest.raises(TransactionError, match=words):
        above.quotes(call(1))
    assert above.quotes(call(1), fees=Fees(3, 7, 1, named=True))[0].expected == 1_000_001


def test_what_cannot_be_estimated_is_as_dear_as_the_dearest() -> None:
    node = Estimates({"0x01": 150_000, "0x02": 300_000, "0x03": None})
    calls = [call(1), call(2, 120_000), call(3, 40_000)]
    assert limits(node.quotes(*calls))[2] == (105_000, 100_000, None)
    # also of those quoted before, but for those of which nobody knows
    before = Quote(call(9, 10_000), FEES, 0, 0, 40_000)
    unknown = Quote(call(9, 10_000), FEES, 0, 0, None)
    assert limits(node.quotes(*calls, known=(unknown, before)))[2] == (168_000, 160_000, None)
    # and never less than our count
    cheap = Estimates({"0x01": 90_000, "0x03": None})
    assert limits(cheap.quotes(call(1), call(3)))[1] == (105_000, 100_000, None)
    # an estimate of less than half is of a contract that is not there
    node = Estimates({"0x01": 50_000, "0x02": 49_999})
    assert [quote.estimate for quote in node.quotes(call(1), call(2))] == [50_000, None]


@pytest.mark.parametrize(("knows", "asked"), [(True, [3]), (False, [3, 1])])
def test_the_node_is_given_the_contracts_that_will_be_there(knows: bool, asked: list[int]) -> None:
    """Nodes that know no overrides are asked without, and about others once."""
    node = Estimates({"0x01": 150_000, "0x02": None}, knows)
    assert node.quotes(call(1, needs=True))[0].estimate == 150_000
    assert [len(parameters) for parameters in node.asked] == asked
    assert node.asked[0][1:] == ["latest", {"0x" + "33" * 20: {"code": "0x6001"}}]
    assert node.asked[0][0]["from"] == "0x" + "11" * 20
    node.asked.clear()
    assert node.quotes(call(2))[0].estimate is None
    assert len(node.asked) == 1


def test_a_node_that_gives_no_answer_ends_the_quotes() -> None:
    with serving(lambda _: Reply(status=500)) as url, pytest.raises(NoAnswerError):
        make_quotes(Connection(url), [call(1)], FEES)


@pytest.mark.parametrize(
    "block", [None, [], ["no"], *({"baseFeePerGas": fee} for fee in ("5", "zz", 5, "0x" + 65 * "f"))]
)
def test_what_is_no_block(block: object) -> None:
    with serving(lambda _: result(block)) as url, pytest.raises(NodeError, match="an invalid block"):
        current_fees(Connection(url))
