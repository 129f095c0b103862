"""Repeat the calls that the Renderer makes of its engines, one for each run of objects.

Mirrors contracts/src/uniforms/Runs.sol and the Renderer's use of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

from ..artifacts import artifact
from ..chain import CallResult, ContractChain, returned_bytes
from ..scene import WIREFRAME, Rectangle, Scene, encode
from . import _layout as layout

#: As in Pipeline.sol.
BAND_PIXELS = 16384
#: Bytes of an answer before its pixels.
HEAD = 0x40


@dataclass(frozen=True)
class EngineCall:
    """A call of an engine, and its result."""

    engine: str
    data: bytes
    result: CallResult


@dataclass(frozen=True)
class _Object:
    number: int
    position: int
    engine: str
    is_blended: bool


def engine_calls(scene: Scene, chain: ContractChain) -> list[EngineCall]:
    """Repeat and return all calls of engines that a render makes."""
    whole = Rectangle(0, 0, scene.width, scene.height)
    data = _uniforms(scene, whole, chain)
    if len(_runs(data)) == 1 or scene.width * scene.height <= BAND_PIXELS:
        return list(_calls(data, chain))
    rows = BAND_PIXELS // scene.width
    calls: list[EngineCall] = []
    for bottom in range(scene.height, 0, -rows):
        top = max(0, bottom - rows)
        calls += _calls(_uniforms(scene, Rectangle(0, top, scene.width, bottom - top), chain), chain)
    return calls


def _uniforms(scene: Scene, tile: Rectangle, chain: ContractChain) -> bytes:
    data = encode(artifact("Renderer").selectors["engineCall"], scene, tile)
    return returned_bytes(chain.call("Renderer", data).output, 0)


def _calls(uniforms: bytes, chain: ContractChain) -> Iterator[EngineCall]:
    data, drawn, runs = bytearray(uniforms), b"", _runs(uniforms)
    invert = _load(uniforms, _place(layout.INVERT))
    for run in runs:
        is_last = run is runs[-1]
        values = {
            layout.OBJECT_COUNT: len(run),
            layout.RETURNS_DEPTHS: not is_last,
            layout.INVERT: invert if is_last else 0,
        }
        if run:
            values |= {layout.OBJECTS: run[0].position, layout.OBJECT_FIRST: run[0].number}
        if drawn:
            values[layout.DRAWN_BEFORE] = len(uniforms) + HEAD
        for register, value in values.items():
            data[_place(register) : _place(register) + 32] = int(value).to_bytes(32, "big")
        engine = run[0].engine if run else "Engine"
        call = EngineCall(engine, bytes(data) + drawn, chain.call(engine, bytes(data) + drawn))
        yield call
        drawn = call.result.output


def _runs(data: bytes) -> list[list[_Object]]:
    """Return runs of objects that one engine draws; an empty one if there is nothing to draw."""
    objects, position = [], _load(data, _place(layout.OBJECTS_BEGIN))
    kind = "Antialiased" if _load(data, _place(layout.FRAME_IS_ANTIALIASED)) else ""
    has_effects = _load(data, _place(layout.EFFECTS_OFFSET)) != 0
    for number in range(_load(data, _place(layout.OBJECT_COUNT))):
        mode, flags = (
            _load(data, position + word - layout.OBJECT_BYTES) for word in (layout.OBJECT_MODE, layout.OBJECT_FLAGS)
        )
        is_blended = mode & layout.IS_BLENDED != 0
        engine = kind + "Engine"
        if kind and mode & layout.IS_QUADRATIC and not (is_blended or flags & WIREFRAME):
            engine = "AntialiasedSmoothEngine"
        elif is_blended or flags & WIREFRAME or mode & (layout.IS_SMOOTH | layout.IS_SPOT_LIT):
            engine = kind + "FragmentEngine"
        objects.append(_Object(number, position, "EffectsEngine" if has_effects else engine, is_blended))
        position += _load(data, position)
    runs = [(key, list(run)) for key, run in groupby(objects, lambda each: (each.engine, each.is_blended))]
    # a stable sort: blended objects come last
    ordered = [run for _, run in sorted(runs, key=lambda each: each[0][1])]
    return ordered or [[]]


def _place(register: int) -> int:
    return 4 + register - layout.FRAME_BEGIN


def _load(data: bytes, place: int) -> int:
    return int.from_bytes(data[place : place + 32], "big")
