"""The collection of scenes that are kept on chain."""

from __future__ import annotations

import base64
import io

import pytest
from attrs import evolve

pytest.importorskip("pyrevm", reason="a chain with state needs it")

import numpy as np
from PIL import Image as PillowImage
from tools.tokens.launched import ALLOW_LIST, CLOSED, ICONS, LIMIT, PUBLIC, Launched, icon_scene
from tools.tokens.merkle import leaf
from tools.tokens.world import ETHER, ZERO, Contract, Refused

from adversaries import adversary
from pictures import frames_of
from shackled import render
from shackled.image import decode_bmp
from token_checks import INDEPENDENT, document, pixels, refused, traits

PRICES = [price for _, _, _, price in ICONS.values()]


def fresh(s: Launched) -> Contract:
    """A collection without icons."""
    return s.world.deploy("IconsCollection", s.studio, (s.owner, LIMIT, s.owner, 500), sender=s.owner)


def pointer(s: Launched) -> str:
    return str(s.icons.call("iconAt", 0)[1])


def test_each_icon_has_its_own_supply(s: Launched) -> None:
    s.icons.send("mint", 0, 10, sender=s.alice, value=10 * PRICES[0])
    assert s.icons.call("left", 0) == 0
    with refused("NothingLeft", 1, 0):
        s.icons.send("mint", 0, 1, sender=s.alice, value=PRICES[0])
    s.icons.send("mint", 1, 10, sender=s.alice, value=10 * PRICES[1])
    s.icons.send("mintReserve", 0, s.bob, 2, sender=s.owner)
    with refused("NothingLeft", 1, 0):
        s.icons.send("mintReserve", 0, s.bob, 1, sender=s.owner)
    with refused("NothingLeft", 1, 0):
        s.icons.send("mintReserve", 1, s.bob, 1, sender=s.owner)
    assert [s.icons.call("iconOf", token) for token in (9, 10, 20, 21)] == [0, 1, 0, 0]


def test_payments_and_quantities(s: Launched) -> None:
    for sent in (0, PRICES[1], 2 * PRICES[0] + 1, 3 * PRICES[0]):
        with refused("Payment", sent, 2 * PRICES[0]):
            s.icons.send("mint", 0, 2, sender=s.alice, value=sent)
    for quantity in (0, LIMIT + 1, 2**256 - 1):
        with refused("Quantity", quantity, LIMIT):
            s.icons.send("mint", 0, quantity, sender=s.alice)
        with refused("Quantity", quantity, LIMIT):
            s.icons.send("mintReserve", 0, s.bob, quantity, sender=s.owner)


def test_icons_that_there_are_not(s: Launched) -> None:
    for icon in (2, 2**24, 2**256 - 1):
        for function, *more in (("mint", 1), ("left",), ("iconAt",), ("renderIcon",)):
            with refused("UnknownIcon", icon, 2):
                s.icons.send(function, icon, *more, sender=s.alice)


def test_the_allow_list_counts_all_icons_together(s: Launched) -> None:
    s.icons.send("setPhase", ALLOW_LIST, sender=s.owner)
    s.icons.send("setAllowList", leaf(s.alice, 3), s.owner, sender=s.owner)
    s.icons.send("mintWithProof", 0, 2, 3, [], sender=s.alice, value=2 * PRICES[0])
    with refused("AllowanceExceeded", 2, 2, 3):
        s.icons.send("mintWithProof", 1, 2, 3, [], sender=s.alice, value=2 * PRICES[1])
    s.icons.send("mintWithProof", 1, 1, 3, [], sender=s.alice, value=PRICES[1])
    with refused("WrongPhase", ALLOW_LIST, PUBLIC):
        s.icons.send("mint", 1, 1, sender=s.alice, value=PRICES[1])
    with refused("AllowanceNotSigned", s.owner):
        s.icons.send("mintWithSignature", 0, 1, (s.alice, 1, 2**40), bytes(65), sender=s.alice, value=PRICES[0])


def test_icons_are_added_until_the_collection_is_sealed(s: Launched) -> None:
    c, scene = fresh(s), pointer(s)
    for supply, reserve in ((0, 0), (5, 6)):
        with refused("Supply", supply, reserve):
            c.send("add", "One", scene, 4, ETHER, supply, reserve, sender=s.owner)
    with refused("NoIcons"):
        c.send("seal", sender=s.owner)
    receipt = c.send("add", "One", scene, 4, ETHER, 5, 1, sender=s.owner)
    expected = {"icon": 0, "name": "One", "scene": scene, "price": ETHER, "supply": 5, "reserve": 1}
    assert receipt.events == [("IconAdded", expected), ("ContractURIUpdated", {})]
    for phase in (ALLOW_LIST, PUBLIC):
        with refused("NotSealed"):
            c.send("setPhase", phase, sender=s.owner)
    c.send("setPhase", CLOSED, sender=s.owner)
    with refused("NotSealed"):
        c.send("mintReserve", 0, s.bob, 1, sender=s.owner)
    assert c.send("seal", sender=s.owner).events == [("Sealed", {"icons": 1})]
    with refused("AlreadySealed"):
        c.send("add", "Two", scene, 4, ETHER, 5, 1, sender=s.owner)
    with refused("AlreadySealed"):
        c.send("seal", sender=s.owner)
    assert (c.call("isSealed"), c.call("iconCount")) == (True, 1)
    assert c.call("iconAt", 0) == ("One", scene, 4, ETHER, 5, 1, 0, 0)


