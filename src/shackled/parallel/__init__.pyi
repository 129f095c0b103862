from ._backends import Backend, ChainBackend, Part, ThreadBackend, Verifier, draw_part, limited
from ._cluster import ClusterBackend
from ._counter import Counter, strips
from ._estimate import estimate, is_large
from ._job import COMPARED_GAS, choose_verifier, plan, render_frames
from ._scheduler import FAILURES, Listener, Outline, Scheduler
from ._store import PLAN, PartStore, folder_of, remove_parts
from ._tiles import SMALLEST, area, covers, cut, grid, halves

__all__ = [
    "COMPARED_GAS",
    "FAILURES",
    "PLAN",
    "SMALLEST",
    "Backend",
    "ChainBackend",
    "ClusterBackend",
    "Counter",
    "Listener",
    "Outline",
    "Part",
    "PartStore",
    "Scheduler",
    "ThreadBackend",
    "Verifier",
    "area",
    "choose_verifier",
    "covers",
    "cut",
    "draw_part",
    "estimate",
    "folder_of",
    "grid",
    "halves",
    "is_large",
    "limited",
    "plan",
    "remove_parts",
    "render_frames",
    "strips",
]
