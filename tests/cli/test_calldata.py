"""--calldata, which several commands have."""

from __future__ import annotations

import pytest

from commands import Shackled


@pytest.mark.parametrize("command", ["deploy", "store icons/die", "library store cube", "token reveal"])
def test_a_file_that_cannot_be_written_is_told_before_the_node_is_asked(command: str, shackled: Shackled) -> None:
    for path, words in ((".", "is a folder"), ("none/calls.json", "does not exist")):
        said = shackled(f"{command} --rpc http://127.0.0.1:1 --calldata {path}", expect=2).err
        assert words in said
        assert "list of transactions" in said
