"""All datasets together, by name."""

from __future__ import annotations

import base64
import io
import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

import shackled
from shackled.cli.app import run
from shackled.datasets import Piece, find, pieces
from shackled.datasets._drawing import PieceCost, cost, draw, draw_all, page, sheet, table
from shackled.datasets._pieces import DATASETS, require
from shackled.datasets.common._models import models
from shackled.errors import InputError


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SHACKLED_CACHE", str(tmp_path / "cache"))
    return tmp_path


@pytest.fixture(scope="module")
def everything() -> list[Piece]:
    return list(pieces())


def test_every_piece_is_found_by_its_name(everything: list[Piece]) -> None:
    names = [piece.name for piece in everything]
    assert len(names) == len(set(names))
    for piece in everything:
        assert piece.dataset == (piece.name.partition("/")[0] if "/" in piece.name else "common")
        assert piece.title
        assert piece.licence
    for piece in [*everything[:80], *everything[80::97], everything[-1]]:
        found = find(piece.name)
        assert found is not None
        assert (found.name, found.dataset, found.title) == (piece.name, piece.dataset, piece.title)
    assert sum(piece.dataset == "genesis" for piece in everything) == 1024


LIST = "; `shackled datasets list` shows all"
NUMBERS = "; after genesis/ comes a number from 0 to 1023, or the 64 hexadecimal digits of a seed"


@pytest.mark.parametrize(
    ("names", "hint"),
    [
        ("teapt Teapot common/teapot", f"; did you mean teapot?{LIST[1:]}"),
        ("cornelbox", f"; did you mean cornell-box?{LIST[1:]}"),
        ("diamond icons/diamnd", f"; did you mean icons/diamond?{LIST[1:]}"),
        ("ico icons/x icons/ ../x", LIST),
        ("showcase/glass", ": it is a scene of examples/showcase.py"),
        ("genesis/1024 genesis/-1 genesis/x genesis/", NUMBERS),
    ],
)
def test_unknown_names(names: str, hint: str) -> None:
    for name in names.split():
        assert find(name) is None
        with pytest.raises(InputError) as caught:
            require(name)
        assert str(caught.value) == f"there is no piece {name!r}{hint}"


def test_a_file_wins(folder: Path) -> None:
    (folder / "teapot.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert shackled.load("teapot.obj").objects[0].mesh.triangles == 1
    assert shackled.load("teapot").objects[0].mesh.triangles == 992
    (folder / "teapot").write_text("a file of that name")
    with pytest.raises(InputError, match="neither a mesh nor a scene file by its extension"):
        shackled.load("teapot")
    (folder / "cube").mkdir()
    assert shackled.load("cube").objects[0].mesh.triangles == 12
    assert len(shackled.load(Path("icons/diamond")).objects) >= 1


@pytest.mark.parametrize("name", ["teapot", "icons/diamond", "genesis/12"])
def test_pieces_are_rendered_by_name(name: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", name, "--json", "--size", "128", "--no-antialias"]) == 0
    output, messages = capsys.readouterr()
    report = json.loads(output)
    assert messages == ""
    assert report["input"] == name
    assert report["output"] == f"{name.replace('/', '-')}.png"
    assert report["gas"] == table()[name].gas
    with PillowImage.open(folder / report["output"]) as picture:
        assert (np.array(picture) == shackled.render(require(name).make()).pixels).all()


def test_who_is_to_be_named_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "cornell-box", "--size", "16", "--json"]) == 0
    output, messages = capsys.readouterr()
    assert json.loads(output)["triangles"] > 0
    assert messages.startswith("cornell-box: Cornell box by the Cornell University Program of Computer Graphics")


def test_the_list_as_json(everything: list[Piece], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["datasets", "list", "--json"]) == 0
    output, messages = capsys.readouterr()
    rows = json.loads(output)
    assert messages == ""
    assert [row["name"] for row in rows] == [piece.name for piece in everything]
    for row in rows:
        assert row.keys() >= {"name", "dataset", "triangles", "licence", "gas"}
        if row["name"] in models():
            assert (row["triangles"], row["gas"], row["fetched"]) == (None, None, False)
        else:
            assert row["triangles"] > 0
            assert row["gas"] > 100_000


