"""Print the gas of one function of a contract: its basic blocks with counts, gas and instructions.

    python tools/gas_blocks.py teapot                              the functions of the engine, most gas first
    python tools/gas_blocks.py teapot LinearSpans.draw              the blocks of one of them
    python tools/gas_blocks.py --call Genesis 0x5d6c... Layouts.fits    of a call of another contract, by its data

For a scene (a file or the name of a dataset piece) the call is `Renderer.render`. Look for repetition: a value that is
unpacked from a word at each use, and long sequences of DUP and SWAP, mean that the function has too many variables.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from shackled import load
from shackled.artifacts import artifact
from shackled.errors import ShackledError
from shackled.ethereum._encoding import instructions
from shackled.gas import render_call
from shackled.gas._source_map import source_map
from shackled.gas._trace import CallFrame, trace

#: JUMPDEST begins a basic block; STOP, JUMP, JUMPI, RETURN, REVERT and INVALID end one.
JUMPDEST, ENDS = 0x5B, {0x00, 0x56, 0x57, 0xF3, 0xFD, 0xFE}


@dataclass(frozen=True)
class Block:
    """A basic block: instructions that are always executed together.

    begin: the position of the first. count: how often the block was executed. instructions: as text, pushed values in
    hexadecimal digits.
    """

    begin: int
    count: int
    gas: int
    instructions: tuple[str, ...]


def functions(root: CallFrame, contract: str) -> list[tuple[str, int]]:
    """Return the functions of a contract called below a frame, with their own gas, the most expensive first."""
    gas: Counter[str] = Counter()
    for frame in _frames(root, contract):
        gas[_name(frame)] += frame.gas()
    return gas.most_common()


def blocks(root: CallFrame, contract: str, function: str) -> list[Block]:
    """Return the blocks of a function that were executed, in the order of the code, with the gas of each."""
    from eth.vm.forks.cancun.opcodes import CANCUN_OPCODES

    opcodes: dict[int, Any] = CANCUN_OPCODES
    costs: Counter[int] = Counter()
    counts: Counter[int] = Counter()
    for frame in _frames(root, contract):
        if _name(frame) == function:
            for each in frame.costs.values():
                costs.update(each)
            counts += frame.counts
    found: list[Block] = []
    for block in _split(artifact(contract).runtime):
        gas = sum(costs[at] for at, _, _ in block)
        if gas:
            texts = (f"0x{pushed.hex()}" if pushed else _mnemonic(opcodes.get(op), op) for _, op, pushed in block)
            found.append(Block(block[0][0], counts[block[0][0]], gas, tuple(texts)))
    return found


def _frames(root: CallFrame, contract: str) -> list[CallFrame]:
    return [frame for frame in root.frames() if frame.contract == contract]


def _name(frame: CallFrame) -> str:
    return source_map(frame.contract).entries.get(frame.entry, frame.contract)


def _mnemonic(opcode: Any, op: int) -> str:
    return str(getattr(opcode, "mnemonic", "INVALID" if op == 0xFE else f"opcode {op:02x}"))


def _split(code: bytes) -> list[list[tuple[int, int, bytes]]]:
    """Return position, opcode and pushed bytes of each instruction, by blocks."""
    found: list[list[tuple[int, int, bytes]]] = [[]]
    for at, end in pairwise([*instructions(code), len(code)]):
        op = code[at]
        if op == JUMPDEST and found[-1]:
            found.append([])
        found[-1].append((at, op, code[at + 1 : end]))
        if op in ENDS:
            found.append([])
    return [block for block in found if block]


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the functions of a contract, or the blocks of one, by their gas."""
    text = __doc__ or ""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", nargs="?", help="a scene, unless there is --call")
    parser.add_argument("function", nargs="?", help="such as Rasterizer.rows; none: a list of all")
    parser.add_argument("--call", nargs=2, metavar=("CONTRACT", "DATA"), help="call this contract with these bytes")
    parser.add_argument("--contract", help="whose functions; else Engine, or the one that is called")
    options = parser.parse_args(arguments)
    # with --call there is no scene, and what comes first is the function
    function = options.input if options.call else options.function
    if not options.call and options.input is None:
        parser.error("a scene or --call is needed")
    try:
        if options.call:
            called, data = options.call[0], bytes.fromhex(options.call[1].removeprefix("0x"))
        else:
            called, data = "Renderer", render_call(load(options.input))
        root, result = trace(called, data)
    except (ShackledError, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    contract = options.contract or (called if options.call else "Engine")
    print(f"{result.gas:,} gas in all")
    return _print_functions(root, contract) if function is None else _print_blocks(root, contract, function)


def _print_functions(root: CallFrame, contract: str) -> int:
    for name, gas in functions(root, contract):
        print(f"{gas:12,} {name}")
    return 0


def _print_blocks(root: CallFrame, contract: str, function: str) -> int:
    found = blocks(root, contract, function)
    if not found:
        print(f"{function} was not called in {contract}", file=sys.stderr)
        return 1
    for block in found:
        print(f"{block.begin:6} x {block.count:<8,}{block.gas:10,} gas  {' '.join(block.instructions)}")
    print(f"{sum(block.gas for block in found):,} gas in {function}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
