"""The deployer: plans, quotes and sends the transactions of contracts that a chain does not have yet."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from ..chain._address_book import AddressBook
from ..chain._connection import Connection, read_all
from ..errors import ChainError, NoAnswerError, TransactionError, WrongChainError
from ..ethereum._amounts import rounded
from ..ethereum._encoding import PROXY, checksum_address, to_hex
from ._contract import PROXY_CODE, Deployment
from ._quote import Call, Fees, Quote, current_fees, make_quotes
from ._transactor import Receipt, Transactor

#: A program with the newest instruction that the contracts use: PUSH0 PUSH0 PUSH0 MCOPY STOP.
NEWEST = bytes.fromhex("5f5f5f5e00")


@dataclass(frozen=True)
class DeploymentStep:
    """One contract of a plan. code: at its address, then. quote: of its transaction; None if it is deployed already."""

    name: str
    address: bytes
    code: bytes
    quote: Quote | None

    @property
    def is_deployed(self) -> bool:
        """Whether there is nothing to do."""
        return self.quote is None


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
    def quotes(self) -> list[Quote]:
        """Quotes of the transactions."""
        return [step.quote for step in self.steps if step.quote is not None]

    @property
    def gas(self) -> int:
        """Gas of all transactions, as counted here."""
        return sum(quote.call.gas for quote in self.quotes)

    @property
    def cost(self) -> int:
        """Likely cost, in wei."""
        return sum(quote.likely for quote in self.quotes)

    @property
    def ceiling(self) -> int:
        """Maximum cost, in wei."""
        return sum(quote.ceiling for quote in self.quotes)

    @property
    def codes(self) -> dict[bytes, bytes]:
        """Runtime code, by address, of the missing contracts."""
        return {step.address: step.code for step in self.missing}


class Deployer:
    """Deploys contracts through the deterministic-deployment proxy, and records their addresses."""

    def __init__(self, connection: Connection, book: AddressBook | None = None) -> None:
        self.connection = connection
        self.book = AddressBook() if book is None else book

    def plan(self, wanted: Sequence[Deployment], fees: Fees | None = None) -> Plan:
        """Return which contracts are missing, and what they cost. fees: None uses the current ones.

        Raises TransactionError if other code is at an address, if a contract does not fit a block, if the chain lacks
        the proxy, or if the node's prices are implausible (`current_fees`, `make_quote`); WrongChainError if the
        chain's rules are too old.
        """
        fees = current_fees(self.connection) if fees is None else fees
        deployed = list(read_all(self.is_deployed, wanted))
        missing = [each for each, done in zip(wanted, deployed, strict=True) if not done]
        if missing:
            self._check_chain(missing)
        calls: list[Call] = []
        codes: dict[bytes, bytes] = {}
        for each in missing:
            calls.append(Call(PROXY, each.data, each.gas, needs=dict(codes)))
            codes[each.address] = each.code
        quotes = iter(make_quotes(self.connection, calls, fees))
        steps = (
            DeploymentStep(each.name, each.address, each.code, None if done else next(quotes))
            for each, done in zip(wanted, deployed, strict=True)
        )
        return Plan(tuple(steps), fees)

    def refresh(self, plan: Plan) -> Plan:
        """Return the plan with steps marked that were deployed meanwhile. Quotes of the others do not change."""
        return replace(
            plan,
            steps=tuple(
                replace(step, quote=None) if step.quote is not None and self.is_deployed(step) else step
                for step in plan.steps
            ),
        )

    def is_deployed(self, wanted: Deployment | DeploymentStep) -> bool:
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
        report: Callable[[str, bytes, Receipt], None] | None = None,
    ) -> list[Receipt]:
        """Deploy what is missing, one contract after the other, as quoted, and compare the code of each.

        report: called with name, address and receipt of each contract. Raises TransactionError if a step fails; a later
        plan continues from there.
        """
        receipts: list[Receipt] = []
        plan = self.refresh(plan)
        if plan.missing and transactor.balance() < plan.cost:
            raise TransactionError(
                f"{transactor.name} has {rounded(transactor.balance())} ether on chain {self.connection.chain_id}, and "
                f"{rounded(plan.cost)} are needed: send it some"
            )
        for step in plan.missing:
            assert step.quote is not None
            is_deployed = partial(self.is_deployed, step)
            receipt = create(transactor, step.quote, is_deployed, step.name, step.address)
            if receipt is not None:
                receipts.append(receipt)
                if report is not None:
                    report(step.name, step.address, receipt)
        self.record(plan.steps)
        return receipts

    def record(self, deployed: Sequence[Deployment | DeploymentStep]) -> None:
        """Write the addresses of contracts to the address book."""
        if deployed:
            self.book.write(self.connection.chain_id, {each.name: each.address for each in deployed})

    def _check_chain(self, missing: Sequence[Deployment]) -> None:
        """Check that contracts can be deployed and used, before anything is paid."""
        chain = f"chain {self.connection.chain_id}"
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
                    f"{each.name} needs {each.gas:,} gas, and a block of {chain} has {limit:,}: it cannot be deployed "
                    "there"
                )
        code = self.connection.code(PROXY)
        if code != PROXY_CODE:
            raise TransactionError(
                f"{chain} has {'other code' if code else 'no code'} at the address of the deployment proxy, "
                f"{checksum_address(PROXY)}: take another chain, deploy it as "
                "github.com/Arachnid/deterministic-deployment-proxy says, or, on a development node, put its code "
                "there (anvil_setCode, hardhat_setCode)"
            )


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
