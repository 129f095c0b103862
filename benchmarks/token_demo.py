"""The gas of `shackled token demo`, on a real node: every action of both collections beside the original's.

    python -m benchmarks.token_demo

starts an anvil, runs the demo, and writes token-demo.md. The pictures of Genesis, and with them the gas of their
`tokenURI`, are others each time, as the chain draws them; benchmarks/tokens.py has exact figures of fixed seeds.
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

Made by `python -m benchmarks.token_demo`: what `shackled token demo` pays on a fresh anvil, at its default limits.
Of transactions all gas that was paid, of `tokenURI` the execution alone. The original, the Shackled contracts of 2021:
mint 1 and mint 5 as measured, `tokenURI` from 5,700 to 14,400 million.

"""


def main() -> int:
    """The command."""
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
