"""What the contracts return is read by an outside decoder: BMP, `data:` URI, SVG."""

from __future__ import annotations

import base64
import io
import struct
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from attrs import evolve
from PIL import Image as PillowImage

from made_scenes import flat, teapot_scene
from pictures import Pixels, call, counts, covered, draw, dynamic, soup, unlit_scene
from shackled import Background, Camera, Scene
from shackled.scene._in_range import in_range

SVG = "{http://www.w3.org/2000/svg}"


def scene_of_size(width: int, height: int) -> Scene:
    return evolve(in_range(flat(teapot_scene())), width=width, height=height)


def decode(data: bytes) -> Pixels:
    with PillowImage.open(io.BytesIO(data)) as picture:
        assert picture.format == "BMP"
        assert picture.mode == "RGB"
        return np.array(picture)


def header(bmp: bytes) -> tuple[int, ...]:
    assert bmp[:2] == b"BM"
    return struct.unpack("<IHHI IiiHHIIiiII", bmp[2:54])


@pytest.mark.parametrize("width", range(1, 10))
@pytest.mark.parametrize("height", [1, 2, 7])
def test_headers_and_padding(width: int, height: int) -> None:
    scene = Scene([], Camera(near=1), [], Background((10, 20, 30), (250, 130, 7)), width=width, height=height)
    output = call("render", scene).output
    bmp = dynamic(output)
    stride = (3 * width + 3) // 4 * 4
    size = stride * height
    assert len(bmp) == 54 + size
    # offset, length, the file, zeros up to a whole word, and no more
    assert len(output) == 64 + (54 + size + 31) // 32 * 32
    assert not any(output[64 + 54 + size :])
    assert header(bmp) == (54 + size, 0, 0, 54, 40, width, height, 1, 24, 0, size, 2835, 2835, 0, 0)
    rows = np.frombuffer(bmp, np.uint8, offset=54).reshape(height, stride)
    assert not rows[:, 3 * width :].any()
    pixels = decode(bmp)
    assert pixels.shape == (height, width, 3)
    assert (pixels[::-1, :, ::-1].reshape(height, -1) == rows[:, : 3 * width]).all()
    assert (pixels[0] == (10, 20, 30)).all()
    if height > 1:
        assert (pixels[-1] == (250, 130, 7)).all()


@pytest.mark.parametrize(("width", "height"), [(33, 9), (1, 1), (130, 131)])
def test_all_entry_points_return_the_same_picture(width: int, height: int) -> None:
    scene = scene_of_size(width, height)
    bmp = dynamic(call("render", scene).output)
    pixels = decode(bmp)
    counted = call("renderCounted", scene).output
    assert dynamic(counted) == bmp
    assert len(counted) == 128 + (len(bmp) + 31) // 32 * 32

    uri = dynamic(call("renderDataURI", scene).output).decode("ascii")
    assert uri == "data:image/bmp;base64," + base64.b64encode(bmp).decode("ascii")

    svg = dynamic(call("renderSVG", scene).output).decode("ascii")
    root = ElementTree.fromstring(svg)
    assert root.tag == f"{SVG}svg"
    assert root.get("viewBox") == f"0 0 {width} {height}"
    (image,) = root
    assert image.tag == f"{SVG}image"
    assert (image.get("width"), image.get("height")) == (str(width), str(height))
    assert image.get("style") == "image-rendering:pixelated"
    kind, _, data = (image.get("href") or "").partition(",")
    assert kind == "data:image/bmp;base64"
    assert (decode(base64.b64decode(data, validate=True)) == pixels).all()


@pytest.mark.parametrize(("width", "height"), [(5, 1), (1, 2), (5, 300), (3, 1024)])
def test_gradients_end_in_their_colors(width: int, height: int) -> None:
    """That of one row is its top."""
    top, bottom = np.random.default_rng(1).integers(0, 256, (2, 3))
    scene = Scene([], Camera(near=1), background=Background(top, bottom), width=width, height=height)
    part = np.arange(height)[:, None, None] / max(height - 1, 1)
    picture = draw(scene)
    assert (picture[0] == top).all()
    assert (picture[-1] == (bottom if height > 1 else top)).all()
    assert np.abs(picture - (top + (bottom - top) * part)).max() <= 0.501
    assert (draw(evolve(scene, invert=True)) == 255 - picture).all()


def test_lit_pixels_are_those_that_are_covered() -> None:
    """Of the last picture in several bands."""
    for width, height in ((1, 1), (31, 17), (150, 140)):
        scene = scene_of_size(width, height)
        assert counts(scene)[1] == covered(evolve(scene, background=Background((0, 0, 0)))).sum()


def test_triangles_are_those_that_face_the_eye() -> None:
    corners = np.array([[-50, -50, -300], [50, -50, -300], [0, 50, -300]])
    away, behind = corners[::-1], corners * [1, 1, -1]
    mesh = soup([corners, away, behind, corners * [1, 1, 2], corners - [10000, 0, 0]])
    both = unlit_scene(mesh, Camera(near=1), 20)
    # what is beside the picture does not count, nor what is behind the eye
    assert counts(both)[0] == 3
    assert counts(evolve(both, objects=[evolve(both.objects[0], cull=True)]))[0] == 2
    far_beside = soup(corners - [1_000_000, 0, 0])
    assert counts(unlit_scene(far_beside, Camera(near=1), 20))[0] == 0
