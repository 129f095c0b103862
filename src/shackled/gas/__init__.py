"""What a picture costs: exactly, by a search over gas limits, by stage and by line, and where it fits."""

import sys

import lazy_loader

from ..base.synonyms import Package

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
sys.modules[__name__].__class__ = Package
