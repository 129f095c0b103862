from ._connection import Connection
from ._opening import open_chain, open_node

__all__ = [
    "Connection",
    "open_chain",
    "open_node",
]
