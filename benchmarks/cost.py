"""What the scenes of the original cost now, against what they cost there and what was aimed at."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from statistics import fmean

from shackled import ChainError, Scene
from shackled.bench import call_renderer, gas, millions, original, table

from . import Section, shared

TITLE = "Cost against the original"


@dataclass(frozen=True)
class Row:
    """One figure; `more` says what belongs to it. The limits are for `gas`."""

    what: str
    gas: float
    original: float | None = None
    must: float | None = None
    aim: float | None = None
    more: str = ""

    @property
    def verdict(self) -> str:
        """Which limits are kept."""
        if self.must is None:
            return ""
        if self.gas > self.must:
            return f"missed by {self.gas / self.must - 1:.1%}"
        if self.aim is None:
            return "reached"
        return "aim" if self.gas <= self.aim else f"must; {self.gas / self.aim - 1:.1%} to the aim"


def section() -> Section:
    """The table."""
    if not shared.is_there():
        return Section(TITLE, shared.SKIPPED, {})
    from .collection_cost import rows as collection_rows

    rows = [*render_rows(), largest_row(), *collection_rows(), *uri_rows()]
    head = ["what", "original", "ours", "original / ours", "must", "aim", "reached"]
    lines = [
        [
            row.what + (f" ({row.more})" if row.more else ""),
            millions(row.original, 0),
            millions(row.gas),
            f"{row.original / row.gas:,.0f}" if row.original else "",
            millions(row.must),
            millions(row.aim),
            row.verdict,
        ]
        for row in rows
    ]
    text = (
        "Execution gas of `Renderer.render` at 128 x 128 pixels, bitmap bytes out, unless a row says otherwise. The\n"
        "original returns a data URI; it knows neither smooth normals nor point lights.\n\n"
        "lamp: a point light at (500, 800, 0); glossy: ambient 0.2, diffuse 0.7, specular 0.5, shininess 20.\n\n"
    )
    data = {row.what: {"original": row.original, "gas": row.gas, "must": row.must, "aim": row.aim} for row in rows}
    return Section(TITLE, text + table(head, lines), data)


def render_rows() -> list[Row]:
    """The rows of pictures."""
    scenes, known = shared.table_scenes(), original()
    objects, pieces = shared.objects(), shared.genesis()

    def mean(names: Iterable[str], suffix: str = "") -> float:
        return fmean(gas(scenes[name + suffix]) for name in names)

    lamp = shared.QUAD + shared.LAMP_SUFFIX
    smooth = "same, smooth normals, lamp"
    return [
        Row(
            f"mean of the {len(objects)} obj_*_cull, lit as they say",
            mean(objects),
            fmean(known[name].gas for name in objects),
            must=4.4e6,
            aim=3.8e6,
        ),
        Row("same, unlit", mean(objects, shared.UNLIT_SUFFIX), must=2.75e6, aim=2.45e6),
        Row(f"{smooth}, glossy", mean(objects, shared.SMOOTH_SUFFIX), must=7.7e6, aim=5.9e6),
        Row(f"{smooth}, coefficients of each scene", mean(objects, shared.OWN_SUFFIX), must=9.5e6, aim=6.5e6),
        Row(
            f"mean of {pieces[0]}..{pieces[-1][-3:]}",
            mean(pieces),
            fmean(known[name].gas for name in pieces),
            must=1.9e6,
            aim=1.65e6,
        ),
        Row(shared.CUBE, gas(scenes[shared.CUBE]), known[shared.CUBE].gas, must=2.3e6, aim=1.5e6),
        Row(
            f"{shared.QUAD}, glossy, point light at (0, 0, -1500)",
            gas(scenes[lamp]),
            known[shared.QUAD].gas,
            must=9.0e6,
            aim=6.3e6,
        ),
        Row(
            f"{shared.LARGE_CUBE}, 512 x 512",
            gas(scenes[shared.LARGE_CUBE]),
            known[shared.LARGE_CUBE].gas,
            must=27e6,
            aim=18e6,
        ),
    ]


def uri_rows() -> list[Row]:
    """What a data URI costs more than the bytes."""
    scenes = {name: scene for name, scene in shared.table_scenes().items() if is_usual(scene)}
    more = {name: gas(scene, "renderDataURI") - gas(scene) for name, scene in scenes.items()}
    worst = max(more, key=more.__getitem__)
    return [
        Row(
            "data URI instead of bytes, more than the above, mean",
            fmean(more.values()),
            must=0.8e6,
            aim=0.35e6,
            more=f"{len(more)} pictures",
        ),
        Row("the same, largest", more[worst], must=0.8e6, aim=0.35e6, more=worst),
    ]


def largest_row() -> Row:
    """The dearest transaction of all scenes, as they are and as this table changes them."""
    costs, refused = {}, 0
    for name, scene in (shared.all_scenes() | shared.table_scenes()).items():
        if is_usual(scene):
            try:
                result = call_renderer(scene)
            except ChainError:
                refused += 1
            else:
                costs[name] = result.gas + result.intrinsic_gas
    worst = max(costs, key=costs.__getitem__)
    more = f"{worst}; of {len(costs)}" + (f", {refused} refused" if refused else "")
    return Row("largest of all scenes at 128 x 128 with intrinsic gas", costs[worst], must=14e6, aim=12e6, more=more)


def is_usual(scene: Scene) -> bool:
    """Whether the canvas has 128 x 128 pixels."""
    return (scene.width, scene.height) == (128, 128)
