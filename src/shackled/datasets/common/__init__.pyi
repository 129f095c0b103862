from ._fetch import fetch, take
from ._models import model, models, pieces

__all__ = [
    "fetch",
    "model",
    "models",
    "pieces",
    "take",
]
