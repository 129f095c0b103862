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
/// @param weights Their cross products.
/// @param sides Its sides at the corners of what may shade it.
/// @param values The functions of that at its own corners.
struct Receiver {
    uint256 corners;
    uint256 planes;
    bool isPlaced;
    int256 determinant;
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
            {
                uint256 own = receiver.planes;
                (int256 a, int256 b, int256 c) = Faces.values(own + BEHIND, corners);
                if (a >= 0 && b >= 0 && c >= 0) return MISSED;
                uint256 side;
                int256[9] memory sides = receiver.sides;
                assembly ("memory-safe") {
                    side := sides
                }
                for (uint256 end = own + BEHIND; own != end; own += PLANE_SIZE) {
                    (a, b, c) = Faces.values(own, corners);
                    if (a <= 0 && b <= 0 && c <= 0) return MISSED;
                    storeSigned(side, a);
                    storeSigned(side + 0x60, b);
                    storeSigned(side + 0xc0, c);
                    side += 0x20;
                }
            }
            uint256 plane = (corners >> FACE_PLANES_AT) & ADDRESS_MASK;
            if (plane == 0) {
                plane = freeMemory();
                setFreeMemory(plane + PLANES_SIZE);
                Faces.writePlanes(caster, isPoint, plane);
                store(caster, corners | (plane << FACE_PLANES_AT));
            }
            int256 isMixed;
            uint256 value;
            int256[12] memory values = receiver.values;
            corners = receiver.corners;
            assembly ("memory-safe") {
                value := values
            }
            for (uint256 end = plane + PLANES_SIZE; plane != end; plane += PLANE_SIZE) {
                (int256 a, int256 b, int256 c) = Faces.values(plane, corners);
                if (a <= 0 && b <= 0 && c <= 0) return MISSED;
                isMixed |= a | b | c;
                storeSigned(value, a);
                storeSigned(value + 0x20, b);
                storeSigned(value + 0x40, c);
                value += 0x60;
            }
            return isMixed < 0 ? MIXED_SHADOW : COVERED;
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
            receiver.determinant = weights[0] * p[0] + weights[1] * p[1] + weights[2] * p[2];
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
            if (receiver.determinant == 0) return (MISSED, begin);
            uint256 head;
            {
                (uint256 top, uint256 bottom) = boundsOf(receiver, 0x20, height);
                (uint256 left, uint256 right) = boundsOf(receiver, 0, width);
                if (top >= bottom || left >= right) return (MISSED, begin);
                head = (top << TOP_AT) | (bottom << BOTTOM_AT) | (right << RIGHT_AT) | (left << LEFT_AT);
            }
            end = begin;
            uint256 values;
            int256[12] memory all = receiver.values;
            assembly ("memory-safe") {
                values := all
            }
            for (uint256 i; i != 4; ++i) {
                (int256 a, int256 b, int256 c) = (loadSigned(values), loadSigned(values + 0x20), loadSigned(values + 0x40));
                values += 0x60;
                if (a | b | c >= 0) continue;
                (int256 x, int256 y, int256 constant_) = combine(receiver, a, b, c);
                // neighbours overlap, so that rounding makes no cracks
                if (i != 3) constant_ += SLACK;
                if (constant_ <= -BOUND) return (MISSED, begin);
                if (constant_ >= BOUND) continue;
                store(
                    end,
                    (uint256(x) << X_AT) | ((uint256(y) & LANE_48) << Y_AT) | ((uint256(constant_) & LANE_64) << CONSTANT_AT) | head
                );
                end += 32;
            }
            if (end == begin) return (COVERED, begin);
            store(begin, load(begin) | (end - begin) >> 5);
            return (MIXED_SHADOW, end);
        }
    }

    /// @dev A function on the canvas with these values at the corners.
    function combine(Receiver memory receiver, int256 a, int256 b, int256 c)
        private
        pure
        returns (int256 x, int256 y, int256 constant_)
    {
        unchecked {
            if (receiver.determinant < 0) (a, b, c) = (-a, -b, -c);
            int256[9] memory weights = receiver.weights;
            uint256 most;
            assembly ("memory-safe") {
                x := add(mul(a, mload(weights)), mul(b, mload(add(weights, 0x60))))
                x := shl(5, add(x, mul(c, mload(add(weights, 0xc0)))))
                y := add(mul(a, mload(add(weights, 0x20))), mul(b, mload(add(weights, 0x80))))
                y := shl(5, add(y, mul(c, mload(add(weights, 0xe0)))))
                constant_ := add(mul(a, mload(add(weights, 0x40))), mul(b, mload(add(weights, 0xa0))))
                constant_ := add(constant_, mul(c, mload(add(weights, 0x100))))
                let sign := sar(255, y)
                most := sub(xor(y, sign), sign)
                sign := sar(255, x)
                sign := sub(xor(x, sign), sign)
                if gt(sign, most) { most := sign }
            }
            uint256 shift = excess(most, GRADIENT_BITS);
            return (x >> shift, y >> shift, constant_ >> shift);
        }
    }

    /// @dev The columns or rows of the canvas in which the shadow may be: the first, and the one after the last.
    /// @param axis 0 for columns, 0x20 for rows.
    /// @param size How many the canvas has.
    function boundsOf(Receiver memory receiver, uint256 axis, uint256 size) private pure returns (uint256, uint256) {
        unchecked {
            int256[9] memory places = receiver.places;
            int256[9] memory sides = receiver.sides;
            int256 low = type(int256).max;
            int256 high = type(int256).min;
            bool isBounded = true;
            assembly ("memory-safe") {
                for { let i := 0 } lt(i, 0x120) { i := add(i, 0x60) } {
                    let a := mload(add(sides, i))
                    let b := mload(add(sides, add(i, 0x20)))
                    let c := mload(add(sides, add(i, 0x40)))
                    let w := add(mul(a, mload(add(places, 0x40))), mul(b, mload(add(places, 0xa0))))
                    w := add(w, mul(c, mload(add(places, 0x100))))
                    if or(slt(add(add(a, b), c), 1), slt(w, 1)) {
                        isBounded := 0
                        break
                    }
                    let p := add(places, axis)
                    let value := add(mul(a, mload(p)), mul(b, mload(add(p, 0x60))))
                    value := sdiv(add(value, mul(c, mload(add(p, 0xc0)))), w)
                    if slt(value, low) { low := value }
                    if sgt(value, high) { high := value }
                }
            }
            if (!isBounded) return (0, size);
            low = (low - WIDER) >> SUBPIXEL_BITS;
            high = ((high + WIDER) >> SUBPIXEL_BITS) + 1;
            if (low < 0) low = 0;
            if (high > int256(size)) high = int256(size);
            return high <= low ? (0, 0) : (uint256(low), uint256(high));
        }
    }
}
