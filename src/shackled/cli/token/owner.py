"""Commands of the owner of a collection: the sale, royalties, ownership, icons, and who may mint before the sale"""

from __future__ import annotations

import json
import time
from functools import partial
from pathlib import Path

from ...base.checks import choice, number
from ...base.whole_file import write_output
from ...deploy._contract import local_chain
from ...errors import InputError
from ...ethereum._amounts import ether, parse_ether
from ...ethereum._encoding import checksum_address
from ...studio._storage import STUDIO, stored_codes
from ...tokens._allow_list import read_allow_list
from ...tokens._contract import PHASES, withdrawn
from ...tokens._icons import SCALE, add_call, check_sale, chosen_pieces, icons_of, token_scene
from ...tokens._minting import sign_allowance
from ...tokens._storage import SceneToStore, plan_storage
from ..chain_options import PayerOptions, SignerOptions, address, parse_checksum_address
from ..option import argument, is_from_environment, option
from ..output import print_line
from .options import MAX_NUMBER, POINTER, CollectionOptions, IconsOptions, parse_royalty


def phase(
    which: CollectionOptions,
    payer: PayerOptions,
    to: str = argument(f"{', '.join(PHASES)}.", "PHASE", parse=partial(choice, choices=PHASES)),
) -> None:
    """Set the phase of the sale, which determines who may mint. For the owner."""
    collection = which.open()
    call = collection.contract.prepare("setPhase", list(PHASES).index(to))
    receipt = payer.send(collection, f"set the sale to {to}", call)
    print_line(f"{collection.name} is {PHASES[collection.phase()]}; {receipt.gas:,} gas")


def withdraw(
    which: CollectionOptions, payer: PayerOptions, to: str | None = address("--to", "Receiver; default: the owner.")
) -> None:
    """Withdraw the ether of the sale. For the owner."""
    collection = which.open()
    receiver = to or payer.address
    balance = collection.balance()
    if not balance:
        print_line("there is nothing to withdraw")
        return
    call = collection.contract.prepare("withdraw", receiver)
    receipt = payer.send(collection, f"send {ether(balance)} to {receiver}", call)
    print_line(f"{ether(withdrawn(receipt.logs, collection.address))} sent to {receiver}; {receipt.gas:,} gas")


def royalty(
    which: CollectionOptions,
    payer: PayerOptions,
    parts: int = argument("Share of the price of resales, 0 to 10.", "PERCENT", type=float, parse=parse_royalty),
    receiver: str | None = address("--receiver", "Receiver; default: unchanged."),
) -> None:
    """Set the royalty on resales, and its receiver. For the owner."""
    collection = which.open()
    to = receiver or checksum_address(bytes.fromhex(collection.contract.call("royaltyInfo", 0, 0)[0][2:]))
    call = collection.contract.prepare("setRoyalty", to, parts)
    receipt = payer.send(collection, f"set royalties of {parts / 100:g} % for {to}", call)
    print_line(f"royalties are {parts / 100:g} % for {to}; {receipt.gas:,} gas")


def transfer_ownership(
    which: CollectionOptions,
    payer: PayerOptions,
    to: str = argument("The new owner.", "ADDRESS", parse=parse_checksum_address),
) -> None:
    """Offer a collection to a new owner, who must accept it. For the owner."""
    collection = which.open()
    receipt = payer.send(collection, f"offer it to {to}", collection.contract.prepare("transferOwnership", to))
    print_line(f"{to} can accept it: shackled token accept-ownership; {receipt.gas:,} gas")


def accept_ownership(which: CollectionOptions, payer: PayerOptions) -> None:
    """Accept the ownership of a collection that was offered to you."""
    collection = which.open()
    pending = collection.contract.account("pendingOwner")
    if pending != payer.address:
        known = int(pending, 16) != 0
        offered = f"is offered to {pending}, not to {payer.address}" if known else "is not offered to anyone"
        raise InputError(f"{collection.name} {offered}")
    receipt = payer.send(collection, "accept its ownership", collection.contract.prepare("acceptOwnership"))
    print_line(f"{collection.name} belongs to {collection.contract.account('owner')}; {receipt.gas:,} gas")


