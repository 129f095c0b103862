"""Pictures without a background: alpha from two pictures, by Python and by the contracts."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image as PillowImage
from PIL import ImageSequence
from tools.ledger import call_data

from pictures import chain, dynamic
from shackled import (
    Animation,
    Background,
    Fog,
    Ground,
    Image,
    InputError,
    Material,
    Object,
    Processes,
    RenderError,
    Rim,
    Scene,
    Tone,
    load,
    render,
    turntable,
)
from shackled.artifacts import artifact
from shackled.cli.app import run
from shackled.image import FORMATS, encode_bmp, uncovered
from shackled.scene import Hemisphere, encode
from shackled.scene._turning import full_turn

Pixels = NDArray[np.uint8]
GRADIENT = Background("#2060c0", "#f0c080")
SIDE = 48


def glass(antialias: bool = True, **changes: Any) -> Scene:
    """A teapot behind a pane of glass, of which edges are in the picture."""
    pot = load("teapot", size=SIDE, antialias=antialias, background=GRADIENT)
    pane = load("cube").objects[0].mesh
    near = Object(pane, (0.5, 0.5, 0.7), (0.1, 0.2, 0, 1), 0.6, Material("flat"), opacity=0.4)
    return evolve(pot, objects=[*pot.objects, near], **changes)


def over(image: Image, background: NDArray[np.float64]) -> NDArray[np.float64]:
    """Show a picture before a background."""
    assert image.alpha is not None
    share = image.alpha[:, :, None] / 255
    return np.asarray(image.pixels * share + background * (1 - share))


def gradient() -> NDArray[np.float64]:
    """The background of the scene, as an empty scene shows it."""
    return render(Scene([], background=GRADIENT, width=SIDE, height=SIDE)).pixels.astype(float)


def opened(png: bytes) -> Pixels:
    with PillowImage.open(io.BytesIO(png)) as picture:
        picture.verify()
    with PillowImage.open(io.BytesIO(png)) as picture:
        assert picture.mode == "RGBA"
        return np.asarray(picture)


def enlarged(pixels: Pixels, scale: int) -> Pixels:
    return pixels.repeat(scale, 0).repeat(scale, 1)


# ---- in Python ----


#: A ground that fades into the background, a shadow on it, fog, light and tone: none changes the background.
EFFECTS: dict[str, Any] = {
    "lights": [evolve(load("teapot").lights[0], shadow=True)],
    "ground": Ground("#e0c8b0"),
    "fog": Fog("#8090a0", 2, 12),
    "hemisphere": Hemisphere("#405060", "#302010"),
    "rim": Rim("#6070ff"),
    "tone": Tone(1.5, filmic=True, gamma=True),
}


@pytest.mark.parametrize(
    "changes",
    [{"antialias": False}, {}, {"invert": True}, EFFECTS],
    ids=["plain", "antialiased", "inverted", "effects"],
)
def test_before_its_own_background_it_is_the_picture(changes: dict[str, Any]) -> None:
    scene = glass(**changes)
    found = render(scene, transparent=True)
    assert found.alpha is not None
    behind = 255 - gradient() if scene.invert else gradient()
    # each of the three pictures is rounded, and so is alpha
    assert np.abs(over(found, behind) - render(scene).pixels).max() <= 2
    assert (found.pixels[found.alpha == 0] == 0).all()
    # the glass, and edges that are antialiased
    levels = set(np.unique(found.alpha).tolist())
    assert {102, 255} <= levels
    assert (len(levels) > 5) == scene.antialias
    plain = render(evolve(scene, invert=False), transparent=True)
    assert np.array_equal(np.asarray(found.alpha), np.asarray(plain.alpha))


def test_opaque_objects_are_as_they_were() -> None:
    """At the cost of two pictures."""
    scene = load("teapot", size=SIDE, antialias=False)
    found, picture = render(scene, transparent=True), render(scene)
    assert found.alpha is not None
    assert set(np.unique(found.alpha)) == {0, 255}
    shown = found.alpha == 255
    assert shown.sum() == picture.covered_pixels == found.covered_pixels
    assert (found.pixels[shown] == picture.pixels[shown]).all()
    backgrounds = ["black", "white"]
    assert found.gas == sum(render(evolve(scene, background=Background(each))).gas or 0 for each in backgrounds)
    assert (found.calls, found.scene) == (2, scene)


def test_in_tiles_it_is_the_same() -> None:
    scene = glass()
    whole, parts = render(scene, transparent=True), render(scene, transparent=True, on=Processes(1), tile=20)
    assert (whole.channels == parts.channels).all()
    assert parts.calls == 18


def test_files() -> None:
    image = render(glass(), transparent=True)
    assert (opened(image.encode(".png")) == image.channels).all()
    assert np.asarray(image).shape == (SIDE, SIDE, 4)
    assert image.to_pil().mode == "RGBA"
    assert (opened(image.encode(".webp")) == image.channels).all()
    assert b"data:image/png" in image.encode(".svg")
    plain = [extension for extension, each in FORMATS.items() if not each.has_alpha]
    assert {".bmp", ".gif", ".jpg"} <= {*plain}
    for extension in plain:
        with pytest.raises(InputError, match=rf"needs a \.png \..* file: {extension} has no alpha channel"):
            image.encode(extension)
    with pytest.raises(InputError, match=r"alpha must have the shape \(48, 48\) of the picture, not \(2, 2\)"):
        Image(image.pixels, alpha=np.zeros((2, 2)))
    assert image != Image(image.pixels, scene=image.scene)
    assert image.sha256 != Image(image.pixels).sha256


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "cube.png"
    assert run(["render", "cube", "--size", "24", "--transparent", "--json", "-o", str(path)]) == 0
    report = json.loads(capsys.readouterr().out)
    expected = render("cube", 24, transparent=True)
    assert (report["gas"], report["calls"], report["sha256"]) == (expected.gas, 2, expected.sha256)
    assert (opened(path.read_bytes()) == expected.channels).all()
    # the scene in the file has its background
    assert (render(path).pixels == render("cube", 24).pixels).all()


@pytest.mark.parametrize("invert", [[], ["--invert"]])
def test_a_turntable(
    invert: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    expected = turntable("cube", 3, 24, transparent=True, invert=bool(invert))
    # as a picture of the first frame is
    first = render(full_turn(load("cube", 24, invert=bool(invert)), 3)[0], transparent=True)
    assert (expected.frames[0].channels == first.channels).all()
    assert first.channels[:, :, 3].min() == 0
    for name in ("a.png", "a.webp", "frames"):
        options = ["--size", "24", "--turntable", "3", "--background", "none", *invert, "-o", name]
        assert run(["render", "cube", "--json", *options]) == 0
        report = json.loads(capsys.readouterr().out)
        assert (report["frames"], report["calls"], report["gas"]) == (3, 6, expected.gas)
        if name == "frames":
            found = [opened(path.read_bytes()) for path in sorted(Path(name).iterdir())]
        else:
            with PillowImage.open(name) as film:
                found = [np.array(frame.convert("RGBA")) for frame in ImageSequence.Iterator(film)]
        assert len(found) == 3
        for shown, frame in zip(found, expected.frames, strict=True):
            # what nothing is seen of may have any colour
            assert ((shown == frame.channels) | (frame.channels[:, :, 3:] == 0)).all()
            assert (shown[:, :, 3] == frame.alpha).all()
    with pytest.raises(InputError, match=r"needs a \.png or \.webp file: \.gif has no alpha"):
        expected.encode(".gif")
    with pytest.raises(InputError, match="must all have alpha, or none"):
        Animation([expected.frames[0], Image(expected.frames[1].pixels)])
    with pytest.raises(InputError, match="`one_call` and `transparent` exclude each other"):
        turntable("cube", 3, 24, transparent=True, one_call=True)


# ---- by the contracts ----


def encoded(black: Pixels, white: Pixels, scale: int) -> bytes:
    data = call_data("encodeTransparent(bytes,bytes,uint256)", encode_bmp(black), encode_bmp(white), scale)
    return bytes(dynamic(chain().call("PngEncoder", data).output))


@st.composite
def pairs(draw: st.DrawFn) -> tuple[Pixels, Pixels]:
    """Pictures over black and over white, with transparent runs and any other pixels."""
    height, width = draw(st.integers(1, 20)), draw(st.integers(1, 150))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    few = random.integers(0, 256, (6, 2, 3), np.uint8)
    few[0] = (0, 0, 0), (255, 255, 255)
    few[1, 1] = few[1, 0]
    lengths = random.geometric(draw(st.sampled_from([0.02, 0.2, 0.9])), height * width)
    both = few[random.integers(0, 6, height * width).repeat(lengths)[: height * width]].reshape(height, width, 2, 3)
    return both[:, :, 0], both[:, :, 1]


@settings(max_examples=60, deadline=None)
@given(pictures=pairs(), scale=st.integers(1, 8))
def test_any_two_pictures(pictures: tuple[Pixels, Pixels], scale: int) -> None:
    black, white = pictures
    expected = uncovered(Image(black), Image(white)).channels
    assert (opened(encoded(black, white, scale)) == enlarged(expected, scale)).all()


@pytest.mark.parametrize("shape", [(1, 1), (1, 1024), (300, 1), (2, 513)])
def test_odd_sizes(shape: tuple[int, int]) -> None:
    black, white = np.random.default_rng(2).integers(0, 256, (2, *shape, 3), np.uint8)
    for first, second in ((black, white), (0 * black, 0 * white + 255)):
        expected = uncovered(Image(first), Image(second)).channels
        assert (opened(encoded(first, second, 8)) == enlarged(expected, 8)).all()


def test_pictures_that_do_not_belong_together() -> None:
    small, large = np.zeros((2, 3, 3), np.uint8), np.zeros((2, 4, 3), np.uint8)
    with pytest.raises(RenderError, match=r"SizesDiffer\(width=3, height=2, otherWidth=4, otherHeight=2\)"):
        encoded(small, large, 1)
    for scale in (0, 9):
        with pytest.raises(RenderError, match=rf"PixelScaleOutOfRange\(scale={scale}, largest=8\)"):
            encoded(small, small, scale)
    data = call_data("encodeTransparent(bytes,bytes,uint256)", encode_bmp(small), b"BM", 1)
    with pytest.raises(RenderError, match=r"NotABitmap\(\)"):
        chain().call("PngEncoder", data)


@pytest.mark.parametrize("scene", [glass(), glass(invert=True)], ids=["", "inverted"])
def test_the_studio_draws_it(scene: Scene) -> None:
    expected = render(scene, transparent=True).channels
    for scale in (1, 4):
        data = encode(artifact("Studio").selectors["drawTransparentPNG"], scene, None, scale)
        assert (opened(dynamic(chain().call("Studio", data).output)) == enlarged(expected, scale)).all()
    data = encode(artifact("Studio").selectors["drawTransparentDataURI"], scene, None, 1)
    uri = bytes(dynamic(chain().call("Studio", data).output))
    assert uri.startswith(b"data:image/png;base64,iVBORw0KGgo")
