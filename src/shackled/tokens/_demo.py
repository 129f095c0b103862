"""Both collections played through on a development node, as several users would, and read back by anyone."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..chain import Connection
from ..deploy import Receipt, Transactor, local_chain
from ..errors import VerificationError
from ..ethereum import checksum_address
from ..whole_file import make_output_folder, write_output
from ._actions import perform
from ._allow_list import make_allow_list
from ._allowance import sign_allowance
from ._collection import Collection
from ._deploying import Offer, launch, plan_launch
from ._development import development_accounts, development_transactors
from ._gallery import Shown, page, tokens_json
from ._icons import SCALE, add_call, chosen_pieces, icons_of
from ._kinds import KINDS
from ._metadata import read_token_uri
from ._minting import MintCall, mint_call
from ._reveal import hidden_rounds, latest_block, steps
from ._storage import Wanted, plan_storage, store
from ._table import ORIGINAL_MINT_1, ORIGINAL_MINT_5, ORIGINAL_TOKEN_URI, Cost
from ._verify import check_code, check_token

GALLERY, LISTING = "gallery.html", "tokens.json"
CLOSED, ALLOW_LIST, PUBLIC = range(3)
#: In wei.
ICON_PRICE = 2 * 10**16
INTRODUCTION = (
    "Each picture was computed whole by contracts on a chain, and read back through tokenURI: one read call of the "
    "token, within the limit on gas that the node gives every call. Nothing was kept or fetched anywhere else."
)


@dataclass
class Demo:
    """What was played. costs: of every action. tokens: as they were read back."""

    gallery: Path
    listing: Path
    costs: list[Cost] = field(default_factory=list)
    tokens: list[Shown] = field(default_factory=list)


def run(connection: Connection, folder: Path, tell: Callable[[str], None], max_fee: int | None = None) -> Demo:
    """Plays both collections through and writes the files. tell: is told what happens. max_fee: see `current_fees`.

    InputError if the node is not a fresh development node; VerificationError if anything is not as it should be.
    """
    users = development_transactors(connection, max_fee)
    make_output_folder(folder)
    demo = Demo(folder / GALLERY, folder / LISTING)
    for play in (_genesis, _icons):
        collection = play(connection, users, demo, tell)
        _read_back(collection, demo, tell)
    gas = [token.gas for token in demo.tokens if token.gas is not None]
    facts = [
        ("tokens", f"{len(demo.tokens)}"),
        ("chain", f"{connection.chain_id} (a development node)"),
        ("the node's limit on gas", f"{connection.block_gas_limit():,}"),
        ("tokenURI, gas", f"{min(gas) / 1e6:.1f} to {max(gas) / 1e6:.1f} million"),
        ("tokenURI, bytes", f"at most {max(token.metadata.length for token in demo.tokens):,}"),
    ]
    html = page("Shackled: tokens that live on chain", INTRODUCTION, demo.tokens, facts, demo.costs)
    write_output(demo.gallery, html.encode())
    write_output(demo.listing, tokens_json(demo.tokens).encode())
    return demo


def _genesis(
    connection: Connection, users: Sequence[Transactor], demo: Demo, tell: Callable[[str], None]
) -> Collection:
    """Sold first to an allow-list, then to all; revealed by a passer-by."""
    owner, alice, bob, carol, dave, erin, passer_by, friend = users[:8]
    collection = _deploy(connection, owner, "genesis", demo, tell)
    contract = collection.contract
    listed = make_allow_list([(_name(alice), 2), (_name(friend), 5), (_name(erin), 1)])

    tell("the allow-list opens")
    _pay(demo, "Genesis: set the allow-list", perform(owner, contract, "setAllowList", listed.root, _name(owner)))
    _pay(demo, "Genesis: open the sale", perform(owner, contract, "setPhase", ALLOW_LIST))
    receipt = _mint(alice, collection, mint_call(collection, _name(alice), 2, allow_list=listed))
    _pay(demo, "Genesis: mint 2 by an allow-list", receipt)
    permission = sign_allowance(collection, development_accounts(1)[0], _name(bob), 1, int(time.time()) + 86400)
    receipt = _mint(bob, collection, mint_call(collection, _name(bob), 1, permission=permission))
    _pay(demo, "Genesis: mint 1 by a signature", receipt)

    tell("the sale is open to all")
    perform(owner, contract, "setPhase", PUBLIC)
    for user, quantity, original in ((carol, 1, ORIGINAL_MINT_1), (dave, 5, ORIGINAL_MINT_5)):
        receipt = _mint(user, collection, mint_call(collection, _name(user), quantity))
        _pay(demo, f"Genesis: mint {quantity}", receipt, original)
    for user, quantity in ((carol, 5), (erin, 4)):
        _mint(user, collection, mint_call(collection, _name(user), quantity))
    receipt = _mint(owner, collection, mint_call(collection, _name(owner), 2, reserve_to=_name(friend)))
    _pay(demo, "Genesis: mint 2 of the reserve", receipt)

    rounds = hidden_rounds(collection)
    if collection.metadata(0).traits != {"Revealed": "No"}:
        raise VerificationError("a token shows traits before it is revealed")
    blocks = rounds[-1].block - latest_block(collection) + 1
    tell(f"{blocks} blocks pass, and a passer-by reveals all tokens")
    connection.request("anvil_mine", hex(blocks))
    (step,) = steps(collection, rounds)
    _pay(
        demo,
        "Genesis: reveal all of a round",
        perform(passer_by, contract, step.function, *step.arguments, ours=step.gas),
    )
    _after_sale(collection, owner, dave, friend, demo, tell)
    return collection


def _icons(connection: Connection, users: Sequence[Transactor], demo: Demo, tell: Callable[[str], None]) -> Collection:
    """Every icon of the dataset, kept on chain, and a few tokens of each."""
    owner, *buyers = users[:8]
    collection = _deploy(connection, owner, "icons", demo, tell)
    contract = collection.contract
    chosen = chosen_pieces(None)
    tell(f"{len(chosen)} icons are stored on chain")
    storage = plan_storage(connection, [Wanted(piece.name, piece.make()) for piece in chosen])
    stored = [receipt.gas for receipt in store(storage, owner)]
    if stored:
        demo.costs.append(Cost(f"Icons: store an icon, mean of {len(chosen)}", sum(stored) // len(chosen)))
    added = []
    for piece, pointer in zip(chosen, storage.pointers, strict=True):
        terms = (piece.title, pointer, SCALE, ICON_PRICE, 100, 1)
        ours = add_call(contract.interface, contract.address, terms, storage.codes).ours
        added.append(perform(owner, contract, "add", *terms, ours=ours).gas)
    demo.costs.append(Cost("Icons: add an icon, mean", sum(added) // len(added)))
    _pay(demo, "Icons: seal the set", perform(owner, contract, "seal"))
    perform(owner, contract, "setPhase", PUBLIC)

    tell("the icons are sold")
    first, *others = icons_of(collection)
    call = mint_call(collection, _name(owner), 1, reserve_to=_name(owner), icon=first.number)
    _pay(demo, "Icons: mint 1 of the reserve", _mint(owner, collection, call))
    for icon in others:
        buyer = buyers[icon.number % len(buyers)]
        receipt = _mint(buyer, collection, mint_call(collection, _name(buyer), 1, icon=icon.number))
        if icon.number == len(buyers):  # that of somebody new, when others have some
            _pay(demo, "Icons: mint 1", receipt)
    _after_sale(collection, owner, buyers[0], buyers[1], demo, tell)
    return collection


def _deploy(
    connection: Connection, owner: Transactor, name: str, demo: Demo, tell: Callable[[str], None]
) -> Collection:
    """Deploy a collection and what it needs, and note the cost of each contract."""
    kind = KINDS[name]
    tell(f"{kind.title} is deployed")
    # so that it can be played again on the same node
    salt = connection.number("eth_blockNumber")
    plan = plan_launch(connection, kind, Offer(_name(owner), _name(owner), salt=salt))
    collection, _ = launch(
        plan,
        owner,
        lambda step, receipts: demo.costs.append(Cost(f"deploy {step.name}", sum(each.gas for each in receipts))),
    )
    return collection


def _after_sale(
    collection: Collection,
    owner: Transactor,
    giver: Transactor,
    receiver: Transactor,
    demo: Demo,
    tell: Callable[[str], None],
) -> None:
    """Transfer a token, which keeps its picture, and withdraw the ether."""
    title = collection.kind.title.removeprefix("Shackled ")
    tell("a token is given away, and the ether of the sale withdrawn")
    token = next(each.number for each in collection.tokens() if each.owner == _name(giver))
    before = collection.token_uri(token)
    arguments = (_name(giver), _name(receiver), token)
    _pay(demo, f"{title}: transfer", perform(giver, collection.contract, "transferFrom", *arguments))
    if collection.owner_of(token) != _name(receiver) or collection.token_uri(token) != before:
        raise VerificationError(f"token {token} did not change hands as it should")
    sold, balance = collection.terms().balance, owner.balance()
    receipt = perform(owner, collection.contract, "withdraw", _name(owner))
    _pay(demo, f"{title}: withdraw", receipt)
    if not sold or collection.terms().balance or owner.balance() != balance + sold - receipt.fee:
        raise VerificationError("the ether of the sale did not arrive")


def _read_back(collection: Collection, demo: Demo, tell: Callable[[str], None]) -> None:
    """Every token as its `tokenURI` shows it, compared with what is computed here; and what reading costs."""
    title = collection.kind.title.removeprefix("Shackled ")
    minted = collection.minted()
    tell(f"{minted} tokens are read back, and computed here again")
    local = local_chain()
    for check in check_code(collection):
        _require(check.failure, check.what)
    gas = []
    for token in collection.tokens():
        uri = collection.token_uri(token.number)
        check = check_token(collection, token.number, local, uri)
        _require(check.failure or check.unread, f"token {token.number}")
        used = collection.contract.gas("tokenURI", token.number)
        metadata = read_token_uri(uri)
        demo.tokens.append(
            Shown(collection.name, collection.address, token.number, token.owner, token.revealed, metadata, used)
        )
        gas.append(used or 0)
    original = ORIGINAL_TOKEN_URI if collection.kind.hidden else None
    demo.costs.append(Cost(f"{title}: tokenURI, least", min(gas), original and (original[0],) * 2))
    demo.costs.append(Cost(f"{title}: tokenURI, mean of {minted}", sum(gas) // minted))
    demo.costs.append(Cost(f"{title}: tokenURI, most", max(gas), original and (original[1],) * 2))


def _mint(user: Transactor, collection: Collection, call: MintCall) -> Receipt:
    return perform(user, collection.contract, call.function, *call.arguments, value=call.value)


def _pay(demo: Demo, name: str, receipt: Receipt, original: tuple[int, int] | None = None) -> None:
    demo.costs.append(Cost(name, receipt.gas, original))


def _name(user: Transactor) -> str:
    return checksum_address(user.address)


def _require(failure: str, what: str) -> Any:
    if failure:
        raise VerificationError(f"{what}: {failure}")
