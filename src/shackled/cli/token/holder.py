"""shackled token mint, reveal and transfer: what everybody does"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...errors import InputError
from ..option import option
from ..payer import ask, open_signer, parse_max_fee, price
from ..telling import say, tell
from .common import MOST, Account, Chain, Json, Key, MaxFee, Rpc, Which, Yes, address, open_named, send

if TYPE_CHECKING:
    from ...deploy import Receipt

#: Seconds between two looks at the chain while waiting for a block.
PAUSE = 4.0
#: ERC-721 has two functions of this name.
SAFE_TRANSFER = "safeTransferFrom(address,address,uint256)"


def mint(
    quantity: Annotated[int, typer.Argument(help="How many tokens.", metavar="N", min=1, max=MOST)] = 1,
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    allow_list: Annotated[
        Path | None, option("--allow-list", "The list that you are on, as the owner published it.", "FILE")
    ] = None,
    permission: Annotated[Path | None, option("--permission", "What the owner has signed for you.", "FILE")] = None,
    icon: Annotated[str | None, option("--icon", "Which icon, by its name or number; for icons.", "NAME")] = None,
    reserve_to: Annotated[
        str | None, option("--reserve-to", "For the owner: from the reserve, to this account.", "ADDRESS")
    ] = None,
    chain_id: Chain = None,
    yes: Yes = False,
    as_json: Json = False,
) -> None:
    """Mint tokens. The price is told first."""
    from ...tokens import find_icon, mint_call

    if sum(each is not None for each in (allow_list, permission, reserve_to)) > 1:
        raise InputError("--allow-list, --permission and --reserve-to are three ways to mint: give one of them")
    receiver = None if reserve_to is None else address(reserve_to, "--reserve-to")
    collection = open_named(which, rpc, chain_id)
    if collection.kind.hidden and icon is not None:
        raise InputError(f"--icon is for icons, and {collection.name} has none")
    if not collection.kind.hidden and icon is None:
        raise InputError("--icon is missing: which icon is minted; `shackled token list -c icons` names them")
    chosen = None if icon is None else find_icon(collection, icon)
    signer = open_signer(account, private_key_env)
    kind = None if chosen is None else chosen.number
    call = mint_call(collection, str(signer.address), quantity, allow_list, permission, receiver, kind)
    first = collection.minted()
    title = f"mint {quantity}" if chosen is None else f"mint {quantity} of {chosen.name}, {chosen.left} left"
    receipt = send(collection, signer, max_fee, yes, title, call.function, *call.arguments, value=call.value)
    numbers = minted_numbers(receipt, collection.address)
    if as_json:
        print(json.dumps({"tokens": numbers, "transaction": receipt.hash, "gas": receipt.gas, "wei": call.value}))
        return
    numbers = numbers or list(range(first, first + quantity))
    tell(f"minted {', '.join(f'#{number}' for number in numbers)}; {receipt.gas:,} gas, transaction {receipt.hash}")
    if collection.kind.hidden:
        block = collection.contract.call("blockOf", collection.round_of(numbers[0]))
        tell(f"block {block:,} draws the seeds; after it, anyone may reveal them: shackled token reveal")


def minted_numbers(receipt: Receipt, address: str) -> list[int]:
    """The tokens that a transaction minted, of the Transfer events in its receipt."""
    from ...ethereum import keccak256

    transfer = "0x" + keccak256(b"Transfer(address,address,uint256)").hex()
    logs = [log for log in receipt.logs if log["topics"][0] == transfer and len(log["topics"]) == 4]
    return [int(log["topics"][3], 16) for log in logs if int(log["address"], 16) == int(address, 16)]


def reveal(
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    wait: Annotated[bool, option("--wait", "Wait for blocks that are still to come.")] = False,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Reveal the tokens whose blocks are there. Anyone may; it is the same whoever does, whenever."""
    from ...deploy import Transactor
    from ...tokens import hidden_rounds, latest_block, price_steps, steps

    collection = open_named(which, rpc, chain_id)
    if not collection.kind.hidden:
        raise InputError(
            f"the tokens of {collection.name} show their pictures from the first: nothing is to be revealed"
        )
    rounds = hidden_rounds(collection)
    if not rounds:
        tell("nothing is to be revealed")
        return
    latest = latest_block(collection)
    while wait and rounds[-1].block > latest:
        say(f"waiting for block {rounds[-1].block:,}: {rounds[-1].block - latest} to come")
        time.sleep(PAUSE)
        latest = latest_block(collection)
    ready = [each for each in rounds if each.block <= latest]
    if not ready:
        raise InputError(
            f"block {rounds[0].block:,} draws the next seeds, and the chain is at {latest:,}: "
            f"wait for {rounds[0].block - latest} more blocks, or add --wait"
        )
    signer = open_signer(account, private_key_env)
    transactor = Transactor(collection.connection, signer, max_fee=parse_max_fee(max_fee))
    todo = steps(collection, ready)
    quotes = price_steps(transactor, collection, todo)
    late = sum(step.function != "reveal" for step in todo)
    rounds_ready = f"{len(ready)} round{'s' * (len(ready) > 1)}"
    say(rounds_ready + (f", and {late} transaction{'s' * (late > 1)} to prove old blocks" if late else ""))
    say(f"it costs {price(quotes)}")
    if not yes:
        ask(transactor.name)
    for step, quote in zip(todo, quotes, strict=True):
        receipt = transactor.send(quote)
        tell(f"{'revealed' if step.function == 'reveal' else 'proved older blocks'}; {receipt.gas:,} gas")
    if len(ready) < len(rounds):
        tell(f"{len(rounds) - len(ready)} rounds wait for their blocks, the next for {rounds[len(ready)].block:,}")


def transfer(
    token_id: Annotated[int, typer.Argument(help="Of the token.", metavar="ID", min=0, max=MOST)],
    to: Annotated[str, typer.Argument(help="Whose it becomes.", metavar="ADDRESS")],
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Give a token to another account."""
    receiver = address(to, "the receiver")
    collection = open_named(which, rpc, chain_id)
    owner = collection.owner_of(token_id)
    signer = open_signer(account, private_key_env)
    if owner != str(signer.address):
        raise InputError(f"token {token_id} belongs to {owner}, not to {signer.address}")
    receipt = send(
        collection, signer, max_fee, yes, f"give #{token_id} to {receiver}", SAFE_TRANSFER, owner, receiver, token_id
    )
    tell(f"#{token_id} belongs to {collection.owner_of(token_id)}; {receipt.gas:,} gas")
