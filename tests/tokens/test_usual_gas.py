"""What is taken to be the usual gas of each function is about what it takes, so that 10 times as much is a lie."""

from __future__ import annotations

from typing import Any

import pytest

pytest.importorskip("pyrevm", reason="the tests of tokens need it")

from tools.tokens.merkle import proof_of, root_of
from tools.tokens.stage import ALLOW_LIST, ICONS, PRICE, PUBLIC, icon_scene, stage, store_scene
from tools.tokens.world import Contract, account

from shackled.chain import Connection
from shackled.deploy import local_chain
from shackled.ethereum import checksum_address, intrinsic_gas
from shackled.studio import STUDIO
from shackled.studio import store_scene as keep
from shackled.tokens import Contract as Contract_
from shackled.tokens import add_call
from shackled.tokens._contract import USUAL_GAS


def test_the_usual_gas_of_each_function() -> None:
    s = stage()
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
        if function != "add":
            assert usual / 2 < used < 2 * usual, function
            continue
        # it looks at the scene as well
        studio = local_chain().address(STUDIO)
        storings = keep(icon_scene("icons/lightning"), studio)
        icon = (arguments[0], checksum_address(storings[-1].pointer), *arguments[2:])
        codes = {each.pointer: each.code for each in storings}
        collection = Contract_(Connection("http://127.0.0.1:1"), "IconsCollection", checksum_address(studio))
        ours = add_call(collection, icon, codes).gas
        assert ours / 4 < used < 2 * ours
    # a signature is looked at where it is needed, on a node
    assert USUAL_GAS.keys() - {each[1] for each in calls} == {"mintWithSignature"}
