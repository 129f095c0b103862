"""What the benchmarks claim: gas grows with triangles and pixels in a straight line; stages add up to the whole."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from benchmarks import stages
from benchmarks.scenes import cubes, staged_teapot
from benchmarks.workload import workload_of

from shackled.bench import EXPERIMENTS, _linear, fits, gas
from shackled.chain import open_chain
from shackled.gas import STAGES

ROOT = Path(__file__).resolve().parent.parent


@pytest.mark.parametrize("look", ["unlit", "matte"])
def test_gas_is_linear_in_triangles_and_pixels(look: str) -> None:
    scenes = _linear.squares(look) + _linear.cubes(look)
    triangles = np.array([scene.triangles for scene in scenes], float)
    pixels = np.array([scene.width * scene.height for scene in scenes], float)
    found = fits.fit([triangles, pixels], np.array([gas(scene) for scene in scenes], float))
    assert found.r2 >= 0.998
    assert min(found.coefficients) > 0


def test_a_fit_finds_a_line_and_a_square() -> None:
    x = np.arange(1.0, 20)
    line, curve = 5 + 3 * x, 5 + x**2
    assert fits.fit([x], line).coefficients == pytest.approx([5, 3])
    assert fits.fit([x], line).r2 == pytest.approx(1)
    assert fits.fit([x], curve).r2 < 0.999
    assert fits.quadratic_share([x], line) == pytest.approx(0, abs=1e-9)
    assert fits.quadratic_share([x], curve) == pytest.approx(19**2 / (5 + 19**2))


def test_the_workload_is_that_of_the_picture() -> None:
    scene = cubes(24)
    work = workload_of(scene)
    assert (work.vertices, work.faces, work.canvas) == (24, 36, 576)
    assert (work.drawn, work.lit) == open_chain().count(scene)
    assert work.tested >= work.lit
    assert work.rows >= work.drawn


def test_the_story_has_the_results() -> None:
    result = subprocess.run(
        [sys.executable, "-m", "benchmarks.story", "--check"], cwd=ROOT, capture_output=True, text=True
    )
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_the_results_of_each_experiment_are_there(name: str) -> None:
    results = ROOT / "benchmarks" / "results"
    files = [path for path in results.iterdir() if path.stem.partition("-")[0] == name]
    assert {path.suffix for path in files} == {".csv", ".md", ".png"}
    assert max(path.stat().st_size for path in files) < 200_000
    assert f"](results/{name}.png)" in (ROOT / "benchmarks" / "README.md").read_text("utf-8")


def test_the_results_are_of_these_contracts() -> None:
    """The snapshot is measured again in each run of the tests; what is written from longer runs must agree with it."""
    snapshot = json.loads((ROOT / "benchmarks" / "gas.json").read_text("utf-8"))
    canvas, triangles, deploy = (rows(name) for name in ("canvas", "triangles", "deploy"))
    written = {f"experiment canvas, {row['side']}": row for row in canvas if row["projection"] == "perspective"}
    written |= {f"experiment triangles, {row['triangles']}": row for row in triangles}
    found = {name: int(row["gas"]) for name, row in written.items() if name in snapshot["scenes"]}
    assert found == {name: snapshot["scenes"][name] for name in found}
    assert len(found) == 5
    deployed = {f"{row['contract']} deployment": int(row["gas"]) for row in deploy}
    assert deployed.items() >= {k: v for k, v in snapshot["contracts"].items() if k.endswith("deployment")}.items()
    table = json.loads((ROOT / "benchmarks" / "results.json").read_text("utf-8"))["Cost against the original"]
    assert table["cube_persp_128"]["gas"] == snapshot["scenes of the cost table"]["cube_persp_128"]


def rows(name: str) -> list[dict[str, str]]:
    with (ROOT / "benchmarks" / "results" / f"{name}.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def test_the_stages_add_up() -> None:
    scene = staged_teapot("flat", 24)
    spent = stages.gas_by_stage(scene)
    assert sum(spent.values()) == gas(scene)
    assert min(spent[stage] for stage in STAGES if stage != "encoding") > 0
    # the same but for what is inverted in the end
    inverted = stages.gas_by_stage(staged_teapot("flat", 24, invert=True))
    assert [stage for stage in STAGES if inverted[stage] > spent[stage] + 300] == ["compositor"]
    # no light, no work for it
    unlit = stages.gas_by_stage(staged_teapot("unlit", 24))
    assert unlit["fragment shader"] < spent["fragment shader"] / 10
