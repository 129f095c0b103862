"""Deploying on real nodes: at addresses that are known before, for the gas that was quoted, once."""

from __future__ import annotations

import json
from contextlib import AbstractContextManager
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from eth_account import Account

from nodes import KEY, Node, Reply, anvil, failure, forward, needs_anvil, replying, result
from proxies import Liar
from shackled.artifacts import RENDERER, artifact
from shackled.chain import AddressBook, Connection
from shackled.deploy import (
    CONTRACTS,
    STANDARD,
    Deployer,
    Deployment,
    Plan,
    Transactor,
    deployment,
    deployments,
    local_chain,
)
from shackled.deploy._contract import PROXY_CODE
from shackled.deploy._proxy import COST, SIGNED, SIGNER
from shackled.errors import ChainError, InputError, TransactionError, WrongChainError
from shackled.ethereum import PROXY, SALT, checksum_address, create2_address, keccak256, parse_address, to_hex

#: A chain without the proxy.
NO_PROXY = ("--disable-default-create2-deployer",)


@pytest.fixture
def book(tmp_path: Path) -> AddressBook:
    return AddressBook(tmp_path / "addresses.json")


@pytest.fixture(scope="module")
def wanted() -> list[Deployment]:
    return deployments()


def parts(node: Node, book: AddressBook) -> tuple[Deployer, Transactor]:
    return Deployer(node.connection, book), Transactor(node.connection, Account.from_key(KEY))


def code(node: Node, address: bytes) -> bytes:
    return node.connection.data("eth_getCode", "0x" + address.hex(), "latest")


def assert_deployed(node: Node, wanted: list[Deployment]) -> None:
    assert [code(node, each.address) for each in wanted] == [each.code for each in wanted]


def refusing_the_published(node: Node, words: str) -> AbstractContextManager[str]:
    """A node in front of another, that refuses the published transaction with these words."""
    signed = to_hex(SIGNED)
    return replying(
        node.url,
        eth_sendRawTransaction=lambda request: failure(words) if request["params"] == [signed] else None,
    )


def missing(plan: Plan) -> list[str]:
    return [step.name for step in plan.missing]


def test_addresses_come_from_the_code() -> None:
    # the first and the last example of EIP-1014 are of other deployers: the formula is checked with the proxy's
    hashed = keccak256(b"\xff" + PROXY + SALT + keccak256(b"\x00"))
    assert create2_address(b"\x00") == hashed[12:]
    assert checksum_address(PROXY) == "0x4e59b44847b379578588920cA78FbF26c0B4956C"
    assert parse_address(checksum_address(PROXY), "it") == PROXY


def test_the_contracts_that_are_deployed(wanted: list[Deployment]) -> None:
    assert [each.name for each in wanted] == list(STANDARD)
    assert {"Studio", "PngEncoder", "Library"} < set(STANDARD)
    local = local_chain()
    for each in wanted:
        assert each.address == local.address(each.name)
        assert each.creation.startswith(artifact(each.name).creation)
        assert len(each.code) == len(artifact(each.name).runtime)
    assert [each.name for each in deployments(["Renderer"])] == list(RENDERER)
    assert [each.name for each in deployments(["Genesis", "Renderer"])] == [*RENDERER, "Genesis"]
    assert [each.name for each in deployments(["Studio"])] == [
        *RENDERER,
        "PngEncoder",
        "Turntable",
        "GlbEncoder",
        "Studio",
    ]
    assert [each.name for each in deployments(["PngEncoder"])] == ["PngEncoder"]
    for name in CONTRACTS:
        assert deployments([name])[-1].name == name
    with pytest.raises(
        InputError, match=r"no contract 'Meter' to deploy; the contracts are Engine, .* GenesisMetadata$"
    ):
        deployments(["Meter"])


def test_a_constructor_that_refuses() -> None:
    engines = 4 * (bytes(31) + b"\x05")
    with pytest.raises(ChainError, match=r"Renderer could not be deployed|the contract refused"):
        deployment("Renderer", artifact("Renderer").creation + engines)


