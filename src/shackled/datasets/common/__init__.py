"""Common objects of computer graphics: shapes that a formula gives, scenes of the Shackled paper, and models of other
people that are fetched on request.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
