"""A demonstration of both collections on a development node, with several users, and a gallery of the tokens."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from ..chain import Connection
from ..deploy import Call, Receipt, Transactor, local_chain, signer_class
from ..errors import InputError, VerificationError
from ..ethereum import ETHER, checksum_address, ether
from ..whole_file import make_output_folder, write_output
from ._allow_list import make_allow_list
from ._collection import KINDS, Collection
from ._contract import perform
from ._icons import ICON_PRICE, SCALE, add_call, chosen_pieces, token_scene
from ._launch import CollectionTerms, launch, plan_launch
from ._minting import mint_call, sign_allowance
from ._reveal import hidden_rounds, reveal_calls
from ._storage import SceneToStore, plan_storage, store
from ._verify import check_code, check_token
from ._view import (
    ORIGINAL_MINT_1,
    ORIGINAL_MINT_5,
    ORIGINAL_TOKEN_URI,
    ActionCost,
    TokenView,
    page,
    read_view,
    tokens_json,
)

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

GALLERY, LISTING = "gallery.html", "tokens.json"
_, ALLOW_LIST, PUBLIC = range(3)
INTRODUCTION = (
    "Each picture was computed entirely by contracts on a chain, and read through tokenURI: one call per token, within "
    "the gas limit of the node. Nothing is stored anywhere else."
)
#: The chain id of anvil, and the mnemonic of its accounts, which its documentation publishes.
CHAIN_ID = 31337
PHRASE = "test test test test test test test test test test test junk"
ACCOUNTS = 10
#: Each account of a fresh anvil has 10,000 ether; after some transactions a little less.
FUNDS = 9_000 * ETHER


def run_demo(connection: Connection, folder: Path, report: Callable[[str], None], max_fee: int | None = None) -> Demo:
    """Run both collections and write the files. report: called with each step. max_fee: see `current_fees`.

    Raises InputError if the node is not a fresh anvil, VerificationError if a result is wrong.
    """
    demo = Demo(connection, development_transactors(connection, max_fee), report)
    make_output_folder(folder)
    demo.read(demo.sell_genesis())
    demo.read(demo.sell_icons())
    gas = [token.gas or 0 for token in demo.tokens]
    facts = [
        ("tokens", f"{len(demo.tokens)}"),
        ("chain", f"{connection.chain_id} (a development node)"),
        ("the node's limit on gas", f"{connection.block_gas_limit():,}"),
        ("tokenURI, gas", f"{min(gas) / 1e6:.1f} to {max(gas) / 1e6:.1f} million"),
        ("tokenURI, bytes", f"at most {max(token.metadata.length for token in demo.tokens):,}"),
    ]
    html = page("Shackled: tokens rendered on chain", INTRODUCTION, demo.tokens, facts, demo.costs)
    write_output(folder / GALLERY, html.encode())
    write_output(folder / LISTING, tokens_json(demo.tokens).encode())
    return demo


@dataclass
class Demo:
    """A demonstration, and its result: gas of every action, and all tokens. report: called with each step."""

    connection: Connection
    users: list[Transactor]
    report: Callable[[str], None]
    costs: list[ActionCost] = field(default_factory=list)
    tokens: list[TokenView] = field(default_factory=list)

    def sell_genesis(self) -> Collection:
        """Sell tokens to an allow list, then to everyone, and reveal them with another account."""
        owner, alice, bob, carol, dave, erin, stranger, friend = self.users[:8]
        collection = self._deploy("genesis")
        prepare = collection.contract.prepare
        listed = make_allow_list([(_name(alice), 2), (_name(friend), 5), (_name(erin), 1)])

        self.report("the sale opens for the allow list")
        self._pay("Genesis: set the allow list", owner, prepare("setAllowList", listed.root, _name(owner)))
        self._pay("Genesis: open the sale", owner, prepare("setPhase", ALLOW_LIST))
        call = mint_call(collection, _name(alice), 2, allow_list=listed)
        self._pay("Genesis: mint 2 by an allow list", alice, call)
        permission = sign_allowance(collection, development_accounts(1)[0], _name(bob), 1, int(time.time()) + 86400)
        call = mint_call(collection, _name(bob), 1, permission=permission)
        self._pay("Genesis: mint 1 by a permission", bob, call)

        self.report("the sale opens for everyone")
        perform(owner, prepare("setPhase", PUBLIC))
        for user, quantity, original in ((carol, 1, ORIGINAL_MINT_1), (dave, 5, ORIGINAL_MINT_5)):
            self._pay(f"Genesis: mint {quantity}", user, mint_call(collection, _name(user), quantity), original)
        for user, quantity in ((carol, 5), (erin, 4)):
            perform(user, mint_call(collection, _name(user), quantity))
        call = mint_call(collection, _name(owner), 2, reserve_to=_name(friend))
        self._pay("Genesis: mint 2 of the reserve", owner, call)

        rounds = hidden_rounds(collection)
        if collection.metadata(0).traits != {"Revealed": "No"}:
            raise VerificationError("a token shows traits before it is revealed")
        blocks = rounds[-1].block - self.connection.number("eth_blockNumber") + 1
        self.report(f"{blocks} blocks pass, and another account reveals all tokens")
        self.connection.request("anvil_mine", hex(blocks))
        (call,) = reveal_calls(collection, rounds).values()
        self._pay("Genesis: reveal all of a round", stranger, call)
        self._after_sale(collection, dave, friend)
        return collection

    def sell_icons(self) -> Collection:
        """Store every icon of the dataset, and sell a token of each."""
        owner, *buyers = self.users[:8]
        collection = self._deploy("icons")
        prepare, chosen = collection.contract.prepare, chosen_pieces(None)
        self.report(f"{len(chosen)} icons are stored on chain")
        storage = plan_storage(self.connection, [SceneToStore(piece.name, token_scene(piece)) for piece in chosen])
        stored = [receipt.gas for receipt in store(storage, owner)]
        if stored:
            self.costs.append(ActionCost(f"Icons: store an icon, mean of {len(chosen)}", sum(stored) // len(chosen)))
        icons = [
            (piece.title, pointer, SCALE, ICON_PRICE, 100, 1)
            for piece, pointer in zip(chosen, storage.pointers, strict=True)
        ]
        added = [perform(owner, add_call(collection.contract, icon, storage.codes)).gas for icon in icons]
        self.costs.append(ActionCost("Icons: add an icon, mean", sum(added) // len(added)))
        self._pay("Icons: seal the set", owner, prepare("seal"))
        perform(owner, prepare("setPhase", PUBLIC))

        self.report("the icons are sold")
        call = mint_call(collection, _name(owner), 1, reserve_to=_name(owner), icon=0)
        self._pay("Icons: mint 1 of the reserve", owner, call)
        for number in range(1, len(icons)):
            buyer = buyers[number % len(buyers)]
            receipt = perform(buyer, mint_call(collection, _name(buyer), 1, icon=number))
            if number == len(buyers):  # a first token for this buyer, not the first one sold
                self.costs.append(ActionCost("Icons: mint 1", receipt.gas))
        self._after_sale(collection, buyers[0], buyers[1])
        return collection

    def _deploy(self, name: str) -> Collection:
        """Deploy a collection and what it needs, and record the gas of each contract."""
        kind, owner = KINDS[name], self.users[0]
        self.report(f"{kind.title} is deployed")
        # a new address, so that the demonstration can be repeated on the same node
        salt = self.connection.number("eth_blockNumber")
        plan = plan_launch(self.connection, kind, CollectionTerms(_name(owner), _name(owner), salt=salt))

        def record(name: str, address: bytes, receipt: Receipt) -> None:
            self.costs.append(ActionCost(f"deploy {name}", receipt.gas))

        return launch(plan, owner, record)[0]

    def _pay(self, name: str, user: Transactor, call: Call, original: int | None = None) -> Receipt:
        """Send a transaction, and record its gas."""
        receipt = perform(user, call)
        self.costs.append(ActionCost(name, receipt.gas, original))
        return receipt

    def _after_sale(self, collection: Collection, giver: Transactor, receiver: Transactor) -> None:
        """Transfer a token, whose picture must not change, and withdraw the ether."""
        title, owner, prepare = _short(collection), self.users[0], collection.contract.prepare
        token = next(each for each in range(collection.minted()) if collection.owner_of(each) == _name(giver))
        before = collection.token_uri(token)
        self._pay(f"{title}: transfer", giver, prepare("transferFrom", _name(giver), _name(receiver), token))
        if collection.owner_of(token) != _name(receiver) or collection.token_uri(token) != before:
            raise VerificationError(f"token {token} was not transferred correctly")
        sold, balance = collection.balance(), owner.balance()
        receipt = self._pay(f"{title}: withdraw", owner, prepare("withdraw", _name(owner)))
        if not sold or collection.balance() or owner.balance() != balance + sold - receipt.fee:
            raise VerificationError("the ether of the sale did not arrive")

    def read(self, collection: Collection) -> None:
        """Read and verify every token, and record the gas of its `tokenURI`."""
        title, minted, local = _short(collection), collection.minted(), local_chain()
        self.report(f"{minted} tokens are read and compared with those computed here")
        for check in (*check_code(collection), *(check_token(collection, token, local) for token in range(minted))):
            if check.failure or check.unread:
                raise VerificationError(f"{check.what}: {check.failure or check.unread}")
        views = [read_view(collection, token, measured=True) for token in range(minted)]
        self.tokens += views
        gas = [view.gas or 0 for view in views]
        low, high = ORIGINAL_TOKEN_URI if collection.kind.hidden else (None, None)
        self.costs.append(ActionCost(f"{title}: tokenURI, least", min(gas), low))
        self.costs.append(ActionCost(f"{title}: tokenURI, mean of {minted}", sum(gas) // minted))
        self.costs.append(ActionCost(f"{title}: tokenURI, most", max(gas), high))


def _short(collection: Collection) -> str:
    return collection.kind.title.removeprefix("Shackled ")


def _name(user: Transactor) -> str:
    return checksum_address(user.address)


def development_accounts(count: int = ACCOUNTS) -> list[LocalAccount]:
    """Return the first accounts of anvil, 1 to 10, whose keys are public: use them on development nodes only."""
    opener = signer_class()
    opener.enable_unaudited_hdwallet_features()
    return [opener.from_mnemonic(PHRASE, account_path=f"m/44'/60'/0'/0/{number}") for number in range(count)]


def development_transactors(connection: Connection, max_fee: int | None) -> list[Transactor]:
    """Return transactors of the accounts of a fresh anvil. Raises InputError if the node is anything else."""
    version = str(connection.request("web3_clientVersion"))
    if connection.chain_id != CHAIN_ID or not version.lower().startswith("anvil"):
        raise InputError(
            f"the demo needs a fresh anvil with chain id {CHAIN_ID}, since its keys are public; the {connection.name} "
            f"is {version[:60]!r} of chain {connection.chain_id}"
        )
    transactors = [Transactor(connection, account, max_fee=max_fee) for account in development_accounts()]
    for transactor in transactors:
        if transactor.balance() < FUNDS:
            raise InputError(
                f"the demo needs a fresh anvil: {transactor.name} has {ether(transactor.balance())} on the "
                f"{connection.name}, not about 10,000; restart anvil without options that change its accounts"
            )
    return transactors
