"""Model the PNG encoder of contracts/src/encode/Png.sol, and make its tables: contracts/src/encode/PngCode.sol.

Each pixel becomes a square of `scale` pixels, so that it stays crisp where pictures are enlarged smoothly. The first
row of each square holds the pixels themselves (filter None), the others equal the row above (filter Up): zeros. A
pixel is written as its three bytes, and a match that repeats them until another one comes. All bytes have codes of nine
bits, so that no table is needed for them; one code, fitted to pictures of this renderer, serves all.
"""

from __future__ import annotations

import struct
import zlib
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

TARGET = Path(__file__).resolve().parent.parent / "contracts" / "src" / "encode" / "PngCode.sol"

FILE = """// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @dev The 9-bit codes of three zeros. The code of another byte is this plus the byte.
uint256 constant LITERALS = {literals};

/// @notice The Huffman code of the PNG encoder, fitted to pictures of the renderer. Written by tools/png_code.py.
/// @dev All bits are in the order of the stream.
library PngCode {{
    /// @notice The 9-bit code of a zero. The code of another byte is this plus the byte.
    uint256 internal constant LITERAL = {literal};
    /// @notice The code size of the longest match in bits; 32 such matches at the distance of a pixel; one of a byte.
    uint256 internal constant LONGEST_SIZE = {longest_size};
    uint256 internal constant LONGEST = {longest};
    uint256 internal constant LONGEST_ZEROS = {zeros};
    /// @notice The bits in which the codes of 259 and 260 bytes, two matches each, differ for the other distance. Codes
    /// of fewer bytes differ in the last bit.
    uint256 internal constant OTHER_DISTANCES = {others};

    /// @notice Returns, for each length from 3 to 260, the code of the match at the distance of a pixel (19 bits), and
    /// its size in bits (5 bits).
    function tables() internal pure returns (bytes memory) {{
        return
{tables};
    }}
{block}}}

/// @notice The Huffman code of PNG files with alpha. Pixels have four bytes.
library AlphaCode {{
    /// @notice The code of a zero pixel, 36 bits. The bytes of a pixel, spread 9 bits apart, are added to it.
    uint256 internal constant PIXEL = {alpha_pixel};

    /// @notice Returns, for each number of pixels from 1 to 64, the code of the match that repeats one that many times
    /// (19 bits), and its size in bits (5 bits).
    function tables() internal pure returns (bytes memory) {{
        return
{alpha_tables};
    }}
{alpha_block}}}
"""

#: What both have of a block.
BLOCK_CODE = """
    /// @notice Returns the header of the block, which defines the code, without the last bits, which fill no byte.
    function header() internal pure returns (bytes memory) {{
        return
{header};
    }}

    /// @notice Returns the last bits of the header, and their number.
    function headerRest() internal pure returns (uint256, uint256) {{
        return ({rest}, {rest_size});
    }}

    /// @notice Returns the end of the block: its bits, and their number.
    function end() internal pure returns (uint256, uint256) {{
        return ({end}, {end_size});
    }}
"""

#: Bits of the code of each byte.
LITERAL_LENGTH = 9
#: Bits of the code of each symbol: 256 bytes, the end, 29 lengths of matches.
CODE_LENGTHS = 256 * [LITERAL_LENGTH] + [int(digit, 16) for digit in "c4eeeee4eeead2d98a98a788887774"]
#: The same for pixels of four bytes, of which only whole ones are repeated.
ALPHA_LENGTHS = 256 * [LITERAL_LENGTH] + [int(digit, 16) for digit in "704000500307077577777777777730"]
END = 256
SIGNATURE = b"\x89PNG\r\n\x1a\n"

#: In PNG: a row of pixels as they are, and of their differences from the row above.
NONE = 0
UP = 2

#: Codes of the two distances: of the byte before, and of the pixel before.
BYTE, PIXEL = "0", "1"
#: The longest match.
LONGEST = 258

