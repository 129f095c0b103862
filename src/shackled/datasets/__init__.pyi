from ._drawing import SIZE, VARIABLE, PieceCost, Thumbnail, cache_folder, cost, draw, draw_all, keep, table
from ._find import DATASETS, find, pieces, require
from ._gallery import figures, page, sheet
from ._piece import Piece
from ._teapot import patches, teapot

__all__ = [
    "DATASETS",
    "SIZE",
    "VARIABLE",
    "Piece",
    "PieceCost",
    "Thumbnail",
    "cache_folder",
    "cost",
    "draw",
    "draw_all",
    "figures",
    "find",
    "keep",
    "page",
    "patches",
    "pieces",
    "require",
    "sheet",
    "table",
    "teapot",
]
