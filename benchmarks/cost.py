"""Compare the cost of the original's scenes with the original and with the limits set for this renderer."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from statistics import fmean, median

import numpy as np
from tools.tokens.launched import LIMIT, PRICE, Launched, icon_scene, launched, store_scene
from tools.tokens.world import Contract

from shackled import ChainError, Scene
from shackled.artifacts import artifact
from shackled.bench._measure import call, call_renderer, gas
from shackled.bench._original import original
from shackled.bench._report import millions, table
from shackled.datasets import icons
from shackled.datasets._pieces import require
from shackled.datasets.genesis import seed_of
from shackled.ethereum._encoding import intrinsic_gas
from shackled.gas import render_call

from . import Section, shared
from .original.recipe import digests
from .studio import recorded as recorded_of_studio

TITLE = "Cost against the original"

#: Seeds of the collection of 2021.
PIECES = 1024
#: Gas of the most expensive piece and of the generation in the original, as the paper states it.
ORIGINAL_PIECE, ORIGINAL_GENERATION = 17_831e6, 40.2e6


@dataclass(frozen=True)
class Row:
    """One figure of the table.

    what: the name of the row. required, target: limits of the gas. more: the scene or the number of scenes.
    """

    what: str
    gas: float
    original: float | None = None
    required: float | None = None
    target: float | None = None
    more: str = ""

    @property
    def verdict(self) -> str:
        """Return which limits are met."""
        if self.required is None:
            return ""
        if self.gas > self.required:
            return f"{self.gas / self.required - 1:.1%} above the required"
        if self.target is None:
            return "met"
        return "target met" if self.gas <= self.target else f"{self.gas / self.target - 1:.1%} above the target"


def section() -> Section:
    """Make the table."""
    if not shared.is_there():
        return Section(TITLE, shared.SKIPPED, {})
    rows = [*render_rows(), largest_row(), *piece_rows(), *genesis_rows(), icon_row(), png_row(), *uri_rows()]
    head = ["what", "original", "ours", "original / ours", "required", "target", "result"]
    lines = [
        [
            row.what + (f" ({row.more})" if row.more else ""),
            millions(row.original, 0),
            millions(row.gas),
            f"{row.original / row.gas:,.0f}" if row.original else "",
            millions(row.required),
            millions(row.target),
            row.verdict,
        ]
        for row in rows
    ]
    text = (
        "Execution gas of `Renderer.render` at 128 x 128 pixels, bitmap bytes out, unless a row says otherwise. The\n"
        "original returns a data URI; it has neither smooth normals nor point lights.\n\n"
        "lamp: a point light at (500, 800, 0); glossy: ambient 0.2, diffuse 0.7, specular 0.5, shininess 20.\n\n"
        "Required and target are limits that this project set for its contracts; result says which of them are met.\n\n"
    )
    data = {
        row.what: {"original": row.original, "gas": row.gas, "required": row.required, "target": row.target}
        for row in rows
    }
    return Section(TITLE, text + table(head, lines), data)


def render_rows() -> list[Row]:
    """Measure pictures."""
    scenes, known = shared.table_scenes(), original()
    objects, pieces = shared.objects(), shared.genesis()

    def mean(names: Iterable[str], suffix: str = "") -> float:
        return fmean(gas(scenes[name + suffix]) for name in names)

    lamp = shared.QUAD + shared.LAMP_SUFFIX
    smooth = "all, smooth normals, lamp"
    anew = sorted(digests().keys() & set(objects))
    return [
        Row(
            f"mean of the {len(objects)} obj_*_cull, lit as they say",
            mean(objects),
            fmean(known[name].gas for name in objects),
            required=4.4e6,
            target=3.8e6,
            more=f"{len(objects) - len(anew)} of them cannot be made again",
        ),
        Row(
            f"mean of the {len(anew)} of them that `benchmarks.original.recipe` makes",
            mean(anew),
            fmean(known[name].gas for name in anew),
        ),
        Row("all, unlit", mean(objects, shared.UNLIT_SUFFIX), required=2.75e6, target=2.45e6),
        Row(f"{smooth}, glossy", mean(objects, shared.SMOOTH_SUFFIX), required=7.7e6, target=5.9e6),
        Row(f"{smooth}, coefficients of each scene", mean(objects, shared.OWN_SUFFIX), required=9.5e6, target=6.5e6),
        Row(
            f"mean of {pieces[0]}..{pieces[-1][-3:]}",
            mean(pieces),
            fmean(known[name].gas for name in pieces),
            required=1.9e6,
            target=1.65e6,
        ),
        Row(shared.CUBE, gas(scenes[shared.CUBE]), known[shared.CUBE].gas, required=2.3e6, target=1.5e6),
        Row(
            f"{shared.QUAD}, glossy, point light at (0, 0, -1500)",
            gas(scenes[lamp]),
            known[shared.QUAD].gas,
            required=9.0e6,
            target=6.3e6,
        ),
        Row(
            f"{shared.LARGE_CUBE}, 512 x 512",
            gas(scenes[shared.LARGE_CUBE]),
            known[shared.LARGE_CUBE].gas,
            required=27e6,
            target=18e6,
        ),
    ]


def uri_rows() -> list[Row]:
    """Measure what a data URI costs in addition to the bytes."""
    scenes = {name: scene for name, scene in shared.table_scenes().items() if is_usual(scene)}
    more = {name: gas(scene, "renderDataURI") - gas(scene) for name, scene in scenes.items()}
    worst = max(more, key=more.__getitem__)
    return [
        Row(
            "data URI instead of bytes, more than the above, mean",
            fmean(more.values()),
            required=0.8e6,
            target=0.35e6,
            more=f"{len(more)} pictures",
        ),
        Row("the same, largest", more[worst], required=0.8e6, target=0.35e6, more=worst),
    ]


def largest_row() -> Row:
    """Measure the most expensive transaction of all scenes, unchanged and with the materials of this table."""
    costs, refused = {}, 0
    for name, scene in (shared.all_scenes() | shared.table_scenes()).items():
        if is_usual(scene):
            try:
                result = call_renderer(scene)
            except ChainError:
                refused += 1
            else:
                costs[name] = result.gas + intrinsic_gas(render_call(scene))
    worst = max(costs, key=costs.__getitem__)
    more = f"{worst}; of {len(costs)}" + (f", {refused} refused" if refused else "")
    return Row(
        "largest of all scenes at 128 x 128 with intrinsic gas", costs[worst], required=14e6, target=12e6, more=more
    )


def is_usual(scene: Scene) -> bool:
    """Return whether the canvas has 128 x 128 pixels."""
    return (scene.width, scene.height) == (128, 128)


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
    return [
        expensive,
        Row("Genesis generation, median", median(generation), ORIGINAL_GENERATION, required=0.70e6, target=0.60e6),
    ]


def genesis_rows() -> list[Row]:
    """Measure `tokenURI` of Genesis."""
    found = genesis_uris()
    worst = int(np.argmax(found))
    return [
        Row(f"Genesis `tokenURI`, mean of {PIECES:,}", fmean(found), required=5.0e6, target=4.5e6),
        Row("Genesis `tokenURI`, most expensive", found[worst], required=12e6, target=10e6, more=f"number {worst}"),
    ]


def icon_row() -> Row:
    """Measure `tokenURI` of Icons."""
    found = icon_uris()
    worst = max(found, key=found.__getitem__)
    return Row("`tokenURI` of an icon, most expensive", found[worst], required=16.5e6, target=14e6, more=worst)


def genesis_uris() -> list[int]:
    """Return the execution gas of `GenesisMetadata.tokenURI` for each seed."""
    s = launched()
    return [s.metadata.gas_of("tokenURI", number, seed_of(number), sender=s.bob) for number in range(PIECES)]


def icon_uris() -> dict[str, int]:
    """Return the execution gas of `IconsCollection.tokenURI` by the name of the icon, enlarged four times."""
    s = launched()
    names = [piece.name for piece in icons.pieces()]
    collection = with_icons(s, names)
    return {name: collection.gas_of("tokenURI", token) for token, name in enumerate(names)}


def with_icons(s: Launched, names: list[str]) -> Contract:
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
