"""Transactions: what can go wrong with one is said in one line."""

from __future__ import annotations

import time
from contextlib import AbstractContextManager
from dataclasses import replace
from itertools import count
from typing import Any

import pytest
from eth_account import Account

from nodes import KEY, Node, Reply, anvil, failure, forward, needs_anvil, replying, result, serving
from proxies import Liar
from shackled.artifacts import artifact
from shackled.chain import Connection
from shackled.deploy import Transactor
from shackled.deploy._quote import FIELDS, ORACLE, Call, Quote, make_quotes
from shackled.errors import ChainError, NodeError, NodeUnreachableError, TransactionError
from shackled.ethereum._amounts import ETHER, GWEI
from shackled.ethereum._encoding import PROXY, to_hex, word

pytestmark = needs_anvil
SOMEONE = b"\x77" * 20


def transactor(url: str, patience: float = 20, max_fee: int | None = None) -> Transactor:
    return Transactor(Connection(url), Account.from_key(KEY), patience, max_fee)


def quoted(payer: Transactor, to: bytes | None = SOMEONE, data: bytes = b"", value: int = 0) -> Quote:
    return payer.quote(Call(to, data, 21_000 + 100 * len(data), value))


def blind(payer: Transactor, to: bytes | None, data: bytes, gas: int) -> Quote:
    """A quote for which nobody asked the node."""
    return Quote(Call(to, data, gas), payer.fees(), gas, gas, None)


def without_estimates(node: Node) -> AbstractContextManager[str]:
    """A node in front of another, that says of everything that it takes 21,000 gas."""
    return replying(node.url, eth_estimateGas=result("0x5208"))


def test_sending_ether(node: Node) -> None:
    payer, before = transactor(node.url), node.balance(SOMEONE)
    owned = payer.balance()
    quote = quoted(payer, value=ETHER)
    receipt = payer.send(quote)
    assert node.balance(SOMEONE) - before == ETHER
    assert receipt.gas == 21000
    assert owned - payer.balance() == ETHER + receipt.fee
    # what is signed is what was quoted
    sent = node.rpc("eth_getTransactionByHash", receipt.hash)
    fields = ("gas", "value", "maxFeePerGas", "maxPriorityFeePerGas", "type")
    assert [int(sent[each], 16) for each in fields] == [quote.gas, ETHER, quote.fees.most, quote.fees.tip, 2]
    assert quote.ceiling == quote.gas * quote.fees.most + ETHER
    # a fee for data is paid besides
    lies = {"eth_getTransactionReceipt": lambda receipt, _: receipt | {"l1Fee": hex(10**12)}}
    with Liar(lies).before(node.url) as url:
        receipt = transactor(url).send(quoted(transactor(url)))
    right = node.rpc("eth_getTransactionReceipt", receipt.hash)
    assert receipt.fee == receipt.gas * int(right["effectiveGasPrice"], 16) + 10**12


def test_fees_of_a_chain_without_eip_1559() -> None:
    with anvil("--hardfork", "berlin") as node:
        payer = transactor(node.url, max_fee=100 * GWEI)
        assert payer.fees().tip is None
        receipt = payer.send(quoted(payer, value=7))
        assert node.balance(SOMEONE) == 7
        assert receipt.gas == 21000
        assert int(node.rpc("eth_getTransactionByHash", receipt.hash)["type"], 16) == 0


