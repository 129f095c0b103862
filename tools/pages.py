"""Update figures in pages: what stands between the marks <!-- begin NAME --> and <!-- end NAME -->."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: The pages of the documentation, and their pictures.
DOCS = ROOT / "docs"
IMAGES = DOCS / "images"


def update(pages: dict[Path, Callable[[str], str | None]], command: str, check: bool = False) -> int:
    """Write the results of functions of the names of marks between these marks of pages; None leaves what there is.

    command: that brings the pages up to date. check: nothing is written, and pages that are not up to date are named.
    Returns the exit code: 1 if the check fails.
    """
    stale = {
        page: text for page, content in pages.items() if (text := filled(page, content)) != page.read_text("utf-8")
    }
    for page, text in stale.items():
        name = page.relative_to(ROOT)
        if check:
            print(f"{name} is not up to date: run {command}", file=sys.stderr)
        else:
            page.write_text(text, "utf-8", newline="\n")
            print(f"written: {name}")
    return 1 if check and stale else 0


def filled(page: Path, content: Callable[[str], str | None]) -> str:
    """Return the text of a page with new content between its marks."""

    def fill(match: re.Match[str]) -> str:
        new = content(match[2])
        return match[0] if new is None else f"{match[1]}\n{new}\n<!-- end {match[2]} -->"

    text, count = re.subn(r"(<!-- begin (\w+) -->)\n.*?<!-- end \2 -->", fill, page.read_text("utf-8"), flags=re.DOTALL)
    if not count:
        raise SystemExit(f"{page.relative_to(ROOT)} has no marks <!-- begin NAME --> and <!-- end NAME -->")
    return text
