"""What a picture is made from: meshes in their places, lights, a camera, a background."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
