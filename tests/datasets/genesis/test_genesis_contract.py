"""The generator's contract, against the pieces that the original and its model in Python made.

    python tests/datasets/genesis/test_genesis_contract.py --count 400      prints the gas of so many pieces
    python tests/datasets/genesis/test_genesis_contract.py --write          writes pieces.json anew, of the contract

pieces.json holds the traits and a digest of all that 516 pieces consist of. It was written by a model in Python, from
which the contract did not differ; `--write` is for a change of the generator that is meant.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import re
import statistics
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from original_scenes import genesis_document
from shackled import render
from shackled.artifacts import artifact
from shackled.chain import open_chain
from shackled.datasets.genesis import (
    COUNT,
    GenesisPiece,
    call,
    decode_piece,
    find,
    generate,
    parse_seed,
    picture_on_chain,
    pieces,
    seed_of,
)
from shackled.errors import InputError, RenderError
from shackled.ethereum._encoding import keccak256
from shackled.scene import encode
from shackled.scene._files.original import original_scene

SOURCES = Path(__file__).resolve().parents[3] / "contracts" / "src" / "genesis"
VECTORS = Path(__file__).with_name("pieces.json")

#: The median and the mean of the gas are over as many of the collection.
SEEDS = 128
#: The first pieces of the collection, as the original made them: a digest of everything that they are made of.
ORIGINAL = {
    0: "a037449c9fbee3c98f68cafe65c3ef7943a914d2711b987dd5df988fbf8b31fa",
    1: "fe700ad0bf5f80d0be0b46a34308e5b5273db08fd109aff7e19d81644b9ddb30",
    2: "e47b1ce56386e3f0b715e4e83f351e636a6fb98c6fd50014b1ea6286bc40976d",
    3: "77ec19db4ffc2c770c8d333b25f70ce8cf812810e4027776622afde470d85ecc",
    7: "6d15169816d977b28126951d7a8440d5cdf07408e49ad41b8adc725a5e721a22",
    21: "85c99b265e5010a8ad633895d93bb7f106030f1146428c2faea8970897baefdb",
}


def digest(piece: GenesisPiece) -> str:
    document = piece.document()
    del document["seed"]
    return hashlib.sha256(json.dumps(document, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def vector(piece: GenesisPiece) -> list[str | int]:
    """A row of pieces.json."""
    names = [piece.structure, piece.chroma, piece.pseudosymmetry]
    return [*names, piece.prisms, int(piece.wireframe), int(piece.invert), digest(piece)[:32]]


def seeds() -> Iterator[bytes]:
    """Of the collection, others, and four that are hardly random."""
    yield from (seed_of(number) for number in range(SEEDS))
    yield from (keccak256(b"test" + number.to_bytes(4, "big")) for number in range(3 * SEEDS))
    yield from (bytes(32), b"\xff" * 32, bytes(31) + b"\x01", b"\x80" + bytes(31))


def test_pieces_are_those_of_the_model() -> None:
    expected: dict[str, list[str | int]] = json.loads(VECTORS.read_text("utf-8"))
    assert list(expected) == [seed.hex() for seed in seeds()]
    kinds = set()
    for seed, row in expected.items():
        assert vector(generate(bytes.fromhex(seed))) == row, seed
        kinds |= {name for name in row[:3] if isinstance(name, str)}
    # seven structures, ten schemes of colours, four symmetries
    assert len(kinds) == 21


def test_pieces_are_those_of_the_original() -> None:
    """Of 400 pieces as the original made them, each alone, or hashed together."""
    digests = [digest(generate(seed_of(number))) for number in range(400)]
    assert {number: digests[number] for number in ORIGINAL} == ORIGINAL
    whole = hashlib.sha256("".join(digests).encode()).hexdigest()
    assert whole == "886afc766687b5b269ac075ef7b459c25053e6312655d5b704e716316b59decc"


@pytest.mark.parametrize(
    ("seed", "error"),
    # the first is the only one of so many: all triangles are to be equal, but each would be below the least size by a
    # rounding
    [("seed-308884", "NoTriangle()"), ("seed-253", "NoPrismToChoose()")],
)
def test_seeds_without_a_piece(seed: str, error: str) -> None:
    for function in ("generate", "scene", "render", "renderDataURI", "renderSVG"):
        with pytest.raises(RenderError, match=re.escape(f"the contract refused: {error}")):
            call(function, keccak256(seed.encode()))


@pytest.mark.parametrize("number", range(24))
def test_scene_and_traits_are_those_of_the_piece(number: int) -> None:
    seed = seed_of(number)
    piece, output = generate(seed), call("traits", seed).output
    assert call("scene", seed).output == encode(bytes(4), piece.scene())[4:]
    assert encode(b"", piece.scene()) == encode(b"", original_scene(genesis_document(number)))
    words = [int.from_bytes(output[at : at + 32], "big") for at in range(32, len(output), 32)]
    assert words[3:6] == [piece.prisms, piece.wireframe, piece.invert]
    for name, place in zip((piece.structure, piece.chroma, piece.pseudosymmetry), words, strict=False):
        assert output[32 + place :].startswith(len(name).to_bytes(32, "big") + name.encode())


@pytest.mark.parametrize("number", [0, 3, 4, 16])
def test_picture_is_that_of_the_scene(number: int) -> None:
    piece = generate(seed_of(number))
    image, expected = picture_on_chain(piece), render(piece.scene())
    assert image.bmp == expected.bmp
    assert (image.triangles, image.covered_pixels) == (expected.triangles, expected.covered_pixels)
    assert (image.covered_pixels or 0) > 300
    assert (image.gas or 0) > (expected.gas or 0)


@pytest.mark.parametrize("function", ["renderDataURI", "renderSVG"])
def test_other_formats_are_those_of_the_renderer(function: str) -> None:
    chain = open_chain()
    scene = generate(seed_of(5)).scene()
    expected = chain.call("Renderer", encode(artifact("Renderer").selectors[function], scene)).output
    assert call(function, seed_of(5)).output == expected


@pytest.mark.parametrize(
    ("function", "median", "mean"),
    [("generate", 850_000, 950_000), ("render", 4_000_000, 4_000_000), ("traits", 500_000, 600_000)],
)
def test_gas(function: str, median: int, mean: int) -> None:
    gas = [call(function, seed_of(number)).gas for number in range(SEEDS)]
    assert statistics.median(gas) <= median
    assert statistics.mean(gas) <= mean
    # the longest search for places that there is, and the most fragments
    assert max(gas) <= 5 * median


def test_the_constants_are_sines() -> None:
    """Those of the original, whose table is rough: sin 30, sin 60 and cos 12 degrees are known to the last digit."""
    text = (SOURCES / "Trigonometry.sol").read_text("utf-8")
    table = bytes.fromhex("".join(re.findall(r'hex"([0-9a-f]+)"', text)))
    sines = [int.from_bytes(table[at : at + 8], "big", signed=True) for at in range(0, len(table), 8)]
    exact = np.sin(np.radians(30 * np.arange(15)))
    assert np.abs(np.array(sines, float) / 1e18 - exact).max() < 5e-6
    assert (sines[1], sines[3]) == (499997878680004681, 10**18)
    found = {
        (name, int(degrees)): int(value) for name, degrees, value in re.findall(r"(SINE|COSINE)_(\d+) = (-?\d+);", text)
    }
    assert len(found) == 6
    assert (found["SINE", 12], found["COSINE", 12]) == (207911222804296399, 978145476420477720)
    assert (found["SINE", 30], found["COSINE", 30]) == (499997878680004681, 866021797929900604)
    assert found["SINE", 348] == -207911314539570042
    for (name, degrees), value in found.items():
        function = np.sin if name == "SINE" else np.cos
        assert abs(value / 1e18 - function(np.radians(degrees))) < 5e-6, (name, degrees)


def test_tags_know_their_lengths() -> None:
    text = "".join(path.read_text("utf-8") for path in SOURCES.glob("*.sol"))
    tags = re.findall(r'Tag\.wrap\(bytes32\("(\w+)"\) \| bytes32\(uint256\((\d+)\)\)\)', text)
    assert len(tags) >= 30
    assert [tag for tag, length in tags if len(tag) != int(length)] == []


def test_the_collection() -> None:
    assert [piece.name for piece in pieces()] == [f"genesis/{number}" for number in range(COUNT)]
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
    with pytest.raises(InputError, match=r"^the pieces of the collection are numbered from 0 to 1023, not 1024$"):
        seed_of(1024)


def test_what_is_no_piece_is_told() -> None:
    output = call("generate", seed_of(0)).output
    assert decode_piece(seed_of(0), output).prisms == 10
    for part in (output[:40], output[:-64], output[:600]):
        with pytest.raises(RenderError, match=r"^the contract returned "):
            decode_piece(seed_of(0), part)
    with pytest.raises(InputError, match=r"^a seed has 32 bytes, not 3$"):
        call("generate", b"abc")


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description="Print the gas of Genesis.")
    parser.add_argument("--count", type=int, default=400, help="how many pieces of the collection")
    parser.add_argument("--write", action="store_true", help="write pieces.json")
    options = parser.parse_args()
    if options.write:
        rows = (f'"{seed.hex()}": {json.dumps(vector(generate(seed)))}' for seed in seeds())
        VECTORS.write_text("{\n" + ",\n".join(rows) + "\n}\n", "utf-8", newline="\n")
        return
    for name in ("generate", "render"):
        figures = np.array([call(name, seed_of(number)).gas for number in range(options.count)])
        middle, mean = np.median(figures), figures.mean()
        print(f"{name}: median {middle:,.0f}, mean {mean:,.0f}, {figures.min():,} to {figures.max():,} gas")


if __name__ == "__main__":
    main()
