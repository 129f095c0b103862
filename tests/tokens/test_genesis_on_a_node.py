"""The Genesis collection from its deployment to its last token, by the command line, seen by web3.py."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from web3.exceptions import ContractCustomError

from commands import Shackled
from nodes import Node
from pictures import frames_of
from shackled.datasets.genesis import generate_on_chain, picture_on_chain
from shackled.ethereum._encoding import intrinsic_gas
from shackled.tokens._launch import parts_of
from shackled.tokens._metadata import read_data_uri
from token_checks import document

OWNER, ALICE, BOB, CAROL = range(4)
PRICE = 2 * 10**17


def test_the_whole_way_of_tokens(
    node: Node, genesis: str, allow_list: Path, tmp_path: Path, shackled: Shackled
) -> None:
    """One test, since each step needs those before."""
    contract = node.contract("GenesisCollection", genesis)

    said = shackled("token", "mint", "--yes", user=CAROL, expect=1)
    assert said.error == "shackled: the sale is closed; for this it must be open for all"

    # the allow list
    assert "open for the allow list" in shackled("token", "phase", "allow-list", "--yes", user=OWNER).out
    assert "only the owner may do this" in shackled("token", "phase", "public", "--yes", user=BOB, expect=1).error
    said = shackled("token", "mint", 1, "--allow-list", allow_list, "--yes", user=BOB, expect=2)
    assert f"the account {node.accounts[BOB]} is not among the 2 accounts of the allow list" in said.error
    said = shackled("token", "mint", 2, "--allow-list", allow_list, "--yes", user=ALICE)
    assert "price: 0.4 ether, plus about" in said.err
    assert "minted #0, #1" in said.out
    said = shackled("token", "mint", 1, "--allow-list", allow_list, "--yes", user=ALICE, expect=1)
    assert said.error == "shackled: the allow list allows the account 2 in all: 2 minted, 1 more wanted"

    # a permission
    file = tmp_path / "bob.json"
    shackled("token", "permit", node.accounts[BOB], 1, "-o", file, user=OWNER)
    assert "signed by" in shackled("token", "permit", node.accounts[BOB], 1, user=BOB, expect=2).error
    said = shackled("token", "mint", 1, "--permission", file, "--yes", user=CAROL, expect=2)
    assert "the permission is for" in said.error
    assert "minted #2" in shackled("token", "mint", 1, "--permission", file, "--yes", user=BOB).out
    assert "1 minted, 1 more" in shackled("token", "mint", 1, "--permission", file, "--yes", user=BOB, expect=1).error

    # for all, and from the reserve
    shackled("token", "phase", "public", "--yes", user=OWNER)
    said = shackled("token", "mint", 6, "--yes", user=CAROL, expect=1)
    assert said.error == "shackled: a call mints 1 to 5 tokens, not 6"
    numbers = json.loads(shackled("token", "mint", 5, "--yes", "--json", user=CAROL).out)["tokens"]
    assert numbers == [3, 4, 5, 6, 7]
    said = shackled("token", "mint", 5, "--yes", user=CAROL, expect=1)
    assert said.error == "shackled: sold out: 5 wanted, 4 left"
    shackled("token", "mint", 2, "--reserve-to", node.accounts[8], "--yes", user=OWNER)
    owners = [contract.functions.ownerOf(number).call() for number in range(10)]
    assert owners == [node.accounts[user] for user in (1, 1, 2, 3, 3, 3, 3, 3, 8, 8)]
    assert node.balance(contract.address) == 8 * PRICE

    # nothing is known before the reveal
    with pytest.raises(ContractCustomError):
        contract.functions.seedOf(0).call()
    assert "not revealed yet" in shackled("token", "show", 0).out
    said = shackled("token", "reveal", "--yes", user=BOB, expect=2)
    assert "determines the next seeds, and the chain is at" in said.error
    assert "--wait" in said.error

    # anyone reveals
    node.mine(200)
    assert "revealed; " in shackled("token", "reveal", "--yes", user=9).out
    assert shackled("token", "reveal", "--yes", user=9).out == "there is nothing to reveal\n"

    # what is shown is the picture of the seed, as others compute it too
    picture = tmp_path / "4.png"
    said = shackled("token", "show", 4, "-o", picture)
    seed = contract.functions.seedOf(4).call()
    piece, _ = generate_on_chain(seed)
    assert f"structure       {piece.structure}" in said.out
    (shown,) = frames_of(picture)
    assert shown.shape == (512, 512, 3)
    np.testing.assert_array_equal(shown[::4, ::4], picture_on_chain(piece).pixels)
    uri = contract.functions.tokenURI(4).call()
    assert read_data_uri(document(uri)["image"], "it") == ("image/png", picture.read_bytes())
    as_json = json.loads(shackled("token", "show", 4, "--json").out)
    assert as_json["document"] == document(uri)
    assert as_json["owner"] == node.accounts[CAROL]

    # the gas that is reported is that of a transaction
    used = node.transact(contract.functions.tokenURI(4), node.accounts[OWNER])["gasUsed"]
    assert as_json["gas"] == used - intrinsic_gas(bytes.fromhex(contract.encode_abi("tokenURI", [4])[2:]))
    assert as_json["gas"] <= 13_000_000

    listed = json.loads(shackled("token", "list", "--json").out)
    assert [each["owner"] for each in listed["tokens"]] == owners
    assert all(each["revealed"] for each in listed["tokens"])
    assert len(shackled("token", "list").out.splitlines()) == 2 + 1 + 10

    # everything is what it should be
    said = shackled("token", "verify")
    assert "WRONG" not in said.out
    assert said.out.count("ok ") == len(parts_of("GenesisCollection")) + 1 + 10

    # a token changes hands and keeps its picture
    shackled("token", "transfer", 4, node.accounts[BOB], "--yes", user=CAROL)
    assert contract.functions.ownerOf(4).call() == node.accounts[BOB]
    assert contract.functions.tokenURI(4).call() == uri
    said = shackled("token", "transfer", 4, node.accounts[BOB], "--yes", user=CAROL, expect=2)
    assert f"token 4 belongs to {node.accounts[BOB]}" in said.error

    # the ether
    assert "only the owner" in shackled("token", "withdraw", "--yes", user=BOB, expect=1).error
    before = node.balance(node.accounts[7])
    assert "1.6 ether sent" in shackled("token", "withdraw", "--to", node.accounts[7], "--yes", user=OWNER).out
    assert node.balance(node.accounts[7]) == before + 8 * PRICE
    assert shackled("token", "withdraw", "--yes", user=OWNER).out == "there is nothing to withdraw\n"
