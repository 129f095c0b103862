"""The common objects: built-in pieces, and models that are downloaded on request."""

from __future__ import annotations

from .. import Piece
from . import _models as models
from . import builtin


def pieces() -> list[Piece]:
    """Return all pieces, the built-in ones first."""
    return [*builtin.pieces(), *models.pieces()]


def find(name: str) -> Piece | None:
    """Return the piece of that name, or None."""
    known = models.models()
    if name in known:
        return known[name].piece()
    return next((piece for piece in builtin.pieces() if piece.name == name), None)
