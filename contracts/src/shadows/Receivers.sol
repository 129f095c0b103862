// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {VertexShader} from "../pipeline/VertexShader.sol";
import "../pipeline/Registers.sol";
import {ADDRESS_MASK, BEHIND, FACE_B_AT, FACE_C_AT, FACE_PLANES_AT, Faces, PLANES_SIZE, PLANE_SIZE} from "./Faces.sol";

// What one face casts on another. The functions of what casts the shadow, at the corners of the other, become functions of the place on the
// canvas: with homogeneous corners H the function is the sum of f_i * (H_j x H_k), exactly. Divided by a power of two each takes a word:
//
//   bits 208 to 255   its change to the right, per eighth of a pixel; signed, as the others
//   bits 160 to 207   its change downwards
//   bits  96 to 159   its value at the centre of the first pixel of the canvas
//   bits  80 to  95   the first row in which the shadow may be
//   bits  64 to  79   the row after the last
//   bits  48 to  63   the column after the last in which it may be
//   bits  32 to  47   the first one
//   bits   0 to   7   in the first word of what casts the shadow, how many words it has; in others 0
//   bit    8          in the same word, whether it is the last one of the list
//
// Lists are ordered by the first row.

uint256 constant X_AT = 208;
uint256 constant Y_AT = 160;
uint256 constant CONSTANT_AT = 96;
uint256 constant TOP_AT = 80;
uint256 constant BOTTOM_AT = 64;
uint256 constant RIGHT_AT = 48;
uint256 constant LEFT_AT = 32;
uint256 constant LAST_SHADOW = 1 << 8;
uint256 constant ROW_MASK = 0xffff;
uint256 constant LANE_48 = 0xffffffffffff;

/// @dev Bits of the distances of vertices, and of other homogeneous coordinates.
uint256 constant DISTANCE_BITS = 38;
uint256 constant CLIP_BITS = 60;
/// @dev Bits of the change of a function per eighth of a pixel, and below what the functions are on the canvas.
uint256 constant GRADIENT_BITS = 44;
int256 constant BOUND = 1 << 60;
/// @dev More than what rounding takes from a function anywhere on the canvas.
int256 constant SLACK = 1 << 16;
/// @dev Sub-pixels by which the rows and columns of a shadow are widened: to the outermost sample, and for rounding.
int256 constant WIDER = 112;

/// @notice What is known of the face that receives shadows.
/// @param corners The first word of its record.
/// @param places Its corners on the canvas, homogeneous: column and row in sub-pixels, and the distance.
/// @param isVisible Whether it is not seen edge-on.
/// @param weights Their cross products, as the coefficients of functions that are 1 at one corner, but for a positive factor.
/// @param sides Its sides at the corners of what may shade it, three of each side.
/// @param values The functions of that at its own corners.
struct Receiver {
    uint256 corners;
    uint256 planes;
    bool isPlaced;
    bool isVisible;
    int256[9] places;
    int256[9] weights;
    int256[9] sides;
    int256[12] values;
}

uint256 constant MISSED = 0;
uint256 constant COVERED = 1;
uint256 constant MIXED_SHADOW = 2;

