"""Which engines the Renderer calls for a scene, as contracts/src/uniforms/Runs.sol chooses them."""

from __future__ import annotations

from functools import lru_cache

from ..artifacts import artifact
from ..errors import ChainError
from ..ethereum._encoding import word
from ..scene._codec import WIREFRAME
from . import _layout as layout
from ._chain import ContractChain, returned_bytes

#: The contracts that draw pictures with four samples per pixel, with effects, and others.
ANTIALIASED = ("AntialiasedEngine", "AntialiasedFragmentEngine", "AntialiasedSmoothEngine")
EFFECTS, PLAIN = ("EffectsEngine", "Effects"), ("Engine", "FragmentEngine")


@lru_cache(4)
def engines(scene: bytes, chain: ContractChain) -> tuple[str, ...]:
    """Return the contracts that may draw an ABI-encoded scene; those of plain scenes if the bytes are no scene.

    Of the three for antialiased scenes only those that are needed: together they leave little space in a creation call.
    """
    call = artifact("Renderer").selectors["engineCall"] + word(0xA0) + bytes(64) + scene[:64] + scene
    try:
        uniforms = returned_bytes(chain.call("Renderer", call).output)
    except ChainError:
        return PLAIN
    if _register(uniforms, layout.EFFECTS_OFFSET):
        return EFFECTS
    if not _register(uniforms, layout.FRAME_IS_ANTIALIASED):
        return PLAIN
    needed, position = set(), _register(uniforms, layout.OBJECTS_BEGIN)
    for _ in range(_register(uniforms, layout.OBJECT_COUNT)):
        words = (layout.OBJECT_MODE, layout.OBJECT_FLAGS)
        mode, flags = (_load(uniforms, position + each - layout.OBJECT_BYTES) for each in words)
        if mode & layout.IS_BLENDED or flags & WIREFRAME:
            needed.add(1)
        elif mode & layout.IS_QUADRATIC:
            needed.add(2)
        else:
            needed.add(1 if mode & (layout.IS_SMOOTH | layout.IS_SPOT_LIT) else 0)
        position += _load(uniforms, position)
    return tuple(ANTIALIASED[number] for number in sorted(needed or {0}))


def _register(data: bytes, register: int) -> int:
    return _load(data, 4 + register - layout.FRAME_BEGIN)


def _load(data: bytes, place: int) -> int:
    return int.from_bytes(data[place : place + 32], "big")
