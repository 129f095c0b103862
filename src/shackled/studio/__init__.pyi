from ._files import make_apng, make_glb
from ._storage import store_scene

__all__ = [
    "make_apng",
    "make_glb",
    "store_scene",
]
