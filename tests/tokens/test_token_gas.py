"""No figure of benchmarks/tokens.json and icons.json may rise unnoticed; the usual gas of functions is about theirs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from attrs import evolve
from benchmarks import icons, tokens
from benchmarks.snapshot import changes
from tools.tokens.launched import ALLOW_LIST, ICONS, PRICE, PUBLIC, icon_scene, launched, store_scene
from tools.tokens.merkle import proof_of, root_of
from tools.tokens.world import Contract, account

from shackled.chain import Connection
from shackled.datasets import pieces
from shackled.datasets._pieces import require
from shackled.deploy._contract import local_chain
from shackled.ethereum._encoding import checksum_address, intrinsic_gas
from shackled.studio import store_scene as keep
from shackled.studio._storage import STUDIO
from shackled.tokens._contract import USUAL_GAS
from shackled.tokens._contract import Contract as Contract_
from shackled.tokens._icons import add_call, token_scene

PAGE = Path(__file__).resolve().parents[2] / "docs" / "tokens.md"
COMMAND = "python -m benchmarks.icons"


def test_the_figures_are_those_that_are_recorded() -> None:
    measured = tokens.take()
    assert measured == tokens.recorded(), "if that has a good reason, run: python -m benchmarks.tokens"
    for name, original in tokens.ORIGINAL.items():
        assert measured[name] < 0.65 * original


def flat(figures: icons.Figures) -> dict[str, int]:
    return {f"{name}: {kind}": int(each[kind]) for name, each in figures.items() for kind in ("plain", "antialiased")}


def test_icons_fit_a_transaction() -> None:
    """Those whose `tokenURI` does so with antialiasing use it."""
    measured = icons.take()
    worse, _ = changes({"icons": flat(icons.recorded())}, {"icons": flat(measured)})
    assert not worse, "\n  ".join([f"figures have risen; if for a good reason, run {COMMAND}:", *worse])
    assert len(measured) == len(list(pieces("icons")))
    assert all(each["plain fits"] for each in measured.values())
    used = [piece.name for piece in pieces("icons") if token_scene(piece).antialias]
    assert sorted(used) == icons.fitting(measured), f"run {COMMAND}"


def test_the_scene_of_a_token_is_that_of_its_piece() -> None:
    for name, antialias in (("icons/lightning", True), ("icons/saucer", False), ("cube", False)):
        assert token_scene(require(name)) == evolve(require(name).make(), antialias=antialias)


def test_the_documentation_has_them() -> None:
    assert tokens.table(tokens.recorded()) in PAGE.read_text("utf-8")
    assert icons.table(icons.recorded()) in icons.PAGE.read_text("utf-8"), f"run {COMMAND}"


def test_models_would_not_fit_beside_all_pictures() -> None:
    """docs/tokens.md gives this as a reason why tokens have no `animation_url`."""
    motion, figures = json.loads(icons.FILE.with_name("motion.json").read_text("utf-8")), icons.recorded()
    models = {name: motion[f"{name}: model: gas"] for name in figures}
    shares = [100 * models[name] / each["plain"] for name, each in figures.items()]
    assert [round(min(shares)), round(max(shares))] == [5, 29]
    antialiased = {name: int(each["antialiased"]) for name, each in figures.items() if each["antialiased fits"]}
    assert any(gas + models[name] > icons.LIMIT for name, gas in antialiased.items())


def test_the_usual_gas_of_each_function() -> None:
    s = launched()
    new = s.world.deploy("IconsCollection", s.studio, (s.owner, 10, s.owner, 500), sender=s.owner)
    pointer = store_scene(s.studio, icon_scene("icons/lightning"))
    listed = {s.alice: 20} | {account(f"listed {number}"): 2 for number in range(99)}
    price = list(ICONS.values())[1][3]
    editions = s.world.deploy("Editions", s.studio)
    editions.send("add", "One", pointer, 4, False, price, 9, 500, 1, sender=s.bob)
    calls: list[tuple[Contract, str, tuple[Any, ...], str, int]] = [
        (s.genesis, "mint", (1,), s.alice, PRICE),
        (s.genesis, "mint", (1,), s.alice, PRICE),
        (s.genesis, "mint", (10,), s.bob, 10 * PRICE),
        (s.icons, "mint", (1, 3), s.bob, 3 * price),
        (s.genesis, "mintReserve", (s.bob, 2), s.owner, 0),
        (s.genesis, "setPhase", (ALLOW_LIST,), s.owner, 0),
        (s.genesis, "setAllowList", (root_of(listed), s.owner), s.owner, 0),
        (s.genesis, "mintWithProof", (1, 20, proof_of(listed, s.alice)), s.alice, PRICE),
        (s.genesis, "setRoyalty", (s.bob, 100), s.owner, 0),
        (s.genesis, "transferFrom", (s.bob, s.alice, 3), s.bob, 0),
        (s.genesis, "safeTransferFrom", (s.bob, s.alice, 4), s.bob, 0),
        (s.genesis, "withdraw", (account("treasury"),), s.owner, 0),
        (s.genesis, "transferOwnership", (s.bob,), s.owner, 0),
        (s.genesis, "acceptOwnership", (), s.bob, 0),
        (editions, "mint", (0, 2), s.alice, 2 * price),
        (editions, "withdraw", ([0], account("treasury")), s.bob, 0),
        (editions, "close", (0,), s.bob, 0),
        (new, "add", ("Lightning", pointer, 4, price, 100, 1), s.owner, 0),
        (new, "seal", (), s.owner, 0),
        (new, "setPhase", (PUBLIC,), s.owner, 0),
    ]
    for contract, function, arguments, sender, value in calls:
        used = contract.send(function, *arguments, sender=sender, value=value).gas
        usual = USUAL_GAS[function] + intrinsic_gas(contract.encode(function, arguments)[1])
        least = usual / 2
        if function == "add":
            # it looks at the scene as well
            studio = local_chain().address(STUDIO)
            storings = keep(icon_scene("icons/lightning"), studio)
            icon = (arguments[0], checksum_address(storings[-1].pointer), *arguments[2:])
            collection = Contract_(Connection("http://127.0.0.1:1"), "IconsCollection", checksum_address(studio))
            usual = add_call(collection, icon, {each.pointer: each.code for each in storings}).gas
            least = usual / 4
        assert least < used < 2 * usual, function
    # a signature is looked at where it is needed, on a node
    assert USUAL_GAS.keys() - {each[1] for each in calls} == {"mintWithSignature"}
