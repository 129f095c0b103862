// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {VertexShader} from "../pipeline/VertexShader.sol";
import "../pipeline/Registers.sol";
import {
    ADDRESS_MASK,
    BEHIND,
    FACE_B_AT,
    FACE_C_AT,
    FACE_PLANES_AT,
    CASTER_SIZE,
    Faces,
    LANE,
    LANE_MASK,
    LANE_ONES,
    LANE_TOP,
    LANE_TOPS,
    PLANES_SIZE,
    PLANE_SIZE
} from "./Faces.sol";

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
/// @dev No place in sub-pixels.
int256 constant UNBOUNDED = 0x10000000000000000000000000000000000000000000000000;

/// @dev Coordinates of a face have so many bits, with the sign, that all functions fit lanes.
uint256 constant NARROW_BITS = 27;
/// @dev Bits of values in lanes without the sign; others are divided by a power of two.
uint256 constant VALUE_BITS = 83;
/// @dev What stands behind the functions of the face that receives shadows: its coordinates, its sides at the corners of what may shade
/// it, and the functions of that at its own corners; lanes.
uint256 constant OWN_COORDINATES = 0x200;
uint256 constant SIDES = 0x260;
uint256 constant VALUES = 0x2c0;
/// @dev 1 if all of that is in front of the face: then all that is inside its sides is behind it as well.
uint256 constant IS_IN_FRONT = 0x340;
uint256 constant RECEIVER_SIZE = 0x360;

/// @notice What is known of the face that receives shadows.
/// @param planes Its functions, and what stands behind them.
/// @param corners The first word of its record.
/// @param isWide Whether its functions do not fit lanes: it is much larger than what casts shadows.
/// @param places Its corners on the canvas, homogeneous: column and row in sub-pixels, and the distance.
/// @param isVisible Whether it is not seen edge-on.
/// @param weights Their cross products, as the coefficients of functions that are 1 at one corner, but for a positive factor.
struct Receiver {
    uint256 planes;
    uint256 corners;
    bool isWide;
    bool isPlaced;
    bool isVisible;
    int256[9] places;
    int256[9] weights;
}

uint256 constant MISSED = 0;
uint256 constant COVERED = 1;
uint256 constant MIXED_SHADOW = 2;

