from __future__ import annotations

import pytest

from shackled.errors import InputError
from shackled.ethereum import ETHER, at_most, ether, parse_ether, roughly, rounded


@pytest.mark.parametrize(
    ("text", "wei"),
    [
        ("0", 0),
        ("0.15", 15 * 10**16),
        ("1", 10**18),
        ("0.000000000000000001", 1),
        ("2.5 ether", 25 * 10**17),
        ("20gwei", 20 * 10**9),
        ("1.5 gwei", 15 * 10**8),
        ("7wei", 7),
        ("1000000000", 10**27),
    ],
)
def test_amounts_are_read_exactly(text: str, wei: int) -> None:
    assert parse_ether(text, "--price") == wei


@pytest.mark.parametrize("text", ["", "-1", "1e3", ".5", "0.5wei", "1.0000000001gwei", "1000000001", "1 dollar", "nan"])
def test_what_is_no_amount_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="--price must be an amount of ether"):
        parse_ether(text, "--price")


def test_amounts_in_words() -> None:
    assert [ether(wei) for wei in (0, 1, 15 * 10**16, 10**18)] == [
        "0 ether",
        "0.000000000000000001 ether",
        "0.15 ether",
        "1 ether",
    ]
    amounts = (0, 123456789, 56345 * 10**9, 123456 * 10**12, 12 * 10**18, 12345 * 10**18)
    assert [roughly(wei) for wei in amounts] == [
        "0 ether",
        "0.123 gwei",
        "0.0000563 ether",
        "0.123 ether",
        "12 ether",
        "12300 ether",
    ]


@pytest.mark.parametrize(
    ("wei", "text"), [(0, "0"), (ETHER, "1"), (ETHER // 100, "0.01"), (1, "1e-18"), (1234567 * 10**12, "1.234567")]
)
def test_ether_in_a_table(wei: int, text: str) -> None:
    assert rounded(wei) == text


@pytest.mark.parametrize(
    ("wei", "text"),
    [(0, "0"), (1, "0.000000000000000001"), (ETHER, "1"), (300_181_000_000_000_001, "0.300182"), (10**24, "1000000")],
)
def test_the_most_is_rounded_up(wei: int, text: str) -> None:
    assert at_most(wei) == text
