"""No figure of benchmarks/studio.json and benchmarks/motion.json may rise unnoticed."""

from __future__ import annotations

import warnings
from typing import Any

import pytest
from benchmarks import motion, studio
from benchmarks.snapshot import changes


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("benchmark", [studio, motion], ids=["studio", "motion"])
def test_no_figure_rises(benchmark: Any) -> None:
    command, name = f"python -m {benchmark.__name__}", benchmark.FILE.stem
    worse, better = changes({name: benchmark.recorded()}, {name: benchmark.take()})
    if better:
        warnings.warn("\n  ".join([f"figures have fallen, run {command}:", *better]), stacklevel=1)
    assert not worse, "\n  ".join([f"figures have risen; if for a good reason, run {command}:", *worse])


def test_most_turntables_fit_a_call() -> None:
    assert len(motion.fitting(motion.recorded())) >= 20


def test_the_documentation_has_them() -> None:
    assert motion.table(motion.recorded()) in motion.PAGE.read_text("utf-8"), "run python -m benchmarks.motion"
    for table in (studio.meshes, studio.pictures):
        assert table(studio.recorded()) in studio.PAGE.read_text("utf-8"), "run python -m benchmarks.studio"
