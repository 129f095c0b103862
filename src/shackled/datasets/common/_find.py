"""Common objects of computer graphics: shapes that a formula gives, scenes of the Shackled paper, and models of other
people that are fetched on request.
"""

from __future__ import annotations

from .. import Piece
from . import _models as models
from . import builtin


def pieces() -> list[Piece]:
    """The built-in ones first."""
    return [*builtin.pieces(), *models.pieces()]


def find(name: str) -> Piece | None:
    """The piece of that name."""
    known = models.models()
    if name in known:
        return known[name].piece()
    return next((piece for piece in builtin.pieces() if piece.name == name), None)