def test_no_price_times_quantity_overflows(s: Launched) -> None:
    c = fresh(s)
    c.send("add", "Dear", pointer(s), 4, 2**96 - 1, 2**32 - 1, 0, sender=s.owner)
    c.send("seal", sender=s.owner)
    c.send("setPhase", PUBLIC, sender=s.owner)
    with refused("Payment", 0, 10 * (2**96 - 1)):
        c.send("mint", 0, 10, sender=s.alice)
    s.world.fund(s.alice, 2**100)
    c.send("mint", 0, 10, sender=s.alice, value=10 * (2**96 - 1))
    assert c.call("left", 0) == 2**32 - 1 - 10


def test_tokens_show_their_icon(s: Launched) -> None:
    for icon, name in enumerate(ICONS):
        s.icons.send("mint", icon, 1, sender=s.alice, value=PRICES[icon])
        found = document(s.icons.call("tokenURI", icon))
        title, supply, _, _ = ICONS[name]
        assert found["name"] == f"{title} #{icon}"
        assert traits(found) == {"Icon": title, "Supply": supply}
        expected = np.asarray(render(icon_scene(name)).pixels)
        assert np.array_equal(pixels(found["image"]), expected.repeat(4, 0).repeat(4, 1))
        assert np.array_equal(decode_bmp(s.icons.call("renderIcon", icon), 128, 128), expected)
        assert found["description"].endswith(f" {INDEPENDENT}")
        assert len(s.icons.call("tokenURI", icon)) < 100_000
    with refused("URIQueryForNonexistentToken"):
        s.icons.call("tokenURI", 2)


def test_render_takes_the_number_of_a_token(s: Launched) -> None:
    """As in the other collection; icons are drawn by a function of another name."""
    for icon in (1, 1, 0):
        s.icons.send("mint", icon, 1, sender=s.alice, value=PRICES[icon])
    pictures = [s.icons.call("renderIcon", icon) for icon in range(2)]
    assert pictures[0] != pictures[1]
    assert [s.icons.call("render", token) for token in range(3)] == [pictures[1], pictures[1], pictures[0]]
    with refused("OwnerQueryForNonexistentToken"):
        s.icons.call("render", 3)


def test_a_token_turns(s: Launched) -> None:
    """Its picture in `tokenURI` and its animation show the same icon, which is not cut off."""
    s.icons.send("mint", 1, 1, sender=s.alice, value=PRICES[1])
    scheme, _, text = s.icons.call("animation", 0).partition(",")
    assert scheme == "data:image/png;base64"
    png = base64.b64decode(text, validate=True)
    with PillowImage.open(io.BytesIO(png)) as film:
        assert (film.size, film.info["loop"], film.info["duration"]) == ((256, 256), 0, 100)
    frames = frames_of(png)
    assert len(frames) == 12
    still = render(evolve(icon_scene("icons/ethereum"), width=64, height=64)).pixels.repeat(4, 0).repeat(4, 1)
    assert (np.abs(frames[0].astype(int) - still) > 8).mean() < 0.05
    for frame in frames[1:]:
        assert 0.02 < (frame != frames[0]).any(axis=2).mean() < 0.6
        # the background is the same all along a row
        assert (frame[:, :4] == frame[:, -4:]).all()
    scheme, _, text = s.icons.call("model", 0).partition(",")
    assert scheme == "data:model/gltf-binary;base64"
    assert base64.b64decode(text, validate=True) == s.studio.call("glb", s.icons.call("iconAt", 1)[1])
    for function in ("animation", "model"):
        with refused("OwnerQueryForNonexistentToken"):
            s.icons.call(function, 1)


def test_a_receiver_that_calls_back_changes_no_icon(s: Launched) -> None:
    """While tokens of one icon arrive, it mints another."""
    receiver = s.world.deploy(adversary("Receiver"))
    s.world.fund(receiver.address, ETHER)
    for swallow in (False, True):
        receiver.send("prepare", s.icons, s.icons.encode("mint", (1, 1))[1], PRICES[1], swallow)
        with pytest.raises(Refused):
            receiver.send("execute", s.icons, s.icons.encode("mint", (0, 1))[1], PRICES[0])
    assert s.icons.call("totalSupply") == 0
    assert s.icons.call("left", 0) == 10
    receiver.send("prepare", ZERO, b"", 0, False)
    receiver.send("execute", s.icons, s.icons.encode("mint", (0, 1))[1], PRICES[0])
    assert s.icons.call("iconOf", 0) == 0


def test_only_the_owner_may(s: Launched) -> None:
    c, add = fresh(s), ("add", "Two", pointer(s), 4, ETHER, 5, 1)
    for function, *arguments in (add, ("mintReserve", 0, s.bob, 1), ("setPhase", 0), ("withdraw", s.bob), ("seal",)):
        with refused("OwnableUnauthorizedAccount", s.bob):
            c.send(str(function), *arguments, sender=s.bob)
