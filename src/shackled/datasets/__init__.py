"""Scenes that come with the package, and models that are fetched on request.

Each dataset is a module or package with `pieces()` and `find(name)`; it is imported when it is first asked for.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
