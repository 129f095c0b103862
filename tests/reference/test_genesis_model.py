"""The generator in Python, against facts about the collection."""

from __future__ import annotations

import hashlib
import json

import numpy as np
import pytest

from original_scenes import genesis_document
from shackled.datasets.genesis import COUNT, find, parse_seed, pieces, seed_of
from shackled.errors import InputError
from shackled.reference.genesis import generate
from shackled.reference.genesis.hsv import hsv_to_rgb, rgb_to_hsv
from shackled.reference.genesis.random import Random, keccak256
from shackled.reference.genesis.trigonometry import ONE, TABLE, cosine, quotient, rotate, rotate_y, sine
from shackled.scene import encode, original_scene

#: The first pieces of the collection: a digest of everything that they are made of.
DIGESTS = {
    0: "a037449c9fbee3c98f68cafe65c3ef7943a914d2711b987dd5df988fbf8b31fa",
    1: "fe700ad0bf5f80d0be0b46a34308e5b5273db08fd109aff7e19d81644b9ddb30",
    2: "e47b1ce56386e3f0b715e4e83f351e636a6fb98c6fd50014b1ea6286bc40976d",
    3: "77ec19db4ffc2c770c8d333b25f70ce8cf812810e4027776622afde470d85ecc",
    7: "6d15169816d977b28126951d7a8440d5cdf07408e49ad41b8adc725a5e721a22",
    21: "85c99b265e5010a8ad633895d93bb7f106030f1146428c2faea8970897baefdb",
}


def digest(seed: bytes) -> str:
    document = generate(seed).document()
    del document["seed"]
    return hashlib.sha256(json.dumps(document, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def test_sine_is_that_of_the_table() -> None:
    packed = b"".join(value.to_bytes(4, "big") for value in TABLE)
    assert keccak256(packed).hex() == "60732e8042a99c4ef85e0f37800cb521c04e52818be832418efcebb97f9625e4"
    assert (sine(12), cosine(12)) == (207911222804296399, 978145476420477720)
    assert (sine(30), cosine(30), cosine(60)) == (499997878680004681, 866021797929900604, 499997960170729998)
    assert (sine(90), sine(348), sine(-12)) == (ONE, -207911314539570042, -207911314539570042)


def test_division_cuts_off() -> None:
    assert [quotient(a, b) for a, b in ((7, 2), (-7, 2), (7, -2), (-7, -2), (0, -3))] == [3, -3, -3, 3, 0]


def test_rotation_divides_the_sum() -> None:
    assert rotate(12820, 0, 210) == (-11102, -6409)
    assert rotate_y((3, 5, 7), 90) == (-7, 5, 3)


@pytest.mark.parametrize(
    ("rgb", "hsv", "back"),
    [
        ((219, 70, 92), (248, 173, 218), (217, 70, 94)),
        ((60, 30, 25), (5, 148, 59), None),
        ((220, 205, 300), (176, 80, 299), None),
    ],
)
def test_colors_as_hue(rgb: tuple[int, int, int], hsv: tuple[int, int, int], back: tuple[int, int, int] | None) -> None:
    assert rgb_to_hsv(rgb) == hsv
    if back:
        assert hsv_to_rgb(*hsv) == back


def test_hue_as_colors() -> None:
    assert hsv_to_rgb(85, 255, 255) == (0, 255, 0)
    assert hsv_to_rgb(200, 105, 255) == (223, 150, 255)
    assert hsv_to_rgb(255, 200, 100) == hsv_to_rgb(0, 200, 100)


def test_draws_are_those_of_the_original() -> None:
    random = Random(seed_of(3))
    assert random.seed.hex() == "4d3e28f746c4f4e200a8302ae65d4f6fd8a76f08915a294e7deed915354747e6"
    assert random.draw("specId", low=0, high=8000) == 7655
    assert random.draw("adj", 3, 2, low=0, high=100) == 43
    assert random.draw("refIdx", 0, low=0, high=-1) == 0


def test_a_piece() -> None:
    piece = generate(seed_of(3))
    assert (piece.structure, piece.chroma, piece.pseudosymmetry) == ("Uniform", "Sunset", "Diagonal")
    assert (piece.prisms, piece.wireframe, piece.culling, piece.invert) == (4, True, False, False)
    assert piece.background == ((250, 103, 247), (157, 104, 250))
    assert piece.verts[:4] == [(-268, 650, -183), (-622, 650, -108), (-432, 344, -81), (-230, 689, -1)]
    far, near = [(87, 0, 128), (0, 0, 122), (0, 0, 119)], [(148, 0, 255), (142, 0, 255), (220, 0, 255)]
    assert piece.cols[:6] == far + near
    assert piece.faces[6:9] == [(3, 5, 2), (9, 10, 11), (10, 9, 6)]


@pytest.mark.parametrize("number", DIGESTS)
def test_digests(number: int) -> None:
    assert digest(seed_of(number)) == DIGESTS[number]


def test_all_digests() -> None:
    """Of 400 pieces as the original made them, hashed together."""
    whole = hashlib.sha256("".join(digest(seed_of(number)) for number in range(400)).encode())
    assert whole.hexdigest() == "886afc766687b5b269ac075ef7b459c25053e6312655d5b704e716316b59decc"


def test_scenes_are_those_of_the_original() -> None:
    for number in range(24):
        original = original_scene(genesis_document(number))
        assert encode(b"", generate(seed_of(number)).scene()) == encode(b"", original)


def test_the_collection() -> None:
    names = [piece.name for piece in pieces()]
    assert names == [f"genesis/{number}" for number in range(COUNT)]
    piece = find("12")
    assert piece is not None
    assert (piece.name, piece.dataset) == ("genesis/12", "genesis")
    assert encode(b"", piece.make()) == encode(b"", generate(seed_of(12)).scene())


@pytest.mark.parametrize("prefix", ["", "0x", "0X"])
def test_any_seed_is_a_piece(prefix: str) -> None:
    seed = bytes(range(7, 39))
    piece = find(prefix + seed.hex().upper())
    assert piece is not None
    assert piece.name == f"genesis/{seed.hex()}"
    np.testing.assert_array_equal(piece.make().objects[0].mesh.positions, generate(seed).verts)


@pytest.mark.parametrize("text", ["1024", "-1", "007", "12.0", "", "x" * 64, "0" * 63, "0" * 65, "0x12", "١٢"])
def test_what_is_no_seed(text: str) -> None:
    assert find(text) is None
    with pytest.raises(InputError, match=r"^a seed must be 64 hexadecimal digits, .* or a number from 0 to 1023, not "):
        parse_seed(text)


def test_seeds_have_32_bytes() -> None:
    with pytest.raises(InputError, match=r"^a seed has 32 bytes, not 31$"):
        generate(bytes(31))
    with pytest.raises(InputError, match=r"^the pieces of the collection are numbered from 0 to 1023, not 1024$"):
        seed_of(1024)
