from ._files import make_apng, make_glb
from ._storage import ANIMATE, STUDIO, StoreTransaction, store_scene, stored_codes

__all__ = [
    "ANIMATE",
    "STUDIO",
    "StoreTransaction",
    "make_apng",
    "make_glb",
    "store_scene",
    "stored_codes",
]
