from __future__ import annotations

import pytest

from shackled.artifacts import artifact
from shackled.errors import VerificationError
from shackled.tokens._launch import immutable_places, immutable_values

VALUE = bytes(range(32))


def test_values_are_found_where_they_were_written() -> None:
    runtime = artifact("GenesisCollection").runtime
    places = immutable_places(runtime)
    code = bytearray(runtime)
    for place in places:
        code[place : place + 32] = VALUE
    assert places
    assert immutable_values(bytes(code), runtime) == {VALUE}


def test_bytes_of_other_instructions_are_not_taken_for_places() -> None:
    # PUSH2 0x7f00, then 32 times STOP: no PUSH32 is executed there
    assert immutable_places(bytes.fromhex("617f00") + bytes(32)) == []
    assert immutable_places(bytes.fromhex("7f") + bytes(32)) == [1]


@pytest.mark.parametrize("change", [0, 100, -1])
def test_any_other_difference_is_said(change: int) -> None:
    runtime = artifact("GenesisCollection").runtime
    code = bytearray(runtime)
    code[change] ^= 1
    with pytest.raises(VerificationError, match=f"at byte {change % len(code):,}$"):
        immutable_values(bytes(code), runtime)


def test_another_length_is_said() -> None:
    runtime = artifact("GenesisCollection").runtime
    with pytest.raises(VerificationError, match="bytes, not "):
        immutable_values(runtime + b"\0", runtime)
    with pytest.raises(VerificationError, match="its code has 0 bytes"):
        immutable_values(b"", runtime)
