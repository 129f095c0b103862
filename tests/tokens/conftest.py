"""A development node for the tests of a file, and commands that run against it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from nodes import ANVIL, PUBLIC, anvil
from shackled.chain import VARIABLE
from shackled.cli.app import run
from shackled.tokens._demo import development_accounts
from tokens.on_a_node import Node, Said, Shackled


@pytest.fixture(scope="module")
def node(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Node]:
    """An anvil as it starts without options, one for each file of tests, with an address book of its own."""
    if ANVIL is None:
        pytest.skip("anvil is not installed: npm ci in contracts/")
    with anvil(*PUBLIC) as started, pytest.MonkeyPatch.context() as patch:
        patch.setenv(VARIABLE, str(tmp_path_factory.mktemp("book") / "addresses.json"))
        accounts = development_accounts()
        keys = [f"KEY_{number}" for number in range(len(accounts))]
        for name, account in zip(keys, accounts, strict=True):
            patch.setenv(name, account.key.hex())
        yield Node(started.url, [str(account.address) for account in accounts], keys)


@pytest.fixture(scope="module")
def allow_list(node: Node, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file for `--allow-list`: the second user may mint 2 tokens, the last one 7."""
    path = tmp_path_factory.mktemp("list") / "friends.csv"
    path.write_text(f"account,quantity\n{node.accounts[1]},2\n{node.accounts[9]},7\n")
    return path


@pytest.fixture
def shackled(node: Node, capsys: pytest.CaptureFixture[str]) -> Shackled:
    """Runs a command against the node. `user`: the number of the account that signs. No key may be shown."""
    secrets = [account.key.hex() for account in development_accounts()]

    def command(*arguments: object, user: int | None = None, expect: int = 0) -> Said:
        signer = [] if user is None else ["--private-key-env", node.keys[user]]
        code = run([*map(str, arguments), "--rpc", node.url, *signer])
        captured = capsys.readouterr()
        said = Said(code, captured.out, captured.err)
        assert not any(secret in said.out + said.err for secret in secrets), "a key was shown"
        assert "Traceback" not in said.err
        assert code == expect, said
        return said

    return command
