from ._fetch import fetch
from ._models import model, models, pieces

__all__ = [
    "fetch",
    "model",
    "models",
    "pieces",
]
