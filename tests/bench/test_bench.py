"""The experiments, in a hurry: what they write, and what is known about it beforehand."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from benchmarks.original.documents import scene_document
from PIL import Image as PillowImage

import shackled
from shackled import InputError, Scene
from shackled.artifacts import artifact
from shackled.bench import regression, scenes
from shackled.bench._culling import culling
from shackled.bench._measure import call_renderer, cost
from shackled.bench._original import CODE_SIZES, original, original_gas
from shackled.bench._report import ExperimentReport, wrapped
from shackled.bench._runner import EXPERIMENTS, Runner
from shackled.chain import open_chain
from shackled.chain._embedded import DEFAULT_GAS_LIMIT, SENDER
from shackled.cli.app import run
from shackled.datasets._pieces import require
from shackled.deploy._contract import STANDARD
from shackled.ethereum._encoding import to_hex
from shackled.scene._files.original import original_scene

Rows = list[dict[str, str]]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of all experiments, each made once."""
    folder = tmp_path_factory.mktemp("bench")
    assert run(["bench", "--quick", "--processes", "1", "-o", str(folder)]) == 0
    return folder


def rows_of(folder: Path, name: str) -> Rows:
    with (folder / f"{name}.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def column(rows: Rows, name: str) -> list[int]:
    return [int(row[name]) for row in rows]


# ---- files ----


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_each_writes_figures_a_table_and_a_plot(made: Path, name: str) -> None:
    rows = rows_of(made, name)
    assert rows
    assert all(value != "" for row in rows for key, value in row.items() if "original" not in key)
    text = (made / f"{name}.md").read_text("utf-8")
    assert text.startswith("# ")
    assert text.endswith("\n")
    lines = text.splitlines()
    assert max(len(line) for line in lines if not line.startswith("|")) <= 120
    assert sum(line.startswith("|") for line in lines) >= 3
    with PillowImage.open(made / f"{name}.png") as plot:
        assert round(plot.info["dpi"][0]) == 300
        pixels = np.array(plot.convert("RGB"))
    # dark letters on white
    assert (pixels == 255).all(axis=2).mean() > 0.5
    assert pixels.max(axis=2).min() < 60


def test_without_a_name_all_are_made(made: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert {path.stem for path in made.glob("*.csv")} == set(EXPERIMENTS)
    # and without a folder they are listed
    assert run(["bench"]) == 0
    listed = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in listed[: len(EXPERIMENTS)]] == list(EXPERIMENTS)


# ---- scenes ----


@pytest.mark.parametrize("scene", [scenes.cube(8), scenes.cube(16, "orthographic"), scenes.equal_triangles(16)])
def test_scenes_look_as_their_documents_do(scene: Scene) -> None:
    assert call_renderer(scene) == call_renderer(original_scene(scene_document(scene)))


def test_the_figures_of_the_original() -> None:
    assert original_gas("cube_persp_128") == 3853325407
    assert original_gas("no such scene") is None
    assert original()["tris_16"].triangles == 16
    assert sum(CODE_SIZES.values()) == 92245


# ---- experiments ----


def test_canvas(made: Path) -> None:
    rows = rows_of(made, "canvas")
    assert [(row["projection"], int(row["side"])) for row in rows] == [
        (projection, side) for projection in ("perspective", "orthographic") for side in (8, 16, 32)
    ]
    assert column(rows, "triangles") == [6] * 6
    assert column(rows, "gas")[:3] == [cost(scenes.cube(side)).gas for side in (8, 16, 32)]
    assert column(rows, "gas")[:3] == sorted(column(rows, "gas")[:3])
    assert column(rows, "original_gas") == [3963557, 11186091, 50843097, 3926385, 11171733, 51321395]
    with PillowImage.open(made / "canvas-pictures.png") as picture:
        assert picture.size == (3 * 128, 2 * 128)
        shown = np.array(picture.convert("RGB"))
    smallest = shackled.render(scenes.cube(8)).pixels
    assert (shown[:128:16, :128:16] == smallest).all()


def test_triangles(made: Path) -> None:
    rows = rows_of(made, "triangles")
    assert column(rows, "triangles") == [1, 2, 3, 4]
    pixels = column(rows, "lit_pixels")
    # of the same shape and size, and none over another
    assert pixels == [pixels[0] * count for count in (1, 2, 3, 4)]
    assert regression.fit([[1, 2, 3, 4]], column(rows, "gas")).r2 > 0.9999
    assert "34.07%" not in (made / "triangles.md").read_text("utf-8")  # that is of 16


def test_genesis(made: Path) -> None:
    rows = rows_of(made, "genesis")
    assert column(rows, "piece") == list(range(0, 1024, 128))
    for row in rows:
        # seven triangles a prism
        assert int(row["triangles"]) % 7 == 0
        assert 0 < int(row["drawn"]) <= int(row["triangles"])
        assert 0 < int(row["lit_pixels"]) < 128 * 128
    first = require("genesis/0").make()
    assert column(rows, "gas")[0] == cost(first).gas


def test_culling(made: Path) -> None:
    rows = rows_of(made, "culling")
    assert rows[0]["name"] == "teapot"
    for row in rows:
        assert int(row["drawn"]) < int(row["drawn_without"]) <= int(row["faces"])
        assert int(row["gas"]) < int(row["gas_without"])
    assert [row["different"] for row in rows if row["name"] == "cornell-box"] == ["0"]


def test_deploy(made: Path) -> None:
    rows = rows_of(made, "deploy")
    assert {row["contract"] for row in rows} == set(STANDARD)
    for row in rows:
        built = artifact(row["contract"])
        assert int(row["code_bytes"]) == len(built.runtime)
        # 200 gas a byte, and the transaction
        assert int(row["gas"]) > 200 * len(built.runtime) + 53000
    # what a transaction costs in another EVM
    pyrevm = pytest.importorskip("pyrevm")
    chain, evm = open_chain("pyrevm"), pyrevm.EVM(spec_id="Cancun")
    evm.deploy(to_hex(SENDER), chain.creation("Engine"), None, DEFAULT_GAS_LIMIT)
    assert {row["contract"]: int(row["gas"]) for row in rows}["Engine"] == evm.result.gas_used


def test_linear(made: Path) -> None:
    rows = rows_of(made, "linear")
    squares = [row for row in rows if row["series"] == "unlit squares"]
    assert column(squares, "triangles") == [2, 162, 578]
    assert regression.fit([column(squares, "triangles")], column(squares, "gas")).r2 > 0.98
    assert "| original: equal triangles | " in (made / "linear.md").read_text("utf-8")
    assert "0.988797" in (made / "linear.md").read_text("utf-8")


# ---- parts, and mistakes ----


def double(number: int) -> int:
    return 2 * number


def test_several_processes_keep_the_order() -> None:
    shown: list[tuple[str, int, int]] = []
    runner = Runner(processes=2, show=lambda *told: shown.append(told))
    assert runner.map("doubles", double, range(20)) == list(range(0, 40, 2))
    assert shown == [("doubles", done, 20) for done in range(1, 21)]


def test_without_matplotlib_there_are_no_plots(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("shackled.bench._report.find_spec", lambda name: None)
    assert run(["bench", "deploy", "--quick", "-o", str(tmp_path)]) == 0
    assert "no plots: they need matplotlib (pip install 'shackled[bench]')" in capsys.readouterr().err
    assert {path.name for path in tmp_path.iterdir()} == {"deploy.csv", "deploy.md"}


def test_reports(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    report = ExperimentReport("Title", ["a"], [[1], [None]], "text", lambda figure: None)
    assert report.csv() == 'a\n1\n""\n'
    with pytest.raises(InputError, match=r"folder cannot be written: Not a directory"):
        report.save("name", tmp_path / "file" / "folder")
    # tables are not wrapped
    row = "| " + "x" * 200 + " |"
    assert len(wrapped("word " * 40 + "\n\n" + row).splitlines()) == 4


def test_the_legend_of_the_bars_is_above_them() -> None:
    from matplotlib.figure import Figure

    report = culling(Runner(quick=True, processes=1))
    figure = Figure(figsize=report.shape, layout="constrained")
    report.draw(figure)
    figure.draw_without_rendering()
    (axes,) = figure.axes
    legend = axes.get_legend()
    assert legend is not None
    assert legend.get_window_extent().y0 >= axes.get_window_extent().y1 - 1
