from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path

import pytest

from commands import Shackled
from nodes import Node, anvil, needs_anvil
from shackled.cli.app import run
from shackled.tokens._metadata import read_data_uri
from token_checks import document, traits


def test_the_demo_plays_both_collections_through(node: Node, tmp_path: Path, shackled: Shackled) -> None:
    said = shackled("token", "demo", "-o", tmp_path / "out")
    listed = json.loads((tmp_path / "out" / "tokens.json").read_text())
    page = (tmp_path / "out" / "gallery.html").read_text()
    assert {each["collection"] for each in listed} == {"Shackled Genesis", "Shackled Icons"}
    genesis = [each["gas"] for each in listed if each["collection"] == "Shackled Genesis"]
    assert sum(genesis) / len(genesis) <= 8_000_000
    assert max(genesis) <= 13_000_000
    assert all(each["bytes"] <= 100_000 and each["revealed"] and each["traits"] for each in listed)
    for each in listed[::7]:
        # web3.py reads the same, with no word about gas
        contract = node.contract(f"{each['collection'].split()[1]}Collection", each["address"])
        found = document(contract.functions.tokenURI(each["token"]).call())
        _, picture = read_data_uri(found["image"], "it")
        assert hashlib.sha256(picture).hexdigest() == each["picture"]["sha256"]
        assert traits(found) == each["traits"]
        assert contract.functions.ownerOf(each["token"]).call() == each["owner"]
        assert f'src="{found["image"]}"' in page
    assert len(re.findall(r"^  mint 5: \d{2},\d{3} gas$", said.err, re.M)) == 2
    # nothing is fetched from elsewhere; a picture in base64 may have any four letters
    text = re.sub("data:image/png;base64,[A-Za-z0-9+/=]+", "", page)
    assert "http" not in text.replace("http-equiv", "")


@needs_anvil
def test_the_demo_refuses_other_chains(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with anvil("--chain-id", "1") as started:
        assert run(["token", "demo", "--rpc", started.url, "-o", str(tmp_path / "out")]) == 2
        (error,) = capsys.readouterr().err.strip().splitlines()
        assert "of chain 1" in error
        assert started.rpc("eth_blockNumber") == "0x0"
    assert not (tmp_path / "out").exists()


def test_the_folder_must_not_be_a_file(node: Node, tmp_path: Path, shackled: Shackled) -> None:
    (tmp_path / "out").write_text("")
    assert "is a file, not a folder" in shackled("token", "demo", "-o", tmp_path / "out", expect=2).error
