"""The showcase: scenes of the options of the renderer, and the command that draws them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

import shackled
from shackled.cli.app import run
from shackled.datasets import find, pieces
from shackled.datasets.showcase import pieces as scenes


@pytest.mark.parametrize("name", [piece.name for piece in scenes()])
def test_every_scene_is_found_antialiased_and_seen(name: str) -> None:
    scene = shackled.load(name)
    assert scene.antialias
    image = shackled.render(scene, size=(40, 30))
    assert len(np.unique(image.pixels.reshape(-1, 3), axis=0)) > 30


def test_scenes_are_not_listed() -> None:
    assert len({piece.name for piece in scenes()}) == 12
    assert find("showcase/nothing") is None
    assert not any(piece.name.startswith("showcase/") for piece in pieces())


def test_the_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "folder"
    assert run(["datasets", "showcase", "genesis", "showcase/wires", "-o", str(folder)]) == 0
    first, second, last = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in (first, second)] == ["showcase/genesis", "showcase/wires"]
    assert last.endswith("sheet.png: 2 scenes")
    assert {path.name for path in folder.iterdir()} == {"genesis.png", "wires.png", "sheet.png"}
    genesis = shackled.render("showcase/genesis")
    assert f"{(genesis.gas or 0) / 1e6:.1f} M gas" in first
    assert shackled.load(folder / "genesis.png").antialias
    with PillowImage.open(folder / "genesis.png") as picture, PillowImage.open(folder / "sheet.png") as sheet:
        assert picture.size == (genesis.width, genesis.height)
        assert sheet.width > 2 * genesis.width
    assert run(["datasets", "showcase", "nothing", "-o", str(tmp_path)]) == 2
    assert "a scene of the showcase must be one of still-life, glass" in capsys.readouterr().err
