"""Pictures that take many calls: cut into tiles, spread over processes, nodes and machines, put together again."""

from .job import Finished, render_frames
from .listener import Listener, Outline
from .where import Where

__all__ = ["Finished", "Listener", "Outline", "Where", "render_frames"]
