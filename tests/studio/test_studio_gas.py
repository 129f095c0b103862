"""No figure of benchmarks/studio.json may rise unnoticed."""

from __future__ import annotations

import warnings

import pytest
from benchmarks import studio
from benchmarks.snapshot import changes


@pytest.mark.filterwarnings("default")
def test_no_figure_rises() -> None:
    worse, better = changes({"studio": studio.recorded()}, {"studio": studio.take()})
    if better:
        warnings.warn("\n  ".join(["figures have fallen, run python -m benchmarks.studio:", *better]), stacklevel=1)
    assert not worse, "\n  ".join(
        ["figures have risen; if for a good reason, run python -m benchmarks.studio:", *worse]
    )


def test_the_documentation_has_them() -> None:
    page = studio.PAGE.read_text("utf-8")
    assert studio.meshes(studio.recorded()) in page, "run python -m benchmarks.studio"
    assert studio.pictures(studio.recorded()) in page, "run python -m benchmarks.studio"
