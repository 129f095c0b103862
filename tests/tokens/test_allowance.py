"""Permissions in files: what is none is told in one line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from shackled.errors import InputError
from shackled.tokens import read_allowance

PERMISSION = {
    "account": "0x3C44CdDdB6a900fa2b585dd299e03d12FA4293BC",
    "quantity": "2",
    "deadline": "1900000000",
    "signature": "0x" + "12" * 65,
}


def test_a_permission_is_read(tmp_path: Path) -> None:
    path = tmp_path / "bob.json"
    path.write_text(json.dumps(PERMISSION))
    found = read_allowance(path)
    assert found.struct == (PERMISSION["account"], 2, 1_900_000_000)
    assert found.signature == b"\x12" * 65
    assert found.document() == PERMISSION


@pytest.mark.parametrize(
    "change",
    [
        {"quantity": str(2**256)},
        {"deadline": str(2**256)},
        {"quantity": "-1"},
        {"quantity": "1.5"},
        {"signature": "0x123"},
        {"signature": ""},
        {"account": "0x12"},
    ],
)
def test_what_is_none_is_told_in_one_line(tmp_path: Path, change: dict[str, str]) -> None:
    path = tmp_path / "bob.json"
    path.write_text(json.dumps(PERMISSION | change))
    with pytest.raises(InputError, match=r"^[^\n]*bob\.json[^\n]*$"):
        read_allowance(path)


def test_a_file_of_something_else(tmp_path: Path) -> None:
    path = tmp_path / "bob.json"
    with pytest.raises(InputError, match="cannot be read"):
        read_allowance(path)
    for text in ("", "[]", "{}", "[" * 100_000):
        path.write_text(text)
        with pytest.raises(InputError, match="is not a permission"):
            read_allowance(path)
