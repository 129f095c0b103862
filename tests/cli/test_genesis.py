"""The command `shackled genesis`."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from commands import Shackled
from pictures import pixels_of
from shackled import render
from shackled.datasets.genesis import generate, seed_of
from shackled.ethereum._encoding import keccak256


def test_json_is_an_object_a_line(shackled: Shackled) -> None:
    seed = bytes(range(32))
    lines = shackled(f"genesis 0x{seed.hex()} 12 --json").out.splitlines()
    assert [json.loads(line) for line in lines] == [generate(each).document() for each in (seed, seed_of(12))]
    assert set(json.loads(lines[0])) == {
        *("seed", "structure", "chroma", "pseudosymmetry", "prisms", "wireframe", "culling", "invert", "background"),
        *("verts", "cols", "faces"),
    }


def test_words(shackled: Shackled) -> None:
    first, second = shackled("genesis 3 12").out.split("\n\n")
    rows = dict(line.split(maxsplit=1) for line in first.splitlines())
    assert rows["seed"] == seed_of(3).hex()
    assert (rows["structure"], rows["chroma"], rows["symmetry"]) == ("Uniform", "Sunset", "Diagonal")
    assert (rows["prisms"], rows["style"]) == ("4, 28 triangles", "wireframe")
    assert rows["gas"].endswith(" for the piece")
    assert "Vivid Ink" in second


def test_pictures(shackled: Shackled) -> None:
    assert "from seed to picture" in shackled("genesis 7 -o seven.png").out
    scene = generate(seed_of(7)).scene()
    np.testing.assert_array_equal(pixels_of("seven.png"), render(scene).pixels)
    shackled("render genesis/7 -o seven.bmp --size 32 --no-antialias")
    assert Path("seven.bmp").read_bytes() == render(scene, 32).bmp


def test_seeds_without_a_piece_are_told(shackled: Shackled) -> None:
    said = shackled(f"genesis {keccak256(b'seed-308884').hex()}", expect=1)
    assert said.err == "shackled: the contract refused: NoTriangle()\n"
