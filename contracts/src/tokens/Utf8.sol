// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice Validates UTF-8.
/// @dev Source: RFC 3629.
library Utf8 {
    /// @notice Returns the position of the first invalid byte sequence; the length of the text if there is none.
    function validLength(bytes calldata text) internal pure returns (uint256 place) {
        unchecked {
            while (place < text.length) {
                uint256 first = uint8(text[place]);
                // the number of continuation bytes
                uint256 more = first < 0x80 ? 0 : first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
                if ((first >= 0x80 && first < 0xc2) || first > 0xf4 || place + more >= text.length) return place;
                uint256 character = more == 0 ? first : first & (0x3f >> more);
                for (uint256 k = 1; k <= more; ++k) {
                    uint256 next = uint8(text[place + k]);
                    if (next >> 6 != 2) return place;
                    character = (character << 6) | (next & 0x3f);
                }
                // overlong encodings, surrogates, and values beyond Unicode
                if (more == 2 && (character < 0x800 || character >> 11 == 0x1b)) return place;
                if (more == 3 && (character < 0x10000 || character > 0x10ffff)) return place;
                place += more + 1;
            }
        }
    }
}
