from ._collection import find, pieces
from ._drawing import draw_showcase

__all__ = [
    "draw_showcase",
    "find",
    "pieces",
]
