"""Views of tokens, read from their `tokenURI`, and a page and a JSON file that show them."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from html import escape
from importlib.resources import files
from string import Template
from typing import Any

from ..base.values import plural
from ..chain._connection import Report, read_all
from ._collection import Collection
from ._metadata import Metadata


@dataclass(frozen=True)
class TokenView:
    """A token with its metadata. gas: of the execution of `tokenURI`; None if it was not measured."""

    collection: str
    address: str
    token: int
    owner: str
    revealed: bool
    metadata: Metadata
    gas: int | None = None

    def summary(self) -> dict[str, Any]:
        """Return number, name, owner and traits, for JSON."""
        return {
            "token": self.token,
            "name": self.metadata.name,
            "owner": self.owner,
            "revealed": self.revealed,
            "traits": self.metadata.traits,
        }

    def document(self) -> dict[str, Any]:
        """Return all properties, for JSON."""
        height, width = self.metadata.pixels.shape[:2]
        return {
            "collection": self.collection,
            "address": self.address,
            **self.summary(),
            "gas": self.gas,
            "bytes": self.metadata.length,
            "picture": {
                "type": "image/png",
                "width": width,
                "height": height,
                "bytes": len(self.metadata.picture),
                "sha256": hashlib.sha256(self.metadata.picture).hexdigest(),
            },
        }

    def row(self, traits: Sequence[str]) -> tuple[str, ...]:
        """Return cells of a table: number, owner, whether it is revealed, and these traits."""
        cells = (str(self.metadata.traits.get(trait, "")) for trait in traits)
        return str(self.token), shorten(self.owner), "yes" if self.revealed else "no", *cells


def read_view(collection: Collection, number: int, measured: bool = False) -> TokenView:
    """Read a token. Raises InputError if it does not exist. measured: also measure the gas of its `tokenURI`."""
    return TokenView(
        collection.name,
        collection.address,
        number,
        collection.owner_of(number),
        collection.is_revealed(number),
        collection.metadata(number),
        collection.contract.gas("tokenURI", number) if measured else None,
    )


def read_views(collection: Collection, report: Report | None = None) -> Iterator[TokenView]:
    """Yield all tokens in the order of their numbers; several are read concurrently."""
    yield from read_all(partial(read_view, collection), range(collection.minted()), report)


def shorten(address: str) -> str:
    """Return the first and the last digits of an address."""
    return f"{address[:6]}…{address[-4:]}"


def tokens_json(tokens: Sequence[TokenView]) -> str:
    """Return a JSON list of the tokens, one per line."""
    return "[\n" + ",\n".join(json.dumps(token.document(), ensure_ascii=False) for token in tokens) + "\n]\n"


def page(tokens: Sequence[TokenView]) -> str:
    """Return an HTML page with the tokens of each collection."""
    links, sections = [], []
    for number, name in enumerate(dict.fromkeys(token.collection for token in tokens)):
        links.append(f'<a href="#c{number}">{escape(name)}</a>')
        sections.append(_section(f"c{number}", [token for token in tokens if token.collection == name]))
    template = Template(files(__package__).joinpath("gallery.html").read_text("utf-8"))
    return template.substitute(links="\n".join(links), sections="\n".join(sections))


def _section(place: str, tokens: Sequence[TokenView]) -> str:
    name, address = escape(tokens[0].collection), escape(tokens[0].address)
    cards = "\n".join(map(_card, tokens))
    return (
        f'<section id="{place}"><h2>{name}</h2><p>{plural(len(tokens), "token")} of <code>{address}</code></p>'
        f'<div class="wall">\n{cards}\n</div></section>'
    )


def _card(token: TokenView) -> str:
    metadata = token.metadata
    data = base64.b64encode(metadata.picture).decode()
    traits = "".join(f"<dt>{escape(key)}</dt><dd>{escape(str(value))}</dd>" for key, value in metadata.traits.items())
    words = " ".join([metadata.name, token.owner, *(f"{key} {value}" for key, value in metadata.traits.items())])
    gas = f'<span class="gas number">{token.gas / 1e6:.2f} M gas</span>' if token.gas else ""
    return (
        f'<article data-words="{escape(words.lower())}">'
        f'<button class="picture" type="button" aria-label="Enlarge {escape(metadata.name)}"'
        f' data-about="{escape(metadata.description)}">'
        f'<img src="data:image/png;base64,{data}" alt="{escape(metadata.name)}"></button>'
        f'<div class="words"><div class="head"><h3>{escape(metadata.name)}</h3>{gas}</div>'
        f'<dl class="traits">{traits}</dl>'
        f'<div class="owner"><code title="{escape(token.owner)}">{escape(shorten(token.owner))}</code>'
        f'<span class="number">{metadata.length:,} bytes</span></div></div></article>'
    )
