"""The users of the tests of tokens on a node, and commands that run against it; collections without a node."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from commands import Said, Shackled
from nodes import Node
from shackled.chain._address_book import VARIABLE, AddressBook
from shackled.cli.app import run
from shackled.ethereum._encoding import checksum_address
from shackled.tokens._demo import development_accounts

if TYPE_CHECKING:
    from tools.tokens.launched import Launched


@pytest.fixture(scope="module")
def users(tmp_path_factory: pytest.TempPathFactory) -> Iterator[list[str]]:
    """The names of environment variables with the keys of the node's accounts; and an address book of the file."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(VARIABLE, str(tmp_path_factory.mktemp("book") / "addresses.json"))
        accounts = development_accounts()
        keys = [f"KEY_{number}" for number in range(len(accounts))]
        for name, account in zip(keys, accounts, strict=True):
            patch.setenv(name, account.key.hex())
        yield keys


@pytest.fixture(scope="module")
def allow_list(running_node: Node, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file for `--allow-list`: the second user may mint 2 tokens, the last one 7."""
    path = tmp_path_factory.mktemp("list") / "friends.csv"
    path.write_text(f"account,quantity\n{running_node.accounts[1]},2\n{running_node.accounts[9]},7\n")
    return path


@pytest.fixture(scope="module")
def genesis(running_node: Node, users: list[str], allow_list: Path) -> str:
    """The address of a closed Genesis collection: 12 tokens are for sale, the other 1,012 kept."""
    sale = ["--price", "0.2", "--reserve", "1012", "--royalty", "7.5", "--allow-list", str(allow_list)]
    sale += ["--signer", running_node.accounts[0], "--rpc", running_node.url]
    assert run(["token", "deploy", "genesis", *sale, "--private-key-env", users[0], "--yes"]) == 0
    found = AddressBook().find(31337, "GenesisCollection")
    assert found is not None
    return checksum_address(found)


@pytest.fixture
def shackled(node: Node, users: list[str], capsys: pytest.CaptureFixture[str]) -> Shackled:
    """Runs a command against the node. `user`: the number of the account that signs. No key may be shown."""
    secrets = [account.key.hex() for account in development_accounts()]

    def command(*arguments: object, user: int | None = None, expect: int = 0) -> Said:
        signer = [] if user is None else ["--private-key-env", users[user]]
        code = run([*map(str, arguments), "--rpc", node.url, *signer])
        captured = capsys.readouterr()
        said = Said(code, captured.out, captured.err)
        assert not any(secret in said.out + said.err for secret in secrets), "a key was shown"
        assert "Traceback" not in said.err
        assert code == expect, said
        return said

    return command


@pytest.fixture
def s() -> Launched:
    """The collections in a world of their own, as they are deployed."""
    from tools.tokens.launched import launched

    return launched()
