"""Values that the author gives: for the constructor, and for calls such as `mint{value: 0.1 ether}(3) x 5`."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..base.untrusted import read_json
from ..deploy._contract import CONTRACTS
from ..errors import InputError
from ..ethereum._abi import Interface, whole_numbers
from ..ethereum._amounts import ETHER, GWEI
from ..ethereum._encoding import parse_address
from ._project import Compiled

CALL = re.compile(
    r"\s*(?P<name>\w+)\s*(?:\{\s*value:\s*(?P<value>[^{}]*?)\s*\})?"
    r"\s*\((?P<arguments>.*)\)\s*(?:x\s*(?P<times>[1-9]\d{0,5}))?\s*",
    re.DOTALL | re.ASCII,
)
AMOUNT = re.compile(r"(\d{1,30})(?:\.(\d{1,30}))?\s*(wei|gwei|ether)?", re.ASCII)
UNITS = {None: 1, "wei": 1, "gwei": GWEI, "ether": ETHER}


@dataclass(frozen=True)
class Call:
    """A call of the contract. data: with the selector. value: in wei. times: how often it is sent. text: as given."""

    data: bytes
    value: int
    times: int
    text: str


def parse_call(text: str, contract: Compiled) -> Call:
    """Read a call of a function, as in Solidity. InputError if the contract has no such function."""
    match = CALL.fullmatch(text)
    if not match:
        raise InputError(f"a call must be like mint(3) or mint{{value: 0.1 ether}}(3) x 5, not {text!r}")
    values = _split(match["arguments"])
    entries = [each for each in contract.abi if each["type"] == "function" and each["name"] == match["name"]]
    fitting = [each for each in entries if len(each["inputs"]) == len(values)]
    if not fitting:
        names = sorted({each["name"] for each in contract.abi if each["type"] == "function"})
        wanted = " or ".join(str(len(each["inputs"])) for each in entries)
        known = f"it takes {wanted} values" if entries else f"its functions are {', '.join(names)}"
        raise InputError(f"{contract.name} has no function {match['name']} of {len(values)} values: {known}")
    wei = _wei(match["value"], match["name"]) if match["value"] is not None else 0
    refused: list[str] = []
    for entry in fitting:
        if wei and entry.get("stateMutability", "payable") != "payable":
            refused.append(f"{match['name']} is not payable: leave out its value")
            continue
        try:
            return Call(_encoded(entry, values), wei, int(match["times"] or 1), text)
        except InputError as error:
            refused.append(str(error))
    raise InputError("; or ".join(dict.fromkeys(refused)))


def _encoded(entry: Mapping[str, Any], values: Sequence[str]) -> bytes:
    what = [f"{entry['name']}: {each['name'] or each['type']}" for each in entry["inputs"]]
    parsed = [parse_value(*each) for each in zip(values, entry["inputs"], what, strict=True)]
    return Interface([entry]).encode(entry["name"], *parsed)


def _wei(text: str, name: str) -> int:
    """Return an amount in wei, without rounding."""
    match = AMOUNT.fullmatch(text.replace("_", ""))
    if match:
        decimals = match[2] or ""
        scale: int = 10 ** len(decimals)
        wei, rest = divmod(int(match[1] + decimals) * UNITS[match[3]], scale)
        if not rest:
            return wei
    raise InputError(
        f"the value of {name} must be whole in wei, such as 0.07 ether, 20 gwei or 1000000 wei, not {text!r:.60}"
    )


def constructor_arguments(contract: Compiled, given: Sequence[str], addresses: Mapping[str, bytes]) -> bytes:
    """Return the encoded arguments of the constructor.

    Parameters that are contracts of the package are filled in; `given` are values of the others, in their order.
    addresses: of the contracts of the package. InputError if there are too few or too many.
    """
    entry = next((each for each in contract.abi if each["type"] == "constructor"), None)
    if entry is None:
        if given:
            raise InputError(f"the constructor of {contract.name} takes no value, but {given[0]!r} was given")
        return b""
    waiting, values = list(given), []
    for number, parameter in enumerate(entry["inputs"], 1):
        name = contract_of(parameter)
        if name is not None:
            values.append(addresses[name])
        elif waiting:
            what = f"{parameter['name'] or f'value {number}'} of the constructor"
            values.append(parse_value(waiting.pop(0), parameter, what))
        else:
            raise InputError(
                f"the constructor of {contract.name} needs {parameter['name'] or 'a value'} ({parameter['type']}): "
                "give it with `arg`"
            )
    if waiting:
        raise InputError(
            f"the constructor of {contract.name} takes {len(given) - len(waiting)} values, not {len(given)}"
        )
    return Interface([entry]).construct(*values)


def contract_of(parameter: Mapping[str, Any]) -> str | None:
    """Return which contract of the package a parameter is, by its type or its name; None if it is none of them."""
    if parameter["type"] != "address":
        return None
    kind = str(parameter.get("internalType", "")).removeprefix("contract ")
    plain = str(parameter["name"]).strip("_").lower()
    for name in CONTRACTS:
        if kind in (name, f"I{name}") or (kind == "address" and plain == name.lower()):
            return name
    return None


def parse_value(text: str, parameter: Mapping[str, Any], what: str) -> Any:
    """Read a value of a type of the ABI: numbers, addresses, true and false, text, bytes in hexadecimal, JSON lists.

    what: the parameter, for the InputError.
    """
    kind = str(parameter["type"])
    if kind.endswith("]") or kind.startswith("tuple"):
        try:
            value = read_json(text)
        except ValueError:
            value = text
        return _nested(value, parameter, what)
    return _single(text, kind, what)


def _nested(value: Any, parameter: Mapping[str, Any], what: str) -> Any:
    kind = str(parameter["type"])
    array = re.fullmatch(r"(.*)\[(\d*)\]", kind)
    if array and isinstance(value, list) and array[2] in ("", str(len(value))):
        return [_nested(each, {**parameter, "type": array[1]}, what) for each in value]
    if kind == "tuple" and isinstance(value, list) and len(value) == len(parameter["components"]):
        return tuple(_nested(each, part, what) for each, part in zip(value, parameter["components"], strict=True))
    is_list = array is not None or kind == "tuple"
    if is_list or value is None or isinstance(value, list | dict):
        wanted = "a JSON list" if is_list else "a value"
        raise InputError(f"{what} must be {wanted} of the type {kind}, not {json.dumps(value):.60}")
    return _single(value if isinstance(value, str) else json.dumps(value), kind, what)


def _single(text: str, kind: str, what: str) -> Any:
    """Read a value that has no parts."""
    text = text.strip()
    if kind == "address":
        return parse_address(text, what)
    shown = repr(text)
    try:
        if kind == "string":
            said = json.loads(text) if text[:1] == '"' else text
            said.encode()
            return said
        if kind == "bool":
            return {"true": True, "false": False}[text]
        if kind.startswith("bytes"):
            content = bytes.fromhex(text.removeprefix("0x"))
            if kind == "bytes" or len(content) == int(kind[5:]):
                return content
            shown = f"{len(content)} bytes"
        else:
            number = int(text.replace("_", ""), 0)
            if number in whole_numbers(kind):
                return number
            shown = text
    except (ValueError, KeyError):
        pass
    how = ", in hexadecimal" if kind.startswith("bytes") else ""
    raise InputError(f"{what} must be of the type {kind}{how}, not {shown:.80}")


def _split(text: str) -> list[str]:
    """Split at the commas that are neither in brackets nor in quotes."""
    parts, depth, quoted, part = [], 0, False, ""
    for letter in text:
        quoted ^= letter == '"'
        depth += (letter in "[(") - (letter in "])") if not quoted else 0
        if letter == "," and not depth and not quoted:
            parts.append(part)
            part = ""
        else:
            part += letter
    return [*parts, part] if parts or part.strip() else []
