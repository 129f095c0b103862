"""The collection of icons."""

from __future__ import annotations

from collections.abc import Iterable

from .. import Piece
from . import _chains as chains
from . import _faces as faces
from . import _treasure as treasure
from . import _world as world

ICONS = (
    chains.ethereum,
    chains.coin,
    chains.chain,
    chains.shackle,
    chains.padlock,
    chains.key,
    chains.block,
    treasure.diamond,
    treasure.crystals,
    treasure.crown,
    treasure.trophy,
    treasure.sword,
    treasure.hourglass,
    treasure.bell,
    faces.skull,
    faces.head,
    faces.glasses,
    faces.cat,
    faces.robot,
    world.heart,
    world.lightning,
    world.mushroom,
    world.cactus,
    world.rocket,
    world.planet,
    world.saucer,
    world.die,
    chains.candles,
)


def pieces() -> Iterable[Piece]:
    """Return all icons."""
    return [icon.piece() for icon in ICONS]


def find(name: str) -> Piece | None:
    """Return the icon of that name, without the name of the dataset, such as "diamond"; None if there is none."""
    return next((icon.piece() for icon in ICONS if icon.name == name), None)
