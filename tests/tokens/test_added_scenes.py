"""What the collections of icons and of editions check alike: the name and the scene of what is added."""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any

import pytest
from attrs import evolve

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from eth_abi.abi import encode
from hypothesis import example, given, settings
from hypothesis import strategies as st
from tools.tokens.launched import LIMIT, Launched, icon_scene, launched, store_scene
from tools.tokens.world import GAS, Contract, keccak

from token_checks import document, refused, traits

NOBODY = "0x" + "12" * 20


@dataclass
class Shop:
    """An empty collection, and a scene of 8 x 8 pixels.

    terms: of one token, after name, scene and scale. kinds: types of the scale and of these.
    """

    s: Launched
    contract: Contract
    scene: str
    kinds: str
    terms: tuple[Any, ...]
    is_icons: bool

    def add(self, name: str = "One", scene: str | None = None, scale: int = 1) -> None:
        """Add a scene, of which one token is minted at once or can be."""
        self.contract.send("add", name, scene or self.scene, scale, *self.terms, sender=self.s.owner)

    def token(self, name: str) -> dict[str, Any]:
        """Return the metadata of token 0, which is of a scene with this name."""
        self.add(name)
        if self.is_icons:
            self.contract.send("seal", sender=self.s.owner)
            self.contract.send("mintReserve", 0, self.s.bob, 1, sender=self.s.owner)
        return document(self.contract.call("tokenURI", 0))


@pytest.fixture(scope="module", params=["IconsCollection", "Editions"])
def shop(request: pytest.FixtureRequest) -> Shop:
    s = launched()
    tiny = store_scene(s.studio, evolve(icon_scene("icons/lightning"), width=8, height=8))
    if request.param == "Editions":
        kinds, terms = "uint8,bool,uint96,uint32,uint16,uint32", (False, 0, 1, 0, 1)
        return Shop(s, s.world.deploy("Editions", s.studio), tiny, kinds, terms, is_icons=False)
    icons = s.world.deploy("IconsCollection", s.studio, (s.owner, LIMIT, s.owner, 500), sender=s.owner)
    return Shop(s, icons, tiny, "uint8,uint96,uint32,uint32", (0, 1, 1), is_icons=True)


@settings(max_examples=40)
@given(st.text(st.characters(codec="utf-8"), min_size=1, max_size=64).filter(lambda name: len(name.encode()) <= 64))
@example('","image":"x')
@example('"')
@example("\\")
@example("\n\r\t\x00\x1f\x7f")
@example("</script> é 😀")
@example("%22#")
def test_every_name_is_valid_json(shop: Shop, name: str) -> None:
    with shop.s.world.attempt():
        found = shop.token(name)
    assert list(found) == ["name", "description", "external_url", "attributes", "image"]
    assert found["name"] == f"{name} #0"
    assert traits(found).get("Icon", name) == name


def test_documents_of_every_length(shop: Shop) -> None:
    """Base64 works on 24 bytes, memory on 32: no remainder may lose anything."""
    for length in range(1, 65):
        with shop.s.world.attempt():
            assert shop.token("n" * length)["name"] == "n" * length + " #0"


PIECES = [*map(str.encode, "aé€😀"), b"\xed\xa0\x80", b"\xc0\xaf", b"\xf4\x90", b"\x80"]
#: The edges of what UTF-8 allows: overlong, cut, surrogates, beyond the last character.
EDGES = [
    *(b"caf\xe9\xff", b"\xed\x9f\xbf\xee\x80\x80\xf4\x8f\xbf\xbf\xc2\x80\xe0\xa0\x80\xf0\x90\x80\x80"),
    *(b"\xe0\x80\x80", b"\xe0\x9f\xbf", b"\xe2\x82", b"\xe2\x82a", b"\xc3a", b"\xed\xbf\xbf", b"\xf0\x80\x80\x80"),
    *(b"\xf0\x8f\xbf\xbf", b"\xf4\x90\x80\x80", b"\xf8\x90\x80\x80"),
]


