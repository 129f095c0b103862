"""Permissions in files: what is none is reported in one line."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from eth_abi.abi import encode
from eth_account import Account

from shackled.errors import InputError
from shackled.ethereum import keccak256
from shackled.tokens import sign_allowance
from shackled.tokens._minting import read_allowance

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
        {"signature": "0x"},
        {"signature": "12" * 65},
        {"signature": "0x" + "00" * 1025},
        {"quantity": "9" * 5000},
        {"quantity": "٢"},
        {"account": "0x12"},
    ],
)
def test_what_is_none_is_reported_in_one_line(tmp_path: Path, change: dict[str, str]) -> None:
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


def test_what_is_signed_is_the_message_of_the_contract() -> None:
    """By EIP-712, hashed here by hand: it holds for one account, number, time, collection and chain only."""
    signer, account, place = Account.create(), PERMISSION["account"], "0x" + "5b" * 20
    connection = SimpleNamespace(chain_id=11155111)
    collection: Any = SimpleNamespace(kind=SimpleNamespace(title="Genesis"), connection=connection, address=place)
    signed = sign_allowance(collection, signer, account, 3, 1_900_000_000)
    assert signed.struct == (account, 3, 1_900_000_000)
    domain = b"EIP712Domain(string name,string version,uint256 chainId,address verifyingContract)"
    domain_words = [keccak256(domain), keccak256(b"Genesis"), keccak256(b"1"), 11155111, place]
    message = b"Allowance(address account,uint256 quantity,uint256 deadline)"
    hashes = [
        keccak256(encode(["bytes32", "bytes32", "bytes32", "uint256", "address"], domain_words)),
        keccak256(encode(["bytes32", "address", "uint256", "uint256"], [keccak256(message), *signed.struct])),
    ]
    digest = keccak256(b"\x19\x01" + b"".join(hashes))
    assert Account._recover_hash(digest, signature=signed.signature) == signer.address


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"quantity": str(2**256 - 1)}, (2**256 - 1, 1_900_000_000, 65)),
        ({"deadline": str(2**256 - 1)}, (2, 2**256 - 1, 65)),
        ({"quantity": "0" * 77 + "3", "deadline": 7}, (3, 7, 65)),
        # a contract that signs may say what it likes
        ({"signature": "0xAB"}, (2, 1_900_000_000, 1)),
        ({"signature": "0x" + "00" * 1024}, (2, 1_900_000_000, 1024)),
    ],
)
def test_the_largest_that_are_read(tmp_path: Path, change: dict[str, object], expected: tuple[int, int, int]) -> None:
    path = tmp_path / "bob.json"
    path.write_text(json.dumps(PERMISSION | change))
    found = read_allowance(path)
    assert (found.quantity, found.deadline, len(found.signature)) == expected


def test_an_account_in_small_letters_is_read(tmp_path: Path) -> None:
    path = tmp_path / "bob.json"
    path.write_text(json.dumps(PERMISSION | {"account": PERMISSION["account"].lower()}))
    assert read_allowance(path).account == PERMISSION["account"]
