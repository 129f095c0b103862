// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ANY, FragmentLight} from "./FragmentLight.sol";
import {Quadratic} from "./Quadratic.sol";
import "../../words/Registers.sol";

// Fits quadratic functions to `shade` of picture.py.
// Flat and unlit triangles whose colours are not linear on the screen: colours are approximated by quadratic functions, fitted to exact
// colours over the whole triangle or over its square cells. The cells are aligned to the canvas, not to the tile, so that tiles match the
// whole picture.

/// @dev From a colour of Q10 to its derivative, Q58, from the differences of values that are 2, 4 and 8 half lengths apart.
uint256 constant Q10_TO_HALF_Q58 = 47;
uint256 constant Q10_TO_FOURTH_Q58 = 46;
uint256 constant Q10_TO_EIGHTH_Q58 = 45;
/// @dev From the sum of two sub-pixel coordinates to their mean in pixels; from a sum of two depths to their mean with DEPTH_FRACTION bits.
uint256 constant SUM_OF_SUBPIXEL_BITS = 9;
uint256 constant SUM_OF_DEPTHS_FRACTION = 7;

library Patches {
    /// @notice Fits a quadratic function to nine exact colours of the cell, where all depths are positive.
    function fit(uint256 column, uint256 row, uint256 start, uint256 size) internal pure {
        unchecked {
            uint256 half = size / 2;
            uint256 x = column + half;
            uint256 y = row / size * size + half;
            // from column 0 of the row to the centre
            start += x * load(DX) + (y - row) * load(DY);
            uint256 dx = half * load(DX);
            uint256 dy = half * load(DY);
            x = load(RAY_LEFT) + x * load(RAY_STEP);
            y = load(RAY_TOP) + y * load(RAY_STEP);
            uint256 step = half * load(RAY_STEP);
            uint256 left = weightedAt(start - dx, x - step, y);
            uint256 right = weightedAt(start + dx, x + step, y);
            uint256 middle = weightedAt(start, x, y);
            store(QUADRATIC_1, middle);
            store(QUADRATIC_SS, left + right - 2 * middle);
            store(QUADRATIC_S, right - left);
            left = weightedAt(start - dy, x, y - step);
            right = weightedAt(start + dy, x, y + step);
            store(QUADRATIC_TT, left + right - 2 * middle);
            store(QUADRATIC_T, right - left);
            left = weightedAt(start - dx - dy, x - step, y - step);
            right = weightedAt(start + dx + dy, x + step, y + step);
            start += dx - dy;
            x += step;
            y -= step;
            middle = weightedAt(start, x, y);
            start = weightedAt(start + 2 * (dy - dx), x - 2 * step, y + 2 * step);
            place(column + half, row - (row / size * size + half), size, right - left, middle - start, left + right - middle - start);
        }
    }

    /// @param down, up, cross Differences of the corners: lower right minus upper left, upper right minus lower left, and that of the sums
    /// of both pairs.
    function place(uint256 x, uint256 y, uint256 size, uint256 down, uint256 up, uint256 cross) private pure {
        unchecked {
            uint256 shift = 0;
            for (; size > 2; size >>= 1) ++shift;
            // Changes per pixel, Q58, where half the size is 2^shift. The first derivatives are the means of those along the centre lines
            // and along the borders: if third derivatives are not zero, one has twice the error of the other, with opposite sign.
            uint256 a = (2 * load(QUADRATIC_S) + down + up) << (Q10_TO_EIGHTH_Q58 - shift);
            uint256 b = (2 * load(QUADRATIC_T) + down - up) << (Q10_TO_EIGHTH_Q58 - shift);
            uint256 xx = load(QUADRATIC_SS) << (Q10_TO_HALF_Q58 - 2 * shift);
            uint256 yy = load(QUADRATIC_TT) << (Q10_TO_HALF_Q58 - 2 * shift);
            uint256 xy = cross << (Q10_TO_FOURTH_Q58 - 2 * shift);
            // from the centre to column 0 of the row
            x = 0 - x;
            store(QUADRATIC_START, (load(QUADRATIC_1) << Q10_TO_Q58) + bias() + x * (a + x * xx + y * xy) + y * (b + y * yy));
            store(QUADRATIC_DX, a + (2 * x + 1) * xx + y * xy);
            store(QUADRATIC_DY, b + (2 * y + 1) * yy + x * xy);
            store(QUADRATIC_DXX, 2 * xx);
            store(QUADRATIC_DXY, xy);
            store(QUADRATIC_DYY, 2 * yy);
        }
    }

    /// @dev Returns the colour for this accumulator and ray, as quadratic functions approximate it.
    function weightedAt(uint256 attribute, uint256 x, uint256 y) private pure returns (uint256) {
        return weighted(FragmentLight.colorOf(attribute, x, y), attribute >> ACCUMULATOR_DEPTH_AT);
    }

    /// @dev Returns a colour as quadratic functions approximate it: if depths differ much, multiplied by its depth relative to the nearest,
    /// Q14.
    function weighted(uint256 color, uint256 depth) private pure returns (uint256) {
        unchecked {
            uint256 nearest = load(PATCH_WEIGHT);
            return nearest == 0 ? color : color * ((depth << Q14) / nearest);
        }
    }

    /// @notice Returns a colour, Q58, from the value of such a function with BIAS_84: a colour times its depth, Q72.
    function unweighted(uint256 value, uint256 depth) internal pure returns (uint256 color) {
        assembly ("memory-safe") {
            value := sub(and(shr(Q48, value), LANES_37), BIAS_36) // Q24
            color := add(mul(value, div(shl(Q34, mload(PATCH_WEIGHT)), depth)), HALF_85) // value * nearest / depth + half a level
        }
    }

    /// @dev Returns the bias of a quadratic function: for rounding, or to keep it positive until it is divided by the depth.
    function bias() private pure returns (uint256) {
        return load(PATCH_WEIGHT) == 0 ? HALF_85 : BIAS_84;
    }

    /// @notice Fits a quadratic function to six exact colours of the triangle.
    function fitWhole(uint256 a, uint256 b, uint256 c, uint256 za, uint256 zb, uint256 zc, uint256 top) internal pure {
        unchecked {
            // a copy for two zeros is wanted, since it computes less, but none for other literals: see ZERO_SLOT
            uint256 none = load(ZERO_SLOT);
            (uint256 one, uint256 half) = (none + ONE_24, none + HALF_24);
            uint256 fa = between(a, a, za << DEPTH_FRACTION, 0, 0);
            uint256 fb = between(b, b, zb << DEPTH_FRACTION, one, none);
            uint256 fc = between(c, c, zc << DEPTH_FRACTION, none, one);
            uint256 ab = between(a, b, (za + zb) << SUM_OF_DEPTHS_FRACTION, half, none);
            uint256 ac = between(a, c, (za + zc) << SUM_OF_DEPTHS_FRACTION, none, half);
            Quadratic.fromNodes(fa, fb, fc, ab, ac, between(b, c, (zb + zc) << SUM_OF_DEPTHS_FRACTION, half, half));
            Quadratic.setDifferences(a, b, c, top);
            store(QUADRATIC_START, load(QUADRATIC_START) + bias());
        }
    }

    /// @dev Returns the colour at the midpoint between two vertices on the screen.
    function between(uint256 a, uint256 b, uint256 depth, uint256 s, uint256 t) private pure returns (uint256) {
        uint256 x;
        uint256 y;
        assembly ("memory-safe") {
            x := add(and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK), and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK))
            x := add(mload(RAY_LEFT), sar(SUM_OF_SUBPIXEL_BITS, mul(x, mload(RAY_STEP)))) // RAY_LEFT + column * RAY_STEP
            y := add(shr(SCREEN_ROW_AT, a), shr(SCREEN_ROW_AT, b))
            y := add(mload(RAY_TOP), sar(SUM_OF_SUBPIXEL_BITS, mul(y, mload(RAY_STEP))))
        }
        return weighted(FragmentLight.colorAt(depth, s, t, x, y, ANY), depth);
    }
}
