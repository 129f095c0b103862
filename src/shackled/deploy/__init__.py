"""Deployment of contracts, at the same addresses on every chain, and transactions with quoted prices."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
