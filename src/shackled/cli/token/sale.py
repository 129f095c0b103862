"""shackled token mint, reveal and transfer: commands for everyone"""

from __future__ import annotations

import time
from pathlib import Path

from ...base.values import plural
from ...deploy._quote import current_fees
from ...errors import InputError
from ...tokens._allow_list import read_allow_list
from ...tokens._collection import Collection
from ...tokens._contract import minted_tokens
from ...tokens._icons import find_icon
from ...tokens._minting import mint_call, read_allowance
from ...tokens._reveal import Round, hidden_rounds, price_calls, reveal_calls
from ..chain_options import CALLDATA, JSON, PayerOptions, address, parse_checksum_address, print_price, write_calls
from ..option import argument, exclude, option
from ..output import print_json, print_line, print_note
from .options import MAX_NUMBER, TOKEN, CollectionOptions

#: Seconds between two requests while waiting for a block.
PAUSE = 4.0
#: ERC-721 has two functions of this name.
SAFE_TRANSFER = "safeTransferFrom(address,address,uint256)"


def mint(
    which: CollectionOptions,
    payer: PayerOptions,
    quantity: int = argument("Number of tokens.", "N", min=1, max=MAX_NUMBER, default=1),
    allow_list: Path | None = option(
        "--allow-list", "The allow list that the owner published, with your account.", "FILE"
    ),
    permission: Path | None = option("--permission", "Mint with a permission from `shackled token permit`.", "FILE"),
    icon: str | None = option("--icon", "Name or number of the icon, in a collection of icons.", "NAME"),
    reserve_to: str | None = address("--reserve-to", "Mint from the reserve, for this account. For the owner."),
    as_json: bool = JSON,
) -> None:
    """Mint tokens. Prints the price first."""
    exclude("--allow-list", allow_list, {"--permission": permission, "--reserve-to": reserve_to})
    exclude("--permission", permission, {"--reserve-to": reserve_to})
    collection = which.open()
    if collection.kind.hidden and icon is not None:
        raise InputError(f"--icon is for collections of icons, and {collection.name} has none")
    if not collection.kind.hidden and icon is None:
        raise InputError("--icon is missing: `shackled token list -c icons` prints the names")
    chosen = None if icon is None else find_icon(collection, icon)
    number = None if chosen is None else chosen.number
    listed = None if allow_list is None else read_allow_list(allow_list)
    allowed = None if permission is None else read_allowance(permission)
    call = mint_call(collection, payer.address, quantity, listed, allowed, reserve_to, number)
    first = collection.minted()
    title = f"mint {quantity}" if chosen is None else f"mint {quantity} of {chosen.name}, {chosen.left} left"
    receipt = payer.send(collection, title, call)
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
    payer: PayerOptions,
    wait: bool = option("--wait", "Wait for blocks that are not mined yet."),
    calldata: Path | None = CALLDATA,
    as_json: bool = JSON,
) -> None:
    """Reveal the tokens whose blocks are mined. Anyone can do this."""
    collection = which.open()
    say = print_note if as_json else print_line
    if not collection.kind.hidden:
        raise InputError(f"the tokens of {collection.name} are never hidden: there is nothing to reveal")
    rounds = hidden_rounds(collection)
    if not rounds:
        if calldata is not None:
            raise InputError(f"there is nothing to reveal: {calldata} was not written")
        say("there is nothing to reveal")
        if as_json:
            print_json({"rounds": [], "transactions": [], "gas": 0})
        return
    ready = _ready_rounds(collection, rounds, wait)
    transactor = None if calldata is not None else payer.transactor(collection.connection)
    calls = reveal_calls(collection, ready)
    fees = current_fees(collection.connection, payer.max_fee)
    sender = None if transactor is None else transactor.address
    quotes = price_calls(collection.connection, list(calls.values()), fees, sender)
    named = dict(zip(calls, quotes, strict=True))
    proofs = sum(not name.startswith("reveal") for name in named)
    more = f", and {plural(proofs, 'transaction')} to prove old blocks" if proofs else ""
    print_note(plural(len(ready), "round") + more)
    if calldata is not None:
        print_price(quotes)
        write_calls(calldata, collection.connection.chain_id, named, as_json)
    elif transactor is not None:
        payer.confirm(transactor, quotes)
        receipts = []
        for name, quote in named.items():
            receipts.append(transactor.send(quote))
            say(f"{'revealed' if name.startswith('reveal') else 'proved older blocks'}; {receipts[-1].gas:,} gas")
        if as_json:
            hashes, gas = [receipt.hash for receipt in receipts], sum(receipt.gas for receipt in receipts)
            print_json({"rounds": [each.number for each in ready], "transactions": hashes, "gas": gas})
    if len(ready) < len(rounds):
        waiting, following = plural(len(rounds) - len(ready), "round"), rounds[len(ready)]
        say(f"not yet revealable: {waiting}; the next one needs block {following.block:,}")


def _ready_rounds(collection: Collection, rounds: list[Round], wait: bool) -> list[Round]:
    """Return the rounds that can be revealed now; with `wait`, wait for all. InputError if there are none."""
    latest = collection.connection.number("eth_blockNumber")
    while wait and (missing := rounds[-1].missing_blocks(latest)):
        print_note(f"waiting for block {rounds[-1].block:,}: {plural(missing, 'more block')}")
        time.sleep(PAUSE)
        latest = collection.connection.number("eth_blockNumber")
    ready = [each for each in rounds if not each.missing_blocks(latest)]
    if not ready:
        raise InputError(
            f"block {rounds[0].block:,} determines the next seeds, and the chain is at {latest:,}: "
            f"wait for {plural(rounds[0].missing_blocks(latest), 'more block')}, or add --wait"
        )
    return ready


def transfer(
    which: CollectionOptions,
    payer: PayerOptions,
    token_id: int = TOKEN,
    to: str = argument("The new owner.", "ADDRESS", parse=parse_checksum_address),
) -> None:
    """Transfer a token to another account."""
    collection = which.open(or_editions=True)
    owner = collection.owner_of(token_id)
    if owner != payer.address:
        raise InputError(f"token {token_id} belongs to {owner}, not to {payer.address}")
    call = collection.contract.prepare(SAFE_TRANSFER, owner, to, token_id)
    receipt = payer.send(collection, f"transfer #{token_id} to {to}", call)
    print_line(f"#{token_id} belongs to {collection.owner_of(token_id)}; {receipt.gas:,} gas")
