"""Who may mint before the public sale, as files say it: allow lists, and permissions."""

from __future__ import annotations

import json
from functools import reduce
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shackled.errors import InputError
from shackled.tokens._allow_list import hash_pair, leaf_of, make_allow_list, read_allow_list
from shackled.tokens._minting import read_allowance

ALICE = "0x70997970C51812dc3A010C7d01b50e0d17dc79C8"
BOB = "0x3C44CdDdB6a900fa2b585dd299e03d12FA4293BC"


def test_the_tree_is_that_of_openzeppelin() -> None:
    # the example in the README of @openzeppelin/merkle-tree
    entries = [("0x" + "1" * 40, 5 * 10**18), ("0x" + "2" * 40, 25 * 10**17)]
    tree = make_allow_list(entries).document()
    assert tree == {
        "format": "standard-v1",
        "leafEncoding": ["address", "uint256"],
        "tree": [
            "0xd4dee0beab2d53f2cc83e567171bd2820e49898130a22622b10ead383e90bd77",
            "0xeb02c421cfa48976e66dfb29120745909ea3a0f843456c263cf8f1253483e283",
            "0xb92c48e9d7abe27fd8dfd6b5dfdbfb1c9a463f80c712b66f3a5180a090cccafc",
        ],
        "values": [
            {"value": ["0x" + "1" * 40, "5000000000000000000"], "treeIndex": 1},
            {"value": ["0x" + "2" * 40, "2500000000000000000"], "treeIndex": 2},
        ],
    }
    assert make_allow_list(entries[::-1]).root.hex() == tree["tree"][0][2:]


@settings(max_examples=30)
@given(st.dictionaries(st.binary(min_size=20, max_size=20), st.integers(1, 2**256 - 1), min_size=1, max_size=40))
def test_every_entry_is_proven_and_no_other_quantity(entries: dict[bytes, int]) -> None:
    listed = make_allow_list(("0x" + account.hex(), quantity) for account, quantity in entries.items())
    for account, quantity in listed.allowances.items():
        proof = listed.proof(account)
        assert reduce(hash_pair, proof, leaf_of(account, quantity)) == listed.root
        assert reduce(hash_pair, proof, leaf_of(account, quantity ^ 1)) != listed.root


def test_a_list_is_read_from_lines(tmp_path: Path) -> None:
    path = tmp_path / "list.csv"
    path.write_text(f"account, quantity\n# friends\n{ALICE.lower()}, 2\n\n{BOB},1\n")
    assert read_allow_list(path).allowances == {ALICE: 2, BOB: 1}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("account,quantity\n", "is empty"),
        (f"{ALICE}\n", "entry 1: it must be account,quantity"),
        (f"{ALICE},2\n{BOB},-1\n", "entry 2: the quantity must be a whole number from 1, not '-1'"),
        (f"{ALICE},0\n", "must be a whole number from 1"),
        (f"{ALICE},1.5\n", "must be a whole number from 1"),
        (f"{ALICE},{2**256}\n", "must be a whole number from 1"),
        ("0x12,1\n", "the account must be an address, 0x and 40 hexadecimal digits"),
        (f"{ALICE},1\n{ALICE.lower()},1\n", "entry 2: the account " + ALICE + " occurs twice"),
        ("\xff", "is not text"),
    ],
)
def test_a_wrong_line_is_named(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "list.csv"
    path.write_text(text, "latin-1")
    with pytest.raises(InputError, match=r"^[^\n]*$") as caught:
        read_allow_list(path)
    assert said in str(caught.value)


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
