"""Write contracts/src/studio/PngCode.sol: the tables of the PNG encoder, of the code lengths in shackled.reference.png.

python tools/png_code.py            writes the file
python tools/png_code.py --check    writes nothing; fails if the file is not as it would be written
"""

from __future__ import annotations

import sys
from pathlib import Path

from shackled.reference import png

TARGET = Path(__file__).resolve().parent.parent / "contracts" / "src" / "studio" / "PngCode.sol"

FILE = """// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice The Huffman code of the PNG encoder, fitted to pictures of the renderer. Written by tools/png_code.py.
/// @dev All bits are in the order of the stream.
library PngCode {{
    /// @notice Bits of the code of 259 zeros, the most that it can tell at once.
    uint256 internal constant LONGEST_RUN_SIZE = {run_size};
    /// @notice Nine times that code.
    uint256 internal constant NINE_LONGEST_RUNS = {runs};

    /// @notice Of each byte the code (12 bits) and its length (4 bits); of each number of zeros from 0 to 259 the codes
    /// of a zero and of a match of the others (19 bits), and their length (5 bits).
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
    literals = "".join(f"{int(code, 2) << 4 | len(code):04x}" for code in map(png.literal, range(256)))
    runs = map(png.short_run, range(png.LONGEST_RUN + 1))
    zeros = "".join(f"{int(code or '0', 2) << 5 | len(code):06x}" for code in runs)
    header = png.code_header()
    whole = len(header) // 8 * 8
    return FILE.format(
        tables=_literal(literals + zeros),
        header=_literal(f"{int(header[:whole], 2):0{whole // 4}x}"),
        run_size=len(png.short_run(png.LONGEST_RUN)),
        runs=hex(int(9 * png.short_run(png.LONGEST_RUN), 2)),
        rest=int(header[whole:] or "0", 2),
        rest_size=len(header) - whole,
        end=int(png.codes()[png.END], 2),
        end_size=len(png.codes()[png.END]),
    )


def _literal(digits: str) -> str:
    lines = [digits[at : at + 128] for at in range(0, len(digits), 128)]
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
