from ._backends import Backend, ChainBackend
from ._cluster import ClusterBackend
from ._job import render_frames
from ._scheduler import Listener, Outline
from ._store import folder_of, remove_parts
from ._tiles import is_large

__all__ = [
    "Backend",
    "ChainBackend",
    "ClusterBackend",
    "Listener",
    "Outline",
    "folder_of",
    "is_large",
    "remove_parts",
    "render_frames",
]
