"""Make a world with the collections deployed, for each test."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from functools import cache

from attrs import evolve

from shackled import Scene
from shackled.artifacts import artifact
from shackled.datasets import icons
from shackled.studio import store_scene as storing
from tools.tokens.world import ETHER, GAS, Contract, World, account

PRICE = ETHER // 20
RESERVE = 24
LIMIT = 10
CLOSED, ALLOW_LIST, PUBLIC = range(3)

#: Two small icons: name, supply, reserve, price.
ICONS = {"icons/lightning": ("Lightning", 12, 2, ETHER // 10), "icons/ethereum": ("Ether", 1000, 0, ETHER // 100)}


@dataclass
class Launched:
    """The contracts and accounts of a world.

    The sales are public; round 0 of Genesis begins with the first block. Each account has 1,000 ether.
    """

    world: World
    renderer: Contract
    generator: Contract
    metadata: Contract
    genesis: Contract
    studio: Contract
    icons: Contract
    owner: str
    alice: str
    bob: str

    def mint(self, quantity: int = 1, sender: str | None = None) -> list[int]:
        """Mint tokens of Genesis; return their numbers."""
        first = int(self.genesis.call("totalSupply"))
        self.genesis.send("mint", quantity, sender=sender or self.alice, value=quantity * PRICE)
        return list(range(first, first + quantity))

    def reveal(self, *rounds: int) -> None:
        """Reveal rounds, in the first block in which the contract can read the hashes that it needs."""
        blocks = [self.genesis.call("blockOf", each) for each in rounds]
        self.world.mine_to(max(*blocks, self.world.number - 257) + 257)
        self.genesis.send("reveal", list(rounds), [self.world.header(block) for block in blocks], sender=self.bob)


@cache
def _deployed(chain_id: int) -> Launched:
    world = World(chain_id)
    owner, alice, bob = (world.fund(account(name)) for name in ("owner", "alice", "bob"))
    renderer = world.deploy("Renderer", *map(world.deploy, artifact("Renderer").parts))
    generator = world.deploy("Genesis", renderer)
    encoder = world.deploy("PngEncoder")
    metadata = world.deploy("GenesisMetadata", generator, encoder)
    genesis = world.deploy("GenesisCollection", metadata, PRICE, RESERVE, (owner, LIMIT, owner, 500), sender=owner)
    genesis.send("setPhase", PUBLIC, sender=owner)
    turntable = world.deploy("Turntable", renderer, encoder)
    studio = world.deploy("Studio", renderer, encoder, turntable, world.deploy("GlbEncoder"))
    collection = world.deploy("IconsCollection", studio, (owner, LIMIT, owner, 500), sender=owner)
    for name, (title, supply, reserve, price) in ICONS.items():
        pointer = store_scene(studio, icon_scene(name))
        collection.send("add", title, pointer, 4, price, supply, reserve, sender=owner)
    collection.send("seal", sender=owner)
    collection.send("setPhase", PUBLIC, sender=owner)
    return Launched(world, renderer, generator, metadata, genesis, studio, collection, owner, alice, bob)


def icon_scene(name: str) -> Scene:
    """Return the scene of an icon, 128 x 128 pixels."""
    (piece,) = (each for each in icons.pieces() if each.name == name)
    return evolve(piece.make(), width=128, height=128)


def store_scene(studio: Contract, scene: Scene) -> str:
    """Store a scene in the Studio as the commands do; return its pointer."""
    transactions = storing(scene, bytes.fromhex(studio.address[2:]))
    for each in transactions:
        studio.world.run(account("owner"), studio.address, each.data, 0, GAS, True, studio.abi)
    return "0x" + transactions[-1].pointer.hex()


def launched(chain_id: int = 1) -> Launched:
    """Return the contracts, newly deployed."""
    return copy.deepcopy(_deployed(chain_id))
