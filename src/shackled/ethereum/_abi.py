"""The ABI: calls of functions, their results, and errors."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

from ._encoding import keccak256

if TYPE_CHECKING:
    from eth_typing import ABIElement, ABIFunction

#: Name and parameters (name, type) of errors, by selector.
Errors = Mapping[bytes, tuple[str, list[tuple[str, str]]]]


class Interface:
    """The functions and the constructor of a contract.

    A function is selected by its name, or by its signature where several have the same name.
    """

    def __init__(self, abi: Iterable[Mapping[str, Any]]) -> None:
        """Take the entries of an ABI."""
        self._abi = list(abi)

    def encode(self, function: str, *arguments: Any) -> bytes:
        """Encode a call: selector and arguments."""
        from eth_abi.abi import encode
        from eth_utils.abi import function_abi_to_4byte_selector, get_abi_input_types

        entry = self._functions[function]
        return function_abi_to_4byte_selector(entry) + encode(get_abi_input_types(entry), arguments)

    def decode(self, function: str, answer: bytes) -> Any:
        """Decode the output of a function: its value, or a tuple of several.

        Raises ValueError if the output is invalid.
        """
        from eth_abi.abi import decode
        from eth_abi.exceptions import DecodingError
        from eth_utils.abi import get_abi_output_types

        try:
            values = decode(get_abi_output_types(self._functions[function]), answer)
        except (DecodingError, OverflowError) as error:
            raise ValueError(f"{len(answer)} bytes are not an output of {function}: {error}") from None
        return values[0] if len(values) == 1 else values

    def construct(self, *arguments: Any) -> bytes:
        """Encode the arguments of the constructor, which are appended to the creation code."""
        from eth_abi.abi import encode
        from eth_utils.abi import get_abi_input_types

        entry = next(entry for entry in self._abi if entry["type"] == "constructor")
        return encode(get_abi_input_types(cast("ABIElement", entry)), arguments)

    def parameter_type(self, function: str, number: int = 0) -> str:
        """Return the type of a parameter for eth_abi, where a struct is a tuple such as "(uint256,bytes)"."""
        from eth_utils.abi import get_abi_input_types

        return get_abi_input_types(self._functions[function])[number]

    @cached_property
    def _functions(self) -> dict[str, ABIFunction]:
        from eth_utils.abi import abi_to_signature

        functions: dict[str, ABIFunction] = {}
        for entry in self._abi:
            if entry["type"] == "function":
                function = cast("ABIFunction", entry)
                functions[abi_to_signature(function)] = function
                functions.setdefault(entry["name"], function)
        return functions


def error_table(abi: Iterable[Mapping[str, Any]]) -> dict[bytes, tuple[str, list[tuple[str, str]]]]:
    """Return name and parameters of the errors of an ABI, by selector. Structs are not supported."""
    table = {}
    for entry in abi:
        if entry["type"] == "error":
            parameters = [(parameter["name"], parameter["type"]) for parameter in entry["inputs"]]
            signature = f"{entry['name']}({','.join(kind for _, kind in parameters)})"
            table[keccak256(signature.encode())[:4]] = (entry["name"], parameters)
    return table


#: Errors of Solidity itself: `require` and `revert` with a text, and failed checks.
SOLIDITY_ERRORS = error_table(
    [
        {"type": "error", "name": "Error", "inputs": [{"name": "message", "type": "string"}]},
        {"type": "error", "name": "Panic", "inputs": [{"name": "code", "type": "uint256"}]},
    ]
)


def decode_error(data: bytes, errors: Errors) -> tuple[str, dict[str, Any]] | None:
    """Return the name of an error and its values by name, from the data of a revert; None if it is not in `errors`.

    A value without a name is called by its type.
    """
    from eth_abi.abi import decode
    from eth_abi.exceptions import DecodingError

    if data[:4] not in errors:
        return None
    name, parameters = errors[data[:4]]
    try:
        values = decode([kind for _, kind in parameters], data[4:])
    except (DecodingError, OverflowError):
        return None
    return name, {label or kind: value for (label, kind), value in zip(parameters, values, strict=True)}
