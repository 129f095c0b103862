"""Tokens that were read from a chain, as a page that stands alone and as JSON."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from string import Template
from typing import Any

from ._metadata import Metadata
from ._table import Cost, comparison


@dataclass(frozen=True)
class Shown:
    """A token as its `tokenURI` shows it.

    gas: of the whole `tokenURI`, execution only; None where none was counted.
    """

    collection: str
    address: str
    token: int
    owner: str
    revealed: bool
    metadata: Metadata
    gas: int | None = None

    def document(self) -> dict[str, Any]:
        """Return the token as JSON has it."""
        picture = self.metadata.picture or b""
        height, width = self.metadata.pixels.shape[:2]
        return {
            "collection": self.collection,
            "address": self.address,
            "token": self.token,
            "name": self.metadata.name,
            "owner": self.owner,
            "revealed": self.revealed,
            "traits": self.metadata.traits,
            "gas": self.gas,
            "bytes": self.metadata.length,
            "picture": {
                "type": self.metadata.media_type,
                "width": width,
                "height": height,
                "bytes": len(picture),
                "sha256": hashlib.sha256(picture).hexdigest(),
            },
        }


def tokens_json(tokens: Sequence[Shown]) -> str:
    """Return the tokens as a list of objects, one a line."""
    return "[\n" + ",\n".join(json.dumps(token.document(), ensure_ascii=False) for token in tokens) + "\n]\n"


def page(
    title: str, introduction: str, tokens: Sequence[Shown], facts: Sequence[tuple[str, str]], costs: Sequence[Cost]
) -> str:
    """Return an HTML page with the tokens, collection by collection, and a table of what was paid."""
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


def _section(place: str, name: str, tokens: Sequence[Shown]) -> str:
    address = escape(tokens[0].address)
    cards = "\n".join(_card(token) for token in tokens)
    count = f"{len(tokens)} token" + "s" * (len(tokens) != 1)
    return (
        f'<section id="{place}"><h2>{escape(name)}</h2><p>{count} of <code>{address}</code></p>'
        f'<div class="wall">\n{cards}\n</div></section>'
    )


def _card(token: Shown) -> str:
    metadata = token.metadata
    data = base64.b64encode(metadata.picture or b"").decode()
    traits = "".join(f"<dt>{escape(key)}</dt><dd>{escape(str(value))}</dd>" for key, value in metadata.traits.items())
    words = " ".join([metadata.name, token.owner, *(f"{key} {value}" for key, value in metadata.traits.items())])
    gas = "" if token.gas is None else f'<span class="gas number">{token.gas / 1e6:.2f} M gas</span>'
    return (
        f'<article data-words="{escape(words.lower())}">'
        f'<button class="picture" type="button" aria-label="Enlarge {escape(metadata.name)}"'
        f' data-about="{escape(metadata.description)}">'
        f'<img src="data:{metadata.media_type};base64,{data}" alt="{escape(metadata.name)}"></button>'
        f'<div class="words"><div class="head"><h3>{escape(metadata.name)}</h3>{gas}</div>'
        f'<dl class="traits">{traits}</dl>'
        f'<div class="owner"><code title="{escape(token.owner)}">{escape(short(token.owner))}</code>'
        f'<span class="number">{metadata.length:,} bytes</span></div></div></article>'
    )


def _table(costs: Sequence[Cost]) -> str:
    head, *rows = comparison(costs)
    titles = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    lines = "\n".join(
        "<tr>" + "".join(f"<td>{escape(cell.removeprefix('-'))}</td>" for cell in row) + "</tr>" for row in rows
    )
    return (
        '<section id="gas"><h2>Gas</h2><p>Of transactions all that was paid, of reads the execution alone. '
        "The original: the Shackled contracts of 2021.</p>"
        f'<div class="scroll"><table><thead><tr>{titles}</tr></thead><tbody>\n{lines}\n</tbody></table></div></section>'
    )


def short(address: str) -> str:
    """Return an address for people: its first and its last digits."""
    return f"{address[:6]}…{address[-4:]}"
