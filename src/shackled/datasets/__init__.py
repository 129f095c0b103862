"""Datasets: scenes that come with the package, and third-party models that are downloaded on request."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
