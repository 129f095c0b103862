"""Commands of the owner of a collection: the sale, royalties, ownership, icons, and who may mint before the sale"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Annotated

from ...checks import choice, number
from ...errors import InputError
from ...ethereum import checksum_address, ether, parse_ether
from ...whole_file import write_output
from ..chain_options import SignerOptions, parse_checksum_address
from ..option import argument, is_from_environment, option
from ..output import print_line
from .options import MAX_NUMBER, PHASES, CollectionOptions, IconsOptions, TokenPayerOptions


def phase(
    to: Annotated[str, argument(", ".join(PHASES) + ".", "PHASE")],
    which: CollectionOptions,
    payer: TokenPayerOptions,
) -> None:
    """Set the phase of the sale, which says who may mint. For the owner."""
    number = PHASES.index(choice(to, "the phase", PHASES))
    collection = which.open()
    receipt = payer.send(collection, f"set the sale to {to}", "setPhase", number)
    print_line(f"{collection.name} is {collection.state().phase_name}; {receipt.gas:,} gas")


def withdraw(
    which: CollectionOptions,
    payer: TokenPayerOptions,
    to: Annotated[str | None, option("--to", "Receiver; default: the owner.", "ADDRESS")] = None,
) -> None:
    """Withdraw the ether of the sale. For the owner."""
    from ...tokens import withdrawn

    collection = which.open()
    receiver = str(payer.signer.address) if to is None else parse_checksum_address(to, "--to")
    balance = collection.state().balance
    if not balance:
        print_line("there is nothing to withdraw")
        return
    receipt = payer.send(collection, f"send {ether(balance)} to {receiver}", "withdraw", receiver)
    print_line(f"{ether(withdrawn(receipt.logs, collection.address))} sent to {receiver}; {receipt.gas:,} gas")


def royalty(
    percent: Annotated[float, argument("Share of the price of resales, 0 to 10.", "PERCENT")],
    which: CollectionOptions,
    payer: TokenPayerOptions,
    receiver: Annotated[str | None, option("--receiver", "Receiver; default: unchanged.", "ADDRESS")] = None,
) -> None:
    """Set the royalty on resales, and its receiver. For the owner."""
    parts = round(100 * number(percent, "the royalty", 0, 10))
    given = None if receiver is None else parse_checksum_address(receiver, "--receiver")
    collection = which.open()
    address = collection.state().royalty_receiver if given is None else given
    title = f"set royalties of {parts / 100:g} % for {address}"
    receipt = payer.send(collection, title, "setRoyalty", address, parts)
    print_line(f"royalties are {parts / 100:g} % for {address}; {receipt.gas:,} gas")


def transfer_ownership(
    to: Annotated[str, argument("The new owner.", "ADDRESS")],
    which: CollectionOptions,
    payer: TokenPayerOptions,
) -> None:
    """Offer a collection to a new owner, who must accept it. For the owner."""
    address = parse_checksum_address(to, "the new owner")
    collection = which.open()
    receipt = payer.send(collection, f"offer it to {address}", "transferOwnership", address)
    print_line(f"{address} can accept it: shackled token accept-ownership; {receipt.gas:,} gas")


def accept_ownership(which: CollectionOptions, payer: TokenPayerOptions) -> None:
    """Accept the ownership of a collection that was offered to you."""
    collection = which.open()
    signer = str(payer.signer.address)
    pending = checksum_address(bytes.fromhex(collection.contract.call("pendingOwner")[2:]))
    if pending != signer:
        offered = "is not offered to anyone" if int(pending, 16) == 0 else f"is offered to {pending}, not to {signer}"
        raise InputError(f"{collection.name} {offered}")
    receipt = payer.send(collection, "accept its ownership", "acceptOwnership")
    print_line(f"{collection.name} belongs to {collection.state().owner}; {receipt.gas:,} gas")


def allow_list(
    file: Annotated[Path, argument("Lines of account,quantity, or an OpenZeppelin tree as JSON.", "FILE")],
    which: CollectionOptions,
    payer: TokenPayerOptions,
    output: Annotated[
        Path | None, option("-o --output", "Write the tree as OpenZeppelin's StandardMerkleTree, .json.", "FILE")
    ] = None,
    signer: Annotated[
        str | None, option("--signer", "Account that signs permissions; default: unchanged.", "ADDRESS")
    ] = None,
) -> None:
    """Print the root of an allow list; with --rpc, set it in a collection. For the owner."""
    from ...tokens import read_allow_list

    allowed = read_allow_list(file)
    quantities = allowed.allowances.values()
    print_line(f"root 0x{allowed.root.hex()}, {len(quantities):,} accounts, {sum(quantities):,} tokens")
    if output is not None:
        write_output(output, (json.dumps(allowed.document(), indent=1) + "\n").encode())
    # the environment variable of the node alone does not ask for a transaction
    if which.rpc is None or (is_from_environment("rpc") and not payer.is_given):
        return
    collection = which.open()
    trusted = collection.state().allow_list_signer if signer is None else parse_checksum_address(signer, "--signer")
    receipt = payer.send(collection, "set the allow list", "setAllowList", allowed.root, trusted)
    print_line(f"{collection.name} has this allow list now; {receipt.gas:,} gas")


def permit(
    who: Annotated[str, argument("The account that may mint.", "ACCOUNT")],
    which: CollectionOptions,
    signing: SignerOptions,
    quantity: Annotated[int, argument("Number of tokens in all.", "N", min=1, max=MAX_NUMBER)] = 1,
    output: Annotated[Path | None, option("-o --output", "File to write; default: print it.", "FILE")] = None,
    days: Annotated[float, option("--days", "Days until it expires.", "DAYS", min=0)] = 30,
) -> None:
    """Sign a permission to mint for one account; sends no transaction. For the signer of the collection."""
    from ...tokens import sign_allowance

    account = parse_checksum_address(who, "the account")
    seconds = 86400 * number(days, "--days", 0, 36_500)
    collection = which.open()
    signer = signing.signer
    trusted = collection.state().allow_list_signer
    if not int(trusted, 16):
        raise InputError(
            "the collection accepts no permissions yet: its owner sets a signer with shackled token allow-list FILE "
            "--signer"
        )
    if str(signer.address) != trusted:
        raise InputError(f"permissions of this collection are signed by {trusted}, not by {signer.address}")
    permission = sign_allowance(collection, signer, account, quantity, int(time.time() + seconds))
    text = json.dumps(permission.document(), indent=1)
    if output is None:
        print(text)
        return
    write_output(output, (text + "\n").encode())
    print_line(f"{output}: {account} may mint {quantity}, with: shackled token mint --permission {output}")


def add(
    name: Annotated[str, argument("A dataset piece; with POINTER, the name of the icon.", "NAME")],
    which: IconsOptions,
    payer: TokenPayerOptions,
    pointer: Annotated[str | None, argument("Address of the stored scene, from `shackled store`.", "POINTER")] = None,
    price: Annotated[str, option("--price", "Price of a token, in ether.", "ETHER")] = "0.02",
    supply: Annotated[int, option("--supply", "Number of tokens.", "N")] = 100,
    reserve: Annotated[int, option("--reserve", "Number of these tokens reserved for the team.", "N")] = 1,
) -> None:
    """Add an icon, whose scene is stored already, to a collection that is not sealed. For the owner."""
    from ...deploy import local_chain
    from ...studio import STUDIO, stored_codes
    from ...tokens import SCALE, SceneToStore, add_call, check_sale, chosen_pieces, plan_storage, token_scene

    wei = parse_ether(price, "--price")
    check_sale([], wei, supply, reserve)
    pieces = [] if pointer is not None else chosen_pieces(name)
    if len(pieces) > 1:
        raise InputError("one icon can be added at a time")
    place = None if pointer is None else parse_checksum_address(pointer, "the pointer")
    collection = which.open()
    if place is None:
        piece = pieces[0]
        storage = plan_storage(collection.connection, [SceneToStore(piece.name, token_scene(piece))])
        if storage.missing:
            raise InputError(f"{piece.name} is not on the chain yet; run: shackled store {piece.name}")
        name, place = piece.title, storage.pointers[0]
    arguments = (name, place, SCALE, wei, supply, reserve)
    # fails before the confirmation if the scene cannot be drawn
    codes = stored_codes(collection.connection, local_chain().address(STUDIO), bytes.fromhex(place[2:]))
    gas = add_call(collection.contract.interface, collection.address, arguments, codes).gas
    receipt = payer.send(collection, f"add {name}", "add", *arguments, gas=gas)
    print_line(f"{name} is added; {receipt.gas:,} gas")


def seal(which: IconsOptions, payer: TokenPayerOptions) -> None:
    """Seal the set of icons; required before the sale. Cannot be undone. For the owner."""
    from ...tokens import icons_of

    collection = which.open()
    icons = icons_of(collection)
    receipt = payer.send(collection, f"seal the collection with {len(icons)} icons", "seal")
    print_line(f"{collection.name} is sealed with {len(icons)} icons; {receipt.gas:,} gas")
