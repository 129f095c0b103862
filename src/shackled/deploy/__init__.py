"""Contracts put on a chain, at the same addresses everywhere, and the transactions that do it."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
