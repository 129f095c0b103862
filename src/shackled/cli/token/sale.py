"""shackled token mint, reveal and transfer: commands for everyone"""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ...errors import InputError
from ...ethereum import checksum_address, to_hex
from ...values import plural
from ..chain_options import (
    Calldata,
    Json,
    check_calldata,
    parse_checksum_address,
    print_price,
    write_calls,
)
from ..option import argument, option
from ..output import print_json, print_line, print_note
from .options import MAX_NUMBER, AnyCollectionOptions, CollectionOptions, TokenPayerOptions

if TYPE_CHECKING:
    from ...deploy import Quote
    from ...tokens import Collection, ContractCall, Round

#: Seconds between two requests while waiting for a block.
PAUSE = 4.0
#: ERC-721 has two functions of this name.
SAFE_TRANSFER = "safeTransferFrom(address,address,uint256)"


def mint(
    which: CollectionOptions,
    payer: TokenPayerOptions,
    quantity: Annotated[int, argument("Number of tokens.", "N", min=1, max=MAX_NUMBER)] = 1,
    allow_list: Annotated[
        Path | None, option("--allow-list", "The allow list that the owner published, with your account.", "FILE")
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
    """Mint tokens. Prints the price first."""
    from ...tokens import find_icon, mint_call, minted_tokens

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
    numbers = minted_tokens(receipt.logs, collection.address)
    if as_json:
        print_json({"tokens": numbers, "transaction": receipt.hash, "gas": receipt.gas, "wei": call.value})
        return
    numbers = numbers or list(range(first, first + quantity))
    names = ", ".join(f"#{number}" for number in numbers)
    print_line(f"minted {names}; {receipt.gas:,} gas, transaction {receipt.hash}")
    if collection.kind.hidden:
        block = collection.contract.call("blockOf", collection.round_of(numbers[0]))
        print_line(f"block {block:,} determines the seeds; then anyone can reveal them: shackled token reveal")


def reveal(
    which: CollectionOptions,
    payer: TokenPayerOptions,
    wait: Annotated[bool, option("--wait", "Wait for blocks that are not mined yet.")] = False,
    calldata: Calldata = None,
    as_json: Json = False,
) -> None:
    """Reveal the tokens whose blocks are mined. Anyone can do this."""
    from ...deploy import current_fees
    from ...tokens import hidden_rounds, price_calls, price_wallet_calls, reveal_calls

    check_calldata(calldata)
    collection = which.open()
    if not collection.kind.hidden:
        raise InputError(f"the tokens of {collection.name} are never hidden: there is nothing to reveal")
    rounds = hidden_rounds(collection)
    if not rounds:
        if calldata is not None:
            raise InputError(f"there is nothing to reveal: {calldata} was not written")
        if as_json:
            print_json({"rounds": [], "transactions": [], "gas": 0})
        else:
            print_line("there is nothing to reveal")
        return
    ready = _ready_rounds(collection, rounds, wait)
    transactor = None if calldata is not None else payer.transactor(collection.connection)
    calls = reveal_calls(collection, ready)
    if transactor is None:
        quotes = price_wallet_calls(collection, calls, current_fees(collection.connection, payer.max_wei))
    else:
        quotes = price_calls(transactor, collection, calls)
    proofs = sum(call.function != "reveal" for call in calls)
    more = f", and {plural(proofs, 'transaction')} to prove old blocks" if proofs else ""
    print_note(plural(len(ready), "round") + more)
    if calldata is not None:
        print_price(quotes)
        named = {_name_of(call): quote for call, quote in zip(calls, quotes, strict=True)}
        write_calls(calldata, collection.connection.chain_id, named, as_json)
        if not as_json:
            _print_pasting(quotes, calldata)
    elif transactor is not None:
        payer.confirm(transactor, quotes)
        receipts = []
        for call, quote in zip(calls, quotes, strict=True):
            receipts.append(transactor.send(quote))
            done = f"{'revealed' if call.function == 'reveal' else 'proved older blocks'}; {receipts[-1].gas:,} gas"
            (print_note if as_json else print_line)(done)
        if as_json:
            hashes = [receipt.hash for receipt in receipts]
            gas = sum(receipt.gas for receipt in receipts)
            print_json({"rounds": [each.number for each in ready], "transactions": hashes, "gas": gas})
    if len(ready) < len(rounds):
        waiting, following = plural(len(rounds) - len(ready), "round"), rounds[len(ready)]
        text = f"not yet revealable: {waiting}; the next one needs block {following.block:,}"
        (print_note if as_json else print_line)(text)


def _ready_rounds(collection: Collection, rounds: list[Round], wait: bool) -> list[Round]:
    """Return the rounds that can be revealed now; with `wait`, wait for all. InputError if there are none."""
    from ...tokens import latest_block

    latest = latest_block(collection)
    while wait and (missing := rounds[-1].missing_blocks(latest)):
        print_note(f"waiting for block {rounds[-1].block:,}: {plural(missing, 'more block')}")
        time.sleep(PAUSE)
        latest = latest_block(collection)
    ready = [each for each in rounds if not each.missing_blocks(latest)]
    if not ready:
        raise InputError(
            f"block {rounds[0].block:,} determines the next seeds, and the chain is at {latest:,}: "
            f"wait for {plural(rounds[0].missing_blocks(latest), 'more block')}, or add --wait"
        )
    return ready


def _name_of(call: ContractCall) -> str:
    """Return the purpose of a call; no two calls of a reveal have the same one."""
    if call.function != "reveal":
        return f"prove blocks before {call.arguments[0]}"
    numbers = call.arguments[0]
    return f"reveal {plural(len(numbers), 'round')}, {', '.join(map(str, numbers))}"


def _print_pasting(quotes: list[Quote], path: Path) -> None:
    """Print how to send the transactions with a wallet that reads no file."""
    if len(quotes) > 1:
        print_line(f"send them in order, each after the previous one is mined: {path} has `to` and `data`")
        return
    call = quotes[0].call
    assert call.to is not None
    print_line("to send it with any wallet that accepts data, paste:")
    print_line(f"to     {checksum_address(call.to)}")
    print_line("value  0")
    print_line(f"data   {to_hex(call.data)}")


def transfer(
    token_id: Annotated[int, argument("Number of the token.", "ID", min=0, max=MAX_NUMBER)],
    to: Annotated[str, argument("The new owner.", "ADDRESS")],
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
