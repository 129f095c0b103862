"""The transactions by which a wallet stores a scene and adds it to the collection Editions."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..artifacts import artifact
from ..chain import EmbeddedChain
from ..ethereum import checksum_address
from ..scene import Scene
from ..studio import STUDIO, store_scene
from ..tokens import EDITIONS, MAX_SCALE, EditionTerms, add_gas

#: The largest side of the picture in a `tokenURI` if that of the scene is smaller, in pixels.
SIDE = 512


@dataclass(frozen=True)
class StoreCall:
    """A transaction to the Studio. pointer: the address where `code` is afterwards. gas: of the whole transaction."""

    pointer: str
    data: bytes
    code: bytes
    gas: int


@dataclass(frozen=True)
class EditionCalls:
    """Transactions in the order in which they are sent: `storing` to the Studio, then `add` to the collection.

    terms: with the address of the scene. code: of the collection. gas: of the last transaction, as counted here.
    """

    terms: EditionTerms
    studio: str
    collection: str
    code: bytes
    storing: tuple[StoreCall, ...]
    add: bytes
    gas: int


def edition_calls(scene: Scene, terms: EditionTerms, chain: EmbeddedChain) -> EditionCalls:
    """Return the transactions. terms: without scene and scale. chain: knows the addresses of the contracts.

    InputError if the scene takes too much gas to draw, or its picture is too large; RenderError if it cannot be drawn.
    """
    studio, collection = chain.address(STUDIO), chain.address(EDITIONS.contract)
    storing = store_scene(scene, studio)
    scale = max(1, min(MAX_SCALE, SIDE // max(scene.width, scene.height)))
    terms = replace(terms, scene=checksum_address(storing[-1].pointer), scale=scale)
    gas = add_gas(terms, {each.pointer: each.code for each in storing})
    return EditionCalls(
        terms=terms,
        studio=checksum_address(studio),
        collection=checksum_address(collection),
        code=chain.code(EDITIONS.contract),
        storing=tuple(StoreCall(checksum_address(each.pointer), each.data, each.code, each.gas) for each in storing),
        add=artifact(EDITIONS.contract).interface.encode("add", *terms.arguments),
        gas=gas,
    )
