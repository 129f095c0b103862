"""shackled token mint, reveal and transfer: commands for everyone"""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...errors import InputError
from ...ethereum import keccak256
from ..chain_options import Json, parse_checksum_address, print_json, with_groups
from ..option import option
from ..output import print_line, print_note
from .options import MAX_NUMBER, AnyCollectionOptions, CollectionOptions, TokenPayerOptions

if TYPE_CHECKING:
    from ...deploy import Receipt

#: Seconds between two requests while waiting for a block.
PAUSE = 4.0
#: ERC-721 has two functions of this name.
SAFE_TRANSFER = "safeTransferFrom(address,address,uint256)"


@with_groups
def mint(
    which: CollectionOptions,
    payer: TokenPayerOptions,
    quantity: Annotated[int, typer.Argument(help="Number of tokens.", metavar="N", min=1, max=MAX_NUMBER)] = 1,
    allow_list: Annotated[
        Path | None, option("--allow-list", "Mint as an account of this list, as the owner published it.", "FILE")
    ] = None,
    permission: Annotated[
        Path | None, option("--permission", "Mint with a permission from `shackled token permit`.", "FILE")
    ] = None,
    icon: Annotated[
        str | None, option("--icon", "Name or number of the icon, in a collection of icons.", "NAME")
    ] = None,
    reserve_to: Annotated[
        str | None, option("--reserve-to", "Mint from the reserve, for this account. For the owner.", "ADDRESS")
    ] = None,
    as_json: Json = False,
) -> None:
    """Mint tokens. The price is printed first."""
    from ...tokens import find_icon, mint_call

    if sum(each is not None for each in (allow_list, permission, reserve_to)) > 1:
        raise InputError("--allow-list, --permission and --reserve-to exclude each other: give one of them")
    receiver = None if reserve_to is None else parse_checksum_address(reserve_to, "--reserve-to")
    collection = which.open()
    if collection.kind.hidden and icon is not None:
        raise InputError(f"--icon is for collections of icons, and {collection.name} has none")
    if not collection.kind.hidden and icon is None:
        raise InputError("--icon is missing: `shackled token list -c icons` prints the names")
    chosen = None if icon is None else find_icon(collection, icon)
    number = None if chosen is None else chosen.number
    account = str(payer.signer.address)
    call = mint_call(collection, account, quantity, allow_list, permission, receiver, number)
    first = collection.minted()
    title = f"mint {quantity}" if chosen is None else f"mint {quantity} of {chosen.name}, {chosen.left} left"
    receipt = payer.send(collection, title, call.function, *call.arguments, value=call.value)
    numbers = minted_numbers(receipt, collection.address)
    if as_json:
        print_json({"tokens": numbers, "transaction": receipt.hash, "gas": receipt.gas, "wei": call.value})
        return
    numbers = numbers or list(range(first, first + quantity))
    names = ", ".join(f"#{number}" for number in numbers)
    print_line(f"minted {names}; {receipt.gas:,} gas, transaction {receipt.hash}")
    if collection.kind.hidden:
        block = collection.contract.call("blockOf", collection.round_of(numbers[0]))
        print_line(f"block {block:,} determines the seeds; then anyone can reveal them: shackled token reveal")


def minted_numbers(receipt: Receipt, address: str) -> list[int]:
    """Return the tokens that a transaction minted, from the Transfer events of its receipt."""
    transfer = "0x" + keccak256(b"Transfer(address,address,uint256)").hex()
    logs = [log for log in receipt.logs if log["topics"][0] == transfer and len(log["topics"]) == 4]
    return [int(log["topics"][3], 16) for log in logs if int(log["address"], 16) == int(address, 16)]


@with_groups
def reveal(
    which: CollectionOptions,
    payer: TokenPayerOptions,
    wait: Annotated[bool, option("--wait", "Wait for blocks that are not mined yet.")] = False,
) -> None:
    """Reveal the tokens whose blocks are mined. Anyone can; the result is the same."""
    from ...tokens import hidden_rounds, latest_block, price_calls, reveal_calls

    collection = which.open()
    if not collection.kind.hidden:
        raise InputError(f"the tokens of {collection.name} show their pictures at once: there is nothing to reveal")
    rounds = hidden_rounds(collection)
    if not rounds:
        print_line("there is nothing to reveal")
        return
    latest = latest_block(collection)
    while wait and rounds[-1].block > latest:
        print_note(f"waiting for block {rounds[-1].block:,}, in {rounds[-1].block - latest} blocks")
        time.sleep(PAUSE)
        latest = latest_block(collection)
    ready = [each for each in rounds if each.block <= latest]
    if not ready:
        raise InputError(
            f"block {rounds[0].block:,} determines the next seeds, and the chain is at {latest:,}: "
            f"wait for {rounds[0].block - latest} more blocks, or add --wait"
        )
    transactor = payer.transactor(collection.connection)
    calls = reveal_calls(collection, ready)
    quotes = price_calls(transactor, collection, calls)
    proofs = sum(call.function != "reveal" for call in calls)
    text = f"{len(ready)} round{'s' * (len(ready) > 1)}"
    print_note(text + (f", and {proofs} transaction{'s' * (proofs > 1)} to prove old blocks" if proofs else ""))
    payer.confirm(transactor, quotes)
    for call, quote in zip(calls, quotes, strict=True):
        receipt = transactor.send(quote)
        print_line(f"{'revealed' if call.function == 'reveal' else 'proved older blocks'}; {receipt.gas:,} gas")
    if len(ready) < len(rounds):
        waiting = len(rounds) - len(ready)
        print_line(f"{waiting} rounds wait for their blocks, the next for {rounds[len(ready)].block:,}")


@with_groups
def transfer(
    token_id: Annotated[int, typer.Argument(help="Number of the token.", metavar="ID", min=0, max=MAX_NUMBER)],
    to: Annotated[str, typer.Argument(help="The new owner.", metavar="ADDRESS")],
    which: AnyCollectionOptions,
    payer: TokenPayerOptions,
) -> None:
    """Transfer a token to another account."""
    receiver = parse_checksum_address(to, "the receiver")
    collection = which.open()
    owner, signer = collection.owner_of(token_id), str(payer.signer.address)
    if owner != signer:
        raise InputError(f"token {token_id} belongs to {owner}, not to {signer}")
    title = f"transfer #{token_id} to {receiver}"
    receipt = payer.send(collection, title, SAFE_TRANSFER, owner, receiver, token_id)
    print_line(f"#{token_id} belongs to {collection.owner_of(token_id)}; {receipt.gas:,} gas")
