"""The experiments of the Shackled paper on the contracts of this package, and some that it could not make.

Each is a module with `run(lab) -> Report`; `EXPERIMENTS` names them in the order of the paper.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