def test_the_list_for_people(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["datasets", "list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert sum(not line.startswith(" ") for line in lines) == len(DATASETS)
    assert "genesis: 1,024 pieces" in lines
    assert re.match(r"  genesis/0 \.\. genesis/1023 +\d+ to \d+ triangles +[\d,]+ to [\d,]+ gas", lines[-1])
    bunny = next(line for line in lines if line.startswith("  bunny "))
    assert bunny.endswith("with credit (not for commercial use); run: shackled datasets fetch bunny")
    assert run(["datasets", "list", "icons"]) == 0
    assert all(line.startswith(("icons", "  icons/")) for line in capsys.readouterr().out.splitlines())


def test_the_table_of_costs_is_what_is_measured(everything: list[Piece]) -> None:
    assert list(table()) == [piece.name for piece in everything if piece.name not in models()]
    genesis = [piece for piece in everything if piece.dataset == "genesis"]
    for piece in [*(each for each in everything if each.dataset != "genesis" and each.ready()), *genesis[::93]]:
        drawing = draw(piece)
        assert table()[piece.name] == (drawing.triangles, drawing.gas), (
            f"{piece.name} has changed; run: python tools/dataset_costs.py"
        )


def test_a_drawing_is_made_once_as_the_contracts_make_it(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert cost(require("bunny")) == PieceCost(None, None)
    first, image = draw(require("cube")), shackled.render(require("cube").make())
    with PillowImage.open(io.BytesIO(first.png)) as picture:
        assert (np.array(picture) == image.pixels).all()
    assert (first.gas, first.triangles) == (image.gas, 12)
    (kept,) = (folder / "cache" / "drawings").iterdir()
    with monkeypatch.context() as patch:
        patch.setattr("shackled.datasets._drawing.decode_bmp", lambda *_: pytest.fail("drawn again"))
        assert draw(require("cube")) == first
    kept.write_bytes(kept.read_bytes()[:100])  # damaged
    assert draw(require("cube")) == first
    assert kept.read_bytes() == first.png
    assert draw(require("cube"), size=32) != first


def test_many_processes_draw_the_same() -> None:
    wanted = [require(name) for name in ("cube", "cone", "bunny", "torus", "icons/diamond")]
    drawn = {drawing.name: drawing for drawing in draw_all(wanted, size=32, processes=2)}
    assert drawn.keys() == {"cube", "cone", "torus", "icons/diamond"}
    for name, drawing in drawn.items():
        assert drawing == draw(require(name), size=32)


def test_the_page_stands_alone() -> None:
    wanted = [require("cube"), require("bunny"), require("icons/diamond")]
    drawings = {piece.name: draw(piece) for piece in wanted if piece.ready()}
    html = page(wanted, drawings)
    images = re.findall(r'src="data:image/png;base64,([^"]+)"', html)
    assert [base64.b64decode(data) for data in images] == [drawings["cube"].png, drawings["icons/diamond"].png]
    assert re.findall(r'(?:src|href|url)\s*[=(]\s*["\']?(?!data:)[\w/.:]+', html) == []
    assert html.count("<figure ") == 3
    assert "shackled datasets fetch bunny" in html
    assert "12 triangles, 2.2 M gas" in html
    assert "prefers-color-scheme: dark" in html
    assert "$" not in re.sub(r"<script>.*</script>", "", html, flags=re.DOTALL)

    evil = page([Piece("x", "common", '<b>"&', "<i>", require("cube").make, credit="<script>")], {})
    assert "<b>" not in evil
    assert "<i>" not in evil
    assert evil.count("<script>") == 1


def test_the_command_gallery(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    built = [piece for piece in pieces("common") if piece.ready()]
    for file, count in (("g.html", len(list(pieces("common")))), ("g.png", len(built))):
        assert run(["datasets", "gallery", "common", "-o", file, "--jobs", "1"]) == 0
        assert capsys.readouterr().out.endswith(f"{file}: {count} pieces\n")
    html = (folder / "g.html").read_text("utf-8")
    assert html.count("data:image/png") == len(built)
    assert "none stated (not for commercial use)" in html
    with PillowImage.open("g.png") as picture, PillowImage.open(io.BytesIO(draw(built[0]).png)) as first:
        pixels = np.array(picture)
        assert (pixels[8:136, 8:136] == np.array(first)).all()
    assert (pixels[138:160, 8:136] < 100).any()  # a label
    assert sheet([], {}).startswith(b"\x89PNG")
