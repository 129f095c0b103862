"""Deployment of a collection, of the contracts that it calls, and its setup before the sale; its immutable values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..artifacts import artifact
from ..chain import Connection
from ..deploy import (
    Call,
    Deployer,
    Deployment,
    DeploymentStep,
    Fees,
    Plan,
    Quote,
    Receipt,
    Transactor,
    create,
    current_fees,
    deployment,
    in_order,
    make_quotes,
)
from ..errors import InputError, VerificationError
from ..ethereum import PROXY, checksum_address, create2_address, ether, word
from ._collection import Collection, CollectionKind
from ._contract import call_of
from ._icons import add_call, icons_of

MAX_PER_TRANSACTION = 100
#: In hundredths of a percent.
MAX_ROYALTY = 1000
GENESIS_SUPPLY = 1024
ZERO_ADDRESS = "0x" + "00" * 20


@dataclass(frozen=True)
class CollectionTerms:
    """The arguments with which a collection is deployed, checked before anything is sent.

    owner, royalty_receiver: addresses. price: of each token, in wei. reserve: number of tokens for the team.
    royalty: in hundredths of a percent. salt: another number gives the same collection another address.
    """

    owner: str
    royalty_receiver: str
    price: int = 15 * 10**16
    reserve: int = 20
    per_transaction: int = 5
    royalty: int = 500
    salt: int = 0

    def __post_init__(self) -> None:
        """Raise InputError if the contract would refuse the terms."""
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
            (0 <= self.price < 2**128, f"the price must be below 2^128 wei, not {ether(self.price)}"),
            (0 <= self.salt < 2**256, f"the salt must be a number of 256 bits, not {self.salt}"),
            (
                int(self.royalty_receiver, 16) != 0 or not self.royalty,
                "royalties need a receiver other than the address 0",
            ),
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
    """Return the contracts that a contract needs, in the order of deployment.

    itself: add the contract, whose constructor must take nothing else.
    """
    return in_order([contract] if itself else artifact(contract).parts)


def address_of(deployments: Sequence[Deployment], name: str) -> str:
    """Return the address of one of these contracts."""
    return checksum_address(next(each.address for each in deployments if each.name == name))


@dataclass(frozen=True)
class Launch:
    """A collection to deploy.

    parts: contracts that it needs. quote: of the transaction that deploys it; None if it is deployed already.
    """

    kind: CollectionKind
    parts: Plan
    creation: bytes
    salt: bytes
    quote: Quote | None

    @property
    def address(self) -> str:
        """Address of the collection."""
        return checksum_address(create2_address(self.creation, self.salt))

    @property
    def quotes(self) -> list[Quote]:
        """Quotes of all transactions."""
        return self.parts.quotes + ([] if self.quote is None else [self.quote])

    @property
    def gas(self) -> int:
        """Gas of all transactions, as counted here."""
        return self.parts.gas + (0 if self.quote is None else self.quote.call.gas)


def creation_code(kind: CollectionKind, parts: Sequence[Deployment], terms: CollectionTerms) -> bytes:
    """Return the creation code of a collection, with the arguments of its constructor."""
    arguments: list[Any] = [address_of(parts, part) for part in artifact(kind.contract).parts]
    arguments += [getattr(terms, term) for term in kind.terms]
    built = artifact(kind.contract)
    return built.creation + built.interface.construct(*arguments, terms.struct)


def plan_launch(
    connection: Connection, kind: CollectionKind, terms: CollectionTerms, fees: Fees | None = None
) -> Launch:
    """Plan a deployment. fees: None uses the current ones. Raises VerificationError if other code is at the address."""
    fees = current_fees(connection) if fees is None else fees
    parts = parts_of(kind.contract)
    creation = creation_code(kind, parts, terms)
    salt = word(terms.salt)
    plan = Deployer(connection).plan(parts, fees)
    if _is_deployed(connection, kind, create2_address(creation, salt)):
        return Launch(kind, plan, creation, salt, None)
    # run in a local EVM; on the chain, the block number may change it by a few hundred gas
    gas = deployment(kind.contract, creation, [each.name for each in parts]).gas
    (quote,) = make_quotes(connection, [Call(PROXY, salt + creation, gas, needs=plan.codes)], fees, plan.quotes)
    return Launch(kind, plan, creation, salt, quote)


def launch(
    launch: Launch,
    transactor: Transactor,
    report: Callable[[DeploymentStep, Sequence[Receipt]], None] | None = None,
) -> tuple[Collection, Receipt | None]:
    """Deploy the missing contracts, then the collection, and compare its code.

    Return the collection and the receipt of its transaction, None if it was deployed already.
    Raises TransactionError if a transaction fails; a later launch continues from there.
    """
    connection, kind = transactor.connection, launch.kind
    deployer = Deployer(connection)
    deployer.execute(launch.parts, transactor, report)
    place = bytes.fromhex(launch.address[2:])
    receipt = None
    if launch.quote is not None:
        receipt = create(transactor, launch.quote, lambda: _is_deployed(connection, kind, place), kind.title, place)
    deployer.book.write(connection.chain_id, {kind.contract: place})
    if report is not None and receipt is not None:
        report(DeploymentStep(kind.contract, place, False), [receipt])
    return Collection(connection, kind, launch.address), receipt


def _is_deployed(connection: Connection, kind: CollectionKind, place: bytes) -> bool:
    """Return whether a collection is at its address. Raises VerificationError if other code is there."""
    code = connection.code(place)
    if code:
        immutable_values(code, artifact(kind.contract).runtime)
    return bool(code)


@dataclass(frozen=True)
class SetupStep:
    """A transaction of the owner before the sale. what: description of its result."""

    what: str
    quote: Quote


def plan_setup(
    connection: Connection,
    launch: Launch,
    fees: Fees,
    allow_list: tuple[bytes, str | None] | None,
    icons: Sequence[tuple[Any, ...]],
    codes: Mapping[bytes, bytes],
    known: Sequence[Quote],
) -> list[SetupStep]:
    """Plan the transactions that set the allow list and add icons, without those that were sent already.

    allow_list: root, and signer of permissions; None sets none. icons: arguments of `add` for each. codes: code of
    their stored scenes, by address. known: quotes of earlier transactions. Raises InputError if the collection is
    sealed and lacks icons.
    """
    deployed = None if launch.quote is not None else Collection(connection, launch.kind, launch.address)
    interface = artifact(launch.kind.contract).interface
    wanted: list[tuple[str, Call]] = []
    if allow_list is not None:
        root, signer = allow_list[0], allow_list[1] or ZERO_ADDRESS
        state = None if deployed is None else deployed.state()
        if state is None or (state.allow_list_root, state.allow_list_signer) != (root, signer):
            wanted.append(("allow list set", call_of(interface, launch.address, "setAllowList", root, signer)))
    scenes = {} if deployed is None or not icons else {icon.name: icon.scene for icon in icons_of(deployed)}
    missing = [each for each in icons if scenes.get(each[0]) != each[1]]
    if deployed is not None and missing and deployed.contract.call("isSealed"):
        raise InputError(f"{deployed.name} at {deployed.address} is sealed without {missing[0][0]}: use another `salt`")
    wanted += [(f"{each[0]}: added", add_call(interface, launch.address, each, codes)) for each in missing]
    quotes = make_quotes(connection, [call for _, call in wanted], fees, known)
    return [SetupStep(what, quote) for (what, _), quote in zip(wanted, quotes, strict=True)]


PUSH1, PUSH32 = 0x60, 0x7F
#: What the compiler pushes in place of an immutable value; it pushes 32 zeros nowhere else.
EMPTY = bytes(32)


def immutable_places(runtime: bytes) -> list[int]:
    """Return the offsets of immutable values, of 32 bytes each, in the runtime code of an artifact."""
    places, at = [], 0
    while at < len(runtime):
        operation = runtime[at]
        at += 1
        if PUSH1 <= operation <= PUSH32:
            size = operation - PUSH1 + 1
            if size == 32 and runtime[at : at + 32] == EMPTY:
                places.append(at)
            at += size
    return places


def immutable_values(code: bytes, runtime: bytes) -> set[bytes]:
    """Return the immutable values of deployed code. Raises VerificationError if it differs elsewhere from `runtime`."""
    places = immutable_places(runtime)
    masked = bytearray(code)
    for place in places:
        masked[place : place + 32] = EMPTY
    if len(code) != len(runtime):
        raise VerificationError(f"its code has {len(code):,} bytes, not {len(runtime):,}")
    if bytes(masked) != runtime:
        at = next(at for at, (one, other) in enumerate(zip(masked, runtime, strict=True)) if one != other)
        raise VerificationError(f"its code differs from the compiled contract at byte {at:,}")
    return {code[place : place + 32] for place in places}
