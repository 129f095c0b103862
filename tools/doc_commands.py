"""Run the commands of the README and the first command of each page of docs/, in a clean clone, as a reader does.

    python -m tools.doc_commands          a part of `make release-check`

The README's commands run in fresh environments with Node and without it: what needs Node must then say so. A row for
each command; the exit code is 1 if one failed.
"""

from __future__ import annotations

import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

from tools.addresses import ROOT
from tools.anvil import Anvil, find_anvil
from tools.children import child
from tools.release_check import VARIABLES, Skipped, Table, demand, make_environment, run

#: Lines of code blocks, and words in a sentence, that are commands.
LINE = r"^ *(?:\$ )?((?:shackled|make|pip|python|npm|forge) [^#\n]*)"
IN_A_SENTENCE = r"`(make [a-z-]+|shackled creator)`"
#: Commands that are not run, by their beginnings, and why.
SKIPPED = {
    "make test": "continuous integration runs it",
    "shackled preview": "needs a compiler of Solidity and a contract of the reader's",
    "shackled render INPUT": "shows the form of the command",
    "python contracts/picture.py CALL": "CALL is a file of the reader's",
    "shackled deploy": "the account ARTIST is the reader's",
}
#: Commands that need Node.
NEED_NODE = ("shackled creator", "make creator", "make docs", "make npm")
#: What readers have.
SCENE = '[[objects]]\nmesh = { piece = "teapot" }\n'
NODE = "http://127.0.0.1:8545"
KEY = "0xac0974bec39a17e36ba4a6b4d238ff944bacb478cbed5efcae784d7bf4f2ff80"
PATIENCE = 1800


def commands(page: str) -> list[str]:
    """Return the commands of a page in Markdown, in their order."""
    plain = re.sub(r"^ *```(?!sh$)\w+\n.*?^ *```$", "", page, flags=re.MULTILINE | re.DOTALL)
    parts = re.split(r"^ *```(?:sh)?$", plain, flags=re.MULTILINE)
    patterns = (IN_A_SENTENCE, LINE)
    return [each.strip() for n, part in enumerate(parts) for each in re.findall(patterns[n % 2], part, re.MULTILINE)]


class Reader:
    """Somebody with a clean clone and an empty environment, who has Node or has not, and a development node."""

    def __init__(self, work: Path, has_node: bool, url: str) -> None:
        """Make clone and environment. work: an empty folder. url: of the node."""
        self.has_node, self.url, self.clone = has_node, url, work / "clone"
        run("git", "clone", "--quiet", ROOT, self.clone, cwd=work)
        (self.clone / "scene.toml").write_text(SCENE)
        tools = make_environment(Path(sys.executable), work / "environment", "pip").parent
        paths = [str(tools), *os.get_exec_path()]
        if not has_node:
            (others := work / "programs").mkdir()
            found = {each.name: each for path in reversed(paths) for each in Path(path).glob("*")}
            for name in found.keys() - {"node", "nodejs", "npm", "npx"}:
                (others / name).symlink_to(found[name])
            paths = [str(tools), str(others)]
        # `true` opens no page
        more = {"PATH": os.pathsep.join(paths), "BROWSER": "true", "SHACKLED_NO_APT": "1", "KEY": KEY}
        self.variables = {name: value for name, value in VARIABLES.items() if not name.startswith("MAKE")} | more
        self.variables["SHACKLED_ADDRESS_BOOK"] = str(work / "addresses.json")

    def follow(self, command: str, table: Table) -> None:
        """Run a command, with a row for the result."""
        with table.check(command[:60]) as details:
            for start, why in SKIPPED.items():
                if command.startswith(start):
                    raise Skipped(why)
            begin = time.monotonic()
            if "model.glb" in command and not (self.clone / "model.glb").exists():
                self.output("shackled export teapot -o model.glb")
            details += [*self.output(command), f"{time.monotonic() - begin:.0f} s"]

    def output(self, command: str) -> list[str]:
        """Run a command; return what is worth telling. Failure if it fails, or without Node does not ask for it."""
        words = shlex.split(re.sub(rf"{NODE}|\bURL\b", self.url, command))
        options = {"cwd": self.clone, "env": self.variables, "start_new_session": True}
        with child(*words, stderr=subprocess.STDOUT, **options) as process:
            assert process.stdout is not None
            told = ""
            if "creator" in words:
                for line in process.stdout:  # until it serves, or ends
                    told += line
                    if address := re.search(r"http://\S+", line):
                        with urllib.request.urlopen(address[0], timeout=60) as page:
                            demand(b"<script" in page.read(), "the page is not served")
                        os.killpg(process.pid, signal.SIGINT)
                        return ["the page is served"]
            else:
                told = process.communicate(timeout=PATIENCE)[0]
            code = process.wait()
        # make ends with a line that says only that something failed
        last = ["", *re.sub(r"^make: .*", "", told, flags=re.MULTILINE).strip().splitlines()][-1]
        if command.startswith(NEED_NODE) and not self.has_node:
            demand(code and re.search(r"Node(\.js)?\b", told), f"it does not ask for Node: {last}")
            return ["asks for Node"]
        demand(not code, last)
        return []


def main() -> int:
    """Run all commands."""
    table = Table()
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
    readme, *others = (commands(page.read_text("utf-8")) for page in pages)
    first = dict.fromkeys(each[0] for each in others if each)
    binary = find_anvil()
    if binary is None:
        print("anvil is not installed: python3 tools/prepare.py node", file=sys.stderr)
        return 1
    for has_node, wanted in ((True, dict.fromkeys([*readme, *first])), (False, dict.fromkeys(readme))):
        with tempfile.TemporaryDirectory() as folder, Anvil(binary) as node:
            print(f"\nin a clean clone, {'with' if has_node else 'without'} Node:")
            reader = Reader(Path(folder), has_node, node.url)
            for command in wanted:
                reader.follow(command, table)
    return int(table.failed)


if __name__ == "__main__":
    sys.exit(main())
