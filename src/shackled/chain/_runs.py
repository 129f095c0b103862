"""Repeat the calls that the Renderer makes of its engines, one for each run of objects.

Mirrors contracts/src/uniforms/Runs.sol and the Renderer's use of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import groupby
from typing import NamedTuple

from ..artifacts import artifact
from ..errors import ChainError
from ..ethereum import word
from ..scene import WIREFRAME, Rectangle, Scene, encode
from . import _layout as layout
from ._chain import CallResult, ContractChain, returned_bytes

#: As in Pipeline.sol.
BAND_PIXELS = 16384
#: Bytes of an answer before its pixels.
HEAD = 0x40
#: The contracts that draw pictures with four samples per pixel, with effects, and others.
ANTIALIASED = ("AntialiasedEngine", "AntialiasedFragmentEngine", "AntialiasedSmoothEngine")
EFFECTS, PLAIN = ("EffectsEngine", "Effects"), ("Engine", "FragmentEngine")


@dataclass(frozen=True)
class EngineCall:
    """A call of an engine, and its result."""

    engine: str
    data: bytes
    result: CallResult


class _Object(NamedTuple):
    engine: str
    is_blended: bool
    number: int
    position: int


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


@lru_cache(4)
def engines(scene: bytes, chain: ContractChain) -> tuple[str, ...]:
    """Return the contracts that may draw an ABI-encoded scene; those of plain scenes if it is none.

    Of the three for antialiased scenes only those that are needed: together they leave little space in a creation call.
    """
    call = artifact("Renderer").selectors["engineCall"] + word(0xA0) + bytes(64) + scene[:64] + scene
    try:
        uniforms = returned_bytes(chain.call("Renderer", call).output, 0)
    except ChainError:
        return PLAIN
    if _load(uniforms, _place(layout.EFFECTS_OFFSET)):
        return EFFECTS
    if not _load(uniforms, _place(layout.FRAME_IS_ANTIALIASED)):
        return PLAIN
    needed = {each.engine for run in _runs(uniforms) for each in run}
    return tuple(name for name in ANTIALIASED if name in needed) or ANTIALIASED[:1]


def _uniforms(scene: Scene, tile: Rectangle, chain: ContractChain) -> bytes:
    data = encode(artifact("Renderer").selectors["engineCall"], scene, tile)
    return returned_bytes(chain.call("Renderer", data).output, 0)


def _calls(uniforms: bytes, chain: ContractChain) -> Iterator[EngineCall]:
    data, drawn, runs = bytearray(uniforms), b"", _runs(uniforms)
    invert = _load(uniforms, _place(layout.INVERT))
    for run in runs:
        is_last = run is runs[-1]
        values = {layout.OBJECT_COUNT: len(run), layout.RETURNS_DEPTHS: not is_last, layout.INVERT: invert * is_last}
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
        objects.append(_Object("EffectsEngine" if has_effects else engine, is_blended, number, position))
        position += _load(data, position)
    runs = [list(run) for _, run in groupby(objects, lambda each: each[:2])]
    # a stable sort: blended objects come last
    return sorted(runs, key=lambda run: run[0].is_blended) or [[]]


def _place(register: int) -> int:
    return 4 + register - layout.FRAME_BEGIN


def _load(data: bytes, place: int) -> int:
    return int.from_bytes(data[place : place + 32], "big")
