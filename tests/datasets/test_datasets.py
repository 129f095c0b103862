"""All datasets together, by name."""

from __future__ import annotations

import base64
import io
import json
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

import shackled
from shackled.cli.app import run
from shackled.datasets import DATASETS, Piece, PieceCost, cost, draw_all, find, page, pieces, require, sheet
from shackled.datasets._drawing import draw, table
from shackled.datasets.common import models
from shackled.errors import InputError
from shackled.scene import Mesh, write_obj


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
    assert [piece.dataset for piece in everything] == sorted(
        (piece.dataset for piece in everything), key=list(DATASETS).index
    )
    for piece in everything:
        assert piece.name.startswith(DATASETS[piece.dataset])
        assert piece.title
        assert piece.licence
    for piece in [*everything[:80], *everything[80::97], everything[-1]]:
        found = find(piece.name)
        assert found is not None
        assert (found.name, found.dataset, found.title) == (piece.name, piece.dataset, piece.title)


def test_how_many_there_are(everything: list[Piece]) -> None:
    count = {name: sum(piece.dataset == name for piece in everything) for name in DATASETS}
    assert count["common"] >= 30
    assert count["icons"] >= 24
    assert count["genesis"] == 1024


def test_any_seed_is_a_piece() -> None:
    scene = shackled.load(f"genesis/{'5a' * 32}")
    assert scene.objects
    assert (shackled.render(scene).covered_pixels or 0) > 0


@pytest.mark.parametrize(
    ("name", "close"),
    [
        ("teapt", "teapot"),
        ("cornelbox", "cornell-box"),
        ("icons/diamnd", "icons/diamond"),
        ("Teapot", "mean teapot?"),
        ("common/teapot", "mean teapot?"),
        ("diamond", "mean icons/diamond?"),
        ("icons/diamnd", "mean icons/diamond?"),
    ],
)
def test_unknown_names(name: str, close: str) -> None:
    with pytest.raises(InputError) as caught:
        require(name)
    message = str(caught.value)
    assert message.startswith(f"there is no piece {name!r}; did you mean ")
    assert close in message
    assert message.endswith("? `shackled datasets list` shows all")
    assert "\n" not in message


@pytest.mark.parametrize("name", ["ico", "icons/x", "material", "texture.png"])
def test_no_name_is_suggested_that_is_not_alike(name: str) -> None:
    with pytest.raises(InputError) as caught:
        require(name)
    assert str(caught.value) == f"there is no piece {name!r}; `shackled datasets list` shows all"


@pytest.mark.parametrize("name", ["genesis/1024", "genesis/-1", "genesis/x"])
def test_pieces_of_genesis_have_numbers(name: str) -> None:
    with pytest.raises(InputError) as caught:
        require(name)
    known = "0 to 1023, or the 64 hexadecimal digits of a seed"
    assert str(caught.value) == f"there is no piece {name!r}; after genesis/ comes a number from {known}"


@pytest.mark.parametrize("name", ["", "no such thing at all", "genesis/", "genesis/-1", "genesis/x", "icons/", "../x"])
def test_names_that_are_like_none(name: str) -> None:
    assert find(name) is None
    with pytest.raises(InputError):
        shackled.load(name)


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


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["teapto"], "shackled: teapto does not exist, and there is no piece 'teapto'; did you mean teapot"),
        (["teapot.obj"], "shackled: teapot.obj does not exist"),
        (["picture.xyz"], "shackled: picture.xyz is neither a mesh nor a scene file by its extension"),
        (["bunny"], "shackled: bunny has not been fetched; run: shackled datasets fetch bunny"),
    ],
)
def test_mistakes_are_one_line(arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", *arguments]) == 2
    output, messages = capsys.readouterr()
    assert output == ""
    assert messages.startswith(message)
    assert messages.count("\n") == 1


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


def test_the_look_of_a_piece_can_be_changed() -> None:
    plain = shackled.render("teapot", size=64).pixels
    changes = ["--rotate=0,40,0", "--smooth", "--color=#30a0ff", "--background=#000000", "--wireframe", "--invert"]
    for change in (*changes, "--unlit", "--light=point:3,3,3", "--orthographic", "--fov=30"):
        if change == "--smooth":
            continue  # as it is
        assert run(["render", "teapot", "--size", "64", "-o", "out.png", change]) == 0
        with PillowImage.open("out.png") as picture:
            assert (np.array(picture) != plain).any(), change
    assert run(["render", "teapot", "--size", "64x32", "--max-triangles", "200", "-o", "out.png"]) == 0


def test_who_is_to_be_named_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["render", "cornell-box", "--size", "16", "--json"]) == 0
    output, messages = capsys.readouterr()
    assert json.loads(output)["triangles"] > 0
    assert messages.startswith("cornell-box: Cornell box by the Cornell University Program of Computer Graphics")


