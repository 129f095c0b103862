"""The deployer: plans, quotes and sends the transactions of contracts that a chain does not have yet."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from ..chain import AddressBook, Connection, read_all
from ..errors import ChainError, NoAnswerError, TransactionError, WrongChainError
from ..ethereum import PROXY, checksum_address, rounded, to_hex
from ._contract import PROXY_CODE, Deployment
from ._proxy import GAS, TRANSFER_GAS, check_gas, deploy_proxy, funding, is_proxy_deployed, missing_funds
from ._quote import Call, Fees, Quote, current_fees, make_quotes
from ._transactor import Receipt, Transactor

#: A program with the newest instruction that the contracts use: PUSH0 PUSH0 PUSH0 MCOPY STOP.
NEWEST = bytes.fromhex("5f5f5f5e00")


@dataclass(frozen=True)
class DeploymentStep:
    """One contract of a plan.

    gas: of its transactions, as counted here; 0 if it is deployed already. quote: of the transaction that the account
    pays for; None if there is none. deployment: None for the proxy.
    """

    name: str
    address: bytes
    is_deployed: bool
    gas: int = 0
    quote: Quote | None = None
    deployment: Deployment | None = None

    @property
    def cost(self) -> int:
        """Likely cost, in wei."""
        return 0 if self.quote is None else self.quote.likely

    @property
    def ceiling(self) -> int:
        """Maximum cost, in wei."""
        return 0 if self.quote is None else self.quote.ceiling


@dataclass(frozen=True)
class Plan:
    """Contracts in the order of their deployment, with prices."""

    steps: tuple[DeploymentStep, ...]
    fees: Fees

    @property
    def missing(self) -> list[DeploymentStep]:
        """Steps that are not deployed yet."""
        return [step for step in self.steps if not step.is_deployed]

    @property
    def gas(self) -> int:
        """Gas of all transactions, as counted here."""
        return sum(step.gas for step in self.steps)

    @property
    def cost(self) -> int:
        """Likely cost, in wei."""
        return sum(step.cost for step in self.steps)

    @property
    def ceiling(self) -> int:
        """Maximum cost, in wei."""
        return sum(step.ceiling for step in self.steps)

    @property
    def quotes(self) -> list[Quote]:
        """Quotes of the transactions that the account pays for."""
        return [step.quote for step in self.steps if step.quote is not None]

    @property
    def codes(self) -> dict[bytes, bytes]:
        """Runtime code, by address, of the missing contracts."""
        return {step.address: PROXY_CODE if step.deployment is None else step.deployment.code for step in self.missing}


class Deployer:
    """Deploys contracts through the deterministic-deployment proxy, and records their addresses."""

    def __init__(self, connection: Connection, book: AddressBook | None = None) -> None:
        """Take a connection and an address book; None uses the user's."""
        self.connection = connection
        self.book = AddressBook() if book is None else book

    def plan(self, wanted: Sequence[Deployment], fees: Fees | None = None) -> Plan:
        """Return which contracts are missing, and what they cost. fees: None uses the current ones.

        Raises TransactionError if other code is at an address, if a contract does not fit a block, or if the node's
        prices are implausible (`current_fees`, `make_quote`); WrongChainError if the chain's rules are too old.
        """
        fees = current_fees(self.connection) if fees is None else fees
        deployed = list(read_all(self.is_deployed, wanted))
        missing = [each for each, done in zip(wanted, deployed, strict=True) if not done]
        steps, codes = [], {}
        if missing:
            self._check_chain(missing)
            steps.append(self._proxy_step(fees))
            if not steps[0].is_deployed:
                codes[PROXY] = PROXY_CODE
        calls = []
        for each in missing:
            calls.append(Call(PROXY, each.data, each.gas, needs=dict(codes)))
            codes[each.address] = each.code
        quotes = iter(make_quotes(self.connection, calls, fees))
        for each, done in zip(wanted, deployed, strict=True):
            gas, quote = (0, None) if done else (each.gas, next(quotes))
            steps.append(DeploymentStep(each.name, each.address, done, gas, quote, each))
        return Plan(tuple(steps), fees)

    def refresh(self, plan: Plan) -> Plan:
        """Return the plan with steps marked that were deployed meanwhile. Quotes of the others do not change."""
        return replace(plan, steps=tuple(self._refresh(step) for step in plan.steps))

    def _refresh(self, step: DeploymentStep) -> DeploymentStep:
        if step.is_deployed:
            return step
        if step.deployment is None:
            is_deployed = is_proxy_deployed(self.connection)
        else:
            is_deployed = self.is_deployed(step.deployment)
        return replace(step, is_deployed=True, gas=0, quote=None) if is_deployed else step

    def is_deployed(self, wanted: Deployment) -> bool:
        """Return whether a contract is at its address. Raises TransactionError if other code is there."""
        code = self.connection.code(wanted.address)
        if code and code != wanted.code:
            raise TransactionError(
                f"the code at {checksum_address(wanted.address)} on chain {self.connection.chain_id} is not that of "
                f"{wanted.name}: do not trust the chain or the node"
            )
        return bool(code)

    def execute(
        self,
        plan: Plan,
        transactor: Transactor,
        report: Callable[[DeploymentStep, Sequence[Receipt]], None] | None = None,
    ) -> list[Receipt]:
        """Deploy what is missing, one contract after the other, and compare the code of each.

        report: called after each step. Raises TransactionError if a step fails; a later plan continues from there.
        """
        receipts: list[Receipt] = []
        plan = self.refresh(plan)
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
        self.record([step.deployment for step in plan.steps if step.deployment is not None])
        return receipts

    def deploy(self, wanted: Deployment, quote: Quote, transactor: Transactor) -> Receipt | None:
        """Deploy one contract as quoted, and compare its code. Return None if someone else deployed it meanwhile."""
        return create(transactor, quote, lambda: self.is_deployed(wanted), wanted.name, wanted.address)

    def record(self, deployed: Sequence[Deployment]) -> None:
        """Write the addresses of contracts to the address book."""
        if deployed:
            self.book.write(self.connection.chain_id, {each.name: each.address for each in deployed})

    def _check_chain(self, missing: Sequence[Deployment]) -> None:
        """Check that contracts can be deployed and used, before anything is paid."""
        try:
            self.connection.request("eth_call", {"data": to_hex(NEWEST)}, "latest")
        except (NoAnswerError, WrongChainError):
            raise
        except ChainError:
            pass  # some nodes refuse calls without a receiver
        limit = self.connection.block_gas_limit()
        for each in missing:
            if each.gas > limit:
                raise TransactionError(
                    f"{each.name} needs {each.gas:,} gas, and a block of chain {self.connection.chain_id} has "
                    f"{limit:,}: it cannot be deployed there"
                )

    def _proxy_step(self, fees: Fees) -> DeploymentStep:
        if is_proxy_deployed(self.connection):
            return DeploymentStep("deployment proxy", PROXY, True)
        check_gas(self.connection)
        missing = missing_funds(self.connection)
        if not missing:
            return DeploymentStep("deployment proxy", PROXY, False, GAS)
        (quote,) = make_quotes(self.connection, [funding(missing)], fees)
        return DeploymentStep("deployment proxy", PROXY, False, GAS + TRANSFER_GAS, quote)


def create(
    transactor: Transactor, quote: Quote, is_deployed: Callable[[], bool], name: str, address: bytes
) -> Receipt | None:
    """Send a transaction that creates a contract at an address which its code determines.

    Return None if the transaction failed because someone else created the same contract first. is_deployed: asks the
    chain. Raises TransactionError if the contract is not there in the end.
    """
    try:
        receipt = transactor.send(quote)
    except TransactionError as error:
        try:
            exists = is_deployed()
        except ChainError:
            raise error from None
        if exists:
            return None
        raise
    if not transactor.wait(lambda: is_deployed() or None):
        raise TransactionError(
            f"{name} is not at {checksum_address(address)}, though its transaction {receipt.hash} succeeded: is "
            "the node synchronized?"
        )
    return receipt
