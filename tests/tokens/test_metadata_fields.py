"""What tokens show, above all those of Genesis, the fields of their metadata, and the tokens of an account."""

from __future__ import annotations

import io
import re
from typing import Any

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

import numpy as np
from attrs import evolve
from numpy.typing import NDArray
from PIL import Image as PillowImage
from tools.tokens.launched import ICONS, Launched, icon_scene, launched, store_scene
from tools.tokens.world import ETHER, Contract, Refused

from shackled import render
from shackled.datasets.genesis import generate, seed_of
from shackled.image import decode_bmp
from token_checks import INDEPENDENT, document, pixels, traits

ADDRESS = r"0x[0-9a-f]{40}"
SIDE, SCALE = 128, 4
#: What marketplaces take.
LONGEST_URI = 100_000
MOST_GAS = 10_000_000


@pytest.fixture(scope="module")
def s() -> Launched:
    """A token of each icon, and ten revealed ones of Genesis."""
    s = launched()
    s.mint(10)
    s.reveal(0)
    for icon, (_, _, _, price) in enumerate(ICONS.values()):
        s.icons.send("mint", icon, 1, sender=s.alice, value=price)
    return s


@pytest.fixture(scope="module")
def editions(s: Launched) -> Contract:
    collection = s.world.deploy("Editions", s.studio)
    scene = store_scene(s.studio, evolve(icon_scene("icons/ethereum"), width=32, height=24))
    collection.send("add", "Ether", scene, 3, True, ETHER, 5, 0, 3, sender=s.bob)
    return collection


def follow(s: Launched, url: str) -> NDArray[np.uint8]:
    """Return the picture at a web3:// address, called as ERC-6860 says of contracts without a mode of their own."""
    match = re.fullmatch(rf"web3://({ADDRESS}):1/(\w+)((?:/[0-9a-fx]+)+)\?mime\.(?:type|content)=([\w/]+)", url)
    assert match, url
    contract = next(each for each in (s.generator, s.studio) if int(each.address, 16) == int(match[1], 16))
    parts = match[3].split("/")[1:]
    kinds = [{42: "address", 66: "bytes32"}.get(len(part), "uint256") for part in parts]
    values = [bytes.fromhex(part[2:]) if len(part) == 66 else part if len(part) == 42 else int(part) for part in parts]
    content: bytes = contract.call(f"{match[2]}({','.join(kinds)})", *values)
    with PillowImage.open(io.BytesIO(content), formats=["PNG" if match[4] == "png" else "BMP"]) as opened:
        return np.asarray(opened.convert("RGB"))


def test_the_link_of_a_token_leads_to_its_picture(s: Launched, editions: Contract) -> None:
    for collection, token, scale in (
        (s.icons, 0, 1),
        (s.icons, 1, 1),
        (editions, 2, 1),
        (s.genesis, 0, 4),
        (s.genesis, 9, 4),
    ):
        found = document(collection.call("tokenURI", token))
        assert np.array_equal(follow(s, found["external_url"]), pixels(found["image"])[::scale, ::scale])
    assert pixels(document(editions.call("tokenURI", 2))["image"]).shape == (72, 96, 3)


def test_links_name_their_chain() -> None:
    elsewhere = launched(chain_id=11155111)
    found = document(elsewhere.metadata.call("tokenURI", 0, seed_of(0)))
    assert re.match(rf"web3://{ADDRESS}:11155111/render/0x", found["external_url"])


def test_the_colour_around_a_piece_is_that_of_its_background(s: Launched) -> None:
    inverted = set()
    for number in range(12):
        seed = seed_of(number)
        piece = generate(seed)
        found = document(s.metadata.call("tokenURI", number, seed))
        top = np.frombuffer(bytes.fromhex(found["background_color"]), np.uint8).astype(int)
        assert len(top) == 3
        # the first row is almost at the top of the gradient
        row = pixels(found["image"])[0].astype(int)
        assert np.abs(row - top).max(axis=1).min() <= 2
        inverted.add(piece.invert)
    assert len(inverted) == 2


