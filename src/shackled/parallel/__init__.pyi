from ._backends import Backend, ChainBackend, ThreadBackend, limited
from ._cluster import ClusterBackend
from ._counter import Counter
from ._estimate import is_large
from ._job import render_frames
from ._scheduler import Listener, Outline
from ._store import folder_of, remove_parts

__all__ = [
    "Backend",
    "ChainBackend",
    "ClusterBackend",
    "Counter",
    "Listener",
    "Outline",
    "ThreadBackend",
    "folder_of",
    "is_large",
    "limited",
    "remove_parts",
    "render_frames",
]
