// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Quadratic} from "../shading/Quadratic.sol";
import {doubleAreaOf} from "../geometry/Screen.sol";
import {Shading} from "../shading/Shading.sol";
import {LESS_BITS, SmoothLight} from "../shading/SmoothLight.sol";
import {SMOOTH_BIAS} from "../shading/SmoothShading.sol";
import {SmoothTriangle, STEEP_LIGHT, UNBOUNDED_LIGHT} from "../shading/SmoothTriangle.sol";
import {SampleRasterizer} from "./SampleRasterizer.sol";
import "../../words/SampleRegisters.sol";

// Chooses how `shade` of picture.py is computed in a smooth triangle.
// Smooth surfaces lit by lamps, with four samples per pixel where open edges are: see OpenEdges.

/// @dev Twice the area, in sub-pixels, of 6 pixels, and of 20: below, six nodes cost more than they save at fragments.
uint256 constant LEAST_NORMALISED = 12 << 16;
uint256 constant LEAST_VARIED = 40 << 16;
/// @dev The square of twice the area of a triangle whose heights are at least half a pixel is 2^15 times that of two edges: fragments
/// outside of narrower ones would have light beyond its lanes.
uint256 constant NARROW_BITS = 15;
/// @dev The shift that leaves the colours of an attribute word, for SAME_COLOR; its values for several colours, and before any; from the
/// table of the highlight to SHINE_TABLE; the bytes of the coefficients of a quadratic function.
uint256 constant COLORS_TO_TOP = 88;
uint256 constant VARIED_COLORS = 0;
uint256 constant NO_COLORS = 2;
uint256 constant Q16_TO_Q42 = 26;
uint256 constant COEFFICIENTS = 0xc0;

/// @dev Steep triangles are those whose depth changes by this power of 2 from pixel to pixel: by 1/16 to 1/8 of the nearest one of the
/// scene, which is 2^61 to 2^62, see SampleDepths. Less would cost the samples of intersections in small pictures. It is the same for all
/// triangles in a plane.
uint256 constant STEEP_AT = 58;

