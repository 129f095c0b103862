"""The interface of the original contracts draws what the original's scenes load as."""

from __future__ import annotations

import base64
import io
import xml.etree.ElementTree as ElementTree
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage

from original_scenes import call_data, documents
from pictures import Pixels, chain, dynamic
from shackled import RenderError, Scene
from shackled.artifacts import artifact
from shackled.image import decode_bmp
from shackled.scene._files.original import original_scene

CUBE: dict[str, Any] = {
    "canvasDim": 40,
    "verts": [[x, y, z] for x in (-200, 200) for y in (-200, 200) for z in (-200, 200)],
    "faces": [
        face
        for a, b, c, d in [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        for face in ([a, b, c], [a, c, d])
    ],
    "cols": [[250 * (i & 1), 125 * (i & 2), 60 * (i & 4)] for i in range(8)],
    "objPosition": [60, -80, -1200],
    "objScale": 1,
    "backgroundColor": [[10, 20, 30], [200, 210, 220]],
    "lightingParams": {
        "applyLighting": True,
        "lightAmbiPower": 0,
        "lightDiffPower": 2000,
        "lightSpecPower": 1500,
        "inverseShininess": 10,
        "lightPos": [-20, 30, 40],
        "lightColSpec": [255, 250, 240],
        "lightColDiff": [255, 250, 240],
        "lightColAmbi": [0, 0, 0],
    },
    "perspCamera": True,
    "backfaceCulling": True,
    "invert": False,
    "wireframe": False,
}


def varied(**changes: Any) -> dict[str, Any]:
    return {**CUBE, **changes, "lightingParams": {**CUBE["lightingParams"], **changes.get("lightingParams", {})}}


MADE = {
    "cube": varied(),
    "orthographic": varied(perspCamera=False, objScale=40, objPosition=[0, 0, -9000]),
    "unlit": varied(lightingParams={"applyLighting": False}),
    "wireframe": varied(wireframe=True, backfaceCulling=False),
    "inverted": varied(invert=True),
    "larger": varied(objScale=2, objPosition=[0, 0, -1500]),
    "mirrored": varied(objScale=-1),
    "an odd canvas": varied(canvasDim=37),
    "no diffuse light": varied(lightingParams={"lightDiffPower": 0}),
    "no highlight": varied(lightingParams={"lightSpecPower": 0}),
    "a coloured highlight": varied(lightingParams={"lightColSpec": [255, 90, 20]}),
    "shininess 128 and more": varied(lightingParams={"inverseShininess": 500}),
    "through the eye": varied(objPosition=[0, 0, -100]),
}


def original_call(document: dict[str, Any], svg: bool = False) -> str:
    return dynamic(chain().call("Original", call_data(document, svg)).output).decode("ascii")


def picture_of(uri: str) -> Pixels:
    kind, _, data = uri.partition(",")
    assert kind == "data:image/bmp;base64"
    with PillowImage.open(io.BytesIO(base64.b64decode(data, validate=True))) as picture:
        assert picture.format == "BMP"
        return np.array(picture)


def assert_like_loaded(document: dict[str, Any], scene: Scene) -> None:
    picture = picture_of(original_call(document))
    expected = decode_bmp(chain().draw(scene).bmp, scene.width, scene.height)
    difference = np.abs(picture.astype(int) - expected)
    assert difference.max() <= 1, f"{(difference > 1).any(axis=2).sum()} pixels, up to {difference.max()} levels"


def test_the_selector_is_that_of_the_original() -> None:
    assert artifact("Original").selectors["render"].hex() == "5d854cfd"


@pytest.mark.parametrize("name", MADE)
def test_scenes_made_by_hand(name: str) -> None:
    document = MADE[name]
    assert_like_loaded(document, original_scene(document))
    assert picture_of(original_call(document)).std() > 10


@pytest.mark.parametrize("name", documents())
def test_scenes_as_the_original_was_measured_with(name: str) -> None:
    document = documents()[name]
    assert_like_loaded(document, original_scene(document))


@pytest.mark.parametrize("name", ["cube", "an odd canvas", "wireframe"])
def test_svg(name: str) -> None:
    document = MADE[name]
    kind, _, data = original_call(document, svg=True).partition(",")
    assert kind == "data:image/svg+xml;base64"
    root = ElementTree.fromstring(base64.b64decode(data, validate=True))
    (image,) = root.iter("{http://www.w3.org/2000/svg}image")
    assert (picture_of(image.get("href") or "") == picture_of(original_call(document))).all()


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
        ({"lightingParams": {"lightPos": [0, 0, 0]}}, r"NoLightDirection\(\)"),
        ({"lightingParams": {"lightColDiff": [0, -5, 0]}}, r"ColorOutOfRange\(red=0, green=-5, blue=0\)"),
        ({"canvasDim": 0}, r"CanvasSize\(width=0, height=0\)"),
        ({"canvasDim": 2049}, r"CanvasSize\(width=2049, height=2049\)"),
        ({"canvasDim": -1}, r"CanvasSize"),
    ],
)
def test_what_is_wrong_is_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(RenderError, match=message):
        original_call(varied(**changes))
