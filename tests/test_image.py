"""Pictures as files."""

from __future__ import annotations

import io
import os
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

from shackled import Animation, Camera, Image, InputError, Light, Mesh, Object, OutputError, RenderError, Scene, render
from shackled._on import Embedded
from shackled.animation import check_animation
from shackled.artifacts import artifact
from shackled.chain import CallResult, RevmChain, open_chain
from shackled.errors import OutOfGasError
from shackled.image import FORMATS, check_output, decode_bmp
from shackled.parallel import Counter
from shackled.scene import encode

#: Formats that are only near.
JPEG = {".jpg", ".jpeg"}
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


def bmp_of(pixels: np.ndarray, **options: Any) -> bytes:
    stream = io.BytesIO()
    PillowImage.fromarray(pixels).save(stream, "BMP", **options)
    return stream.getvalue()


def test_render_fills_every_field(image: Image) -> None:
    assert image.pixels.shape == (21, 37, 3)
    assert image.pixels.dtype == np.uint8
    assert (image.width, image.height) == (37, 21)
    assert image.gas is not None
    assert image.gas > 100_000
    assert image.intrinsic_gas is not None
    assert image.intrinsic_gas > 21_000
    assert image.triangles == 1
    assert image.covered_pixels == np.count_nonzero(image.pixels.any(axis=2))
    assert image.made_by.startswith("embedded EVM (")
    assert image.seconds > 0


def test_the_gas_is_that_of_render_alone(image: Image) -> None:
    chain = open_chain()
    assert image.gas == chain.call("Renderer", encode(artifact("Renderer").selectors["render"], SCENE)).gas


def test_sizes(image: Image) -> None:
    assert render(SCENE, size=8).pixels.shape == (8, 8, 3)
    assert (render(SCENE, size=(37, 21)).pixels == image.pixels).all()
    for size in (0, 2049, (5, 0), "big", (1, 2, 3), 1.5):
        with pytest.raises(InputError):
            render(SCENE, size=size)  # type: ignore[arg-type]


@pytest.mark.parametrize("extension", [*(name for name in FORMATS if name not in (".svg", *JPEG)), ".PNG"])
def test_files_hold_the_pixels_of_the_contract(image: Image, tmp_path: Path, extension: str) -> None:
    few = evolve(image, pixels=image.pixels & np.uint8(0xC0))
    few = evolve(few, bmp=bmp_of(few.pixels))
    path = tmp_path / f"picture{extension}"
    few.save(path)
    with PillowImage.open(path) as picture:
        assert (np.array(picture.convert("RGB")) == few.pixels).all()
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_a_bmp_is_what_the_contract_returned(image: Image, tmp_path: Path) -> None:
    image.save(tmp_path / "a.bmp")
    assert (tmp_path / "a.bmp").read_bytes() == image.bmp


def test_a_gif_of_many_colours_is_near(image: Image) -> None:
    rng = np.random.default_rng(0)
    pixels = rng.integers(0, 256, (40, 40, 3)).astype(np.uint8) // 8
    with PillowImage.open(io.BytesIO(evolve(image, pixels=pixels).encode(".gif"))) as picture:
        difference = np.abs(np.array(picture.convert("RGB")).astype(int) - pixels)
    assert 0 < difference.max() < 16


def test_a_jpeg_is_near(image: Image) -> None:
    assert image.encode("jpg") == image.encode("jpeg")
    with PillowImage.open(io.BytesIO(image.encode(".jpg"))) as picture:
        assert (picture.format, picture.mode) == ("JPEG", "RGB")
        difference = np.abs(np.array(picture).astype(int) - image.pixels)
    assert 0 < difference.mean() < 2


def test_an_svg_holds_a_png(image: Image, tmp_path: Path) -> None:
    """The contract's holds a bitmap, which servers of images leave blank; else they are the same."""
    image.save(tmp_path / "a.svg")
    text = (tmp_path / "a.svg").read_text("utf-8")
    chain = open_chain()
    output = chain.call("Renderer", encode(artifact("Renderer").selectors["renderSVG"], SCENE)).output
    theirs = ElementTree.fromstring(output[64 : 64 + int.from_bytes(output[32:64], "big")])
    ours = ElementTree.fromstring(text)
    assert ours.attrib == theirs.attrib
    assert ours[0].attrib | {"href": ""} == theirs[0].attrib | {"href": ""}
    assert "pixelated" in ours[0].attrib["style"]
    assert b64decode(theirs[0].attrib["href"].partition(",")[2]) == image.bmp
    with PillowImage.open(io.BytesIO(b64decode(ours[0].attrib["href"].partition(",")[2]))) as picture:
        assert picture.format == "PNG"
        assert (np.array(picture.convert("RGB")) == image.pixels).all()


def test_a_notebook_shows_it(image: Image) -> None:
    with PillowImage.open(io.BytesIO(image._repr_png_())) as picture:
        assert (np.array(picture) == image.pixels).all()


