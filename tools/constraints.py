"""Write tools/constraints.txt: the exact version of each package with which the project is built and tested.

    python3.11 tools/constraints.py

installs the newest versions that pyproject.toml allows in an empty environment, and writes down which they are. Then
`make clean test` tries them. tools/prepare.py installs these; the constraints are for the version of Python that made
them, and others take what pyproject.toml allows.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CONSTRAINTS = ROOT / "tools" / "constraints.txt"
EXTRAS = "bench,cluster,draco,jupyter,mp4,pyevm,pyrevm"
HEAD = "# The versions with which the project is tested; written by tools/constraints.py, which says how.\n"


def main() -> None:
    """Write the file."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        pip = [f"{folder}/bin/python", "-m", "pip"]
        subprocess.run([*pip, "install", "--quiet", "--upgrade", "pip"], check=True)
        wanted = ["--editable", f"{ROOT}[{EXTRAS}]", "--group", f"{ROOT / 'pyproject.toml'}:dev"]
        subprocess.run([*pip, "install", "--quiet", *wanted], check=True)
        frozen = subprocess.run([*pip, "freeze", "--exclude-editable"], check=True, capture_output=True, text=True)
    CONSTRAINTS.write_text(constraints(frozen.stdout, sys.version_info[:2]))


def constraints(frozen: str, python: tuple[int, int]) -> str:
    """Return the text of the file, from the output of `pip freeze` under a version of Python."""
    marker = f"python_version == '{python[0]}.{python[1]}'"
    return HEAD + "".join(f"{line} ; {marker}\n" for line in frozen.splitlines() if "==" in line)


if __name__ == "__main__":
    main()
