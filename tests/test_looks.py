"""The table of what people render, the table of `--fit`, and the unit costs: their logic, and that pages have them."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve
from benchmarks import fitting, looks, snapshot, unit_costs
from benchmarks.scenes import staged_teapot
from benchmarks.workload import workload_of

from shackled import Scene, load
from shackled.bench._measure import gas


@pytest.fixture(scope="module")
def recorded() -> looks.Figures:
    return looks.recorded()


def test_pages_have_the_last_run(recorded: looks.Figures) -> None:
    gas_page, parallel = (page.read_text("utf-8") for page in looks.PAGES)
    assert looks.table(recorded) in gas_page, "run python -m benchmarks.looks"
    assert looks.opcodes(recorded) in gas_page, "run python -m benchmarks.looks"
    assert looks.strips(recorded) in parallel, "run python -m benchmarks.looks"


def test_figures_are_those_of_the_snapshot(recorded: looks.Figures) -> None:
    """The snapshot is measured again in each run of the tests."""
    taken = snapshot.recorded()
    of_table = taken["scenes of the cost table"]
    smooth = [value for name, value in of_table.items() if name.startswith("obj_") and name.endswith("_cull smooth")]
    lit = [value for name, value in of_table.items() if name.startswith("obj_") and name.endswith("_cull")]
    assert len(smooth) == len(lit) == 15
    same = {
        "cube": of_table["cube_persp_128"],
        "cube 512": of_table["cube_persp_512"],
        "wires": taken["scenes"]["teapot, wireframe, antialiased, 128"],
        "smooth objects": round(np.mean(smooth), 4),
        "lit objects": round(np.mean(lit), 4),
    }
    assert {name: recorded[name] for name in same} == same, "run python -m benchmarks.looks"


def test_ratios_are_those_of_sums() -> None:
    scenes = [staged_teapot("flat", 16), load("cube", size=16)]
    found = looks.ratios({looks.SMOOTH: scenes, looks.RATIOS["icons"]: scenes[:1]})
    plain, smooth = ([gas(evolve(scene, antialias=flag)) for scene in scenes] for flag in (False, True))
    assert found == {"icons, x": smooth[0] / plain[0], "smooth, x": sum(smooth) / sum(plain), "smooth": sum(smooth) / 2}


def test_what_is_lowered() -> None:
    scene = staged_teapot("smooth", 256, antialias=True)
    assert fitting.Lowered("", True).scene(scene) == scene
    lowered = fitting.Lowered("", side=64, triangles=0.5).scene(scene)
    assert (lowered.width, lowered.height, lowered.antialias) == (64, 64, False)
    assert 0 < lowered.triangles <= 0.5 * scene.triangles
    assert fitting.Lowered("", triangles=5000).scene(scene).triangles == scene.triangles


def test_the_way_of_fit_loses_least() -> None:
    """Of the pictures of the tables, none but those on the way of `--fit` is both cheaper and nearer than one on it."""
    text = fitting.PAGE.read_text("utf-8")
    for name in ("coarse", "fine"):
        table = text.partition(f"<!-- begin {name} -->\n")[2].partition(f"\n<!-- end {name} -->")[0]
        rows = [line.strip("| ").split(" | ") for line in table.splitlines()[2:]]
        found = [(title, int(gas.split()[0]), float(flip), float(error)) for title, gas, flip, error in rows]
        on_way = [each for each in found if each[0].startswith("**")]
        assert len(on_way) >= 5
        for _, cost, flip, error in on_way:
            assert not [each for each in found if each[1] < cost and each[2] < flip and each[3] < error]


@pytest.mark.parametrize("antialias", [False, True])
def test_unit_costs_are_those_of_differences(antialias: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a made-up cost, which is linear, the parts come out."""

    def made_up(scene: Scene) -> int:
        work = workload_of(scene)
        lights = 70 * work.drawn * (len(scene.lights) - 1)
        return 5 * work.lit + 30 * work.rows + 200 * work.drawn + 12345 + lights + 10**6 * scene.antialias

    monkeypatch.setattr(unit_costs, "gas", made_up)
    path = "flat, antialiased" if antialias else "smooth"
    monkeypatch.setattr(unit_costs, "PATHS", {path: unit_costs.PATHS[path]})
    assert unit_costs.figures() == {
        f"{path}, a pixel": 5,
        f"{path}, a row": 30,
        f"{path}, a triangle": 200,
        f"{path}, a second light, for each triangle": 70,
    }
