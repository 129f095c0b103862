"""The gas of a picture: exactly, by a search, by stage and line, and the limits within which it fits."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
