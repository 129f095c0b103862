"""The icons of a collection, each with a stored scene, a price and a supply; and the licences of what is stored."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

from attrs import evolve

from .._load import is_model, load
from ..artifacts import artifact
from ..base.checks import whole
from ..chain._connection import read_all
from ..datasets._pieces import Piece, find, pieces
from ..deploy._contract import local_chain
from ..deploy._quote import Call
from ..errors import InputError
from ..ethereum._amounts import amount
from ..ethereum._encoding import checksum_address
from ..scene._files.link import Link
from ..scene._scene import Scene
from ..studio._storage import STUDIO
from ._collection import Collection
from ._contract import Contract

#: Side of the square that each pixel becomes in the picture of a token: 128 pixels become 512.
SCALE = 4
#: The default price of a token, in wei.
ICON_PRICE = 2 * 10**16


@dataclass(frozen=True)
class CollectionIcon:
    """An icon. scene: address of its stored scene. price: in wei. supply: maximum number of tokens.

    reserve: number of these that are reserved for the team. sold, reserve_minted: numbers of minted tokens.
    """

    number: int
    name: str
    scene: str
    scale: int
    price: int
    supply: int
    reserve: int
    sold: int
    reserve_minted: int

    @property
    def left(self) -> int:
        """Number of tokens that can still be sold."""
        return self.supply - self.reserve - self.sold

    @property
    def traits(self) -> dict[str, Any]:
        """The attributes of its tokens."""
        return {"Icon": self.name, "Supply": self.supply}

    def document(self) -> dict[str, Any]:
        """Return the icon for JSON, with the price in ether."""
        return {
            "icon": self.number,
            "name": self.name,
            "scene": self.scene,
            "price": amount(self.price),
            "supply": self.supply,
            "reserve": self.reserve,
            "left": self.left,
        }


def icon_at(collection: Collection, number: int) -> CollectionIcon:
    """Return an icon by its number. Raises RevertError if there is none."""
    name, scene, *numbers = collection.contract.call("iconAt", number)
    return CollectionIcon(number, name, checksum_address(bytes.fromhex(scene[2:])), *numbers)


def icons_of(collection: Collection) -> list[CollectionIcon]:
    return list(read_all(partial(icon_at, collection), range(collection.contract.call("iconCount"))))


def find_icon(collection: Collection, text: str) -> CollectionIcon:
    """Return an icon by its number or name, such as "heart" or "icons/heart". Raises InputError if there is none."""
    icons = icons_of(collection)
    if text.isdecimal() and int(text) < len(icons):
        return icons[int(text)]
    piece = find(text if "/" in text else f"icons/{text}")
    names = {text.lower()} | ({piece.title.lower()} if piece is not None else set())
    found = [icon for icon in icons if icon.name.lower() in names]
    if not found:
        known = ", ".join(f"{icon.number} {icon.name}" for icon in icons[:40])
        raise InputError(f"there is no icon {text!r} in {collection.name}; its icons are {known or 'none yet'}")
    return found[0]


def chosen_pieces(names: str | None) -> list[Piece]:
    """Return dataset pieces for icons, from names with commas; None returns the dataset of icons.

    Raises InputError for an unknown piece, or one that must not be stored.
    """
    if names is None:
        return list(pieces("icons"))
    chosen: list[Piece] = []
    for name in filter(None, (each.strip() for each in names.split(","))):
        piece = find(f"icons/{name}") or find(name)
        if piece is None:
            raise InputError(f"there is no piece {name!r}; `shackled datasets list` lists them")
        licence_of(piece, None)
        if piece.name in [each.name for each in chosen]:
            raise InputError(f"{piece.name} is named twice")
        chosen.append(piece)
    if not chosen:
        raise InputError("there is no icon: give names with commas, such as heart,diamond")
    return chosen


def token_scene(piece: Piece) -> Scene:
    """Return the scene that a token shows: that of a piece, antialiased if a transaction has enough gas for `tokenURI`.

    antialiased.json lists these pieces; `python -m benchmarks.icons` writes it.
    """
    return evolve(piece.make(), antialias=True) if piece.name in _antialiased() else piece.make()


def scene_to_store(
    source: Path | Piece | Link, size: tuple[int, int] | None = None, max_triangles: int | Literal["all"] | None = None
) -> Scene:
    """Return the scene that is stored of a piece, a mesh or a scene file. size, max_triangles: as in `load`."""
    # a token is drawn by nodes of all kinds, of which many allow a call too little gas for antialiased meshes
    antialias = False if is_model(source) else None
    thing = (token_scene(source) if size is None else source.make()) if isinstance(source, Piece) else source
    return load(thing, size, max_triangles=max_triangles, antialias=antialias)


@cache
def _antialiased() -> frozenset[str]:
    return frozenset(json.loads(files(__package__).joinpath("antialiased.json").read_text("utf-8")))


def add_call(contract: Contract, icon: Sequence[Any], codes: Mapping[bytes, bytes]) -> Call:
    """Return the transaction that adds an icon; it writes it, and draws one pixel of its scene as a check.

    icon: arguments of `add`. codes: code of the stored scene, by address. Raises RenderError if it cannot be drawn.
    """
    local = local_chain()
    local.address(STUDIO)
    for place, code in codes.items():
        local.put(place, code)
    studio, renderer = artifact(STUDIO).interface, artifact("Renderer").interface
    reading = local.call(STUDIO, studio.encode("scene(address)", icon[1]))
    scene = studio.decode("scene(address)", reading.output)
    drawing = local.call("Renderer", renderer.encode("renderTile", scene, (0, 0, 1, 1)))
    call = contract.prepare("add", *icon)
    return replace(call, gas=call.gas + reading.gas + drawing.gas)


def check_sale(supply: int, reserve: int) -> None:
    """Raise InputError if a collection would refuse an icon of so many tokens."""
    whole(supply, "the supply of an icon", 1, (1 << 32) - 1)
    whole(reserve, "the reserve of an icon", 0, supply)


#: Licences that allow commercial use of changed copies, in lower case, with single spaces between the words.
ALLOWED_LICENCES = re.compile(
    r"my own work|own work|public domain|cc ?0( 1\.0)?( universal)?|cc by( sa)?( [1-4]\.0)?( international)?"
    r"|(the )?mit( 0)?( licen[cs]e)?|apache( licen[cs]e)?( 2(\.0)?)|0 ?bsd|bsd [0-3] clause( licen[cs]e)?"
    r"|isc( licen[cs]e)?|zlib( licen[cs]e)?|(the )?unlicense|wtfpl"
)
LICENCE_EXAMPLES = "CC0-1.0, public domain, CC-BY-4.0, CC-BY-SA-4.0, MIT, BSD-3-Clause, Apache-2.0"


def licence_of(source: Path | Piece | Link, stated: str | None) -> str:
    """Return the licence of an object that is to be stored: that of a dataset piece, or `stated` for a file.

    Raises InputError if it is not known to allow commercial use of changed copies: what is stored cannot be removed.
    """
    if isinstance(source, Piece):
        if stated is not None:
            raise InputError(f"`licence` is for files: {source.name} has the licence {source.licence}")
        if not (source.commercial and allows(source.licence)):
            raise InputError(
                f"{source.name} must not be stored: its licence ({source.licence}) is not known to allow commercial "
                "use of changed copies, and nothing can be removed from a chain"
            )
        return source.licence
    words = " ".join((stated or "").split())
    if not words:
        raise InputError(
            f"check the licence of {source} yourself, and state it with `licence`, for instance CC0-1.0 or "
            "'my own work'"
        )
    if not allows(words):
        raise InputError(
            f"{source} must not be stored under the licence {words!r}: it is not known to allow commercial use of "
            f"changed copies, as {LICENCE_EXAMPLES} do; if you made it yourself, state 'my own work'"
        )
    return words


def allows(licence: str) -> bool:
    """Return whether a licence is known to allow commercial use of changed copies."""
    return ALLOWED_LICENCES.fullmatch(re.sub(r"[\s_-]+", " ", licence.lower()).strip()) is not None
