"""What the benchmarks claim: gas grows with triangles and pixels in a straight line; stages add up to the whole."""

from __future__ import annotations

import csv
import hashlib
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from benchmarks import client_workload, cost, gas_model, look_quality, money, ray_marcher, shared, stages
from benchmarks.scenes import cubes, staged_teapot
from benchmarks.workload import workload_of

from compiler import needs_compiler
from evms import pyrevm_call
from shackled import render
from shackled.bench import _linear, regression
from shackled.bench._measure import gas
from shackled.bench._runner import EXPERIMENTS
from shackled.chain import open_chain
from shackled.gas._stages import STAGES

ROOT = Path(__file__).resolve().parent.parent


@pytest.mark.parametrize("look", ["unlit", "matte"])
def test_gas_is_linear_in_triangles_and_pixels(look: str) -> None:
    scenes = _linear.squares(look) + _linear.cubes(look)
    triangles, pixels, spent = np.array([(s.triangles, s.width * s.height, gas(s)) for s in scenes], float).T
    found = regression.fit([triangles, pixels], spent)
    assert found.r2 >= 0.998
    assert min(found.coefficients) > 0


def test_a_fit_finds_a_line_and_a_square() -> None:
    x = np.arange(1.0, 20)
    line, curve = 5 + 3 * x, 5 + x**2
    assert regression.fit([x], line).coefficients == pytest.approx([5, 3])
    assert regression.fit([x], line).r2 == pytest.approx(1)
    assert regression.fit([x], curve).r2 < 0.999
    assert regression.fit([[1, 2, 3]], [1, 0, 1]).r2 == pytest.approx(0)
    assert regression.quadratic_share([x], line) == pytest.approx(0, abs=1e-9)
    assert regression.quadratic_share([x], curve) == pytest.approx(19**2 / (5 + 19**2))


def test_the_workload_is_that_of_the_picture() -> None:
    scene = cubes(24)
    work = workload_of(scene)
    assert (work.vertices, work.faces, work.canvas) == (24, 36, 576)
    assert (work.drawn, work.lit) == open_chain().count(scene)
    assert work.tested >= work.lit
    assert work.rows >= work.drawn


def test_the_story_has_the_results() -> None:
    command = [sys.executable, "-m", "benchmarks.story", "--check"]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr


def test_the_results_of_each_experiment_are_there() -> None:
    page = (ROOT / "benchmarks" / "README.md").read_text("utf-8")
    for name in EXPERIMENTS:
        files = [each for each in (ROOT / "benchmarks" / "results").iterdir() if each.stem.partition("-")[0] == name]
        assert {path.suffix for path in files} == {".csv", ".md", ".png"}
        assert max(path.stat().st_size for path in files) < 200_000
        assert f"](results/{name}.png)" in page


def test_the_results_are_of_these_contracts() -> None:
    """The snapshot is measured again in each run of the tests; what is written from longer runs must agree with it."""
    snapshot = json.loads((ROOT / "benchmarks" / "gas.json").read_text("utf-8"))
    canvas, triangles, deploy = (rows(name) for name in ("canvas", "triangles", "deploy"))
    written = {f"experiment canvas, {row['side']}": row for row in canvas if row["projection"] == "perspective"}
    written |= {f"experiment triangles, {row['triangles']}": row for row in triangles}
    written |= {f"{row['contract']} deployment": row for row in deploy}
    taken = snapshot["scenes"] | snapshot["contracts"]
    found = {name: int(row["gas"]) for name, row in written.items() if name in taken}
    assert found == {name: taken[name] for name in found}
    assert len(found) == 5 + sum(name.endswith("deployment") for name in snapshot["contracts"])
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


# ---- beyond the paper ----


@pytest.mark.parametrize("module", [gas_model, ray_marcher, money, look_quality], ids=lambda each: each.__name__)
def test_the_page_has_the_recorded_figures(module: Any) -> None:
    name, recorded = module.__name__.rpartition(".")[2], module.recorded()
    text = module.text(*recorded) if isinstance(recorded, tuple) else module.text(recorded)
    page = (ROOT / "benchmarks" / "README.md").read_text("utf-8")
    assert f"<!-- begin {name} -->\n{text}\n<!-- end {name} -->" in page, f"run python -m benchmarks.{name}"


def test_the_workload_of_clients_runs() -> None:
    """From its files alone: two EVMs return the expected bytes for the expected gas."""
    assert client_workload.stale() == [], "run python -m benchmarks.client_workload"
    texts = {path.name: path.read_text("utf-8") for path in client_workload.FOLDER.iterdir()}
    expected = json.loads(texts["expected.json"])
    codes = {
        bytes.fromhex(address[2:]): bytes.fromhex(each["code"][2:])
        for address, each in json.loads(texts["state.json"])["alloc"].items()
    }
    assert len(expected) == 9
    for name, each in expected.items():
        to, data = bytes.fromhex(each["to"][2:]), bytes.fromhex(texts[f"{name}.hex"])
        answer = client_workload.call(codes, to, data)
        assert (answer.gas, hashlib.sha256(answer.output).hexdigest()) == (each["gas"], each["output sha256"])
        assert pyrevm_call(codes, to, data, client_workload.GAS) == answer


