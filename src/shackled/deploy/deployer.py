"""Deploying: what is missing on a chain, what it costs, and doing it. What is there already is left alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..chain.address_book import AddressBook
from ..chain.addresses import PROXY, show_address
from ..chain.connection import Connection
from ..errors import (
    NodeBusyError,
    NodeTimeoutError,
    NodeUnreachableError,
    RenderError,
    TransactionError,
    WrongChainError,
)
from .contract import Deployment
from .proxy import GAS, TRANSFER_GAS, deploy_proxy, missing_funds, proxy_stands
from .transactor import Fees, Receipt, Transactor, block_gas, current_fees, ether

#: The newest instruction that the contracts use, in a program that does nothing: PUSH0 PUSH0 PUSH0 MCOPY STOP.
NEWEST = bytes.fromhex("5f5f5f5e00")


@dataclass(frozen=True)
class Step:
    """Something that is to stand on a chain. gas, cost: of the transactions, cost in wei; 0 if it is there already."""

    name: str
    address: bytes
    there: bool
    gas: int = 0
    cost: int = 0
    deployment: Deployment | None = None


@dataclass(frozen=True)
class Plan:
    """What is to be done on a chain, in this order."""

    steps: tuple[Step, ...]
    fees: Fees

    @property
    def missing(self) -> list[Step]:
        """What is not there yet."""
        return [step for step in self.steps if not step.there]

    @property
    def gas(self) -> int:
        """Of all transactions."""
        return sum(step.gas for step in self.steps)

    @property
    def cost(self) -> int:
        """What is probably paid, in wei."""
        return sum(step.cost for step in self.steps)


class Deployer:
    """Puts contracts on the chain of a node, by the deterministic-deployment proxy, and notes where they are."""

    def __init__(self, connection: Connection, book: AddressBook | None = None) -> None:
        """`book`: None takes the user's."""
        self.connection = connection
        self.book = AddressBook() if book is None else book

    def plan(self, wanted: Sequence[Deployment]) -> Plan:
        """What of the contracts is there, and what the rest costs now.

        TransactionError if there is anything else, or a block cannot hold a contract; WrongChainError if the chain has
        older rules than the contracts need.
        """
        fees = current_fees(self.connection)
        there = [self.stands(each) for each in wanted]
        steps = []
        if not all(there):
            self._check_chain([each for each, done in zip(wanted, there, strict=True) if not done])
            steps.append(self._proxy_step(fees))
        for each, done in zip(wanted, there, strict=True):
            gas = 0 if done else each.gas
            steps.append(Step(each.name, each.address, done, gas, gas * fees.likely, each))
        return Plan(tuple(steps), fees)

    def stands(self, wanted: Deployment) -> bool:
        """Whether a contract is where it belongs. TransactionError if anything else is there."""
        code = self.connection.data("eth_getCode", "0x" + wanted.address.hex(), "latest")
        if code and code != wanted.code:
            raise TransactionError(
                f"the code at {show_address(wanted.address)} on chain {self.connection.chain_id} is not that of "
                f"{wanted.name}: the chain or the node is not to be trusted"
            )
        return bool(code)

    def carry_out(
        self, plan: Plan, transactor: Transactor, report: Callable[[Step, Sequence[Receipt]], None] | None = None
    ) -> list[Receipt]:
        """Deploys what is missing and compares the code, one contract after the other.

        report: is told of each step that is done. TransactionError if one fails; what was done before stays, and the
        next plan goes on from there.
        """
        receipts: list[Receipt] = []
        if plan.missing and transactor.balance() < plan.cost:
            raise TransactionError(
                f"{transactor.name} has {ether(transactor.balance())} ether on chain {self.connection.chain_id}, and "
                f"{ether(plan.cost)} are needed: send it some"
            )
        for step in plan.missing:
            if step.deployment is None:
                done = deploy_proxy(transactor, plan.fees)
            else:
                done = [self.deploy(step.deployment, transactor, plan.fees)]
            receipts += done
            if report is not None:
                report(step, done)
        self.note([step.deployment for step in plan.steps if step.deployment is not None])
        return receipts

    def deploy(self, wanted: Deployment, transactor: Transactor, agreed: Fees | None = None) -> Receipt:
        """Deploys one contract, and compares its code. agreed: fees, as `Transactor.send` has them."""
        receipt = transactor.send(PROXY, wanted.data, agreed=agreed)
        if not transactor.wait(lambda: self.stands(wanted) or None):
            raise TransactionError(
                f"{wanted.name} is not at {show_address(wanted.address)}, though its transaction {receipt.hash} "
                "succeeded: is the node in step?"
            )
        return receipt

    def note(self, standing: Sequence[Deployment]) -> None:
        """Writes into the address book where contracts are."""
        if standing:
            self.book.write(self.connection.chain_id, {each.name: each.address for each in standing})

    def _check_chain(self, missing: Sequence[Deployment]) -> None:
        """Whether contracts can be deployed, and used; else it would be found out when something was paid."""
        try:
            self.connection.request("eth_call", {"data": "0x" + NEWEST.hex()}, "latest")
        except (NodeBusyError, NodeTimeoutError, NodeUnreachableError, WrongChainError):
            raise
        except RenderError:
            pass  # some nodes make no calls without a receiver
        limit = block_gas(self.connection)
        for each in missing:
            if each.gas > limit:
                raise TransactionError(
                    f"{each.name} needs {each.gas:,} gas, and a block of chain {self.connection.chain_id} has "
                    f"{limit:,}: it cannot be deployed there"
                )

    def _proxy_step(self, fees: Fees) -> Step:
        if proxy_stands(self.connection):
            return Step("deployment proxy", PROXY, True)
        missing = missing_funds(self.connection)
        gas = GAS + (TRANSFER_GAS if missing else 0)
        return Step("deployment proxy", PROXY, False, gas, missing + (TRANSFER_GAS * fees.likely if missing else 0))
