"""No figure of benchmarks/gas.json may rise unnoticed."""

from __future__ import annotations

import warnings

import pytest
from benchmarks import shared, snapshot


@pytest.fixture(scope="module")
def measured(each_evm: None) -> snapshot.Snapshot:
    return snapshot.take()


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("group", ["contracts", "scenes", "unit costs", "scenes of the cost table"])
@pytest.mark.slow
def test_no_figure_rises(group: str, measured: snapshot.Snapshot) -> None:
    if group not in measured:
        pytest.skip(shared.SKIPPED)
    worse, better = snapshot.changes(snapshot.recorded(), {group: measured[group]})
    if better:
        warnings.warn("\n  ".join(["figures have fallen, run `make gas`:", *better]), stacklevel=1)
    assert not worse, "\n  ".join(["figures have risen; if that has a good reason, run `make gas`:", *worse])


def test_a_rise_is_found_and_told_with_its_size() -> None:
    old = {"scenes": {"a": 1000, "b": 1000, "c": 5}}
    assert snapshot.changes(old, {"scenes": {"a": 1001, "b": 990, "c": 5}}) == (
        ["a: 1,000 -> 1,001 (+1, +0.10%)"],
        ["b: 1,000 -> 990 (-10, -1.00%)"],
    )
    assert snapshot.changes(old, {"scenes": {"a": 1000, "b": 1000, "d": 7}}) == (
        ["d: 7, not recorded yet"],
        ["c: 5, not measured any more"],
    )
    assert snapshot.changes(old, {}) == ([], [])
