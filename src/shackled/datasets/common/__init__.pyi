from ._clean import MAX_TRIANGLES, capped, clean, creased, placed, prepare, reduce, without_crumbs
from ._cornell_box import EYE, HEIGHT, cornell_box
from ._fetch import checksum, download, fetch, take
from ._models import Model, find, model, models, pieces

__all__ = [
    "EYE",
    "HEIGHT",
    "MAX_TRIANGLES",
    "Model",
    "capped",
    "checksum",
    "clean",
    "cornell_box",
    "creased",
    "download",
    "fetch",
    "find",
    "model",
    "models",
    "pieces",
    "placed",
    "prepare",
    "reduce",
    "take",
    "without_crumbs",
]