def test_headroom_for_a_base_fee_that_rises() -> None:
    """It may double between the quote and the block; beyond that nothing is sent. Prices are not undone."""
    with anvil() as node:
        payer, base = transactor(node.url), 100 * GWEI
        node.rpc("anvil_setNextBlockBaseFeePerGas", hex(base))
        node.rpc("evm_mine")
        quote, owned = quoted(payer, value=1), payer.balance()
        node.rpc("anvil_setNextBlockBaseFeePerGas", hex(19 * base // 10))
        receipt = payer.send(quote)
        assert receipt.fee > quote.gas * base
        assert owned - payer.balance() <= quote.ceiling
        quote, owned = quoted(payer, value=1), payer.balance()
        node.rpc("anvil_setNextBlockBaseFeePerGas", hex(10 * base))
        node.rpc("evm_mine")
        with pytest.raises(TransactionError, match=r"^the price of gas has risen to 1,000 gwei, .* was not sent"):
            payer.send(quote)
        assert payer.balance() == owned


@pytest.mark.parametrize(
    ("lies", "words"),
    [
        ({"eth_getBlockByNumber": lambda block, _: block | {"baseFeePerGas": "zz"}}, "an invalid block"),
        ({"eth_getTransactionCount": lambda count, _: "0x" + 64 * "f"}, "an impossible nonce of .* 115,79"),
        ({"eth_estimateGas": lambda gas, _: "0x" + 20_000 * "9"}, "an invalid number"),
    ],
)
def test_odd_answers_are_reported_before_anything_is_sent(node: Node, lies: Any, words: str) -> None:
    before = node.rpc("eth_blockNumber")
    with Liar(lies).before(node.url) as url, pytest.raises(ChainError, match=words):
        transactor(url).send(quoted(transactor(url)))
    assert node.rpc("eth_blockNumber") == before


@pytest.mark.parametrize("logs", ["zz", ["zz"], [{"topics": []}], [{"address": "0x" + 40 * "0", "topics": ["0x"]}]])
def test_odd_events_of_a_transaction_that_succeeded(node: Node, logs: Any) -> None:
    lies = {"eth_getTransactionReceipt": lambda receipt, _: receipt | {"logs": logs}}
    before = node.balance(SOMEONE)
    words = r"^the transaction 0x\w{64} succeeded, so do not send it again; but the node .* invalid events"
    with Liar(lies).before(node.url) as url, pytest.raises(TransactionError, match=words):
        transactor(url).send(quoted(transactor(url), value=9))
    assert node.balance(SOMEONE) - before == 9


@pytest.mark.parametrize("receipt", ["zz", {}, {"status": "0x1"}, {"status": "0x" + 99 * "1"}])
def test_what_is_no_receipt(node: Node, receipt: Any) -> None:
    """The transaction was sent all the same, which is reported."""
    lies = {"eth_getTransactionReceipt": lambda right, _: receipt}
    words = r"^the transaction 0x\w{64} was sent, check what became of it before .*: .*an invalid receipt"
    with Liar(lies).before(node.url) as url, pytest.raises(NodeError, match=words):
        transactor(url).send(quoted(transactor(url)))


def test_a_refusal_without_a_reason(node: Node) -> None:
    with pytest.raises(TransactionError, match=r"^the transaction would fail: the contract gave no reason$"):
        quoted(transactor(node.url), PROXY, bytes(32) + bytes.fromhex("5f5ffd"))


def test_too_little_ether(node: Node) -> None:
    with pytest.raises(TransactionError, match=r"has 10000 ether, a transaction may cost 1000000.* send it some"):
        transactor(node.url).send(quoted(transactor(node.url), value=10**6 * ETHER))
    poor = Transactor(node.connection, Account.create())
    with pytest.raises(TransactionError, match=r"^the account 0x\w+ has 0 ether, a transaction may cost 0\.0\d+: send"):
        poor.send(blind(poor, SOMEONE, b"", 10**7))


def reverting(node: Node) -> bytes:
    """An account whose code says `CanvasSize(1, 2)`."""
    (selector,) = (key for key, (name, _) in artifact("Renderer").errors.items() if name == "CanvasSize")
    # PUSH4 selector, shifted up; 1; 2; then REVERT
    code = b"\x63" + selector + bytes.fromhex("60e01b5f52600160045260026024526044" + "5ffd")
    node.rpc("anvil_setCode", "0x" + "99" * 20, "0x" + code.hex())
    return b"\x99" * 20


def test_what_a_contract_refuses(node: Node) -> None:
    place = reverting(node)
    with pytest.raises(TransactionError, match=r"would fail: the contract refused: CanvasSize\(width=1, height=2\)"):
        quoted(transactor(node.url), place)
    # where the node does not find out before, it fails on the chain
    with (
        without_estimates(node) as url,
        pytest.raises(TransactionError, match=r"^the transaction 0x\w{64} failed.*CanvasSize\(width=1, height=2\)"),
    ):
        transactor(url).send(blind(transactor(url), place, b"", 100_000))


def test_a_contract_without_gas(node: Node) -> None:
    creation = artifact("Engine").creation
    with (
        without_estimates(node) as url,
        pytest.raises(TransactionError, match=r"^the transaction 0x\w{64} failed: .* too little gas"),
    ):
        transactor(url).send(blind(transactor(url), None, creation, 2_000_000))


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ("nonce too low: next nonce 5, tx nonce 4", "was used by another program meanwhile"),
        ("replacement transaction underpriced", "the price of gas has risen meanwhile"),
        ("max fee per gas less than block base fee: address 0x, maxFeePerGas: 1", "the price of gas has risen"),
        ("insufficient funds for gas * price + value", "ether, a transaction may cost"),
        ("the moon is full", "the transaction was refused: .*the moon is full"),
    ],
)
def test_what_nodes_say(node: Node, said: str, words: str) -> None:
    refusing = replying(node.url, eth_sendRawTransaction=failure(said))
    with refusing as url, pytest.raises(TransactionError, match=words) as error:
        transactor(url).send(quoted(transactor(url)))
    assert KEY[2:] not in str(error.value)
    assert "\n" not in str(error.value)


