from ._drawing import SIZE, VARIABLE, PieceCost, Thumbnail, cache_folder, cost, draw_all, keep
from ._find import DATASETS, find, pieces, require
from ._gallery import figures, page, sheet
from ._piece import Piece
from ._teapot import teapot

__all__ = [
    "DATASETS",
    "SIZE",
    "VARIABLE",
    "Piece",
    "PieceCost",
    "Thumbnail",
    "cache_folder",
    "cost",
    "draw_all",
    "figures",
    "find",
    "keep",
    "page",
    "pieces",
    "require",
    "sheet",
    "teapot",
]
