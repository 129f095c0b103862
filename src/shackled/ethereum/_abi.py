"""The ABI: calls of functions, their results, and errors."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any, cast

from ..errors import InputError
from ._encoding import keccak256

if TYPE_CHECKING:
    from eth_abi.codec import ABICodec
    from eth_typing import ABIComponent, ABIConstructor, ABIFunction

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
        """Encode a call: selector and arguments. InputError, which names the parameter, for a wrong value."""
        from eth_utils.abi import function_abi_to_4byte_selector

        entry = self._functions[function]
        return function_abi_to_4byte_selector(entry) + _encode(entry, arguments, function)

    def decode(self, function: str, answer: bytes) -> Any:
        """Decode the output of a function: its value, or a tuple of several.

        Raises ValueError if the output is invalid.
        """
        from eth_abi.abi import decode
        from eth_abi.exceptions import DecodingError
        from eth_utils.abi import get_abi_output_types

        try:
            values = decode(get_abi_output_types(self._functions[function]), answer)
        except (DecodingError, OverflowError, UnicodeDecodeError) as error:
            raise ValueError(f"{len(answer)} bytes are not an output of {function}: {error}") from error
        return values[0] if len(values) == 1 else values

    def construct(self, *arguments: Any) -> bytes:
        """Encode the arguments of the constructor, which are appended to the creation code. InputError as `encode`."""
        entry = next(entry for entry in self._abi if entry["type"] == "constructor")
        return _encode(cast("ABIConstructor", entry), arguments, "the constructor")

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


def _encode(entry: ABIConstructor | ABIFunction, arguments: Sequence[Any], name: str) -> bytes:
    from eth_abi.abi import encode
    from eth_abi.exceptions import EncodingError
    from eth_utils.abi import get_abi_input_types

    kinds = get_abi_input_types(entry)
    try:
        return encode(kinds, arguments)
    except (EncodingError, UnicodeEncodeError):
        for parameter, kind, value in zip(entry["inputs"], kinds, arguments, strict=True):
            try:
                encode([kind], [value])
            except (EncodingError, UnicodeEncodeError):
                which = f"{parameter.get('name')} of {name}".strip()
                raise InputError(f"{which} must be a {kind}, not {value!r:.60}") from None
        raise


def error_table(abi: Iterable[Mapping[str, Any]]) -> dict[bytes, tuple[str, list[tuple[str, str]]]]:
    """Return name and parameters of the errors of an ABI, by selector. The type of a struct is a tuple."""
    table = {}
    for entry in abi:
        if entry["type"] == "error":
            parameters = [(parameter["name"], _type_of(parameter)) for parameter in entry["inputs"]]
            signature = f"{entry['name']}({','.join(kind for _, kind in parameters)})"
            table[keccak256(signature.encode())[:4]] = (entry["name"], parameters)
    return table


def _type_of(parameter: Mapping[str, Any]) -> str:
    """Return the type of a parameter in signatures."""
    if not parameter["type"].startswith("tuple"):
        return str(parameter["type"])
    from eth_utils.abi import collapse_if_tuple

    return collapse_if_tuple(cast("ABIComponent", parameter))


#: Errors of Solidity itself: `require` and `revert` with a text, and failed checks.
SOLIDITY_ERRORS = error_table(
    [
        {"type": "error", "name": "Error", "inputs": [{"name": "message", "type": "string"}]},
        {"type": "error", "name": "Panic", "inputs": [{"name": "code", "type": "uint256"}]},
    ]
)


def decode_error(data: bytes, errors: Errors) -> tuple[str, dict[str, Any]] | None:
    """Return the name of an error and its values by name, from the data of a revert; None if it is not in `errors`.

    A value without a name is called by its type. Bytes of a text that are not UTF-8 are replaced.
    """
    from eth_abi.exceptions import DecodingError

    if data[:4] not in errors:
        return None
    name, parameters = errors[data[:4]]
    try:
        values = _tolerant_codec().decode([kind for _, kind in parameters], data[4:])
    except (DecodingError, OverflowError):
        return None
    return name, {label or kind: value for (label, kind), value in zip(parameters, values, strict=True)}


@cache
def _tolerant_codec() -> ABICodec:
    """Return a decoder that replaces bytes of texts that are not UTF-8."""
    from eth_abi.codec import ABICodec
    from eth_abi.decoding import StringDecoder
    from eth_abi.registry import BaseEquals, registry

    tolerant = registry.copy()  # type: ignore[no-untyped-call]
    tolerant.unregister_decoder("string")
    decoder = StringDecoder("replace")  # type: ignore[no-untyped-call]
    tolerant.register_decoder(BaseEquals("string"), decoder, label="string")  # type: ignore[no-untyped-call]
    return ABICodec(tolerant)
