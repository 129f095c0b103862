"""docs/studio.md: its pictures, and the contracts of its examples."""

from __future__ import annotations

import base64
import re
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from eth_abi.abi import decode, encode
from PIL import Image as PillowImage
from tools.docs import draw_library
from tools.docs.draw_library import Shelf
from tools.pages import IMAGES

from compiler import needs_compiler
from pictures import pixels_of
from shackled import render
from shackled.artifacts import artifact
from shackled.datasets import pieces
from shackled.library import chosen_items, items
from shackled.scene._arithmetic import from_euler, rotate

ROOT = Path(__file__).resolve().parents[2]
SITE = "examples/library/PedestalSite.sol"
#: Of the contact sheet: the sides of a picture, the height of its name, and the pictures in a row.
SIDE, LABEL, COLUMNS = 128, 22, 8


@pytest.fixture(scope="module")
def shelf() -> Shelf:
    return Shelf(chosen_items((*draw_library.ON_PEDESTALS, *draw_library.IN_COMPARTMENTS)))


def objects_of(scene: bytes) -> list[Any]:
    """The objects of an ABI-encoded scene."""
    (struct,) = decode([artifact("Renderer").interface.parameter_type("render")], scene)
    return list(struct[-2])


def test_the_contact_sheet(shelf: Shelf) -> None:
    sheet = pixels_of(IMAGES / "library.png")
    assert sheet.shape == (-(-len(items()) // COLUMNS) * (SIDE + LABEL), COLUMNS * SIDE, 3)
    for number, item in enumerate(items()):
        if item.name in draw_library.ON_PEDESTALS:
            x, y = number % COLUMNS * SIDE, number // COLUMNS * (SIDE + LABEL)
            difference = np.abs(draw_library.picture(shelf, item).astype(int) - sheet[y : y + SIDE, x : x + SIDE])
            assert difference.mean() < 0.5, "run python -m tools.docs.draw_library"


@needs_compiler
def test_scenes_of_the_example(shelf: Shelf) -> None:
    """Items stand on pedestals, and fill their compartments."""
    *standing, compartments = draw_library.scenes(shelf)
    for name, scene in zip(draw_library.ON_PEDESTALS, standing, strict=True):
        (item,) = chosen_items([name])
        *parts, stone = objects_of(scene)
        assert [part[0][1:] for part in parts] == item.meshes
        for _, position, _, scale, *_ in parts:
            low, high = ((bounds * scale + np.array(position)) / 2**32 for bounds in (item.low, item.high))
            assert low[1] == pytest.approx(0, abs=1e-4)
            assert (low + high)[[0, 2]] == pytest.approx(0, abs=1e-4)
            assert (high - low).max() == pytest.approx(100, abs=0.1)
        assert stone[1] == (0, 0, 0)
    found = objects_of(compartments)
    for k, name in enumerate(draw_library.IN_COMPARTMENTS):
        (item,) = chosen_items([name])
        for _, position, _, scale, *_ in (each for each in found if each[0][1:] in item.meshes):
            corners = np.array([*product(*zip(item.low, item.high, strict=True))], float)
            placed = (rotate(from_euler((0, 20, 0)), corners) * scale + np.array(position)) / 2**32
            size, middle = np.ptp(placed, axis=0), (placed.min(axis=0) + placed.max(axis=0)) / 2
            assert size.max() == pytest.approx(100, abs=0.1)
            assert middle == pytest.approx([120 * k + 50, 50, 50], abs=0.1)


@needs_compiler
def test_the_picture_of_the_example() -> None:
    with PillowImage.open(IMAGES / "library-pedestal.png") as kept:
        difference = np.abs(np.asarray(draw_library.example_picture()).astype(int) - np.asarray(kept))
    assert difference.mean() < 0.5, "run python -m tools.docs.draw_library"


@needs_compiler
def test_a_portrait(shelf: Shelf) -> None:
    (crown,) = chosen_items(["crown"])
    contract, selectors = shelf.deploy(draw_library.EXAMPLE)
    output = shelf.call(contract, selectors["portrait(string)"] + encode(["string"], ["crown"]))
    png = base64.b64decode(decode(["string"], output)[0].removeprefix("data:image/png;base64,"), validate=True)
    assert np.array_equal(draw_library.pixels(png)[::4, ::4], render(crown.scene).pixels)


@needs_compiler
def test_a_site_of_ones_own(shelf: Shelf) -> None:
    site, selectors = shelf.deploy(SITE)
    assert shelf.call(site, selectors["resolveMode()"]) == b"5219".ljust(32, b"\0")
    status, body, headers = shelf.ask(site, "")
    assert (status, headers) == (200, {"Content-Type": "text/html"})
    assert re.findall(rb'href="/(.+?)"', body) == [item.name.encode() for item in items()]
    status, body, headers = shelf.ask(site, "/crown")
    assert (status, headers) == (200, {"Content-Type": "image/png"})
    crown = shelf.draw(draw_library.scenes(shelf)[draw_library.ON_PEDESTALS.index("crown")])
    assert np.array_equal(draw_library.pixels(body), crown.repeat(4, 0).repeat(4, 1))
    # one that is not stored, and none
    for path in ("/coin", "/gold"):
        assert shelf.ask(site, path)[::2] == (404, {"Content-Type": "text/plain"})


def test_the_page_shows_the_code_of_the_example() -> None:
    page = (ROOT / "docs" / "studio.md").read_text("utf-8")
    page = page.partition("\n## The library\n")[2].partition("\n## web3:")[0]
    code = (ROOT / draw_library.EXAMPLE).read_text("utf-8")
    statements = {line.strip() for line in code.splitlines()}
    shown = re.findall(r"^```solidity\n(.*?)^```", page, re.M | re.S)
    lines = [line.strip() for block in shown for line in block.splitlines() if line]
    assert len(lines) > 10
    assert not [line for line in lines if line not in statements]


def test_licences() -> None:
    """They are as the page says."""
    licences = {piece.name: piece.licence for piece in pieces()}
    assert {item.name for item in items() if licences[item.piece] != "MIT"} == {"glasses"}
    assert licences["icons/glasses"] == "CC0"
    assert "MIT licence, except the glasses, which are CC0" in (ROOT / "docs" / "studio.md").read_text("utf-8")
