"""Checks of a compiled contract: which memory its instructions may write, by a decoder of our own."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

#: Parameters of a region: the end of the stack, the EVM's memory and its size, gas, the state of the frame.
STACK, MEMORY, SIZE, _, STATE = range(5)
WORD, REACH = 32, 64
#: Bytes of the state that compiled code writes: end of the stack; position, gas and whether it gave up; operands.
WRITABLE = [(0, 4), (28, 44), (56, 152)]
#: Functions that are imported: the first lets memory grow.
IMPORTED = ["grow", "copy", "calculate", "memory"]
#: Functions before the regions: helpers, and `run`.
HELPERS = 11
WIDTHS = {0x36: 4, 0x37: 8, 0x3A: 1, 0x3C: 1}
#: Instructions of one operand.
UNARY = {0x45, 0x50, 0xA7, 0xAD, 0xFD00, 0xFD12, 0xFD1D, *range(0x28, 0x36)}
#: Those that are followed by a number, and by two.
ONE, TWO = (
    {0x02, 0x03, 0x04, 0x0C, 0x0D, 0x10, 0x12, 0x20, 0x21, 0x22},
    {0x11, 0x13, *range(0x28, 0x3F), 0xFD00, 0xFD0B},
)


class Reader:
    """Reads the binary format."""

    def __init__(self, data: bytes) -> None:
        self.data, self.at = data, 0

    def byte(self) -> int:
        self.at += 1
        return self.data[self.at - 1]

    def number(self, signed: bool = False) -> int:
        value = shift = 0
        while True:
            byte = self.byte()
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value - (1 << shift) if signed and byte & 64 else value

    def take(self, count: int) -> bytes:
        self.at += count
        return self.data[self.at - count : self.at]


def sections(module: bytes) -> dict[int, Reader]:
    """Return what sections contain, by number."""
    reader, found = Reader(module), {}
    assert reader.take(8) == b"\0asm\1\0\0\0"
    while reader.at < len(module):
        number = reader.byte()
        found[number] = Reader(reader.take(reader.number()))
    return found


def imports(module: bytes) -> list[str]:
    """Return the names of what a module imports."""
    reader = sections(module)[2]
    names = []
    for _ in range(reader.number()):
        assert reader.take(reader.number()) == b"evm"
        names.append(reader.take(reader.number()).decode())
        kind = reader.byte()
        reader.number()
        if kind == 2:
            reader.number()
    return names


def instructions(reader: Reader) -> Iterator[tuple[int, list[int]]]:
    """Read the instructions of a function: their codes, those of vectors from 0xFD00 on, and what follows them."""
    while reader.at < len(reader.data):
        code = reader.byte()
        more: list[int] = []
        if code == 0xFD:
            code = 0xFD00 + reader.number()
        if code in ONE:
            more = [reader.number()]
        elif code in TWO:
            more = [reader.number(), reader.number()]
        elif code in (0x41, 0x42):
            more = [reader.number(signed=True)]
        elif code in (0xFD0C, 0xFD0D):
            more = list(reader.take(16))
        elif code in (0xFD1D, 0xFD1E):
            more = [reader.byte()]
        yield code, more


@dataclass
class Block:
    """A block that is open, and what was known in front of it. grows: the end that memory has behind it."""

    memory: int
    checked: set[Any]
    grows: Any = None
    calls: bool = False


@dataclass
class Function:
    """Follows a region, and checks each store."""

    locals: dict[int, Any] = field(default_factory=dict)
    values: list[Any] = field(default_factory=list)
    blocks: list[Block] = field(default_factory=list)
    memory: int = 0
    checked: set[Any] = field(default_factory=set)
    #: Words below and above the end of the stack that are there, by the check at entry.
    below: int = -1
    above: int = -1
    stores: int = 0
    #: Calls after which memory may be elsewhere.
    moves: int = 0

    def store(self, base: Any, offset: int, width: int) -> None:
        self.stores += 1
        if base == ("local", STATE):
            assert any(begin <= offset and offset + width <= end for begin, end in WRITABLE), offset
        elif base == ("low",):
            first, last = WORD * (REACH - self.below), WORD * (REACH + self.above)
            assert first <= offset <= last - width, (offset, self.below, self.above)
        elif base == ("local", MEMORY):
            assert offset + width <= self.memory, (offset, width, self.memory)
        else:
            kind, where, moves = base
            assert (kind, moves) == ("address", self.moves)
            assert any(place == where and offset + width <= end for place, end in self.checked), base

    def pop(self) -> Any:
        return self.values.pop()

    def step(self, code: int, more: list[int]) -> None:
        """Follow an instruction; what it leaves is a value that later ones know by its form, or None."""
        values = self.values
        match code, more:
            case 0x20, [local]:
                values.append(self.locals.get(local, ("local", local)))
            case ((0x21 | 0x22), [local]):
                value = self.pop()
                # parameters, and what has no form of its own, are known by their number
                self.locals[local] = ("local", local) if value is None or local <= STATE else value
                if code == 0x22:
                    values.append(self.locals[local])
            case 0x41, [value]:
                values.append(value)
            case ((0x36 | 0x37 | 0x3A | 0x3C), [_, offset]):
                self.pop()
                self.store(self.pop(), offset, WIDTHS[code])
            case 0xFD0B, [_, offset]:
                self.pop()
                self.store(self.pop(), offset, 16)
            case 0x10, [function]:
                self.call(function)
            case 0x04, _:
                self.blocks.append(Block(self.memory, set(self.checked)))
                condition = self.pop()
                match condition:
                    case ("less", ("local", 2), int(end)):
                        self.blocks[-1].grows = end
                    case ("beyond", place, width):
                        self.blocks[-1].grows = ("end", place, width)
            case 0x05, _:
                self.memory, self.checked = self.blocks[-1].memory, set(self.blocks[-1].checked)
            case 0x03, _:
                self.blocks.append(Block(self.memory, set(self.checked)))
            case 0x0B, _ if self.blocks:
                block = self.blocks.pop()
                self.memory, self.checked = block.memory, block.checked
                if block.calls and isinstance(block.grows, int):
                    self.memory = max(self.memory, block.grows)
                elif block.calls and block.grows:
                    self.checked.add((block.grows[1], block.grows[2]))
            case ((0x0F | 0x0B | 0x00), _):
                pass
            case _:
                self.other(code, more)

    def call(self, function: int) -> None:
        """Follow a call: its arguments, and how many results it has."""
        takes, leaves = {0: (4, 1), 1: (6, 1), 2: (2, 0), 3: (2, 2)}.get(function, (8, 4))
        # the last four divide, and take the state of the frame too
        takes += function >= len(IMPORTED) - 1 + HELPERS - 1 - 4
        arguments = [self.pop() for _ in range(takes)][::-1]
        self.moves += function < 2
        if function == 0:
            for block in self.blocks:
                block.calls |= block.grows == arguments[1]
        self.values += [None] * leaves

    def other(self, code: int, more: list[int]) -> None:
        """Follow an instruction that calculates."""
        if code in (0x42, 0xFD0C):
            self.values.append(None)
            return
        if code in (0x12, 0x13, 0x0D):
            return
        last = self.pop()
        if code in UNARY:
            self.values.append(("field", more[1]) if code == 0x28 and last == ("local", STATE) else None)
            return
        first = self.pop()
        value: Any = None
        match code, first, last:
            case 0x6B, ("local", 0), int(size):
                assert size == WORD * REACH
                value = ("low",)
            case 0x6B, ("local", 0), ("field", 4):
                value = "below"
            case 0x6B, ("field", 8), ("local", 0):
                value = "above"
            case 0x49, "below", int(size):
                self.below = size // WORD
            case 0x49, "above", int(size):
                self.above = size // WORD
            case 0x49, ("local", 2), int(end):
                value = ("less", first, end)
            case 0x6A, ("local", place), int(width):
                value = ("end", place, width)
            case 0x4B, ("end", place, width), ("local", 2):
                value = ("beyond", place, width)
            case 0x72, ("beyond", place, width), _:
                value = first
            case 0x6A, ("local", 1), ("local", place):
                value = ("address", place, self.moves)
        self.values.append(value)


def check(module: bytes) -> int:
    """Check all stores of the regions of a module; return how many there are. AssertionError for a wrong one."""
    assert imports(module) == IMPORTED
    bodies = sections(module)[10]
    stores = 0
    for number in range(bodies.number()):
        body = Reader(bodies.take(bodies.number()))
        for _ in range(body.number()):
            body.number(), body.byte()
        if number < HELPERS:
            continue
        region = Function()
        for code, more in instructions(body):
            region.step(code, more)
        stores += region.stores
    return stores
