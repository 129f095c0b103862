"""Whether a picture is right: what the contracts draw, pixel by pixel, against the range in which it may lie."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, fields

import numpy as np
from numpy.typing import NDArray

from pictures import Pixels, call_data
from pictures import draw as drawn_by_contracts
from shackled import Scene
from shackled.parallel._tiles import grid
from shackled.scene._codec import Rectangle
from shackled.scene._in_range import in_range

from .composition import Picture, render

Array = NDArray[np.float64]

#: Levels by which no pixel may be off, and by which few interior ones may be: one in so many.
MOST, MANY, FEW = 8.0, 4.0, 10_000
#: The mean error of a channel of an interior pixel, over a run.
MEAN = 0.35
#: The same in a scene, and one in so many pixels of any kind that may be off by more than MANY levels there.
MEAN_OF_SCENE, SHARE = 0.6, 1_000
#: One in so many pixels may have a colour that only a rule explains.
RARE = {"slivers": 1_000, "backs": 100, "fans": 10_000, "wires": 1_000, "wholes": 500}
#: Interior pixels of a run for which these shares hold; of fewer, one may be too many.
LEAST_RUN = 100_000
#: Faults of a scene that are described.
SHOWN = 3


@dataclass(frozen=True)
class Verdict:
    """The pixels of a scene, or of many together.

    scenes: how many. lit: pixels that show anything. interior: those that, as their neighbours, show one triangle
    without steps. many, far: of these, those off by more than MANY and MOST levels. worst, error: the largest of their
    errors, and the sum of those of all channels. outside: other pixels that are more than MOST levels outside of their
    range. off: pixels of either sort that are so by more than MANY levels. explained: those that are not with one of
    the RULES. faults: what is wrong, in words.
    """

    scenes: int = 0
    lit: int = 0
    interior: int = 0
    many: int = 0
    far: int = 0
    worst: float = 0.0
    error: float = 0.0
    outside: int = 0
    off: int = 0
    explained: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)

    def __add__(self, other: Verdict) -> Verdict:
        sums = {each.name: getattr(self, each.name) + getattr(other, each.name) for each in fields(self)}
        return Verdict(**sums | {"worst": max(self.worst, other.worst)})

    @property
    def mean(self) -> float:
        """The mean error of a channel of an interior pixel."""
        return self.error / max(3 * self.interior, 1)

    @property
    def is_near(self) -> bool:
        """Whether a picture is right with closer bounds: those that a few hundred pixels can be held to."""
        return not self.faults and self.mean <= MEAN_OF_SCENE and SHARE * self.off <= max(self.lit, SHARE)

    def faults_of_run(self) -> list[str]:
        """Return what is out of the bounds that hold for many pixels together, of which LEAST_RUN are inner ones."""
        found = []
        if self.many * FEW > self.interior:
            found.append(f"{self.many} of {self.interior} interior pixels are off by more than {MANY:g} levels")
        if self.mean > MEAN:
            found.append(f"the mean error of interior pixels is {self.mean:.3f} levels")
        for rule, few in RARE.items():
            if self.explained[rule] * few > self.lit:
                found.append(f"{self.explained[rule]} of {self.lit} pixels are explained by the rule {rule!r} only")
        return found


def table(rows: dict[str, Verdict], rules: Iterable[str] = RARE) -> str:
    """Return the counts as a table in Markdown, a line for each row."""
    heads = ["", "scenes", "lit pixels", "interior", "mean error", "> 4", "> 8", "worst", "others outside", *rules]
    lines = [" | ".join(heads), "---|" * (len(heads) - 1) + "---"]
    for name, r in rows.items():
        counts = f"{r.scenes:,} | {r.lit:,} | {r.interior:,} | {r.mean:.3f} | {r.many:,} | {r.far:,} | {r.worst:.1f}"
        lines.append(" | ".join([name, counts, f"{r.outside:,}", *(f"{r.explained[rule]:,}" for rule in rules)]))
    return "\n".join(f"| {line} |" if line[0] != "-" else f"|{line}|" for line in lines)


def report(results: Iterable[tuple[str, Verdict]], rules: Iterable[str] = RARE) -> tuple[Verdict, bool]:
    """Print faults, each when it is known, and the table of rows; return the sum, and whether all is right."""
    rows: dict[str, Verdict] = {}
    for row, verdict in results:
        rows[row] = rows.get(row, Verdict()) + verdict
        for fault in verdict.faults:
            print(fault, flush=True)
    whole = sum(rows.values(), Verdict())
    print(table(rows | {"all": whole}, rules))
    # nothing is promised for numbers of wild scenes
    of_run = [] if "wild" in rows or whole.interior < LEAST_RUN else whole.faults_of_run()
    for fault in of_run:
        print(fault)
    return whole, not whole.faults and not of_run


def judge(name: str, scene: Scene, draw: Callable[[Scene], Pixels] = drawn_by_contracts) -> Verdict:
    """Draw a scene and judge its picture."""
    scene = in_range(scene)
    return judge_pixels(name, draw(scene), render(call_data("render", scene)))


def judge_pixels(name: str, drawn: Pixels, right: Picture) -> Verdict:
    """Judge the pixels (H, W, 3) of a picture; `name` begins its faults."""
    inner = right.interior
    error = np.abs(drawn - right.exact)
    strict = outside(drawn, right.low, right.high)
    largest = np.where(inner, error.max(axis=2), strict)
    bound = np.where(inner, MANY, MOST)
    explained: Counter[str] = Counter()
    for rule, (low, high) in right.explained.items():
        wide = outside(drawn, low, high)
        found = (largest > bound) & (wide <= bound) & (wide < strict)
        explained[rule] = int(found.sum())
        largest[found] = 0
    wrong = largest > MOST
    places = np.argwhere(wrong)
    order = np.argsort(-largest[wrong])
    faults = [_fault(name, len(places), drawn, right, *places[i]) for i in order[:SHOWN]]
    return Verdict(
        scenes=1,
        lit=int(right.lit.sum()),
        interior=int(inner.sum()),
        many=int((largest[inner] > MANY).sum()),
        far=int((wrong & inner).sum()),
        worst=float(largest[inner].max(initial=0.0)),
        error=float(error[inner].sum()),
        outside=int((wrong & ~inner).sum()),
        off=int((largest > MANY).sum()),
        explained=explained,
        faults=faults,
    )


def outside(drawn: Pixels, low: Array, high: Array) -> Array:
    """Return how far pixels are outside of their ranges, (H, W), rounded."""
    return np.asarray(np.maximum(0, np.maximum(drawn - high, low - drawn) - 0.5).max(axis=2))


def draw_in_tiles(scene: Scene) -> Pixels:
    """Draw a scene in four to six tiles."""
    picture = np.empty((scene.height, scene.width, 3), np.uint8)
    for x, y, width, height in grid(scene.width, scene.height, (scene.width + 1) // 2, (scene.height + 1) // 3 + 1):
        picture[y : y + height, x : x + width] = drawn_by_contracts(scene, Rectangle(x, y, width, height))
    return picture


def _fault(name: str, count: int, drawn: Pixels, right: Picture, row: int, column: int) -> str:
    low, high = right.low[row, column].round(1).tolist(), right.high[row, column].round(1).tolist()
    where = "interior" if right.interior[row, column] else "edge"
    return (
        f"{name}: pixel ({column}, {row}), {where}, is {tuple(drawn[row, column].tolist())}, right "
        f"{tuple(low)} to {tuple(high)}; {count} are wrong"
    )
