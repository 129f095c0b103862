"""Shackled Icons: small models made by code, each with its own light, pose and background."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
