"""Shackled Genesis: 1024 pieces of an on-chain generator. Every seed of 32 bytes gives a piece."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
