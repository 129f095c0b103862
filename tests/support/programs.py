"""Random programs for the EVM: arithmetic, stack, memory, the data of the call, forks that join, and loops."""

from __future__ import annotations

import random

JUMPDEST, RETURN = 0x5B, 0xF3
#: Instructions of two operands and one result, and of three.
BINARY = (*range(0x01, 0x08), 0x0B, *range(0x10, 0x15), *range(0x16, 0x19), *range(0x1A, 0x1E))
TERNARY = (0x08, 0x09)
#: Instructions that compilers use with a constant, and constants of bits and of bytes.
WITH_BITS, WITH_BYTES, WITH_ANY = (0x1B, 0x1C, 0x1D), (0x1A, 0x0B), (0x16, 0x17, 0x18, 1, 2, 3, 4, 6, 0x10, 0x12, 0x14)
BITS = (0, 1, 7, 8, 16, 31, 32, 63, 64, 65, 100, 127, 128, 129, 191, 192, 193, 224, 248, 255, 256, 300, 1 << 64)
EDGES = [
    (sign * (1 << power) + step) % (1 << 256)
    for power in (0, 3, 5, 6, 8, 31, 32, 62, 63, 64, 65, 127, 128, 192, 255)
    for sign in (1, -1)
    for step in (-1, 0, 1)
]
#: Words of the data of a call; counters of loops, in memory; where results are stored; bytes that are returned.
DATA, COUNTER, RESULTS, RETURNED = 40, 0x400, 0x500, 0x800
MOST_WORDS = 14


def push(value: int) -> bytes:
    """Return the shortest instruction that pushes a number."""
    size = (value.bit_length() + 7) // 8
    return bytes([0x5F + size]) + value.to_bytes(size, "big")


def number(rng: random.Random) -> int:
    """Return an edge, a number of some size, or the negative of one."""
    kind = rng.random()
    if kind < 0.5:
        return rng.choice(EDGES)
    value = rng.getrandbits(rng.choice((8, 16, 32, 63, 64, 65, 100, 128, 192, 256)))
    return value if kind < 0.8 else -value % (1 << 256)


def call_data(rng: random.Random) -> bytes:
    """Return the data of a call of a program."""
    return b"".join(number(rng).to_bytes(32, "big") for _ in range(DATA))[: rng.choice((32 * DATA, 32 * DATA, 77))]