library Receivers {
    /// @notice Begins with a face.
    /// @param face Its record.
    function setFace(Receiver memory receiver, uint256 face, bool isPoint) internal pure {
        unchecked {
            uint256 corners = load(face);
            (receiver.corners, receiver.isPlaced) = (corners, false);
            uint256 planes = receiver.planes;
            Faces.writePlanes(face, isPoint, planes);
            Faces.pack(planes + OWN_COORDINATES, corners);
            bool isWide;
            assembly ("memory-safe") {
                for { let i := 0 } lt(i, 0x60) { i := add(i, 0x20) } {
                    let bias := shl(sub(NARROW_BITS, 1), 1)
                    let all := add(mload(add(and(corners, ADDRESS_MASK), i)), bias)
                    all := or(all, add(mload(add(and(shr(FACE_B_AT, corners), ADDRESS_MASK), i)), bias))
                    all := or(all, add(mload(add(and(shr(FACE_C_AT, corners), ADDRESS_MASK), i)), bias))
                    isWide := or(isWide, gt(shr(NARROW_BITS, all), 0))
                }
            }
            receiver.isWide = isWide;
        }
    }

    /// @notice The next of up to 256 faces that may shade the one of the receiver: it is in front of it, and inside its sides.
    /// @param bits Which of them may be.
    /// @param casters The address of the first.
    /// @return caster The address of the one that was found; then its corners are in SIDES; or 0.
    /// @return rest The bits of those behind it.
    function next(Receiver memory receiver, uint256 bits, uint256 casters) internal pure returns (uint256 caster, uint256 rest) {
        unchecked {
            uint256 planes = receiver.planes;
            bool isWide = receiver.isWide;
            for (; bits != 0; bits &= bits - 1) {
                caster = casters + CASTER_SIZE * Faces.lowestBit(bits);
                if (isWide ? isBeforeWide(planes, load(load(caster))) : isBefore(planes, caster)) return (caster, bits & (bits - 1));
            }
            return (0, 0);
        }
    }

    function isBefore(uint256 planes, uint256 caster) private pure returns (bool found) {
        assembly ("memory-safe") {
            let x := mload(add(caster, 0x20))
            let y := mload(add(caster, 0x40))
            let z := mload(add(caster, 0x60))
            let p := add(planes, BEHIND)
            let v := add(mul(x, mload(p)), mul(y, mload(add(p, 0x20))))
            v := add(add(v, mul(z, mload(add(p, 0x40)))), add(mul(LANE_ONES, mload(add(p, 0x60))), LANE_TOPS))
            // not all are behind it
            if sub(and(v, LANE_TOPS), LANE_TOPS) {
                found := 1
                mstore(add(planes, IS_IN_FRONT), iszero(and(sub(v, LANE_ONES), LANE_TOPS)))
                p := planes
                for { let target := add(planes, SIDES) } lt(p, add(planes, BEHIND)) { target := add(target, 0x20) } {
                    v := add(mul(x, mload(p)), mul(y, mload(add(p, 0x20))))
                    v := add(add(v, mul(z, mload(add(p, 0x40)))), add(mul(LANE_ONES, mload(add(p, 0x60))), LANE_TOPS))
                    // all are at most 0
                    if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) {
                        found := 0
                        break
                    }
                    mstore(target, v)
                    p := add(p, PLANE_SIZE)
                }
            }
        }
    }

    /// @dev The same with numbers that do not fit lanes.
    function isBeforeWide(uint256 planes, uint256 corners) private pure returns (bool) {
        unchecked {
            int256[9] memory all;
            (int256 a, int256 b, int256 c) = Faces.values(planes + BEHIND, corners);
            if (a | b | c >= 0) return false;
            store(planes + IS_IN_FRONT, a <= 0 && b <= 0 && c <= 0 ? 1 : 0);
            uint256 most;
            for (uint256 i; i != 9; i += 3) {
                (a, b, c) = Faces.values(planes + PLANE_SIZE * (i / 3), corners);
                if (a <= 0 && b <= 0 && c <= 0) return false;
                (all[i], all[i + 1], all[i + 2]) = (a, b, c);
                most |= magnitude(a) | magnitude(b) | magnitude(c);
            }
            uint256 shift = excess(most, VALUE_BITS);
            for (uint256 i; i != 3; ++i) {
                store(planes + SIDES + 32 * i, lanesOf(all[3 * i] >> shift, all[3 * i + 1] >> shift, all[3 * i + 2] >> shift));
            }
            return true;
        }
    }

    function lanesOf(int256 a, int256 b, int256 c) private pure returns (uint256) {
        unchecked {
            return uint256(a + (b << LANE) + (c << (2 * LANE))) + LANE_TOPS;
        }
    }

    /// @notice Whether a face that `next` has found shades the one of the receiver.
    /// @param caster Its record.
    /// @return MISSED, COVERED, or MIXED_SHADOW; then its functions are in VALUES.
    function test(Receiver memory receiver, uint256 caster, bool isPoint) internal pure returns (uint256) {
        unchecked {
            uint256 first = load(caster);
            uint256 plane = (first >> FACE_PLANES_AT) & ADDRESS_MASK;
            if (plane == 0) {
                plane = freeMemory();
                setFreeMemory(plane + PLANES_SIZE);
                Faces.writePlanes(caster, isPoint, plane);
                store(caster, first | (plane << FACE_PLANES_AT));
            }
            uint256 own = receiver.planes;
            uint256 all = receiver.isWide ? functionsWide(own, plane, receiver.corners) : functions(own, plane);
            if (all == 0) return MISSED;
            return all & LANE_TOPS == LANE_TOPS ? COVERED : MIXED_SHADOW;
        }
    }

    /// @return all 0 if no place is inside all functions; else the highest bits of its lanes are set where all are at least 0.
    function functions(uint256 own, uint256 plane) private pure returns (uint256 all) {
        assembly ("memory-safe") {
            let x := mload(add(own, OWN_COORDINATES))
            let y := mload(add(add(own, OWN_COORDINATES), 0x20))
            let z := mload(add(add(own, OWN_COORDINATES), 0x40))
            all := not(0)
            let target := add(own, VALUES)
            mstore(add(target, 0x60), LANE_TOPS)
            for { let end := add(target, sub(0x80, shl(5, mload(add(own, IS_IN_FRONT))))) } lt(target, end) {
                target := add(target, 0x20)
            } {
                let v := add(mul(x, mload(plane)), mul(y, mload(add(plane, 0x20))))
                v := add(add(v, mul(z, mload(add(plane, 0x40)))), add(mul(LANE_ONES, mload(add(plane, 0x60))), LANE_TOPS))
                if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) {
                    all := 0
                    break
                }
                mstore(target, v)
                // the highest bit of a word is not one of a lane
                all := and(all, or(v, shl(255, 1)))
                plane := add(plane, PLANE_SIZE)
            }
        }
    }

    /// @dev The same with numbers that do not fit lanes.
    function functionsWide(uint256 own, uint256 plane, uint256 corners) private pure returns (uint256 all) {
        unchecked {
            all = type(uint256).max;
            store(own + VALUES + 0x60, LANE_TOPS);
            for (uint256 i; i != 4 - load(own + IS_IN_FRONT); ++i) {
                (int256 a, int256 b, int256 c) = Faces.values(plane + PLANE_SIZE * i, corners);
                if (a <= 0 && b <= 0 && c <= 0) return 0;
                uint256 shift = excess(magnitude(a) | magnitude(b) | magnitude(c), VALUE_BITS);
                uint256 lanes = lanesOf(a >> shift, b >> shift, c >> shift);
                store(own + VALUES + 32 * i, lanes);
                all &= lanes | (1 << 255);
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
            int256[9] memory weights = receiver.weights;
            uint256 value = receiver.planes + VALUES;
            for (uint256 i; i != 4; ++i) {
                uint256 lanes = load(value);
                value += 32;
                if (lanes & LANE_TOPS == LANE_TOPS) continue;
                int256 x;
                int256 y;
                int256 constant_;
                assembly ("memory-safe") {
                    let a := sub(and(lanes, LANE_MASK), LANE_TOP)
                    let b := sub(and(shr(LANE, lanes), LANE_MASK), LANE_TOP)
                    lanes := sub(shr(LANE, shr(LANE, lanes)), LANE_TOP)
                    x := add(mul(a, mload(weights)), add(mul(b, mload(add(weights, 0x60))), mul(lanes, mload(add(weights, 0xc0)))))
                    y := add(mul(a, mload(add(weights, 0x20))), mul(b, mload(add(weights, 0x80))))
                    y := add(y, mul(lanes, mload(add(weights, 0xe0))))
                    constant_ := add(mul(a, mload(add(weights, 0x40))), mul(b, mload(add(weights, 0xa0))))
                    constant_ := add(constant_, mul(lanes, mload(add(weights, 0x100))))
                }
                uint256 shift = excess(greater(magnitude(x), magnitude(y)), GRADIENT_BITS);
                constant_ >>= shift;
                // neighbours overlap, so that rounding makes no cracks
                if (i != 3) constant_ += SLACK;
                if (constant_ <= -BOUND) return (MISSED, begin);
                if (constant_ >= BOUND) continue;
                assembly ("memory-safe") {
                    let word := or(shl(X_AT, sar(shift, x)), shl(Y_AT, and(sar(shift, y), LANE_48)))
                    mstore(end, or(word, or(shl(CONSTANT_AT, and(constant_, LANE_64)), head)))
                }
                end += 32;
            }
            if (end == begin) return (COVERED, begin);
            store(begin, load(begin) | (end - begin) >> 5);
            return (MIXED_SHADOW, end);
        }
    }

    function greater(uint256 a, uint256 b) private pure returns (uint256) {
        return a > b ? a : b;
    }

    /// @dev The columns and rows of the canvas in which the shadow may be, as they stand in the words; 0 if there are none.
    function boundsOf(Receiver memory receiver, uint256 width, uint256 height) private pure returns (uint256) {
        unchecked {
            (int256 left, int256 top) = cornerOf(receiver, 0);
            (int256 right, int256 bottom) = (left, top);
            bool isBounded = left != UNBOUNDED;
            for (uint256 lane = LANE; lane != 3 * LANE && isBounded; lane += LANE) {
                (int256 x, int256 y) = cornerOf(receiver, lane);
                isBounded = x != UNBOUNDED;
                if (x < left) left = x;
                if (x > right) right = x;
                if (y < top) top = y;
                if (y > bottom) bottom = y;
            }
            if (!isBounded) return (height << BOTTOM_AT) | (width << RIGHT_AT);
            assembly ("memory-safe") {
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

    /// @dev Where a corner of what casts the shadow does so on the canvas, in sub-pixels; UNBOUNDED if it does not.
    /// @param lane Where its lane begins.
    function cornerOf(Receiver memory receiver, uint256 lane) private pure returns (int256 x, int256 y) {
        unchecked {
            int256[9] memory places = receiver.places;
            uint256 side = receiver.planes + SIDES;
            assembly ("memory-safe") {
                let a := sub(and(shr(lane, mload(side)), LANE_MASK), LANE_TOP)
                let b := sub(and(shr(lane, mload(add(side, 0x20))), LANE_MASK), LANE_TOP)
                side := sub(and(shr(lane, mload(add(side, 0x40))), LANE_MASK), LANE_TOP)
                let w := add(mul(a, mload(add(places, 0x40))), mul(b, mload(add(places, 0xa0))))
                w := add(w, mul(side, mload(add(places, 0x100))))
                switch or(slt(add(add(a, b), side), 1), slt(w, 1))
                case 0 {
                    x := add(mul(a, mload(places)), mul(b, mload(add(places, 0x60))))
                    x := sdiv(add(x, mul(side, mload(add(places, 0xc0)))), w)
                    y := add(mul(a, mload(add(places, 0x20))), mul(b, mload(add(places, 0x80))))
                    y := sdiv(add(y, mul(side, mload(add(places, 0xe0)))), w)
                }
                default { x := UNBOUNDED }
            }
        }
    }
}
