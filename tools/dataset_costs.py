"""Measure every piece that comes with the package: src/shackled/datasets/gas.json.

python tools/dataset_costs.py            write the file
python tools/dataset_costs.py --check    say where it is wrong
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from shackled.cli.progress import LateBar
from shackled.datasets import pieces
from shackled.datasets._drawing import draw_all
from shackled.datasets.common._models import models

FILE = Path(__file__).resolve().parent.parent / "src" / "shackled" / "datasets" / "gas.json"


def main() -> int:
    """Measure the pieces and write the file."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="change nothing; exit code 1 if the file is wrong")
    check = parser.parse_args().check
    builtin = [piece for piece in pieces() if piece.name not in models()]
    with LateBar("drawing") as bar:
        costs = {}
        for drawing in draw_all(builtin):
            costs[drawing.name] = (drawing.triangles, drawing.gas)
            bar.set(len(costs), len(builtin))
    rows = [f"{json.dumps(piece.name)}: {json.dumps(costs[piece.name])}" for piece in builtin]
    text = "{\n" + ",\n".join(rows) + "\n}\n"
    if not check:
        FILE.write_text(text, "utf-8")
        return 0
    if FILE.is_file() and FILE.read_text("utf-8") == text:
        return 0
    print(f"{FILE.name} is out of date; run: python tools/dataset_costs.py", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
