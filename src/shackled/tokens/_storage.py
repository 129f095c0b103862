"""Scenes put on a chain through the Studio: what is missing there, what it costs, and doing it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from .._render import render
from ..chain import Connection
from ..deploy import Call, Deployer, Fees, Plan, Quote, Receipt, Step, Transactor, create, current_fees, make_quotes
from ..errors import VerificationError
from ..ethereum import checksum_address
from ..image import Image, decode_bmp
from ..scene import Scene
from ..studio import STUDIO, Storing, store_scene
from ._contract import Contract
from ._deploying import address_of, parts_of

#: The Studio has two functions of this name.
RENDER = "render(address)"


@dataclass(frozen=True)
class Wanted:
    """A scene that is to be on a chain. position_bits: None keeps it exactly; fewer, 4 to 16, are cheaper."""

    name: str
    scene: Scene
    position_bits: int | None = None
    normal_bits: int = 10


@dataclass(frozen=True)
class Due:
    """Something that is to be stored, of the scene of that name."""

    name: str
    storing: Storing
    quote: Quote


@dataclass(frozen=True)
class Storage:
    """What is to be done. parts: contracts that are missing. missing: what is to be stored, in this order. pointers: of
    the scenes, in the order in which they were wanted. codes: by address, what the chain keeps of the scenes then.
    """

    parts: Plan
    studio: str
    missing: tuple[Due, ...]
    pointers: tuple[str, ...]
    codes: Mapping[bytes, bytes]

    @property
    def gas(self) -> int:
        """Of those transactions that store, as counted here."""
        return sum(each.storing.gas for each in self.missing)

    @property
    def quotes(self) -> list[Quote]:
        """Of those that store."""
        return [each.quote for each in self.missing]


def plan_storage(connection: Connection, wanted: Iterable[Wanted], fees: Fees | None = None) -> Storage:
    """Return what of some scenes a chain does not have yet. fees: None asks for those of now.

    Each scene is rendered here first, since one that cannot be rendered is not worth the price.
    """
    fees = current_fees(connection) if fees is None else fees
    parts = parts_of(STUDIO, itself=True)
    studio = address_of(parts, STUDIO)
    missing: dict[bytes, tuple[str, Storing]] = {}
    pointers, codes = [], {}
    for each in wanted:
        render(each.scene)
        storings = store_scene(each.scene, bytes.fromhex(studio[2:]), each.position_bits, each.normal_bits)
        pointers.append(checksum_address(storings[-1].pointer))
        for storing in storings:
            codes[storing.pointer] = storing.code
            if storing.pointer not in missing and not _stands(connection, storing):
                missing[storing.pointer] = each.name, storing
    plan = Deployer(connection).plan(parts, fees)
    place = bytes.fromhex(studio[2:])
    calls = [Call(place, storing.data, storing.gas, needs=plan.codes) for _, storing in missing.values()]
    quotes = make_quotes(connection, calls, fees, plan.quotes)
    due = (Due(name, storing, quote) for (name, storing), quote in zip(missing.values(), quotes, strict=True))
    return Storage(plan, studio, tuple(due), tuple(pointers), codes)


def store(
    storage: Storage,
    transactor: Transactor,
    report: Callable[[Step, Sequence[Receipt]], None] | None = None,
) -> list[Receipt]:
    """Deploys what is missing and stores what is missing; the receipts of the latter.

    What was done before a failure stays, and the next time goes on from there.
    """
    Deployer(transactor.connection).carry_out(storage.parts, transactor, report)
    receipts = []
    for due in storage.missing:
        each = due.storing
        # the address is made of the bytes that are kept: if anything is there, it is these
        receipt = create(
            transactor, due.quote, partial(_stands, transactor.connection, each), f"the {each.what}", each.pointer
        )
        if receipt is None:
            continue
        receipts.append(receipt)
        if report is not None:
            report(Step(f"{due.name}, {each.what}, {each.size:,} bytes", each.pointer, False), [receipt])
    return receipts


def read_back(connection: Connection, studio: str, pointer: str, wanted: Wanted) -> Image:
    """Return the picture that the Studio of a chain draws of a scene that it keeps.

    VerificationError if it is not that of the scene as it was kept; exact scenes are compared byte for byte.
    """
    contract = Contract(connection, STUDIO, studio)
    started = time.perf_counter()
    bmp: bytes = contract.call(RENDER, pointer)
    seconds = time.perf_counter() - started
    pixels = decode_bmp(bmp, wanted.scene.width, wanted.scene.height)
    if wanted.position_bits is None and wanted.normal_bits == 10 and bmp != render(wanted.scene).bmp:
        raise VerificationError(f"chain {connection.chain_id} does not draw {wanted.name} as it is computed here")
    return Image(pixels, bmp, contract.gas(RENDER, pointer), None, connection.name, seconds)


def _stands(connection: Connection, storing: Storing) -> bool:
    return bool(connection.code(storing.pointer))
