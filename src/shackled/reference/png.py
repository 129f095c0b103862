"""PNG files as contracts/src/studio/Png.sol makes them.

Each pixel becomes a square of `scale` pixels, so that it stays crisp where pictures are enlarged smoothly. Rows are
stored as differences: the first row of each square from the pixel at the left (filter Sub), the others from the row
above (filter Up), which leaves nothing but zeros. So there are only two things to compress, the differences of pixels
and runs of zeros, and one Huffman code, fitted to pictures of this renderer once and for all, does for every picture.
"""

from __future__ import annotations

import struct
import zlib
from functools import cache

import numpy as np
from numpy.typing import NDArray

#: Bits of the code of each symbol, one digit (hexadecimal) each: 256 bytes, the end, 29 lengths of runs.
CODE_LENGTHS = [
    int(digit, 16)
    for digit in (
        "155788999999aaaaaaaaaaabbbbbbbbbbbbbbbcbbbcbcccccccccccccccccccccccccccccccccccccccccccccccccccc"
        "cccccccbbbacccccccccccccccccccccccccccccccccccccccccccabbbcccccccccccccccccccccccccccccccccccccc"
        "cccccccccccccccccccccbcbbbcbbbbbbbbbbbbbbbaaaaaaaaaaa99999987755cccccc4cccbcc6bcababcaabaaa773"
    )
]
END = 256
SIGNATURE = b"\x89PNG\r\n\x1a\n"

#: In PNG: a pixel less the one at its left, less the one above it.
SUB = 1
UP = 2

#: A run of zeros in one go: a zero, and a match of up to 258 more at distance 1.
LONGEST_RUN = 259


def encode_png(pixels: NDArray[np.uint8], scale: int = 1) -> bytes:
    """A PNG of (height, width, 3) pixels, red, green, blue, rows from the top, each enlarged `scale` times."""
    height, width, _ = pixels.shape
    head = struct.pack(">IIBBBBB", width * scale, height * scale, 8, 2, 0, 0, 0)
    filtered = _filtered(pixels, scale)
    data = b"\x78\x01" + _deflate(pixels, scale) + struct.pack(">I", zlib.adler32(filtered))
    return SIGNATURE + _chunk(b"IHDR", head) + _chunk(b"IDAT", data) + _chunk(b"IEND", b"")


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _differences(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Each pixel less the one at its left."""
    return np.diff(pixels, axis=1, prepend=np.zeros((len(pixels), 1, 3), np.uint8))


def _filtered(pixels: NDArray[np.uint8], scale: int) -> bytes:
    """What is compressed."""
    rows = []
    size = 3 * pixels.shape[1] * scale
    for row in _differences(pixels):
        spread = np.zeros((len(row), scale, 3), np.uint8)
        spread[:, 0] = row
        rows.append(bytes([SUB]) + spread.tobytes() + (bytes([UP]) + bytes(size)) * (scale - 1))
    return b"".join(rows)


def _deflate(pixels: NDArray[np.uint8], scale: int) -> bytes:
    """One block with the code, in bits: "0" and "1" in the order of the stream."""
    size = 3 * pixels.shape[1] * scale
    bits = [code_header()]
    for row in _differences(pixels):
        bits.append(literal(SUB))
        zeros = 0
        for red, green, blue in row.tolist():
            if red | green | blue:
                bits += [run(zeros), literal(red), literal(green), literal(blue)]
                zeros = -3
            zeros += 3 * scale
            # what follows the first of the pixels of a square is zeros
        bits.append(run(zeros))
        bits += (scale - 1) * [literal(UP) + run(size)]
    bits.append(codes()[END])
    return packed("".join(bits))


def packed(bits: str) -> bytes:
    """Bits as bytes, in each of which the first is the lowest."""
    bits += "0" * (-len(bits) % 8)
    return bytes(int(bits[at : at + 8][::-1], 2) for at in range(0, len(bits), 8))


def literal(value: int) -> str:
    """The code of a byte."""
    return codes()[value]


def run(zeros: int) -> str:
    """The code of so many zeros."""
    whole, rest = divmod(zeros, LONGEST_RUN)
    return whole * short_run(LONGEST_RUN) + short_run(rest)


@cache
def short_run(zeros: int) -> str:
    """The code of up to LONGEST_RUN zeros: one, and a match of the others."""
    if zeros <= 3:
        return zeros * literal(0)
    symbol, extra, first = next(row for row in reversed(_lengths()) if row[2] <= zeros - 1)
    more = f"{zeros - 1 - first:0{extra}b}"[::-1] if extra else ""
    # "0" is the code of the only distance that there is, which is 1
    return literal(0) + codes()[symbol] + more + "0"


def _lengths() -> list[tuple[int, int, int]]:
    """Of each symbol of a length: the symbol, how many more bits follow it, the first length. RFC 1951, 3.2.5."""
    rows, length = [], 3
    for symbol in range(257, 285):
        extra = max(0, (symbol - 261) // 4)
        rows.append((symbol, extra, length))
        length += 1 << extra
    return [*rows, (285, 0, 258)]


@cache
def codes() -> list[str]:
    """The code of each symbol. RFC 1951, 3.2.2."""
    return canonical(CODE_LENGTHS)


def canonical(lengths: list[int]) -> list[str]:
    """The codes of these lengths: shorter ones first, in the order of the symbols."""
    result = [""] * len(lengths)
    code, before = 0, 0
    for length, symbol in sorted((length, symbol) for symbol, length in enumerate(lengths) if length):
        code <<= length - before
        result[symbol] = f"{code:0{length}b}"
        code, before = code + 1, length
    return result


@cache
def code_header() -> str:
    """What tells the code at the beginning of the block: the last one, of the kind with a code of its own."""
    lengths = [*CODE_LENGTHS, 1]
    # the lengths of the codes, themselves as symbols: 16 repeats the one before 3 to 6 times
    symbols: list[tuple[int, str]] = []
    while lengths:
        value, times = lengths[0], 1
        while times < len(lengths) and lengths[times] == value:
            times += 1
        del lengths[:times]
        symbols.append((value, ""))
        times -= 1
        while times >= 3:
            part = min(times, 6)
            symbols.append((16, f"{part - 3:02b}"[::-1]))
            times -= part
        symbols += times * [(value, "")]
    order = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15]
    used = sorted({symbol for symbol, _ in symbols})
    # codes of three bits while there are symbols for them, of four for the others
    short = 16 - len(used)
    by_count = sorted(used, key=lambda symbol: -sum(each == symbol for each, _ in symbols))
    sizes = [0] * 19
    for rank, symbol in enumerate(by_count):
        sizes[symbol] = 3 if rank < short else 4
    texts = canonical(sizes)
    last = max(at for at, symbol in enumerate(order) if sizes[symbol])
    return "".join(
        [
            "1",
            "01",
            _number(len(CODE_LENGTHS) - 257, 5),
            _number(0, 5),
            _number(last + 1 - 4, 4),
            *(_number(sizes[symbol], 3) for symbol in order[: last + 1]),
            *(texts[symbol] + more for symbol, more in symbols),
        ]
    )


def _number(value: int, bits: int) -> str:
    """A number, lowest bit first."""
    return f"{value:0{bits}b}"[::-1]
