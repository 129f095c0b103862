"""The ABI: calls of functions, their results, and errors."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache, cached_property
from typing import Any

from ..errors import InputError
from ._encoding import keccak256, parse_address, to_hex, word

#: Name and parameters (name, type) of errors, by selector.
Errors = Mapping[bytes, tuple[str, list[tuple[str, str]]]]


class Interface:
    """The functions and the constructor of a contract.

    A function is selected by its name, or by its signature where several have the same name.
    """

    def __init__(self, abi: Iterable[Mapping[str, Any]]) -> None:
        self._abi = list(abi)

    def encode(self, function: str, *arguments: Any) -> bytes:
        """Encode a call: selector and arguments. InputError, which names the parameter, for a wrong value."""
        entry = self._functions[function]
        return _selector(entry) + _encode(entry, arguments, function)

    def decode(self, function: str, answer: bytes) -> Any:
        """Decode the output of a function: its value, or a tuple of several.

        Raises ValueError if the output is invalid.
        """
        try:
            values = decode_values([_type_of(each) for each in self._functions[function]["outputs"]], answer)
        except ValueError as error:
            raise ValueError(f"{len(answer)} bytes are not an output of {function}: {error}") from error
        return values[0] if len(values) == 1 else values

    def construct(self, *arguments: Any) -> bytes:
        """Encode the arguments of the constructor, which are appended to the creation code. InputError as `encode`."""
        entry = next(entry for entry in self._abi if entry["type"] == "constructor")
        return _encode(entry, arguments, "the constructor")

    def parameter_type(self, function: str) -> str:
        """Return the type of the first parameter, where a struct is a tuple such as "(uint256,bytes)"."""
        return _type_of(self._functions[function]["inputs"][0])

    @cached_property
    def _functions(self) -> dict[str, Mapping[str, Any]]:
        functions: dict[str, Mapping[str, Any]] = {}
        for entry in self._abi:
            if entry["type"] == "function":
                functions[_signature(entry)] = entry
                functions.setdefault(entry["name"], entry)
        return functions


def _encode(entry: Mapping[str, Any], arguments: Sequence[Any], name: str) -> bytes:
    kinds = [_type_of(each) for each in entry["inputs"]]
    for parameter, kind, value in zip(entry["inputs"], kinds, arguments, strict=True):
        try:
            encode_values([kind], [value])
        except ValueError:
            which = f"{parameter.get('name')} of {name}".strip()
            raise InputError(f"{which} must be a {kind}, not {value!r:.60}") from None
    return encode_values(kinds, arguments)


def _signature(entry: Mapping[str, Any]) -> str:
    return f"{entry['name']}({','.join(map(_type_of, entry['inputs']))})"


def _selector(entry: Mapping[str, Any]) -> bytes:
    return keccak256(_signature(entry).encode())[:4]


def _type_of(parameter: Mapping[str, Any]) -> str:
    """Return the type of a parameter in signatures."""
    kind: str = parameter["type"]
    if not kind.startswith("tuple"):
        return kind
    return f"({','.join(map(_type_of, parameter['components']))}){kind.removeprefix('tuple')}"


# ---- values ----


def encode_values(kinds: Sequence[str], values: Sequence[Any]) -> bytes:
    """Encode values of these types. ValueError for a value that is not of its type.

    An array or struct is a list or tuple, an address is text or 20 bytes.
    """
    heads, tails = [], b""
    size = sum(map(_size, kinds))
    for kind, value in zip(kinds, values, strict=True):
        data = _encoded(kind, value)
        if _is_dynamic(kind):
            heads.append(word(size + len(tails)))
            tails += data
        else:
            heads.append(data)
    return b"".join(heads) + tails


def decode_values(kinds: Sequence[str], data: bytes, texts: str = "strict") -> tuple[Any, ...]:
    """Decode values of these types: arrays and structs as tuples, addresses as text without capitals.

    texts: what becomes of bytes of a text that are not UTF-8, as `bytes.decode` names it. ValueError if the data are
    cut or invalid, which includes bits that are not zero beside a value.
    """
    return _decoded_all(kinds, data, 0, texts)


@cache
def _parts(kind: str) -> tuple[str, list[str]]:
    """Return what a type is, "[]", "()" or itself, and the types of its elements. An array [n] is as a struct of n."""
    if kind.endswith("]"):
        element, _, count = kind[:-1].rpartition("[")
        return ("()", [element] * int(count)) if count else ("[]", [element])
    if not kind.startswith("("):
        return kind, []
    found, depth = [""], 0
    for each in kind[1:-1]:
        depth += (each == "(") - (each == ")")
        if each == "," and not depth:
            found.append("")
        else:
            found[-1] += each
    return "()", found


@cache
def _is_dynamic(kind: str) -> bool:
    what, inner = _parts(kind)
    return what in ("bytes", "string", "[]") or any(map(_is_dynamic, inner))


@cache
def _size(kind: str) -> int:
    """Return the bytes that a value takes in place: for a dynamic one, those of its offset."""
    what, inner = _parts(kind)
    return sum(map(_size, inner)) if what == "()" and not _is_dynamic(kind) else 32


def _encoded(kind: str, value: Any) -> bytes:
    what, inner = _parts(kind)
    if inner:
        if not isinstance(value, list | tuple):
            raise ValueError(f"{value!r:.60} is not a list or tuple")
        if what == "()":
            return encode_values(inner, value)
        return word(len(value)) + encode_values(inner * len(value), value)
    if what == "string" and isinstance(value, str):
        value = value.encode()
    elif what == "address":
        value = parse_address(value, "the value") if isinstance(value, str) else value
        if isinstance(value, bytes) and len(value) == 20:
            return word(value)
    elif what == "bool" and isinstance(value, bool):
        return word(int(value))
    elif isinstance(value, int) and not isinstance(value, bool) and value in whole_numbers(what):
        return word(value % (1 << 256))
    if what in ("string", "bytes") and isinstance(value, bytes):
        return word(len(value)) + value.ljust(-(-len(value) // 32) * 32, b"\0")
    if (length := _fixed(what)) and isinstance(value, bytes) and len(value) <= length:
        return value.ljust(32, b"\0")
    raise ValueError(f"{value!r:.60} is not a {kind}")


def _decoded_all(kinds: Sequence[str], data: bytes, start: int, texts: str) -> tuple[Any, ...]:
    values, at = [], start
    for kind in kinds:
        place = start + int.from_bytes(_piece(data, at, 32), "big") if _is_dynamic(kind) else at
        values.append(_decoded(kind, data, place, texts))
        at += _size(kind)
    return tuple(values)


def _decoded(kind: str, data: bytes, at: int, texts: str) -> Any:
    what, inner = _parts(kind)
    if what == "()":
        return _decoded_all(inner, data, at, texts)
    piece = _piece(data, at, 32)
    value = int.from_bytes(piece, "big")
    if what == "[]":
        if value * _size(inner[0]) > len(data):
            raise ValueError(f"{len(data)} bytes do not hold {value} times {inner[0]}")
        return _decoded_all(inner * value, data, at + 32, texts)
    if what in ("string", "bytes"):
        whole = _piece(data, at + 32, -(-value // 32) * 32)
        if any(whole[value:]):
            raise ValueError(f"the bytes after a {kind} are not zero")
        return whole[:value].decode(errors=texts) if what == "string" else whole[:value]
    if length := _fixed(what):
        if any(piece[length:]):
            raise ValueError(f"the bytes after a {kind} are not zero")
        return piece[:length]
    if what == "address" and not any(piece[:12]):
        return to_hex(piece[12:])
    if what == "bool" and value <= 1:
        return bool(value)
    allowed = whole_numbers(what)
    value -= (value >> 255 << 256) if allowed.start else 0
    if value in allowed:
        return value
    raise ValueError(f"{to_hex(piece)} is not a {kind}")


def _piece(data: bytes, at: int, size: int) -> bytes:
    if at + size > len(data):
        raise ValueError(f"{len(data)} bytes end before byte {at + size}")
    return data[at : at + size]


@cache
def whole_numbers(kind: str) -> range:
    """Return the values of a type of whole numbers such as int256; none for another type."""
    match = re.fullmatch(r"(u?)int(\d+)", kind)
    if match is None:
        return range(0)
    count = 1 << int(match[2])
    return range(count) if match[1] else range(-count // 2, count // 2)


@cache
def _fixed(kind: str) -> int:
    """Return the number of bytes of a type such as bytes32; 0 for another type."""
    match = re.fullmatch(r"bytes(\d+)", kind)
    return int(match[1]) if match else 0


# ---- errors ----


def error_table(abi: Iterable[Mapping[str, Any]]) -> dict[bytes, tuple[str, list[tuple[str, str]]]]:
    """Return name and parameters of the errors of an ABI, by selector. The type of a struct is a tuple."""
    table = {}
    for entry in abi:
        if entry["type"] == "error":
            parameters = [(parameter["name"], _type_of(parameter)) for parameter in entry["inputs"]]
            table[_selector(entry)] = (entry["name"], parameters)
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

    A value without a name is called by its type. Bytes of a text that are not UTF-8 are replaced.
    """
    if data[:4] not in errors:
        return None
    name, parameters = errors[data[:4]]
    try:
        values = decode_values([kind for _, kind in parameters], data[4:], "replace")
    except ValueError:
        return None
    return name, {label or kind: value for (label, kind), value in zip(parameters, values, strict=True)}