def test_numbers_are_shown_as_numbers(s: Launched, editions: Contract) -> None:
    for uri in (s.genesis.call("tokenURI", 0), s.icons.call("tokenURI", 0), editions.call("tokenURI", 0)):
        attributes = document(uri)["attributes"]
        for each in attributes:
            assert each.get("display_type") == ("number" if isinstance(each["value"], int) else None)
        assert any("display_type" in each for each in attributes)


def test_collections_have_a_banner(s: Launched, editions: Contract) -> None:
    for collection in (s.genesis, s.icons, editions):
        found = document(collection.call("contractURI"))
        assert list(found) == ["name", "symbol", "description", "banner_image", "image"]
        assert (found["name"], found["symbol"]) == tuple(collection.call(each) for each in ("name", "symbol"))
        assert found["name"].startswith("Shackled ")
        assert found["description"].endswith(f" {INDEPENDENT}")
        assert pixels(found["image"]).shape == (512, 512, 3)
        banner = pixels(found["banner_image"])
        assert banner.shape == (256, 1024, 3)
        # the object in the middle, and nothing at the ends
        assert len(np.unique(banner[:, 384:640].reshape(-1, 3), axis=0)) > 20
        assert banner[:, :64].std(axis=1).max() < 1
    empty = s.world.deploy("IconsCollection", s.studio, (s.owner, 1, s.owner, 500), sender=s.owner)
    assert "image" not in document(empty.call("contractURI"))


def test_the_tokens_of_an_account(s: Launched, editions: Contract) -> None:
    def tokens(collection: Contract, *range_: int, owner: str) -> tuple[Any, ...]:
        return tuple(collection.call("tokensOfOwnerIn" if range_ else "tokensOfOwner", owner, *range_))

    with s.world.attempt():
        s.genesis.send("transferFrom", s.alice, s.bob, 4, sender=s.alice)
        assert tokens(s.genesis, owner=s.alice) == (0, 1, 2, 3, 5, 6, 7, 8, 9)
        assert tokens(s.genesis, owner=s.bob) == (4,)
        assert tokens(s.genesis, owner=s.owner) == ()
        assert tokens(s.genesis, 3, 6, owner=s.alice) == (3, 5)
    assert tokens(s.icons, owner=s.alice) == (0, 1)
    assert tokens(editions, owner=s.bob) == (0, 1, 2)
    with pytest.raises(Refused, match="InvalidQueryRange"):
        tokens(editions, 2, 2, owner=s.bob)
    assert editions.call("explicitOwnershipOf", 1)[0] == s.bob
    assert editions.call("explicitOwnershipOf", 3)[0] == "0x" + "00" * 20


def test_the_picture_is_that_of_the_generator(s: Launched) -> None:
    """For pieces of all kinds: wires, inverted, one prism."""
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


def test_the_traits_are_those_of_the_model(s: Launched) -> None:
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


def test_a_token_shows_that_it_is_not_revealed(s: Launched) -> None:
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


def test_there_is_nothing_to_see_of_tokens_that_are_not_there(s: Launched) -> None:
    for token in (10, 1023, 2**256 - 1):
        with pytest.raises(Refused, match="URIQueryForNonexistentToken"):
            s.genesis.call("tokenURI", token)
        for function in ("seedOf", "traitsOf", "render", "roundOf", "ownerOf"):
            with pytest.raises(Refused, match="OwnerQueryForNonexistentToken"):
                s.genesis.call(function, token)


def test_length_and_gas(s: Launched) -> None:
    lengths, gas = [], []
    for number in range(48):
        lengths.append(len(s.metadata.call("tokenURI", number, seed_of(number))))
        gas.append(s.metadata.gas_of("tokenURI", number, seed_of(number)))
    assert max(lengths) < LONGEST_URI
    assert np.mean(gas) < 6_500_000
    assert np.quantile(gas, 0.95) < MOST_GAS


def test_nothing_of_it_can_be_changed() -> None:
    """No function writes generator, renderer, metadata, price, supply or a round that is revealed."""
    s = launched()
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
