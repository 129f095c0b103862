"""Common objects of computer graphics: shapes, scenes of the Shackled paper, and models of other authors."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
