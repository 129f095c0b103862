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
from tools.tokens.stage import Stage, icon_scene, stage, store_scene
from tools.tokens.world import ETHER, GAS, ZERO, Contract, Receipt, Refused, World

from adversaries import adversary
from shackled import render
from shackled.tokens import read_data_uri
from token_checks import document, pixels, refused, traits

OPEN = 2**32 - 1
PRICE = ETHER // 10
NOBODY = "0x" + "12" * 20


@dataclass
class Show:
    """A collection with one edition by alice: 8 x 8 pixels, 5 tokens, 5 % royalties, no copies."""

    s: Stage
    editions: Contract
    scene: str

    def __post_init__(self) -> None:
        self.world: World = self.s.world
        self.alice, self.bob, self.carol = self.s.alice, self.s.bob, self.s.owner

    def add(self, sender: str | None = None, gas: int = GAS, **changes: Any) -> Receipt:
        """Adds an edition."""
        terms = {"name": "One", "scene": self.scene, "scale": 1, "model": False, "price": PRICE}
        terms |= {"supply": 5, "royalty": 500}
        terms |= {"copies": 0} | changes
        return self.editions.send("add", *terms.values(), sender=sender or self.alice, gas=gas)

    def mint(self, edition: int = 0, quantity: int = 1, sender: str | None = None, value: int | None = None) -> Receipt:
        due = quantity * self.editions.call("editionAt", edition)[1]
        due = due if value is None else value
        return self.editions.send("mint", edition, quantity, sender=sender or self.bob, value=due)


@cache
def _shown() -> Show:
    s = stage()
    tiny = store_scene(s.studio, evolve(icon_scene("icons/lightning"), width=8, height=8))
    show = Show(s, s.world.deploy("Editions", s.studio), tiny)
    show.add()
    return show


@pytest.fixture
def show() -> Show:
    return copy.deepcopy(_shown())


@pytest.fixture(scope="module")
def shared() -> Show:
    """For tests that undo what they do."""
    return copy.deepcopy(_shown())


# ---- adding ----


def test_anybody_adds_scenes(show: Show) -> None:
    first = show.editions.call("editionAt", 0)
    receipt = show.add(show.bob, name="Two", price=1, supply=OPEN, royalty=1000, copies=2)
    added, *given = receipt.events
    expected = {
        "edition": 1,
        "artist": show.bob,
        "scene": show.scene,
        "name": "Two",
        "scale": 1,
        "model": False,
        "price": 1,
    }
    assert added == ("EditionAdded", expected | {"supply": OPEN, "royalty": 1000})
    assert [event["to"] for _, event in given] == [show.bob, show.bob]
    assert (
        show.editions.call("editionAt", 0)
        == first
        == (*(show.alice, PRICE, 5, 0, 0, False, 500, 1, False, show.scene, "One"),)
    )
    # the copies are the artist's, and nothing is due for them
    assert show.editions.call("editionAt", 1) == (*(show.bob, 1, OPEN, 2, 2, False, 1000, 1, False, show.scene, "Two"),)
    assert (show.editions.call("editionCount"), show.editions.call("totalSupply")) == (2, 2)
    assert [show.editions.call("editionOf", token) for token in range(2)] == [1, 1]
    assert [show.editions.call("left", edition) for edition in range(2)] == [5, OPEN - 2]
    assert [show.editions.call("proceeds", edition) for edition in range(2)] == [0, 0]


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
def test_editions_that_make_no_sense_are_refused(shared: Show, change: dict[str, Any], error: tuple[Any, ...]) -> None:
    with refused(*error):
        shared.add(**change)
    assert shared.editions.call("editionCount") == 1


def test_limits_are_allowed(show: Show) -> None:
    show.add(name="x" * 64, scale=8, price=2**96 - 1, supply=100, royalty=1000, copies=100)
    assert show.editions.call("left", 1) == 0
    show.add(name="x", price=0, supply=1, royalty=0, copies=1)
    assert show.editions.call("editionOf", 100) == 2


