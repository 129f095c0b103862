from ._icons import pieces

__all__ = [
    "pieces",
]
