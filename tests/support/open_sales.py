"""A Genesis collection on a node, as many tests need it."""

from __future__ import annotations

from shackled.chain import Connection
from shackled.deploy import Transactor
from shackled.ethereum._encoding import checksum_address
from shackled.tokens._collection import KINDS, Collection
from shackled.tokens._contract import perform
from shackled.tokens._demo import development_accounts
from shackled.tokens._launch import CollectionTerms, launch, plan_launch


def open_sale(connection: Connection, mints: int = 1) -> tuple[Transactor, Collection]:
    """Deploy a collection, open its sale, and mint single tokens; also return who owns all of this."""
    owner = Transactor(connection, development_accounts(1)[0])
    terms = CollectionTerms(checksum_address(owner.address), checksum_address(owner.address))
    collection, _ = launch(plan_launch(connection, KINDS["genesis"], terms), owner)
    perform(owner, collection.contract.prepare("setPhase", 2))
    for _ in range(mints):
        perform(owner, collection.contract.prepare("mint", 1, value=collection.contract.call("price")))
    return owner, collection
