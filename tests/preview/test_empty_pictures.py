"""Pictures that show only the background: mostly of faces that are clockwise."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage

import shackled
from preview.small_contracts import Made, answering, contract, function, output
from shackled.cli.app import run
from shackled.preview._preview import Preview, Request, Token
from shackled.preview._report import folded

TRIANGLE = shackled.Mesh([(0, 0, 0), (100, 0, 0), (0, 100, 0)], [(0, 2, 1)])
LINE = "the picture shows only the background: faces may be clockwise (swap two indices, or set object.flags = 0)"


def project(folder: Path, file: bytes) -> Made:
    source = folder / "Small.sol"
    source.write_text("contract Small {}")
    return Made(source, contract(answering(output(file)), function("image", "uint256", output="bytes")))


def problems(folder: Path, file: bytes, **request: Any) -> list[str]:
    return Preview(project(folder, file), Request(count=1, **request)).token(0).problems


def encoded(pixels: list[PillowImage.Image], kind: str) -> bytes:
    stream = io.BytesIO()
    pixels[0].save(stream, kind, save_all=len(pixels) > 1, append_images=pixels[1:])
    return stream.getvalue()


@pytest.mark.parametrize(
    ("look", "kind"),
    [({}, "PNG"), ({}, "BMP"), ({"antialias": True, "gamma": True}, "PNG"), ({"transparent": True}, "PNG")],
)
def test_a_clockwise_face(tmp_path: Path, look: dict[str, Any], kind: str) -> None:
    """The renderer's own pictures: with culling, of the background and nothing else; without, of the triangle."""
    for cull in (True, False):
        picture = shackled.render(TRIANGLE, size=24, azimuth=0, elevation=0, cull=cull, **look).to_pil()
        found = problems(tmp_path, encoded([picture], kind))
        assert [each.startswith(LINE) for each in found] == [True] * cull
        assert problems(tmp_path, encoded([picture], kind), allow_empty=True) == []


def test_one_pixel_is_enough(tmp_path: Path) -> None:
    rows = np.broadcast_to(np.arange(8, dtype=np.uint8)[:, None, None], (8, 8, 3)).copy()
    dotted = rows.copy()
    dotted[5, 7, 2] += 1
    empty, seen = (PillowImage.fromarray(each) for each in (rows, dotted))
    for pictures, is_empty in (
        ([empty], True),
        ([seen], False),
        ([empty, empty.rotate(180)], True),
        ([empty, seen], False),
    ):
        assert bool(problems(tmp_path, encoded(pictures, "PNG"))) is is_empty
    # formats that the renderer does not have, and pictures the rows of which cannot have two colours
    assert problems(tmp_path, encoded([empty], "GIF")) == []
    assert problems(tmp_path, encoded([PillowImage.fromarray(rows[:, :1])], "PNG")) == []


def test_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    made = project(tmp_path, encoded([PillowImage.new("RGB", (8, 8))], "PNG"))
    monkeypatch.setattr("shackled.cli.preview.Project", lambda source: made)
    words = ["preview", str(made.source), "--check", "--tokens", "1"]
    assert run(words) == 1
    assert LINE in capsys.readouterr().out
    assert run([*words, "--allow-empty"]) == 0


def test_equal_words_are_one_line_whatever_numbers_they_have() -> None:
    words = f"{LINE}; attribute 1 has no value"
    assert folded(Token(number, problems=[words]) for number in range(3)) == [("0 to 2", words)]
