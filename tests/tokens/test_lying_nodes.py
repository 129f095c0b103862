"""Nodes that lie about prices: what is paid is never above what was quoted, or nothing is sent."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest

from nodes import Node
from open_sales import open_sale
from proxies import Liar
from shackled.chain._address_book import VARIABLE
from shackled.cli.app import run
from shackled.tokens import plan_storage, store
from shackled.tokens._demo import development_accounts

ETHER, GWEI = 10**18, 10**9
USER = 3
#: Runs a command, with lies of the node.
Pay = Callable[..., tuple[int, int, str, str]]
TRIANGLE = "v 0 1 0\nv -1 -1 0\nv 1 -1 0\nf 1 2 3\n"

#: Everything that costs something, with the contracts there that it needs.
COMMANDS = {
    "mint": ("token", "mint", "2"),
    "deploy": ("deploy", "--contracts", "Original"),
    "reveal": ("token", "reveal"),
    "store": ("store", "triangle.obj", "--licence", "MIT", "--size", "8"),
}


#: More than all the ether of the account, for the gas of a mint.
DEAR = hex(2_000_000 * GWEI)


def latest(change: Callable[[dict[str, Any]], dict[str, Any]]) -> Callable[[Any, list[Any]], Any]:
    """A lie about the last block: of older ones the hash is known."""
    return lambda block, parameters: change(block) if parameters[0] == "latest" else block


TIP = {"eth_maxPriorityFeePerGas": lambda tip, _: DEAR}
NO_BASE = {
    "eth_getBlockByNumber": latest(lambda block: {key: block[key] for key in block if key != "baseFeePerGas"}),
    "eth_gasPrice": lambda price, _: DEAR,
}
GAS = {"eth_estimateGas": lambda gas, _: hex(1000 * int(gas, 16))}
JUMP = {"eth_getBlockByNumber": latest(lambda block: block | {"baseFeePerGas": DEAR})}


@pytest.fixture(scope="module", autouse=True)
def _contracts(running_node: Node, tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Deploy a collection whose sale is open, with a token that can be revealed, and the Studio."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(VARIABLE, str(tmp_path_factory.mktemp("book") / "addresses.json"))
        patch.setenv("KEY", development_accounts()[USER].key.hex())
        owner, _ = open_sale(running_node.connection)
        running_node.mine(200)
        store(plan_storage(running_node.connection, []), owner)
        running_node.rpc("anvil_setNextBlockBaseFeePerGas", hex(GWEI))
        running_node.mine(1)
        yield


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("triangle.obj").write_text(TRIANGLE)


def balance(node: Node) -> int:
    return node.balance(node.accounts[USER])


def ceiling(said: str) -> int:
    """The most that was quoted, in wei."""
    found = re.findall(r"at most ([\d.]+) ether in total", said) or re.findall(r"total.* ([\d.]+)\s*$", said, re.M)
    (most,) = found
    return int(Decimal(most) * ETHER)


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.fixture
def pay(node: Node, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Pay:
    """Runs a command. Without `yes` the node lies as soon as the price was quoted and agreed to.

    Returns the code, what was paid, all that was said, and the last line on stderr.
    """

    def run_it(lies: Any, *arguments: str, yes: bool = False) -> tuple[int, int, str, str]:
        liar = Liar(lies, lying=yes)

        def agree(*_: Any, **__: Any) -> bool:
            liar.lying = True
            return True

        if not yes:
            monkeypatch.setattr("sys.stdin", Terminal())
            monkeypatch.setattr("click.confirm", agree)
        before = balance(node)
        with liar.before(node.url) as url:
            code = run([*arguments, "--rpc", url, "--private-key-env", "KEY", *(["--yes"] if yes else [])])
        said = capsys.readouterr()
        assert "Traceback" not in said.err
        return code, before - balance(node), said.out + said.err, (said.err.splitlines() or [""])[-1]

    return run_it


@pytest.mark.parametrize("lies", [TIP, NO_BASE], ids=["tip", "no base"])
@pytest.mark.parametrize("what", COMMANDS)
def test_later_fees_change_nothing(pay: Pay, what: str, lies: Any) -> None:
    code, paid, said, _ = pay(lies, *COMMANDS[what])
    assert code == 0, said
    assert 0 < paid <= ceiling(said)


@pytest.mark.parametrize(
    ("lies", "words"),
    [(GAS, "estimates .* gas for this, and at most .* were quoted"), (JUMP, "the price of gas has risen")],
    ids=["gas", "base"],
)
@pytest.mark.parametrize("what", COMMANDS)
def test_whoever_wants_more_than_was_quoted_gets_nothing(pay: Pay, what: str, lies: Any, words: str) -> None:
    code, paid, said, error = pay(lies, *COMMANDS[what])
    assert (code, paid) == (1, 0), said
    assert re.search(rf"^shackled: .*{words}.*run the command again", error)


@pytest.mark.parametrize(
    ("lies", "words"),
    [
        (TIP, "suggests a tip of 2,000,000 gwei per unit of gas, more than 3"),
        (NO_BASE, "reports no base fee, and asks for 2,000,000 gwei per unit of gas"),
        (GAS, "more than 10 times as much"),
    ],
    ids=["tip", "no base", "gas"],
)
@pytest.mark.parametrize("what", COMMANDS)
def test_a_first_price_that_is_a_lie_is_refused_unasked(pay: Pay, what: str, lies: Any, words: str) -> None:
    code, paid, said, error = pay(lies, *COMMANDS[what], yes=True)
    assert (code, paid) == (1, 0), said
    assert re.search(rf"^shackled: .*{words}.*--max-fee", error)


@pytest.mark.parametrize("what", COMMANDS)
def test_a_price_that_is_named_is_the_most(pay: Pay, what: str) -> None:
    code, paid, said, _ = pay(TIP, *COMMANDS[what], "--max-fee", "50", yes=True)
    assert code == 0, said
    assert paid <= ceiling(said)


def test_a_price_above_the_one_that_is_named_is_not_paid(pay: Pay) -> None:
    for lies in (JUMP, NO_BASE):
        code, paid, _, error = pay(lies, *COMMANDS["mint"], "--max-fee", "50", yes=True)
        assert (code, paid) == (1, 0)
        assert "a unit of gas costs 2,000,000 gwei now, more than the 50 of --max-fee" in error


def test_an_event_without_topics_hides_no_token(pay: Pay) -> None:
    odd = {"address": "0x" + "12" * 20, "topics": [], "data": "0x"}
    lies = {"eth_getTransactionReceipt": lambda receipt, _: receipt | {"logs": [odd, *receipt["logs"]]}}
    code, paid, said, _ = pay(lies, *COMMANDS["mint"], yes=True)
    assert (code, paid > 0) == (0, True), said
    assert "minted #1, #2" in said


@pytest.mark.parametrize("odd", ["zz", {}, None, *({"gasUsed": value} for value in ("zz", 1.5, -5, [300], "0x7"))])
def test_blocks_that_are_none_reveal_nothing(pay: Pay, odd: Any) -> None:
    def lie(block: Any, parameters: Any) -> Any:
        return block if parameters[0] == "latest" else block | odd if odd and isinstance(odd, dict) else odd

    code, paid, said, error = pay({"eth_getBlockByNumber": lie}, *COMMANDS["reveal"], yes=True)
    assert (code, paid) == (1, 0), said
    assert re.search("does not have block|an invalid block|a wrong header of block", error)
