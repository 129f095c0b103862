"""The written figures of tiles are those of the contracts."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from attrs import evolve
from benchmarks.parallel import GRIDS, SIDES

from shackled.bench import gas
from shackled.datasets import require
from shackled.parallel._tiles import grid

FIGURES = json.loads((Path(__file__).parents[2] / "benchmarks" / "parallel.json").read_text("utf-8"))


@pytest.mark.parametrize("side", SIDES[:3])
def test_gas_of_tiles(side: int) -> None:
    scene, written = evolve(require("teapot").make(), width=side, height=side), FIGURES["Tiles"][str(side)]
    assert written["whole"] == gas(scene)
    for across, down in GRIDS[:3]:
        parts = grid(side, side, side // across, side // down)
        assert written[f"{across} x {down}"] == sum(gas(scene, "renderTile", part) for part in parts)


def test_few_strips_cost_about_as_much_as_squares() -> None:
    for written in FIGURES["Tiles"].values():
        assert written["1 x 4"] < 1.02 * written["2 x 2"]
        # of 128 rows, two each
        assert written["1 x 64"] < 1.18 * written["8 x 8"]
