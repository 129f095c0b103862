from ._collection import open_collection
from ._editions import editions_of, open_editions
from ._storage import SceneToStore, plan_storage, read_back, store

__all__ = [
    "SceneToStore",
    "editions_of",
    "open_collection",
    "open_editions",
    "plan_storage",
    "read_back",
    "store",
]
