"""Storage of meshes and scenes on chain, in the contract Studio (contracts/src/studio), and files made by contracts."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
