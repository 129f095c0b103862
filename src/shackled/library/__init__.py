"""The library on chain: icons and common objects by name, at the same pointers on every chain."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
