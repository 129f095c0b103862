"""Storage of scenes on a chain through the Studio: plan with prices, transactions, and check of the result."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial

from .._render import render
from ..chain._connection import Connection, read_all
from ..deploy._contract import in_order
from ..deploy._deployer import Deployer, Plan, create
from ..deploy._quote import Call, Fees, Quote, current_fees, make_quotes
from ..deploy._transactor import Receipt, Transactor
from ..errors import VerificationError
from ..ethereum._encoding import checksum_address
from ..image import Image, decode_bmp
from ..scene._scene import Scene
from ..studio._storage import STUDIO, StoreTransaction, store_scene
from ._contract import Contract

#: The Studio has two functions called `render`.
RENDER = "render(address)"


@dataclass(frozen=True)
class SceneToStore:
    """A scene to store. position_bits: None is exact; 4 to 16 are cheaper."""

    name: str
    scene: Scene
    position_bits: int | None = None


@dataclass(frozen=True)
class QuotedStorage:
    """A transaction that stores a part of the scene `name`, with its quote."""

    name: str
    transaction: StoreTransaction
    quote: Quote


@dataclass(frozen=True)
class StoragePlan:
    """Transactions that store scenes.

    parts: contracts that are needed. missing: what is not stored yet, in order. pointers: addresses of the scenes, in
    the order of the request. codes: code of all parts of the scenes, by address.
    """

    parts: Plan
    studio: str
    missing: tuple[QuotedStorage, ...]
    pointers: tuple[str, ...]
    codes: Mapping[bytes, bytes]

    @property
    def gas(self) -> int:
        """Gas of the transactions that store, as counted here."""
        return sum(each.transaction.gas for each in self.missing)

    @property
    def quotes(self) -> list[Quote]:
        """Quotes of the transactions that store."""
        return [each.quote for each in self.missing]


def plan_storage(connection: Connection, wanted: Iterable[SceneToStore], fees: Fees | None = None) -> StoragePlan:
    """Plan the transactions that store scenes, without those that are stored already.

    fees: None uses the current ones. Each scene is rendered first, so that errors occur before anything is paid.
    """
    fees = current_fees(connection) if fees is None else fees
    parts = in_order([STUDIO])
    place = parts[-1].address
    stored: dict[bytes, tuple[str, StoreTransaction]] = {}
    pointers = []
    for each in wanted:
        render(each.scene)
        transactions = store_scene(each.scene, place, each.position_bits)
        pointers.append(checksum_address(transactions[-1].pointer))
        for transaction in transactions:
            stored.setdefault(transaction.pointer, (each.name, transaction))
    is_there = read_all(partial(_is_stored, connection), list(stored))
    missing = [part for part, is_stored in zip(stored.values(), is_there, strict=True) if not is_stored]
    plan = Deployer(connection).plan(parts, fees)
    calls = [Call(place, each.data, each.gas, needs=plan.codes) for _, each in missing]
    quotes = make_quotes(connection, calls, fees, plan.quotes)
    quoted = (QuotedStorage(*named, quote) for named, quote in zip(missing, quotes, strict=True))
    codes = {pointer: each.code for pointer, (_, each) in stored.items()}
    return StoragePlan(plan, checksum_address(place), tuple(quoted), tuple(pointers), codes)


def store(
    storage: StoragePlan,
    transactor: Transactor,
    report: Callable[[str, bytes, Receipt], None] | None = None,
) -> list[Receipt]:
    """Deploy missing contracts, store missing parts of scenes, and return the receipts of the latter.

    report: called after each step. After a failure, a new plan continues from there.
    """
    Deployer(transactor.connection).execute(storage.parts, transactor, report)
    receipts = []
    for quoted in storage.missing:
        each = quoted.transaction
        # the address is a hash of the stored bytes, so no others can be there
        is_stored = partial(_is_stored, transactor.connection, each.pointer)
        receipt = create(transactor, quoted.quote, is_stored, f"the {each.what}", each.pointer)
        if receipt is None:
            continue
        receipts.append(receipt)
        if report is not None:
            name = f"{quoted.name}, {each.what}, {each.size:,} bytes"
            report(name, each.pointer, receipt)
    return receipts


def read_back(connection: Connection, studio: str, pointer: str, wanted: SceneToStore) -> Image:
    """Return the picture of a stored scene, as the Studio renders it.

    Raises VerificationError if it is wrong; if the scene was stored exactly, all bytes are compared.
    """
    contract = Contract(connection, STUDIO, studio)
    bmp: bytes = contract.call(RENDER, pointer)
    pixels = decode_bmp(bmp, wanted.scene.width, wanted.scene.height)
    if wanted.position_bits is None and bmp != render(wanted.scene).bmp:
        raise VerificationError(
            f"the picture of {wanted.name} on chain {connection.chain_id} differs from the one computed here"
        )
    return Image(pixels, bmp, contract.gas(RENDER, pointer), None, connection.name)


def _is_stored(connection: Connection, pointer: bytes) -> bool:
    return bool(connection.code(pointer))
