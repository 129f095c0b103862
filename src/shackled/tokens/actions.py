"""What accounts do with contracts: checked and priced before it is sent."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..deploy import Fees, Receipt, Transactor
from ..errors import NodeError, RevertError
from .contract import Contract


@dataclass(frozen=True)
class Action:
    """A transaction that would succeed now. value: what is sent along, in wei. gas: as the node estimates it."""

    contract: Contract
    data: bytes
    value: int
    gas: int
    fees: Fees

    @property
    def fee(self) -> int:
        """What its gas probably costs, in wei."""
        return self.gas * self.fees.likely

    def send(self, transactor: Transactor) -> Receipt:
        """Sends it, and waits until it is in a block."""
        return transactor.send(_bytes(self.contract.address), self.data, self.value)


def plan(transactor: Transactor, contract: Contract, function: str, *arguments: Any, value: int = 0) -> Action:
    """The call of a function as a transaction.

    RevertError, in words, if the contract would refuse it; TransactionError if it would fail otherwise.
    """
    try:
        contract.call(function, *arguments, sender="0x" + transactor.address.hex(), value=value)
    except RevertError:
        raise
    except NodeError:
        pass  # what the estimate says in better words, such as an account without ether
    data = contract.encode(function, *arguments)
    gas = transactor.estimate(_bytes(contract.address), data, value)
    return Action(contract, data, value, gas, transactor.fees())


def perform(transactor: Transactor, contract: Contract, function: str, *arguments: Any, value: int = 0) -> Receipt:
    """Plans a transaction and sends it."""
    return plan(transactor, contract, function, *arguments, value=value).send(transactor)


def _bytes(address: str) -> bytes:
    return bytes.fromhex(address.removeprefix("0x"))
