from ._pieces import Piece, find, pieces
from ._teapot import teapot

__all__ = [
    "Piece",
    "find",
    "pieces",
    "teapot",
]
