"""Scenes that can be turned in a browser: pages, and widgets for notebooks, around the bundle of web/."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
