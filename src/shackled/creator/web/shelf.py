"""The objects to choose from, as HTML; their pictures are made by the contracts when they come into sight."""

from __future__ import annotations

from functools import cache
from itertools import islice
from urllib.parse import quote

from markupsafe import Markup

from ...datasets import Piece, find, pieces
from .elements import drawing, mark, push

#: Pieces of Genesis that are shown; the others are had by their number or seed.
GENESIS = 36

SHELVES = (("icons", "Icons"), ("common", "Objects"), ("genesis", "Genesis"))
ACCEPTED = ".obj,.mtl,.ply,.stl,.glb,.gltf,.bin,.off,.zip,.json,.toml"


@cache
def shelf() -> Markup:
    """A file, a search, and the shelves."""
    open_ = mark("span", "Open", mark("span", " or drop", class_="drop"), " a file")
    return Markup("").join(
        (
            mark("label", drawing("open"), open_, class_="button", for_="file"),
            mark(
                "input",
                class_="unseen",
                type="file",
                id="file",
                multiple=True,
                aria_label="Open a mesh or scene file",
                accept=ACCEPTED,
            ),
            mark(
                "input",
                class_="field",
                data_search="",
                type="search",
                autocomplete="off",
                spellcheck="false",
                placeholder="Search, or a Genesis seed",
                aria_label="Search the objects, or paste a Genesis seed and press Enter",
            ),
            mark(
                "div",
                *(_tab(name, title, number == 0) for number, (name, title) in enumerate(SHELVES)),
                class_="tabs",
                role="group",
                aria_label="Shelves",
            ),
            *(_shelf(name, title, number == 0) for number, (name, title) in enumerate(SHELVES)),
            mark(
                "p",
                "Nothing of that name. Drop a file anywhere on the page, or paste a seed.",
                class_="quiet",
                id="shelf-none",
                hidden=True,
            ),
        )
    )


def on_shelf(name: str) -> list[Piece]:
    """The pieces on a shelf; those that have to be fetched first are left out."""
    return [piece for piece in islice(pieces(name), GENESIS if name == "genesis" else None) if piece.ready()]


def has_thumbnail(name: str) -> bool:
    """Whether it is a piece of which a picture may be asked."""
    piece = find(name) if len(name) <= 40 else None
    return piece is not None and piece.ready()


def _tab(name: str, title: str, first: bool) -> Markup:
    return mark("button", title, type="button", data_tab=name, aria_pressed="true" if first else "false")


def _shelf(name: str, title: str, first: bool) -> Markup:
    items = mark("div", *map(_item, on_shelf(name)), class_="shelf-items")
    more = [push("Any of the 1,024", {"do": "any-genesis"}, drawing("dice"))] if name == "genesis" else []
    return mark("section", *more, items, data_shelf=name, aria_label=title, hidden=not first)


def _item(piece: Piece) -> Markup:
    picture = mark(
        "img",
        src=f"/thumbnail/{quote(piece.name)}.png",
        alt="",
        width=64,
        height=64,
        loading="lazy",
        decoding="async",
    )
    return mark(
        "button",
        picture,
        mark("span", piece.title),
        type="button",
        title=piece.title,
        aria_pressed="false",
        data_name=f"piece-{piece.name}",
        data_words=f"{piece.name} {piece.title}".lower(),
        data_do={"do": "piece", "name": piece.name},
    )
