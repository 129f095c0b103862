"""Contracts of a few instructions, for previews without a compiler."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from eth_abi.abi import encode

from shackled.preview._project import Compiled, Project

RETURN, REVERT = 0xF3, 0xFD
#: An endless loop, and memory that costs more gas than one transaction may take.
ENDLESS, DEAR = bytes.fromhex("5b600056"), bytes.fromhex("6000622e00005200")
SVG = "<svg xmlns='http://www.w3.org/2000/svg'/>"


def function(name: str, *inputs: str, output: str = "string", **more: Any) -> dict[str, Any]:
    """Return an entry of an ABI."""
    parameters = [{"name": f"value{number}", "type": kind} for number, kind in enumerate(inputs)]
    return {"type": "function", "name": name, "inputs": parameters, "outputs": [{"name": "", "type": output}], **more}


def contract(runtime: bytes, *entries: dict[str, Any]) -> Compiled:
    """Return a contract that has this code, and by default a function `image(uint256)`."""
    head = bytes.fromhex("61") + len(runtime).to_bytes(2, "big") + bytes.fromhex("80600a5f395ff3")
    return Compiled("Small", list(entries) or [function("image", "uint256")], head + runtime)


def answering(zero: bytes, other: bytes = b"", zero_ends: int = RETURN) -> bytes:
    """Return code that answers calls for 0 with one output, or reverts with it, and calls for other numbers."""

    def part(data: bytes, place: int, end: int) -> bytes:
        size = len(data).to_bytes(2, "big")
        # CODECOPY(0, place, size), then the end with (0, size)
        return b"\x61" + size + b"\x61" + place.to_bytes(2, "big") + b"\x5f\x39\x61" + size + b"\x5f" + bytes([end])

    length = len(part(b"", 0, 0))
    # the number, and a jump behind the first part if it is not 0
    head = bytes.fromhex("60043560") + bytes([6 + length]) + b"\x57"
    place = len(head) + 2 * length + 1
    return head + part(zero, place, zero_ends) + b"\x5b" + part(other, place + len(zero), RETURN) + zero + other


def drawing(call: bytes, renderer: bytes) -> bytes:
    """Return code that calls a renderer, and answers or reverts with what it returns."""
    size, end = len(call).to_bytes(2, "big").hex(), "3d5f5f3e602f573d5ffd5b3d5ff3"
    return bytes.fromhex(f"61{size}6100335f395f5f61{size}5f73{renderer.hex()}5afa{end}") + call


def output(value: str | bytes) -> bytes:
    """Return the output of a function that returns text."""
    return encode(["bytes"], [value.encode() if isinstance(value, str) else value])


class Made(Project):
    """A project that is compiled already."""

    def __init__(self, source: Path, found: Compiled) -> None:
        super().__init__(source)
        self.found = found

    def compile(self) -> list[Compiled]:
        return [self.found]
