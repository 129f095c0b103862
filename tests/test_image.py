"""Pictures as files."""

from __future__ import annotations

import io
import pickle
import re
import xml.etree.ElementTree as ElementTree
from base64 import b64decode
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from PIL import Image as PillowImage

from pictures import pixels_of
from shackled import Animation, Camera, Image, InputError, Light, Mesh, Object, Processes, RenderError, Scene, render
from shackled.animation import check_animation
from shackled.artifacts import artifact
from shackled.chain import open_chain
from shackled.chain._chain import ContractChain
from shackled.chain._embedded import RevmChain
from shackled.image import FORMATS, check_output, decode_bmp
from shackled.scene import encode

SCENE = Scene(
    [Object(Mesh([[-2, -1, 0], [2, -1, 0], [0, 2, 0]], [[0, 1, 2]], [[255, 0, 0], [0, 255, 0], [0, 0, 255]]))],
    Camera(eye=(0, 0, 4), target=(0, 0, 0)),
    [Light("point", (1, 2, 3))],
    width=37,
    height=21,
)


@pytest.fixture(scope="module")
def image() -> Image:
    return render(SCENE)


def bmp_of(pixels: np.ndarray) -> bytes:
    stream = io.BytesIO()
    PillowImage.fromarray(pixels).save(stream, "BMP")
    return stream.getvalue()


def in_svg(data: bytes) -> bytes:
    return b64decode(ElementTree.fromstring(data.decode())[0].attrib["href"].partition(",")[2])


def test_render_fills_every_field(image: Image) -> None:
    assert image.pixels.shape == (21, 37, 3)
    assert image.pixels.dtype == np.uint8
    assert (image.width, image.height, image.triangles) == (37, 21, 1)
    # that of `render` alone
    assert image.gas == open_chain().call("Renderer", encode(artifact("Renderer").selectors["render"], SCENE)).gas
    assert (image.intrinsic_gas or 0) > 21_000
    assert image.covered_pixels == np.count_nonzero(image.pixels.any(axis=2))
    assert image.made_by.startswith("embedded EVM (")
    assert image.seconds > 0


@pytest.mark.parametrize("extension", [*FORMATS, ".PNG"])
def test_files_hold_the_pixels_of_the_contract(image: Image, tmp_path: Path, extension: str) -> None:
    """Of few colours, so that all formats can; those of a JPEG are near."""
    few = Image(image.pixels & np.uint8(0xC0))
    path = tmp_path / f"picture{extension}"
    few.save(path)
    data = path.read_bytes()
    assert data == few.encode(extension) == few.encode(extension[1:]) == few.encode(extension.upper())
    difference = np.abs(pixels_of(in_svg(data) if extension == ".svg" else data).astype(int) - few.pixels)
    assert difference.mean() < 4 if "j" in extension else not difference.any()
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_files_that_are_near_or_the_contracts_own(image: Image) -> None:
    assert image.encode("bmp") == image.bmp
    assert (pixels_of(image._repr_png_()) == image.pixels).all()
    assert 0 < np.abs(pixels_of(image.encode("jpg")).astype(int) - image.pixels).mean() < 2
    pixels = np.random.default_rng(0).integers(0, 256, (40, 40, 3)).astype(np.uint8) // 8
    assert 0 < np.abs(pixels_of(Image(pixels).encode(".gif")).astype(int) - pixels).max() < 16


def test_an_svg_holds_a_png(image: Image) -> None:
    """The contract's holds a bitmap, which servers of images leave blank; else they are the same."""
    output = open_chain().call("Renderer", encode(artifact("Renderer").selectors["renderSVG"], SCENE)).output
    svg = output[64 : 64 + int.from_bytes(output[32:64], "big")]
    theirs, ours = ElementTree.fromstring(svg), ElementTree.fromstring(image.encode("svg").decode())
    assert ours.attrib == theirs.attrib
    assert ours[0].attrib | {"href": ""} == theirs[0].attrib | {"href": ""}
    assert "pixelated" in ours[0].attrib["style"]
    assert in_svg(svg) == image.bmp
    assert in_svg(image.encode("svg")).startswith(b"\x89PNG")


def test_other_formats_are_refused(image: Image, tmp_path: Path) -> None:
    for name in ("picture.tiff", "picture", "picture.png.txt", ".png"):
        with pytest.raises(InputError, match=re.escape(f"must end in one of {' '.join(FORMATS)}")):
            image.save(tmp_path / name)
    assert not list(tmp_path.iterdir())
    for wrong in ("tiff", ".xyz", "", ".", "png.png", None, 3):
        with pytest.raises(InputError, match=re.escape(f"the format must be one of {' '.join(FORMATS)}, not ")):
            image.encode(wrong)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="does not exist"):
        image.save(tmp_path / "missing" / "a.png")


