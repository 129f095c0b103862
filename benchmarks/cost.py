"""Compare the cost of the original's scenes with the original and with the limits set for this renderer."""

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
    from .collection_cost import rows as collection_rows

    rows = [*render_rows(), largest_row(), *collection_rows(), *uri_rows()]
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
    smooth = "same, smooth normals, lamp"
    return [
        Row(
            f"mean of the {len(objects)} obj_*_cull, lit as they say",
            mean(objects),
            fmean(known[name].gas for name in objects),
            required=4.4e6,
            target=3.8e6,
        ),
        Row("same, unlit", mean(objects, shared.UNLIT_SUFFIX), required=2.75e6, target=2.45e6),
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
                costs[name] = result.gas + result.intrinsic_gas
    worst = max(costs, key=costs.__getitem__)
    more = f"{worst}; of {len(costs)}" + (f", {refused} refused" if refused else "")
    return Row(
        "largest of all scenes at 128 x 128 with intrinsic gas", costs[worst], required=14e6, target=12e6, more=more
    )


def is_usual(scene: Scene) -> bool:
    """Return whether the canvas has 128 x 128 pixels."""
    return (scene.width, scene.height) == (128, 128)
