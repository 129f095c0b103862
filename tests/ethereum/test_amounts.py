from __future__ import annotations

from collections.abc import Callable

import pytest

from shackled.errors import InputError
from shackled.ethereum._amounts import ETHER, GWEI, at_most, ether, parse_ether, roughly, rounded


def test_amounts_are_read_exactly() -> None:
    amounts = {"0": 0, "0.15": 15 * 10**16, "1": ETHER, "0.000000000000000001": 1, "2.5 ether": 25 * 10**17}
    amounts |= {"20gwei": 20 * GWEI, "1.5 gwei": 15 * 10**8, "7wei": 7, "1000000000": 10**27}
    assert {text: parse_ether(text, "--price") for text in amounts} == amounts


@pytest.mark.parametrize("text", ["", "-1", "1e3", ".5", "0.5wei", "1.0000000001gwei", "1000000001", "1 dollar", "nan"])
def test_what_is_no_amount_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="--price must be an amount of ether"):
        parse_ether(text, "--price")


@pytest.mark.parametrize(
    ("write", "amounts"),
    [
        (ether, {0: "0 ether", 1: "0.000000000000000001 ether", 15 * 10**16: "0.15 ether", ETHER: "1 ether"}),
        (roughly, {0: "0 ether", 123456789: "0.123 gwei", 56345 * 10**9: "0.0000563 ether", 12 * ETHER: "12 ether"}),
        (roughly, {123456 * 10**12: "0.123 ether", 12345 * ETHER: "12300 ether"}),
        (rounded, {0: "0", ETHER: "1", ETHER // 100: "0.01", 1: "1e-18", 1234567 * 10**12: "1.234567"}),
        (at_most, {0: "0", 1: "0.000000000000000001", 300_181_000_000_000_001: "0.300182", 10**24: "1000000"}),
    ],
)
def test_amounts_are_written(write: Callable[[int], str], amounts: dict[int, str]) -> None:
    assert {wei: write(wei) for wei in amounts} == amounts
