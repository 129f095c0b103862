"""The counts without colours are those of the contract."""

from __future__ import annotations

import pytest

from pictures import chain
from random_scenes import random_case
from shackled import ChainError
from shackled.chain import count_call, returned_counts
from shackled.reference import coverage, draw_call, selector
from shackled.reference.call import read_call
from shackled.scene import encode, encode_scene

#: Scenes of every kind; `tests/differential.py` compares many more with `renderCounted`.
SEEDS = range(40_000, 40_150)


def test_counts_are_those_of_the_contract() -> None:
    drawn = 0
    for seed in SEEDS:
        case = random_case(seed)
        head = count_call(case.scene)
        data = head[:36] + encode_scene(case.scene)
        try:
            expected = returned_counts(chain().call("Renderer", data).output)
        except ChainError:
            continue
        assert coverage.count(*read_call(data)) == expected, seed
        drawn += expected[1] > 0
    assert drawn > len(SEEDS) / 2


def test_counts_of_tiles_are_those_of_pictures() -> None:
    drawn = 0
    for seed in SEEDS[:60]:
        case = random_case(seed)
        try:
            data = encode(selector("renderTile"), case.scene, case.tile)
            picture = draw_call(data)
        except (ChainError, ValueError):
            continue
        assert coverage.count(*read_call(data)) == (picture.triangles, picture.lit_pixels), seed
        drawn += picture.lit_pixels > 0
    assert drawn > 10


def test_many_spans_are_taken_a_part_at_a_time(monkeypatch: pytest.MonkeyPatch) -> None:
    data = [random_case(seed) for seed in SEEDS[:20]]
    calls = [count_call(case.scene)[:36] + encode_scene(case.scene) for case in data]
    whole = [coverage.count(*read_call(each)) for each in calls]
    monkeypatch.setattr(coverage, "AT_ONCE", 1)
    assert [coverage.count(*read_call(each)) for each in calls] == whole
