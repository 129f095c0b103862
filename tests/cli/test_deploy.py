"""The command `shackled deploy`."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from eth_account import Account
from tools.anvil import Anvil
from tools.children import child

from commands import Said, Shackled
from nodes import KEY, Reply, failure, forward, free_port, serving
from shackled.artifacts import artifact
from shackled.chain._address_book import VARIABLE
from shackled.deploy import deployments

PASSWORD = "a pass phrase 77"


@pytest.fixture(autouse=True)
def book(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = folder / "book" / "addresses.json"
    monkeypatch.setenv(VARIABLE, str(path))
    monkeypatch.setenv("TEST_KEY", KEY)
    for name in ("SHACKLED_RPC", "SHACKLED_PASSWORD"):
        monkeypatch.delenv(name, raising=False)
    return path


@pytest.fixture
def deploy(folder: Path, shackled: Shackled) -> Shackled:
    """Runs the command, and looks whether it printed or wrote a key or a password."""

    def command(words: str, expect: int = 0) -> Said:
        told = shackled(f"deploy {words}", expect=expect)
        written = [path for path in folder.rglob("*") if path.is_file() and path.name != "keystore"]
        for text in [told.out, told.err, *(path.read_text("utf-8") for path in written)]:
            assert KEY[2:] not in text
            assert PASSWORD not in text
        return told

    return command


@pytest.fixture
def paid(node: Anvil) -> str:
    """The options of a command that sends."""
    return f"--rpc {node.url} --private-key-env TEST_KEY --yes"


def test_deploying_twice(node: Anvil, book: Path, paid: str, deploy: Shackled, shackled: Shackled) -> None:
    told = deploy(f"{paid} --standard-json verify")
    summary = json.loads(Path("verify/contracts.json").read_text("utf-8"))
    assert summary["chainId"] == 31337
    for each, entry in zip(deployments(), summary["contracts"], strict=True):
        address = json.loads(book.read_text("utf-8"))["chains"]["31337"][each.name]
        assert address.lower() == "0x" + each.address.hex()
        assert node.connection.data("eth_getCode", address, "latest") == each.code
        # in the table before, and when it was done
        assert told.err.count(address) == 2
        assert told.err.count(f"{each.gas:,}") == 2
        # what verifies the source
        assert entry["name"].endswith(f":{each.name}")
        assert each.creation == artifact(each.name).creation + bytes.fromhex(entry["constructorArguments"])
        source = json.loads(Path("verify", entry["standardInput"]).read_text("utf-8"))
        assert entry["name"].split(":")[0] in source["sources"]
        assert entry["compiler"].startswith("0.8.")
    assert f"on chain 31337, through the {node.connection.name}, at " in told.err
    blocks = node.rpc("eth_blockNumber")
    assert "all contracts are deployed already: nothing was sent" in deploy(f"--rpc {node.url}").out
    assert node.rpc("eth_blockNumber") == blocks
    # and a render finds it
    assert "(deployed)" in shackled(f"render shape.obj --size 8 --rpc {node.url} --json").json["chain"]


@pytest.mark.parametrize(
    ("code", "line"),
    [
        # each of its two functions returns 10^15 wei
        ("66038d7ea4c680005f5260205ff3", "the maximum includes 0.004 ether for data on L1, twice what the chain tells"),
        ("5f5ffd", "takes a fee for data on L1 as well, and tells no bound of it: the maximum does not include it"),
    ],
)
def test_the_fee_of_a_rollup_is_told(node: Anvil, paid: str, deploy: Shackled, code: str, line: str) -> None:
    node.rpc("anvil_setCode", "0x420000000000000000000000000000000000000F", "0x" + code)
    assert line in deploy(f"{paid} --contracts Engine").err
    assert "L1" not in deploy(f"{paid} --contracts Engine").err


def test_json(book: Path, paid: str, deploy: Shackled) -> None:
    words = f"{paid} --json --contracts PngEncoder,Renderer"
    told = deploy(words).json
    engines = artifact("Renderer").parts
    assert [each["name"] for each in told["contracts"]] == ["PngEncoder", *engines, "Renderer"]
    assert all(each["deployed_now"] for each in told["contracts"])
    assert (told["chain_id"], len(told["transactions"])) == (31337, len(engines) + 2)
    assert told["gas"] == sum(each.gas for each in deployments(["Renderer", "PngEncoder"]))
    assert told["wei"] > 0
    assert (told["address_book"], told["standard_json"]) == (str(book), "deployed-31337")
    told = deploy(words).json
    assert (told["gas"], told["transactions"]) == (0, [])
    assert not any(each["deployed_now"] for each in told["contracts"])


def test_a_wallet_sends_the_transactions(node: Anvil, deploy: Shackled) -> None:
    words = f"--rpc {node.url} --contracts PngEncoder"
    assert "nothing was sent: calls.json has 1 transaction" in deploy(f"{words} --calldata calls.json").err
    (call,) = json.loads(Path("calls.json").read_text("utf-8"))["calls"]
    assert call.pop("name") == "deploy PngEncoder"
    node.rpc("eth_sendTransaction", call | {"from": node.rpc("eth_accounts")[1]})
    node.rpc("evm_mine")
    assert "all contracts are deployed already" in deploy(words).out


def test_what_a_node_says_is_no_command_for_the_terminal(node: Anvil, deploy: Shackled, shackled: Shackled) -> None:
    owned = "\x1b]0;owned\x07\x1b[2J\x1b[1;1Hall is well\x1b[8m\x9b2J\u202e"
    with serving(lambda _: failure(owned)) as url:
        told = deploy(f"--rpc {url} --private-key-env TEST_KEY --yes --contracts Engine", expect=1)
    assert "all is well" in told.err
    assert all(letter.isprintable() for letter in told.err.rstrip("\n"))
    for name in ("--account", "--standard-json"):
        told = shackled(f"deploy --rpc {node.url} --yes", name, f"no\x1b[2Jfile/{owned}", expect=2)
        assert all(letter.isprintable() for letter in told.err.replace("\n", ""))


def test_a_keystore(node: Anvil, folder: Path, deploy: Shackled, monkeypatch: pytest.MonkeyPatch) -> None:
    keystore = Account.encrypt(bytes.fromhex(KEY[2:]), PASSWORD, kdf="pbkdf2", iterations=1000)
    (folder / "keystore").write_text(json.dumps(keystore))
    words = f"--rpc {node.url} --account keystore --contracts Engine --yes"
    no_terminal = "there is no terminal to ask for the password of keystore: set SHACKLED_PASSWORD"
    assert no_terminal in deploy(words, expect=2).err
    monkeypatch.setenv("SHACKLED_PASSWORD", PASSWORD[:-1])
    assert "the password is wrong" in deploy(words, expect=2).err
    monkeypatch.setenv("SHACKLED_PASSWORD", PASSWORD)
    deploy(words)


def test_nobody_to_ask_and_nobody_to_pay(node: Anvil, deploy: Shackled) -> None:
    told = deploy(f"--rpc {node.url} --private-key-env TEST_KEY", expect=2)
    assert "nothing was sent: there is no terminal to ask for consent; --yes" in told.err
    # what it would cost is told all the same
    assert all(f"{each.gas:,}" in told.err for each in deployments())
    told = deploy(f"--rpc {node.url} --yes", expect=2)
    assert "--account FILE or --private-key-env NAME" in told.err
    assert int(node.rpc("eth_blockNumber"), 16) == 0


@pytest.mark.parametrize(("answer", "code", "blocks"), [("n", 1, 0), ("y", 0, 1)])
def test_asking(node: Anvil, folder: Path, answer: str, code: int, blocks: int) -> None:
    """On a terminal; nothing is sent for anything but yes, and the cost is told before."""
    pty = pytest.importorskip("pty")
    command = [sys.executable, "-m", "shackled", "deploy", "--rpc", node.url, "--private-key-env", "TEST_KEY"]
    ours, theirs = pty.openpty()
    with (
        os.fdopen(ours, "wb", buffering=0) as typed,
        child(*command, "--contracts", "Engine", stdin=theirs, stderr=subprocess.STDOUT) as process,
    ):
        os.close(theirs)
        typed.write(f"{answer}\n".encode())
        text, _ = process.communicate(timeout=60)
    assert process.returncode == code
    assert text.index(f"{deployments(['Engine'])[0].gas:,}") < text.index("Send from 0x")
    assert int(node.rpc("eth_blockNumber"), 16) == blocks
    assert KEY[2:] not in text


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("", "--rpc is missing"),
        ("--rpc nowhere", "--rpc must be the address of a node"),
        ("--rpc URL --contracts Nothing", "there is no contract 'Nothing' to deploy"),
        ("--rpc URL --contracts ,", "--contracts is empty"),
        ("--rpc URL --account none --yes", "there is no keystore file none"),
        ("--rpc URL --account shape.obj --yes", "shape.obj is not a keystore file"),
        ("--rpc URL --private-key-env NO_SUCH --yes", "environment variable NO_SUCH"),
        (f"--rpc URL --private-key-env {KEY} --yes", "give the name of a variable, not the key"),
        ("--rpc URL --account x --private-key-env TEST_KEY", "give one of them"),
        ("--rpc URL --rpc-timeout 0", "--rpc-timeout must be more than 0 seconds"),
        *((f"PAID --max-fee {fee}", "--max-fee must be") for fee in ("0", "-1", "nan", "1e12")),
        ("PAID --standard-json shape.obj", "shape.obj is a file, not a folder to write to"),
    ],
)
def test_bad_input(node: Anvil, paid: str, deploy: Shackled, words: str, message: str) -> None:
    """It is told before anything is paid."""
    told = deploy(words.replace("URL", node.url).replace("PAID", paid), expect=2)
    assert message in told.error
    assert int(node.rpc("eth_blockNumber"), 16) == 0


def test_a_broken_book_is_told_first(
    node: Anvil, book: Path, paid: str, deploy: Shackled, monkeypatch: pytest.MonkeyPatch
) -> None:
    book.parent.mkdir()
    book.write_text("{")
    assert f"the address book {book} is damaged" in deploy(paid, expect=2).err
    # one that cannot be written
    monkeypatch.setenv(VARIABLE, str(book / "book.json"))
    assert "book.json cannot be" in deploy(paid, expect=2).err
    assert int(node.rpc("eth_blockNumber"), 16) == 0


def test_other_nodes(node: Anvil, paid: str, deploy: Shackled) -> None:
    assert "belongs to chain 31337, not to chain 1" in deploy(f"{paid} --chain-id 1", expect=1).err
    assert int(node.rpc("eth_blockNumber"), 16) == 0
    url = f"http://127.0.0.1:{free_port()}"
    assert "cannot be reached" in deploy(f"--rpc {url} --private-key-env TEST_KEY", expect=1).err


def test_errors_show_no_key(node: Anvil, deploy: Shackled) -> None:
    """Not even if a node repeats what it was sent, or the address has one."""

    def answer(request: dict[str, Any]) -> Reply:
        if request["method"] == "eth_sendRawTransaction":
            return failure(f"no, at /v2/secret-of-the-node: {request['params'][0]}")
        return forward(node.url, request)

    with serving(answer) as url:
        told = deploy(f"--rpc {url}/v2/secret-of-the-node --private-key-env TEST_KEY --yes", expect=1)
    assert "the transaction was refused" in told.err
    assert "secret-of-the-node" not in told.err + told.out
