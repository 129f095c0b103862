// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../../words/Registers.sol";

// Interpolates `shade` of picture.py between six places of a triangle.
// Quadratic functions of the position on the screen, three in a word, in signed lanes of 85 bits. A smooth function that is interpolated
// from its values at the corners and edge midpoints of a triangle (the P2 element) has errors of third order only.
//
// With the barycentric coordinates s of the second vertex and t of the third,
//
//   value = QUADRATIC_1 + s * QUADRATIC_S + t * QUADRATIC_T + s^2 * QUADRATIC_SS + s * t * QUADRATIC_ST + t^2 * QUADRATIC_TT
//
// where the coefficients have any Q format, Qn. Coordinates are Q24, so products with them have 48 more bits: Qn+48. Only sums and products
// with integers are computed: intermediate overflows of lanes cancel at each pixel whose value fits its lane, and a row or column yields
// the same bits wherever the differences start.

library Quadratic {
    /// @notice Computes the coefficients from the values at the vertices and the edge midpoints.
    function fromNodes(uint256 a, uint256 b, uint256 c, uint256 ab, uint256 ac, uint256 bc) internal pure {
        assembly ("memory-safe") {
            // along an edge: value = a + s * (b - a) + s * (1 - s) * (4 * ab - 2 * (a + b))
            ab := sub(shl(2, ab), shl(1, add(a, b))) // from here on 4 * ab - 2 * (a + b), the bend of the edge
            ac := sub(shl(2, ac), shl(1, add(a, c)))
            mstore(QUADRATIC_ST, sub(sub(sub(shl(2, bc), shl(1, add(b, c))), ab), ac)) // that of bc - ab - ac
            mstore(QUADRATIC_SS, sub(0, ab))
            mstore(QUADRATIC_TT, sub(0, ac))
            mstore(QUADRATIC_S, add(sub(b, a), ab)) // b - a + bend
            mstore(QUADRATIC_T, add(sub(c, a), ac))
            mstore(QUADRATIC_1, a)
        }
    }

    /// @notice Computes the value at column 0 of row `top` (QUADRATIC_START) and its differences from the coefficients. The change from
    /// column x of row y to column x + 1 is QUADRATIC_DX + x * QUADRATIC_DXX + y * QUADRATIC_DXY; rows likewise.
    /// @param a, b, c The screen words of the vertices, as for the triangle.
    function setDifferences(uint256 a, uint256 b, uint256 c, uint256 top) internal pure {
        // literals, for which the compiler makes a function
        setDifferences(a, b, c, top, 0, 0, 0);
    }

    /// @notice The same if column 0 means another column.
    /// @param column That column in row `top`; it is `further` columns to the right in each row below.
    /// @param less The number of bits by which coordinates are shorter than Q24, for narrower lanes.
    function setDifferences(uint256 a, uint256 b, uint256 c, uint256 top, uint256 column, uint256 further, uint256 less) internal pure {
        assembly ("memory-safe") {
            let x := and(shr(SCREEN_COLUMN_AT, a), SCREEN_COLUMN_MASK)
            let xb := sub(and(shr(SCREEN_COLUMN_AT, b), SCREEN_COLUMN_MASK), x)
            let xc := sub(and(shr(SCREEN_COLUMN_AT, c), SCREEN_COLUMN_MASK), x)
            a := shr(SCREEN_ROW_AT, a) // rows from here on: ya, yb - ya, yc - ya
            b := sub(shr(SCREEN_ROW_AT, b), a)
            c := sub(shr(SCREEN_ROW_AT, c), a)
            // from the first vertex to the centres of the row
            a := sub(shl(SUBPIXEL_BITS, top), a) // a from here on: y
            x := sub(x, shl(SUBPIXEL_BITS, column)) // from that column
            // change of s and t per pixel, Q24: (ds/dx, dt/dx) = (-c, b) / area, (ds/dy, dt/dy) = (xc, -xb) / area, in sub-pixels
            top := shl(less, sub(mul(xc, b), mul(xb, c))) // top from here on: twice the area
            let dsdx := sub(0, sdiv(shl(SUBPIXEL_TO_Q24, c), top))
            let dtdx := sdiv(shl(SUBPIXEL_TO_Q24, b), top)
            xc := sdiv(shl(SUBPIXEL_TO_Q24, xc), top) // xc from here on: ds/dy
            xb := sub(0, sdiv(shl(SUBPIXEL_TO_Q24, xb), top)) // xb from here on: dt/dy
            // b and c from here on: s and t at column 0 of the first row, Q24
            b := sar(SUBPIXEL_BITS, sub(mul(xc, a), mul(dsdx, x))) // ds/dy * y - ds/dx * x
            c := sar(SUBPIXEL_BITS, sub(mul(xb, a), mul(dtdx, x)))
            xc := add(xc, mul(further, dsdx)) // to the next row
            xb := add(xb, mul(further, dtdx))
            {
                // the value, and its derivatives with respect to s and t, Qn+24
                a := mul(b, mload(QUADRATIC_SS)) // a and x from here on: s * SS and t * TT
                x := mul(c, mload(QUADRATIC_TT))
                let ds := add(add(shl(sub(Q24, less), mload(QUADRATIC_S)), a), mul(c, mload(QUADRATIC_ST))) // S + s * SS + t * ST
                let dt := add(shl(sub(Q24, less), mload(QUADRATIC_T)), x) // T + t * TT
                // 1 + s * ds + t * dt
                mstore(QUADRATIC_START, add(shl(sub(Q48, shl(1, less)), mload(QUADRATIC_1)), add(mul(b, ds), mul(c, dt))))
                ds := add(ds, a) // S + 2 s * SS + t * ST
                dt := add(add(dt, x), mul(b, mload(QUADRATIC_ST))) // T + 2 t * TT + s * ST
                // half the second difference along the row: dsdx * (SS * dsdx) + dtdx * (ST * dsdx + TT * dtdx)
                a := mul(dsdx, mload(QUADRATIC_SS)) // a, x, b, c from here on: the terms of this
                x := mul(dtdx, mload(QUADRATIC_TT))
                b := add(mul(dsdx, mload(QUADRATIC_ST)), x)
                c := add(mul(dsdx, a), mul(dtdx, b))
                mstore(QUADRATIC_DX, add(c, add(mul(dsdx, ds), mul(dtdx, dt)))) // c + ds/dx * ds + dt/dx * dt
                mstore(QUADRATIC_DXX, shl(1, c))
                // dsdy * (2 * SS * dsdx + ST * dtdx) + dtdy * (ST * dsdx + 2 * TT * dtdx)
                a := add(shl(1, a), mul(dtdx, mload(QUADRATIC_ST)))
                mstore(QUADRATIC_DXY, add(mul(xc, a), mul(xb, add(b, x))))
                // the same for columns
                b := add(mul(xc, mload(QUADRATIC_ST)), mul(xb, mload(QUADRATIC_TT)))
                c := add(mul(xc, mul(xc, mload(QUADRATIC_SS))), mul(xb, b))
                mstore(QUADRATIC_DY, add(c, add(mul(xc, ds), mul(xb, dt))))
                mstore(QUADRATIC_DYY, shl(1, c))
            }
        }
    }
}
