"""The table of features: each that is kept has tests, and each of these exists."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = (ROOT / "tests", ROOT / "web" / "tests")


def rows() -> list[list[str]]:
    text = Path(__file__).with_name("features.md").read_text()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]


def test_each_kept_feature_has_tests_that_exist() -> None:
    known = set()
    for path in (*FOLDERS[0].rglob("test_*.py"), *FOLDERS[1].glob("*.test.ts")):
        names = re.findall(r"^def (test_\w+)|^test\(\s*[\"`]([^\"`]+)", path.read_text(), re.MULTILINE)
        known |= {(path.name, one or other) for one, other in names}
    head, _rule, *features = rows()
    assert (len(head), len(features) > 60) == (3, True)
    for feature, decision, tests in features:
        if decision.startswith("dropped"):
            assert re.match(r"dropped, because \w", decision), feature
            continue
        assert decision == "kept", feature
        named = re.findall(r"`([\w.-]+)::([^`]+)`", tests)
        assert named, feature
        for name in named:
            assert name in known, f"{feature}: {name}"
