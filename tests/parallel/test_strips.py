"""Canvases so large that strips are cheaper than the whole; and the written figures of tiles."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from attrs import evolve
from benchmarks.parallel import GRIDS, SIDES

import shackled
from shackled import Scene, load
from shackled.bench._measure import gas as gas_of
from shackled.chain import open_chain
from shackled.chain._chain import ContractChain
from shackled.datasets._pieces import require
from shackled.parallel._backends import ChainBackend
from shackled.parallel._estimate import estimate
from shackled.parallel._job import plan
from shackled.parallel._tiles import grid
from shackled.parallel.places import RenderOptions
from shackled.scene._codec import Rectangle

FIGURES = json.loads((Path(__file__).parents[2] / "benchmarks" / "parallel.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def chain() -> ContractChain:
    return open_chain()


@pytest.fixture(scope="module")
def teapot() -> Scene:
    return load("teapot", size=1024, shading="flat")


def heights(scene: Scene, chain: ContractChain, gas: int | None = None) -> list[int]:
    tiles = plan(scene, 1, [ChainBackend(chain, gas=gas)], estimate(scene), None)
    assert all(tile.width == scene.width for tile in tiles)
    return [tile.height for tile in tiles]


def test_the_picture_is_the_same_for_less_gas(teapot: Scene, chain: ContractChain) -> None:
    whole = shackled.render(teapot, tile=1024)
    image = shackled.render(teapot)
    assert whole.calls == 1 < image.calls
    assert image == evolve(whole, **{name: getattr(image, name) for name in COSTS})
    assert image.gas is not None
    assert image.intrinsic_gas is not None
    assert whole.gas is not None
    assert whole.intrinsic_gas is not None
    assert image.gas + image.intrinsic_gas < 0.85 * (whole.gas + whole.intrinsic_gas)
    rows = 1024 // image.calls
    strips = [chain.draw(teapot, Rectangle(0, y, 1024, rows)).gas or 0 for y in range(0, 1024, rows)]
    assert (image.gas, image.call_gas) == (sum(strips), max(strips))
    assert (image.triangles, image.covered_pixels) == chain.count(teapot)


#: What differs between a picture of one call and one of several.
COSTS = ("gas", "intrinsic_gas", "calls", "call_gas")


def test_no_other_number_of_strips_is_much_cheaper(teapot: Scene, chain: ContractChain) -> None:
    def cost(rows: int) -> int:
        image = shackled.render(teapot, tile=(1024, rows))
        return (image.gas or 0) + (image.intrinsic_gas or 0)

    (rows, *_) = heights(teapot, chain)
    assert cost(rows) < 1.02 * min(cost(other) for other in (64, 128, 256, 512))


def test_small_pictures_are_one_call(chain: ContractChain) -> None:
    small = load("cube", size=1000)
    assert RenderOptions().is_one_call(small)
    assert heights(small, chain) == [1000]
    assert not RenderOptions().is_one_call(evolve(small, width=1024, height=1024))


def test_the_number_of_strips() -> None:
    expected = replace(estimate(load("cube", size=2048)), call=100_000.0, intrinsic=50_000)
    counts = [replace(expected, area=side * side).cheapest_strips() for side in (1023, 1024, 1536, 2048)]
    assert counts[0] == 1
    assert all(fewer < more for fewer, more in pairwise(counts))
    # each costs more: fewer, at least one
    assert replace(expected, call=1e9).cheapest_strips() == 1
    assert replace(expected, call=400_000.0).cheapest_strips() in range(counts[-1] // 3, counts[-1])
    assert replace(expected, call=0.0, intrinsic=1).cheapest_strips() == 32


def test_strips_are_whole_bands(chain: ContractChain) -> None:
    found = heights(load("cube", size=2048), chain)
    # a band has 16,384 pixels
    assert {height % 8 for height in found} == {0}
    assert len(set(found)) == 1


def test_options_win(teapot: Scene, chain: ContractChain) -> None:
    assert shackled.render(teapot, tile=(1024, 512)).calls == 2
    # a limit that needs smaller strips than the cheapest
    assert len(heights(teapot, chain, 10_000_000)) > len(heights(teapot, chain))


def test_frames_and_backgrounds_are_cut_alike(teapot: Scene) -> None:
    calls = shackled.render(teapot).calls
    assert shackled.render(teapot, transparent=True).calls == 2 * calls
    assert shackled.turntable(teapot, frames=2).calls == 2 * calls


@pytest.mark.parametrize("side", SIDES[:3])
def test_gas_of_tiles(side: int) -> None:
    scene, written = evolve(require("teapot").make(), width=side, height=side), FIGURES["Tiles"][str(side)]
    assert written["whole"] == gas_of(scene)
    for across, down in GRIDS[:3]:
        parts = grid(side, side, side // across, side // down)
        assert written[f"{across} x {down}"] == sum(gas_of(scene, "renderTile", part) for part in parts)


def test_few_strips_cost_about_as_much_as_squares() -> None:
    for written in FIGURES["Tiles"].values():
        assert written["1 x 4"] < 1.02 * written["2 x 2"]
        # of 128 rows, two each
        assert written["1 x 64"] < 1.18 * written["8 x 8"]
