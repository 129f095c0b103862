"""Measure `shackled token demo` on a real node: every action of Genesis and Icons, compared with the original.

    python -m benchmarks.token_demo

starts an anvil, runs the demo, and writes token-demo.md. The pieces of Genesis, and the gas of their
`tokenURI`, differ from run to run, because the chain determines the seeds; benchmarks/tokens.py measures fixed seeds.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

from tools.anvil import Anvil, find_anvil

from shackled.bench import table
from shackled.chain import VARIABLE
from shackled.tokens import comparison, run_demo

FILE = Path(__file__).with_name("token-demo.md")

HEAD = """# Tokens on a node

Made by `python -m benchmarks.token_demo`: the gas of `shackled token demo` on a fresh anvil, with its default limits.
The figures of transactions include all gas that was paid; those of `tokenURI` are execution only. *Original*: the
Shackled contracts of 2021, as measured; their `tokenURI` took 5,700 to 14,400 million gas.

"""


def main() -> int:
    """Run the demo on an anvil and write token-demo.md."""
    binary = find_anvil()
    if binary is None:
        print("anvil is not installed: npm ci in contracts/", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder, Anvil(binary) as node:
        os.environ[VARIABLE] = str(Path(folder) / "addresses.json")
        demo = run_demo(node.connection, Path(folder) / "demo", lambda text: print(text, file=sys.stderr))
    head, *rows = comparison(demo.costs)
    text = table(head, rows) + "\n"
    print(text, end="")
    FILE.write_text(HEAD + text, "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
