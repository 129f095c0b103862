"""Putting a collection on a chain, and before it the contracts that it uses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from ..artifacts import artifact
from ..chain import Connection
from ..deploy import (
    Call,
    Deployer,
    Deployment,
    Fees,
    Plan,
    Quote,
    Receipt,
    Step,
    Transactor,
    create,
    current_fees,
    deployment,
    in_order,
    make_quotes,
)
from ..errors import InputError
from ..ethereum import PROXY, checksum_address, create2_address, ether, word
from ._collection import Collection
from ._immutables import immutable_values
from ._kinds import Kind

MAX_PER_TRANSACTION = 100
#: In hundredths of a percent.
MAX_ROYALTY = 1000
GENESIS_SUPPLY = 1024


@dataclass(frozen=True)
class Offer:
    """What a collection is deployed with; what of it cannot be changed afterwards is checked before anything is sent.

    owner, royalty_receiver: addresses. price: in wei, of each token. reserve: tokens for the team.
    royalty: in hundredths of a percent. salt: another number gives the same offer another address.
    """

    owner: str
    royalty_receiver: str
    price: int = 15 * 10**16
    reserve: int = 20
    per_transaction: int = 5
    royalty: int = 500
    salt: int = 0

    def __post_init__(self) -> None:
        """Raise InputError where the contract would refuse."""
        checks = (
            (0 <= self.reserve <= GENESIS_SUPPLY, f"the reserve must be 0 to {GENESIS_SUPPLY:,}, not {self.reserve}"),
            (
                1 <= self.per_transaction <= MAX_PER_TRANSACTION,
                f"a call may mint 1 to {MAX_PER_TRANSACTION} tokens, not {self.per_transaction}",
            ),
            (
                0 <= self.royalty <= MAX_ROYALTY,
                f"royalties can be 0 to {MAX_ROYALTY / 100:g} %, not {self.royalty / 100:g} %",
            ),
            (0 <= self.price < 2**128, f"the price cannot be {ether(self.price)}"),
            (0 <= self.salt < 2**256, f"the salt must be a number of 256 bits, not {self.salt}"),
            (int(self.royalty_receiver, 16) != 0 or not self.royalty, "royalties need a receiver other than address 0"),
            (int(self.owner, 16) != 0, "the owner cannot be the address 0"),
        )
        for holds, message in checks:
            if not holds:
                raise InputError(message)

    @property
    def struct(self) -> tuple[str, int, str, int]:
        """The struct Terms of contracts/src/tokens/Collection.sol."""
        return self.owner, self.per_transaction, self.royalty_receiver, self.royalty


def parts_of(contract: str, itself: bool = False) -> list[Deployment]:
    """Return the contracts that one needs, in the order in which they are deployed; the same on every chain.

    itself: whether to add that one, which needs nothing but these.
    """
    return in_order([contract] if itself else artifact(contract).parts)


def address_of(deployments: Sequence[Deployment], name: str) -> str:
    """Return where one of some contracts stands."""
    return checksum_address(next(each.address for each in deployments if each.name == name))


@dataclass(frozen=True)
class Launch:
    """A collection that is to be deployed. parts: what is missing before. quote: of its own transaction; None if the
    collection stands already.
    """

    kind: Kind
    parts: Plan
    creation: bytes
    salt: bytes
    quote: Quote | None

    @property
    def address(self) -> str:
        """Where it will stand."""
        return checksum_address(create2_address(self.creation, self.salt))

    @property
    def quotes(self) -> list[Quote]:
        """Of all transactions."""
        return self.parts.quotes + ([] if self.quote is None else [self.quote])

    @property
    def gas(self) -> int:
        """Of all transactions, as counted here."""
        return self.parts.gas + (0 if self.quote is None else self.quote.call.ours)


def creation_code(kind: Kind, parts: Sequence[Deployment], offer: Offer) -> bytes:
    """Return what deploys a collection, its terms included."""
    arguments: list[Any] = [address_of(parts, part) for part in artifact(kind.contract).parts]
    arguments += [getattr(offer, term) for term in kind.terms]
    built = artifact(kind.contract)
    return built.creation + built.interface.construct(*arguments, offer.struct)


def plan_launch(connection: Connection, kind: Kind, offer: Offer, fees: Fees | None = None) -> Launch:
    """Return what is to be deployed. fees: None asks for those of now. VerificationError if other code is there."""
    fees = current_fees(connection) if fees is None else fees
    parts = parts_of(kind.contract)
    creation = creation_code(kind, parts, offer)
    salt = word(offer.salt)
    plan = Deployer(connection).plan(parts, fees)
    if _stands(connection, kind, create2_address(creation, salt)):
        return Launch(kind, plan, creation, salt, None)
    # the constructor is run here; on the chain other numbers of blocks may change it by a few hundred gas
    gas = deployment(kind.contract, creation, [each.name for each in parts]).gas
    (quote,) = make_quotes(connection, [Call(PROXY, salt + creation, gas, needs=plan.codes)], fees, plan.quotes)
    return Launch(kind, plan, creation, salt, quote)


def launch(
    launch: Launch,
    transactor: Transactor,
    report: Callable[[Step, Sequence[Receipt]], None] | None = None,
) -> tuple[Collection, Receipt | None]:
    """Deploys what is missing, then the collection, and compares its code; the collection, and the receipt of its own,
    None if it stood there already, whoever had deployed it.

    TransactionError if anything fails; what was done before stays, and the next time goes on from there.
    """
    connection, kind = transactor.connection, launch.kind
    deployer = Deployer(connection)
    deployer.carry_out(launch.parts, transactor, report)
    place = bytes.fromhex(launch.address[2:])
    receipt = None
    if launch.quote is not None:
        receipt = create(transactor, launch.quote, lambda: _stands(connection, kind, place), kind.title, place)
    deployer.book.write(connection.chain_id, {kind.contract: place})
    if report is not None and receipt is not None:
        report(Step(kind.contract, place, False), [receipt])
    return Collection(connection, kind, launch.address), receipt


def _stands(connection: Connection, kind: Kind, place: bytes) -> bool:
    """Return whether a collection is at its address. VerificationError if anything else is there."""
    code = connection.code(place)
    if code:
        immutable_values(code, artifact(kind.contract).runtime)
    return bool(code)
