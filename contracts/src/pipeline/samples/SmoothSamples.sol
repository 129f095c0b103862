// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Quadratic} from "../shading/Quadratic.sol";
import {doubleAreaOf} from "../geometry/Screen.sol";
import {Shading} from "../shading/Shading.sol";
import {SmoothLight} from "../shading/SmoothLight.sol";
import {SMOOTH_BIAS} from "../shading/SmoothShading.sol";
import {SmoothTriangle, STEEP_LIGHT, UNBOUNDED_LIGHT} from "../shading/SmoothTriangle.sol";
import {OpenEdges} from "./OpenEdges.sol";
import {QuadraticSamples} from "./QuadraticSamples.sol";
import {SampleRasterizer} from "./SampleRasterizer.sol";
import "../../words/SampleRegisters.sol";

// Smooth surfaces lit by lamps, with four samples per pixel where open edges are: see OpenEdges.

/// @dev Twice the area, in sub-pixels, of 12 pixels: below, six nodes cost more than they save at fragments.
int256 constant LEAST_NORMALISED = 24 << 16;
/// @dev The shift that leaves the colours of an attribute word; the bytes of the table of the highlight; from its format to that of
/// SHINE_TABLE.
uint256 constant COLORS_TO_TOP = 88;
uint256 constant SPECULAR_SIZE = 0x820;
uint256 constant Q16_TO_Q42 = 26;

/// @dev Steep triangles are those whose depth changes by this power of 2 from pixel to pixel: by 1/16 to 1/8 of the nearest one of the
/// scene, which is 2^61 to 2^62, see SampleDepths. Less would cost the samples of intersections in small pictures. It is the same for all
/// triangles in a plane.
uint256 constant STEEP_AT = 58;

abstract contract SmoothSamples is SampleRasterizer {
    /// @dev Prepares the registers that differ between objects.
    function openSmooth() internal pure {
        unchecked {
            store(SAME_COLOR, 0);
            if (load(OBJECT_MODE) & IS_QUADRATIC == 0 || load(SPECULAR_BEGIN) == NO_HIGHLIGHT) return;
            uint256 color = load(LIGHTS + LIGHT_COLOR);
            assembly ("memory-safe") {
                // lanes of 85 bits
                let upper := or(shl(MIDDLE_56_TO_85, and(color, MIDDLE_LANE_24)), shl(UPPER_56_TO_85, and(color, UPPER_LANE_24)))
                color := or(and(color, LANE_24), upper)
                for { let i := 0 } lt(i, SPECULAR_SIZE) { i := add(i, 32) } {
                    mstore(add(SHINE_TABLE, i), shl(Q16_TO_Q42, mul(color, shr(SPECULAR_VALUE_AT, mload(add(SPECULAR_TABLE, i))))))
                }
            }
        }
    }

    function shade(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure override {
        unchecked {
            uint256 kind = UNBOUNDED_LIGHT;
            uint256 size = Shading.squareSize(a, b, c);
            // skip triangles that are too large
            if (size < load(SMOOTH_REACH_3)) kind = SmoothTriangle.setLight(a, b, c, size, false);
            (uint256 p, uint256 q, uint256 r) = Shading.attributesOf(a, b, c);
            uint256 mode = (load(OBJECT_MODE) & ~IS_QUADRATIC) | crossing;
            bool varies = ((p ^ q) | (p ^ r)) << COLORS_TO_TOP != 0;
            if (kind == UNBOUNDED_LIGHT || (varies && kind == STEEP_LIGHT)) {
                Shading.setNormals(a, b, c);
                return Shading.setExact(a, b, c, p, q, r, mode);
            }
            mode |= IS_QUADRATIC;
            if (varies) {
                mode |= IS_VARIED;
            } else {
                if ((p << COLORS_TO_TOP) + 1 != load(SAME_COLOR)) setSame(p);
                if (doubleAreaOf(a, b, c) > LEAST_NORMALISED && SmoothLight.normalise()) mode |= IS_NORMALISED;
            }
            store(MODE, mode);
            store(ATTRIBUTE_0, (p << ACCUMULATOR_FRACTION) + SMOOTH_BIAS);
            store(DELTA_1, q - p);
            store(DELTA_2, r - p);
        }
    }

    /// @dev Sets the registers of a colour that all vertices have.
    /// @param word An attribute word.
    function setSame(uint256 word) private pure {
        unchecked {
            store(SAME_COLOR, (word << COLORS_TO_TOP) + 1);
            store(SAME_AMBIENT, (product(word, load(AMBIENT)) << Q26_TO_Q58) + HALF_85);
            store(SAME_DIFFUSE, product(word, load(LIGHTS + LIGHT_DIFFUSE)) << Q26_TO_Q34);
        }
    }

    /// @dev Returns a colour, Q10, times light, Q16, both in lanes of 56 bits, in lanes of 85 bits, Q26.
    function product(uint256 color, uint256 light) private pure returns (uint256 lanes) {
        assembly ("memory-safe") {
            lanes := mul(and(color, LANE_24), and(light, LANE_32))
            lanes := add(lanes, shl(MIDDLE_85_AT, mul(and(shr(MIDDLE_AT, color), LANE_24), and(shr(MIDDLE_AT, light), LANE_32))))
            lanes := add(lanes, shl(UPPER_85_AT, mul(and(shr(UPPER_AT, color), LANE_24), shr(UPPER_AT, light))))
        }
    }

    /// @dev Sets the differences of the light relative to address 0, as QuadraticSamples needs them.
    function setRows(uint256 a, uint256 b, uint256 c) internal pure {
        unchecked {
            if (load(MODE) & IS_QUADRATIC == 0) return;
            uint256 row = load(SIDE_ROW);
            uint256 column = load(SAMPLE_ORIGIN) - row * load(SAMPLE_STRIDE);
            column = 0 - uint256(int256(column) >> SAMPLE_SIZE_BITS);
            Quadratic.setDifferences(a, b, c, row, column, load(SAMPLE_STRIDE) >> SAMPLE_SIZE_BITS);
        }
    }

    /// @dev Sets the depths of the samples of whole pixels: beyond the edge of a steep triangle, its depth would be far from that of the
    /// surface.
    function setWholeOffsets() internal pure {
        assembly ("memory-safe") {
            let offsets := mload(DEPTH_OFFSETS)
            let dx := sar(ACCUMULATOR_DEPTH_AT, mload(DX))
            let dy := sar(ACCUMULATOR_DEPTH_AT, mload(DY))
            dx := add(xor(dx, sar(SIGN_AT, dx)), xor(dy, sar(SIGN_AT, dy))) // |dx| + |dy|
            if shr(STEEP_AT, shl(mload(SAMPLE_SHIFT), dx)) { offsets := mul(and(offsets, LANE_64), ONES_64) }
            mstore(WHOLE_OFFSETS, offsets)
        }
    }
}
