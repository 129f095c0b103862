from ._drawing import draw_showcase
from ._scenes import pieces

__all__ = [
    "draw_showcase",
    "pieces",
]
