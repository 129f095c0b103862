"""A contract on a chain: calls through its ABI, and transactions that are checked and quoted before they are sent."""

from __future__ import annotations

from typing import Any

from ..artifacts import artifact
from ..chain import Connection, metered
from ..deploy import Call, Quote, Receipt, Transactor
from ..errors import NoAnswerError, NodeError, OutOfGasError, RevertError
from ..ethereum import Interface, intrinsic_gas, to_hex
from ._reverts import explained

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
        """Take the name of the artifact and the address; nothing is sent yet."""
        self.name, self.connection, self.address = name, connection, address
        self.interface = artifact(name).interface

    def call(
        self, function: str, *arguments: Any, sender: str | None = None, value: int = 0, block: str = "latest"
    ) -> Any:
        """Call a function with the node's gas limit, and return its value, or a tuple of several.

        Raises RevertError, with an explanation, if the contract reverts; NodeError if the node fails.
        """
        request = {"to": self.address, "data": to_hex(self.interface.encode(function, *arguments))}
        if sender is not None:
            request["from"] = sender
        if value:
            request["value"] = hex(value)
        try:
            answer = self.connection.data("eth_call", request, block)
        except RevertError as error:
            raise explained(error) from None
        except OutOfGasError:
            raise OutOfGasError(
                f"the {self.connection.name} allows a read call too little gas for {function}: "
                "raise its limit, or use another node"
            ) from None
        try:
            return self.interface.decode(function, answer)
        except ValueError:
            what = f"it returned {len(answer)} invalid bytes for {function}" if answer else "there is no contract"
            raise NodeError(
                f"the address {self.address} is not a {self.name} on chain {self.connection.chain_id}: {what}"
            ) from None

    def gas(self, function: str, *arguments: Any) -> int | None:
        """Return the exact gas of the execution of a read call.

        None if the node has no state overrides, or gives a call too little gas to measure it.
        """
        data = self.interface.encode(function, *arguments)
        try:
            result = metered(self.connection, bytes.fromhex(self.address[2:]), data)
        except RevertError as error:
            raise explained(error) from None
        except NoAnswerError:
            raise
        except (NodeError, OutOfGasError):
            return None
        return result.gas if result.output else None


def call_of(
    interface: Interface, address: str, function: str, *arguments: Any, value: int = 0, gas: int | None = None
) -> Call:
    """Return a transaction that calls a function. gas: of the whole transaction; None uses `USUAL_GAS`."""
    data = interface.encode(function, *arguments)
    usual = USUAL_GAS[function.partition("(")[0]] + intrinsic_gas(data) if gas is None else gas
    return Call(bytes.fromhex(address.removeprefix("0x")), data, usual, value)


def plan(
    transactor: Transactor,
    contract: Contract,
    function: str,
    *arguments: Any,
    value: int = 0,
    gas: int | None = None,
) -> Quote:
    """Return the quote of a transaction that would succeed now.

    Raises RevertError, with an explanation, if the contract would revert it; TransactionError if it would fail
    otherwise, or if the prices of the node are implausible.
    """
    try:
        contract.call(function, *arguments, sender=to_hex(transactor.address), value=value)
    except RevertError:
        raise
    except NodeError:
        pass  # the estimate has a better message, for instance about an account without ether
    return transactor.quote(call_of(contract.interface, contract.address, function, *arguments, value=value, gas=gas))


def perform(
    transactor: Transactor,
    contract: Contract,
    function: str,
    *arguments: Any,
    value: int = 0,
    gas: int | None = None,
) -> Receipt:
    """Plan a transaction and send it."""
    return transactor.send(plan(transactor, contract, function, *arguments, value=value, gas=gas))
