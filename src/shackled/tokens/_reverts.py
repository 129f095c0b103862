"""Explanations of the errors of collections and the Studio."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..artifacts import known_errors
from ..chain import describe_revert
from ..errors import RevertError
from ..ethereum import decode_error, ether

#: The phases of a sale, in the order of the contract's numbers.
PHASES = ("closed", "open for the allow list", "open for all")

#: The message of each error that users may get, from its values by name.
SENTENCES: dict[str, Callable[[dict[str, Any]], str]] = {
    "WrongPhase": lambda v: f"the sale is {_phase(v['phase'])}; for this it must be {_phase(v['needed'])}",
    "Quantity": lambda v: f"a call mints 1 to {v['perTransaction']} tokens, not {v['quantity']}",
    "Payment": lambda v: f"the price is {ether(v['due'])}, but {ether(v['sent'])} was sent",
    "PaymentForNothing": lambda v: f"{ether(v['sent'])} was sent, but the call is free",
    "NotOnAllowList": lambda v: f"the account {v['account']} is not on the allow list for {v['quantity']} tokens",
    "AllowanceOfAnother": lambda v: f"the permission is for {v['account']}, not for {v['sender']}",
    "AllowanceExpired": lambda v: f"the permission expired at {v['deadline']} s of Unix time, and it is {v['time']}",
    "AllowanceNotSigned": lambda v: f"the permission is not signed by {v['signer']}, the signer of this collection",
    "AllowanceExceeded": lambda v: (
        f"the allow list allows the account {v['allowance']} in all: {v['minted']} minted, {v['quantity']} more wanted"
    ),
    "NothingLeft": lambda v: (
        f"sold out: {v['quantity']} wanted, {v['left']} left"
        if v["left"]
        else f"sold out: {v['quantity']} wanted, none left"
    ),
    "WithdrawalRefused": lambda v: f"{v['to']} does not accept the {ether(v['amount'])}; choose another account",
    "NameNotUtf8": lambda v: f"the name is not valid UTF-8 at byte {v['position']}",
    "OwnerNeeded": lambda v: "a collection needs an owner",
    "PerTransaction": lambda v: f"a call may mint 1 to 100 tokens, not {v['perTransaction']}",
    "Reserve": lambda v: f"the reserve can be 0 to {v['supply']} tokens, not {v['reserve']}",
    "Royalty": lambda v: f"royalties can be 0 to {v['highest'] / 100:g} %, not {v['royalty'] / 100:g} %",
    "OwnableUnauthorizedAccount": lambda v: f"only the owner may do this, and {v['account']} is not the owner",
    "OwnableInvalidOwner": lambda v: f"{v['owner']} cannot be the owner",
    "NotRevealed": lambda v: (
        f"token {v['tokenId']} is not revealed yet (round {v['round']}); run: shackled token reveal"
    ),
    "NotSealed": lambda v: "the set of icons is not sealed yet: the owner has to seal the collection first",
    "AlreadySealed": lambda v: "the set of icons is sealed: none can be added",
    "NoIcons": lambda v: "a collection without icons cannot be sealed",
    "UnknownIcon": lambda v: f"there is no icon {v['icon']}: the collection has {v['icons']}",
    "NameLength": lambda v: f"a name has 1 to {v['longest']} bytes, not {v['length']}",
    "NoSupply": lambda v: "an edition needs a supply of 1 token or more",
    "UnknownEdition": lambda v: f"there is no edition {v['edition']}: the collection has {v['editions']}",
    "TooManyEditions": lambda v: f"the collection is full: it has {v['editions']:,} editions",
    "NotTheArtist": lambda v: (
        f"only its artist {v['artist']} may do this with edition {v['edition']}, not {v['account']}"
    ),
    "AlreadyClosed": lambda v: f"edition {v['edition']} is closed: no more tokens of it can be minted",
    "DrawingOutOfGas": lambda v: (
        f"drawing the scene {v['scene']} takes more than {v['gasLimit']:,} gas, or more than the transaction has"
    ),
    "NothingKept": lambda v: f"no scene is stored at {v.get('scene', v.get('pointer'))}",
    "NotAScene": lambda v: f"the data stored at {v['pointer']} is not a scene",
    "BlockToCome": lambda v: f"block {v['blockNumber']:,} is not mined yet",
    "BlockForgotten": lambda v: f"the chain no longer provides the hash of block {v['blockNumber']:,}",
    "WrongHeader": lambda v: f"the header is not that of block {v['blockNumber']:,}",
    "NoRandomness": lambda v: f"block {v['blockNumber']:,} has no randomness, which this chain does not provide",
    "OwnerQueryForNonexistentToken": lambda v: "there is no such token",
    "URIQueryForNonexistentToken": lambda v: "there is no such token",
    "TransferCallerNotOwnerNorApproved": lambda v: "the token belongs to another account",
    "TransferFromIncorrectOwner": lambda v: "the token belongs to another account",
    "TransferToZeroAddress": lambda v: "a token cannot be sent to the address 0",
    "TransferToNonERC721ReceiverImplementer": lambda v: "the receiver is a contract that does not accept tokens",
}


def explained(error: RevertError) -> RevertError:
    """Return a RevertError with an explanation as its message, if its data is that of a known error."""
    found = decode_error(error.data, known_errors())
    if found is None:
        return error
    name, values = found
    sentence = SENTENCES.get(name)
    message = f"the contract refused: {describe_revert(error.data)}" if sentence is None else sentence(values)
    return RevertError(message, error.data)


def _phase(number: int) -> str:
    return PHASES[number] if number < len(PHASES) else f"phase {number}"
