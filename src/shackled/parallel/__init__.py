"""Pictures that take many calls: cut into tiles, spread over processes, nodes and machines, put together again."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
