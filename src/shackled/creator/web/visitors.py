"""Everybody who has the page open."""

from __future__ import annotations

import secrets
import time

from ...errors import InputError
from ..pool import Pool
from ..scene import Facts
from ..state import State
from .visitor import Visitor

#: How many are served at once.
MOST = 500
#: Seconds that somebody who is not there is waited for.
PATIENCE = 120


class Visitors:
    """By names that nobody can guess."""

    def __init__(self, pool: Pool) -> None:
        """`pool` draws for all of them."""
        self.pool = pool
        self._all: dict[str, Visitor] = {}

    def add(self, state: State, facts: Facts) -> Visitor:
        """Somebody new. InputError if there are too many already."""
        self._forget()
        visitor = Visitor(secrets.token_urlsafe(18), self.pool, state, facts)
        self._all[visitor.name] = visitor
        return visitor

    def find(self, name: str) -> Visitor | None:
        """The visitor of that name."""
        return self._all.get(name)

    def drop(self, visitor: Visitor) -> None:
        """Forgets somebody whose page is gone, unless they are there by another way."""
        if not visitor.present:
            visitor.end()
            self._all.pop(visitor.name, None)

    def _forget(self) -> None:
        """Those who have gone for long, or whose places are needed. InputError if everybody is there."""
        now = time.monotonic()
        absent = sorted((each for each in self._all.values() if not each.present), key=lambda each: each.seen)
        for visitor in absent:
            if now - visitor.seen > PATIENCE or len(self._all) >= MOST:
                self.drop(visitor)
        if len(self._all) >= MOST:
            raise InputError(f"there are {MOST} visitors already; try again in a few minutes")
