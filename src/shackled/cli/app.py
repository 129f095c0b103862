"""The command `shackled` and its exit codes: 0 for success, 2 for wrong usage or bad input, 1 for other failures."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path

import click

from ..base.synonyms import HINTS, SYNONYMS
from ..base.untrusted import plain
from ..errors import InputError, InputWarning, ShackledError
from .command import CommandGroup
from .option import MEANT, option_names, with_options
from .output import noting

datasets = CommandGroup(
    "datasets",
    {name: f"datasets:{name}" for name in ("list", "fetch", "gallery")},
    "List, fetch and show the pieces of the datasets.",
)
library = CommandGroup(
    "library",
    {"list": "store:list", "store": "store:store_items"},
    "List and store the library: icons and common objects that any contract can draw.",
)
edition = CommandGroup(
    "edition",
    {name: f"token.edition:{name}" for name in ("add", "mint", "list", "close", "withdraw")},
    "Add your own scenes to the collection Editions, and mint them.",
)
token = CommandGroup(
    "token",
    {
        "deploy": "token.deploy:deploy",
        **{name: f"token.owner:{name}" for name in ("add", "seal", "allow-list", "permit", "phase")},
        **{name: f"token.sale:{name}" for name in ("mint", "reveal")},
        **{name: f"token.show:{name}" for name in ("show", "list", "verify", "picture")},
        "transfer": "token.sale:transfer",
        **{name: f"token.owner:{name}" for name in ("withdraw", "royalty", "transfer-ownership", "accept-ownership")},
        "demo": "token.deploy:demo",
        "edition": edition,
    },
    "Deploy and use collections of tokens whose pictures are rendered on chain.",
)
#: How the help of each command begins, which is that of its function, so that none is loaded to list them.
LINES = {
    "render": "Render mesh files, scene files or pieces of datasets.",
    "export": "Write a scene as an interactive HTML page in one file, which needs no network, or as a .glb model.",
    "info": "Show what a file contains, what is left out, and what its pictures cost.",
    "gas": "Measure the gas of a picture: exactly, by binary search, by stage and by line, and compare it with limits.",
    "bench": "Run the experiments of the Shackled paper: gas against canvas, triangles, culling and more.",
    "genesis": "Generate Genesis pieces from seeds in the contract.",
    "stages": "Draw the result of each stage of the pipeline: six pictures, and a strip with all of them.",
    "deploy": "Deploy the contracts, at the same addresses on every chain.",
    "store": "Store an object on a chain; any contract can then draw it.",
    "creator": "Make pictures on a page in the browser, without code; all data stays on this machine.",
    "preview": "Show the tokens of a Solidity contract, and their gas, on a page that updates when a source changes.",
}


GROUPS = (datasets, library, token)


class Root(CommandGroup):
    """The command itself, which lists its commands without loading them, and knows other words for them."""

    strict = frozenset({"render", "export", "info", "gas", "stages", "store", "preview"})

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command. UsageError, which names the right one, for another word."""
        if args[0] in MEANT and not ctx.resilient_parsing:
            ctx.fail(f"no such command {args[0]}: it is {MEANT[args[0]]}")
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the first lines of the help of all commands."""
        with formatter.section("Commands"):
            formatter.write_dl([*LINES.items(), *((each.name or "", each.help or "") for each in GROUPS)])


app = Root(
    "shackled",
    {
        **{name: f"{name}:{name}" for name in LINES},
        "stages": "render:stages",
        **{str(each.name): each for each in GROUPS},
    },
    "Render 3D scenes with Ethereum smart contracts.",
)


click.version_option(
    package_name="shackled", prog_name="shackled", message="%(prog)s %(version)s", help="Print the version and exit."
)(app)


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code. Errors and warnings are printed on stderr, one line each."""
    try:
        with noting("always"):
            code = app.main(arguments, "shackled", standalone_mode=False)
        # at the end of the interpreter, a failure to write could not be reported
        sys.stdout.flush()
        return int(code or 0)
    except ExceptionGroup as group:
        # of several inputs; the others were rendered
        for error in group.exceptions:
            _fail(error, 1)
        return _fail(group.message, 1)
    except (InputError, InputWarning) as error:
        return _fail(error, 2)
    except ShackledError as error:
        return _fail(error, 1)
    except (KeyboardInterrupt, click.Abort):
        return _fail("stopped", 1)
    except click.ClickException as error:
        return _fail(_meant(error) or error.format_message(), error.exit_code)
    except OSError as error:
        # for instance, the disk to which the output is redirected is full
        _drop_output()
        where = f"{error.filename}: " if error.filename else ""
        return _fail(f"{where}{error.strerror or repr(error)}", 1)


def _meant(error: click.ClickException) -> str | None:
    """Return what a usage error with another word for an option says; None for other errors."""
    if not isinstance(error, click.NoSuchOption) or error.ctx is None:
        return None
    given, known = error.option_name, {name for each in error.ctx.command.params for name in each.opts}
    keyword = given.lstrip("-").replace("-", "_")
    right = MEANT.get(given) or option_names().get((SYNONYMS["look"] | SYNONYMS["render"]).get(keyword, ""))
    if right in known:
        return f"no such option {given}: it is {right}"
    if len(given) == 2:
        return f"no such option {given}; before a file whose name begins with -, put --"
    return f"no such option {given}: {HINTS[keyword]}" if keyword in HINTS and "--fov" in known else None


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
