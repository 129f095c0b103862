"""Messages of the library name parameters; those of the command name options."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import shackled
from shackled import InputError
from shackled.cli.option import OPTIONS, with_options

SOURCE = Path(shackled.__file__).parent


def test_parameters_become_options() -> None:
    assert with_options("`jobs` must be\n from 1; see `timeout`") == "--jobs must be from 1; see --rpc-timeout"
    assert with_options("`fov` and `half_height` exclude each other") == "--fov and --half-height exclude each other"
    assert with_options("`ls` is `no option`") == "`ls` is `no option`"


def test_python_is_told_of_parameters() -> None:
    with pytest.raises(InputError, match=r"^`jobs` must be a whole number from 1 to 256, not 0$"):
        shackled.render("cube", on=shackled.Processes(0))


def test_every_parameter_that_a_message_names_has_an_option() -> None:
    named = set()
    for folder in ("chain", "deploy", "parallel", "tokens", "gas"):
        for path in (SOURCE / folder).rglob("*.py"):
            without = re.sub(r'"""(?:.|\n)*?"""|#[^\n]*', "", path.read_text())
            named |= set(re.findall(r"`(\w+)`", without))
    assert named <= OPTIONS.keys(), named - OPTIONS.keys()


def test_the_library_names_no_options() -> None:
    for folder in ("chain", "deploy", "parallel", "tokens"):
        for path in (SOURCE / folder).rglob("*.py"):
            assert not re.search(r"[ (\"']--[a-z]", path.read_text()), path