library Receivers {
    /// @notice Whether a face shades another.
    /// @param caster Its record.
    /// @return MISSED, COVERED, or MIXED_SHADOW; then `sides` and `values` are set.
    function test(Receiver memory receiver, uint256 caster, bool isPoint) internal pure returns (uint256) {
        unchecked {
            uint256 corners = load(caster);
            (int256 a, int256 b, int256 c) = Faces.values(receiver.planes + BEHIND, corners);
            if (a | b | c >= 0) return MISSED;
            uint256 target;
            {
                int256[9] memory sides = receiver.sides;
                assembly ("memory-safe") {
                    target := sides
                }
            }
            (bool isMissed, int256 signs) = valuesOfSides(receiver.planes, corners, isPoint, target);
            if (isMissed) return MISSED;
            uint256 plane = (corners >> FACE_PLANES_AT) & ADDRESS_MASK;
            if (plane == 0) {
                plane = freeMemory();
                setFreeMemory(plane + PLANES_SIZE);
                Faces.writePlanes(caster, isPoint, plane);
                store(caster, corners | (plane << FACE_PLANES_AT));
            }
            corners = receiver.corners;
            {
                int256[12] memory values = receiver.values;
                assembly ("memory-safe") {
                    target := values
                }
            }
            (isMissed, signs) = valuesOfSides(plane, corners, isPoint, target);
            if (isMissed) return MISSED;
            (a, b, c) = Faces.values(plane + BEHIND, corners);
            if (a <= 0 && b <= 0 && c <= 0) return MISSED;
            storeSigned(target + 0x120, a);
            storeSigned(target + 0x140, b);
            storeSigned(target + 0x160, c);
            return (signs | a | b | c) < 0 ? MIXED_SHADOW : COVERED;
        }
    }

    /// @dev The sides of a face at the corners of another.
    /// @param plane The functions of the one; `corners`: the first word of the record of the other.
    /// @param target Where to write the values, three of each side.
    /// @return isMissed Whether the other is outside a side; then not all values are written.
    /// @return signs Negative if any value is.
    function valuesOfSides(uint256 plane, uint256 corners, bool isPoint, uint256 target)
        private
        pure
        returns (bool isMissed, int256 signs)
    {
        assembly ("memory-safe") {
            let p := and(corners, ADDRESS_MASK)
            let q := and(shr(FACE_B_AT, corners), ADDRESS_MASK)
            let r := and(shr(FACE_C_AT, corners), ADDRESS_MASK)
            let end := add(target, 0x120)
            switch isPoint
            case 0 {
                let py := mload(add(p, 0x20))
                let qy := mload(add(q, 0x20))
                let ry := mload(add(r, 0x20))
                p := mload(p)
                q := mload(q)
                r := mload(r)
                for {} lt(target, end) { target := add(target, 0x60) } {
                    let x := mload(plane)
                    let y := mload(add(plane, 0x20))
                    let w := mload(add(plane, 0x60))
                    let a := add(w, add(mul(x, p), mul(y, py)))
                    let b := add(w, add(mul(x, q), mul(y, qy)))
                    w := add(w, add(mul(x, r), mul(y, ry)))
                    // all are at most 0
                    if slt(and(and(sub(a, 1), sub(b, 1)), sub(w, 1)), 0) {
                        isMissed := 1
                        break
                    }
                    mstore(target, a)
                    mstore(add(target, 0x20), b)
                    mstore(add(target, 0x40), w)
                    signs := or(or(signs, a), or(b, w))
                    plane := add(plane, PLANE_SIZE)
                }
            }
            default {
                for {} lt(target, end) { target := add(target, 0x60) } {
                    let x := mload(plane)
                    let y := mload(add(plane, 0x20))
                    let z := mload(add(plane, 0x40))
                    let a := add(mul(x, mload(p)), add(mul(y, mload(add(p, 0x20))), mul(z, mload(add(p, 0x40)))))
                    let b := add(mul(x, mload(q)), add(mul(y, mload(add(q, 0x20))), mul(z, mload(add(q, 0x40)))))
                    let c := add(mul(x, mload(r)), add(mul(y, mload(add(r, 0x20))), mul(z, mload(add(r, 0x40)))))
                    if slt(and(and(sub(a, 1), sub(b, 1)), sub(c, 1)), 0) {
                        isMissed := 1
                        break
                    }
                    mstore(target, a)
                    mstore(add(target, 0x20), b)
                    mstore(add(target, 0x40), c)
                    signs := or(or(signs, a), or(b, c))
                    plane := add(plane, PLANE_SIZE)
                }
            }
        }
    }

    /// @notice Sets the corners on the canvas. The registers have the mesh and the matrix of the object.
    /// @param numbers The three numbers of the vertices, 16 bits each.
    function place(Receiver memory receiver, uint256 numbers) internal pure {
        unchecked {
            receiver.isPlaced = true;
            int256[9] memory p = receiver.places;
            bool isOrthographic = load(FRAME_IS_ORTHOGRAPHIC) != 0;
            uint256 corner = freeMemory();
            bool isPlain = true;
            uint256 most;
            for (uint256 i; i != 9; i += 3) {
                VertexShader.clipCoordinates((numbers >> (FACE_FIRST_AT - 16 * (i / 3))) & FACE_INDEX_MASK, corner);
                (int256 x, int256 y, int256 w) = (loadSigned(corner), loadSigned(corner + CORNER_Y), loadSigned(corner + CORNER_W));
                if (w < loadSigned(NEAR)) isPlain = false;
                if (isOrthographic) w = int256(ONE_32);
                if (x < 0 || y < 0 || x >= w << GUARD_BITS || y >= w << GUARD_BITS) isPlain = false;
                (p[i], p[i + 1], p[i + 2]) = (x, y, w);
                if (w > int256(most)) most = uint256(w);
            }
            int256 bias = int256(PIXEL_BIAS << SUBPIXEL_BITS);
            if (isPlain) {
                uint256 shift = isOrthographic ? Q32 : excess(most, DISTANCE_BITS);
                for (uint256 i; i != 9; i += 3) {
                    int256 w = p[i + 2] >> shift;
                    p[i] = (p[i] / p[i + 2] - bias) * w;
                    p[i + 1] = (p[i + 1] / p[i + 2] - bias) * w;
                    p[i + 2] = w;
                }
            } else {
                // nearer than the near plane, or far beyond the canvas
                most = 0;
                for (uint256 i; i != 9; i += 3) {
                    p[i] -= bias * p[i + 2];
                    p[i + 1] -= bias * p[i + 2];
                    for (uint256 k = i; k != i + 3; ++k) if (magnitude(p[k]) > most) most = magnitude(p[k]);
                }
                uint256 shift = excess(most, CLIP_BITS);
                for (uint256 i; i != 9; ++i) p[i] >>= shift;
            }
            int256[9] memory weights = receiver.weights;
            cross(weights, 0, p, 3, 6);
            cross(weights, 3, p, 6, 0);
            cross(weights, 6, p, 0, 3);
            int256 determinant = weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2];
            receiver.isVisible = determinant != 0;
            for (uint256 i; i != 9; ++i) {
                int256 weight = determinant < 0 ? -weights[i] : weights[i];
                // changes are per eighth of a pixel
                weights[i] = i % 3 == 2 ? weight : weight << 5;
            }
        }
    }

    /// @dev How many bits a number has above so many.
    function excess(uint256 value, uint256 bits) private pure returns (uint256 shift) {
        assembly ("memory-safe") {
            value := shr(bits, value)
            if value {
                shift := shl(7, lt(0xffffffffffffffffffffffffffffffff, value))
                shift := or(shift, shl(6, lt(0xffffffffffffffff, shr(shift, value))))
                shift := or(shift, shl(5, lt(0xffffffff, shr(shift, value))))
                shift := or(shift, shl(4, lt(0xffff, shr(shift, value))))
                shift := or(shift, shl(3, lt(0xff, shr(shift, value))))
                shift := or(shift, shl(2, lt(0xf, shr(shift, value))))
                shift := or(shift, shl(1, lt(0x3, shr(shift, value))))
                shift := add(or(shift, lt(1, shr(shift, value))), 1)
            }
        }
    }

    function magnitude(int256 value) private pure returns (uint256) {
        unchecked {
            return uint256(value < 0 ? -value : value);
        }
    }

    function cross(int256[9] memory target, uint256 k, int256[9] memory p, uint256 a, uint256 b) private pure {
        unchecked {
            target[k] = p[a + 1] * p[b + 2] - p[a + 2] * p[b + 1];
            target[k + 1] = p[a + 2] * p[b] - p[a] * p[b + 2];
            target[k + 2] = p[a] * p[b + 1] - p[a + 1] * p[b];
        }
    }

    /// @notice Writes the functions of what casts the shadow that `test` has found.
    /// @param begin Where to write them.
    /// @return shade MISSED, if no part of the shadow is on the canvas, COVERED, if all of the face is in it, or MIXED_SHADOW.
    /// @return end The address after the last word.
    function write(Receiver memory receiver, uint256 width, uint256 height, uint256 begin)
        internal
        pure
        returns (uint256 shade, uint256 end)
    {
        unchecked {
            uint256 head = receiver.isVisible ? boundsOf(receiver, width, height) : 0;
            if (head == 0) return (MISSED, begin);
            end = begin;
            int256[12] memory values = receiver.values;
            int256[9] memory weights = receiver.weights;
            assembly ("memory-safe") {
                let value := values
                for { let valuesEnd := add(values, 0x180) } lt(value, valuesEnd) { value := add(value, 0x60) } {
                    let a := mload(value)
                    let b := mload(add(value, 0x20))
                    let c := mload(add(value, 0x40))
                    if sgt(or(or(a, b), c), not(0)) { continue }
                    let x := add(mul(a, mload(weights)), add(mul(b, mload(add(weights, 0x60))), mul(c, mload(add(weights, 0xc0)))))
                    let y := add(mul(a, mload(add(weights, 0x20))), mul(b, mload(add(weights, 0x80))))
                    y := add(y, mul(c, mload(add(weights, 0xe0))))
                    a := add(mul(a, mload(add(weights, 0x40))), mul(b, mload(add(weights, 0xa0))))
                    a := add(a, mul(c, mload(add(weights, 0x100))))
                    // the bits of the greater one above GRADIENT_BITS are left out
                    c := sar(255, y)
                    b := sub(xor(y, c), c)
                    c := sar(255, x)
                    c := sub(xor(x, c), c)
                    if gt(c, b) { b := c }
                    b := shr(GRADIENT_BITS, b)
                    if b {
                        c := shl(7, lt(0xffffffffffffffffffffffffffffffff, b))
                        c := or(c, shl(6, lt(0xffffffffffffffff, shr(c, b))))
                        c := or(c, shl(5, lt(0xffffffff, shr(c, b))))
                        c := or(c, shl(4, lt(0xffff, shr(c, b))))
                        c := or(c, shl(3, lt(0xff, shr(c, b))))
                        c := or(c, shl(2, lt(0xf, shr(c, b))))
                        c := or(c, shl(1, lt(0x3, shr(c, b))))
                        c := add(or(c, lt(1, shr(c, b))), 1)
                        x := sar(c, x)
                        y := sar(c, y)
                        a := sar(c, a)
                    }
                    // neighbours overlap, so that rounding makes no cracks
                    if lt(sub(value, values), 0x120) { a := add(a, SLACK) }
                    if iszero(sgt(a, sub(0, BOUND))) {
                        shade := 1
                        break
                    }
                    if slt(a, BOUND) {
                        mstore(
                            end,
                            or(or(shl(X_AT, x), shl(Y_AT, and(y, LANE_48))), or(shl(CONSTANT_AT, and(a, LANE_64)), head))
                        )
                        end := add(end, 0x20)
                    }
                }
            }
            if (shade != 0) return (MISSED, begin);
            if (end == begin) return (COVERED, begin);
            store(begin, load(begin) | (end - begin) >> 5);
            return (MIXED_SHADOW, end);
        }
    }

    /// @dev The columns and rows of the canvas in which the shadow may be, as they stand in the words; 0 if there are none.
    function boundsOf(Receiver memory receiver, uint256 width, uint256 height) private pure returns (uint256) {
        unchecked {
            int256[9] memory places = receiver.places;
            int256[9] memory sides = receiver.sides;
            int256 left = type(int256).max;
            int256 right = type(int256).min;
            int256 top = left;
            int256 bottom = right;
            assembly ("memory-safe") {
                for { let end := add(sides, 0x60) } lt(sides, end) { sides := add(sides, 0x20) } {
                    let a := mload(sides)
                    let b := mload(add(sides, 0x60))
                    let c := mload(add(sides, 0xc0))
                    let w := add(mul(a, mload(add(places, 0x40))), mul(b, mload(add(places, 0xa0))))
                    w := add(w, mul(c, mload(add(places, 0x100))))
                    if or(slt(add(add(a, b), c), 1), slt(w, 1)) {
                        left := WIDER
                        top := WIDER
                        right := shl(SUBPIXEL_BITS, width)
                        bottom := shl(SUBPIXEL_BITS, height)
                        break
                    }
                    let value := add(mul(a, mload(places)), mul(b, mload(add(places, 0x60))))
                    value := sdiv(add(value, mul(c, mload(add(places, 0xc0)))), w)
                    if slt(value, left) { left := value }
                    if sgt(value, right) { right := value }
                    value := add(mul(a, mload(add(places, 0x20))), mul(b, mload(add(places, 0x80))))
                    value := sdiv(add(value, mul(c, mload(add(places, 0xe0)))), w)
                    if slt(value, top) { top := value }
                    if sgt(value, bottom) { bottom := value }
                }
                left := sar(SUBPIXEL_BITS, sub(left, WIDER))
                left := mul(left, sgt(left, 0))
                top := sar(SUBPIXEL_BITS, sub(top, WIDER))
                top := mul(top, sgt(top, 0))
                right := add(sar(SUBPIXEL_BITS, add(right, WIDER)), 1)
                if sgt(right, width) { right := width }
                bottom := add(sar(SUBPIXEL_BITS, add(bottom, WIDER)), 1)
                if sgt(bottom, height) { bottom := height }
            }
            if (left >= right || top >= bottom) return 0;
            return (uint256(top) << TOP_AT) | (uint256(bottom) << BOTTOM_AT) | (uint256(right) << RIGHT_AT) | (uint256(left) << LEFT_AT);
        }
    }
}
