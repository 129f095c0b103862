"""A contract on a chain, asked through its ABI."""

from __future__ import annotations

from typing import Any

from ..artifacts import artifact
from ..chain import Connection, metered
from ..errors import NoAnswerError, NodeError, OutOfGasError, RevertError
from ..ethereum import to_hex
from ._refusals import in_words


class Contract:
    """A contract of ours at an address."""

    def __init__(self, connection: Connection, name: str, address: str) -> None:
        """Take the name of the artifact and the address; nothing is asked yet."""
        self.name, self.connection, self.address = name, connection, address
        self.interface = artifact(name).interface

    def call(
        self, function: str, *arguments: Any, sender: str | None = None, value: int = 0, block: str = "latest"
    ) -> Any:
        """Call a function and return its value, or a tuple of them. The call has the node's limit of gas.

        RevertError, in words, where the contract refuses; NodeError where the node fails.
        """
        request = {"to": self.address, "data": to_hex(self.interface.encode(function, *arguments))}
        if sender is not None:
            request["from"] = sender
        if value:
            request["value"] = hex(value)
        try:
            answer = self.connection.data("eth_call", request, block)
        except RevertError as error:
            raise in_words(error) from None
        except OutOfGasError:
            raise OutOfGasError(
                f"the {self.connection.name} allows a read call too little gas for {function}: "
                "raise its limit, or take another node"
            ) from None
        try:
            return self.interface.decode(function, answer)
        except ValueError:
            what = "there is none" if not answer else f"it answered {function} with {len(answer)} bytes of another kind"
            raise NodeError(
                f"the address {self.address} is no {self.name} on chain {self.connection.chain_id}: {what}"
            ) from None

    def gas(self, function: str, *arguments: Any) -> int | None:
        """Return the exact gas of the execution of a read call.

        None if the node takes no state overrides, or gives a call too little gas to count it.
        """
        data = self.interface.encode(function, *arguments)
        try:
            result = metered(self.connection, bytes.fromhex(self.address[2:]), data)
        except RevertError as error:
            raise in_words(error) from None
        except NoAnswerError:
            raise
        except (NodeError, OutOfGasError):
            return None
        return result.gas if result.output else None
