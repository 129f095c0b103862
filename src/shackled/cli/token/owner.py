"""shackled token phase, withdraw, royalty, hand-over and take-over: what is the owner's"""

from __future__ import annotations

from typing import Annotated

import typer

from ...checks import choice, number
from ...errors import InputError
from ...ethereum import checksum_address, ether
from ..option import option
from ..payer import open_signer
from ..telling import tell
from .common import PHASES, Account, Chain, Key, MaxFee, Rpc, Which, Yes, address, do, open_named, send


def phase(
    to: Annotated[str, typer.Argument(help=", ".join(PHASES) + ".", metavar="PHASE")],
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Say who may mint from now on; for the owner."""
    number = PHASES.index(choice(to, "the phase", PHASES))
    collection = open_named(which, rpc, chain_id)
    receipt = do(collection, account, private_key_env, max_fee, yes, f"the sale becomes {to}", "setPhase", number)
    tell(f"{collection.name} is {collection.terms().phase_words}; {receipt.gas:,} gas")


def withdraw(
    to: Annotated[str | None, option("--to", "Who gets it; else the owner.", "ADDRESS")] = None,
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Fetch the ether of the sale; for the owner."""
    collection = open_named(which, rpc, chain_id)
    signer = open_signer(account, private_key_env)
    receiver = str(signer.address) if to is None else address(to, "--to")
    balance = collection.terms().balance
    if not balance:
        tell("there is nothing to withdraw")
        return
    receipt = send(collection, signer, max_fee, yes, f"send {ether(balance)} to {receiver}", "withdraw", receiver)
    tell(f"{ether(balance)} sent to {receiver}; {receipt.gas:,} gas")


def royalty(
    percent: Annotated[float, typer.Argument(help="Of resales, 0 to 10.", metavar="PERCENT")],
    receiver: Annotated[str | None, option("--receiver", "Whose they are; else whose they were.", "ADDRESS")] = None,
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Say what part of resales marketplaces are to pay, and to whom; for the owner."""
    parts = round(100 * number(percent, "the royalty", 0, 10))
    given = None if receiver is None else address(receiver, "--receiver")
    collection = open_named(which, rpc, chain_id)
    whose = collection.terms().royalty_receiver if given is None else given
    title = f"royalties of {parts / 100:g} % for {whose}"
    receipt = do(collection, account, private_key_env, max_fee, yes, title, "setRoyalty", whose, parts)
    tell(f"royalties are {parts / 100:g} % for {whose}; {receipt.gas:,} gas")


def hand_over(
    to: Annotated[str, typer.Argument(help="Who is to be the owner.", metavar="ADDRESS")],
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Offer the collection to another owner, who then takes it over; for the owner."""
    heir = address(to, "the new owner")
    collection = open_named(which, rpc, chain_id)
    title = f"offer it to {heir}"
    receipt = do(collection, account, private_key_env, max_fee, yes, title, "transferOwnership", heir)
    tell(f"{heir} can take it over: shackled token take-over; {receipt.gas:,} gas")


def take_over(
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Become the owner of a collection that was offered to you."""
    collection = open_named(which, rpc, chain_id)
    signer = open_signer(account, private_key_env)
    heir = checksum_address(bytes.fromhex(collection.contract.call("pendingOwner")[2:]))
    if heir != str(signer.address):
        offered = "to nobody" if int(heir, 16) == 0 else f"to {heir}"
        raise InputError(f"{collection.name} is offered {offered}, not to {signer.address}")
    receipt = send(collection, signer, max_fee, yes, "become its owner", "acceptOwnership")
    tell(f"{collection.name} belongs to {collection.terms().owner}; {receipt.gas:,} gas")