abstract contract SmoothSamples is SampleRasterizer {
    /// @dev Prepares the registers that differ between objects.
    function openSmooth() internal pure {
        unchecked {
            store(SAME_COLOR, NO_COLORS);
            if (load(SPECULAR_BEGIN) == NO_HIGHLIGHT) return;
            assembly ("memory-safe") {
                let place := SHINE_TABLE
                for { let light := LIGHTS } lt(light, mload(LIGHTS_END)) { light := add(light, LIGHT_SIZE) } {
                    // lanes of 85 bits
                    let color := mload(add(light, LIGHT_COLOR))
                    let upper := or(shl(MIDDLE_56_TO_85, and(color, MIDDLE_LANE_24)), shl(UPPER_56_TO_85, and(color, UPPER_LANE_24)))
                    color := or(and(color, LANE_24), upper)
                    for { let entry := SPECULAR_TABLE } lt(entry, SPECULAR_TABLE_END) { entry := add(entry, 32) } {
                        mstore(place, shl(Q16_TO_Q42, mul(color, shr(SPECULAR_VALUE_AT, mload(entry)))))
                        place := add(place, 32)
                    }
                }
            }
        }
    }

    function isSmooth() internal pure override returns (bool) {
        return true;
    }

    function hasBacks() internal pure override returns (bool) {
        return load(BACK_COUNT) != 0;
    }

    function shade(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure override {
        unchecked {
            (uint256 p, uint256 q, uint256 r) = Shading.attributesOf(a, b, c);
            uint256 mode = (load(OBJECT_MODE) & ~IS_QUADRATIC) | crossing;
            uint256 light = lightOf(a, b, c, ((p ^ q) | (p ^ r)) << COLORS_TO_TOP == 0 ? 0 : IS_VARIED);
            if (light == UNBOUNDED_LIGHT) {
                Shading.setNormals(a, b, c);
                return Shading.setExact(a, b, c, p, q, r, mode);
            }
            uint256 color = light & IS_VARIED == 0 ? (p << COLORS_TO_TOP) + 1 : VARIED_COLORS;
            if (color != load(SAME_COLOR)) setColor(color, p);
            store(MODE, mode | light);
            store(ATTRIBUTE_0, (p << ACCUMULATOR_FRACTION) + SMOOTH_BIAS);
            store(DELTA_1, q - p);
            store(DELTA_2, r - p);
        }
    }

    /// @dev Computes the coefficients of the light.
    /// @param varied IS_VARIED if the vertices have several colours, otherwise 0.
    /// @return mode The bits of MODE; UNBOUNDED_LIGHT if the error may be too large.
    function lightOf(uint256 a, uint256 b, uint256 c, uint256 varied) private pure returns (uint256 mode) {
        unchecked {
            uint256 size = Shading.squareSize(a, b, c);
            // skip triangles that are too large
            if (size >= load(SMOOTH_REACH_3)) return UNBOUNDED_LIGHT;
            uint256 kind = SmoothTriangle.setLight(a, b, c, size, false);
            if (kind == UNBOUNDED_LIGHT || (varied != 0 && kind == STEEP_LIGHT)) return UNBOUNDED_LIGHT;
            mode = varied | IS_QUADRATIC;
            uint256 area = uint256(doubleAreaOf(a, b, c));
            bool isWide = area * area > size << NARROW_BITS;
            if (load(LIGHTS_END) == LIGHTS + LIGHT_SIZE) {
                if (isWide && area > (varied == 0 ? LEAST_NORMALISED : LEAST_VARIED) && SmoothLight.normalise()) mode |= IS_NORMALISED;
                return mode;
            }
            if (!isWide || !SmoothLight.normalise()) return UNBOUNDED_LIGHT;
            assembly ("memory-safe") {
                mcopy(FIRST_LIGHT, QUADRATIC_1, COEFFICIENTS)
            }
            store(LIGHT_OFFSET, LIGHT_SIZE);
            kind = SmoothTriangle.setLight(second(a), second(b), second(c), size, false);
            store(LIGHT_OFFSET, 0);
            if (kind == UNBOUNDED_LIGHT || !SmoothLight.normalise()) return UNBOUNDED_LIGHT;
            assembly ("memory-safe") {
                function join(place) {
                    let first := add(place, sub(FIRST_LIGHT, QUADRATIC_1))
                    mstore(place, add(mload(first), shl(LANE_2_AT, mload(place))))
                }
                join(QUADRATIC_1)
                join(QUADRATIC_S)
                join(QUADRATIC_T)
                join(QUADRATIC_SS)
                join(QUADRATIC_ST)
                join(QUADRATIC_TT)
            }
            return mode | IS_NORMALISED | IS_PAIR;
        }
    }

    /// @dev Returns the address of the record of a vertex for the second lamp.
    function second(uint256 vertex) private pure returns (uint256 record) {
        unchecked {
            vertex &= SCREEN_RECORD_MASK;
            record = vertex + SMOOTH_RECORD_SIZE;
            if (load(record + VERTEX_STATE) == 0) {
                assembly ("memory-safe") {
                    mcopy(record, vertex, VERTEX_REVERSED)
                }
            }
        }
    }

    /// @dev Sets the registers of the light on a colour that all vertices have, or of the light alone.
    /// @param color For SAME_COLOR.
    /// @param word An attribute word.
    function setColor(uint256 color, uint256 word) private pure {
        unchecked {
            store(SAME_COLOR, color);
            uint256 source = AMBIENT;
            for (uint256 place = SAME_AMBIENT; place != SAME_DIFFUSE_2 + 32; place += 32) {
                uint256 light = load(source);
                store(place, color == VARIED_COLORS ? light : product(word, light) << Q26_TO_Q34);
                source = source == AMBIENT ? LIGHTS + LIGHT_DIFFUSE : source + LIGHT_SIZE;
            }
            store(SAME_AMBIENT, load(SAME_AMBIENT) << Q24);
            if (color != VARIED_COLORS) store(SAME_AMBIENT, load(SAME_AMBIENT) + HALF_85);
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
            uint256 less = load(MODE) & IS_NORMALISED == 0 ? 0 : LESS_BITS;
            Quadratic.setDifferences(a, b, c, row, column, load(SAMPLE_STRIDE) >> SAMPLE_SIZE_BITS, less);
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
