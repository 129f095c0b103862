"""All tokens of a collection, with what they say of themselves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

from ._collection import AT_ONCE, Collection, Token
from ._gallery import short
from ._metadata import Trait


@dataclass(frozen=True)
class Listed:
    """A token in a list. title: as it calls itself."""

    token: Token
    title: str
    traits: dict[str, Trait]

    def document(self) -> dict[str, Any]:
        """Return the token as JSON has it."""
        return {
            "token": self.token.number,
            "name": self.title,
            "owner": self.token.owner,
            "revealed": self.token.revealed,
            "traits": self.traits,
        }

    def row(self, columns: Sequence[str]) -> tuple[str, ...]:
        """Return the cells of a table with these columns after the first three."""
        cells = (str(self.traits.get(column, "")) for column in columns)
        return str(self.token.number), short(self.token.owner), "yes" if self.token.revealed else "no", *cells


def read_all(collection: Collection) -> Iterator[Listed]:
    """Yield the tokens in the order of their numbers; each `tokenURI` is read, several at once."""

    def read(number: int) -> Listed:
        metadata = collection.metadata(number)
        return Listed(collection.token(number), metadata.name, metadata.traits)

    with ThreadPoolExecutor(AT_ONCE) as pool:
        yield from pool.map(read, range(collection.minted()))


def trait_columns(tokens: Sequence[Listed]) -> list[str]:
    """Return the traits that tokens with a picture have, in their order."""
    return list(dict.fromkeys(key for each in tokens if each.token.revealed for key in each.traits))
