from ._scheduler import Listener

__all__ = [
    "Listener",
]
