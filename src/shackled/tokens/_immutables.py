"""Comparison of deployed code with a compiled contract: only immutable values, set by the constructor, may differ."""

from __future__ import annotations

from ..errors import VerificationError

PUSH1, PUSH32 = 0x60, 0x7F
#: What the compiler pushes in place of an immutable value; it pushes 32 zeros nowhere else.
EMPTY = bytes(32)


def immutable_places(runtime: bytes) -> list[int]:
    """Return the offsets of immutable values, of 32 bytes each, in the runtime code of an artifact."""
    places, at = [], 0
    while at < len(runtime):
        operation = runtime[at]
        at += 1
        if PUSH1 <= operation <= PUSH32:
            size = operation - PUSH1 + 1
            if size == 32 and runtime[at : at + 32] == EMPTY:
                places.append(at)
            at += size
    return places


def immutable_values(code: bytes, runtime: bytes) -> set[bytes]:
    """Return the immutable values of deployed code. Raises VerificationError if it differs elsewhere from `runtime`."""
    places = immutable_places(runtime)
    masked = bytearray(code)
    for place in places:
        masked[place : place + 32] = EMPTY
    if len(code) != len(runtime):
        raise VerificationError(f"its code has {len(code):,} bytes, not {len(runtime):,}")
    if bytes(masked) != runtime:
        at = next(at for at, (one, other) in enumerate(zip(masked, runtime, strict=True)) if one != other)
        raise VerificationError(f"its code differs from the compiled contract at byte {at:,}")
    return {code[place : place + 32] for place in places}
