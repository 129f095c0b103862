"""shackled preview"""

from __future__ import annotations

from pathlib import Path

from ..base.untrusted import plain
from ..errors import VerificationError
from ..ethereum._encoding import checksum_address
from ..preview._preview import Preview, Request, Token
from ..preview._project import CompilerError, Project
from ..preview._report import folded, summary
from ..preview._server import serve
from ..preview._world import MAX_GAS, stored_scene
from .option import argument, need, option
from .output import print_json, print_line, print_note, print_table
from .progress import LateBar

#: Default port of the page.
PORT = 8090


def preview(
    source: Path = argument("Solidity file of the contract.", "FILE"),
    contract: str | None = option("--contract", "Contract in the file; default: the only one with tokenURI.", "NAME"),
    arg: tuple[str, ...] = option(
        "--arg",
        "Value for the constructor; may be repeated. Parameters that are Shackled contracts are filled in.",
        "VALUE",
    ),
    setup: tuple[str, ...] = option(
        "--setup", "Call before tokens are read; may be repeated: 'mint{value: 0.1 ether}(3) x 5'.", "CALL"
    ),
    store: tuple[str, ...] = option(
        "--store",
        "Scene to store in the Studio before the deployment: a piece of a dataset, a mesh or a scene file; "
        "may be repeated. Its pointer is printed.",
        "SCENE",
    ),
    tokens: int | None = option(
        "--tokens", "Number of tokens (default: totalSupply(), at most 256; or 256).", "N", min=1, max=10_000
    ),
    first: int | None = option("--first", "First token (default: 0, or 1).", "N", min=0),
    function: str | None = option(
        "--function", "Function to read (default: tokenURI, uri, image, render or svg).", "NAME"
    ),
    max_gas: int = option("--max-gas", "Gas that a read may take (default: 2^24).", "GAS", min=1, default=MAX_GAS),
    allow_empty: bool = option("--allow-empty", "Accept pictures that show only the background."),
    check: bool = option(
        "--check", "Check all tokens instead of opening a page; the exit code is 1 if one has a problem."
    ),
    as_json: bool = option("--json", "With --check: print one JSON object instead of text."),
    port: int | None = option("--port", f"Port of the page (default: {PORT}, or a free one).", "PORT", min=0),
    browser: bool = option("--browser/--no-browser", "Open the page in the browser.", default=True),
) -> None:
    """Show the tokens of a Solidity contract, and their gas, on a page that updates when a source changes."""
    need("--check", check, {"--json": as_json})
    project = Project(source)
    stored: dict[bytes, bytes] = {}
    for each in store or ():
        stored |= (codes := stored_scene(each))
        print_note(f"{each} is stored at {checksum_address(list(codes)[-1])}")
    request = Request(
        contract, tuple(arg or ()), tuple(setup or ()), function, first, tokens, max_gas, stored, allow_empty
    )
    if check:
        _check(project, request, as_json)
    else:
        serve(project, request, port, PORT, browser)


def _check(project: Project, request: Request, as_json: bool) -> None:
    """Check all tokens. VerificationError if one of them has a problem."""
    found: list[Token] = []
    with LateBar("reading tokens") as bar:
        try:
            made = Preview(project, request)
        except CompilerError as error:
            for line in error.said.splitlines():
                bar.print(plain(line))
            raise
        for token in made.tokens():
            found.append(token)
            bar.set(len(found), made.count)
    wrong = [token for token in found if token.problems]
    gas = [token.gas for token in found if token.gas is not None]
    if as_json:
        gases = {"least": min(gas, default=None), "most": max(gas, default=None), "sum": sum(gas)}
        document = {
            "contract": made.contract.name,
            "function": made.function["name"],
            "max_gas": request.max_gas,
            "gas": gases,
            "problems": made.problems,
            "tokens": [summary(token) for token in found],
        }
        print_json(document)
    else:
        for problem in made.problems:
            print_line(problem)
        if wrong:
            print_table(("tokens", "problem"), folded(wrong))
        if notes := folded(found, "notes"):
            print_table(("tokens", "note"), notes)
        if gas:
            most = max(found, key=lambda token: token.gas or 0)
            print_line(
                f"{made.contract.name}.{made.function['name']}: {len(found)} tokens, {sum(gas) // len(gas):,} gas on "
                f"average, {most.gas or 0:,} at most (token {most.number}), {request.max_gas:,} allowed"
            )
    if wrong:
        hint = made.hint(found)
        raise VerificationError(f"{len(wrong)} of {len(found)} tokens have problems{f'; {hint}' if hint else ''}")
    if made.problems:
        raise VerificationError("a transaction takes more gas than one may")
