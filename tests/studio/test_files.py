"""Files that contracts make in one call, from Python."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image as PillowImage
from PIL import ImageSequence

import shackled
from evms import Ours, pyevm_call, pyrevm_call
from nodes import anvil, needs_anvil
from shackled import InputError, Nodes, Processes, load
from shackled.artifacts import artifact
from shackled.cli.app import run
from shackled.deploy._contract import local_chain
from shackled.scene import encode
from shackled.studio import make_apng, make_glb

SCENE, TINY = load("icons/lightning", 16), load("icons/lightning", 6)


def test_a_turntable_of_one_call(tmp_path: Path) -> None:
    spin = shackled.turntable("icons/lightning", 3, 16, duration=60, one_call=True)
    assert spin.file is not None
    assert spin.file.content == make_apng(SCENE, 3, 60).content
    assert (spin.pixels.shape, spin.calls, spin.gas) == ((3, 16, 16, 3), 1, spin.file.gas)
    assert spin.intrinsic_gas == spin.file.intrinsic_gas
    assert spin.encode(".png") == spin.file.content
    assert spin.data_uri() == spin.file.data_uri()
    spin.save(tmp_path / "spin.gif")
    with PillowImage.open(tmp_path / "spin.gif") as opened:
        assert len(list(ImageSequence.Iterator(opened))) == 3
    # the same turn as that of one call for each frame
    usual = shackled.turntable("icons/lightning", 3, 16)
    assert (np.abs(usual.pixels.astype(int) - spin.pixels).max(axis=3) > 30).mean() < 0.2
    with pytest.raises(InputError, match="carry its scene"):
        spin.encode(".png", scene=True)


def test_options() -> None:
    plain = make_apng(SCENE, 2)
    assert repr(plain).startswith("ContractFile(media_type='image/png', gas=")
    assert plain == make_apng(SCENE, 2, 80, 1, (0, 5, 0), True, "revm")
    others = [make_apng(SCENE, 2, scale=2), make_apng(SCENE, 2, axis=(1, 0, -1)), make_apng(SCENE, 2, hold=False)]
    assert len({plain.content, *(other.content for other in others)}) == 4
    with PillowImage.open(io.BytesIO(others[0].content)) as opened:
        assert opened.size == (32, 32)
    for wrong in ({"frames": 1}, {"frames": 2.5}, {"frames": 361}, {"scale": 9}, {"duration": 5}, {"axis": (0, 0, 0)}):
        with pytest.raises(InputError):
            make_apng(SCENE, **wrong)
    with pytest.raises(InputError, match="needs an EVM that runs the contracts"):
        make_glb(SCENE, Processes())


def test_a_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made = make_glb(SCENE)
    made.save(tmp_path / "a.glb")
    assert (tmp_path / "a.glb").read_bytes() == made.content
    assert made.data_uri().startswith("data:model/gltf-binary;base64,Z2xURgIAAA")
    assert run(["export", "icons/lightning", "--size", "16", "-o", str(tmp_path / "b.glb")]) == 0
    assert (tmp_path / "b.glb").read_bytes() == made.content
    said = capsys.readouterr()
    assert f"{made.gas:,}" in said.out
    assert not said.err
    assert run(["export", "cube", "--shadow", "--ground", "white", "-o", str(tmp_path / "b.glb")]) == 0
    assert "the model leaves out shadows, the fading of the ground\n" in capsys.readouterr().err
    assert run(["export", "icons/lightning", "-o", str(tmp_path / "b.glb"), "--title", "A"]) == 2


@pytest.mark.parametrize(
    ("contract", "function", "words"),
    [("Turntable", "animate", (None, 2, 80, 1, 0, 1 << 32, 0, 1)), ("GlbEncoder", "encode", ())],
)
def test_every_evm_agrees(contract: str, function: str, words: tuple[Any, ...]) -> None:
    chain = local_chain()
    address, data = chain.address(contract), encode(artifact(contract).selectors[function], TINY, *words)
    ours = Ours().call(chain.codes(), address, data, 10**8)
    assert ours.output == chain.call(contract, data).output
    assert pyrevm_call(chain.codes(), address, data, 10**8) == ours
    assert pyevm_call(chain.codes(), address, data, 10**8) == ours


@needs_anvil
def test_on_a_node() -> None:
    with anvil() as node:
        made = make_glb(SCENE, Nodes(node.url))
        assert made.content == make_glb(SCENE).content
        assert "state override" in made.made_by
        assert make_apng(SCENE, 2, on=Nodes(node.url)).content == make_apng(SCENE, 2).content
