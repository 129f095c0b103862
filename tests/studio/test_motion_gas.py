"""No figure of benchmarks/motion.json may rise unnoticed."""

from __future__ import annotations

import warnings

import pytest
from benchmarks import motion
from benchmarks.snapshot import changes


@pytest.mark.filterwarnings("default")
def test_no_figure_rises() -> None:
    worse, better = changes({"motion": motion.recorded()}, {"motion": motion.take()})
    if better:
        warnings.warn("\n  ".join(["figures have fallen, run python -m benchmarks.motion:", *better]), stacklevel=1)
    assert not worse, "\n  ".join(
        ["figures have risen; if for a good reason, run python -m benchmarks.motion:", *worse]
    )


def test_most_turntables_fit_a_call() -> None:
    assert len(motion.fitting(motion.recorded())) >= 20


def test_the_documentation_has_them() -> None:
    assert motion.table(motion.recorded()) in motion.PAGE.read_text("utf-8"), "run python -m benchmarks.motion"
