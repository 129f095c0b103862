"""Addresses, hashes and words, by the examples of their standards."""

from __future__ import annotations

import pytest

from shackled.errors import InputError
from shackled.ethereum import checksum_address, create2_address, intrinsic_gas, keccak256, parse_address, to_hex, word

# EIP-55
ADDRESSES = [
    "0x5aAeb6053F3E94C9b9A09f33669435E7Ef1BeAed",
    "0xfB6916095ca1df60bB79Ce92cE3Ea74c37c5d359",
    "0xdbF03B407c01E7cD3CBea99509d93f8DDDC8C6FB",
    "0xD1220A0cf47c7B9Be7A2E6BA89F429762e7b9aDb",
]


def test_hashes_words_and_gas() -> None:
    assert to_hex(keccak256(b"")) == "0xc5d2460186f7233c927e7db2dcc703c0e500b653ca82273b7bfad8045d85a470"
    assert (word(5), word(b"\5\6")) == (bytes(31) + b"\5", bytes(30) + b"\5\6")
    assert (intrinsic_gas(b""), intrinsic_gas(b"\0\1\0")) == (21_000, 21_000 + 2 * 4 + 16)


@pytest.mark.parametrize("text", ADDRESSES)
def test_checksums(text: str) -> None:
    address = bytes.fromhex(text[2:])
    assert checksum_address(address) == text
    for way in (text, text.lower(), "0x" + text[2:].upper(), f" {text} "):
        assert parse_address(way, "address") == address


def test_what_is_no_address_is_refused() -> None:
    for text in ("", "5aAeb6053F3E94C9b9A09f33669435E7Ef1BeAed", ADDRESSES[0][:-1], ADDRESSES[0] + "0"):
        with pytest.raises(InputError, match=r"^owner must be an address, 0x and 40 hexadecimal digits, not "):
            parse_address(text, "owner")
    with pytest.raises(InputError, match=r"^owner has an invalid checksum, its capitals do not match its digits: "):
        parse_address(ADDRESSES[0].replace("aA", "Aa"), "owner")


@pytest.mark.parametrize(
    ("creator", "salt", "creation", "expected"),
    [  # EIP-1014
        (bytes(20), bytes(32), b"\0", "0x4D1A2e2bB4F88F0250f26Ffff098B0b30B26BF38"),
        (b"\xde\xad\xbe\xef" + bytes(16), bytes(32), b"\0", "0xB928f69Bb1D91Cd65274e3c79d8986362984fDA3"),
        (bytes(20), bytes(32), b"\xde\xad\xbe\xef", "0x70f2b2914A2a4b783FaEFb75f459A580616Fcb5e"),
        (bytes(20), bytes(32), b"", "0xE33C0C7F7df4809055C3ebA6c09CFe4BaF1BD9e0"),
    ],
)
def test_addresses_of_create2(creator: bytes, salt: bytes, creation: bytes, expected: str) -> None:
    assert checksum_address(create2_address(creation, salt, creator)) == expected
