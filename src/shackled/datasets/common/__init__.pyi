from ._fetch import fetch, take
from ._models import find, model, models, pieces

__all__ = [
    "fetch",
    "find",
    "model",
    "models",
    "pieces",
    "take",
]
