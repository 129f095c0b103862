"""What tokens of the Genesis collection show."""

from __future__ import annotations

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

import numpy as np
from tools.tokens.stage import Stage, stage
from tools.tokens.world import Refused

from shackled import render
from shackled.datasets.genesis import generate, seed_of
from shackled.image import decode_bmp
from token_checks import INDEPENDENT, document, pixels, traits

SIDE, SCALE = 128, 4
#: What marketplaces take.
LONGEST_URI = 100_000
MOST_GAS = 10_000_000


@pytest.fixture(scope="module")
def revealed() -> Stage:
    s = stage()
    s.mint(10)
    s.reveal(0)
    return s


def test_the_picture_is_that_of_the_generator(revealed: Stage) -> None:
    """For pieces of all kinds: wires, inverted, one prism."""
    s = revealed
    kinds = set()
    for number in range(60):
        seed = seed_of(number)
        piece = generate(seed)
        kind = (piece.wireframe, piece.invert, piece.prisms == 1)
        if kind not in kinds or number < 5:
            kinds.add(kind)
            found = document(s.metadata.call("tokenURI", number, seed))
            expected = decode_bmp(s.generator.call("render", seed), SIDE, SIDE).repeat(SCALE, 0).repeat(SCALE, 1)
            assert np.array_equal(pixels(found["image"]), expected), number
            if number < 5:
                assert np.array_equal(expected[::SCALE, ::SCALE], render(piece.scene()).pixels)
    assert len(kinds) >= 3


def test_the_traits_are_those_of_the_model(revealed: Stage) -> None:
    s = revealed
    for token in range(10):
        seed = s.genesis.call("seedOf", token)
        piece = generate(seed)
        found = document(s.genesis.call("tokenURI", token))
        assert list(found) == ["name", "description", "external_url", "background_color", "attributes", "image"]
        assert found["name"] == f"Genesis #{token}"
        assert f" {INDEPENDENT} Seed 0x{seed.hex()}." in found["description"]
        assert traits(found) == {
            "Structure": piece.structure,
            "Chroma": piece.chroma,
            "Pseudosymmetry": piece.pseudosymmetry,
            "Prisms": piece.prisms,
            "Wireframe": "Yes" if piece.wireframe else "No",
            "Inversion": "Yes" if piece.invert else "No",
        }
        plain = (piece.structure, piece.chroma, piece.pseudosymmetry, piece.prisms, piece.wireframe, piece.invert)
        assert s.genesis.call("traitsOf", token) == plain
        assert s.genesis.call("render", token) == s.generator.call("render", seed)


def test_a_token_shows_that_it_is_not_revealed(revealed: Stage) -> None:
    s = revealed
    with s.world.attempt():
        (token,) = s.mint()
        found = document(s.genesis.call("tokenURI", token))
        block = s.genesis.call("blockOf", s.genesis.call("roundOf", token))
        assert found["name"] == f"Genesis #{token}"
        assert f"block {block} " in found["description"]
        assert traits(found) == {"Revealed": "No"}
        picture = pixels(found["image"])
        assert picture.shape == (SIDE * SCALE, SIDE * SCALE, 3)
        assert np.array_equal(picture, picture[::SCALE, ::SCALE].repeat(SCALE, 0).repeat(SCALE, 1))
        # something is to be seen
        assert 300 < (picture[::SCALE, ::SCALE].max(axis=2) > 60).sum() < 4000
        s.reveal(s.genesis.call("roundOf", token))
        assert "Revealed" not in traits(document(s.genesis.call("tokenURI", token)))


def test_there_is_nothing_to_see_of_tokens_that_are_not_there(revealed: Stage) -> None:
    for token in (10, 1023, 2**256 - 1):
        with pytest.raises(Refused, match="URIQueryForNonexistentToken"):
            revealed.genesis.call("tokenURI", token)
        for function in ("seedOf", "traitsOf", "render", "roundOf", "ownerOf"):
            with pytest.raises(Refused, match="OwnerQueryForNonexistentToken"):
                revealed.genesis.call(function, token)


def test_length_and_gas(revealed: Stage) -> None:
    lengths, gas = [], []
    for number in range(48):
        lengths.append(len(revealed.metadata.call("tokenURI", number, seed_of(number))))
        gas.append(revealed.metadata.gas_of("tokenURI", number, seed_of(number)))
    assert max(lengths) < LONGEST_URI
    assert np.mean(gas) < 6_500_000
    assert np.quantile(gas, 0.95) < MOST_GAS


def test_nothing_of_it_can_be_changed() -> None:
    """No function writes generator, renderer, metadata, price, supply or a round that is revealed."""
    s = stage()
    writers = {
        entry["name"]
        for entry in s.genesis.abi
        if entry["type"] == "function" and entry["stateMutability"] not in ("view", "pure")
    }
    assert writers == {
        *("approve", "setApprovalForAll", "transferFrom", "safeTransferFrom"),
        *("mint", "mintWithProof", "mintWithSignature", "mintReserve", "reveal", "keepHash"),
        *("setPhase", "setAllowList", "setRoyalty", "withdraw", "transferOwnership", "acceptOwnership"),
    }
    for contract in (s.metadata, s.generator, s.renderer):
        assert all(
            entry["stateMutability"] in ("view", "pure") for entry in contract.abi if entry["type"] == "function"
        )
