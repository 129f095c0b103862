"""Write the files that are made of tables, and the tables of README and docs.

python -m tools.generated            writes those that have changed, and names them
python -m tools.generated --check    writes nothing; fails, and names the files that are not up to date

Each maker is a module of this folder with a function `files`, which returns the text of each of its files by path. The
table of the library holds addresses of compiled contracts: see `build` in the Makefile.
"""

from __future__ import annotations

import argparse
import sys
from importlib import import_module
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: The makers, in this order: modules of the package need what the first one writes.
MAKERS = (
    "layout",
    "scene_fields",
    "presets",
    "lettering",
    "png_code",
    "library",
    "page_settings",
    "virtual_functions",
    "readme",
)


def stale(maker: str) -> dict[Path, str]:
    """Return the text of each file of a maker that is not up to date."""
    made: dict[Path, str] = import_module(f"tools.{maker}").files()
    return {path: text for path, text in made.items() if not path.is_file() or path.read_text("utf-8") != text}


def main() -> int:
    """Write or check the files."""
    parser = argparse.ArgumentParser(description="Write the files that are made of tables.")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if a file is not up to date")
    check, code = parser.parse_args().check, 0
    for maker in MAKERS:
        for path, text in stale(maker).items():
            name = path.relative_to(ROOT)
            if check:
                print(f"{name} is not as tools/{maker}.py makes it: run python -m tools.generated", file=sys.stderr)
                code = 1
            else:
                path.write_text(text, "utf-8", newline="\n")
                print(f"written: {name}")
    return code


if __name__ == "__main__":
    sys.exit(main())
