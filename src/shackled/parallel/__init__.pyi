from ._cluster import ClusterPlace
from ._estimate import estimate
from ._job import COMPARED_GAS, Finished, choose_referee, plan, render_frames
from ._listener import Listener, Outline
from ._part import Part, draw_part
from ._place import ChainPlace, Place
from ._processes import ProcessPlace
from ._referee import Referee
from ._scheduler import FAILURES, Scheduler
from ._store import PLAN, Store, folder_of, remove_parts
from ._tiles import SMALLEST, area, covers, cut, grid, halves
from ._where import VERIFY, Where

__all__ = [
    "COMPARED_GAS",
    "FAILURES",
    "PLAN",
    "SMALLEST",
    "VERIFY",
    "ChainPlace",
    "ClusterPlace",
    "Finished",
    "Listener",
    "Outline",
    "Part",
    "Place",
    "ProcessPlace",
    "Referee",
    "Scheduler",
    "Store",
    "Where",
    "area",
    "choose_referee",
    "covers",
    "cut",
    "draw_part",
    "estimate",
    "folder_of",
    "grid",
    "halves",
    "plan",
    "remove_parts",
    "render_frames",
]