# ---- list ----


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
    assert run(["datasets", "list", "icon"]) == 2
    assert capsys.readouterr().err == "shackled: the dataset must be one of common, icons, genesis, not 'icon'\n"


def measured(everything: list[Piece]) -> Iterator[Piece]:
    sampled = [piece for piece in everything if piece.dataset == "genesis"][::93]
    return (p for p in [*everything, *sampled] if p.name not in models() and (p.dataset != "genesis" or p in sampled))


def test_the_table_of_costs_is_what_is_measured(everything: list[Piece]) -> None:
    assert list(table()) == [piece.name for piece in everything if piece.name not in models()]
    for piece in measured(everything):
        drawing = draw(piece)
        assert table()[piece.name] == (drawing.triangles, drawing.gas), (
            f"{piece.name} has changed; run: python tools/dataset_costs.py"
        )


def test_the_cost_of_what_is_not_here() -> None:
    assert cost(require("bunny")) == PieceCost(None, None)


# ---- drawings and galleries ----


def test_a_drawing_is_made_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = draw(require("cube"))
    kept = list((folder / "cache" / "drawings").iterdir())
    assert len(kept) == 1
    monkeypatch.setattr("shackled.datasets._drawing._png", lambda *_: pytest.fail("drawn again"))
    assert draw(require("cube")) == first
    monkeypatch.undo()
    monkeypatch.setenv("SHACKLED_CACHE", str(folder / "cache"))
    kept[0].write_bytes(kept[0].read_bytes()[:100])  # damaged
    assert draw(require("cube")) == first
    assert kept[0].read_bytes() == first.png
    assert draw(require("cube"), size=32) != first


def test_a_drawing_is_what_the_contracts_make() -> None:
    drawing, image = draw(require("torus")), shackled.render(require("torus").make())
    with PillowImage.open(io.BytesIO(drawing.png)) as picture:
        assert (np.array(picture) == image.pixels).all()
    assert drawing.gas == image.gas
    assert drawing.triangles == 1152


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


def test_texts_on_the_page_are_texts() -> None:
    evil = Piece("x", "common", '<b>"&', "<i>", require("cube").make, credit="<script>")
    html = page([evil], {})
    assert "<b>" not in html
    assert "<i>" not in html
    assert html.count("<script>") == 1


def test_the_sheet(folder: Path) -> None:
    wanted = [require(name) for name in ("cube", "cone", "torus", "bunny")]
    drawings = {piece.name: draw(piece) for piece in wanted if piece.ready()}
    with PillowImage.open(io.BytesIO(sheet(wanted, drawings))) as picture:
        pixels = np.array(picture)
    with PillowImage.open(io.BytesIO(drawings["cube"].png)) as picture:
        assert (pixels[8:136, 8:136] == np.array(picture)).all()
    assert (pixels[138:160, 8:136] < 100).any()  # a label
    with PillowImage.open(io.BytesIO(sheet([], {}))) as picture:
        assert picture.size[0] > 0


def test_the_command_gallery(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "own.obj").write_text("")
    write_obj(
        Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]), "own.obj"
    )
    assert run(["datasets", "fetch", "cow", "--from", "own.obj"]) == 0
    assert run(["datasets", "gallery", "common", "-o", "g.html", "-o", "g.png", "--jobs", "1"]) == 0
    output = capsys.readouterr().out
    html = (folder / "g.html").read_text("utf-8")
    built = [piece for piece in pieces("common") if piece.ready()]
    assert output.endswith(f"g.html: {len(list(pieces('common')))} pieces\ng.png: {len(built)} pieces\n")
    assert html.count("data:image/png") == len(built)
    assert "that of your own file (not for commercial use)" in html
    with PillowImage.open("g.png") as picture:
        assert picture.size[0] > 600


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("g.gif", "the gallery g.gif must end in .html or .png"),
        ("no/g.png", "the folder no of the gallery g.png does not exist"),
        ("folder.html", "folder.html is a folder, not the file of a gallery"),
    ],
)
def test_galleries_that_cannot_be_written(
    folder: Path, output: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "folder.html").mkdir()
    assert run(["datasets", "gallery", "-o", output]) == 2
    assert capsys.readouterr().err == f"shackled: {message}\n"
