"""Scenes that are part of the package, and models that are downloaded on request.

Each dataset is a module or package with `pieces()` and `find(name)`, imported when it is first used.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
