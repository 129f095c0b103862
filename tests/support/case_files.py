"""Files that the table of cases names by how they are made: each function writes one into a folder and returns it."""

from __future__ import annotations

from pathlib import Path

#: A square that fills the picture of `test_cases.PLAIN`, in OBJ.
SQUARE = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"


def square_obj(folder: Path) -> Path:
    """Write a square without a colour."""
    path = folder / "square.obj"
    path.write_text(SQUARE)
    return path
