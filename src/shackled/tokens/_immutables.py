"""Code on a chain against the compiled contract: equal but for immutable values, which the constructor wrote."""

from __future__ import annotations

from ..errors import VerificationError

PUSH1, PUSH32 = 0x60, 0x7F
#: What the compiler leaves in the place of an immutable value: the only way in which it pushes 32 zeros.
EMPTY = bytes(32)


def immutable_places(runtime: bytes) -> list[int]:
    """Return where immutable values stand in the runtime code of an artifact, 32 bytes each."""
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
    """Return the values that stand in code on a chain where the runtime code of the artifact has places for them.

    VerificationError if anything else differs.
    """
    places = immutable_places(runtime)
    masked = bytearray(code)
    for place in places:
        masked[place : place + 32] = EMPTY
    if len(code) != len(runtime):
        raise VerificationError(f"its code has {len(code):,} bytes, and should have {len(runtime):,}")
    if bytes(masked) != runtime:
        at = next(at for at, (one, other) in enumerate(zip(masked, runtime, strict=True)) if one != other)
        raise VerificationError(f"its code differs from the compiled contract at byte {at:,}")
    return {code[place : place + 32] for place in places}
