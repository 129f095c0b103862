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
from shackled.tokens import read_allowance, sign_allowance

PERMISSION = {
    "account": "0x3C44CdDdB6a900fa2b585dd299e03d12FA4293BC",
    "quantity": "2",
    "deadline": str(2**256 - 1),
    "signature": "0x" + "12" * 65,
}


def test_a_permission_is_read(tmp_path: Path) -> None:
    path = tmp_path / "bob.json"
    for change in ({}, {"account": PERMISSION["account"].lower(), "quantity": 2}):
        path.write_text(json.dumps(PERMISSION | change))
        found = read_allowance(path)
        assert (found.struct, found.signature) == ((PERMISSION["account"], 2, 2**256 - 1), b"\x12" * 65)
        assert found.document() == PERMISSION


@pytest.mark.parametrize(
    "change",
    [
        *({"quantity": value} for value in (str(2**256), "-1", "1.5", "9" * 5000, None)),
        *({"signature": value} for value in ("0x123", "zz", 7)),
        *({"account": value} for value in ("0x12", 7)),
    ],
)
def test_what_is_none_is_reported_in_one_line(tmp_path: Path, change: dict[str, Any]) -> None:
    path = tmp_path / "bob.json"
    for text in ("", "[]", "{}", "[" * 100_000, json.dumps(PERMISSION | change)):
        path.write_text(text)
        with pytest.raises(InputError, match=r"^[^\n]*bob\.json is not a permission[^\n]*$"):
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
