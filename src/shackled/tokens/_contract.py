"""A contract on a chain: calls through its ABI, transactions that are checked and quoted first, errors and events."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import Any

from ..artifacts import artifact, known_errors
from ..chain._connection import Connection
from ..chain._failures import describe_revert
from ..chain._node import metered
from ..deploy._quote import Call, Quote
from ..deploy._transactor import Receipt, Transactor
from ..errors import NoAnswerError, NodeError, OutOfGasError, RevertError, VerificationError
from ..ethereum._abi import decode_error
from ..ethereum._amounts import ether
from ..ethereum._encoding import checksum_address, intrinsic_gas, keccak256, to_hex

#: Approximate gas of each function, without the intrinsic gas of the transaction.
USUAL_GAS = {
    "acceptOwnership": 8_000,
    "add": 135_000,
    "close": 15_000,
    "mint": 65_000,
    "mintReserve": 65_000,
    "mintWithProof": 60_000,
    "mintWithSignature": 75_000,
    "safeTransferFrom": 55_000,
    "seal": 28_000,
    "setAllowList": 55_000,
    "setPhase": 12_000,
    "setRoyalty": 9_000,
    "transferFrom": 55_000,
    "transferOwnership": 28_000,
    "withdraw": 30_000,
}


class Contract:
    """A contract of this package at an address."""

    def __init__(self, connection: Connection, name: str, address: str) -> None:
        self.name, self.connection, self.address = name, connection, address
        self.place = bytes.fromhex(address.removeprefix("0x"))
        self.interface = artifact(name).interface

    def call(self, function: str, *arguments: Any) -> Any:
        """Call a function with the node's gas limit, and return its value, or a tuple of several.

        Raises RevertError, with an explanation, if the contract reverts; NodeError if the node fails.
        """
        request = {"to": self.address, "data": to_hex(self.interface.encode(function, *arguments))}
        try:
            answer = self.connection.data("eth_call", request, "latest")
        except RevertError as error:
            raise explained(error) from None
        except OutOfGasError:
            raise self.too_little_gas(function) from None
        try:
            return self.interface.decode(function, answer)
        except ValueError:
            what = f"it returned {len(answer)} invalid bytes for {function}" if answer else "there is no contract"
            raise NodeError(
                f"the address {self.address} is not a {self.name} on chain {self.connection.chain_id}: {what}"
            ) from None

    def too_little_gas(self, function: str) -> OutOfGasError:
        """Return the error for a read call that runs out of gas."""
        return OutOfGasError(
            f"the {self.connection.name} allows a read call too little gas for {function}: raise its limit, or use "
            "another node"
        )

    def account(self, function: str, *arguments: Any) -> str:
        """Return the address that a function returns, with its checksum."""
        return checksum_address(bytes.fromhex(self.call(function, *arguments)[2:]))

    def gas(self, function: str, *arguments: Any) -> int | None:
        """Return the exact gas of the execution of a read call.

        None if the node has no state overrides, or gives a call too little gas to measure it.
        """
        try:
            result = metered(self.connection, self.place, self.interface.encode(function, *arguments))
        except RevertError as error:
            raise explained(error) from None
        except NoAnswerError:
            raise
        except (NodeError, OutOfGasError):
            return None
        return result.gas if result.output else None

    def prepare(self, function: str, *arguments: Any, value: int = 0, gas: int | None = None) -> Call:
        """Return a transaction that calls a function. gas: of the whole transaction; None uses `USUAL_GAS`."""
        data = self.interface.encode(function, *arguments)
        usual = USUAL_GAS[function.partition("(")[0]] + intrinsic_gas(data) if gas is None else gas
        return Call(self.place, data, usual, value)


def simulate(connection: Connection, call: Call, sender: bytes | None = None) -> None:
    """Raise RevertError, with an explanation, if a contract would revert a transaction now."""
    try:
        connection.data("eth_call", call.request(sender), "latest")
    except RevertError as error:
        raise explained(error) from None


def plan(transactor: Transactor, call: Call) -> Quote:
    """Return the quote of a transaction that would succeed now.

    Raises RevertError, with an explanation, if the contract would revert it; TransactionError if it would fail
    otherwise, or if the prices of the node are implausible.
    """
    # the estimate has a better message of other failures, for instance about an account without ether
    with suppress(NodeError):
        simulate(transactor.connection, call, transactor.address)
    return transactor.quote(call)


def perform(transactor: Transactor, call: Call) -> Receipt:
    """Plan a transaction and send it."""
    return transactor.send(plan(transactor, call))


TRANSFER = "Transfer(address,address,uint256)"
#: Of collections with an owner, and of editions.
WITHDRAWN = ("Withdrawn(address,uint256)", "Withdrawn(address,address,uint256)")


def find_events(logs: Iterable[Any], address: str, signature: str) -> list[list[int]]:
    """Return the words of each event of a contract, as numbers: those of its topics, then those of its data.

    logs: of a receipt, as JSON-RPC returns them. Raises VerificationError if an event is invalid.
    """
    kind, count = to_hex(keccak256(signature.encode())), signature.count(",") + 1
    found = []
    try:
        for log in logs:
            if log["address"].lower() != address.lower() or log["topics"][:1] != [kind]:
                continue
            data = bytes.fromhex(log.get("data", "").removeprefix("0x"))
            words = [int(topic, 16) for topic in log["topics"][1:]]
            words += [int.from_bytes(data[at : at + 32], "big") for at in range(0, len(data), 32)]
            if len(words) < count or not all(0 <= word < 1 << 256 for word in words):
                raise ValueError(log)
            found.append(words)
    except (AttributeError, LookupError, TypeError, ValueError):
        raise VerificationError(
            f"the transaction succeeded, but its receipt has invalid events: {logs!r:.60}"
        ) from None
    return found


def minted_tokens(logs: Iterable[Any], address: str) -> list[int]:
    """Return the tokens of a collection that a transaction minted or transferred. Errors as `find_events`."""
    return [token for _, _, token, *_ in find_events(logs, address, TRANSFER)]


def withdrawn(logs: Iterable[Any], address: str) -> int:
    """Return what a transaction withdrew from a collection, in wei. Raises VerificationError if no event says so."""
    amounts = [words[-1] for each in WITHDRAWN for words in find_events(logs, address, each)]
    if len(amounts) != 1:
        raise VerificationError("the transaction succeeded, but its receipt does not say what was withdrawn")
    return amounts[0]


#: The phases of a sale in words, by what they are called on the command line, in the order of the contract's numbers.
PHASES = {"closed": "closed", "allow-list": "open for the allow list", "public": "open for all"}

#: The message of each error that a command may meet although it checks before, from its values by name.
SENTENCES: dict[str, Callable[[dict[str, Any]], str]] = {
    "WrongPhase": lambda v: f"the sale is {_phase(v['phase'])}; for this it must be {_phase(v['needed'])}",
    "Quantity": lambda v: f"a call mints 1 to {v['perTransaction']} tokens, not {v['quantity']}",
    "Payment": lambda v: f"the price is {ether(v['due'])}, but {ether(v['sent'])} was sent",
    "AllowanceExpired": lambda v: f"the permission expired at {v['deadline']} s of Unix time, and it is {v['time']}",
    "AllowanceNotSigned": lambda v: f"the permission is not signed by {v['signer']}, the signer of this collection",
    "AllowanceExceeded": lambda v: (
        f"the allow list allows the account {v['allowance']} in all: {v['minted']} minted, {v['quantity']} more wanted"
    ),
    "NothingLeft": lambda v: f"sold out: {v['quantity']} wanted, {v['left'] or 'none'} left",
    "WithdrawalRefused": lambda v: f"{v['to']} does not accept the {ether(v['amount'])}; choose another account",
    "OwnableUnauthorizedAccount": lambda v: f"only the owner may do this, and {v['account']} is not the owner",
    "NotRevealed": lambda v: (
        f"token {v['tokenId']} is not revealed yet (round {v['round']}); run: shackled token reveal"
    ),
    "NotSealed": lambda v: "the set of icons is not sealed yet: the owner has to seal the collection first",
    "AlreadySealed": lambda v: "the set of icons is sealed: none can be added",
    "UnknownEdition": lambda v: f"there is no edition {v['edition']}: the collection has {v['editions']}",
    "NotTheArtist": lambda v: (
        f"only its artist {v['artist']} may do this with edition {v['edition']}, not {v['account']}"
    ),
    "AlreadyClosed": lambda v: f"edition {v['edition']} is closed: no more tokens of it can be minted",
    "NothingKept": lambda v: f"no scene is stored at {v.get('scene', v.get('pointer'))}",
    "OwnerQueryForNonexistentToken": lambda v: "there is no such token",
    "URIQueryForNonexistentToken": lambda v: "there is no such token",
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
    return list(PHASES.values())[number] if number < len(PHASES) else f"phase {number}"