#: Rows are divided into parts of so many pixels, each of which begins with a pixel that is written.
PART = 256
#: Where the codes of a pixel and of a match of the rest of its square have 32 bits together, as many pixels as fit into
#: a word are written all if so many of them are not like those at their left; likewise where pixels are not enlarged.
BLOCK = 8
MANY = 4


def encode_png(pixels: NDArray[np.uint8], scale: int = 1) -> bytes:
    """Encode (height, width, 3) pixels, red, green, blue, rows from the top, each enlarged `scale` times."""
    height, width, _ = pixels.shape
    head = struct.pack(">IIBBBBB", width * scale, height * scale, 8, 2, 0, 0, 0)
    filtered = _filtered(pixels, scale)
    data = b"\x78\x01" + _deflate(pixels, scale) + struct.pack(">I", zlib.adler32(filtered))
    return SIGNATURE + _chunk(b"IHDR", head) + _chunk(b"IDAT", data) + _chunk(b"IEND", b"")


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _filtered(pixels: NDArray[np.uint8], scale: int) -> bytes:
    """Return the bytes that are compressed."""
    rows = []
    size = 3 * pixels.shape[1] * scale
    for row in pixels:
        rows.append(bytes([NONE]) + row.repeat(scale, 0).tobytes() + (bytes([UP]) + bytes(size)) * (scale - 1))
    return b"".join(rows)


def _deflate(pixels: NDArray[np.uint8], scale: int) -> bytes:
    """Return one block with the code, in bits: "0" and "1" in the order of the stream."""
    width = pixels.shape[1]
    above = literal(UP) + literal(0) + match(3 * width * scale - 1, BYTE)
    bits = [code_header()]
    for row in pixels:
        bits.append(literal(NONE))
        for begin in range(0, width, PART):
            part = row[begin : begin + PART]
            places = [*_written(part, scale), len(part)]
            for place, following in pairwise(places):
                bits += [*map(literal, part[place].tolist()), match(3 * scale * (following - place) - 3, PIXEL)]
        bits += (scale - 1) * [above]
    bits.append(codes()[END])
    return packed("".join(bits))


def _written(part: NDArray[np.uint8], scale: int) -> list[int]:
    """Return which pixels are written; the others equal those at their left."""
    written = np.append(True, (part[1:] != part[:-1]).any(1))
    if scale == 1 or 3 * LITERAL_LENGTH + len(match(3 * scale - 3, PIXEL)) == 32:
        # the first pixel of a part is written anyway
        changed = np.append(False, written[1:])
        for begin in range(0, len(part) - BLOCK + 1, BLOCK):
            if changed[begin : begin + BLOCK].sum() >= MANY:
                written[begin : begin + BLOCK] = True
    return np.flatnonzero(written).tolist()


def packed(bits: str) -> bytes:
    """Pack bits into bytes, the first bit lowest."""
    bits += "0" * (-len(bits) % 8)
    return bytes(int(bits[at : at + 8][::-1], 2) for at in range(0, len(bits), 8))


def literal(value: int) -> str:
    """Return the code of a byte."""
    return codes()[value]


def match(length: int, distance: str) -> str:
    """Return the code of a repetition of so many bytes, none or at least 3, at one of the two distances."""
    if not length:
        return ""
    # so many of the longest that at least 3 are left
    longest, rest = divmod(length - 3, LONGEST)
    return longest * (codes()[285] + distance) + short_match(rest + 3, distance)


@cache
def short_match(length: int, distance: str) -> str:
    """Return the code of a repetition of 3 to 260 bytes."""
    if length > LONGEST:
        return short_match(length - 3, distance) + short_match(3, distance)
    return _match(codes(), length, distance)


def _match(table: list[str], length: int, distance: str) -> str:
    """Return the code of a repetition of 3 to 258 bytes, by the codes of all symbols."""
    symbol, extra, first = next(row for row in reversed(_lengths()) if row[2] <= length)
    more = f"{length - first:0{extra}b}"[::-1] if extra else ""
    return table[symbol] + more + distance


