"""The command `shackled` and its exit codes: 0 for success, 2 for wrong usage or bad input, 1 for other failures."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from .._version import __version__
from ..errors import InputError, InputWarning, ShackledError
from ..untrusted import plain
from .bench import bench
from .creator import creator
from .datasets import datasets
from .deploy import deploy
from .export import export
from .gas import gas
from .genesis import genesis
from .info import info
from .library import library
from .mint import mint
from .notes import noting, with_strict
from .option import with_options
from .preview import preview
from .render import render
from .stages import stages
from .token import token

#: The exit code with which typer reports a keyboard interrupt.
INTERRUPTED = 130

app = typer.Typer(
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command()(with_strict(render))
app.command()(with_strict(export))
app.command()(with_strict(info))
app.command()(with_strict(gas))
app.command()(bench)
app.command()(genesis)
app.command()(with_strict(stages))
app.command()(deploy)
app.command()(with_strict(mint))
app.command()(creator)
app.command()(with_strict(preview))
app.add_typer(datasets, name="datasets")
app.add_typer(library, name="library")
app.add_typer(token, name="token")


@app.callback(invoke_without_command=True)
def shackled(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version and exit.")] = False,
) -> None:
    """Render 3D scenes with Ethereum smart contracts."""
    if version:
        print(f"shackled {__version__}")
    elif context.invoked_subcommand is None:
        print(context.get_help())


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code. Errors and warnings are printed on stderr, one line each."""
    with noting("always"):
        return _run(arguments)


def _run(arguments: Sequence[str] | None) -> int:
    try:
        code = app(args=arguments, standalone_mode=False, prog_name="shackled")
        # at the end of the interpreter, a failure to write could not be reported
        sys.stdout.flush()
        return _fail("stopped", 1) if code == INTERRUPTED else int(code or 0)
    except ExceptionGroup as group:
        # of several inputs; the others were rendered
        for error in group.exceptions:
            _fail(error, 1)
        return _fail(group.message, 1)
    except (InputError, InputWarning) as error:
        return _fail(error, 2)
    except ShackledError as error:
        return _fail(error, 1)
    except (KeyboardInterrupt, typer.Abort):
        return _fail("stopped", 1)
    except OSError as error:
        # for instance, the disk to which the output is redirected is full
        _drop_output()
        where = f"{error.filename}: " if error.filename else ""
        return _fail(f"{where}{error.strerror or repr(error)}", 1)
    except Exception as error:
        # usage errors, whose class depends on the version of typer
        if not hasattr(error, "format_message"):
            raise
        message, code = error.format_message(), getattr(error, "exit_code", 2)
        # a group without a command has printed its help, and has no message
        return _fail(message, code) if message else int(code)


def _drop_output() -> None:
    """Discard the rest of standard output, which the interpreter would otherwise try to write again at its end."""
    try:
        sys.stdout.flush()
    except OSError:
        with Path(os.devnull).open("w") as nowhere:
            os.dup2(nowhere.fileno(), sys.stdout.fileno())


def _fail(message: object, code: int) -> int:
    print(f"shackled: {plain(with_options(str(message)))}", file=sys.stderr)
    return code
