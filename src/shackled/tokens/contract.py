"""A contract on a chain, asked through its ABI."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from ..artifacts import artifact
from ..chain.connection import Connection
from ..errors import (
    NodeBusyError,
    NodeError,
    NodeTimeoutError,
    NodeUnreachableError,
    OutOfGasError,
    RevertError,
)
from ..ethereum import to_hex
from .refusals import in_words

if TYPE_CHECKING:
    from eth_typing import ABIElement, ABIFunction


class Interface:
    """What can be asked of a contract of ours, by the name of its artifact.

    Functions are named by their names, or by their signatures where there are several of one name.
    """

    def __init__(self, name: str) -> None:
        """Of any contract of that name."""
        self.name = name
        self._functions: dict[str, dict[str, Any]] = {}
        for entry in artifact(name).abi:
            if entry["type"] == "function":
                kinds = ",".join(_kind(each) for each in entry["inputs"])
                self._functions[f"{entry['name']}({kinds})"] = entry
                self._functions.setdefault(entry["name"], entry)

    def encode(self, function: str, *arguments: Any) -> bytes:
        """The data of a call."""
        from eth_abi.abi import encode
        from eth_utils.abi import function_abi_to_4byte_selector, get_abi_input_types

        entry = self._function(function)
        return function_abi_to_4byte_selector(entry) + encode(get_abi_input_types(entry), arguments)

    def decode(self, function: str, answer: bytes) -> Any:
        """The value, or all of them in a tuple, that a function answered. ValueError if these are none."""
        from eth_abi.abi import decode
        from eth_abi.exceptions import DecodingError
        from eth_utils.abi import get_abi_output_types

        try:
            values = decode(get_abi_output_types(self._function(function)), answer)
        except (DecodingError, OverflowError) as error:
            raise ValueError(f"{len(answer)} bytes are no answer of {function}: {error}") from None
        return values[0] if len(values) == 1 else values

    def _function(self, name: str) -> ABIFunction:
        return cast("ABIFunction", self._functions[name])


class Contract(Interface):
    """A contract of ours at an address."""

    def __init__(self, connection: Connection, name: str, address: str) -> None:
        """Nothing is asked yet."""
        super().__init__(name)
        self.connection, self.address = connection, address

    def call(
        self, function: str, *arguments: Any, sender: str | None = None, value: int = 0, block: str = "latest"
    ) -> Any:
        """What a function returns: its value, or all of them in a tuple. No gas is named: the node's limit holds.

        RevertError, in words, where the contract refuses; NodeError where the node fails.
        """
        request = {"to": self.address, "data": to_hex(self.encode(function, *arguments))}
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
            return self.decode(function, answer)
        except ValueError:
            what = "there is none" if not answer else f"it answered {function} with {len(answer)} bytes of another kind"
            raise NodeError(
                f"the address {self.address} is no {self.name} on chain {self.connection.chain_id}: {what}"
            ) from None

    def gas(self, function: str, *arguments: Any) -> int | None:
        """The exact gas of the execution of a read call; None where the node takes no state overrides, or gives a call
        too little to count it.
        """
        from ..chain.node import METER

        # a contract that counts gas is placed beside this one, for the length of the call
        data = bytes(12) + bytes.fromhex(self.address[2:]) + bytes(32) + self.encode(function, *arguments)
        request = {"to": to_hex(METER), "data": to_hex(data)}
        code = {to_hex(METER): {"code": to_hex(artifact("Meter").runtime)}}
        try:
            answer = self.connection.data("eth_call", request, "latest", code)
        except RevertError as error:
            raise in_words(error) from None
        except (NodeBusyError, NodeTimeoutError, NodeUnreachableError):
            raise
        except (NodeError, OutOfGasError):
            return None
        return int.from_bytes(answer[:32], "big") if len(answer) > 32 else None


def _kind(parameter: dict[str, Any]) -> str:
    from eth_utils.abi import collapse_if_tuple

    return collapse_if_tuple(parameter)


def constructor_arguments(name: str, *arguments: Any) -> bytes:
    """What follows the creation code of an artifact."""
    from eth_abi.abi import encode
    from eth_utils.abi import get_abi_input_types

    entry = next(entry for entry in artifact(name).abi if entry["type"] == "constructor")
    return encode(get_abi_input_types(cast("ABIElement", entry)), arguments)
