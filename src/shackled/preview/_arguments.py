"""Values that the author gives: for the constructor, and for calls such as `mint{value: 0.1 ether}(3) x 5`."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..deploy import CONTRACTS
from ..errors import InputError
from ..ethereum import ETHER, GWEI, Interface, parse_address
from ..untrusted import read_json
from ._project import Compiled

CALL = re.compile(
    r"\s*(?P<name>\w+)\s*(?:\{\s*value:\s*(?P<value>[\d._]+)\s*(?P<unit>wei|gwei|ether)?\s*\})?"
    r"\s*\((?P<arguments>.*)\)\s*(?:x\s*(?P<times>\d{1,6}))?\s*",
    re.DOTALL,
)
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
    entry = fitting[0]
    encoded = [
        parse_value(value, parameter, f"{match['name']}: {parameter['name'] or parameter['type']}")
        for value, parameter in zip(values, entry["inputs"], strict=True)
    ]
    wei = float(match["value"].replace("_", "")) * UNITS[match["unit"]] if match["value"] else 0
    return Call(Interface([entry]).encode(entry["name"], *encoded), int(wei), int(match["times"] or 1), text)


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
    for parameter in entry["inputs"]:
        name = contract_of(parameter)
        if name is not None:
            values.append(addresses[name])
        elif waiting:
            values.append(parse_value(waiting.pop(0), parameter, f"{parameter['name']} of the constructor"))
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
            listed = read_json(text)
        except ValueError:
            listed = None
        if not isinstance(listed, list):
            raise InputError(f"{what} must be a JSON list, for {kind}, not {text!r}")
        return _nested(listed, parameter, what)
    return _single(text, kind, what)


def _nested(value: Any, parameter: Mapping[str, Any], what: str) -> Any:
    """Convert the parts of a list or a tuple."""
    kind = str(parameter["type"])
    array = re.fullmatch(r"(.*)\[\d*\]", kind)
    if array and isinstance(value, list):
        return [_nested(each, {**parameter, "type": array[1]}, what) for each in value]
    if kind == "tuple" and isinstance(value, list) and len(value) == len(parameter["components"]):
        return tuple(_nested(each, part, what) for each, part in zip(value, parameter["components"], strict=True))
    if array or kind == "tuple" or isinstance(value, list | dict):
        raise InputError(f"{what} must be a list of the parts of {kind}, not {json.dumps(value)}")
    return _single(json.dumps(value) if isinstance(value, bool) else str(value), kind, what)


def _single(text: str, kind: str, what: str) -> Any:
    text = text.strip()
    try:
        if kind == "string":
            return json.loads(text) if text[:1] == '"' else text
        if kind == "bool":
            return {"true": True, "false": False}[text]
        if kind.startswith("bytes"):
            return bytes.fromhex(text.removeprefix("0x"))
        if kind == "address":
            return parse_address(text, what)
        return int(text.replace("_", ""), 0)
    except (ValueError, KeyError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{what} must be a value of the type {kind}, not {text!r}") from None


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