def test_what_takes_too_much_gas_to_draw_is_refused(show: Show) -> None:
    """Also what passes the check of the studio, which draws one pixel, and where a chain gives transactions more."""
    limit = show.editions.call("DRAWING_GAS")
    assert limit == 2**24
    large = evolve(icon_scene("icons/lightning"), width=768, height=768)
    # the renderer says that its engine ran out of gas; the encoder, of the second one, has no gas left to say it
    for picture, scale, error in ((large, 1, "OutOfGas"), (evolve(large, objects=()), 8, "DrawingOutOfGas")):
        scene = store_scene(show.s.studio, picture)
        show.s.studio.call("check", scene)
        assert show.s.studio.gas_of("renderDataURI", scene, scale) > limit
        with refused(error):
            show.add(scene=scene, scale=scale)
    needed = show.s.studio.gas_of("renderDataURI", show.scene, 1)
    for gas in (needed // 2, needed, needed + 20_000):
        with pytest.raises(Refused):
            show.add(gas=gas)
    assert show.editions.call("editionCount") == 1
    show.add()


def test_the_whole_metadata_is_computed(show: Show) -> None:
    """So what was added can be read with as much gas, and little more for the number of the token and its owner."""
    for number, (name, model) in enumerate((("lightning", False), ("ethereum", False), ("ethereum", True)), 1):
        scene = store_scene(show.s.studio, icon_scene(f"icons/{name}"))
        execution = show.add(scene=scene, scale=4, model=model, copies=3).execution
        computing = show.editions.gas_of("editionURI", number)
        assert computing > show.s.studio.gas_of("renderDataURI", scene, 4)
        assert 0 < execution - computing < 330_000
        (*_, last) = range(show.editions.call("totalSupply"))
        assert 0 < show.editions.gas_of("tokenURI", last) - computing < 20_000


def test_the_metadata_of_an_edition_is_that_of_its_tokens(show: Show) -> None:
    show.add(name='A "model"', model=True, copies=1)
    plain, edition = (document(show.editions.call("editionURI", number)) for number in range(2))
    token = document(show.editions.call("tokenURI", 0))
    assert token == edition | {"name": 'A "model" #0'}
    assert edition["name"] == 'A "model"'
    assert "animation_url" not in plain
    kind, content = read_data_uri(edition["animation_url"], "the model")
    assert (kind, content) == ("model/gltf-binary", show.s.studio.call("glb", show.scene))
    with refused("UnknownEdition", 2, 2):
        show.editions.call("editionURI", 2)


def test_the_picture_is_drawn_at_its_scale(show: Show) -> None:
    """What fits at a scale of 1 may not fit at 8."""
    plain = evolve(icon_scene("icons/lightning"), width=480, height=440, objects=())
    scene = store_scene(show.s.studio, plain)
    assert show.s.studio.gas_of("renderDataURI", scene, 1) < 2**24 < show.s.studio.gas_of("renderDataURI", scene, 8)
    show.add(scene=scene)
    with refused("DrawingOutOfGas", scene, 2**24):
        show.add(scene=scene, scale=8)


def test_the_number_of_an_edition_fits_beside_the_owner(show: Show) -> None:
    storage = show.world.of(show.editions.address).storage
    (slot,) = (slot for slot, value in storage.items() if value == 1 and slot < 32)
    storage[slot] = 2**24 - 1
    show.add(copies=1)
    assert show.editions.call("editionOf", 0) == 2**24 - 1
    with refused("TooManyEditions", 2**24):
        show.add()


def test_the_same_scene_can_be_added_by_others(show: Show) -> None:
    """Or an account that sees it first could keep the artist from adding it."""
    show.add(show.bob)
    assert [show.editions.call("editionAt", edition)[0] for edition in range(2)] == [show.alice, show.bob]


# ---- what tokens show ----


def test_tokens_show_their_scene_for_ever(show: Show) -> None:
    scene = evolve(icon_scene("icons/ethereum"), width=24, height=16)
    show.add(show.bob, name="Ether", scene=store_scene(show.s.studio, scene), scale=3, supply=OPEN)
    show.mint(1, 2)
    show.mint(0)
    said = [show.editions.call("tokenURI", token) for token in range(3)]
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
    show.editions.send("close", 1, sender=show.bob)
    show.editions.send("transferFrom", show.bob, show.carol, 1, sender=show.bob)
    assert [show.editions.call("tokenURI", token) for token in range(3)] == said
    assert [show.editions.call("editionOf", token) for token in range(3)] == [1, 1, 0]
    with refused("URIQueryForNonexistentToken"):
        show.editions.call("tokenURI", 3)


def test_the_collection_speaks_of_itself(shared: Show) -> None:
    found = document(shared.editions.call("contractURI"))
    assert (found["name"], found["symbol"]) == ("Shackled Editions", "SHKE")
    assert "Anybody can add scenes" in found["description"]
    # nobody can choose its picture, which is that of tokens of Genesis before they are revealed
    hidden = document(shared.s.metadata.call("hiddenURI", 0, 0))
    assert np.array_equal(pixels(found["image"]), pixels(hidden["image"]))


def test_royalties_are_those_of_the_edition(show: Show) -> None:
    show.add(show.bob, royalty=1000, copies=1)
    show.mint(0)
    assert show.editions.call("royaltyInfo", 0, 12345) == (show.bob, 1234)
    assert show.editions.call("royaltyInfo", 1, 10_000) == (show.alice, 500)
    with refused("OwnerQueryForNonexistentToken"):
        show.editions.call("royaltyInfo", 2, 1)
    for interface, expected in (
        ("01ffc9a7", True),  # ERC-165
        ("80ac58cd", True),  # ERC-721
        ("5b5e139f", True),  # its metadata
        ("2a55205a", True),  # ERC-2981
        ("49064906", False),  # ERC-4906: metadata never change
        ("ffffffff", False),
    ):
        assert show.editions.call("supportsInterface", bytes.fromhex(interface)) is expected


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
                show.editions.send(function, *arguments, sender=show.alice)
        for function in ("left", "proceeds", "editionAt"):
            with refused("UnknownEdition", edition, 1):
                show.editions.call(function, edition)
    show.mint(0, 3)
    with refused("NothingLeft", 3, 2):
        show.mint(0, 3)
    show.mint(0, 2)
    with refused("NothingLeft", 1, 0):
        show.mint(0)


def test_no_payment_overflows(show: Show) -> None:
    show.add(price=2**96 - 1, supply=OPEN)
    show.world.fund(show.bob, 2**104)
    show.mint(1, 100)
    assert show.editions.call("proceeds", 1) == 100 * (2**96 - 1) == show.world.balance(show.editions.address)


def test_a_closed_edition_is_closed_for_ever(show: Show) -> None:
    show.mint(0, 2)
    with refused("NotTheArtist", 0, show.alice, show.bob):
        show.editions.send("close", 0, sender=show.bob)
    assert show.editions.send("close", 0, sender=show.alice).events == [("EditionClosed", {"edition": 0, "minted": 2})]
    assert show.editions.call("left", 0) == 0
    for sender in (show.alice, show.bob):
        with refused("AlreadyClosed", 0):
            show.mint(0, sender=sender)
    with refused("AlreadyClosed", 0):
        show.editions.send("close", 0, sender=show.alice)
    # what was sold is still due
    show.editions.send("withdraw", [0], NOBODY, sender=show.alice)
    assert show.world.balance(NOBODY) == 2 * PRICE


def test_artists_withdraw_what_their_own_tokens_cost(show: Show) -> None:
    show.add(show.carol, price=3, copies=2)
    show.add(show.alice, price=7)
    show.mint(0, 2)
    show.mint(1, 3)
    show.mint(2, 1)
    for editions, sender in (([1], show.alice), ([0, 2, 1], show.alice), ([0], show.carol)):
        with refused("NotTheArtist"):
            show.editions.send("withdraw", editions, NOBODY, sender=sender)
    # naming an edition twice pays it once
    receipt = show.editions.send("withdraw", [0, 2, 0, 2], NOBODY, sender=show.alice)
    amount = 2 * PRICE + 7
    assert receipt.events == [("Withdrawn", {"artist": show.alice, "to": NOBODY, "amount": amount})]
    assert int.from_bytes(receipt.output) == amount == show.world.balance(NOBODY)
    show.editions.send("withdraw", [0, 2], NOBODY, sender=show.alice)
    assert show.world.balance(NOBODY) == amount
    assert show.editions.call("proceeds", 1) == 9 == show.world.balance(show.editions.address)
    show.mint(0)
    show.editions.send("withdraw", [0], NOBODY, sender=show.alice)
    assert show.world.balance(NOBODY) == amount + PRICE


def test_ether_comes_in_by_minting_only(show: Show) -> None:
    show.mint()
    for function, arguments in (
        ("approve", (show.alice, 0)),
        ("transferFrom", (show.bob, show.alice, 0)),
        ("safeTransferFrom", (show.bob, show.alice, 0)),
    ):
        with refused("PaymentForNothing", 1):
            show.editions.send(function, *arguments, sender=show.bob, value=1)
    for data in (b"", b"\1\2\3\4"):
        with pytest.raises(Refused):
            show.world.run(show.bob, show.editions.address, data, 1, GAS, True, show.editions.abi)
    # what is forced in is nobody's, and changes nothing
    show.world.of(show.editions.address).balance += 5
    show.editions.send("withdraw", [0], NOBODY, sender=show.alice)
    assert (show.world.balance(NOBODY), show.world.balance(show.editions.address)) == (PRICE, 5)


# ---- adversaries ----


def execute(show: Show, contract: Contract, function: str, *arguments: Any, value: int = 0) -> Receipt:
    """Has a contract call the collection, whose errors it passes on."""
    data = contract.encode("execute", (show.editions, show.editions.encode(function, arguments)[1]))[1]
    return show.world.run(show.bob, contract.address, data, value, GAS, True, show.editions.abi)


def trap(show: Show, copies: int = 0) -> tuple[Any, ...]:
    """An edition of a contract."""
    return "add", "Trap", show.scene, 1, False, PRICE, 5, 0, copies


def test_calls_from_a_token_that_arrives(show: Show) -> None:
    """A receiver mints or adds while its token arrives; the token keeps its edition."""
    show.add(show.bob, price=1)
    receiver = show.world.deploy(adversary("Receiver"))
    show.world.fund(receiver.address, ETHER)
    mint = show.editions.encode("mint", (0, 1))[1]
    more = show.editions.encode("add", ("Two", show.scene, 1, False, 0, 1, 0, 1))[1]
    for swallow in (False, True):
        for data, value in ((show.editions.encode("mint", (1, 1))[1], 1), (more, 0)):
            receiver.send("prepare", show.editions, data, value, swallow)
            with pytest.raises(Refused):
                receiver.send("execute", show.editions, mint, PRICE)
    assert show.editions.call("totalSupply") == 0
    # adding without copies, giving the token away: as well then as later
    for data in (
        show.editions.encode("add", ("Two", show.scene, 1, False, 0, 1, 0, 0))[1],
        show.editions.encode("transferFrom", (receiver.address, show.carol, 1))[1],
    ):
        receiver.send("prepare", show.editions, data, 0, False)
        receiver.send("execute", show.editions, mint, PRICE)
    assert [show.editions.call("editionOf", token) for token in range(2)] == [0, 0]
    assert show.editions.call("ownerOf", 1) == show.carol
    assert show.editions.call("editionAt", 2)[0] == receiver.address


def test_an_artist_who_mints_to_withdraw_gets_no_more_than_is_due(show: Show) -> None:
    """While the token arrives, and whenever ether arrives."""
    show.mint(0, 2)
    receiver = show.world.deploy(adversary("Receiver"))
    show.world.fund(receiver.address, PRICE)
    receiver.send("execute", show.editions, show.editions.encode("add", trap(show, 1)[1:])[1], 0)
    receiver.send("prepare", show.editions, show.editions.encode("withdraw", ([1], receiver.address))[1], 0, False)
    receiver.send("execute", show.editions, show.editions.encode("mint", (1, 1))[1], PRICE)
    assert show.world.balance(receiver.address) == PRICE
    greedy = show.world.deploy(adversary("Greedy"))
    execute(show, greedy, *trap(show, 1))
    show.mint(2, 2)
    execute(show, greedy, "withdraw", [2], greedy.address)
    # the calls within the call succeed, and fetch nothing
    assert greedy.call("again") > 0
    assert show.world.balance(greedy.address) == 2 * PRICE
    assert show.world.balance(show.editions.address) == 2 * PRICE == show.editions.call("proceeds", 0)


def test_who_refuses_ether_or_tokens_blocks_nobody_else(show: Show) -> None:
    refuser, deaf = show.world.deploy(adversary("Refuser")), show.world.deploy(adversary("Deaf"))
    execute(show, refuser, *trap(show))
    show.mint(1)
    show.mint(0)
    for to in (refuser.address, ZERO):
        with refused("WithdrawalRefused", to, PRICE):
            execute(show, refuser, "withdraw", [1], to)
    show.editions.send("withdraw", [0], NOBODY, sender=show.alice)
    execute(show, refuser, "withdraw", [1], NOBODY)
    assert show.world.balance(NOBODY) == 2 * PRICE
    # copies for a contract that cannot take them
    with refused("TransferToNonERC721ReceiverImplementer"):
        execute(show, deaf, *trap(show, 1))
    execute(show, deaf, *trap(show))
    with refused("TransferToNonERC721ReceiverImplementer"):
        execute(show, deaf, "mint", 0, 1, value=PRICE)
    assert (show.editions.call("editionCount"), show.editions.call("totalSupply")) == (3, 2)


def test_long_answers_do_not_make_a_withdrawal_dear(show: Show) -> None:
    show.mint()
    bomb = show.world.deploy(adversary("Bomb"))
    # the receiver's own memory costs what it costs; copying it would cost as much again
    gas = show.editions.send("withdraw", [0], bomb, sender=show.alice).gas
    alone = show.world.run(show.bob, bomb.address, b"", 0, 10**8, False, []).gas
    assert gas < alone + 50_000
