"""Deployment of a collection, of the contracts that it calls, and its setup before the sale; its immutable values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..artifacts import artifact
from ..base.checks import whole
from ..chain._connection import Connection
from ..deploy._contract import Deployment, deployment, in_order
from ..deploy._deployer import Deployer, Plan, create
from ..deploy._quote import Call, Fees, Quote, current_fees, make_quotes
from ..deploy._transactor import Receipt, Transactor
from ..errors import InputError, VerificationError
from ..ethereum._encoding import PROXY, PUSH32, checksum_address, create2_address, instructions, word
from ._collection import Collection, CollectionKind
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
        whole(self.price, "the price, in wei,", 0, (1 << 128) - 1)
        whole(self.reserve, "the reserve", 0, GENESIS_SUPPLY)
        whole(self.per_transaction, "the number of tokens that a call may mint", 1, MAX_PER_TRANSACTION)
        whole(self.royalty, "the royalty, in hundredths of a percent,", 0, MAX_ROYALTY)
        whole(self.salt, "the salt", 0, (1 << 256) - 1)
        if self.royalty and int(self.royalty_receiver, 16) == 0:
            raise InputError("royalties need a receiver other than the address 0")
        if int(self.owner, 16) == 0:
            raise InputError("the owner cannot be the address 0")


def parts_of(contract: str) -> list[Deployment]:
    """Return the contracts that a contract needs, in the order of deployment."""
    return in_order(artifact(contract).parts)


def address_of(contract: str) -> str:
    """Return the address of a contract that exists once on each chain: its constructor takes only such contracts."""
    return checksum_address(in_order([contract])[-1].address)


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


def creation_code(kind: CollectionKind, parts: Sequence[Deployment], terms: CollectionTerms) -> bytes:
    """Return the creation code of a collection, with the arguments of its constructor."""
    built, places = artifact(kind.contract), {part.name: part.address for part in parts}
    arguments = [*(places[name] for name in built.parts), *(getattr(terms, term) for term in kind.terms)]
    struct = (terms.owner, terms.per_transaction, terms.royalty_receiver, terms.royalty)
    return built.creation + built.interface.construct(*arguments, struct)


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
    report: Callable[[str, bytes, Receipt], None] | None = None,
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
        report(kind.contract, place, receipt)
    return Collection(connection, kind, launch.address), receipt


def _is_deployed(connection: Connection, kind: CollectionKind, place: bytes) -> bool:
    """Return whether a collection is at its address. Raises VerificationError if other code is there."""
    code = connection.code(place)
    if code:
        immutable_values(code, artifact(kind.contract).runtime)
    return bool(code)


def plan_setup(
    connection: Connection,
    launch: Launch,
    fees: Fees,
    allow_list: tuple[bytes, str | None] | None,
    icons: Sequence[tuple[Any, ...]],
    codes: Mapping[bytes, bytes],
    known: Sequence[Quote],
) -> dict[str, Quote]:
    """Plan the transactions by which the owner sets the allow list and adds icons, without those sent already.

    allow_list: root, and signer of permissions; None sets none. icons: arguments of `add` for each. codes: code of
    their stored scenes, by address. known: quotes of earlier transactions. Returns quotes by a description of what was
    done. Raises InputError if the collection is sealed and lacks icons.
    """
    collection, is_deployed = Collection(connection, launch.kind, launch.address), launch.quote is None
    contract = collection.contract
    wanted: dict[str, Call] = {}
    if allow_list is not None:
        root, signer = allow_list[0], allow_list[1] or ZERO_ADDRESS
        if not is_deployed or (contract.call("allowListRoot"), contract.account("allowListSigner")) != (root, signer):
            wanted["allow list set"] = contract.prepare("setAllowList", root, signer)
    scenes = {icon.name: icon.scene for icon in icons_of(collection)} if is_deployed and icons else {}
    missing = [each for each in icons if scenes.get(each[0]) != each[1]]
    if is_deployed and missing and contract.call("isSealed"):
        raise InputError(f"{collection.name} at {launch.address} is sealed without {missing[0][0]}: use another `salt`")
    wanted |= {f"{each[0]}: added": add_call(contract, each, codes) for each in missing}
    quotes = make_quotes(connection, list(wanted.values()), fees, known)
    return dict(zip(wanted, quotes, strict=True))


#: What the compiler pushes in place of an immutable value; it pushes 32 zeros nowhere else.
EMPTY = bytes(32)


def immutable_places(runtime: bytes) -> list[int]:
    """Return the offsets of immutable values, of 32 bytes each, in the runtime code of an artifact."""
    pushed = [at + 1 for at in instructions(runtime) if runtime[at] == PUSH32]
    return [at for at in pushed if runtime[at : at + 32] == EMPTY]


def immutable_values(code: bytes, runtime: bytes) -> dict[int, bytes]:
    """Return the immutable values of deployed code by their offsets.

    Raises VerificationError if it differs elsewhere from `runtime`.
    """
    places = immutable_places(runtime)
    if len(code) != len(runtime):
        raise VerificationError(f"its code has {len(code):,} bytes, not {len(runtime):,}")
    masked = bytearray(code)
    for place in places:
        masked[place : place + 32] = EMPTY
    if bytes(masked) != runtime:
        at = next(at for at, (one, other) in enumerate(zip(masked, runtime, strict=True)) if one != other)
        raise VerificationError(f"its code differs from the compiled contract at byte {at:,}")
    return {place: code[place : place + 32] for place in places}
