from __future__ import annotations

import pytest

from shackled.artifacts import artifact
from shackled.errors import VerificationError
from shackled.tokens._launch import immutable_places, immutable_values

RUNTIME = artifact("GenesisCollection").runtime
VALUE = bytes(range(32))


def test_values_are_found_where_they_were_written() -> None:
    code, places = bytearray(RUNTIME), immutable_places(RUNTIME)
    for place in places:
        code[place : place + 32] = VALUE
    assert places
    assert immutable_values(bytes(code), RUNTIME) == dict.fromkeys(places, VALUE)
    # PUSH2 0x7f00, then 32 times STOP: no PUSH32 is executed there
    assert immutable_places(bytes.fromhex("617f00") + bytes(32)) == []
    assert immutable_places(bytes.fromhex("7f") + bytes(32)) == [1]


@pytest.mark.parametrize(
    ("code", "complaint"),
    [
        (bytes([RUNTIME[0] ^ 1]) + RUNTIME[1:], "at byte 0$"),
        (RUNTIME[:-1] + bytes([RUNTIME[-1] ^ 1]), f"at byte {len(RUNTIME) - 1:,}$"),
        (RUNTIME + b"\0", "bytes, not "),
        (b"", "its code has 0 bytes"),
    ],
)
def test_any_other_difference_is_said(code: bytes, complaint: str) -> None:
    with pytest.raises(VerificationError, match=complaint):
        immutable_values(code, RUNTIME)
