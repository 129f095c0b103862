"""The picture on the page as an edition of the visitor, stored, added and minted by the visitor's own wallet.

Every answer of the wallet is checked: the code of the contracts and of what was stored, the receipts, and the edition
as the collection returns it.
"""

from __future__ import annotations

from typing import Any

from ...datasets import require
from ...errors import InputError
from ...ethereum import ether, parse_ether, to_hex
from ...tokens import EDITIONS, OPEN, Edition, EditionTerms, added_number, allows, minted_tokens
from .._edition import EditionCalls
from .._state import Source
from .wallet import Tell, Wallet, WalletError, chain_name

#: Address of a scene that is not known yet.
UNKNOWN = "0x" + "00" * 20


def parse_terms(fields: Any, source: Source) -> EditionTerms:
    """Return the terms of an edition from the fields of the page, all of them text, without the scene.

    InputError if one is wrong, or if the licence of the object does not allow it.
    """
    if not isinstance(fields, dict) or not all(isinstance(each, str) and len(each) <= 200 for each in fields.values()):
        raise InputError("the fields of an edition must be short texts")
    name, price, supply, royalty, licence = (
        " ".join(fields.get(key, "").split()) for key in ("name", "price", "supply", "royalty", "licence")
    )
    _check_licence(source, licence)
    if supply and not supply.isdecimal():
        raise InputError(f"the number of tokens must be a whole number, or empty for no limit, not {supply!r:.60}")
    return EditionTerms(
        name=name,
        scene=UNKNOWN,
        price=parse_ether(price, "the price"),
        supply=int(supply) if supply else OPEN,
        royalty=round(100 * _percent(royalty)),
        model=fields.get("model") == "on",
    )


def can_be_sold(source: Source) -> bool:
    """Return whether the licence of a piece allows an edition of it; for a file the visitor states it."""
    if source.kind == "upload":
        return True
    piece = require(source.name)
    return piece.commercial and allows(piece.licence)


def _check_licence(source: Source, stated: str) -> None:
    if not can_be_sold(source):
        raise InputError("the licence of this object is not known to allow commercial use of changed copies")
    if source.kind == "upload" and not allows(stated):
        raise InputError(
            "state the licence of the file, one that allows commercial use of changed copies: my own work, CC0, "
            f"CC BY, MIT ...; not {stated!r:.60}"
        )


def _percent(text: str) -> float:
    try:
        percent = float(text)
    except ValueError:
        percent = -1.0
    if not 0 <= percent <= 10:
        raise InputError(f"the royalty must be 0 to 10 percent, not {text!r:.60}")
    return percent


async def mint_edition(calls: EditionCalls, wallet: Wallet, tell: Tell) -> str:
    """Store the scene where it is missing, add the edition, and return a sentence that says which it is.

    tell: called with a sentence on each step. InputError if the chain has no collection; WalletError or
    VerificationError if the wallet refuses or returns an invalid answer.
    """
    await tell("Waiting for the wallet …")
    account = await wallet.account()
    number_of_chain = await wallet.number("eth_chainId")
    chain = chain_name(number_of_chain)
    if await _code(wallet, calls.collection) != calls.code:
        raise InputError(
            f"{chain} has no collection of editions at {calls.collection}: switch the wallet to a chain that has "
            "one, or deploy it there: shackled deploy --contracts Editions"
        )
    missing = [each for each in calls.storing if await _code(wallet, each.pointer) != each.code]
    for number, each in enumerate(missing, 1):
        await tell(f"Storing the scene, {number} of {len(missing)}: about {each.gas:,} gas. Confirm it in the wallet …")
        transaction = {"from": account, "to": calls.studio, "data": to_hex(each.data), "value": "0x0"}
        await wallet.send(transaction, tell, number_of_chain)
        if await _code(wallet, each.pointer) != each.code:
            raise WalletError(f"the transaction succeeded, but the scene is not at {each.pointer} on {chain}")
    terms, transaction = calls.terms, {"from": account, "to": calls.collection, "data": to_hex(calls.add)}
    await tell(
        f"Adding the edition: {terms.name}, {ether(terms.price)} a token, about {calls.gas:,} gas. This cannot be "
        "changed later. Confirm it in the wallet …"
    )
    receipt = await wallet.send(transaction | {"value": "0x0"}, tell, number_of_chain)
    logs = receipt.get("logs") or ()
    number = added_number(logs, calls.collection)
    answer = await wallet.read(EDITIONS.contract, calls.collection, "editionAt", number)
    Edition.from_answer(number, answer).check(account, terms)
    yours = "".join(f", token {each} is yours" for each in minted_tokens(logs, calls.collection))
    return f"Added: edition {number} of {EDITIONS.title}{yours}, at {calls.collection} on {chain}"


async def _code(wallet: Wallet, address: str) -> bytes:
    return await wallet.data("eth_getCode", address, "latest")
