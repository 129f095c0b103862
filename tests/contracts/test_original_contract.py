"""The interface of the original contracts draws what the original's scenes load as."""

from __future__ import annotations

import base64
import io
import xml.etree.ElementTree as ElementTree
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage

from original_scenes import call_data, document, documents
from pictures import Pixels, chain, dynamic
from shackled import RenderError
from shackled.artifacts import artifact
from shackled.image import decode_bmp
from shackled.scene._files.original import original_scene

SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
CUBE: dict[str, Any] = {
    "verts": [[x, y, z] for x in (-200, 200) for y in (-200, 200) for z in (-200, 200)],
    "faces": [face for a, b, c, d in SIDES for face in ([a, b, c], [a, c, d])],
    "cols": [[250 * (i & 1), 125 * (i & 2), 60 * (i & 4)] for i in range(8)],
    "objPosition": [60, -80, -1200],
    "backgroundColor": [[10, 20, 30], [200, 210, 220]],
}


def varied(light: dict[str, Any] | None = None, **changes: Any) -> dict[str, Any]:
    lit = {"lightDiffPower": 2000, "lightSpecPower": 1500, "lightPos": [-20, 30, 40], "lightColSpec": [255, 250, 240]}
    return document(40, lit | (light or {}), **CUBE | changes)


#: What those with which the original was measured do not have.
MADE = {
    "a lit cube": varied(),
    "wires of a lit cube": varied(wireframe=True, backfaceCulling=False),
    "an odd canvas": varied(canvasDim=37),
    "a coloured highlight": varied({"lightColSpec": [255, 90, 20]}),
    "shininess 128 and more": varied({"inverseShininess": 500}),
    "through the eye": varied(objPosition=[0, 0, -100]),
}


def original_call(drawn: dict[str, Any], svg: bool = False) -> str:
    return dynamic(chain().call("Original", call_data(drawn, svg)).output).decode("ascii")


def picture_of(uri: str) -> Pixels:
    kind, _, data = uri.partition(",")
    assert kind == "data:image/bmp;base64"
    with PillowImage.open(io.BytesIO(base64.b64decode(data, validate=True))) as picture:
        assert picture.format == "BMP"
        return np.array(picture)


def test_the_selector_is_that_of_the_original() -> None:
    assert artifact("Original").selectors["render"].hex() == "5d854cfd"


@pytest.mark.parametrize("name", [*MADE, *documents()])
def test_scenes_are_drawn_as_they_are_loaded(name: str) -> None:
    """Those made by hand, and those as the original was measured with."""
    drawn = MADE[name] if name in MADE else documents()[name]
    scene, picture = original_scene(drawn), picture_of(original_call(drawn))
    difference = np.abs(picture.astype(int) - decode_bmp(chain().draw(scene).bmp, scene.width, scene.height))
    assert difference.max() <= 1, f"{(difference > 1).any(axis=2).sum()} pixels, up to {difference.max()} levels"
    assert name not in MADE or picture.std() > 10


@pytest.mark.parametrize("name", ["a lit cube", "an odd canvas"])
def test_svg(name: str) -> None:
    kind, _, data = original_call(MADE[name], svg=True).partition(",")
    assert kind == "data:image/svg+xml;base64"
    root = ElementTree.fromstring(base64.b64decode(data, validate=True))
    (image,) = root.iter("{http://www.w3.org/2000/svg}image")
    assert (picture_of(image.get("href") or "") == picture_of(original_call(MADE[name]))).all()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"faces": [[0, 1, 8]]}, r"NoVertex\(face=0, vertex=8\)"),
        ({"faces": [[0, 1, 2], [1, 2, 2**256 - 1]]}, rf"NoVertex\(face=1, vertex={2**256 - 1}\)"),
        ({"cols": CUBE["cols"][:5]}, r"NoVertex\(face=1, vertex=\d+\)|NoVertex\(face=\d+, vertex=[567]\)"),
        ({"cols": [[0, 0, 256]] * 8}, r"ColorOutOfRange\(red=0, green=0, blue=256\)"),
        ({"cols": [[-1, 0, 0]] * 8}, r"ColorOutOfRange\(red=-1, green=0, blue=0\)"),
        ({"backgroundColor": [[0, 0, 0], [0, 300, 0]]}, r"ColorOutOfRange\(red=0, green=300, blue=0\)"),
        ({"verts": [[2**23, 0, 0]] * 8}, rf"VertexOutOfRange\(vertex=0, x={2**23}, y=0, z=0\)"),
        ({"objPosition": [0, 2**40, 0]}, rf"NumberOutOfRange\(value={2**40}\)"),
        ({"objScale": 2**255 - 1}, rf"NumberOutOfRange\(value={2**255 - 1}\)"),
        ({"light": {"lightPos": [0, 0, 0]}}, r"NoLightDirection\(\)"),
        ({"light": {"lightColDiff": [0, -5, 0]}}, r"ColorOutOfRange\(red=0, green=-5, blue=0\)"),
        ({"canvasDim": 0}, r"CanvasSize\(width=0, height=0\)"),
        ({"canvasDim": 2049}, r"CanvasSize\(width=2049, height=2049\)"),
        ({"canvasDim": -1}, r"CanvasSize"),
    ],
)
def test_what_is_wrong_is_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(RenderError, match=message):
        original_call(varied(**changes))
