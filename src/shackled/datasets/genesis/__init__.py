"""Shackled Genesis: 1024 pieces from a generator that runs in a contract. Every seed of 32 bytes is a piece."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
