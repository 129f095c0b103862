// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrt} from "../math/Roots.sol";
import {Material} from "../scene/Scene.sol";
import "../words/Registers.sol";

// Tabulates the highlight of `radiance` of picture.py.

/// @dev A reach, in squares of sub-pixels, above any triangle's.
uint256 constant UNBOUNDED_REACH = 1 << 60;
/// @dev 0.19, Q20: by so much the square of a cosine within a triangle may be above that of its nodes, for turns that SmoothLight allows;
/// 1, Q72, which divided by a coefficient, Q32, is Q40.
int256 constant FAR_NODES = 199229;
uint256 constant ONE_72 = 1 << 72;
uint256 constant Q20_TO_Q38 = 18;

/// @notice Computes the highlight of a material.
library Specular {
    /// @notice Tabulates coefficient * cos^shininess over cos^2, where it is at least half a level.
    function setTable(uint256 coefficient, uint256 shininess) internal pure {
        unchecked {
            store(SPECULAR_ROOT, shininess == 1 ? coefficient >> (Q32 - Q16) : 0);
            if (coefficient == 0 || shininess == 1) {
                // no square exceeds this
                store(SPECULAR_BEGIN, NO_HIGHLIGHT);
                return;
            }
            uint256 width = 13;
            for (uint256 k = ONE_32; k < coefficient; k <<= 1) width += 2;
            width = (width << Q24) / shininess;
            if (width > ONE_24) width = ONE_24;
            uint256 begin = ONE_24 - width;
            store(SPECULAR_BEGIN, begin);
            store(SPECULAR_SCALE, (SPECULAR_ENTRIES << Q40) / width);
            store(SPECULAR_OFFSET, (begin * load(SPECULAR_SCALE)) >> Q16);
            uint256 last = (coefficient * power(ONE_24, shininess)) >> (Q32 + Q32 - Q16);
            uint256 pointer = SPECULAR_TABLE + SPECULAR_ENTRIES * 32;
            store(pointer, last << SPECULAR_VALUE_AT);
            for (uint256 i = SPECULAR_ENTRIES; i != 0; ) {
                --i;
                pointer -= 32;
                uint256 value = (coefficient * power(begin + width * i / SPECULAR_ENTRIES, shininess)) >> (Q32 + Q32 - Q16);
                store(pointer, (value << SPECULAR_VALUE_AT) | (last - value));
                last = value;
            }
        }
    }

    /// @dev Returns square^(exponent / 2), where square is Q24 and the result Q32.
    function power(uint256 square, uint256 exponent) private pure returns (uint256 result) {
        unchecked {
            uint256 base = square << (Q32 - Q24);
            result = exponent & 1 == 0 ? ONE_32 : sqrt(base << Q32);
            for (exponent >>= 1; exponent != 0; exponent >>= 1) {
                if (exponent & 1 != 0) result = (result * base) >> Q32;
                base = (base * base) >> Q32;
            }
        }
    }

    /// @notice Sets how far half vectors can be interpolated: see SmoothTriangle.
    /// @param lampReach The maximum sum of the squares of two edges, in sub-pixels, for which directions to a lamp can be.
    /// @param focal The focal length in sub-pixels; 0 for an orthographic camera, for which half vectors are constant.
    function setReaches(uint256 coefficient, uint256 shininess, uint256 lampReach, uint256 focal) internal pure {
        unchecked {
            // the maximum slope of cos^n is 0.6 * sqrt(n): 4 / (255 * 0.6 * 0.15) = 0.174 = 11 / 63
            uint256 slope = (sqrt(shininess << (Q32 + Q32)) * coefficient) >> Q32;
            uint256 reach = slope == 0 || focal == 0 ? UNBOUNDED_REACH : (11 * focal * focal << (Q32 - 6)) / slope;
            store(SMOOTH_REACH, lampReach < reach ? lampReach : reach);
            store(SMOOTH_REACH_3, lampReach < 5 * reach / 2 ? 8 * lampReach : 20 * reach);
            store(HALF_SLOPE, (3109 * shininess * coefficient) >> Q32);
            // 2.8 = 2936013 / 2^20
            store(FAR_FROM_HIGHLIGHT, (1 << Q20) - 2936013 / shininess);
        }
    }

    /// @notice Sets which smooth triangles may have a highlight, and how far their normals may turn then: see SmoothLight.
    function setTurn(uint256 coefficient, uint256 shininess) internal pure {
        unchecked {
            store(COSINE_FAR, NO_HIGHLIGHT);
            store(COSINE_BEGIN, NO_HIGHLIGHT);
            if (load(SPECULAR_BEGIN) == NO_HIGHLIGHT) return;
            store(COSINE_BEGIN, sqrt(load(SPECULAR_BEGIN) << Q24));
            int256 far = loadSigned(FAR_FROM_HIGHLIGHT) - FAR_NODES;
            store(COSINE_FAR, far > 0 ? sqrt(uint256(far) << Q20_TO_Q38) : 0);
            store(SHINY_TURN, sqrt(ONE_72 / (shininess * coefficient)));
        }
    }

    /// @dev Returns whether the highlight is the cosine itself: as a function of its square, which the tables use, it is too steep near
    /// zero to be interpolated, so each fragment computes the root.
    function isBroad(Material calldata material) internal pure returns (bool) {
        return material.shininess == 1 && material.specular.raw() != 0;
    }
}