def test_images_are_values(image: Image) -> None:
    assert repr(image) == f"<Image 37x21, {image.gas:,} gas>"
    assert repr(evolve(image, gas=35_312_345)) == "<Image 37x21, 35.3M gas>"
    assert repr(evolve(image, gas=None, scene=None)) == "<Image 37x21>"
    other = evolve(image, seconds=9.0)
    assert image == other
    assert hash(image) == hash(other)
    for changes in ({"pixels": 255 - image.pixels}, {"gas": 1}, {"made_by": "nowhere"}, {"scene": None}):
        assert evolve(image, **changes) != image
    with pytest.raises(ValueError, match="read-only"):
        image.pixels[0, 0] = 5
    with pytest.raises(AttributeError):
        image.gas = 5  # type: ignore[misc]
    assert Image(image.pixels.tolist()).bmp == image.bmp
    wrong_values = [image.pixels + np.int64(1) * 300, image.pixels - 0.5, np.full((2, 2, 3), np.nan), [[[-1, 2, 3]]]]
    for wrong in (image.pixels[0], image.pixels[:, :, :1], image.pixels[:0], "picture", [[1, 2], [3]], *wrong_values):
        with pytest.raises(InputError, match=r"^the pixels of a picture must be bytes of shape"):
            Image(wrong)


def test_open_files(image: Image, tmp_path: Path) -> None:
    for made in (image, Animation([image])):
        stream = io.BytesIO()
        made.save(stream, "png")
        assert stream.getvalue() == made.encode(".png")
        with (tmp_path / "a.gif").open("wb") as file:
            made.save(file)
        assert (tmp_path / "a.gif").read_bytes() == made.encode(".gif")
        with pytest.raises(InputError, match=r"^the format must be one of .*, not ''$"):
            made.save(io.BytesIO())
        with pytest.raises(InputError, match=r"^a picture is saved to a path or an open file, not to 5$"):
            made.save(5)  # type: ignore[arg-type]


def test_for_other_libraries(image: Image, monkeypatch: pytest.MonkeyPatch) -> None:
    assert (np.asarray(image) == image.pixels).all()
    assert np.asarray(image, np.float32).dtype == np.float32
    assert np.array(image).flags.writeable
    assert np.asarray(Animation([image, image])).shape == (2, *image.pixels.shape)
    assert (np.array(image.to_pil()) == image.pixels).all()
    assert len(Animation([image, image]).to_pil()) == 2
    for made, kinds in ((image, ("png", "bmp", "svg+xml", "gif")), (Animation([image]), ("png", "gif"))):
        for kind in kinds:
            head, _, data = made.data_uri(kind.partition("+")[0]).partition(",")
            assert head == f"data:image/{kind};base64"
            assert b64decode(data) == made.encode(kind.partition("+")[0])
    shown: list[Any] = []
    monkeypatch.setattr("PIL.Image.Image.show", lambda picture: shown.append(picture.size))
    monkeypatch.setattr("webbrowser.open", lambda uri: shown.append(Path(uri.removeprefix("file://"))))
    image.show()
    Animation([image]).show()
    assert shown[0] == (image.width, image.height)
    assert shown[1].read_bytes() == Animation([image]).encode(".png")
    shown[1].unlink()


def test_counts_are_calls_of_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """Made at the first access, in the EVM that drew the picture; the gas is that of `render`."""
    asked: list[str | None] = []

    def opened(evm: str | None) -> ContractChain:
        asked.append(evm)
        return open_chain()

    monkeypatch.setattr("shackled.image.open_chain", opened)
    expected = RevmChain().count(SCENE)
    for on, evm in ((None, None), ("pyevm", "pyevm"), (RevmChain(), None), (Processes(2), None)):
        image = render(SCENE, on=on)
        assert asked == []
        assert repr(image).endswith(" gas>")
        for each in (image, pickle.loads(pickle.dumps(image))):
            assert (each.triangles, each.covered_pixels) == expected
        assert asked == [evm, evm]
        asked.clear()


def test_a_picture_of_unknown_scene_has_no_counts(image: Image) -> None:
    assert evolve(image, scene=None).triangles is None


def test_a_folder_that_cannot_be_written_to(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is told before anything is rendered."""
    monkeypatch.setattr("os.access", lambda path, mode: False)
    for check, name in ((check_output, "a.png"), (check_animation, "a.gif"), (check_animation, "frames")):
        with pytest.raises(InputError, match=rf"{name} cannot be written: nothing can be written to its folder"):
            check(tmp_path / name)


def test_only_the_right_bitmap_is_taken(image: Image) -> None:
    assert (decode_bmp(image.bmp, 37, 21) == image.pixels).all()
    wrong = [
        *(b"", b"BM", image.encode("png"), image.bmp[:-1], image.bmp + b"\0"),
        image.bmp[:2] + bytes(4) + image.bmp[6:],
        image.bmp[:18] + b"\x26" + image.bmp[19:],
        bmp_of(image.pixels[:, :, 0]),
        bmp_of(image.pixels[:20]),
    ]
    for data in wrong:
        with pytest.raises(RenderError, match="the contract "):
            decode_bmp(data, 37, 21)
