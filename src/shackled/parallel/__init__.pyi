from ._counter import Counter
from ._job import render_frames
from ._scheduler import Listener, Outline
from ._store import folder_of, remove_parts
from ._where import Where

__all__ = [
    "Counter",
    "Listener",
    "Outline",
    "Where",
    "folder_of",
    "remove_parts",
    "render_frames",
]
