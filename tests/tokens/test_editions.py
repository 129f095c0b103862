"""The collection to which anybody adds scenes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import pytest
from attrs import evolve

pytest.importorskip("pyrevm", reason="a chain with state needs it")

import copy

import numpy as np
from tools.tokens.launched import Launched, icon_scene, launched, store_scene
from tools.tokens.world import ETHER, GAS, ZERO, Contract, Receipt, Refused, World

from adversaries import adversary
from shackled import render
from shackled.tokens._metadata import read_data_uri
from token_checks import document, execute, pixels, refused, traits

OPEN = 2**32 - 1
PRICE = ETHER // 10
NOBODY = "0x" + "12" * 20


@dataclass
class Show:
    """A collection with one edition by alice: 8 x 8 pixels, 5 tokens, 5 % royalties, no copies."""

    s: Launched
    editions: Contract
    scene: str

    def __post_init__(self) -> None:
        self.world: World = self.s.world
        self.alice, self.bob, self.carol = self.s.alice, self.s.bob, self.s.owner

        self.call, self.gas_of = self.editions.call, self.editions.gas_of

    def send(self, function: str, *arguments: Any, sender: str | None = None, value: int = 0) -> Receipt:
        """A transaction, of alice if of nobody else."""
        return self.editions.send(function, *arguments, sender=sender or self.alice, value=value)

    def encode(self, function: str, *arguments: Any) -> bytes:
        """Data of a call."""
        return self.editions.encode(function, arguments)[1]

    def add(self, sender: str | None = None, gas: int = GAS, **changes: Any) -> Receipt:
        """Adds an edition."""
        terms = {"name": "One", "scene": self.scene, "scale": 1, "model": False, "price": PRICE}
        terms |= {"supply": 5, "royalty": 500, "copies": 0} | changes
        return self.editions.send("add", *terms.values(), sender=sender or self.alice, gas=gas)

    def mint(self, edition: int = 0, quantity: int = 1, sender: str | None = None, value: int | None = None) -> Receipt:
        due = quantity * self.call("editionAt", edition)[1] if value is None else value
        return self.send("mint", edition, quantity, sender=sender or self.bob, value=due)


@cache
def _shown() -> Show:
    s = launched()
    tiny = store_scene(s.studio, evolve(icon_scene("icons/lightning"), width=8, height=8))
    show = Show(s, s.world.deploy("Editions", s.studio), tiny)
    show.add()
    return show


@pytest.fixture
def show() -> Show:
    return copy.deepcopy(_shown())


# ---- adding ----


def test_anybody_adds_scenes(show: Show) -> None:
    first = show.call("editionAt", 0)
    receipt = show.add(show.bob, name="Two", price=1, supply=OPEN, royalty=1000, copies=2)
    added, *given = receipt.events
    names = ("edition", "artist", "scene", "name", "scale", "model", "price", "supply", "royalty")
    values = (1, show.bob, show.scene, "Two", 1, False, 1, OPEN, 1000)
    assert added == ("EditionAdded", dict(zip(names, values, strict=True)))
    assert [event["to"] for _, event in given] == [show.bob, show.bob]
    one = show.call("editionAt", 0)
    assert one == first == (show.alice, PRICE, 5, 0, 0, False, 500, 1, False, show.scene, "One")
    # the copies are the artist's, and nothing is due for them
    two = (show.bob, 1, OPEN, 2, 2, False, 1000, 1, False, show.scene, "Two")
    assert show.call("editionAt", 1) == two
    assert (show.call("editionCount"), show.call("totalSupply")) == (2, 2)
    assert [show.call("editionOf", token) for token in range(2)] == [1, 1]
    assert [show.call("left", edition) for edition in range(2)] == [5, OPEN - 2]
    assert [show.call("proceeds", edition) for edition in range(2)] == [0, 0]


def test_nobody_owns_it(show: Show) -> None:
    """There is nothing that only the deployer or an owner may do, and nothing that changes an edition."""
    writing = {
        each["name"]
        for each in show.editions.abi
        if each["type"] == "function" and each["stateMutability"] in ("nonpayable", "payable")
    }
    standard = {"approve", "safeTransferFrom", "setApprovalForAll", "transferFrom"}
    assert writing - standard == {"add", "close", "mint", "withdraw"}


@pytest.mark.parametrize(
    ("change", "error"),
    [
        ({"supply": 0}, ("NoSupply",)),
        ({"royalty": 1001}, ("Royalty", 1001, 1000)),
        ({"supply": OPEN, "copies": 101}, ("Quantity", 101, 100)),
        ({"copies": 6}, ("NothingLeft", 6, 5)),
    ],
)
def test_editions_that_make_no_sense_are_refused(show: Show, change: dict[str, Any], error: tuple[Any, ...]) -> None:
    with refused(*error):
        show.add(**change)
    assert show.call("editionCount") == 1


def test_limits_are_allowed(show: Show) -> None:
    show.add(name="x" * 64, scale=8, price=2**96 - 1, supply=200, royalty=1000, copies=100)
    show.world.fund(show.bob, 2**104)
    show.mint(1, 100)
    assert show.call("proceeds", 1) == 100 * (2**96 - 1) == show.world.balance(show.editions.address)
    assert show.call("left", 1) == 0
    show.add(name="x", price=0, supply=1, royalty=0, copies=1)
    assert show.call("editionOf", 200) == 2


def test_what_takes_too_much_gas_to_draw_is_refused(show: Show) -> None:
    """Also what passes the check of the studio, which draws one pixel, and where a chain gives transactions more."""
    limit = show.call("DRAWING_GAS")
    assert limit == 2**24
    large = evolve(icon_scene("icons/lightning"), width=768, height=768)
    # the renderer says that its engine ran out of gas; the encoder, of the second one, has no gas left to say it
    plain = evolve(large, width=480, height=440, objects=())
    for picture, scale, error in ((large, 1, "OutOfGas"), (plain, 8, "DrawingOutOfGas")):
        scene = store_scene(show.s.studio, picture)
        show.s.studio.call("check", scene)
        assert show.s.studio.gas_of("renderDataURI", scene, scale) > limit
        with refused(error):
            show.add(scene=scene, scale=scale)
    # at another scale it is not too much
    show.add(scene=scene)
    needed = show.s.studio.gas_of("renderDataURI", show.scene, 1)
    for gas in (needed // 2, needed, needed + 20_000):
        with pytest.raises(Refused):
            show.add(gas=gas)
    assert show.call("editionCount") == 2
    show.add()


def test_the_whole_metadata_is_computed(show: Show) -> None:
    """So what was added can be read with as much gas, and little more for the number of the token and its owner."""
    for number, (name, model) in enumerate((("lightning", False), ("ethereum", False), ("ethereum", True)), 1):
        scene = store_scene(show.s.studio, icon_scene(f"icons/{name}"))
        execution = show.add(scene=scene, scale=4, model=model, copies=3).execution
        computing = show.gas_of("editionURI", number)
        assert computing > show.s.studio.gas_of("renderDataURI", scene, 4)
        assert 0 < execution - computing < 330_000
        (*_, last) = range(show.call("totalSupply"))
        assert 0 < show.gas_of("tokenURI", last) - computing < 20_000


def test_the_metadata_of_an_edition_is_that_of_its_tokens(show: Show) -> None:
    show.add(name='A "model"', model=True, copies=1)
    plain, edition = (document(show.call("editionURI", number)) for number in range(2))
    token = document(show.call("tokenURI", 0))
    assert token == edition | {"name": 'A "model" #0'}
    assert edition["name"] == 'A "model"'
    assert "animation_url" not in plain
    kind, content = read_data_uri(edition["animation_url"], "the model")
    assert (kind, content) == ("model/gltf-binary", show.s.studio.call("glb", show.scene))
    with refused("UnknownEdition", 2, 2):
        show.call("editionURI", 2)


def test_the_number_of_an_edition_fits_beside_the_owner(show: Show) -> None:
    storage = show.world.of(show.editions.address).storage
    (slot,) = (slot for slot, value in storage.items() if value == 1 and slot < 32)
    storage[slot] = 2**24 - 1
    show.add(copies=1)
    assert show.call("editionOf", 0) == 2**24 - 1
    with refused("TooManyEditions", 2**24):
        show.add()


# ---- what tokens show ----


def test_tokens_show_their_scene_for_ever(show: Show) -> None:
    scene = evolve(icon_scene("icons/ethereum"), width=24, height=16)
    show.add(show.bob, name="Ether", scene=store_scene(show.s.studio, scene), scale=3, supply=OPEN)
    show.mint(1, 2)
    show.mint(0)
    said = [show.call("tokenURI", token) for token in range(3)]
    found = document(said[1])
    assert found["name"] == "Ether #1"
    artist = traits(found).pop("Artist")
    assert artist.lower() == show.bob
    assert artist != show.bob  # with its checksum
    assert traits(found) == {"Edition": 1, "Artist": artist, "Supply": "open"}
    expected = np.asarray(render(scene).pixels)
    assert np.array_equal(pixels(found["image"]), expected.repeat(3, 0).repeat(3, 1))
    assert found["description"].endswith(" Not by the authors of the Shackled contracts of 2021, nor endorsed by them.")
    assert traits(document(said[2]))["Supply"] == "5"
    show.send("close", 1, sender=show.bob)
    show.send("transferFrom", show.bob, show.carol, 1, sender=show.bob)
    assert [show.call("tokenURI", token) for token in range(3)] == said
    assert [show.call("editionOf", token) for token in range(3)] == [1, 1, 0]
    with refused("URIQueryForNonexistentToken"):
        show.call("tokenURI", 3)


def test_nobody_can_choose_the_picture_of_the_collection(show: Show) -> None:
    """It is that of tokens of Genesis before they are revealed."""
    found, hidden = document(show.call("contractURI")), document(show.s.metadata.call("hiddenURI", 0, 0))
    assert np.array_equal(pixels(found["image"]), pixels(hidden["image"]))


def test_royalties_are_those_of_the_edition(show: Show) -> None:
    show.add(show.bob, royalty=1000, copies=1)
    show.mint(0)
    assert show.call("royaltyInfo", 0, 12345) == (show.bob, 1234)
    assert show.call("royaltyInfo", 1, 10_000) == (show.alice, 500)
    with refused("OwnerQueryForNonexistentToken"):
        show.call("royaltyInfo", 2, 1)
    # ERC-165, ERC-721 with metadata, ERC-2981; not ERC-4906, since metadata never change
    interfaces = {"01ffc9a7": True, "80ac58cd": True, "5b5e139f": True, "2a55205a": True, "49064906": False}
    for interface, expected in (interfaces | {"ffffffff": False}).items():
        assert show.call("supportsInterface", bytes.fromhex(interface)) is expected


# ---- minting and ether ----


def test_payments_and_quantities(show: Show) -> None:
    for sent in (0, 2 * PRICE - 1, 2 * PRICE + 1, 3 * PRICE):
        with refused("Payment", sent, 2 * PRICE):
            show.mint(0, 2, value=sent)
    for quantity in (0, 101, 2**32, 2**256 - 1):
        with refused("Quantity", quantity, 100):
            show.mint(0, quantity, value=0)
    for edition in (1, 2**24, 2**256 - 1):
        for function, arguments in (("mint", (edition, 1)), ("close", (edition,)), ("withdraw", ([edition], NOBODY))):
            with refused("UnknownEdition", edition, 1):
                show.send(function, *arguments)
        for function in ("left", "proceeds", "editionAt"):
            with refused("UnknownEdition", edition, 1):
                show.call(function, edition)
    show.mint(0, 3)
    with refused("NothingLeft", 3, 2):
        show.mint(0, 3)
    show.mint(0, 2)
    with refused("NothingLeft", 1, 0):
        show.mint(0)


def test_a_closed_edition_is_closed_for_ever(show: Show) -> None:
    show.mint(0, 2)
    with refused("NotTheArtist", 0, show.alice, show.bob):
        show.send("close", 0, sender=show.bob)
    assert show.send("close", 0).events == [("EditionClosed", {"edition": 0, "minted": 2})]
    assert show.call("left", 0) == 0
    for sender in (show.alice, show.bob):
        with refused("AlreadyClosed", 0):
            show.mint(0, sender=sender)
    with refused("AlreadyClosed", 0):
        show.send("close", 0)
    # what was sold is still due
    show.send("withdraw", [0], NOBODY)
    assert show.world.balance(NOBODY) == 2 * PRICE


def test_artists_withdraw_what_their_own_tokens_cost(show: Show) -> None:
    show.add(show.carol, price=3, copies=2)
    show.add(show.alice, price=7)
    show.mint(0, 2)
    show.mint(1, 3)
    show.mint(2, 1)
    for editions, sender in (([1], show.alice), ([0, 2, 1], show.alice), ([0], show.carol)):
        with refused("NotTheArtist"):
            show.send("withdraw", editions, NOBODY, sender=sender)
    # naming an edition twice pays it once
    receipt = show.send("withdraw", [0, 2, 0, 2], NOBODY)
    amount = 2 * PRICE + 7
    assert receipt.events == [("Withdrawn", {"artist": show.alice, "to": NOBODY, "amount": amount})]
    assert int.from_bytes(receipt.output) == amount == show.world.balance(NOBODY)
    show.send("withdraw", [0, 2], NOBODY)
    assert show.world.balance(NOBODY) == amount
    assert show.call("proceeds", 1) == 9 == show.world.balance(show.editions.address)
    show.mint(0)
    show.send("withdraw", [0], NOBODY)
    assert show.world.balance(NOBODY) == amount + PRICE


def test_ether_comes_in_by_minting_only(show: Show) -> None:
    show.mint()
    both = (show.bob, show.alice)
    for function, *parties in (("approve", show.alice), ("transferFrom", *both), ("safeTransferFrom", *both)):
        with refused("PaymentForNothing", 1):
            show.send(function, *parties, 0, sender=show.bob, value=1)
    for data in (b"", b"\1\2\3\4"):
        with pytest.raises(Refused):
            show.world.run(show.bob, show.editions.address, data, 1, GAS, True, show.editions.abi)
    # what is forced in is nobody's, and changes nothing
    show.world.of(show.editions.address).balance += 5
    show.send("withdraw", [0], NOBODY)
    assert (show.world.balance(NOBODY), show.world.balance(show.editions.address)) == (PRICE, 5)


# ---- adversaries ----


def trap(show: Show, copies: int = 0) -> tuple[Any, ...]:
    """An edition of a contract."""
    return "add", "Trap", show.scene, 1, False, PRICE, 5, 0, copies


def test_calls_from_a_token_that_arrives(show: Show) -> None:
    """A receiver mints or adds while its token arrives; the token keeps its edition."""
    show.add(show.bob, price=1)
    receiver = show.world.deploy(adversary("Receiver"))
    show.world.fund(receiver.address, ETHER)
    mint = show.encode("mint", 0, 1)
    more = show.encode("add", "Two", show.scene, 1, False, 0, 1, 0, 1)
    for swallow in (False, True):
        for data, value in ((show.encode("mint", 1, 1), 1), (more, 0)):
            receiver.send("prepare", show.editions, data, value, swallow)
            with pytest.raises(Refused):
                receiver.send("execute", show.editions, mint, PRICE)
    assert show.call("totalSupply") == 0
    # adding without copies, giving the token away: as well then as later
    for data in (
        show.encode("add", "Two", show.scene, 1, False, 0, 1, 0, 0),
        show.encode("transferFrom", receiver.address, show.carol, 1),
    ):
        receiver.send("prepare", show.editions, data, 0, False)
        receiver.send("execute", show.editions, mint, PRICE)
    assert [show.call("editionOf", token) for token in range(2)] == [0, 0]
    assert show.call("ownerOf", 1) == show.carol
    assert show.call("editionAt", 2)[0] == receiver.address


def test_an_artist_who_mints_to_withdraw_gets_no_more_than_is_due(show: Show) -> None:
    """While the token arrives, and whenever ether arrives."""
    show.mint(0, 2)
    receiver = show.world.deploy(adversary("Receiver"))
    show.world.fund(receiver.address, PRICE)
    receiver.send("execute", show.editions, show.encode(*trap(show, 1)), 0)
    receiver.send("prepare", show.editions, show.encode("withdraw", [1], receiver.address), 0, False)
    receiver.send("execute", show.editions, show.encode("mint", 1, 1), PRICE)
    assert show.world.balance(receiver.address) == PRICE
    greedy = show.world.deploy(adversary("Greedy"))
    execute(greedy, show.editions, *trap(show, 1), sender=show.bob)
    show.mint(2, 2)
    execute(greedy, show.editions, "withdraw", [2], greedy.address, sender=show.bob)
    # the calls within the call succeed, and fetch nothing
    assert greedy.call("again") > 0
    assert show.world.balance(greedy.address) == 2 * PRICE
    assert show.world.balance(show.editions.address) == 2 * PRICE == show.call("proceeds", 0)


def test_who_refuses_ether_or_tokens_blocks_nobody_else(show: Show) -> None:
    refuser, deaf = show.world.deploy(adversary("Refuser")), show.world.deploy(adversary("Deaf"))
    execute(refuser, show.editions, *trap(show), sender=show.bob)
    show.mint(1)
    show.mint(0)
    for to in (refuser.address, ZERO):
        with refused("WithdrawalRefused", to, PRICE):
            execute(refuser, show.editions, "withdraw", [1], to, sender=show.bob)
    show.send("withdraw", [0], NOBODY)
    execute(refuser, show.editions, "withdraw", [1], NOBODY, sender=show.bob)
    assert show.world.balance(NOBODY) == 2 * PRICE
    # copies for a contract that cannot take them
    with refused("TransferToNonERC721ReceiverImplementer"):
        execute(deaf, show.editions, *trap(show, 1), sender=show.bob)
    execute(deaf, show.editions, *trap(show), sender=show.bob)
    with refused("TransferToNonERC721ReceiverImplementer"):
        execute(deaf, show.editions, "mint", 0, 1, value=PRICE, sender=show.bob)
    assert (show.call("editionCount"), show.call("totalSupply")) == (3, 2)


def test_long_answers_do_not_make_a_withdrawal_dear(show: Show) -> None:
    show.mint()
    bomb = show.world.deploy(adversary("Bomb"))
    # the receiver's own memory costs what it costs; copying it would cost as much again
    gas = show.send("withdraw", [0], bomb).gas
    alone = show.world.run(show.bob, bomb.address, b"", 0, 10**8, False, []).gas
    assert gas < alone + 50_000
