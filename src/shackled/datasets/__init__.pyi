from ._drawing import SIZE, VARIABLE, PieceCost, cache_folder, cost, draw, draw_all, keep, table
from ._find import DATASETS, find, pieces, require
from ._gallery import page, sheet
from ._piece import Piece
from ._teapot import patches, teapot

__all__ = [
    "DATASETS",
    "SIZE",
    "VARIABLE",
    "Piece",
    "PieceCost",
    "cache_folder",
    "cost",
    "draw",
    "draw_all",
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