def allow_list(
    which: CollectionOptions,
    payer: PayerOptions,
    file: Path = argument("Lines of account,quantity.", "FILE"),
    output: Path | None = option("-o --output", "Write the tree as OpenZeppelin's StandardMerkleTree, .json.", "FILE"),
    signer: str | None = address("--signer", "Account that signs permissions; default: unchanged."),
) -> None:
    """Print the root of an allow list; with --rpc, set it in a collection. For the owner."""
    allowed = read_allow_list(file)
    quantities = allowed.allowances.values()
    print_line(f"root 0x{allowed.root.hex()}, {len(quantities):,} accounts, {sum(quantities):,} tokens")
    if output is not None:
        write_output(output, (json.dumps(allowed.document(), indent=1) + "\n").encode())
    # the environment variable of the node alone does not ask for a transaction
    if which.rpc is None or (is_from_environment("rpc") and not payer.is_given):
        return
    collection = which.open()
    trusted = signer or collection.contract.account("allowListSigner")
    call = collection.contract.prepare("setAllowList", allowed.root, trusted)
    receipt = payer.send(collection, "set the allow list", call)
    print_line(f"{collection.name} has this allow list now; {receipt.gas:,} gas")


def permit(
    which: CollectionOptions,
    signing: SignerOptions,
    who: str = argument("The account that may mint.", "ACCOUNT", parse=parse_checksum_address),
    quantity: int = argument("Number of tokens in all.", "N", min=1, max=MAX_NUMBER, default=1),
    output: Path | None = option("-o --output", "File to write; default: print it.", "FILE"),
    days: float = option("--days", "Days until it expires.", "DAYS", min=0, default=30),
) -> None:
    """Sign a permission to mint for one account; sends no transaction. For the signer of the collection."""
    seconds = 86400 * number(days, "--days", 0, 36_500)
    collection = which.open()
    trusted = collection.contract.account("allowListSigner")
    if not int(trusted, 16):
        raise InputError(
            "the collection accepts no permissions yet: its owner sets a signer with shackled token allow-list FILE "
            "--signer"
        )
    if signing.address != trusted:
        raise InputError(f"permissions of this collection are signed by {trusted}, not by {signing.address}")
    permission = sign_allowance(collection, signing.signer, who, quantity, int(time.time() + seconds))
    text = json.dumps(permission.document(), indent=1)
    if output is None:
        print(text)
        return
    write_output(output, (text + "\n").encode())
    print_line(f"{output}: {who} may mint {quantity}, with: shackled token mint --permission {output}")


def add(
    which: IconsOptions,
    payer: PayerOptions,
    name: str = argument("A dataset piece; with POINTER, the name of the icon.", "NAME"),
    pointer: str | None = POINTER,
    price: int = option("--price", "Price of a token, in ether.", "ETHER", default="0.02", parse=parse_ether),
    supply: int = option("--supply", "Number of tokens.", "N", default=100),
    reserve: int = option("--reserve", "Number of these tokens reserved for the team.", "N", default=1),
) -> None:
    """Add an icon, whose scene is already stored, to a collection that is not sealed. For the owner."""
    check_sale(supply, reserve)
    pieces = [] if pointer is not None else chosen_pieces(name)
    if len(pieces) > 1:
        raise InputError("one icon can be added at a time")
    collection = which.open()
    if pointer is None:
        piece = pieces[0]
        storage = plan_storage(collection.connection, [SceneToStore(piece.name, token_scene(piece))])
        if storage.missing:
            raise InputError(f"{piece.name} is not on the chain yet; run: shackled store {piece.name}")
        name, pointer = piece.title, storage.pointers[0]
    arguments = (name, pointer, SCALE, price, supply, reserve)
    # fails before the confirmation if the scene cannot be drawn
    codes = stored_codes(collection.connection, local_chain().address(STUDIO), bytes.fromhex(pointer[2:]))
    receipt = payer.send(collection, f"add {name}", add_call(collection.contract, arguments, codes))
    print_line(f"{name} is added; {receipt.gas:,} gas")


def seal(which: IconsOptions, payer: PayerOptions) -> None:
    """Seal the set of icons; required before the sale. Cannot be undone. For the owner."""
    collection = which.open()
    icons = icons_of(collection)
    title = f"seal the collection with {len(icons)} icons"
    receipt = payer.send(collection, title, collection.contract.prepare("seal"))
    print_line(f"{collection.name} is sealed with {len(icons)} icons; {receipt.gas:,} gas")
