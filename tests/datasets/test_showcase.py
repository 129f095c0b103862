"""The showcase: scenes of the options of the renderer, and the command that draws them."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

import shackled
from shackled.cli.app import run
from shackled.datasets import find, pieces
from shackled.datasets.showcase import pieces as scenes


def test_scenes_are_found_by_name_only() -> None:
    names = [piece.name for piece in scenes()]
    assert len(names) == len(set(names)) == 12
    for name in names:
        piece = find(name)
        assert piece is not None
        assert piece.name == name
    assert find("showcase/nothing") is None
    assert not any(piece.name.startswith("showcase/") for piece in pieces())


@pytest.mark.parametrize("name", [piece.name for piece in scenes()])
def test_every_scene_is_antialiased_and_seen(name: str) -> None:
    scene = shackled.load(name)
    assert scene.antialias
    image = shackled.render(scene, size=(40, 30))
    assert len(np.unique(image.pixels.reshape(-1, 3), axis=0)) > 30


def test_the_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["datasets", "showcase", "genesis", "showcase/wires", "-o", str(tmp_path / "folder")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines[:2]] == ["showcase/genesis", "showcase/wires"]
    assert lines[2].endswith("index.html: 2 scenes")
    assert {path.name for path in (tmp_path / "folder").iterdir()} == {
        "genesis.png",
        "wires.png",
        "index.html",
        "sheet.png",
    }
    genesis = shackled.render("showcase/genesis")
    gas = f"{(genesis.gas or 0) / 1e6:.1f} M gas"
    assert gas in lines[0]
    page = (tmp_path / "folder" / "index.html").read_text("utf-8")
    assert gas in page
    assert page.count("<figure>") == 2
    with PillowImage.open(tmp_path / "folder" / "genesis.png") as picture:
        assert (picture.width, picture.height) == (genesis.width, genesis.height)
    assert shackled.load(tmp_path / "folder" / "genesis.png").antialias
    sheet = PillowImage.open(io.BytesIO((tmp_path / "folder" / "sheet.png").read_bytes()))
    assert sheet.width > 2 * genesis.width
    assert run(["datasets", "showcase", "nothing", "-o", str(tmp_path)]) == 2
    assert "a scene of the showcase must be one of still-life, glass" in capsys.readouterr().err
