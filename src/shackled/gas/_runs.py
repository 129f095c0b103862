"""The calls of the Renderer to its engines, one for each run of objects, as in Runs.sol and Renderer.sol."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

from ..artifacts import artifact
from ..chain import CallResult, ContractChain, returned_bytes
from ..reference.layout import (
    DRAWN_BEFORE,
    FRAME_BEGIN,
    INVERT,
    IS_BLENDED,
    IS_SMOOTH,
    IS_SPOT_LIT,
    OBJECT_BYTES,
    OBJECT_COUNT,
    OBJECT_FIRST,
    OBJECT_FLAGS,
    OBJECT_MODE,
    OBJECTS,
    OBJECTS_BEGIN,
    RETURNS_DEPTHS,
)
from ..scene import WIREFRAME, Rectangle, Scene, encode

#: As in Pipeline.sol.
BAND_PIXELS = 16384
#: Bytes of a result before the pixels.
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
    """Repeat all engine calls of a render."""
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
    invert = _load(uniforms, _place(INVERT))
    for run in runs:
        is_last = run is runs[-1]
        values = {OBJECT_COUNT: len(run), RETURNS_DEPTHS: not is_last, INVERT: invert if is_last else 0}
        if run:
            values |= {OBJECTS: run[0].position, OBJECT_FIRST: run[0].number}
        if drawn:
            values[DRAWN_BEFORE] = len(uniforms) + HEAD
        for register, value in values.items():
            data[_place(register) : _place(register) + 32] = int(value).to_bytes(32, "big")
        engine = run[0].engine if run else "Engine"
        call = EngineCall(engine, bytes(data) + drawn, chain.call(engine, bytes(data) + drawn))
        yield call
        drawn = call.result.output


def _runs(data: bytes) -> list[list[_Object]]:
    """Return the runs of consecutive objects that one engine draws; one empty run without objects."""
    objects, position = [], _load(data, _place(OBJECTS_BEGIN))
    for number in range(_load(data, _place(OBJECT_COUNT))):
        mode, flags = (_load(data, position + word - OBJECT_BYTES) for word in (OBJECT_MODE, OBJECT_FLAGS))
        is_blended = mode & IS_BLENDED != 0
        by_fragments = is_blended or flags & WIREFRAME or mode & (IS_SMOOTH | IS_SPOT_LIT)
        objects.append(_Object(number, position, "FragmentEngine" if by_fragments else "Engine", is_blended))
        position += _load(data, position)
    runs = [(key, list(run)) for key, run in groupby(objects, lambda each: (each.engine, each.is_blended))]
    # stable sort: objects that are not opaque come last
    ordered = [run for _, run in sorted(runs, key=lambda each: each[0][1])]
    return ordered or [[]]


def _place(register: int) -> int:
    return 4 + register - FRAME_BEGIN


def _load(data: bytes, place: int) -> int:
    return int.from_bytes(data[place : place + 32], "big")
