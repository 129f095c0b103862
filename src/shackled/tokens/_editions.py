"""Editions: scenes that anyone can add to one collection, each a limited or open number of tokens."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from ..artifacts import artifact
from ..base.checks import whole
from ..chain._connection import Connection, Report, read_all
from ..deploy._contract import local_chain
from ..deploy._quote import Call
from ..errors import InputError, NodeError, OutOfGasError, RenderError, VerificationError
from ..ethereum._amounts import amount
from ..ethereum._encoding import checksum_address, intrinsic_gas
from ..studio._storage import STUDIO
from ._collection import EDITIONS, Collection
from ._contract import find_events
from ._icons import SCALE
from ._launch import MAX_ROYALTY, address_of
from ._metadata import MAX_LENGTH

#: The supply of an edition without a limit.
OPEN = 2**32 - 1
#: The largest number of tokens of a call.
MOST_AT_ONCE = 100
MAX_NAME = 64
MAX_SCALE = 8
#: Bytes of the JSON of a token without its picture, at most.
DOCUMENT = 1_500
#: Gas of `add` that depends on the chain: counters and balances that are new or not, each copy, and the rest.
ADD_GAS, COPY_GAS = 70_000, 3_000
#: Gas of `withdraw` for each edition but the first.
WITHDRAW_GAS = 8_000
#: The maximum number of editions.
MOST = 1 << 24
ADDED = "EditionAdded(uint256,address,address,string,uint256,bool,uint256,uint256,uint256)"


@dataclass(frozen=True)
class EditionTerms:
    """The terms of a new edition, which cannot be changed later.

    name: 1 to 64 bytes. scene: address of the stored scene. price: of a token, in wei. supply: maximum number of
    tokens, `OPEN` for no limit. royalty: in hundredths of a percent. copies: number of tokens minted to the
    artist free of charge. scale: side of the square that each pixel becomes. model: whether the metadata contains the
    scene as a GLB model.
    """

    name: str
    scene: str
    price: int
    supply: int = OPEN
    royalty: int = 500
    copies: int = 1
    scale: int = SCALE
    model: bool = False

    def __post_init__(self) -> None:
        """Raise InputError if the contract would refuse the terms."""
        whole(len(self.name.encode(errors="replace")), "the number of bytes of the name", 1, MAX_NAME)
        whole(self.price, "the price, in wei,", 0, (1 << 96) - 1)
        whole(self.supply, "the supply", 1, OPEN)
        whole(self.royalty, "the royalty, in hundredths of a percent,", 0, MAX_ROYALTY)
        whole(self.copies, "the number of copies for the artist", 0, min(self.supply, MOST_AT_ONCE))
        whole(self.scale, "the scale", 1, MAX_SCALE)

    @property
    def arguments(self) -> tuple[Any, ...]:
        """The arguments of `add`."""
        return self.name, self.scene, self.scale, self.model, self.price, self.supply, self.royalty, self.copies


@dataclass(frozen=True)
class Edition:
    """An edition on a chain. settled: number of minted tokens whose proceeds were withdrawn."""

    number: int
    artist: str
    scene: str
    name: str
    price: int
    supply: int
    minted: int
    settled: int
    closed: bool
    royalty: int
    scale: int
    model: bool

    @property
    def left(self) -> int:
        """Number of tokens that can still be minted."""
        return 0 if self.closed else self.supply - self.minted

    @property
    def proceeds(self) -> int:
        """Ether that the artist can withdraw, in wei."""
        return (self.minted - self.settled) * self.price

    @property
    def limit(self) -> str:
        """The supply in words, as in the metadata of a token."""
        return "open" if self.supply == OPEN else str(self.supply)

    @property
    def traits(self) -> dict[str, Any]:
        """The attributes of its tokens."""
        return {"Edition": self.number, "Artist": self.artist, "Supply": self.limit}

    def check(self, artist: str, terms: EditionTerms) -> None:
        """Raise VerificationError unless it is what this artist added with these terms."""
        found = (self.name, self.scene, self.scale, self.model, self.price, self.supply, self.royalty)
        if self.artist.lower() != artist.lower() or found != terms.arguments[:-1]:
            raise VerificationError(
                f"edition {self.number}, which the receipt of the transaction names, does not match the terms"
            )

    def document(self) -> dict[str, Any]:
        """Return the edition for JSON, with amounts in ether. supply, left: null for no limit."""
        is_open = self.supply == OPEN
        return {
            "edition": self.number,
            "name": self.name,
            "artist": self.artist,
            "scene": self.scene,
            "price": amount(self.price),
            "supply": None if is_open else self.supply,
            "minted": self.minted,
            "left": None if is_open and not self.closed else self.left,
            "closed": self.closed,
            "royalty": self.royalty / 100,
            "model": self.model,
            "proceeds": amount(self.proceeds),
        }


def open_editions(connection: Connection, address: str | None = None) -> Collection:
    """Return the collection of editions on a chain. address: None is the usual one. Raises InputError without it."""
    collection = Collection(connection, EDITIONS, address or address_of(EDITIONS.contract))
    if not connection.code(collection.contract.place) or collection.contract.call("name") != EDITIONS.title:
        raise InputError(
            f"there is no collection of editions at {collection.address} on chain {connection.chain_id}: "
            "run shackled deploy `contracts` Editions"
        )
    return collection


def edition_at(collection: Collection, number: int) -> Edition:
    """Return an edition by its number. Raises RevertError if there is none."""
    found = collection.contract.call("editionAt", number)
    artist, scene = (checksum_address(bytes.fromhex(found[place][2:])) for place in (0, 9))
    return Edition(number, artist, scene, found[10], *found[1:9])


def editions_of(collection: Collection, artist: str | None = None, report: Report | None = None) -> list[Edition]:
    """Return all editions, or those of an artist."""
    count = collection.contract.call("editionCount")
    if count > MOST:
        raise NodeError(f"the {collection.connection.name} reports an impossible number of editions, {count:,}")
    found = read_all(partial(edition_at, collection), range(count), report)
    return [each for each in found if artist in (None, each.artist)]


def add_gas(terms: EditionTerms, codes: Mapping[bytes, bytes]) -> int:
    """Return the gas of the transaction that adds an edition, which draws its picture, from drawing it here.

    codes: code of the stored scene, by address. Raises RenderError if it cannot be drawn; InputError if it takes more
    gas than the contract allows, or if marketplaces would not show so large a picture.
    """
    local, interface = local_chain(), artifact(EDITIONS.contract).interface
    local.address(EDITIONS.contract)
    for place, code in codes.items():
        local.put(place, code)
    limit = local.ask(EDITIONS.contract, "DRAWING_GAS")
    parts: list[tuple[Any, ...]] = [("renderDataURI(address,uint256)", terms.scene, terms.scale)]
    if terms.model:
        parts.append(("glbDataURI", terms.scene))
    fewer = ", or no model" if terms.model else ""
    too_much = InputError(
        f"the tokenURI takes more than the {limit:,} gas that an edition may take: choose a smaller size, fewer "
        f"triangles or no antialiasing{fewer}"
    )
    try:
        # a contract that runs out of gas cannot always report it; with more gas, other errors can be told apart
        drawn = [local.call(STUDIO, artifact(STUDIO).interface.encode(*each), 16 * limit) for each in parts]
    except OutOfGasError:
        raise too_much from None
    if sum(each.gas for each in drawn) > limit:
        raise too_much
    length = (sum(len(each.output) for each in drawn) + DOCUMENT) * 4 // 3
    if length > MAX_LENGTH:
        raise InputError(
            f"the tokenURI would have {length:,} bytes, and marketplaces show no more than {MAX_LENGTH:,}: choose a "
            f"smaller size or scale{fewer}"
        )
    data = interface.encode("add", *terms.arguments)
    silent = interface.encode("add", *replace(terms, copies=0).arguments)
    try:
        adding = local.call(EDITIONS.contract, silent)
    except (OutOfGasError, RenderError):
        # each call keeps back a 64th of the gas
        raise too_much from None
    return adding.gas + intrinsic_gas(data) + ADD_GAS + COPY_GAS * terms.copies


def added_number(logs: Iterable[Any], address: str) -> int:
    """Return the number of the edition that a transaction added to a collection.

    logs: of its receipt. Raises VerificationError if they do not name one edition.
    """
    added = find_events(logs, address, ADDED)
    if len(added) != 1:
        raise VerificationError("the transaction succeeded, but its receipt names no new edition")
    return added[0][0]


def withdraw_call(collection: Collection, editions: Sequence[int], to: str) -> Call:
    """Return the transaction that withdraws the proceeds of these editions."""
    call = collection.contract.prepare("withdraw", editions, to)
    return replace(call, gas=call.gas + WITHDRAW_GAS * (len(editions) - 1))
