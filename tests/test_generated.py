"""The files that are made of tables are up to date."""

from __future__ import annotations

import pytest
from tools.generated import MAKERS, ROOT, stale


@pytest.mark.parametrize("maker", MAKERS)
def test_the_files_are_up_to_date(maker: str) -> None:
    assert [str(path.relative_to(ROOT)) for path in stale(maker)] == [], "run python -m tools.generated"
