"""The command `shackled genesis`."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

from shackled import render
from shackled.cli.app import run
from shackled.datasets.genesis import generate, seed_of
from shackled.ethereum import keccak256


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SHACKLED_CACHE", str(tmp_path / "cache"))
    return tmp_path


def test_json_is_an_object_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    seed = bytes(range(32))
    assert run(["genesis", "0x" + seed.hex(), "12", "--json"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [json.loads(line) for line in lines] == [generate(each).document() for each in (seed, seed_of(12))]
    assert set(json.loads(lines[0])) == {
        *("seed", "structure", "chroma", "pseudosymmetry", "prisms", "wireframe", "culling", "invert", "background"),
        *("verts", "cols", "faces"),
    }


def test_words(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["genesis", "3", "12"]) == 0
    first, second = capsys.readouterr().out.split("\n\n")
    rows = dict(line.split(maxsplit=1) for line in first.splitlines())
    assert rows["seed"] == seed_of(3).hex()
    assert (rows["structure"], rows["chroma"], rows["symmetry"]) == ("Uniform", "Sunset", "Diagonal")
    assert (rows["prisms"], rows["style"]) == ("4, 28 triangles", "wireframe")
    assert rows["gas"].endswith(" for the piece")
    assert "Vivid Ink" in second


def test_picture(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["genesis", "7", "-o", "seven.png"]) == 0
    assert "from seed to picture" in capsys.readouterr().out
    with PillowImage.open("seven.png") as picture:
        pixels = np.array(picture.convert("RGB"))
    np.testing.assert_array_equal(pixels, render(generate(seed_of(7)).scene()).pixels)


def test_a_piece_can_be_rendered_by_its_name() -> None:
    assert run(["render", "genesis/7", "-o", "seven.bmp", "--size", "32", "--no-antialias"]) == 0
    assert Path("seven.bmp").read_bytes() == render(generate(seed_of(7)).scene(), 32).bmp


def test_sheet(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["genesis", "--sheet", "all.png", "--count", "3", "--size", "16", "--jobs", "1"]) == 0
    assert capsys.readouterr().out == "all.png: 3 pieces\n"
    with PillowImage.open("all.png") as picture:
        assert picture.size == (32, 32)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "a SEED is missing: 64 hexadecimal digits or a number from 0 to 1023; or give --sheet FILE"),
        (["1024"], "a seed must be 64 hexadecimal digits, with or without 0x, or a number from 0 to 1023, not '1024'"),
        (
            ["3", "xyz"],
            "a seed must be 64 hexadecimal digits, with or without 0x, or a number from 0 to 1023, not 'xyz'",
        ),
        (["3", "4", "-o", "a.png"], "--output needs exactly one SEED, not 2"),
        (["3", "-o", "a.txt"], "the picture a.txt must end in one of .png .bmp .svg .gif .jpg .jpeg .webp"),
        (["3", "--count", "4"], "--count, --size and --jobs need --sheet FILE"),
        (["3", "--sheet", "a.png"], "--sheet excludes SEED, --json and --output"),
        (["--sheet", "a.gif"], "the sheet a.gif must end in .png"),
    ],
)
def test_wrong_usage_is_one_line(arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["genesis", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.err == f"shackled: {message}\n"
    assert captured.out == ""
    assert [path.name for path in Path().iterdir()] == []


def test_seeds_without_a_piece_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    seed = keccak256(b"seed-308884").hex()
    assert run(["genesis", seed]) == 1
    assert capsys.readouterr().err == "shackled: the contract refused: NoTriangle()\n"
