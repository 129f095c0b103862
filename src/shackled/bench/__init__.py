"""The experiments of the Shackled paper on the contracts of this package, and some that it could not make.

`EXPERIMENTS` names them.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
