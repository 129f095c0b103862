"""Chains on which the contracts run: an EVM in this process, or a node."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
