"""The gas of one function: its basic blocks with their executions and instructions."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from ..artifacts import artifact
from ._source_map import source_map
from ._trace import Frame

_ADD_TO_SIGNEXTEND = ("ADD", "MUL", "SUB", "DIV", "SDIV", "MOD", "SMOD", "ADDMOD", "MULMOD", "EXP", "SIGNEXTEND")
_LT_TO_SAR = ("LT", "GT", "SLT", "SGT", "EQ", "ISZERO", "AND", "OR", "XOR", "NOT", "BYTE", "SHL", "SHR", "SAR")
_NAMES = {
    0x00: "STOP",
    **dict(enumerate(_ADD_TO_SIGNEXTEND, 0x01)),
    **dict(enumerate(_LT_TO_SAR, 0x10)),
    0x20: "KECCAK256",
    0x35: "CALLDATALOAD",
    0x36: "CALLDATASIZE",
    0x37: "CALLDATACOPY",
    0x3D: "RETURNDATASIZE",
    0x3E: "RETURNDATACOPY",
    0x50: "POP",
    0x51: "MLOAD",
    0x52: "MSTORE",
    0x53: "MSTORE8",
    0x56: "JUMP",
    0x57: "JUMPI",
    0x5A: "GAS",
    0x5B: "JUMPDEST",
    0x5E: "MCOPY",
    0x5F: "PUSH0",
    0xF3: "RETURN",
    0xFA: "STATICCALL",
    0xFD: "REVERT",
    0xFE: "INVALID",
}
#: Gas of instructions with a constant price other than 3.
_PRICES = {
    **dict.fromkeys((0x02, 0x04, 0x05, 0x06, 0x07, 0x0B), 5),
    **dict.fromkeys((0x08, 0x09, 0x56), 8),
    **dict.fromkeys((0x36, 0x3D, 0x50, 0x5A, 0x5F), 2),
    0x57: 10,
    0x5B: 1,
}
_VARIES = {0x00, 0x0A, 0x20, 0x37, 0x3E, 0x51, 0x52, 0x53, 0x5E, *range(0xF0, 0x100)}
_JUMPDEST, _ENDS = 0x5B, {0x00, 0x56, 0x57, 0xF3, 0xFD, 0xFE}


@dataclass(frozen=True)
class Block:
    """A basic block.

    begin: position of the first instruction.
    count: number of executions.
    instructions: mnemonics; a push is its value in hexadecimal.
    """

    begin: int
    count: int
    gas: int
    instructions: tuple[str, ...]


def functions(root: Frame, contract: str) -> list[tuple[str, int]]:
    """Return the functions of a contract called below a frame, with their own gas, the most expensive first."""
    gas: Counter[str] = Counter()
    for frame in _frames(root, contract):
        gas[_name(frame)] += frame.gas()
    return gas.most_common()


def blocks(root: Frame, contract: str, function: str) -> list[Block]:
    """Return the executed blocks of a function, in the order of the code."""
    costs: Counter[int] = Counter()
    for frame in _frames(root, contract):
        if _name(frame) == function:
            for each in frame.costs.values():
                costs.update(each)
    found: list[Block] = []
    for block in _split(artifact(contract).runtime):
        gas = sum(costs[at] for at, _, _ in block)
        if gas:
            count = next((costs[at] // _PRICES.get(op, 3) for at, op, _ in block if op not in _VARIES), 0)
            found.append(Block(block[0][0], count, gas, tuple(text for _, _, text in block)))
    return found


def _frames(root: Frame, contract: str) -> list[Frame]:
    return [frame for frame in root.frames() if frame.contract == contract]


def _name(frame: Frame) -> str:
    return source_map(frame.contract).entries.get(frame.entry, frame.contract)


def _split(code: bytes) -> list[list[tuple[int, int, str]]]:
    """Return position, opcode and text of each instruction, by blocks."""
    found: list[list[tuple[int, int, str]]] = [[]]
    at = 0
    while at < len(code):
        op = code[at]
        size = op - 0x5F if 0x60 <= op <= 0x7F else 0
        if op == _JUMPDEST and found[-1]:
            found.append([])
        found[-1].append((at, op, _text(op, code[at + 1 : at + 1 + size])))
        if op in _ENDS:
            found.append([])
        at += 1 + size
    return [block for block in found if block]


def _text(op: int, pushed: bytes) -> str:
    if pushed:
        return f"0x{pushed.hex()}"
    if 0x80 <= op <= 0x9F:
        return f"{'DUP' if op < 0x90 else 'SWAP'}{op % 16 + 1}"
    return _NAMES.get(op, f"opcode {op:02x}")
