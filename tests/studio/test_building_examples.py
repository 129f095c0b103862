"""The scenes of docs/building.md."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage
from tools.docs import draw_building
from tools.ledger import World
from tools.pages import IMAGES

from compiler import needs_compiler
from shackled import render
from shackled.artifacts import artifact
from shackled.scene import decode

ROOT = Path(__file__).resolve().parents[2]

pytestmark = needs_compiler


@pytest.mark.parametrize(
    ("gallery", "name"), [(gallery, name) for gallery, names in draw_building.PICTURES.items() for name in names]
)
def test_pictures(world: World, gallery: str, name: str) -> None:
    """They are those that contracts build, and Python renders the same."""
    functions = draw_building.PICTURES[gallery][name]
    scenes = draw_building.scenes(world, gallery, functions)
    pictures = [draw_building.draw(world, scene) for scene in scenes]
    with PillowImage.open(IMAGES / f"building-{name}.png") as kept:
        difference = np.abs(np.hstack(pictures).astype(int) - np.asarray(kept))
    assert difference.mean() < 0.5, "run python -m tools.docs.draw_building"
    for scene, picture in zip(scenes, pictures, strict=True):
        decoded = decode(artifact("Renderer").selectors["render"] + scene)
        assert np.array_equal(render(decoded).pixels, picture)
        # what is built fills the picture but for its margin, in one direction
        rows, columns = np.nonzero((picture != picture[:, :1]).any(axis=2))
        assert max(np.ptp(rows) / picture.shape[0], np.ptp(columns) / picture.shape[1]) == pytest.approx(0.92, abs=0.03)


def test_the_page_shows_the_code_of_the_pictures() -> None:
    """Lines that belong to a picture, and all pictures."""
    page = (ROOT / "docs" / "building.md").read_text("utf-8")
    code = "".join((ROOT / name).read_text("utf-8") for name in draw_building.PICTURES)
    statements = {" ".join(line.split()) for line in code.splitlines()}
    shown = re.findall(r"^!\[.*?\]\(images/building-(.+?)\.png\)\n\n```solidity\n(.*?)^```", page, re.M | re.S)
    lines = [line for _, block in shown for line in block.splitlines()]
    assert len(lines) > 10
    assert not [line for line in lines if not any(line in each for each in statements)]
    pictures = [name for names in draw_building.PICTURES.values() for name in names]
    assert sorted(pictures) == sorted(re.findall(r"images/building-(.+?)\.png", page))