def check_name(shop: Shop, name: bytes) -> None:
    """Python's decoder says which bytes are UTF-8, and where they are not."""
    data = keccak(f"add(string,address,{shop.kinds})".encode())[:4]
    data += encode(["bytes", "address", *shop.kinds.split(",")], [name, shop.scene, 1, *shop.terms])
    expected: AbstractContextManager[None] = nullcontext()
    try:
        name.decode()
    except UnicodeDecodeError as error:
        # Python reports the first byte of the invalid character
        expected = refused("NameNotUtf8", error.start)
    with expected:
        shop.s.world.run(shop.s.owner, shop.contract.address, data, 0, GAS, False, shop.contract.abi)


@settings(max_examples=80)
@given(st.one_of(st.binary(min_size=1), st.lists(st.sampled_from(PIECES), min_size=1).map(b"".join)))
def test_names_are_text(shop: Shop, name: bytes) -> None:
    check_name(shop, name[:64])


def test_names_at_the_edges_of_text(shop: Shop) -> None:
    for name in EDGES:
        check_name(shop, name)


@pytest.mark.parametrize(
    ("change", "error"),
    [
        ({"name": ""}, ("NameLength", 0, 64)),
        ({"name": "x" * 65}, ("NameLength", 65, 64)),
        ({"name": "x" * 100_000}, ("NameLength", 100_000, 64)),
        ({"scale": 0}, ("PixelScaleOutOfRange", 0, 8)),
        ({"scale": 9}, ("PixelScaleOutOfRange", 9, 8)),
        ({"scene": NOBODY}, ("NothingKept", NOBODY)),
    ],
)
def test_invalid_names_scales_and_addresses_are_refused(
    shop: Shop, change: dict[str, Any], error: tuple[Any, ...]
) -> None:
    with refused(*error):
        shop.add(**change)


def test_what_cannot_be_drawn_is_refused(shop: Shop) -> None:
    s = shop.s
    canvas, *others, objects, more = s.studio.call("scene(address)", shop.scene)
    mesh, position, *rest = objects[0]

    def put(function: str, value: Any) -> str:
        _, call = s.studio.encode(function, (value,))
        return "0x" + s.world.run(s.bob, s.studio.address, call, 0, GAS, True, s.studio.abi).output[12:32].hex()

    def kept(canvas: Any = canvas, mesh: Any = mesh, position: Any = position) -> str:
        return put("storeScene", (canvas, *others, [(mesh, position, *rest)], more))

    # the collection of icons asks the studio, which reverts without data where it cannot decode a scene
    undecodable = "0x" if shop.is_icons else "NotAScene"
    cases: list[tuple[str, tuple[Any, ...]]] = [
        # an account, and a contract that the studio does not keep
        (s.alice, ("NothingKept", s.alice)),
        (s.renderer.address, ("NothingKept", s.renderer.address)),
        # parts that may come when it is sold, or never
        (put("storePart", b"\x13" + 20 * b"\x12"), ("NothingKept", NOBODY)),
        (put("storePart", b"\1" + bytes(4)), ("NotAScene",)),
        # the mark of a scene, without one behind it
        (put("storePart", b"\x20"), (undecodable,)),
        (put("storePart", b"\x20" + 64 * b"\xff"), (undecodable,)),
        (put("storePart", s.world.of(shop.scene).code[1:-64]), (undecodable,)),
        (kept(canvas=(2049, 128)), ("CanvasSize", 2049, 128)),
        (kept(position=(2**59, 0, 0)), ("PositionOutOfRange", 0, 2**59, 0, 0)),
        (kept(mesh=b"\x12" + 20 * b"\x12"), ("NothingKept", NOBODY)),
        (kept(mesh=bytes(4)), ("MeshHeader", 0, 0, 4)),
        (kept(mesh=mesh[:-2] + b"\xff\xff"), ("IndexOutOfRange",)),
    ]
    for scene, error in cases:
        with s.world.attempt(), refused(*error):
            shop.add(scene=scene)
    with s.world.attempt():
        shop.add(scene=kept())


@pytest.mark.parametrize(
    ("name", "more"), [("IconsCollection", [("0x" + "11" * 20, LIMIT, NOBODY, 500)]), ("Editions", [])]
)
def test_a_collection_needs_a_studio(name: str, more: list[Any]) -> None:
    s = launched()
    with refused("NoStudio", s.alice):
        s.world.deploy(name, s.alice, *more)
