"""Addresses, hashes, words and headers of blocks, by the examples of their standards."""

from __future__ import annotations

import pytest

from shackled.errors import InputError
from shackled.ethereum._encoding import (
    checksum_address,
    create2_address,
    encode_header,
    intrinsic_gas,
    keccak256,
    parse_address,
    to_hex,
    word,
)

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


#: The first block of Ethereum (2015), as every node tells it.
GENESIS = {
    "hash": "0xd4e56740f876aef8c010b86a40d5f56745a118d0906a34e69aec8c0db1cb8fa3",
    "parentHash": "0x" + "00" * 32,
    "sha3Uncles": "0x1dcc4de8dec75d7aab85b567b6ccd41ad312451b948a7413f0a142fd40d49347",
    "miner": "0x" + "00" * 20,
    "stateRoot": "0xd7f8974fb5ac78d9ac099b9ad5018bedc2ce0a72dad1827a1709da30580f0544",
    "transactionsRoot": "0x56e81f171bcc55a6ff8345e692c0f86e5b48e01b996cadc001622fb5e363b421",
    "receiptsRoot": "0x56e81f171bcc55a6ff8345e692c0f86e5b48e01b996cadc001622fb5e363b421",
    "logsBloom": "0x" + "00" * 256,
    "difficulty": "0x400000000",
    "number": "0x0",
    "gasLimit": "0x1388",
    "gasUsed": "0x0",
    "timestamp": "0x0",
    "extraData": "0x11bbe8db4e347b4e8c937c1c8370e4b5ed33adb3db69cbdb7a38e1e50b1b82fa",
    "mixHash": "0x" + "00" * 32,
    "nonce": "0x0000000000000042",
}


def test_the_first_block_has_its_hash() -> None:
    assert to_hex(keccak256(encode_header(GENESIS))) == GENESIS["hash"]


@pytest.mark.parametrize("name", ["mixHash", "gasUsed"])
@pytest.mark.parametrize("value", [None, "zz", "0xzz", 1.5, -5, [300], 7])
def test_a_field_that_is_none_is_named(name: str, value: object) -> None:
    with pytest.raises(InputError, match=rf"its {name} is .*, not hexadecimal$"):
        encode_header({**GENESIS, name: value})