class Writer:
    """Writes a program, and knows how many words are on the stack."""

    def __init__(self, rng: random.Random) -> None:
        """Begin without code."""
        self.rng, self.code, self.words = rng, bytearray(), 0

    def write(self, code: bytes, words: int) -> None:
        """Append code that leaves so many words more."""
        self.code += code
        self.words += words

    def instruction(self) -> None:
        """Append an instruction, with constants where it has some."""
        rng, place = self.rng, push(self.rng.randrange(300))
        kind = 0.0 if self.words < 3 else rng.random()
        if kind < 0.12:
            self.write(push(rng.randrange(DATA + 2) * rng.choice((32, 32, 31)) + rng.choice((0, 0, 1))) + b"\x35", 1)
        elif kind < 0.2:
            self.write(push(number(rng)), 1)
        elif kind < 0.32:
            with_any = rng.choice(WITH_ANY), rng.choice((*EDGES, number(rng)))
            with_bits = rng.choice(WITH_BITS), rng.choice(BITS)
            code, constant = rng.choice((with_any, with_bits, (rng.choice(WITH_BYTES), rng.randrange(34))))
            self.write(push(constant) + bytes([code]), 0)
        elif kind < 0.56:
            self.write(bytes([rng.choice(BINARY)]), -1)
        elif kind < 0.6:
            self.write(bytes([rng.choice(TERNARY)]), -2)
        elif kind < 0.68:
            self.write(rng.choice((b"\x15", b"\x15\x15", b"\x19")), 0)
        elif kind < 0.78:
            self.write(bytes([0x80 + rng.randrange(self.words)]), 1)
        elif kind < 0.86:
            self.write(bytes([0x90 + rng.randrange(self.words - 1)]), 0)
        elif kind < 0.9:
            self.write(place + rng.choice((b"\x52", b"\x53")), -1)
        elif kind < 0.94:
            self.write(place + b"\x51", 1)
        elif kind < 0.95:
            # a place that is known at run time only: small, or beyond all gas
            self.write(rng.choice((push(0x1FF) + b"\x16", b"")) + b"\x51", 0)
        elif kind < 0.97:
            self.write(push(rng.choice((0, 3, 8, 17, 32, 40))) + place + push(rng.randrange(200)) + b"\x5e", 0)
        else:
            self.write(bytes([rng.choice((0x36, 0x58, 0x59, 0x5A))]), 1)
        while self.words > MOST_WORDS:
            self.write(b"\x50", -1)

    def block(self, most: int) -> None:
        """Append some instructions."""
        for _ in range(self.rng.randrange(most)):
            self.instruction()

    def level(self, words: int) -> None:
        """Bring the stack to a height, and move what is on it."""
        while self.words > words:
            self.write(b"\x50", -1)
        while self.words < words:
            self.write(push(number(self.rng)), 1)
        for _ in range(self.rng.randrange(3) if words > 1 else 0):
            self.write(bytes([0x90 + self.rng.randrange(words - 1)]), 0)

    def fork(self) -> None:
        """Append a block that is left out or not, by a word of the stack."""
        words = self.words
        self.write(bytes([0x80 + self.rng.randrange(words)]) + b"\x61\0\0\x57", 0)
        at = len(self.code) - 3
        self.block(10)
        self.level(words)
        self.code[at : at + 2] = len(self.code).to_bytes(2, "big")
        self.code.append(JUMPDEST)

    def loop(self) -> None:
        """Append some rounds of a block. The place to which they lead back is a constant, or known at run time only."""
        words, head = self.words, len(self.code)
        counter = push(COUNTER)
        count = counter + b"\x51" + push(1) + b"\x01\x80" + counter + b"\x52" + push(self.rng.randrange(2, 12))
        self.code.append(JUMPDEST)
        if self.rng.random() < 0.4:
            # the end is in front of the block, which may change any word
            self.code += count + b"\x10\x61\0\0\x57"
            at = len(self.code) - 3
            self.block(12)
            self.level(words)
            self.code += b"\x61" + head.to_bytes(2, "big") + b"\x56"
            self.code[at : at + 2] = len(self.code).to_bytes(2, "big")
            self.code.append(JUMPDEST)
            return
        self.block(12)
        self.level(words)
        self.code += count
        if self.rng.random() < 0.7:
            self.code += b"\x11\x61" + head.to_bytes(2, "big") + b"\x57"
            return
        # to the end, or back by the distance
        end = len(self.code) + 10
        self.code += b"\x11\x61" + (end - head).to_bytes(2, "big") + b"\x02\x61" + end.to_bytes(2, "big") + b"\x03\x56"
        self.code.append(JUMPDEST)

    def program(self) -> bytes:
        """Return a program that returns its memory, and what was on its stack."""
        self.block(30)
        for _ in range(self.rng.randrange(5)):
            while self.words < 1:
                self.instruction()
            self.fork() if self.rng.random() < 0.5 else self.loop()
            self.block(10)
        for place in range(self.words):
            self.write(push(RESULTS + 32 * place) + b"\x52", 0)
        return bytes(self.code) + push(RETURNED) + b"\x5f\xf3"


def program(rng: random.Random) -> bytes:
    """Return a random program."""
    return Writer(rng).program()


def differences(rng: random.Random, count: int, calls: int = 4) -> list[str]:
    """Run random programs in the interpreter, and compiled in regions of several sizes; return what differs."""
    from evms import ADDRESS, Ours

    found = []
    for begin in range(0, count, 50):
        # the smallest take longest to compile
        regions = [None, rng.choice((3, 12, 25, 25, 80)), *[1] * (begin % 200 == 0)]
        machines = {region: Ours(region) for region in regions}
        for _ in range(begin, min(begin + 50, count)):
            code = program(rng)
            for _ in range(calls):
                data, gas = call_data(rng), rng.choice((10**7, 10**7, rng.randrange(3000)))
                answers = {region: each.call({ADDRESS: code}, ADDRESS, data, gas) for region, each in machines.items()}
                if len(set(answers.values())) > 1:
                    said = {region: (each.status.name, each.gas) for region, each in answers.items()}
                    found.append(f"{code.hex()} {data.hex()} {gas}: {said}")
    return found