def test_the_transaction_that_deploys_the_proxy() -> None:
    """It is what was published: its signer is the one whose first contract has the address that everybody knows."""
    assert Account.recover_transaction(SIGNED) == checksum_address(SIGNER)
    # keccak256(rlp([signer, 0]))
    assert keccak256(b"\xd6\x94" + SIGNER + b"\x80")[12:] == PROXY
    assert SIGNED.count(PROXY_CODE) == 1
    assert COST == 10**16


def test_deploying(node: Node, book: AddressBook, wanted: list[Deployment]) -> None:
    deployer, transactor = parts(node, book)
    plan = deployer.plan(wanted)
    assert missing(plan) == list(STANDARD)
    assert plan.steps[0].name == "deployment proxy"
    assert all(code(node, each.address) == b"" for each in wanted)
    reported: list[tuple[str, int]] = []
    receipts = deployer.execute(
        plan, transactor, lambda step, done: reported.append((step.name, sum(each.gas for each in done)))
    )
    assert_deployed(node, wanted)
    # gas is known before, exactly
    assert reported == [(each.name, each.gas) for each in wanted]
    assert plan.gas == sum(receipt.gas for receipt in receipts)
    assert book.entries(31337) == {each.name: each.address for each in wanted}
    # the second time there is nothing to do
    nonce = node.rpc("eth_getTransactionCount", "0x" + transactor.address.hex(), "latest")
    again = deployer.plan(wanted)
    assert (again.missing, again.gas, again.cost) == ([], 0, 0)
    assert deployer.execute(again, transactor) == []
    assert node.rpc("eth_getTransactionCount", "0x" + transactor.address.hex(), "latest") == nonce


def test_the_price_that_was_quoted_is_kept(node: Node, book: AddressBook, wanted: list[Deployment]) -> None:
    deployer, transactor = parts(node, book)
    plan = deployer.plan(wanted)
    receipts = deployer.execute(plan, transactor)
    # the base fee of an empty chain falls meanwhile
    assert 0 < sum(receipt.fee for receipt in receipts) <= plan.cost


@needs_anvil
def test_a_chain_without_the_proxy(book: AddressBook, wanted: list[Deployment]) -> None:
    with anvil(*NO_PROXY, "--chain-id", "4321") as node:
        deployer, transactor = parts(node, book)
        assert code(node, PROXY) == b""
        plan = deployer.plan(wanted[: len(RENDERER)])
        assert missing(plan) == ["deployment proxy", *RENDERER]
        before = transactor.balance()
        deployer.execute(plan, transactor)
        assert before - transactor.balance() <= plan.cost
        assert code(node, PROXY) == PROXY_CODE
        assert_deployed(node, wanted[: len(RENDERER)])
        assert book.entries(4321).keys() == set(RENDERER)


