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
from shackled.chain import CHAINS, ContractChain, EmbeddedChain, RevmChain, open_chain
from shackled.errors import OutOfGasError
from shackled.ethereum import intrinsic_gas
from shackled.image import decode_bmp
from shackled.scene import Rectangle, encode

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


@pytest.fixture(params=["revm", "pyrevm", "pyevm"])
def chain(request: pytest.FixtureRequest) -> EmbeddedChain:
    if request.param != "revm":
        pytest.importorskip(CHAINS[request.param])
    return open_chain(request.param)


@pytest.mark.parametrize("name", ["pyrevm", "pyevm"])
def test_evms_agree_on_bytes_and_gas(name: str) -> None:
    pytest.importorskip(CHAINS[name])
    fast, slow = RevmChain(), open_chain(name)
    for scene in (SCENE, evolve(SCENE, objects=[], invert=True)):
        assert fast.draw(scene) == slow.draw(scene)
        assert fast.count(scene) == slow.count(scene)
    tile = Rectangle(3, 2, 10, 9)
    assert fast.draw(SCENE, tile) == slow.draw(SCENE, tile)


def test_every_call_finds_the_same_state(chain: EmbeddedChain) -> None:
    first = chain.draw(SCENE)
    with pytest.raises(RenderError):
        chain.call("Renderer", b"")
    assert chain.draw(SCENE) == first
    assert type(chain)().draw(SCENE) == first


def test_the_picture_and_the_counts(chain: EmbeddedChain) -> None:
    pixels = decode_bmp(chain.draw(SCENE).bmp, 24, 17)
    triangles, lit = chain.count(SCENE)
    assert 0 < triangles <= 8
    assert 0 < lit <= 24 * 17
    assert np.count_nonzero(pixels.any(axis=2)) <= lit
    assert chain.count(evolve(SCENE, objects=[])) == (0, 0)


def test_a_tile_is_a_part_of_the_picture(chain: EmbeddedChain) -> None:
    whole = decode_bmp(chain.draw(SCENE).bmp, 24, 17)
    tile = decode_bmp(chain.draw(SCENE, Rectangle(3, 2, 10, 9)).bmp, 10, 9)
    assert (tile == whole[2:11, 3:13]).all()


def test_intrinsic_gas_is_that_of_cancun(chain: EmbeddedChain) -> None:
    assert intrinsic_gas(bytes(10) + b"\1\2\3") == 21000 + 40 + 48
    data = encode(artifact("Renderer").selectors["render"], SCENE)
    assert chain.draw(SCENE).intrinsic_gas == intrinsic_gas(data)


def test_refusals_are_read_from_the_abi(chain: EmbeddedChain) -> None:
    data = bytearray(encode(artifact("Renderer").selectors["render"], SCENE))
    data[4 + 32 : 4 + 64] = bytes(32)
    with pytest.raises(RenderError, match=r"^the contract refused: CanvasSize\(width=0, height=17\)$"):
        chain.call("Renderer", bytes(data))
    data[4 + 32 : 4 + 64] = (24).to_bytes(32, "big")
    data[4 + 96 : 4 + 128] = (-(2**100)).to_bytes(32, "big", signed=True)
    with pytest.raises(RenderError, match=rf"^the contract refused: CameraOutOfRange\(x={-(2**100)}, y="):
        chain.call("Renderer", bytes(data))


def test_calls_that_are_no_scenes(chain: EmbeddedChain) -> None:
    for data in (b"", b"\1\2\3\4", artifact("Renderer").selectors["render"]):
        with pytest.raises(RenderError, match="the contract refused: the data of the call is not a scene"):
            chain.call("Renderer", data)


def test_out_of_gas_says_the_limit(chain: EmbeddedChain) -> None:
    data = encode(artifact("Renderer").selectors["render"], SCENE)
    used = chain.call("Renderer", data).gas
    for limit in (5_000, used // 2):
        with pytest.raises(OutOfGasError, match=f"^the call ran out of gas: {limit:,} gas is not enough$"):
            chain.call("Renderer", data, limit)
    assert type(chain)(2 * used).call("Renderer", data).gas == used


def test_chains_by_name() -> None:
    assert isinstance(open_chain(), ContractChain)
    assert open_chain() is open_chain()
    assert open_chain("pyevm").name == "embedded EVM (py-evm)"
    assert set(CHAINS) == {"revm", "pyrevm", "pyevm"}
    with pytest.raises(InputError, match=r"^the chain must be one of revm, pyrevm, pyevm, not 'hardhat'$"):
        open_chain("hardhat")
    gone = "^the chain 'reference', a renderer in NumPy, is gone: use one of revm, pyrevm, pyevm$"
    with pytest.raises(InputError, match=gone):
        open_chain("reference")


def test_a_chain_that_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.chain._opening.find_spec", lambda name: name != "pyrevm" or None)
    open_chain.cache_clear()
    try:
        assert open_chain().name == "embedded EVM (revm)"
        with pytest.raises(
            InputError,
            match=r"'pyrevm' needs a package .* installed: pyrevm, which has wheels for Python 3\.11 and 3\.12$",
        ):
            open_chain("pyrevm")
    finally:
        open_chain.cache_clear()


def test_artifacts_are_whole() -> None:
    assert "Renderer" in contracts()
    for name in contracts():
        data = json.loads(files("shackled.artifacts").joinpath(f"{name}.json").read_text("utf-8"))
        for path, digest in data["sources"].items():
            assert hashlib.sha256((source(path) or "").encode()).hexdigest() == digest, path
        assert len(artifact(name).runtime) <= 24576
        assert data["compiler"].startswith("0.8.37")


def test_selectors_of_errors() -> None:
    errors = [error for contract in contracts() for error in artifact(contract).errors.items()]
    by_name = {name: selector for selector, (name, _) in errors}
    eth_utils = pytest.importorskip("eth_utils")
    assert by_name["CanvasSize"] == eth_utils.keccak(text="CanvasSize(uint256,uint256)")[:4]
