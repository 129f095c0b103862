from ._compact_mesh import COMPACT, compact, split_mesh
from ._files import ContractFile, make_apng, make_glb
from ._reading import expand_zeros, stored_codes, stored_meshes
from ._storage import (
    ANIMATE,
    SCENE,
    STUDIO,
    StoreTransaction,
    compress_zeros,
    encode_with_pointers,
    quantize,
    scene_struct,
    storage_address,
    store_mesh,
    store_scene,
)

__all__ = [
    "ANIMATE",
    "COMPACT",
    "SCENE",
    "STUDIO",
    "ContractFile",
    "StoreTransaction",
    "compact",
    "compress_zeros",
    "encode_with_pointers",
    "expand_zeros",
    "make_apng",
    "make_glb",
    "quantize",
    "scene_struct",
    "split_mesh",
    "storage_address",
    "store_mesh",
    "store_scene",
    "stored_codes",
    "stored_meshes",
]
