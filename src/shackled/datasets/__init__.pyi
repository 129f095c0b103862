from ._drawing import PieceCost, cache_folder, cost, draw_all, keep, page, sheet
from ._pieces import DATASETS, Piece, find, pieces, require
from ._teapot import teapot

__all__ = [
    "DATASETS",
    "Piece",
    "PieceCost",
    "cache_folder",
    "cost",
    "draw_all",
    "find",
    "keep",
    "page",
    "pieces",
    "require",
    "sheet",
    "teapot",
]
