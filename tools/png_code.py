"""Write contracts/src/encode/PngCode.sol: the tables of the PNG encoder, of the code lengths in shackled.reference.png.

python tools/png_code.py            writes the file
python tools/png_code.py --check    writes nothing; fails if the file is not as it would be written
"""

from __future__ import annotations

import sys
from pathlib import Path

from shackled.reference import png

TARGET = Path(__file__).resolve().parent.parent / "contracts" / "src" / "encode" / "PngCode.sol"

FILE = """// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @dev The codes of three zeros; those of other bytes are as much more. They have 9 bits each.
uint256 constant LITERALS = {literals};

/// @notice The Huffman code of the PNG encoder, fitted to pictures of the renderer. Written by tools/png_code.py.
/// @dev All bits are in the order of the stream.
library PngCode {{
    /// @notice The code of a zero; those of other bytes are as much more. They have 9 bits.
    uint256 internal constant LITERAL = {literal};
    /// @notice Bits of the longest match, and 32 of them: at the distance of a pixel, and of a byte.
    uint256 internal constant LONGEST_SIZE = {longest_size};
    uint256 internal constant LONGEST = {longest};
    uint256 internal constant LONGEST_ZEROS = {zeros};
    /// @notice Where the matches of 259 and 260 bytes, which are two each, differ for the other distance. Those of
    /// fewer bytes differ in the last bit.
    uint256 internal constant OTHER_DISTANCES = {others};

    /// @notice Of each length from 3 to 260 the code of the match at the distance of a pixel (19 bits), and its length
    /// (5 bits).
    function tables() internal pure returns (bytes memory) {{
        return
{tables};
    }}

    /// @notice What tells the code at the beginning of the block, as far as it fills bytes.
    function header() internal pure returns (bytes memory) {{
        return
{header};
    }}

    /// @notice The rest of it: bits, and how many.
    function headerRest() internal pure returns (uint256, uint256) {{
        return ({rest}, {rest_size});
    }}

    /// @notice What ends the block: bits, and how many.
    function end() internal pure returns (uint256, uint256) {{
        return ({end}, {end_size});
    }}
}}
"""


def write() -> str:
    """The text of the file."""
    matches = [png.short_match(length, png.PIXEL) for length in range(3, 261)]
    longest, zeros = (png.short_match(png.LONGEST, distance) for distance in (png.PIXEL, png.BYTE))
    others = {int(png.short_match(n, png.PIXEL), 2) ^ int(png.short_match(n, png.BYTE), 2) for n in (259, 260)}
    header = png.code_header()
    whole = len(header) // 8 * 8
    return FILE.format(
        tables=_literal("".join(f"{int(code, 2) << 5 | len(code):06x}" for code in matches)),
        header=_literal(f"{int(header[:whole], 2):0{whole // 4}x}"),
        literal=int(png.literal(0), 2),
        literals=int(3 * png.literal(0), 2),
        longest_size=len(longest),
        longest=f"0x{int(32 * longest, 2):064x}",
        zeros=f"0x{int(32 * zeros, 2):064x}",
        others=hex(others.pop()),
        rest=int(header[whole:] or "0", 2),
        rest_size=len(header) - whole,
        end=int(png.codes()[png.END], 2),
        end_size=len(png.codes()[png.END]),
    )


def _literal(digits: str) -> str:
    lines = [digits[at : at + 120] for at in range(0, len(digits), 120)]
    return "\n".join(f'            hex"{line}"' for line in lines)


def main() -> int:
    """The command."""
    text = write()
    if "--check" in sys.argv[1:]:
        return int(TARGET.read_text("utf-8") != text)
    TARGET.write_text(text, "utf-8", newline="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