def _lengths() -> list[tuple[int, int, int]]:
    """Return for each symbol of a length: the symbol, its extra bits, its first length. RFC 1951, 3.2.5."""
    rows, length = [], 3
    for symbol in range(257, 285):
        extra = max(0, (symbol - 261) // 4)
        rows.append((symbol, extra, length))
        length += 1 << extra
    return [*rows, (285, 0, 258)]


@cache
def codes() -> list[str]:
    """Return the code of each symbol. RFC 1951, 3.2.2."""
    return canonical(CODE_LENGTHS)


def canonical(lengths: list[int]) -> list[str]:
    """Return the codes of these lengths: shorter ones first, in the order of the symbols."""
    result = [""] * len(lengths)
    code, before = 0, 0
    for length, symbol in sorted((length, symbol) for symbol, length in enumerate(lengths) if length):
        code <<= length - before
        result[symbol] = f"{code:0{length}b}"
        code, before = code + 1, length
    return result


@cache
def code_header() -> str:
    """Return the header of the block: the last one, with dynamic codes."""
    # the distances 1 and 3 have a bit each, 2 has none
    return _header(CODE_LENGTHS, [1, 0, 1])


def _header(symbol_lengths: list[int], distance_lengths: list[int]) -> str:
    """Return the header of a block whose codes have these lengths."""
    lengths = [*symbol_lengths, *distance_lengths]
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
            _number(len(symbol_lengths) - 257, 5),
            _number(len(distance_lengths) - 1, 5),
            _number(last + 1 - 4, 4),
            *(_number(sizes[symbol], 3) for symbol in order[: last + 1]),
            *(texts[symbol] + more for symbol, more in symbols),
        ]
    )


def _number(value: int, bits: int) -> str:
    """Return the bits of a number, the lowest first."""
    return f"{value:0{bits}b}"[::-1]


def files() -> dict[Path, str]:
    """Return the text of the file, by its path."""
    longest, zeros = (short_match(LONGEST, distance) for distance in (PIXEL, BYTE))
    others = {int(short_match(n, PIXEL), 2) ^ int(short_match(n, BYTE), 2) for n in (259, 260)}
    alpha = canonical(ALPHA_LENGTHS)
    # the distances 1 and 4 have a bit each
    alpha_header = _header(ALPHA_LENGTHS, [1, 0, 0, 1])
    text = FILE.format(
        tables=_table([short_match(length, PIXEL) for length in range(3, 261)]),
        block=_block(code_header(), codes()[END]),
        literal=int(literal(0), 2),
        literals=int(3 * literal(0), 2),
        longest_size=len(longest),
        longest=f"0x{int(32 * longest, 2):064x}",
        zeros=int(zeros, 2),
        others=hex(others.pop()),
        alpha_pixel=int(4 * alpha[0], 2),
        alpha_tables=_table([_match(alpha, 4 * pixels, PIXEL) for pixels in range(1, 65)]),
        alpha_block=_block(alpha_header, alpha[END]),
    )
    return {TARGET: text}


def _table(matches: list[str]) -> str:
    """Return codes with their sizes."""
    return _literal("".join(f"{int(code, 2) << 5 | len(code):06x}" for code in matches))


def _block(header: str, end: str) -> str:
    """Return the functions of the beginning and the end of a block."""
    whole = len(header) // 8 * 8
    return BLOCK_CODE.format(
        header=_literal(f"{int(header[:whole], 2):0{whole // 4}x}"),
        rest=int(header[whole:] or "0", 2),
        rest_size=len(header) - whole,
        end=int(end, 2),
        end_size=len(end),
    )


def _literal(digits: str) -> str:
    lines = [digits[at : at + 120] for at in range(0, len(digits), 120)]
    return "\n".join(f'            hex"{line}"' for line in lines)