@needs_compiler
def test_the_ray_marcher_draws_the_same_picture() -> None:
    for shape in ray_marcher.all_shapes().values():
        gas, marched = ray_marcher.march(shape, 24)
        drawn = render(ray_marcher.scene(shape, 24)).pixels
        inside = (marched != ray_marcher.SKY).any(axis=2) & (drawn != ray_marcher.SKY).any(axis=2)
        assert inside.sum() > 100
        assert np.abs(marched.astype(int) - drawn)[inside].mean() < 2
        assert gas > 100_000
    gas, _ = ray_marcher.march(ray_marcher.all_shapes()["torus"], 64)
    assert gas == ray_marcher.recorded()["torus, 64 x 64"]["ray marcher"], "run python -m benchmarks.ray_marcher"


def test_money_is_counted() -> None:
    prices = money.Prices("a day", ether=2000, mainnet=5, rollup=0.5, blob=1)
    work = money.Work(gas=900_000, intrinsic=100_000, data=1000, compressed=500_000)
    assert work.on_mainnet(prices) == pytest.approx(10)
    assert work.on_rollup(prices) == pytest.approx(1 + 1)
    # 10 gas for a zero byte, and 40 for any other, where the execution is short
    assert money.Work(0, 21_000 + 16, 1, 1).total == 21_040
    scene = next(iter(money.scenes().values()))
    assert next(iter(money.recorded()[1].values())) == money.measure(scene), "run python -m benchmarks.money"


def test_the_model_of_gas_finds_what_there_is() -> None:
    counts = np.array([[1, 10, 5], [1, 20, 9], [1, 35, 4], [1, 2, 80]], float)
    assert gas_model.fitted(counts, counts @ [1000, 30, 7]) == pytest.approx([1000, 30, 7])
    assert gas_model.errors(counts, counts @ [1000, 30, 7], np.array([2000, 60, 14])) == pytest.approx([1] * 4)
    teapot = staged_teapot("smooth", 24)
    assert gas_model.curved(teapot) == (1, 1)
    assert gas_model.curved(staged_teapot("flat", 24)) == (0, 0)


def test_a_part_of_a_look_is_left_out() -> None:
    """Of the truth, the picture of the contract is near; without a part it is farther."""
    scene = evolve(look_quality.effects("teapot"), width=32, height=32)
    right = look_quality.truth(scene)
    assert np.abs(right - render(scene).pixels).mean() < 5
    for change in look_quality.LOOKS["effects"][1].values():
        assert np.abs(right - render(change(scene)).pixels).mean() > 1.25


#: Runs the module of its first argument with the others, without packages that are not needed to render.
WITHOUT = """
import runpy, sys
for name in ("pyrevm", "flip_evaluator", "moderngl", "matplotlib", "distributed"):
    sys.modules[name] = None
_, names, *arguments = sys.argv
for name in names.split(","):
    sys.argv[1:] = arguments
    try:
        runpy.run_module(name, run_name="__main__", alter_sys=True)
    except SystemExit as end:
        print(f"{name}: {end.code}", flush=True)
"""
COMMANDS = [
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for path in sorted((ROOT / "benchmarks").rglob("*.py"))
    if 'if __name__ == "__main__":' in path.read_text("utf-8")
]


def without_packages(names: list[str], *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-W", "ignore", "-c", WITHOUT, ",".join(names), *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)


def test_help_does_nothing_else() -> None:
    """And needs no optional package."""
    before = {path: path.stat().st_mtime_ns for path in (ROOT / "benchmarks").rglob("*.*")}
    done = without_packages(COMMANDS, "--help")
    assert len(COMMANDS) > 20
    assert [line for line in done.stdout.splitlines() if line.startswith("benchmarks.")] == [
        f"{n}: 0" for n in COMMANDS
    ]
    assert done.stdout.count("usage: ") == len(COMMANDS)
    assert {path: path.stat().st_mtime_ns for path in before} == before


def test_a_package_that_is_missing_is_named() -> None:
    packages = {"tokens": "pyrevm", "look_quality": "flip-evaluator", "quality": "moderngl"}
    done = without_packages([f"benchmarks.{name}" for name in packages])
    for (name, package), line in zip(packages.items(), done.stdout.splitlines(), strict=True):
        assert line.startswith(
            f"benchmarks.{name}: the package {package.replace('-', '_')} is not installed: pip install {package}"
        )
    assert "Traceback" not in done.stderr


def test_scenes_of_which_some_are_missing_are_skipped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shared, "FOLDER", tmp_path)
    for name in (shared.CUBE, shared.LARGE_CUBE, shared.QUAD, *shared.genesis()):
        (tmp_path / f"{name}.json").touch()
    assert cost.section().text == shared.SKIPPED
