"""PNG files: the contract against its model, byte for byte, and both against Pillow."""

from __future__ import annotations

import base64
import io
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image as PillowImage
from tools.ledger import call_data
from tools.png_code import CODE_LENGTHS, PIXEL, code_header, codes, encode_png, literal, match

from pictures import chain
from shackled import RenderError
from shackled.image import encode_bmp

ROOT = Path(__file__).resolve().parents[2]

Pixels = NDArray[np.uint8]
SHAPES = [(1, 1), (1, 1024), (300, 1), (2, 513)]


def contract_answer(pixels: Pixels | bytes, scale: int, function: str = "encode") -> bytes:
    bmp = pixels if isinstance(pixels, bytes) else encode_bmp(pixels)
    output = chain().call("PngEncoder", call_data(f"{function}(bytes,uint256)", bmp, scale)).output
    return output[64 : 64 + int.from_bytes(output[32:64], "big")]


def check(png: bytes, pixels: Pixels, scale: int) -> None:
    """The contract makes this file of a picture, and Pillow reads the picture in it."""
    assert contract_answer(pixels, scale) == png
    with PillowImage.open(io.BytesIO(png)) as picture:
        picture.verify()  # the checksums of the chunks
    with PillowImage.open(io.BytesIO(png)) as picture:
        assert picture.mode == "RGB"
        assert np.array_equal(np.asarray(picture), pixels.repeat(scale, 0).repeat(scale, 1))


@st.composite
def pictures(draw: st.DrawFn) -> Pixels:
    """Of one colour, of few, of many, smooth, or stripes; any size."""
    height, width = draw(st.integers(1, 40)), draw(st.integers(1, 90))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    slopes = random.normal(0, 3, (2, 3))
    plane = np.arange(height)[:, None, None] * slopes[0] + np.arange(width)[:, None] * slopes[1]
    kinds = {
        "one": random.integers(0, 256, 3),
        "few": random.integers(0, 256, (4, 3))[random.integers(0, 4, (height, width))],
        "noise": random.integers(0, 256, (height, width, 3)),
        "smooth": plane.astype(int) & 255,
        "columns": random.integers(0, 256, (width, 3)),
    }
    return np.broadcast_to(kinds[draw(st.sampled_from(list(kinds)))], (height, width, 3)).astype(np.uint8)


@settings(max_examples=60)
@given(pixels=pictures(), scale=st.integers(1, 8))
def test_any_picture(pixels: Pixels, scale: int) -> None:
    check(encode_png(pixels, scale), pixels, scale)


@pytest.mark.parametrize(
    ("pixels", "scales"),
    [
        *((np.random.default_rng(3).integers(0, 3, (*shape, 3), np.uint8), (1, 8)) for shape in SHAPES),
        # rows that are longer than the code of nine longest runs, and runs that end anywhere
        (np.where(np.isin(np.arange(3000), (700, 1086, 1087))[:, None], (1, 2, 3), 0).reshape(3, 1000, 3), (1, 3, 8)),
        # the sums of Adler-32 pass 2^16 many times, and the checksum of the data goes over many words
        (np.random.default_rng(5).integers(128, 256, (128, 128, 3)), (4,)),
    ],
)
def test_odd_pictures(pixels: Pixels, scales: tuple[int, ...]) -> None:
    pixels = pixels.astype(np.uint8)
    for scale in scales:
        check(encode_png(pixels, scale), pixels, scale)


def test_a_file_without_sums() -> None:
    """What is left to others: checksums, the size of the data, and the last chunk."""
    pixels = np.random.default_rng(6).integers(0, 256, (9, 70, 3), np.uint8)
    whole, bare = encode_png(pixels, 1), contract_answer(pixels, 1, "compress")
    assert len(bare) == len(whole)
    assert bare[:29] == whole[:29]
    assert bare[37:-16] == whole[37:-16]


def test_svg() -> None:
    """A document of the size of the file that it holds."""
    pixels = np.random.default_rng(4).integers(0, 256, (7, 300, 3), np.uint8)
    for scale in (1, 8):
        root = ElementTree.fromstring(contract_answer(pixels, scale, "svg").decode("ascii"))
        assert root.attrib == {"viewBox": f"0 0 {300 * scale} {7 * scale}"}
        (image,) = root
        uri = image.attrib.pop("href")
        sides = {"width": str(300 * scale), "height": str(7 * scale)}
        assert image.attrib == sides | {"style": "image-rendering:pixelated"}
        assert uri == contract_answer(pixels, scale, "dataURI").decode()


def test_data_uri_of_whole_words() -> None:
    """The encoder writes zeros behind the file, where nothing else may be."""
    rows = (np.random.default_rng(width).integers(0, 256, (1, width, 3), np.uint8) for width in range(1, 200))
    pixels = next(row for row in rows if len(encode_png(row, 2)) % 32 == 0)
    for scale in range(1, 9):
        uri = b"data:image/png;base64," + base64.b64encode(encode_png(pixels, scale))
        assert contract_answer(pixels, scale, "dataURI") == uri


@pytest.mark.parametrize("function", ["encode", "svg"])
@pytest.mark.parametrize("scale", [0, 9, 2**255])
def test_scale_out_of_range(function: str, scale: int) -> None:
    with pytest.raises(RenderError, match=f"ScaleOutOfRange.*{scale}"):
        contract_answer(np.zeros((1, 1, 3), np.uint8), scale, function)


def test_what_is_no_bitmap() -> None:
    bmp = encode_bmp(np.zeros((4, 4, 3), np.uint8))
    one_more = [bmp[:at] + bytes([bmp[at] + 1]) + bmp[at + 1 :] for at in (0, 18, 28)]
    for other in (b"", bmp[:-1], bmp + b"\0", *one_more):
        with pytest.raises(RenderError, match="NotABitmap"):
            contract_answer(other, 1)


def test_the_code_is_complete() -> None:
    assert sum(2.0**-length for length in CODE_LENGTHS) == 1
    assert len(set(codes())) == len(CODE_LENGTHS) == 286
    assert set(code_header()) == {"0", "1"}
    # those of bytes need no table
    assert {int(literal(value), 2) - value for value in range(256)} == {int(literal(0), 2)}
    assert {len(literal(value)) for value in range(256)} == {9}


def test_what_the_contract_writes_at_once_fits_a_word() -> None:
    """A pixel and its match, behind up to seven bits and before the byte that has their number."""
    longest = max(len(match(3 * 8 * gap - 3, PIXEL)) for gap in range(1, 257))
    assert 7 + 3 * 9 + longest <= 248
    for scale in (2, 4, 8):
        assert 3 * 9 + len(match(3 * scale - 3, PIXEL)) == 32
