"""Pages that the commands serve to the browser of their user: sockets, security headers, the browser."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
