"""Basics of Ethereum: hashes, addresses, the ABI, block headers, amounts of ether."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
