"""A 3D renderer whose every computation runs inside Ethereum smart contracts."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
