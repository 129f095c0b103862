"""What accounts do with collections: checked and priced before it is sent."""

from __future__ import annotations

from typing import Any

from ..deploy import Call, Quote, Receipt, Transactor
from ..errors import NodeError, RevertError
from ..ethereum import Interface, intrinsic_gas, to_hex
from ._contract import Contract

#: About the gas that each function takes, without what is paid for the call and its data.
USUAL = {
    "acceptOwnership": 8_000,
    "add": 135_000,
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


def call_of(
    interface: Interface, address: str, function: str, *arguments: Any, value: int = 0, ours: int | None = None
) -> Call:
    """Return the call of a function as a transaction. ours: its gas as counted here; None takes what is usual."""
    data = interface.encode(function, *arguments)
    usual = USUAL[function.partition("(")[0]] + intrinsic_gas(data) if ours is None else ours
    return Call(bytes.fromhex(address.removeprefix("0x")), data, usual, value)


def plan(
    transactor: Transactor,
    contract: Contract,
    function: str,
    *arguments: Any,
    value: int = 0,
    ours: int | None = None,
) -> Quote:
    """Return the price of a call that would succeed now.

    RevertError, in words, if the contract would refuse it; TransactionError if it would fail otherwise, or if the
    prices of the node are not to be believed.
    """
    try:
        contract.call(function, *arguments, sender=to_hex(transactor.address), value=value)
    except RevertError:
        raise
    except NodeError:
        pass  # what the estimate says in better words, such as an account without ether
    return transactor.quote(call_of(contract.interface, contract.address, function, *arguments, value=value, ours=ours))


def perform(
    transactor: Transactor,
    contract: Contract,
    function: str,
    *arguments: Any,
    value: int = 0,
    ours: int | None = None,
) -> Receipt:
    """Plans a transaction and sends it."""
    return transactor.send(plan(transactor, contract, function, *arguments, value=value, ours=ours))