@pytest.mark.parametrize("name", ["picture.tiff", "picture", "picture.png.txt", ".png"])
def test_unknown_formats(image: Image, tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match=re.escape(f"must end in one of {' '.join(FORMATS)}")):
        image.save(tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_formats_with_and_without_a_dot(image: Image) -> None:
    for name in FORMATS:
        assert image.encode(name) == image.encode(name[1:]) == image.encode(name.upper())
    assert image.encode("bmp") == image.bmp
    for wrong in ("tiff", ".xyz", "", ".", "png.png", None, 3):
        with pytest.raises(InputError, match=re.escape(f"the format must be one of {' '.join(FORMATS)}, not ")):
            image.encode(wrong)  # type: ignore[arg-type]


def test_it_shows_itself_in_a_line(image: Image) -> None:
    assert repr(image) == f"<Image 37x21, {image.gas:,} gas>"
    assert repr(evolve(image, gas=35_312_345)) == "<Image 37x21, 35.3M gas>"
    assert repr(evolve(image, gas=None, scene=None)) == "<Image 37x21>"


def test_images_are_values(image: Image) -> None:
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


def test_each_format_holds_the_pixels(image: Image) -> None:
    """Of few colours, so that all formats can."""
    few = evolve(image, pixels=image.pixels & np.uint8(0xC0), bmp=b"")
    for extension in FORMATS.keys() - JPEG:
        data = few.encode(extension)
        if extension == ".svg":
            data = b64decode(ElementTree.fromstring(data.decode())[0].attrib["href"].partition(",")[2])
        with PillowImage.open(io.BytesIO(data)) as picture:
            assert (np.array(picture.convert("RGB")) == few.pixels).all()


def test_counts_are_calls_of_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """Made at the first access, on the same chain and in tiles that are no larger; the gas is that of `render`."""
    made: list[bytes] = []

    def counted(to: bytes, data: bytes, gas_limit: int) -> CallResult:
        made.append(data[:4])
        return run(to, data, gas_limit)

    chain = RevmChain()
    expected = chain.count(SCENE)
    run = chain._run
    monkeypatch.setattr(chain, "_run", counted)
    selectors = artifact("Renderer").selectors
    for tile, draws, counts in ((None, ["render"], ["renderCounted"]), ((37, 7), ["renderTile"] * 3, TILES)):
        made.clear()
        image = render(SCENE, on=chain, tile=tile)
        assert repr(image).endswith(" gas>")
        assert made == [selectors[each] for each in draws]
        made.clear()
        assert (image.triangles, image.covered_pixels) == expected == (image.triangles, image.covered_pixels)
        assert made == [selectors[each] for each in counts]
    assert "Embedded" not in repr(image.counter)
    copied = pickle.loads(pickle.dumps(image))
    made.clear()
    assert (copied.triangles, copied.covered_pixels) == expected
    # the chain stayed where it was, so the embedded EVM counts
    assert made == []


#: Strips of seven rows, of which each shares one with the next: 0 to 6, 6 to 12, 12 to 18, 18 to 20.
TILES = ["renderTileCounted"] * 7


def test_a_strip_that_takes_too_much_gas_is_halved() -> None:
    chain = RevmChain(300_000)
    with pytest.raises(OutOfGasError):
        chain.count(SCENE)
    assert Counter(Embedded(chain), 37 * 21)(SCENE) == RevmChain().count(SCENE)


def test_a_picture_of_unknown_scene_has_no_counts(image: Image) -> None:
    assert evolve(image, scene=None).triangles is None
    # one without means is counted in the embedded EVM
    assert evolve(image, counter=None).covered_pixels == image.covered_pixels


def test_a_folder_that_cannot_be_written_to(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is told before anything is rendered."""
    monkeypatch.setattr("os.access", lambda path, mode: False)
    for check, name in ((check_output, "a.png"), (check_animation, "a.gif"), (check_animation, "frames")):
        with pytest.raises(InputError, match=rf"{name} cannot be written: nothing can be written to its folder"):
            check(tmp_path / name)


def test_places_that_are_not_there(image: Image, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        image.save(tmp_path / "missing" / "a.png")
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(InputError, match="is a folder"):
        image.save(tmp_path / "folder.png")


def test_nothing_is_left_of_a_failed_write(image: Image, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.png").write_bytes(b"before")

    def refuse(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(OutputError, match=r"a\.png cannot be written: No space left on device"):
        image.save(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes() == b"before"
    assert len(list(tmp_path.iterdir())) == 1


def test_only_the_right_bitmap_is_taken(image: Image) -> None:
    assert (decode_bmp(image.bmp, 37, 21) == image.pixels).all()
    png = io.BytesIO()
    PillowImage.fromarray(image.pixels).save(png, "PNG")
    wrong = [
        b"",
        b"BM",
        png.getvalue(),
        image.bmp[:-1],
        image.bmp + b"\0",
        image.bmp[:2] + bytes(4) + image.bmp[6:],
        image.bmp[:18] + b"\x26" + image.bmp[19:],
        bmp_of(image.pixels[:, :, 0]),
        bmp_of(image.pixels[:20]),
    ]
    for data in wrong:
        with pytest.raises(RenderError, match="the contract "):
            decode_bmp(data, 37, 21)
