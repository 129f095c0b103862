"""A demonstration of both collections on a development node, with several users, and a gallery of the tokens."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..base.whole_file import make_output_folder, write_output
from ..chain._connection import Connection
from ..deploy._account import signer_class
from ..deploy._contract import local_chain
from ..deploy._quote import Call
from ..deploy._transactor import Receipt, Transactor
from ..errors import InputError, VerificationError
from ..ethereum._encoding import checksum_address
from ._allow_list import make_allow_list
from ._collection import KINDS, Collection
from ._contract import perform
from ._icons import ICON_PRICE, SCALE, add_call, chosen_pieces, token_scene
from ._launch import CollectionTerms, launch, plan_launch
from ._minting import mint_call, sign_allowance
from ._reveal import hidden_rounds, reveal_calls
from ._storage import SceneToStore, plan_storage, store
from ._verify import check_code, check_token
from ._view import TokenView, page, read_view, tokens_json

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

GALLERY, LISTING = "gallery.html", "tokens.json"
_, ALLOW_LIST, PUBLIC = range(3)
#: The chain id of anvil, and the mnemonic of its accounts, which its documentation publishes.
CHAIN_ID = 31337
PHRASE = "test test test test test test test test test test test junk"
ACCOUNTS = 10


def run_demo(
    connection: Connection, folder: Path, report: Callable[[str], None], max_fee: int | None = None
) -> list[TokenView]:
    """Run both collections, write the files, and return all tokens.

    report: called with each step and its gas. max_fee: see `current_fees`. Raises InputError if the node is not an
    anvil, VerificationError if a result is wrong.
    """
    demo = Demo(connection, development_transactors(connection, max_fee), report)
    make_output_folder(folder)
    tokens = [*demo.read(demo.sell_genesis()), *demo.read(demo.sell_icons())]
    write_output(folder / GALLERY, page(tokens).encode())
    write_output(folder / LISTING, tokens_json(tokens).encode())
    return tokens


@dataclass(frozen=True)
class Demo:
    """A demonstration. report: called with each step."""

    connection: Connection
    users: list[Transactor]
    report: Callable[[str], None]

    def sell_genesis(self) -> Collection:
        """Sell tokens to an allow list, then to everyone, and reveal them with another account."""
        owner, alice, bob, carol, dave, erin, stranger, friend = self.users[:8]
        collection = self._deploy("genesis")
        prepare = collection.contract.prepare
        listed = make_allow_list([(_name(alice), 2), (_name(friend), 5), (_name(erin), 1)])

        self.report("the sale opens for the allow list")
        self._pay("set the allow list", owner, prepare("setAllowList", listed.root, _name(owner)))
        self._pay("open the sale", owner, prepare("setPhase", ALLOW_LIST))
        self._pay("mint 2 by the allow list", alice, mint_call(collection, _name(alice), 2, allow_list=listed))
        permission = sign_allowance(collection, development_accounts(1)[0], _name(bob), 1, int(time.time()) + 86400)
        self._pay("mint 1 by a permission", bob, mint_call(collection, _name(bob), 1, permission=permission))

        self.report("the sale opens for everyone")
        perform(owner, prepare("setPhase", PUBLIC))
        for user, quantity in ((carol, 1), (dave, 5), (carol, 5), (erin, 4)):
            self._pay(f"mint {quantity}", user, mint_call(collection, _name(user), quantity))
        self._pay("mint 2 of the reserve", owner, mint_call(collection, _name(owner), 2, reserve_to=_name(friend)))

        rounds = hidden_rounds(collection)
        if collection.metadata(0).traits != {"Revealed": "No"}:
            raise VerificationError("a token shows traits before it is revealed")
        blocks = rounds[-1].block - self.connection.number("eth_blockNumber") + 1
        self.report(f"{blocks} blocks pass, and another account reveals all tokens")
        self.connection.request("anvil_mine", hex(blocks))
        (call,) = reveal_calls(collection, rounds).values()
        self._pay("reveal a round", stranger, call)
        self._after_sale(collection, dave, friend)
        return collection

    def sell_icons(self) -> Collection:
        """Store every icon of the dataset, and sell a token of each."""
        owner, *buyers = self.users[:8]
        collection = self._deploy("icons")
        prepare, chosen = collection.contract.prepare, chosen_pieces(None)
        self.report(f"{len(chosen)} icons are stored on chain")
        storage = plan_storage(self.connection, [SceneToStore(piece.name, token_scene(piece)) for piece in chosen])
        store(storage, owner, self._paid)
        for piece, pointer in zip(chosen, storage.pointers, strict=True):
            icon = (piece.title, pointer, SCALE, ICON_PRICE, 100, 1)
            self._pay(f"add {piece.title}", owner, add_call(collection.contract, icon, storage.codes))
        self._pay("seal the set", owner, prepare("seal"))
        perform(owner, prepare("setPhase", PUBLIC))

        self.report("the icons are sold")
        call = mint_call(collection, _name(owner), 1, reserve_to=_name(owner), icon=0)
        self._pay("mint 1 of the reserve", owner, call)
        for number in range(1, len(chosen)):
            buyer = buyers[number % len(buyers)]
            self._pay("mint 1", buyer, mint_call(collection, _name(buyer), 1, icon=number))
        self._after_sale(collection, buyers[0], buyers[1])
        return collection

    def _deploy(self, name: str) -> Collection:
        kind, owner = KINDS[name], self.users[0]
        self.report(f"{kind.title} is deployed")
        # a new address, so that the demonstration can be repeated on the same node
        salt = self.connection.number("eth_blockNumber")
        plan = plan_launch(self.connection, kind, CollectionTerms(_name(owner), _name(owner), salt=salt))
        return launch(plan, owner, self._paid)[0]

    def _pay(self, name: str, user: Transactor, call: Call) -> Receipt:
        receipt = perform(user, call)
        self._paid(name, user.address, receipt)
        return receipt

    def _paid(self, name: str, _: bytes, receipt: Receipt) -> None:
        self.report(f"  {name}: {receipt.gas:,} gas")

    def _after_sale(self, collection: Collection, giver: Transactor, receiver: Transactor) -> None:
        """Transfer a token, whose picture must not change, and withdraw the ether."""
        owner, prepare = self.users[0], collection.contract.prepare
        token = next(each for each in range(collection.minted()) if collection.owner_of(each) == _name(giver))
        before = collection.token_uri(token)
        self._pay("transfer", giver, prepare("transferFrom", _name(giver), _name(receiver), token))
        if collection.owner_of(token) != _name(receiver) or collection.token_uri(token) != before:
            raise VerificationError(f"token {token} was not transferred correctly")
        sold, balance = collection.balance(), owner.balance()
        receipt = self._pay("withdraw", owner, prepare("withdraw", _name(owner)))
        if not sold or collection.balance() or owner.balance() != balance + sold - receipt.fee:
            raise VerificationError("the ether of the sale did not arrive")

    def read(self, collection: Collection) -> list[TokenView]:
        """Read and verify every token, with the gas of its `tokenURI`."""
        minted, local = collection.minted(), local_chain()
        self.report(f"{minted} tokens are read and compared with those computed here")
        for check in (*check_code(collection), *(check_token(collection, token, local) for token in range(minted))):
            if check.failure or check.unread:
                raise VerificationError(f"{check.what}: {check.failure or check.unread}")
        return [read_view(collection, token, measured=True) for token in range(minted)]


def _name(user: Transactor) -> str:
    return checksum_address(user.address)


def development_accounts(count: int = ACCOUNTS) -> list[LocalAccount]:
    """Return the first accounts of anvil, 1 to 10, whose keys are public: use them on development nodes only."""
    opener = signer_class()
    opener.enable_unaudited_hdwallet_features()
    return [opener.from_mnemonic(PHRASE, account_path=f"m/44'/60'/0'/0/{number}") for number in range(count)]


def development_transactors(connection: Connection, max_fee: int | None) -> list[Transactor]:
    """Return transactors of the accounts of an anvil. Raises InputError if the node is anything else."""
    version = str(connection.request("web3_clientVersion"))
    if connection.chain_id != CHAIN_ID or not version.lower().startswith("anvil"):
        raise InputError(
            f"the demo needs a fresh anvil with chain id {CHAIN_ID}, since its keys are public; the {connection.name} "
            f"is {version[:60]!r} of chain {connection.chain_id}"
        )
    return [Transactor(connection, account, max_fee=max_fee) for account in development_accounts()]