def test_an_answer_that_was_lost(node: Node) -> None:
    """The transaction came through all the same: it is followed, not sent twice."""
    sent = []

    def lose(request: dict[str, Any]) -> Reply:
        sent.append(request)
        return replace(forward(node.url, request), cut=5)

    before = node.balance(SOMEONE)
    with replying(node.url, eth_sendRawTransaction=lose) as url:
        payer = transactor(url)
        payer.send(quoted(payer, value=3))
    assert node.balance(SOMEONE) - before == 3
    # a broken connection is tried again at once, and the node knows the transaction then
    assert {each["params"][0] for each in sent} == {sent[0]["params"][0]}


def test_a_transaction_that_is_in_no_block() -> None:
    with anvil("--no-mining") as node:
        payer = transactor(node.url, patience=0.3)
        with pytest.raises(TransactionError, match=r"0x\w{64} was sent, and is not mined after 0.3 s.*check"):
            payer.send(quoted(payer))
        with pytest.raises(TransactionError, match="still has 1 pending transactions"):
            payer.wait_for_pending()
        node.rpc("evm_mine")
        payer.wait_for_pending()


def test_a_transaction_that_was_replaced() -> None:
    """It is reported long before the patience ends."""
    with anvil("--no-mining") as node:

        def replace_it(request: dict[str, Any]) -> Reply:
            reply = forward(node.url, request)
            other = {"chainId": 31337, "nonce": 0, "gas": 21_000, "to": "0x" + "66" * 20, "value": 1}
            other |= {"maxFeePerGas": 900 * GWEI, "maxPriorityFeePerGas": 90 * GWEI, "type": 2}
            signed = Account.from_key(KEY).sign_transaction(other)
            node.rpc("eth_sendRawTransaction", "0x" + bytes(signed.raw_transaction).hex())
            node.rpc("evm_mine")
            return reply

        started = time.monotonic()
        words = r"^the transaction 0x\w{64} was replaced: another one of .* the same nonce, 0, was mined, .* again$"
        proxy = replying(node.url, eth_sendRawTransaction=replace_it)
        with proxy as url, pytest.raises(TransactionError, match=words):
            transactor(url, patience=60).send(quoted(transactor(node.url)))
        assert time.monotonic() - started < 20


def test_a_receipt_that_comes_after_the_nonce(node: Node, monkeypatch: pytest.MonkeyPatch) -> None:
    """A host's nodes may know different blocks for a while: that is no replacement. A wait is reported once."""
    monkeypatch.setattr("shackled.deploy._transactor.DELAY", 0.0)
    asked, reported = count(), list[str]()
    with replying(node.url, eth_getTransactionReceipt=lambda _: result(None) if next(asked) < 6 else None) as url:
        payer = transactor(url)
        payer.on_delay = reported.append
        receipt = payer.send(quoted(payer, value=1))
    assert receipt.gas == 21_000
    assert reported == [f"waiting for the transaction {receipt.hash} to be mined"]


