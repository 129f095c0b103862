"""Deploying: what is missing on a chain, what it costs, and doing it. What is there already is left alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from ..chain import AddressBook, Connection
from ..errors import ChainError, NoAnswerError, TransactionError, WrongChainError
from ..ethereum import PROXY, checksum_address, rounded, to_hex
from ._contract import PROXY_CODE, Deployment
from ._proxy import GAS, TRANSFER_GAS, check_gas, deploy_proxy, funding, missing_funds, proxy_stands
from ._quote import Call, Fees, Quote, current_fees, make_quotes
from ._transactor import Receipt, Transactor

#: The newest instruction that the contracts use, in a program that does nothing: PUSH0 PUSH0 PUSH0 MCOPY STOP.
NEWEST = bytes.fromhex("5f5f5f5e00")


@dataclass(frozen=True)
class Step:
    """Something that is to stand on a chain. gas: of the transactions, as counted here; 0 if it is there already.
    quote: of the transaction that the account pays; None if it pays none.
    """

    name: str
    address: bytes
    there: bool
    gas: int = 0
    quote: Quote | None = None
    deployment: Deployment | None = None

    @property
    def cost(self) -> int:
        """What is probably paid, in wei."""
        return 0 if self.quote is None else self.quote.likely

    @property
    def ceiling(self) -> int:
        """What is paid at most, in wei."""
        return 0 if self.quote is None else self.quote.ceiling


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
        """Of all transactions, as counted here."""
        return sum(step.gas for step in self.steps)

    @property
    def cost(self) -> int:
        """What is probably paid, in wei."""
        return sum(step.cost for step in self.steps)

    @property
    def ceiling(self) -> int:
        """What is paid at most, in wei."""
        return sum(step.ceiling for step in self.steps)

    @property
    def quotes(self) -> list[Quote]:
        """Of the transactions that the account pays."""
        return [step.quote for step in self.steps if step.quote is not None]

    @property
    def codes(self) -> dict[bytes, bytes]:
        """The code, by address, of what is missing."""
        known = {step.address: step.deployment.code for step in self.missing if step.deployment is not None}
        return known | {step.address: PROXY_CODE for step in self.missing if step.deployment is None}


class Deployer:
    """Puts contracts on the chain of a node, by the deterministic-deployment proxy, and notes where they are."""

    def __init__(self, connection: Connection, book: AddressBook | None = None) -> None:
        """`book`: None takes the user's."""
        self.connection = connection
        self.book = AddressBook() if book is None else book

    def plan(self, wanted: Sequence[Deployment], fees: Fees | None = None) -> Plan:
        """Return what of the contracts is there, and what the rest costs. fees: None asks for those of now.

        TransactionError if there is anything else, a block cannot hold a contract, or the node's prices are not to be
        believed (`current_fees`, `make_quote`); WrongChainError if the chain has older rules than the contracts need.
        """
        fees = current_fees(self.connection) if fees is None else fees
        there = [self.stands(each) for each in wanted]
        missing = [each for each, done in zip(wanted, there, strict=True) if not done]
        steps, codes = [], {}
        if missing:
            self._check_chain(missing)
            steps.append(self._proxy_step(fees))
            if not steps[0].there:
                codes[PROXY] = PROXY_CODE
        calls = []
        for each in missing:
            calls.append(Call(PROXY, each.data, each.gas, needs=dict(codes)))
            codes[each.address] = each.code
        quotes = iter(make_quotes(self.connection, calls, fees))
        for each, done in zip(wanted, there, strict=True):
            gas, quote = (0, None) if done else (each.gas, next(quotes))
            steps.append(Step(each.name, each.address, done, gas, quote, each))
        return Plan(tuple(steps), fees)

    def look_again(self, plan: Plan) -> Plan:
        """Return the plan without what has come there meanwhile; its quotes stay what they were."""
        return replace(plan, steps=tuple(self._look_again(step) for step in plan.steps))

    def _look_again(self, step: Step) -> Step:
        if step.there:
            return step
        stands = proxy_stands(self.connection) if step.deployment is None else self.stands(step.deployment)
        return replace(step, there=True, gas=0, quote=None) if stands else step

    def stands(self, wanted: Deployment) -> bool:
        """Return whether a contract is where it belongs. TransactionError if anything else is there."""
        code = self.connection.code(wanted.address)
        if code and code != wanted.code:
            raise TransactionError(
                f"the code at {checksum_address(wanted.address)} on chain {self.connection.chain_id} is not that of "
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
        plan = self.look_again(plan)
        if plan.missing and transactor.balance() < plan.cost:
            raise TransactionError(
                f"{transactor.name} has {rounded(transactor.balance())} ether on chain {self.connection.chain_id}, and "
                f"{rounded(plan.cost)} are needed: send it some"
            )
        for step in plan.missing:
            if step.deployment is None:
                done = deploy_proxy(transactor, step.quote)
            else:
                assert step.quote is not None
                receipt = self.deploy(step.deployment, step.quote, transactor)
                done = [] if receipt is None else [receipt]
            receipts += done
            if report is not None and done:
                report(step, done)
        self.note([step.deployment for step in plan.steps if step.deployment is not None])
        return receipts

    def deploy(self, wanted: Deployment, quote: Quote, transactor: Transactor) -> Receipt | None:
        """Deploys one contract as it was quoted, and compares its code; None if somebody else was quicker."""
        return create(transactor, quote, lambda: self.stands(wanted), wanted.name, wanted.address)

    def note(self, standing: Sequence[Deployment]) -> None:
        """Writes into the address book where contracts are."""
        if standing:
            self.book.write(self.connection.chain_id, {each.name: each.address for each in standing})

    def _check_chain(self, missing: Sequence[Deployment]) -> None:
        """Check that contracts can be deployed and used, before anything is paid."""
        try:
            self.connection.request("eth_call", {"data": to_hex(NEWEST)}, "latest")
        except (NoAnswerError, WrongChainError):
            raise
        except ChainError:
            pass  # some nodes make no calls without a receiver
        limit = self.connection.block_gas_limit()
        for each in missing:
            if each.gas > limit:
                raise TransactionError(
                    f"{each.name} needs {each.gas:,} gas, and a block of chain {self.connection.chain_id} has "
                    f"{limit:,}: it cannot be deployed there"
                )

    def _proxy_step(self, fees: Fees) -> Step:
        if proxy_stands(self.connection):
            return Step("deployment proxy", PROXY, True)
        check_gas(self.connection)
        missing = missing_funds(self.connection)
        if not missing:
            return Step("deployment proxy", PROXY, False, GAS)
        (quote,) = make_quotes(self.connection, [funding(missing)], fees)
        return Step("deployment proxy", PROXY, False, GAS + TRANSFER_GAS, quote)


def create(
    transactor: Transactor, quote: Quote, stands: Callable[[], bool], name: str, address: bytes
) -> Receipt | None:
    """Has a contract created at an address that is made of its code. None if it stands there by then: whoever created
    it, it is the same.

    stands: whether it does. TransactionError if it does not in the end.
    """
    try:
        receipt = transactor.send(quote)
    except TransactionError as error:
        try:
            there = stands()
        except ChainError:
            raise error from None
        if there:
            return None
        raise
    if not transactor.wait(lambda: stands() or None):
        raise TransactionError(
            f"{name} is not at {checksum_address(address)}, though its transaction {receipt.hash} succeeded: is "
            "the node in step?"
        )
    return receipt