@needs_anvil
def test_a_proxy_whose_signer_has_something_already(book: AddressBook, wanted: list[Deployment]) -> None:
    with anvil(*NO_PROXY) as node:
        node.rpc("anvil_setBalance", "0x" + SIGNER.hex(), hex(COST // 4))
        deployer, transactor = parts(node, book)
        plan = deployer.plan(wanted[:1])
        assert COST * 3 // 4 < plan.steps[0].cost < COST
        deployer.execute(plan, transactor)
        assert code(node, PROXY) == PROXY_CODE
        assert code(node, wanted[0].address) == wanted[0].code


@needs_anvil
def test_a_node_that_refuses_the_published_transaction(book: AddressBook, wanted: list[Deployment]) -> None:
    """Nothing is paid before it says so."""
    refusal = "only replay-protected (EIP-155) transactions allowed over RPC"
    with anvil(*NO_PROXY) as bare, refusing_the_published(bare, refusal) as url:
        transactor = Transactor(Connection(url), Account.from_key(KEY))
        deployer, before = Deployer(transactor.connection, book), transactor.balance()
        with pytest.raises(TransactionError, match=r"refuses transactions without a chain id.*another node"):
            deployer.execute(deployer.plan(wanted[:1]), transactor)
        assert transactor.balance() == before
        # another node of the same chain does it
        parts(bare, book)[0].execute(deployer.plan(wanted[:1]), parts(bare, book)[1])
        assert code(bare, PROXY) == PROXY_CODE


@needs_anvil
def test_chains_that_cannot_have_the_contracts(book: AddressBook, wanted: list[Deployment]) -> None:
    with anvil("--hardfork", "shanghai") as old, pytest.raises(WrongChainError, match="they need the rules of Cancun"):
        Deployer(old.connection, book).plan(wanted)
    with anvil("--gas-limit", "3000000") as small:
        message = (
            r"^Engine needs [45],\d+,\d+ gas, and a block of chain 31337 has 3,000,000: it cannot be deployed there$"
        )
        with pytest.raises(TransactionError, match=message):
            Deployer(small.connection, book).plan(wanted)


def test_going_on_where_it_stopped(node: Node, book: AddressBook, wanted: list[Deployment]) -> None:
    deployer, transactor = parts(node, book)
    plan = deployer.plan(wanted)

    class StopError(Exception):
        pass

    def stop(step: object, done: object) -> None:
        raise StopError

    with pytest.raises(StopError):
        deployer.execute(plan, transactor, stop)
    rest = deployer.plan(wanted)
    assert missing(rest) == list(STANDARD[1:])
    deployer.execute(rest, transactor)
    assert deployer.plan(wanted).missing == []


def test_anything_else_in_the_place(node: Node, book: AddressBook, wanted: list[Deployment]) -> None:
    deployer, _ = parts(node, book)
    node.rpc("anvil_setCode", "0x" + wanted[len(RENDERER) - 1].address.hex(), "0x00")
    with pytest.raises(TransactionError, match="is not that of Renderer"):
        deployer.plan(wanted)
    node.rpc("anvil_setCode", "0x" + wanted[len(RENDERER) - 1].address.hex(), "0x")
    node.rpc("anvil_setCode", "0x" + PROXY.hex(), "0x00")
    with pytest.raises(TransactionError, match="other code at the address of the deployment proxy"):
        deployer.plan(wanted)


def test_an_account_with_too_little(node: Node, book: AddressBook, wanted: list[Deployment]) -> None:
    deployer = Deployer(node.connection, book)
    poor = Transactor(node.connection, Account.create())
    with pytest.raises(TransactionError, match=r"^the account 0x\w+ has 0 ether on chain 31337, and .* are needed"):
        deployer.execute(deployer.plan(wanted), poor)
    assert not book.path.exists()


def test_any_creation_code(node: Node, book: AddressBook) -> None:
    """Such as that of a collection."""
    deployer, transactor = parts(node, book)
    # leaves a contract of one byte: PUSH1 1 PUSH0 RETURN
    own = deployment("Stop", bytes.fromhex("60015ff3"))
    assert (own.code, own.address) == (b"\0", create2_address(own.creation))
    (quote,) = deployer.plan([own]).quotes
    receipt = deployer.deploy(own, quote, transactor)
    assert receipt is not None
    assert receipt.gas == own.gas
    assert deployer.is_deployed(own)


def test_hosts_whose_nodes_are_not_in_step(node: Node, book: AddressBook, wanted: list[Deployment]) -> None:
    """Each answer but every third comes from a node that has not heard of the last block."""
    numbers = count()

    def late(request: dict[str, Any]) -> Reply | None:
        if next(numbers) % 3 == 2:
            return None
        latest = int(node.rpc("eth_blockNumber"), 16)
        return forward(node.url, request | {"params": [request["params"][0], hex(max(0, latest - 1))]})

    with replying(node.url, eth_getCode=late, eth_getTransactionCount=late) as url:
        connection = Connection(url)
        deployer, transactor = Deployer(connection, book), Transactor(connection, Account.from_key(KEY))
        deployer.execute(deployer.plan(wanted[: len(RENDERER)]), transactor)
    assert_deployed(node, wanted[: len(RENDERER)])


@needs_anvil
def test_limits_follow_the_estimates_of_the_node(book: AddressBook, wanted: list[Deployment]) -> None:
    """A fork may count gas otherwise: seven times as much for code, say."""
    lies = {"eth_estimateGas": lambda gas, _: hex(7 * int(gas, 16))}
    with anvil("--gas-limit", "60000000") as node, Liar(lies).before(node.url) as url:
        deployer = Deployer(Connection(url), book)
        plan = deployer.plan(wanted)
        assert all(each.estimate is not None and each.gas >= each.estimate >= 7 * each.call.gas for each in plan.quotes)
        before = Transactor(node.connection, Account.from_key(KEY)).balance()
        receipts = deployer.execute(plan, Transactor(Connection(url), Account.from_key(KEY)))
        sent = [int(node.rpc("eth_getTransactionByHash", each.hash)["gas"], 16) for each in receipts]
        assert sent == [each.gas for each in plan.quotes]
        assert before - Transactor(node.connection, Account.from_key(KEY)).balance() <= plan.ceiling


def test_a_node_that_estimates_only_what_can_be_done_now(
    node: Node, book: AddressBook, wanted: list[Deployment]
) -> None:
    """The renderer needs the engine, which is not there yet: its gas is taken to be as dear as that of the others."""

    def estimate(request: dict[str, Any]) -> Reply | None:
        if len(request["params"]) > 2:
            return failure("too many arguments, want at most 2", -32602)
        reply = json.loads(forward(node.url, request).body)
        return result(hex(5 * int(reply["result"], 16))) if "result" in reply else None

    with replying(node.url, eth_estimateGas=estimate) as url:
        deployer = Deployer(Connection(url), book)
        engine, *_, renderer = deployer.plan(wanted[: len(RENDERER)]).quotes
        assert engine.estimate is not None
        assert renderer.estimate is None
        assert 5 * renderer.call.gas <= renderer.gas <= 6 * renderer.call.gas
        deployer.execute(deployer.plan(wanted[: len(RENDERER)]), Transactor(Connection(url), Account.from_key(KEY)))
    assert_deployed(node, wanted[: len(RENDERER)])


@needs_anvil
def test_a_chain_on_which_the_published_transaction_has_too_little_gas(
    book: AddressBook, wanted: list[Deployment]
) -> None:
    words = r"chain 31337 has no deployment proxy, and the published transaction that deploys it has 100,000 gas, and 2"
    lies = {"eth_estimateGas": lambda gas, _: hex(3 * int(gas, 16))}
    with anvil(*NO_PROXY) as bare, Liar(lies).before(bare.url) as url:
        with pytest.raises(TransactionError, match=words):
            Deployer(Connection(url), book).plan(wanted)
        # a node that says so only when the transaction is there
        with refusing_the_published(bare, "intrinsic gas too low: have 100000, want 214898") as other:
            transactor = Transactor(Connection(other), Account.from_key(KEY))
            deployer, before = Deployer(transactor.connection, book), transactor.balance()
            with pytest.raises(TransactionError, match="has 100,000 gas, which is too little for the node"):
                deployer.execute(deployer.plan(wanted[:1]), transactor)
            assert transactor.balance() == before


@needs_anvil
def test_a_proxy_that_is_too_dear_now(book: AddressBook, wanted: list[Deployment]) -> None:
    with anvil(*NO_PROXY, "--base-fee", str(300 * 10**9)) as node:
        deployer, transactor = parts(node, book)
        with pytest.raises(TransactionError, match=r"^gas costs \d+ gwei now, and the published .* offers 100: wait"):
            deployer.execute(deployer.plan(wanted[:1]), transactor)
        # the ether for it was not sent in vain
        assert node.connection.number("eth_getBalance", "0x" + SIGNER.hex(), "latest") == 0
