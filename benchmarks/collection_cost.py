"""Measure the cost of the collections: all 1,024 pieces of Genesis, all icons, PNG files."""

from __future__ import annotations

import statistics

import numpy as np
from tools.tokens.stage import LIMIT, PRICE, Stage, icon_scene, stage, store_scene
from tools.tokens.world import GAS, Contract

from shackled.artifacts import artifact
from shackled.bench import call, gas
from shackled.datasets import icons, require
from shackled.datasets.genesis import seed_of

from .cost import Row
from .studio import recorded as recorded_of_studio

#: Seeds of the collection of 2021.
PIECES = 1024
#: Gas of the most expensive piece and of the generation in the original, as the paper states it.
ORIGINAL_PIECE, ORIGINAL_GENERATION = 17_831e6, 40.2e6


def rows() -> list[Row]:
    """Measure the rows of the cost table."""
    return [*piece_rows(), *token_rows(), png_row()]


def piece_rows() -> list[Row]:
    """Measure the generation and the pictures of the pieces."""
    generate = artifact("Genesis").selectors["generate"]
    generation = [call("Genesis", generate + seed_of(number)).gas for number in range(PIECES)]
    pictures = [gas(require(f"genesis/{number}").make()) for number in range(PIECES)]
    worst = int(np.argmax(pictures))
    expensive = Row(
        f"most expensive Genesis piece of {PIECES:,}",
        pictures[worst],
        ORIGINAL_PIECE,
        required=7.5e6,
        target=6e6,
        more=f"number {worst}",
    )
    median = statistics.median(generation)
    return [expensive, Row("Genesis generation, median", median, ORIGINAL_GENERATION, required=0.70e6, target=0.60e6)]


def token_rows() -> list[Row]:
    """Measure `tokenURI` of Genesis and of Icons."""
    of_icons = icon_uris()
    icon = max(of_icons, key=of_icons.__getitem__)
    return [
        *genesis_rows(),
        Row("`tokenURI` of an icon, most expensive", of_icons[icon], required=16.5e6, target=14e6, more=icon),
    ]


def genesis_rows() -> list[Row]:
    """Measure `tokenURI` of Genesis."""
    gas = genesis_uris()
    worst = int(np.argmax(gas))
    return [
        Row(f"Genesis `tokenURI`, mean of {PIECES:,}", statistics.fmean(gas), required=5.0e6, target=4.5e6),
        Row("Genesis `tokenURI`, most expensive", gas[worst], required=12e6, target=10e6, more=f"number {worst}"),
    ]


def genesis_uris() -> list[int]:
    """Return the execution gas of `GenesisMetadata.tokenURI` for each seed."""
    s = stage()
    calls = (s.metadata.encode("tokenURI", (number, seed_of(number)))[1] for number in range(PIECES))
    return [s.world.run(s.bob, s.metadata.address, data, 0, GAS, False, []).execution for data in calls]


def icon_uris() -> dict[str, int]:
    """Return the execution gas of `IconsCollection.tokenURI` by the name of the icon, enlarged four times."""
    s = stage()
    names = [piece.name for piece in icons.pieces()]
    collection = with_icons(s, names)
    return {name: collection.gas_of("tokenURI", token) for token, name in enumerate(names)}


def with_icons(s: Stage, names: list[str]) -> Contract:
    """Deploy a collection with one token of each icon."""
    collection = s.world.deploy("IconsCollection", s.studio, (s.owner, LIMIT, s.owner, 500), sender=s.owner)
    for name in names:
        pointer = store_scene(s.studio, icon_scene(name))
        collection.send("add", name.rpartition("/")[2], pointer, 4, PRICE, 1, 1, sender=s.owner)
    collection.send("seal", sender=s.owner)
    for number in range(len(names)):
        collection.send("mintReserve", number, s.owner, 1, sender=s.owner)
    return collection


def png_row() -> Row:
    """Return what a PNG file costs in addition to its bitmap: the figure of studio.json."""
    (name,) = (name for name in recorded_of_studio() if name.startswith("PNG, Genesis, x 4") and name.endswith(": gas"))
    return Row(
        "PNG of 128 x 128 enlarged 4 times, more than BMP, mean",
        recorded_of_studio()[name],
        required=1.3e6,
        target=1.1e6,
    )
