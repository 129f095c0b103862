"""The collections that there are."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Kind:
    """One of them.

    name: as it is typed. title: as the contract says it. contract: its artifact.
    hidden: whether tokens are minted without a picture, and revealed later.
    terms: which numbers of an offer its constructor takes, before those that all collections have.
    """

    name: str
    title: str
    contract: str
    hidden: bool
    terms: tuple[str, ...]


KINDS = {
    "genesis": Kind("genesis", "Shackled Genesis", "GenesisCollection", hidden=True, terms=("price", "reserve")),
    "icons": Kind("icons", "Shackled Icons", "IconsCollection", hidden=False, terms=()),
}
