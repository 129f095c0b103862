// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../math/Roots.sol";
import {Material} from "../scene/Scene.sol";
import "../pipeline/Registers.sol";

/// @notice The highlight of a material.
library Specular {
    /// @notice Tabulates coefficient * cos^shininess over cos^2, where it is at least half a level.
    function setTable(uint256 coefficient, uint256 shininess) internal pure {
        unchecked {
            store(SPECULAR_ROOT, shininess == 1 ? coefficient >> 16 : 0);
            if (coefficient == 0 || shininess == 1) {
                // no square is greater than this
                store(SPECULAR_BEGIN, type(uint256).max);
                return;
            }
            uint256 width = 13;
            for (uint256 k = 1 << 32; k < coefficient; k <<= 1) width += 2;
            width = (width << 24) / shininess;
            if (width > 1 << 24) width = 1 << 24;
            uint256 begin = (1 << 24) - width;
            store(SPECULAR_BEGIN, begin);
            store(SPECULAR_SCALE, (SPECULAR_ENTRIES << 40) / width);
            store(SPECULAR_OFFSET, (begin * load(SPECULAR_SCALE)) >> 16);
            uint256 last = (coefficient * power((1 << 24), shininess)) >> 48;
            uint256 pointer = SPECULAR_TABLE + SPECULAR_ENTRIES * 32;
            store(pointer, last << SPECULAR_VALUE_AT);
            for (uint256 i = SPECULAR_ENTRIES; i != 0; ) {
                --i;
                pointer -= 32;
                uint256 value = (coefficient * power(begin + width * i / SPECULAR_ENTRIES, shininess)) >> 48;
                store(pointer, (value << SPECULAR_VALUE_AT) | (last - value));
                last = value;
            }
        }
    }

    /// @dev square^(exponent / 2), where square is Q24 and the result Q32.
    function power(uint256 square, uint256 exponent) private pure returns (uint256 result) {
        unchecked {
            uint256 base = square << 8;
            result = exponent & 1 == 0 ? 1 << 32 : sqrt(base << 32);
            for (exponent >>= 1; exponent != 0; exponent >>= 1) {
                if (exponent & 1 != 0) result = (result * base) >> 32;
                base = (base * base) >> 32;
            }
        }
    }

    /// @dev The square, Q40, of how much unit half vectors may differ in a triangle. If they are interpolated, their direction is off by
    /// d^2/4 at most for a difference d, and cos^n is steepest with about 0.6 * sqrt(n): four levels of 255 are allowed, or d = 1/4.
    function halfReach(uint256 coefficient, uint256 shininess) internal pure returns (uint256) {
        unchecked {
            uint256 slope = (sqrt(shininess << 64) * coefficient) >> 32;
            if (slope == 0) return 1 << 36;
            // 4 * 4 / (0.6 * 255) = 0.1
            uint256 reach = (uint256(1) << 72) / (10 * slope);
            return reach > 1 << 36 ? 1 << 36 : reach;
        }
    }

    /// @dev The highlight is the cosine itself: over its square, where the others are tabulated, it is too steep near zero to be
    /// interpolated, and each fragment takes the root.
    function isBroad(Material calldata material) internal pure returns (bool) {
        return material.shininess == 1 && material.specular.raw() != 0;
    }
}
