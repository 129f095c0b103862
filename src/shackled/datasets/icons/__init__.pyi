from ._collection import find, pieces

__all__ = [
    "find",
    "pieces",
]
