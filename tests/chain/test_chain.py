"""Where pictures are made: the same bytes everywhere, the same gas, and errors that say what was wrong."""

from __future__ import annotations

import hashlib
import json
from importlib.resources import files

import numpy as np
import pytest
from attrs import evolve

from shackled import Camera, InputError, Light, Material, Mesh, Object, RenderError, Scene
from shackled.artifacts import artifact, contracts, source
from shackled.chain import open_chain
from shackled.chain._chain import ContractChain
from shackled.chain._embedded import RevmChain
from shackled.chain._opening import CHAINS
from shackled.errors import OutOfGasError
from shackled.ethereum._encoding import intrinsic_gas
from shackled.image import decode_bmp
from shackled.scene import encode
from shackled.scene._codec import Rectangle

TETRAHEDRON = Mesh(
    [[1, 1, 1], [-1, -1, 1], [-1, 1, -1], [1, -1, -1]],
    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]],
)
SCENE = Scene(
    [Object(TETRAHEDRON, material=Material("smooth")), Object(TETRAHEDRON, (2, 0, -3), wireframe=True)],
    Camera(eye=(1, 2, 5), target=(0, 0, 0)),
    [Light("point", (3, 4, 5)), Light("directional", (1, 0, 0), (90, 0, 0))],
    width=24,
    height=17,
)


RENDER = artifact("Renderer").selectors["render"]


def changed(**numbers: int) -> bytes:
    """The call that draws the scene, with other numbers in its words."""
    data = bytearray(encode(RENDER, SCENE))
    for word, value in numbers.items():
        data[4 + 32 * WORDS[word] : 36 + 32 * WORDS[word]] = value.to_bytes(32, "big", signed=True)
    return bytes(data)


#: Words of a scene, by their number.
WORDS = {"width": 1, "eye": 3}


@pytest.mark.parametrize("name", CHAINS)
def test_chains(name: str) -> None:
    """All agree on bytes and gas, whatever was called before, and on what is refused and why."""
    pytest.importorskip(CHAINS[name])
    chain, fast = open_chain(name), RevmChain()
    for scene in (SCENE, evolve(SCENE, objects=[], invert=True)):
        for tile in (None, Rectangle(3, 2, 10, 9)):
            assert chain.draw(scene, tile) == fast.draw(scene, tile)
            assert chain.count(scene, tile) == fast.count(scene, tile)
    for data, words in (
        (b"", "the data of the call is not a scene that is encoded correctly"),
        (b"\1\2\3\4", "the data of the call is not a scene that is encoded correctly"),
        (RENDER, "the data of the call is not a scene that is encoded correctly"),
        (changed(width=0), "CanvasSize(width=0, height=17)"),
        (changed(eye=-(2**100)), f"CameraOutOfRange(x={-(2**100)}, y="),
    ):
        with pytest.raises(RenderError) as error:
            chain.call("Renderer", data)
        assert str(error.value).startswith(f"the contract refused: {words}")
    used = fast.call("Renderer", changed()).gas
    for limit in (5_000, used // 2):
        with pytest.raises(OutOfGasError, match=f"^the call ran out of gas: {limit:,} gas is not enough$"):
            chain.call("Renderer", changed(), limit)
    assert type(chain)(2 * used).call("Renderer", changed()).gas == used


def test_the_picture_and_the_counts() -> None:
    made = open_chain().draw(SCENE)
    pixels = decode_bmp(made.bmp, 24, 17)
    assert made.intrinsic_gas == intrinsic_gas(changed()) == 21000 + sum(16 if byte else 4 for byte in changed())
    triangles, lit = open_chain().count(SCENE)
    assert 0 < triangles <= 8
    assert np.count_nonzero(pixels.any(axis=2)) <= lit <= 24 * 17
    assert open_chain().count(evolve(SCENE, objects=[])) == (0, 0)


def test_chains_by_name() -> None:
    assert isinstance(open_chain(), ContractChain)
    assert open_chain() is open_chain() is open_chain("revm")
    assert open_chain("pyevm").name == "embedded EVM (py-evm)"
    assert set(CHAINS) == {"revm", "pyrevm", "pyevm"}
    with pytest.raises(InputError, match=r"^the chain must be one of revm, pyrevm, pyevm, not 'hardhat'$"):
        open_chain("hardhat")


def test_a_chain_that_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.chain._opening.find_spec", lambda name: name != "pyrevm" or None)
    assert open_chain().name == "embedded EVM (revm)"
    words = r"'pyrevm' needs a package .* installed: pyrevm, which has wheels for Python 3\.11 and 3\.12$"
    with pytest.raises(InputError, match=words):
        open_chain("pyrevm")


def test_artifacts_are_whole() -> None:
    assert "Renderer" in contracts()
    for name in contracts():
        data = json.loads(files("shackled.artifacts").joinpath(f"{name}.json").read_text("utf-8"))
        for path, digest in data["sources"].items():
            assert hashlib.sha256((source(path) or "").encode()).hexdigest() == digest, path
        assert len(artifact(name).runtime) <= 24576
        assert data["compiler"].startswith("0.8.37")
