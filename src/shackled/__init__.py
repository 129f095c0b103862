"""A 3D renderer whose every computation runs inside Ethereum smart contracts."""

from importlib import import_module
from importlib.util import find_spec
from typing import Any

import lazy_loader

from .base.synonyms import HINTS

_attribute, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> Any:
    """Import what is named, also a package such as `shackled.gas`; say what there is in place of what there is not."""
    if name not in __all__:
        if not name.startswith("_") and find_spec(f"{__name__}.{name}"):
            return import_module(f".{name}", __name__)
        if name in HINTS:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}; {HINTS[name]}", name=name)
    return _attribute(name)
