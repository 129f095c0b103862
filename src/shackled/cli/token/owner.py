"""shackled token phase, withdraw, royalty, transfer-ownership and accept-ownership: commands of the owner"""

from __future__ import annotations

from typing import Annotated

from ...checks import choice, number
from ...errors import InputError
from ...ethereum import checksum_address, ether
from ..chain_options import parse_checksum_address
from ..option import argument, option
from ..output import print_line
from .options import PHASES, CollectionOptions, TokenPayerOptions


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
