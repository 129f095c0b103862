"""Views of tokens, read from their `tokenURI`, and a page and a JSON file that show them with a table of gas costs."""

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

from ..chain import Report, read_all
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


@dataclass(frozen=True)
class ActionCost:
    """The gas of an action: of a transaction all of it, of a read the execution alone.

    original: gas of the same action in the Shackled contracts of 2021; None if it is unknown.
    """

    name: str
    gas: int
    original: int | None = None


#: Gas of actions in the contracts of 2021; that of `tokenURI` from the lowest to the highest.
ORIGINAL_MINT_1, ORIGINAL_MINT_5 = 124_000, 712_000
ORIGINAL_TOKEN_URI = (5_700_000_000, 14_400_000_000)


def comparison(costs: Sequence[ActionCost]) -> list[tuple[str, str, str, str]]:
    """Return the rows of a table, heading first: action, gas, gas of the original, ratio."""
    rows = [("action", "gas", "original", "times less")]
    for cost in costs:
        original, times = "-", "-"
        if cost.original is not None:
            ratio = cost.original / cost.gas
            original, times = _rounded_gas(cost.original), f"{ratio:,.{1 if ratio < 20 else 0}f}"
        rows.append((cost.name, f"{cost.gas:,}", original, times))
    return rows


def _rounded_gas(gas: int) -> str:
    """Write gas in thousands or millions."""
    return f"{gas / 1e6:,.0f} M" if gas >= 10_000_000 else f"{gas / 1e3:,.0f} k"


def tokens_json(tokens: Sequence[TokenView]) -> str:
    """Return a JSON list of the tokens, one per line."""
    return "[\n" + ",\n".join(json.dumps(token.document(), ensure_ascii=False) for token in tokens) + "\n]\n"


def page(
    title: str,
    introduction: str,
    tokens: Sequence[TokenView],
    facts: Sequence[tuple[str, str]],
    costs: Sequence[ActionCost],
) -> str:
    """Return an HTML page with the tokens of each collection and a table of costs."""
    collections = list(dict.fromkeys(token.collection for token in tokens))
    links = [(f"c{number}", name) for number, name in enumerate(collections)]
    sections = [_section(place, name, [token for token in tokens if token.collection == name]) for place, name in links]
    if costs:
        links.append(("gas", "Gas"))
        sections.append(_table(costs))
    return Template(files(__package__).joinpath("gallery.html").read_text("utf-8")).substitute(
        title=escape(title),
        introduction=escape(introduction),
        facts="\n".join(f"<div><dt>{escape(name)}</dt><dd>{escape(value)}</dd></div>" for name, value in facts),
        links="\n".join(f'<a href="#{place}">{escape(name)}</a>' for place, name in links),
        sections="\n".join(sections),
    )


def _section(place: str, name: str, tokens: Sequence[TokenView]) -> str:
    address = escape(tokens[0].address)
    cards = "\n".join(_card(token) for token in tokens)
    count = f"{len(tokens)} token" + "s" * (len(tokens) != 1)
    return (
        f'<section id="{place}"><h2>{escape(name)}</h2><p>{count} of <code>{address}</code></p>'
        f'<div class="wall">\n{cards}\n</div></section>'
    )


def _card(token: TokenView) -> str:
    metadata = token.metadata
    data = base64.b64encode(metadata.picture).decode()
    traits = "".join(f"<dt>{escape(key)}</dt><dd>{escape(str(value))}</dd>" for key, value in metadata.traits.items())
    words = " ".join([metadata.name, token.owner, *(f"{key} {value}" for key, value in metadata.traits.items())])
    gas = "" if token.gas is None else f'<span class="gas number">{token.gas / 1e6:.2f} M gas</span>'
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


def _table(costs: Sequence[ActionCost]) -> str:
    head, *rows = comparison(costs)
    titles = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    lines = "\n".join(
        "<tr>" + "".join(f"<td>{escape(cell.removeprefix('-'))}</td>" for cell in row) + "</tr>" for row in rows
    )
    return (
        '<section id="gas"><h2>Gas</h2><p>Of transactions all that was paid, of reads the execution alone. '
        "Original: the Shackled contracts of 2021.</p>"
        f'<div class="scroll"><table><thead><tr>{titles}</tr></thead><tbody>\n{lines}\n</tbody></table></div></section>'
    )
