"""What a picture costs: exactly, by a search over gas limits, by stage and by line, and where it fits."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
