"""--calldata, which several commands have."""

from __future__ import annotations

from pathlib import Path

import pytest

from shackled.cli.app import run

COMMANDS = {
    "deploy": ("deploy",),
    "store": ("store", "icons/die"),
    "library": ("library", "store", "cube"),
    "reveal": ("token", "reveal"),
}


@pytest.mark.parametrize("command", COMMANDS.values(), ids=COMMANDS)
def test_a_file_that_cannot_be_written_is_told_before_the_node_is_asked(
    command: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    node = ("--rpc", "http://127.0.0.1:1")
    for path, words in ((tmp_path, "is a folder"), (tmp_path / "none" / "calls.json", "does not exist")):
        assert run([*command, *node, "--calldata", str(path)]) == 2
        said = capsys.readouterr().err
        assert words in said
        assert "list of transactions" in said
