from ._cache import VARIABLE, cache_folder, keep
from ._costs import Cost, cost, table
from ._drawing import SIZE, draw, draw_all
from ._find import DATASETS, find, pieces, require
from ._gallery import page, sheet
from ._piece import Piece
from ._teapot import patches, teapot

__all__ = [
    "DATASETS",
    "SIZE",
    "VARIABLE",
    "Cost",
    "Piece",
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
