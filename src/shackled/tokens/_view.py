"""Views of tokens: owner, traits and picture, read from their `tokenURI`."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ..chain import Report, read_all
from ._collection import Collection, Token
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
        picture = self.metadata.picture or b""
        height, width = self.metadata.pixels.shape[:2]
        return {
            "collection": self.collection,
            "address": self.address,
            **self.summary(),
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

    def row(self, traits: Sequence[str]) -> tuple[str, ...]:
        """Return cells of a table: number, owner, whether it is revealed, and these traits."""
        cells = (str(self.metadata.traits.get(trait, "")) for trait in traits)
        return str(self.token), shorten(self.owner), "yes" if self.revealed else "no", *cells


def view_of(collection: Collection, token: Token, metadata: Metadata, gas: int | None = None) -> TokenView:
    """Return the view of a token that was read already."""
    return TokenView(collection.name, collection.address, token.number, token.owner, token.revealed, metadata, gas)


def read_view(collection: Collection, number: int) -> TokenView:
    """Read a token, and measure the gas of its `tokenURI`. Raises InputError if it does not exist."""
    token, metadata = collection.token(number), collection.metadata(number)
    return view_of(collection, token, metadata, collection.contract.gas("tokenURI", number))


def read_views(collection: Collection, report: Report | None = None) -> Iterator[TokenView]:
    """Yield all tokens in the order of their numbers; several are read concurrently."""

    def read(number: int) -> TokenView:
        metadata = collection.metadata(number)
        return view_of(collection, collection.token(number), metadata)

    yield from read_all(read, range(collection.minted()), report)


def shorten(address: str) -> str:
    """Return the first and the last digits of an address."""
    return f"{address[:6]}…{address[-4:]}"
