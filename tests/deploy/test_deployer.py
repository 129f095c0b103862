"""Deploying on real nodes: at addresses that are known before, for the gas that was quoted, once."""

from __future__ import annotations

import json
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from eth_account import Account

from nodes import KEY, Node, Reply, anvil, failure, forward, needs_anvil, replying, result
from proxies import Liar
from shackled.artifacts import RENDERER, artifact
from shackled.chain import Connection
from shackled.chain._address_book import AddressBook
from shackled.deploy import Deployer, Transactor, deployment, deployments
from shackled.deploy._contract import CONTRACTS, PROXY_CODE, STANDARD, Deployment, local_chain
from shackled.deploy._deployer import Plan
from shackled.errors import ChainError, InputError, TransactionError, WrongChainError
from shackled.ethereum._encoding import PROXY, create2_address, to_hex


@pytest.fixture
def book(tmp_path: Path) -> AddressBook:
    return AddressBook(tmp_path / "addresses.json")


@pytest.fixture(scope="module")
def wanted() -> list[Deployment]:
    return deployments()


def parts(node: Node, book: AddressBook) -> tuple[Deployer, Transactor]:
    return Deployer(node.connection, book), Transactor(node.connection, Account.from_key(KEY))


def assert_deployed(node: Node, wanted: list[Deployment]) -> None:
    assert [node.connection.code(each.address) for each in wanted] == [each.code for each in wanted]


def missing(plan: Plan) -> list[str]:
    return [step.name for step in plan.missing]


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
    parts = ["PngEncoder", "Turntable", "GlbEncoder"]
    assert [each.name for each in deployments(["Studio"])] == [*RENDERER, *parts, "Studio"]
    assert [each.name for each in deployments(["PngEncoder"])] == ["PngEncoder"]
    for name in CONTRACTS:
        assert deployments([name])[-1].name == name
    with pytest.raises(InputError, match=r"no contract 'Meter' to deploy; the contracts are Engine, .* GenesisM"):
        deployments(["Meter"])


def test_a_constructor_that_refuses() -> None:
    engines = 4 * (bytes(31) + b"\x05")
    with pytest.raises(ChainError, match=r"Renderer could not be deployed|the contract refused"):
        deployment("Renderer", artifact("Renderer").creation + engines)


def test_deploying(node: Node, book: AddressBook, wanted: list[Deployment]) -> None:
    deployer, transactor = parts(node, book)
    plan = deployer.plan(wanted)
    assert missing(plan) == list(STANDARD)
    before = transactor.balance()
    assert all(node.connection.code(each.address) == b"" for each in wanted)
    reported: list[tuple[str, int]] = []
    receipts = deployer.execute(plan, transactor, lambda name, _, receipt: reported.append((name, receipt.gas)))
    assert_deployed(node, wanted)
    # the base fee of an empty chain falls meanwhile
    assert before - transactor.balance() == sum(receipt.fee for receipt in receipts) <= plan.cost <= plan.ceiling
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


@needs_anvil
def test_chains_that_cannot_have_the_contracts(book: AddressBook, wanted: list[Deployment]) -> None:
    with anvil("--hardfork", "shanghai") as old, pytest.raises(WrongChainError, match="they need the rules of Cancun"):
        Deployer(old.connection, book).plan(wanted)
    with anvil("--gas-limit", "3000000") as small:
        message = r"^Engine needs [45],\d+,\d+ gas, and a block of chain 31337 has 3,000,000: it cannot be deployed"
        with pytest.raises(TransactionError, match=message):
            Deployer(small.connection, book).plan(wanted)
    with anvil("--disable-default-create2-deployer") as bare:
        for code, words in (("0x", "no code"), ("0x00", "other code")):
            bare.rpc("anvil_setCode", to_hex(PROXY), code)
            with pytest.raises(TransactionError, match=f"31337 has {words} at the address of the deployment proxy"):
                Deployer(bare.connection, book).plan(wanted)
        bare.rpc("anvil_setCode", to_hex(PROXY), to_hex(PROXY_CODE))
        deployer, transactor = parts(bare, book)
        deployer.execute(deployer.plan(wanted[:1]), transactor)
        assert_deployed(bare, wanted[:1])


def test_going_on_where_it_stopped(node: Node, book: AddressBook, wanted: list[Deployment]) -> None:
    deployer, transactor = parts(node, book)
    plan = deployer.plan(wanted)

    class StopError(Exception):
        pass

    def stop(*_: object) -> None:
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
    (receipt,) = deployer.execute(deployer.plan([own]), transactor)
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
