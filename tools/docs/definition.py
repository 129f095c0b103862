"""A hook of the documentation: lines of the form `{picture.py: draw, fill}` become the source of these functions."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import Any

FILE = Path(__file__).resolve().parents[2] / "contracts" / "picture.py"
LINE = re.compile(r"^\{picture\.py: ([\w, .]+)\}$", re.M)


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Return the text of a page with the sources that it names. KeyError for a name that picture.py does not have."""
    return LINE.sub(_included, markdown)


def _included(line: re.Match[str]) -> str:
    text = FILE.read_text("utf-8")
    sources = {each.name: each for each in ast.parse(text).body if isinstance(each, ast.FunctionDef | ast.ClassDef)}
    parts = [ast.get_source_segment(text, sources[name.strip()]) for name in line[1].split(",")]
    return "```python\n" + "\n\n\n".join(part or "" for part in parts) + "\n```"


def named(markdown: str) -> set[str]:
    """Return the functions that a page includes."""
    return {name.strip() for line in LINE.finditer(markdown) for name in line[1].split(",")}
