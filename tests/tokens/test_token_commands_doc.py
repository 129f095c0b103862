"""Every command that the documentation shows is one that there is, with options that there are."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from typer.main import get_command

from shackled.cli.app import app

PAGE = Path(__file__).parents[2] / "docs" / "token-commands.md"
COMMANDS = re.findall(r"^(?:\$ )?(shackled (?:token|mint) .*)$", PAGE.read_text("utf-8"), re.MULTILINE)


@pytest.mark.parametrize("line", COMMANDS)
def test_the_command_is_there(line: str) -> None:
    words = shlex.split(line, comments=True)[1:]
    command = get_command(app)
    while words and hasattr(command, "commands"):
        command = command.commands[words.pop(0)]
    known = {option for parameter in command.params for option in parameter.opts}
    assert {word for word in words if word.startswith("-")} <= known
