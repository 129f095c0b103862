"""The generator's contract, against the model in Python.

    python tests/datasets/genesis/test_genesis_contract.py --count 2000

compares as many random seeds as are wanted, and prints the gas.
"""

from __future__ import annotations

import argparse
import re
import statistics
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from attrs import evolve

from shackled import Light, render
from shackled.artifacts import artifact
from shackled.chain import ContractChain, open_chain
from shackled.datasets.genesis import call, decode_piece, generate_on_chain, picture_on_chain, seed_of
from shackled.errors import InputError, RenderError
from shackled.reference.genesis import generate
from shackled.reference.genesis.random import keccak256
from shackled.reference.genesis.schemes import BOUNDS as SCHEMES
from shackled.reference.genesis.structures import BOUNDS as STRUCTURES
from shackled.reference.genesis.trigonometry import cosine, sine
from shackled.scene import encode

SOURCES = Path(__file__).resolve().parents[3] / "contracts" / "src" / "genesis"

#: In the suite. The median and the mean of the gas are over as many of the collection.
SEEDS = 128


def random_seeds(count: int) -> Iterator[bytes]:
    """The same ones every time."""
    return (keccak256(b"test" + number.to_bytes(4, "big")) for number in range(count))


def test_pieces_are_those_of_the_model() -> None:
    kinds = set()
    for seed in random_seeds(SEEDS):
        piece, _ = generate_on_chain(seed)
        assert piece == generate(seed), seed.hex()
        kinds |= {piece.structure, piece.chroma, piece.pseudosymmetry}
    # so many seeds have everything but rare things
    assert len(kinds & {*STRUCTURES, *SCHEMES, "Diagonal", "Horizontal", "Vertical", "Scattered"}) >= 19


@pytest.mark.parametrize("seed", [bytes(32), b"\xff" * 32, bytes(31) + b"\x01", b"\x80" + bytes(31)])
def test_seeds_that_are_hardly_random(seed: bytes) -> None:
    assert generate_on_chain(seed)[0] == generate(seed)


@pytest.mark.parametrize(
    ("seed", "reason", "error"),
    [
        # the only one of so many: all triangles are to be equal, but each would be below the least size by a rounding
        (keccak256(b"seed-308884").hex(), "no triangle fits", "NoTriangle()"),
        (keccak256(b"seed-253").hex(), "it would choose among no prisms", "NoPrismToChoose()"),
    ],
)
def test_seeds_without_a_piece(seed: str, reason: str, error: str) -> None:
    with pytest.raises(InputError, match=f"^the seed {seed} has no piece: {reason}$"):
        generate(bytes.fromhex(seed))
    for function in ("generate", "scene", "render", "renderDataURI", "renderSVG"):
        with pytest.raises(RenderError, match=re.escape(f"the contract refused: {error}")):
            call(function, bytes.fromhex(seed))


def test_scene_is_that_of_the_model() -> None:
    for number in range(24):
        seed = seed_of(number)
        expected = encode(bytes(4), generate(seed).scene())
        assert call("scene", seed).output == expected[4:]


def test_traits_are_those_of_the_piece() -> None:
    for number in range(24):
        seed = seed_of(number)
        piece, output = generate(seed), call("traits", seed).output
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
    assert image.gas is not None
    assert expected.gas is not None
    assert image.gas > expected.gas


@pytest.mark.parametrize("function", ["renderDataURI", "renderSVG"])
def test_other_formats_are_those_of_the_renderer(function: str) -> None:
    chain = open_chain()
    assert isinstance(chain, ContractChain)
    scene = generate(seed_of(5)).scene()
    expected = chain.call("Renderer", encode(artifact("Renderer").selectors[function], scene)).output
    assert call(function, seed_of(5)).output == expected


def test_light_comes_from_the_left() -> None:
    scene = generate(seed_of(15)).scene()
    image = picture_on_chain(generate(seed_of(15)))
    brightened = image.pixels.astype(int) - render(evolve(scene, lights=[])).pixels
    assert brightened.min() == 0
    # black and green prisms, and a white light: black faces turn grey
    red, green, blue = brightened.reshape(-1, 3).T
    lit = (red > 20) & (green == red) & (blue == red)
    assert lit.sum() > 100
    # from the right, it is other faces that are lit
    mirrored = render(evolve(scene, lights=[Light("directional", (50, 0, 0))])).pixels.astype(int)
    assert ((mirrored - image.pixels).reshape(-1, 3)[lit] < 0).all()


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


def test_the_constants_are_those_of_the_table() -> None:
    text = (SOURCES / "Trigonometry.sol").read_text("utf-8")
    table = bytes.fromhex("".join(re.findall(r'hex"([0-9a-f]+)"', text)))
    sines = [int.from_bytes(table[at : at + 8], "big", signed=True) for at in range(0, len(table), 8)]
    assert sines == [sine(30 * turn) for turn in range(15)]
    assert sines[3:] == [cosine(30 * turn) for turn in range(12)]
    found = {}
    for name, degrees, value in re.findall(r"(SINE|COSINE)_(\d+) = (-?\d+);", text):
        function: Callable[[int], int] = sine if name == "SINE" else cosine
        found[name, degrees] = int(value) == function(int(degrees))
    assert found == {(name, degrees): True for name in ("SINE", "COSINE") for degrees in ("30", "12", "348")}


def test_tags_know_their_lengths() -> None:
    text = "".join(path.read_text("utf-8") for path in SOURCES.glob("*.sol"))
    tags = re.findall(r'Tag\.wrap\(bytes32\("(\w+)"\) \| bytes32\(uint256\((\d+)\)\)\)', text)
    assert len(tags) >= 30
    assert [tag for tag, length in tags if len(tag) != int(length)] == []


def test_what_is_no_piece_is_told() -> None:
    output = call("generate", seed_of(0)).output
    assert decode_piece(seed_of(0), output).prisms == 10
    for part in (output[:40], output[:-64], output[:600]):
        with pytest.raises(RenderError, match=r"^the contract returned "):
            decode_piece(seed_of(0), part)
    with pytest.raises(InputError, match=r"^a seed has 32 bytes, not 3$"):
        call("generate", b"abc")
    with pytest.raises(InputError, match=r"runs no contracts"):
        call("generate", bytes(32), open_chain("reference"))


def main() -> None:
    """The long run."""
    parser = argparse.ArgumentParser(description="Compare the Genesis contract with its model in Python.")
    parser.add_argument("--count", type=int, default=1000, help="how many seeds")
    parser.add_argument("--pictures", type=int, default=400, help="how many pictures of the collection for the gas")
    options = parser.parse_args()
    making = []
    for seed in random_seeds(options.count):
        piece, gas = generate_on_chain(seed)
        assert piece == generate(seed), seed.hex()
        making.append(gas)
    print(f"{options.count:,} pieces are equal")
    collection = {
        "generate": [call("generate", seed_of(number)).gas for number in range(options.pictures)],
        "render": [call("render", seed_of(number)).gas for number in range(options.pictures)],
    }
    for name, costs in {"generate, these seeds": making, **collection}.items():
        figures = np.array(costs)
        print(
            f"{name}: median {np.median(figures):,.0f}, mean {figures.mean():,.0f},"
            f" {figures.min():,} to {figures.max():,} gas"
        )


if __name__ == "__main__":
    main()
