"""Lower antialiasing, size and triangles of a picture until one request can draw it.

The order is the one that costs the eye least for the gas that it saves, by FLIP and by the mean error against the
picture as it was asked for, at its size: see docs/gas.md and benchmarks/fitting.py.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

from attrs import evolve

from ..base.checks import choice
from ..base.values import listed
from ..chain._opening import open_chain
from ..errors import InputError, OutOfGasError
from ..ethereum._encoding import intrinsic_gas
from ..scene._codec import has_effects
from ..scene._scene import Scene
from ..scene._simplify import simplify_scene
from ._limits import ENVELOPE, MAX_TRANSACTION, Limit, floor_gas, known_chains, limits, render_call

#: What a picture is to fit, by the place whose limit it is: one transaction on Ethereum or on another chain, or a read
#: call of a node with the default settings of geth.
FITS = {"transaction": "Ethereum", "call": "geth"} | {e.id: e.name for e in known_chains() if not e.is_test}

#: Longer sides of the canvas, in pixels, down to which the size is lowered: before triangles, and after them.
SMALL, SMALLEST = 128, 64
#: Sides are multiples of this.
SIDE_STEP = 8
#: Pixels of the canvas for each triangle: triangles are lowered to that before the size goes below `SMALL`.
PIXELS = 8
#: The fewest triangles to which a mesh is lowered, and the difference of two tries.
FEWEST, TRIANGLE_STEP = 200, 0.02
#: The share of the limit that is near enough.
NEAR = 0.97

_Name = Literal["antialias", "side", "triangles"]


@dataclass(frozen=True)
class _Settings:
    """antialias: 0 or 1. side: the longer one of the canvas. triangles: of a mesh at most."""

    antialias: int
    side: int
    triangles: int


#: What is lowered, in this order, and how far.
STEPS: tuple[tuple[_Name, Callable[[_Settings], int]], ...] = (
    ("antialias", lambda _: 0),
    ("side", lambda _: SMALL),
    ("triangles", lambda now: max(FEWEST, now.side**2 // PIXELS)),
    ("side", lambda _: SMALLEST),
    ("triangles", lambda _: FEWEST),
)


#: What is left out, one after another, where nothing fits, to say what would.
EXTRAS: dict[str, Callable[[Scene], Scene]] = {
    "shadows": lambda scene: evolve(scene, lights=[evolve(each, shadow=False) for each in scene.lights]),
    "the ground": lambda scene: evolve(scene, ground=None),
    "effects of light": lambda scene: evolve(scene, hemisphere=None, rim=None, fog=None, tone=None),
    "textures": lambda scene: evolve(
        scene, objects=[evolve(o, material=evolve(o.material, texture=None)) for o in scene.objects]
    ),
}


@dataclass(frozen=True)
class Fitted:
    """A scene that fits, and a sentence that says what was done."""

    scene: Scene
    sentence: str


def fit_scene(scene: Scene, what: str, crease: float | None = None) -> Fitted:
    """Return the scene with less antialiasing, size and triangles, as far as it takes to fit one request.

    what: "transaction" (on Ethereum), "call", or the id of a chain, such as "base". crease: as in `simplify_scene`.
    Each try is a call with no more gas than the request may use, so that it never takes longer than a picture that
    fits. InputError if nothing fits.
    """
    place = FITS[choice(what, "`fit`", FITS)]
    return _Fitting(scene, next(each for each in limits() if each.place == place), crease).run()


class _Fitting:
    def __init__(self, scene: Scene, limit: Limit, crease: float | None) -> None:
        chain = open_chain()
        self._scene, self._limit, self._crease, self._chain = scene, limit, crease, chain
        self._place = f"{'one transaction on' if limit.kind == 'transaction' else 'a read call of'} {limit.place}"
        triangles = max((each.mesh.triangles for each in scene.objects), default=0)
        self._asked = _Settings(int(scene.antialias), max(scene.width, scene.height), triangles)
        self._simpler = {triangles: scene}

    def run(self) -> Fitted:
        found, least, remark = self._find()
        if found is not None:
            return self._fitted(*found)
        even = f", even {words}" if (words := self._words(least)) else ""
        raise InputError(f"nothing that is left of the picture fits {self._place}{even}{remark}{self._costs(least)}")

    def _find(self) -> tuple[tuple[_Settings, int] | None, _Settings, str]:
        """Return the first settings that fit and their gas, or None; the last that were tried; a remark on these."""
        now = self._sendable()
        if (gas := self._gas(now)) is not None:
            return (now, gas), now, ""
        remark = ""
        for name, lowest in STEPS:
            high = getattr(now, name)
            low = min(high, lowest(now))
            # scenes with effects are always antialiased
            if low == high or (name == "antialias" and has_effects(self._scene)):
                continue
            least = replace(now, **{name: low})
            try:
                gas = self._gas(least)
            except InputError as error:
                # the mesh cannot be simplified so far, or not at all here
                remark = f"; {error}"
                continue
            if gas is not None:
                return (least, gas) if name == "antialias" else self._highest(name, least, gas, high), least, remark
            now = least
        return None, now, remark

    def _costs(self, least: _Settings) -> str:
        """Return what shadows cost with the least settings, and what fits without them and without other extras."""
        said, left_out, without = "", list[str](), self
        for name, leave_out in EXTRAS.items():
            plainer = leave_out(without._scene)
            if plainer == without._scene:
                continue
            before, without = without, _Fitting(plainer, self._limit, self._crease)
            left_out.append(name)
            if name == "shadows":
                saved, for_geometry = (before._used(e) - without._used(e) for e in (least, replace(least, side=1)))
                said += f", where shadows take {saved:,} gas, {for_geometry:,} of it for geometry at any size"
            found, *_ = without._find()
            if found is not None:
                settings, gas = found
                said += f"; without {listed(left_out)}, it fits {without._words(settings) or 'as it is'} ({gas:,} gas)"
                if settings.side == self._asked.side:
                    break
        return said

    def _used(self, settings: _Settings) -> int:
        """Return the gas of a call with intrinsic gas, whatever fits."""
        data = render_call(self._scene_of(settings))
        return intrinsic_gas(data) + (self._chain.call("Renderer", data).gas or 0)

    def _highest(self, name: _Name, best: _Settings, gas: int, high: int) -> tuple[_Settings, int]:
        """Return the highest setting below `high`, which does not fit, that fits, and its gas. best: one that does."""
        power = 2 if name == "side" else 1
        step = SIDE_STEP if name == "side" else max(1, round(TRIANGLE_STEP * high))
        # gas is nearly linear in both; at first as if all of it were that of pixels or triangles: too low
        x, y = 0.0, 0.0
        while gas < NEAR * self._limit.gas:
            low: int = getattr(best, name)
            here = float(low**power)
            slope = (gas - y) / (here - x)
            guess = int((here + (self._limit.gas - gas) / slope) ** (1 / power)) if slope > 0 else high
            value = guess if guess < high else (low + high) // 2
            value = max(value // step * step, (low // step + 1) * step)
            if value >= high:
                break
            tried = replace(best, **{name: value})
            try:
                found = self._gas(tried)
            except InputError:
                found = None
            if found is None:
                high = value
            else:
                x, y = here, float(gas)
                best, gas = tried, found
        return best, gas

    def _sendable(self) -> _Settings:
        """Return the settings that were asked for, with no more triangles than a request can hold."""
        now = self._asked
        while self._limit.kind == "transaction":
            size = len(render_call(self._scene_of(now))) + ENVELOPE
            if size <= MAX_TRANSACTION:
                break
            now = replace(now, triangles=int(0.98 * now.triangles * MAX_TRANSACTION / size))
            if now.triangles < FEWEST:
                raise InputError(f"the scene is larger than what {self._place} can hold, whatever its triangles")
        return now

    def _gas(self, settings: _Settings) -> int | None:
        """Return the gas of a request with intrinsic gas; None if it does not fit."""
        data = render_call(self._scene_of(settings))
        intrinsic = intrinsic_gas(data)
        if max(intrinsic, floor_gas(data)) > self._limit.gas:
            return None
        try:
            return intrinsic + self._chain.call("Renderer", data, self._limit.gas - intrinsic).gas
        except OutOfGasError:
            return None

    def _scene_of(self, settings: _Settings) -> Scene:
        if settings.triangles not in self._simpler:
            self._simpler[settings.triangles] = simplify_scene(self._scene, settings.triangles, self._crease)
        width, height = self._size(settings)
        return evolve(self._simpler[settings.triangles], antialias=bool(settings.antialias), width=width, height=height)

    def _size(self, settings: _Settings) -> tuple[int, int]:
        share = settings.side / self._asked.side
        return max(1, round(share * self._scene.width)), max(1, round(share * self._scene.height))

    def _fitted(self, settings: _Settings, gas: int) -> Fitted:
        words = self._words(settings)
        used = f"{gas:,} of {self._limit.gas:,} gas"
        how = f"to fit {self._place}, the picture is drawn {words}" if words else f"the picture fits {self._place}"
        return Fitted(self._scene_of(settings), f"{how}: {used}")

    def _words(self, settings: _Settings) -> str:
        """Return how a picture is drawn, where that is not as it was asked for."""
        width, height = self._size(settings)
        scenes = (self._scene_of(settings), self._scene)
        now, was = (sum(each.mesh.triangles for each in scene.objects) for scene in scenes)
        words = []
        if settings.antialias != self._asked.antialias:
            words.append("without antialiasing")
        if settings.side != self._asked.side:
            words.append(f"at {width} x {height} instead of {self._scene.width} x {self._scene.height} pixels")
        if now != was:
            words.append(f"with {now:,} of {was:,} triangles")
        return listed(words) if words else ""