#: What a GasPriceOracle answers to its two functions: the size or the gas, times a number in its storage.
BOUND, OPERATOR = 1_000, 7
ORACLE_CODE = bytes.fromhex(
    "5f3560e01c 8063f1c7a58b14601d57 63275aedd214602357 5f5ffd 0000 5b5f54602756 5b600154 5b600435025f5260205ff3"
)


def oracle(node: Node, code: bytes) -> None:
    node.rpc("anvil_setCode", to_hex(ORACLE), to_hex(code))
    for slot, value in enumerate((BOUND, OPERATOR)):
        node.rpc("anvil_setStorageAt", to_hex(ORACLE), hex(slot), to_hex(word(value)))


def test_fees_of_a_rollup_are_quoted(node: Node) -> None:
    """Those which its oracle tells, twice; and nothing is sent when they have more than that."""
    plain = quoted(transactor(node.url), data=b"\1\2\3", value=5)
    assert (plain.rollup_fee, plain.fees.is_rollup) == (0, False)
    oracle(node, ORACLE_CODE)
    quote = quoted(transactor(node.url), data=b"\1\2\3", value=5)
    fee = 2 * ((3 + FIELDS) * BOUND + quote.gas * OPERATOR)
    assert quote.rollup_fee == fee
    assert quote.ceiling == quote.gas * quote.fees.most + 5 + fee
    assert quote.likely == quote.expected * quote.fees.likely + 5 + fee // 2
    assert make_quotes(node.connection, [quote.call], quote.fees)[0].rollup_fee == fee
    # it may rise by three quarters, so that an eighth more is left until it is mined
    for slot, value in enumerate((BOUND, OPERATOR)):
        node.rpc("anvil_setStorageAt", to_hex(ORACLE), hex(slot), to_hex(word(value * 7 // 4)))
    transactor(node.url).send(quote)
    node.rpc("anvil_setStorageAt", to_hex(ORACLE), "0x0", to_hex(word(BOUND * 20)))
    sent = node.rpc("eth_blockNumber")
    with pytest.raises(TransactionError, match=r"^the fee for data on L1 has risen: .* was not sent; run the command"):
        transactor(node.url).send(quote)
    assert node.rpc("eth_blockNumber") == sent


def test_a_rollup_that_tells_no_bound(node: Node) -> None:
    oracle(node, bytes.fromhex("5f5ffd"))
    quote = quoted(transactor(node.url), value=5)
    assert quote.rollup_fee is None
    assert quote.ceiling == quote.gas * quote.fees.most + 5
    transactor(node.url).send(quote)


def test_the_size_of_a_transaction_without_its_data() -> None:
    """Whatever its fields: as wide as the fees and values that chains have allow."""
    widest: dict[str, Any] = {"chainId": 2**64 - 1, "nonce": 2**64 - 2, "gas": 2**64 - 1, "to": "0x" + 40 * "6"}
    widest |= {"value": 2**96, "maxFeePerGas": 2**96, "maxPriorityFeePerGas": 2**96, "type": 2}
    for size in (0, 100, 49_152):
        signed = Account.from_key(KEY).sign_transaction(widest | {"data": to_hex(b"\1" * size)})
        # of a signature with 67 bytes
        assert len(signed.raw_transaction) - 67 - size <= FIELDS


def test_a_node_that_dies_meanwhile() -> None:
    with anvil("--no-mining") as node:

        def answer(request: dict[str, Any]) -> Reply:
            if node.process.poll() is not None:
                return Reply(b"", 502)
            reply = forward(node.url, request)
            if request["method"] == "eth_sendRawTransaction":
                node.stop()
            return reply

        words = r"^the transaction 0x\w{64} was sent, check what became of it before .*: .* temporarily unavailable"
        with serving(answer) as url, pytest.raises(NodeUnreachableError, match=words):
            transactor(url, patience=0.5).send(quoted(transactor(node.url)))
