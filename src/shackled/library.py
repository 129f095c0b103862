"""The items of the library: their contents, and the addresses at which the Studio stores them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache

import numpy as np

from .base.checks import Ints
from .datasets._pieces import pieces
from .datasets.common._models import models
from .deploy._contract import deployments
from .errors import InputError
from .scene._in_range import in_range
from .scene._object import Material
from .scene._scene import Scene
from .studio._storage import STUDIO, StoreTransaction, store_scene
from .tokens._icons import token_scene

#: Built-in pieces that are not one solid object, or not an object of which scenes are made.
LEFT_OUT = {"cornell-box", "first-render", "wireframe-cube", "wireframe-icosphere"}


@dataclass(frozen=True, eq=False)
class Item:
    """A model of the library.

    name: in the library. piece: of the dataset. scene: that is stored. transactions: that store its meshes, then the
    scene. materials: of each mesh. low, high: the bounds of all meshes together, (3,) int64.
    """

    name: str
    piece: str
    scene: Scene
    transactions: tuple[StoreTransaction, ...]
    materials: tuple[Material, ...]
    low: Ints
    high: Ints

    @property
    def is_icon(self) -> bool:
        """Whether it is an icon."""
        return self.piece.startswith("icons/")

    @property
    def pointer(self) -> bytes:
        """Address of the scene."""
        return self.transactions[-1].pointer

    @property
    def meshes(self) -> list[bytes]:
        """Addresses of the meshes."""
        return [each.pointer for each in self.transactions[:-1]]

    @property
    def gas(self) -> int:
        """Gas of the transactions that store it."""
        return sum(each.gas for each in self.transactions)

    @property
    def size(self) -> int:
        """Number of stored bytes."""
        return sum(each.size for each in self.transactions)


@cache
def items() -> tuple[Item, ...]:
    """Return all items, icons first; it takes some seconds."""
    studio = deployments([STUDIO])[-1].address
    fetched = set(models())
    found = [*pieces("icons"), *(piece for piece in pieces("common") if piece.name not in fetched | LEFT_OUT)]
    return tuple(_item(piece.name, token_scene(piece), studio) for piece in found)


def chosen_items(names: Iterable[str]) -> list[Item]:
    """Return items by name; all if no name is given. InputError for a name that is not in the library."""
    known = {each.name: each for each in items()}
    wanted = list(dict.fromkeys(names))
    for name in wanted:
        if name not in known:
            raise InputError(f"there is no {name!r} in the library; its items are {', '.join(known)}")
    return [known[name] for name in wanted] or list(known.values())


def _item(piece: str, scene: Scene, studio: bytes) -> Item:
    transactions = store_scene(scene, studio)
    fitted = in_range(scene).objects
    # so that one box holds all meshes as they are
    assert all(np.array_equal(each.position, fitted[0].position) and each.scale == fitted[0].scale for each in fitted)
    points = np.concatenate([each.mesh.positions for each in fitted])
    assert len(transactions) == len(fitted) + 1, f"{piece} has parts, or two objects of one mesh"
    return Item(
        name=piece.rpartition("/")[2],
        piece=piece,
        scene=scene,
        transactions=tuple(transactions),
        materials=tuple(each.material for each in fitted),
        low=np.floor(points.min(axis=0)).astype(np.int64),
        high=np.ceil(points.max(axis=0)).astype(np.int64),
    )
