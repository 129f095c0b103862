// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Lighting} from "./Lighting.sol";
import {Patches} from "./Patches.sol";
import {Rasterizer} from "../geometry/Rasterizer.sol";
import {doubleAreaOf, firstRowOf, max, min} from "../geometry/Screen.sol";
import {EIGHT_ROWS, Shading} from "./Shading.sol";
import {VertexHighlights} from "./VertexHighlights.sol";
import "../../words/Registers.sol";

// Chooses how `shade` of picture.py is computed in a flat or unlit triangle.
// Selects how precisely flat and unlit triangles are shaded.

/// @dev Addend that sets a bit of OVERFLOW in each colour that may exceed 255 at a fragment: half a level, by which fragments are rounded,
/// plus eight steps of Q10, since interpolation is off by at most one.
uint256 constant NEARLY_ABOVE = 0x2080000000000020800000000000208;
/// @dev A REACH above the size of any triangle.
uint256 constant NO_LIMIT = 1 << 60;
/// @dev Twice the area, in sub-pixels, of 10 pixels.
uint256 constant SMALL = 20 << 16;

abstract contract FlatShading is Rasterizer {
    function isSmooth() internal pure override returns (bool) {
        return false;
    }

    function hasBacks() internal pure override returns (bool) {
        return false;
    }

    function shade(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure override {
        if (load(OBJECT_MODE) & IS_FLAT != 0) return shadeFlat(a, b, c, crossing);
        uint256 p;
        uint256 q;
        uint256 r;
        bool linear;
        assembly ("memory-safe") {
            p := mload(add(and(a, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
            q := mload(add(and(b, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
            r := mload(add(and(c, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
            // At most 8 rows, and depths that differ by at most 1/24 of the first vertex's depth, and so by less than 1/22 of the minimum:
            // equivalent to `isAffine` without computing minima. |d| <= depth / 24 is computed as 0 <= 24 * d + depth <= 2 * depth on whole
            // words: the bits below the depths are less than one unit of depth.
            let second := mul(24, sub(q, p)) // 24 (q - p)
            let third := mul(24, sub(r, p)) // 24 (r - p)
            let limit := shl(1, p)
            linear := or(or(gt(add(second, p), limit), gt(add(third, p), limit)), gt(add(sub(second, third), p), limit))
            limit := add(a, EIGHT_ROWS) // a limit of b and c from here on
            linear := iszero(or(linear, or(gt(b, limit), gt(c, limit))))
        }
        if (linear || Shading.isAffine(p, q, r, a, b, c)) return Shading.setLinear(p, q, r, crossing);
        setPatch(a, b, c, p, q, r, load(OBJECT_MODE) | crossing);
    }

    /// @dev Shades a flat triangle.
    function shadeFlat(uint256 a, uint256 b, uint256 c, uint256 crossing) private pure {
        (uint256 mode, uint256 light) = Lighting.setFace(crossing);
        uint256 p;
        uint256 q;
        uint256 r;
        assembly ("memory-safe") {
            p := mload(add(and(a, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
            q := mload(add(and(b, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
            r := mload(add(and(c, SCREEN_RECORD_MASK), VERTEX_ATTRIBUTES))
        }
        if (mode & IS_DIFFUSE == 0) {
            bool linear;
            if (mode & IS_GREY == 0) {
                (p, q, r) = (Shading.lit(p, light), Shading.lit(q, light), Shading.lit(r, light));
            } else {
                assembly ("memory-safe") {
                    // all channels at once: color * light, Q16, and the depth as it is
                    light := and(light, LANE_32)
                    let color := and(p, LANES_24)
                    p := or(and(shr(LIGHT_FRACTION, mul(color, light)), LANES_24), xor(p, color))
                    color := and(q, LANES_24)
                    q := or(and(shr(LIGHT_FRACTION, mul(color, light)), LANES_24), xor(q, color))
                    color := and(r, LANES_24)
                    r := or(and(shr(LIGHT_FRACTION, mul(color, light)), LANES_24), xor(r, color))
                }
            }
            assembly ("memory-safe") {
                // as in `shade`
                let second := mul(24, sub(q, p)) // 24 (q - p)
                let third := mul(24, sub(r, p)) // 24 (r - p)
                let limit := shl(1, p)
                linear := or(gt(add(sub(second, third), p), limit), and(or(or(p, q), r), OVERFLOW))
                linear := or(linear, or(gt(add(second, p), limit), gt(add(third, p), limit)))
                limit := add(a, EIGHT_ROWS) // a limit of b and c from here on
                linear := iszero(or(linear, or(gt(b, limit), gt(c, limit))))
            }
            if (linear || Shading.isAffine(p, q, r, a, b, c)) {
                if (mode & IS_LIT == 0) return setLit(p, q, r, crossing);
                if (Shading.squareSize(a, b, c) < load(REACH)) {
                    (p, q, r) = VertexHighlights.addTo(a, b, c, p, q, r);
                    return setLit(p, q, r, crossing);
                }
            }
        }
        Lighting.setFacing();
        setPatch(a, b, c, p, q, r, mode | crossing);
    }

    /// @dev Sets the registers of a triangle with linear colours. If they may exceed 255, a loop that clamps them is selected.
    function setLit(uint256 p, uint256 q, uint256 r, uint256 crossing) private pure {
        assembly ("memory-safe") {
            let above := or(or(add(p, NEARLY_ABOVE), add(q, NEARLY_ABOVE)), add(r, NEARLY_ABOVE))
            mstore(MODE, or(crossing, iszero(iszero(and(above, OVERFLOW))))) // crossing, and IS_LINEAR if any bit of OVERFLOW is set
            mstore(ATTRIBUTE_0, add(shl(ACCUMULATOR_FRACTION, p), COLOR_BIAS))
            mstore(DELTA_1, sub(q, p))
            mstore(DELTA_2, sub(r, p))
        }
    }

    /// @dev Selects quadratic colours, or individual fragments.
    function setPatch(uint256 a, uint256 b, uint256 c, uint256 p, uint256 q, uint256 r, uint256 mode) private pure {
        unchecked {
            Shading.setExact(a, b, c, p, q, r, mode);
            store(PATCH_WEIGHT, 0);
            uint256 size = patchSize(a, b, c, p, q, r);
            store(PATCH_SIZE, size);
            if (size == 0) {
                uint256 top = max(firstRowOf(a), load(BAND_TOP));
                Patches.fitWhole(a, b, c, p >> ATTRIBUTE_DEPTH_AT, q >> ATTRIBUTE_DEPTH_AT, r >> ATTRIBUTE_DEPTH_AT, top);
            }
        }
    }

    /// @dev Returns the size of the area over which colours are approximated by quadratic functions: see PATCH_SIZE and PATCH_WEIGHT.
    ///
    /// If third derivatives are at most D, the error of such a function is at most D * d^3 / 125 in a triangle of longest edge d with exact
    /// colours at vertices and edge midpoints, and at most D * d^3 / 96 in a square of side d with nine exact colours.
    ///
    /// Perspective: along an edge with depths that differ by k of their mean, the error is k^2/2 * (u - u^3) / (1 + ku) * dc for u from -1
    /// to 1 and colours dc apart: 1.5 levels of 255 for k = 1/6. For larger k, colours times depths are approximated instead; they are
    /// linear without highlights, and eight pixels at a time are divided by their depths. There k may be up to 1/5: 2.2 levels.
    ///
    /// Light: a highlight cos^n of strength m has a third derivative of at most 1.4 * n^1.5 * m with respect to the angle of H, which turns
    /// by d / 2f over d pixels. At the size at which linear functions are off by 1.5 levels, d^2 = REACH, the error is 0.03 / sqrt(m) *
    /// (d^2 / REACH)^1.5 levels: for d^2 = 16 * REACH it is 2 / sqrt(m), and the same in squares of 11 * REACH; for m below 1/4 it is far
    /// below that, since m is at most 64 levels then. Multiplied by the depth z, the third derivative grows by 3 * z' / z times the second
    /// one: at most 4 levels if depths in the triangle differ by a factor of 2.
    ///
    /// Cells extend beyond the triangle by up to their size. Within a cell, depths change by at most 7/8 of the farthest depth in the
    /// triangle, so that they are positive; k is that of the cell.
    function patchSize(uint256 a, uint256 b, uint256 c, uint256 za, uint256 zb, uint256 zc) private pure returns (uint256 size) {
        unchecked {
            uint256 mode = load(MODE);
            uint256 area = uint256(doubleAreaOf(a, b, c));
            // small triangles need the fewest exact colours this way
            if (area < SMALL || mode & IS_STEEP != 0) return 1;
            uint256 nearest = max(za, max(zb, zc)) >> ATTRIBUTE_DEPTH_AT;
            uint256 farthest = min(za, min(zb, zc)) >> ATTRIBUTE_DEPTH_AT;
            uint256 reach = NO_LIMIT;
            if (mode & IS_LIT != 0) reach = mode & IS_DIFFUSE == 0 ? load(REACH) : Lighting.pointReach(farthest);
            uint256 along;
            uint256 down;
            if (mode & IS_ORTHOGRAPHIC == 0) (along, down) = slopes(a, b, c, za, zb, zc);
            uint256 change = nearest - farthest;
            uint256 mean = nearest + farthest;
            if (longest(a, b, c) >= 16 * reach || (reach != NO_LIMIT && nearest > 2 * farthest)) {
                mean = 2 * farthest * area;
                change = 512 * (along + down);
                size = 64;
                while (size * size << 2 * SUBPIXEL_BITS >= 11 * reach || 8 * change * size > 7 * mean) if ((size >>= 1) == 4) return 1;
                change *= size;
            }
            if (mode & IS_ORTHOGRAPHIC == 0) {
                uint256 bright = brightness(za | zb | zc, mode);
                if (6 * change * bright > mean) {
                    // so that colours times depths, Q72, fit their lanes; includes the change of depth over eight pixels of a row
                    if (bright > 8 || 5120 * along > farthest * area) return 1;
                    store(PATCH_WEIGHT, nearest << DEPTH_FRACTION);
                }
            }
        }
    }

    /// @dev Returns the square of the longest edge, in sub-pixels.
    function longest(uint256 a, uint256 b, uint256 c) private pure returns (uint256) {
        return max(squareLength(a, b), max(squareLength(a, c), squareLength(b, c)));
    }

    /// @dev Returns the square of an edge, in sub-pixels.
    function squareLength(uint256 p, uint256 q) private pure returns (uint256 square) {
        assembly ("memory-safe") {
            square := sub(shr(SCREEN_ROW_AT, p), shr(SCREEN_ROW_AT, q)) // dy; p from here on dx
            p := sub(and(shr(SCREEN_COLUMN_AT, p), SCREEN_COLUMN_MASK), and(shr(SCREEN_COLUMN_AT, q), SCREEN_COLUMN_MASK))
            square := add(mul(square, square), mul(p, p)) // dy^2 + dx^2
        }
    }

    /// @dev Returns the changes of depth along a row and along a column, times twice the area.
    function slopes(uint256 a, uint256 b, uint256 c, uint256 za, uint256 zb, uint256 zc)
        private pure returns (uint256 along, uint256 down)
    {
        assembly ("memory-safe") {
            za := shr(ATTRIBUTE_DEPTH_AT, za) // depths from here on: of the first vertex, and relative to it
            zb := sub(shr(ATTRIBUTE_DEPTH_AT, zb), za)
            zc := sub(shr(ATTRIBUTE_DEPTH_AT, zc), za)
            let y := shr(SCREEN_ROW_AT, a)
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            along := sub(mul(zc, sub(shr(SCREEN_ROW_AT, b), y)), mul(zb, sub(shr(SCREEN_ROW_AT, c), y))) // zc yb - zb yc
            along := xor(along, sar(255, along)) // the absolute value, or one less
            down := sub( // zb xc - zc xb
                mul(zb, sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x)),
                mul(zc, sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x))
            )
            down := xor(down, sar(255, down))
        }
    }

    /// @dev Returns the maximum brightness of colours in multiples of 255.
    function brightness(uint256 colors, uint256 mode) private pure returns (uint256 times) {
        unchecked {
            if (mode & IS_DIFFUSE == 0) {
                colors >>= OVERFLOW_AT;
                times = 1 + ((colors | (colors >> MIDDLE_AT) | (colors >> UPPER_AT)) & OVERFLOW_MASK);
            } else {
                uint256 light = load(AMBIENT);
                for (uint256 record = LIGHTS; record != load(LIGHTS_END); record += LIGHT_SIZE) light += load(record + LIGHT_DIFFUSE);
                light >>= LIGHT_FRACTION;
                times = 1 + ((light | (light >> MIDDLE_AT) | (light >> UPPER_AT)) & 0xffff);
            }
        }
    }
}
