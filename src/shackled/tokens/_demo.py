"""A demonstration of both collections on a development node, with several users, and a gallery of the tokens."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from ..chain import Connection
from ..deploy import Receipt, Transactor, local_chain, signer_class
from ..errors import InputError, VerificationError
from ..ethereum import ETHER, checksum_address, ether
from ..whole_file import make_output_folder, write_output
from ._allow_list import make_allow_list
from ._collection import KINDS, Collection
from ._contract import ContractCall, perform
from ._icons import ICON_PRICE, SCALE, add_call, chosen_pieces, icons_of, token_scene
from ._launch import CollectionTerms, launch, plan_launch
from ._metadata import read_token_uri
from ._minting import mint_call, sign_allowance
from ._reveal import hidden_rounds, latest_block, reveal_calls
from ._storage import SceneToStore, plan_storage, store
from ._verify import check_code, check_token
from ._view import (
    ORIGINAL_MINT_1,
    ORIGINAL_MINT_5,
    ORIGINAL_TOKEN_URI,
    ActionCost,
    TokenView,
    page,
    tokens_json,
    view_of,
)

if TYPE_CHECKING:
    from eth_account.signers.local import LocalAccount

GALLERY, LISTING = "gallery.html", "tokens.json"
CLOSED, ALLOW_LIST, PUBLIC = range(3)
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


@dataclass
class Demo:
    """The result of a demonstration: files, gas of every action, and all tokens."""

    gallery: Path
    listing: Path
    costs: list[ActionCost] = field(default_factory=list)
    tokens: list[TokenView] = field(default_factory=list)


def run_demo(connection: Connection, folder: Path, report: Callable[[str], None], max_fee: int | None = None) -> Demo:
    """Run both collections and write the files. report: called with each step. max_fee: see `current_fees`.

    Raises InputError if the node is not a fresh anvil, VerificationError if a result is wrong.
    """
    users = development_transactors(connection, max_fee)
    make_output_folder(folder)
    demo = Demo(folder / GALLERY, folder / LISTING)
    for run in (_genesis, _icons):
        collection = run(connection, users, demo, report)
        _read_back(collection, demo, report)
    gas = [token.gas for token in demo.tokens if token.gas is not None]
    facts = [
        ("tokens", f"{len(demo.tokens)}"),
        ("chain", f"{connection.chain_id} (a development node)"),
        ("the node's limit on gas", f"{connection.block_gas_limit():,}"),
        ("tokenURI, gas", f"{min(gas) / 1e6:.1f} to {max(gas) / 1e6:.1f} million"),
        ("tokenURI, bytes", f"at most {max(token.metadata.length for token in demo.tokens):,}"),
    ]
    html = page("Shackled: tokens rendered on chain", INTRODUCTION, demo.tokens, facts, demo.costs)
    write_output(demo.gallery, html.encode())
    write_output(demo.listing, tokens_json(demo.tokens).encode())
    return demo


def _genesis(
    connection: Connection, users: Sequence[Transactor], demo: Demo, report: Callable[[str], None]
) -> Collection:
    """Sell tokens to an allow list, then to everyone, and reveal them with another account."""
    owner, alice, bob, carol, dave, erin, stranger, friend = users[:8]
    collection = _deploy(connection, owner, "genesis", demo, report)
    contract = collection.contract
    listed = make_allow_list([(_name(alice), 2), (_name(friend), 5), (_name(erin), 1)])

    report("the sale opens for the allow list")
    _pay(demo, "Genesis: set the allow list", perform(owner, contract, "setAllowList", listed.root, _name(owner)))
    _pay(demo, "Genesis: open the sale", perform(owner, contract, "setPhase", ALLOW_LIST))
    receipt = _send(alice, collection, mint_call(collection, _name(alice), 2, allow_list=listed))
    _pay(demo, "Genesis: mint 2 by an allow list", receipt)
    permission = sign_allowance(collection, development_accounts(1)[0], _name(bob), 1, int(time.time()) + 86400)
    receipt = _send(bob, collection, mint_call(collection, _name(bob), 1, permission=permission))
    _pay(demo, "Genesis: mint 1 by a permission", receipt)

    report("the sale opens for everyone")
    perform(owner, contract, "setPhase", PUBLIC)
    for user, quantity, original in ((carol, 1, ORIGINAL_MINT_1), (dave, 5, ORIGINAL_MINT_5)):
        receipt = _send(user, collection, mint_call(collection, _name(user), quantity))
        _pay(demo, f"Genesis: mint {quantity}", receipt, original)
    for user, quantity in ((carol, 5), (erin, 4)):
        _send(user, collection, mint_call(collection, _name(user), quantity))
    receipt = _send(owner, collection, mint_call(collection, _name(owner), 2, reserve_to=_name(friend)))
    _pay(demo, "Genesis: mint 2 of the reserve", receipt)

    rounds = hidden_rounds(collection)
    if collection.metadata(0).traits != {"Revealed": "No"}:
        raise VerificationError("a token shows traits before it is revealed")
    blocks = rounds[-1].block - latest_block(collection) + 1
    report(f"{blocks} blocks pass, and another account reveals all tokens")
    connection.request("anvil_mine", hex(blocks))
    (call,) = reveal_calls(collection, rounds)
    _pay(demo, "Genesis: reveal all of a round", _send(stranger, collection, call))
    _after_sale(collection, owner, dave, friend, demo, report)
    return collection


def _icons(
    connection: Connection, users: Sequence[Transactor], demo: Demo, report: Callable[[str], None]
) -> Collection:
    """Store every icon of the dataset, and sell a token of each."""
    owner, *buyers = users[:8]
    collection = _deploy(connection, owner, "icons", demo, report)
    contract = collection.contract
    chosen = chosen_pieces(None)
    report(f"{len(chosen)} icons are stored on chain")
    storage = plan_storage(connection, [SceneToStore(piece.name, token_scene(piece)) for piece in chosen])
    stored = [receipt.gas for receipt in store(storage, owner)]
    if stored:
        demo.costs.append(ActionCost(f"Icons: store an icon, mean of {len(chosen)}", sum(stored) // len(chosen)))
    added = []
    for piece, pointer in zip(chosen, storage.pointers, strict=True):
        terms = (piece.title, pointer, SCALE, ICON_PRICE, 100, 1)
        gas = add_call(contract.interface, contract.address, terms, storage.codes).gas
        added.append(perform(owner, contract, "add", *terms, gas=gas).gas)
    demo.costs.append(ActionCost("Icons: add an icon, mean", sum(added) // len(added)))
    _pay(demo, "Icons: seal the set", perform(owner, contract, "seal"))
    perform(owner, contract, "setPhase", PUBLIC)

    report("the icons are sold")
    first, *others = icons_of(collection)
    call = mint_call(collection, _name(owner), 1, reserve_to=_name(owner), icon=first.number)
    _pay(demo, "Icons: mint 1 of the reserve", _send(owner, collection, call))
    for icon in others:
        buyer = buyers[icon.number % len(buyers)]
        receipt = _send(buyer, collection, mint_call(collection, _name(buyer), 1, icon=icon.number))
        if icon.number == len(buyers):  # a first token for this buyer, not the first one sold
            _pay(demo, "Icons: mint 1", receipt)
    _after_sale(collection, owner, buyers[0], buyers[1], demo, report)
    return collection


def _deploy(
    connection: Connection, owner: Transactor, name: str, demo: Demo, report: Callable[[str], None]
) -> Collection:
    """Deploy a collection and what it needs, and record the gas of each contract."""
    kind = KINDS[name]
    report(f"{kind.title} is deployed")
    # a new address, so that the demonstration can be repeated on the same node
    salt = connection.number("eth_blockNumber")
    plan = plan_launch(connection, kind, CollectionTerms(_name(owner), _name(owner), salt=salt))
    collection, _ = launch(
        plan,
        owner,
        lambda step, receipts: demo.costs.append(ActionCost(f"deploy {step.name}", sum(each.gas for each in receipts))),
    )
    return collection


def _after_sale(
    collection: Collection,
    owner: Transactor,
    giver: Transactor,
    receiver: Transactor,
    demo: Demo,
    report: Callable[[str], None],
) -> None:
    """Transfer a token, whose picture must not change, and withdraw the ether."""
    title = collection.kind.title.removeprefix("Shackled ")
    report("a token is transferred, and the ether of the sale is withdrawn")
    token = next(each.number for each in collection.tokens() if each.owner == _name(giver))
    before = collection.token_uri(token)
    arguments = (_name(giver), _name(receiver), token)
    _pay(demo, f"{title}: transfer", perform(giver, collection.contract, "transferFrom", *arguments))
    if collection.owner_of(token) != _name(receiver) or collection.token_uri(token) != before:
        raise VerificationError(f"token {token} was not transferred correctly")
    sold, balance = collection.state().balance, owner.balance()
    receipt = perform(owner, collection.contract, "withdraw", _name(owner))
    _pay(demo, f"{title}: withdraw", receipt)
    if not sold or collection.state().balance or owner.balance() != balance + sold - receipt.fee:
        raise VerificationError("the ether of the sale did not arrive")


def _read_back(collection: Collection, demo: Demo, report: Callable[[str], None]) -> None:
    """Read and verify every token, and record the gas of its `tokenURI`."""
    title = collection.kind.title.removeprefix("Shackled ")
    minted = collection.minted()
    report(f"{minted} tokens are read and compared with those computed here")
    local = local_chain()
    for check in check_code(collection):
        _require(check.failure, check.what)
    gas = []
    for token in collection.tokens():
        uri = collection.token_uri(token.number)
        check = check_token(collection, token.number, local, uri)
        _require(check.failure or check.unread, f"token {token.number}")
        used = collection.contract.gas("tokenURI", token.number)
        demo.tokens.append(view_of(collection, token, read_token_uri(uri), used))
        gas.append(used or 0)
    original = ORIGINAL_TOKEN_URI if collection.kind.hidden else None
    demo.costs.append(ActionCost(f"{title}: tokenURI, least", min(gas), original and (original[0],) * 2))
    demo.costs.append(ActionCost(f"{title}: tokenURI, mean of {minted}", sum(gas) // minted))
    demo.costs.append(ActionCost(f"{title}: tokenURI, most", max(gas), original and (original[1],) * 2))


def _send(user: Transactor, collection: Collection, call: ContractCall) -> Receipt:
    return perform(user, collection.contract, call.function, *call.arguments, value=call.value, gas=call.gas)


def _pay(demo: Demo, name: str, receipt: Receipt, original: tuple[int, int] | None = None) -> None:
    demo.costs.append(ActionCost(name, receipt.gas, original))


def _name(user: Transactor) -> str:
    return checksum_address(user.address)


def _require(failure: str, what: str) -> None:
    if failure:
        raise VerificationError(f"{what}: {failure}")


def development_accounts(count: int = ACCOUNTS) -> list[LocalAccount]:
    """Return the first accounts of anvil, 1 to 10, whose keys are public: use them on development nodes only."""
    opener = signer_class()
    opener.enable_unaudited_hdwallet_features()
    return [opener.from_mnemonic(PHRASE, account_path=f"m/44'/60'/0'/0/{number}") for number in range(count)]


def development_transactors(connection: Connection, max_fee: int | None) -> list[Transactor]:
    """Return transactors of the accounts of a fresh anvil. Raises InputError if the node is anything else."""
    if connection.chain_id != CHAIN_ID:
        raise InputError(
            f"the demo needs a fresh anvil, with chain id {CHAIN_ID}; the {connection.name} belongs to chain "
            f"{connection.chain_id}, where public keys must not be used"
        )
    version = str(connection.request("web3_clientVersion"))
    if not version.lower().startswith("anvil"):
        raise InputError(f"the demo needs a fresh anvil, and the {connection.name} is {version[:60]!r}")
    transactors = [Transactor(connection, account, max_fee=max_fee) for account in development_accounts()]
    for transactor in transactors:
        if transactor.balance() < FUNDS:
            raise InputError(
                f"the demo needs a fresh anvil: {transactor.name} has {ether(transactor.balance())} on the "
                f"{connection.name}, not about 10,000; restart anvil without options that change its accounts"
            )
    return transactors
