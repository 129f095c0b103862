// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {magnitude, excess} from "../math/Bits.sol";
import {VertexShader} from "../pipeline/geometry/VertexShader.sol";
import {LANE, LANE_MASK, LANE_TOP} from "./Faces.sol";
import {IS_IN_FRONT, POLYGON_1, POLYGON_2, Receiver, SIDES} from "./Receivers.sol";
import "../words/Registers.sol";

// Computes `Camera.project` of picture.py for the corners of shadows.
// Projects shadows to the canvas, clipped to it. The corner of a shadow is known relative to the sides of the receiver: these numbers are
// its barycentric coordinates, so that its homogeneous position on the canvas is the sum of the receiver's corners with these weights.
//
// Each corner of a caster has one position on the canvas, shared by all its faces, so that there are no gaps.

/// @dev The bits of the distances of vertices, and of other homogeneous coordinates.
uint256 constant DISTANCE_BITS = 38;
uint256 constant CLIP_BITS = 60;
/// @dev The bits of the coordinates of corners made by clipping polygons.
uint256 constant VALUE_BITS = 83;
/// @dev Of positions on the canvas: the bits below the pixel, and the bias. In sub-pixels they are below 2^POINT_GUARD.
uint256 constant POINT_BITS = 20;
uint256 constant POINT_BIAS = 0x10000000000;
uint256 constant POINT_GUARD = 22;
uint256 constant SUBPIXEL_TO_POINT = 12;
/// @dev Where a vertex stores its position, or 0, replacing its ranges: above POINT_AT; and below the tag of the receiver.
uint256 constant PLACE_POINT = 0x60;
uint256 constant POINT_AT = 64;
uint256 constant TAG_MASK = 0xffffffffffffffff;
/// @dev The first row of samples not above a position: its row plus this, shifted by the next constant; and the bias after that.
uint256 constant ROW_UP = 0x9ffff;
uint256 constant ROW_SHIFT = 18;
uint256 constant ROW_BIAS = 0x400000;
/// @dev A corner of a polygon: relative to the sides of the face, and its distance from a boundary.
uint256 constant POLYGON_CORNER = 0x80;

library Clipping {
    /// @notice Sets the corners on the canvas. The registers must contain the mesh and the matrix of the object.
    /// @param numbers The three vertex indices, 16 bits each.
    function place(Receiver memory receiver, uint256 numbers, uint256 width, uint256 height) internal pure {
        unchecked {
            receiver.isPlaced = true;
            int256[9] memory p = receiver.places;
            uint256 begin;
            assembly ("memory-safe") {
                begin := p // the address of the array
            }
            uint256 placesEnd = begin + 0x120;
            bool isOrthographic = load(FRAME_IS_ORTHOGRAPHIC) != 0;
            uint256 corner = receiver.planes + POLYGON_1; // clip coordinates, for a while
            bool isPlain = true;
            int256 most; // the greatest distance
            for (uint256 q = begin; q != placesEnd; q += 0x60) {
                VertexShader.clipCoordinates((numbers >> FACE_FIRST_AT) & FACE_INDEX_MASK, corner);
                numbers <<= FACE_SECOND_AT;
                (int256 x, int256 y, int256 w) = (loadSigned(corner), loadSigned(corner + CORNER_Y), loadSigned(corner + CORNER_W));
                if (w < loadSigned(NEAR)) isPlain = false;
                if (isOrthographic) w = int256(ONE_32);
                if (x < 0 || y < 0 || x >= w << GUARD_BITS || y >= w << GUARD_BITS) isPlain = false;
                storeSigned(q, x);
                storeSigned(q + 0x20, y);
                storeSigned(q + 0x40, w);
                if (w > most) most = w;
            }
            int256 bias = int256(PIXEL_BIAS << SUBPIXEL_BITS);
            (int256 top, int256 bottom, int256 right) = (0, int256(4 * height), int256(width << POINT_BITS));
            if (!isPlain) {
                // nearer than the near plane, or far beyond the canvas
                most = 0; // from here on, the bits of all coordinates
                for (uint256 q = begin; q != placesEnd; q += 0x60) {
                    int256 w = loadSigned(q + 0x40);
                    storeSigned(q, loadSigned(q) - bias * w);
                    storeSigned(q + 0x20, loadSigned(q + 0x20) - bias * w);
                    most |= magnitude(loadSigned(q)) | magnitude(loadSigned(q + 0x20)) | magnitude(w);
                }
            }
            uint256 shift = excess(uint256(most), isPlain ? DISTANCE_BITS : CLIP_BITS);
            if (isPlain) {
                if (isOrthographic) shift = Q32; // distances become 1
                int256 low = type(int256).max; // the first and last row, and the last column, in sub-pixels
                int256 high = type(int256).min;
                int256 far = high;
                for (uint256 q = begin; q != placesEnd; q += 0x60) {
                    int256 w = loadSigned(q + 0x40);
                    (int256 x, int256 y) = (loadSigned(q) / w - bias, loadSigned(q + 0x20) / w - bias);
                    w >>= shift;
                    storeSigned(q, x * w);
                    storeSigned(q + 0x20, y * w);
                    storeSigned(q + 0x40, w);
                    if (y < low) low = y;
                    if (y > high) high = y;
                    if (x > far) far = x;
                }
                // from here on, rows of samples, and a column in the unit of positions: two sub-pixels wider
                low = (((low - 2) << SUBPIXEL_TO_POINT) + int256(ROW_UP)) >> ROW_SHIFT;
                high = (((high + 2) << SUBPIXEL_TO_POINT) + int256(ROW_UP)) >> ROW_SHIFT;
                far = ((far + 2) << SUBPIXEL_TO_POINT) + int256(1 << POINT_BITS);
                if (low > top) top = low;
                if (high < bottom) bottom = high;
                if (far < right) right = far;
            } else {
                for (uint256 q = begin; q != placesEnd; q += 32) storeSigned(q, loadSigned(q) >> shift);
            }
            receiver.top = uint256(top + int256(ROW_BIAS));
            receiver.bottom = uint256(bottom + int256(ROW_BIAS));
            receiver.right = uint256(right + int256(POINT_BIAS));
            // of the three corners: its sign is that of their order on the canvas
            int256 determinant = (p[1] * p[5] - p[2] * p[4]) * p[6] + (p[2] * p[3] - p[0] * p[5]) * p[7];
            determinant += (p[0] * p[4] - p[1] * p[3]) * p[8];
            receiver.isVisible = determinant != 0 && top < bottom;
            receiver.isFlipped = receiver.isFlipped != (determinant < 0);
        }
    }

    /// @notice Writes the corners of the shadow of a face found by Receivers.next, positions on the canvas.
    /// @param corners The first word of its record.
    /// @return begin The address of the first one.
    /// @return end The address after the last.
    function cornersOf(Receiver memory receiver, uint256 corners) internal pure returns (uint256 begin, uint256 end) {
        unchecked {
            begin = receiver.planes + POLYGON_1;
            end = begin;
            bool isPlain = load(receiver.planes + IS_IN_FRONT) != 0;
            for (uint256 lane; isPlain && lane != 3 * LANE; lane += LANE) {
                uint256 kept = (corners & FACE_A_MASK) + PLACE_POINT;
                uint256 point = load(kept);
                if (point & TAG_MASK != receiver.tag) {
                    point = (cornerOf(receiver, lane) << POINT_AT) | receiver.tag;
                    store(kept, point);
                }
                point >>= POINT_AT;
                isPlain = point != 0;
                store(end, point);
                end += 32;
                corners >>= FACE_B_AT;
            }
            if (isPlain) return (begin, end);
            uint256 polygonEnd;
            (begin, polygonEnd) = clippedPolygon(receiver);
            end = begin;
            for (uint256 p = begin; p != polygonEnd; p += POLYGON_CORNER) {
                (int256 x, int256 y, int256 w) = placeOf(receiver, p);
                assembly ("memory-safe") {
                    x := add(sdiv(shl(SUBPIXEL_TO_POINT, x), w), POINT_BIAS) // x / w
                    y := add(sdiv(shl(SUBPIXEL_TO_POINT, y), w), POINT_BIAS) // y / w
                    mstore(end, or(shl(POINT_ROW_AT, y), x))
                }
                end += 32;
            }
        }
    }

    /// @dev Returns the position on the canvas of the shadow of a caster's corner; 0 if it is far outside or does not exist. This is
    /// placeOf and isFar, written out: it is called for each corner.
    /// @param lane The position of its lane.
    function cornerOf(Receiver memory receiver, uint256 lane) private pure returns (uint256 point) {
        unchecked {
            int256[9] memory places = receiver.places;
            uint256 side = receiver.planes + SIDES;
            assembly ("memory-safe") {
                let a := sub(and(shr(lane, mload(side)), LANE_MASK), LANE_TOP) // the weights of the receiver's corners
                let b := sub(and(shr(lane, mload(add(side, 0x20))), LANE_MASK), LANE_TOP) // of the second
                side := sub(and(shr(lane, mload(add(side, 0x40))), LANE_MASK), LANE_TOP) // from here on, the third
                let w := add(mul(a, mload(add(places, 0x40))), mul(b, mload(add(places, 0xa0)))) // a w0 + b w1 ..
                w := add(w, mul(side, mload(add(places, 0x100)))) // a w0 + b w1 + side w2
                let x := add(mul(a, mload(places)), mul(b, mload(add(places, 0x60))))
                x := add(x, mul(side, mload(add(places, 0xc0)))) // a x0 + b x1 + side x2
                let y := add(mul(a, mload(add(places, 0x20))), mul(b, mload(add(places, 0x80))))
                y := add(y, mul(side, mload(add(places, 0xe0)))) // a y0 + b y1 + side y2
                if and(sgt(add(add(a, b), side), 0), sgt(w, 0)) { // it exists: the eye sees it
                    let most := shl(POINT_GUARD, w) // the bound for x and y
                    if iszero(or(gt(add(x, most), shl(1, most)), gt(add(y, most), shl(1, most)))) { // |x| <= most and |y| <= most
                        point := shl(POINT_ROW_AT, add(sdiv(shl(SUBPIXEL_TO_POINT, y), w), POINT_BIAS)) // y / w
                        point := or(point, add(sdiv(shl(SUBPIXEL_TO_POINT, x), w), POINT_BIAS)) // x / w
                    }
                }
            }
        }
    }

    /// @dev Returns the homogeneous position of a polygon's corner: the sum of the receiver's corners with its weights.
    function placeOf(Receiver memory receiver, uint256 corner) private pure returns (int256 x, int256 y, int256 w) {
        unchecked {
            int256[9] memory p = receiver.places;
            (int256 a, int256 b, int256 c) = (loadSigned(corner), loadSigned(corner + 0x20), loadSigned(corner + 0x40));
            return (a * p[0] + b * p[3] + c * p[6], a * p[1] + b * p[4] + c * p[7], a * p[2] + b * p[5] + c * p[8]);
        }
    }

    /// @dev Returns whether a homogeneous position is far beyond the canvas, or not in front of the eye.
    function isFar(int256 x, int256 y, int256 w) private pure returns (bool) {
        unchecked {
            int256 most = w << POINT_GUARD;
            return w <= 0 || magnitude(x) > most || magnitude(y) > most;
        }
    }

    /// @dev Clips a caster to the part in front of the face whose shadow is on the canvas or near it.
    /// @return polygon The address of its first corner; `end` is the address after the last.
    function clippedPolygon(Receiver memory receiver) private pure returns (uint256 polygon, uint256 end) {
        unchecked {
            polygon = receiver.planes + POLYGON_1;
            end = polygon;
            for (uint256 lane; lane != 3 * LANE; lane += LANE) {
                for (uint256 i; i != 4; ++i) {
                    uint256 lanes = load(receiver.planes + SIDES + 32 * i);
                    storeSigned(end + 32 * i, int256((lanes >> lane) & LANE_MASK) - int256(LANE_TOP));
                }
                storeSigned(end + 0x60, -loadSigned(end + 0x60));
                end += POLYGON_CORNER;
            }
            if (load(receiver.planes + IS_IN_FRONT) == 0) (polygon, end) = clip(receiver, polygon, end);
            bool isPlain = true;
            for (uint256 p = polygon; p != end; p += POLYGON_CORNER) {
                (int256 x, int256 y, int256 w) = placeOf(receiver, p);
                int256 sum = loadSigned(p) + loadSigned(p + 0x20) + loadSigned(p + 0x40);
                if (sum <= 0 || isFar(x, y, w)) isPlain = false;
                storeSigned(p + 0x60, sum);
            }
            if (isPlain) return (polygon, end);
            (polygon, end) = clip(receiver, polygon, end);
            // to the four borders of what is not far
            for (uint256 i; i != 4; ++i) {
                for (uint256 p = polygon; p != end; p += POLYGON_CORNER) {
                    (int256 x, int256 y, int256 w) = placeOf(receiver, p);
                    if (i > 1) x = y;
                    storeSigned(p + 0x60, (w << POINT_GUARD) + (i & 1 == 0 ? x : -x));
                }
                (polygon, end) = clip(receiver, polygon, end);
            }
        }
    }

    /// @dev Clips a convex polygon to the part where the distances of its corners are not negative, into the other one of the two polygons.
    function clip(Receiver memory receiver, uint256 polygon, uint256 polygonEnd) private pure returns (uint256 begin, uint256 end) {
        unchecked {
            begin = receiver.planes + POLYGON_1;
            if (polygon == begin) begin = receiver.planes + POLYGON_2;
            end = begin;
            uint256 a = polygonEnd - POLYGON_CORNER;
            for (uint256 b = polygon; b != polygonEnd; b += POLYGON_CORNER) {
                (int256 m, int256 n) = (loadSigned(a + 0x60), loadSigned(b + 0x60));
                bool isInside = n >= 0;
                if (m < 0 == isInside) {
                    // the same for both faces that share the edge
                    uint256 outer = b;
                    if (isInside) (a, outer, m, n) = (b, a, n, m);
                    int256 i = loadSigned(outer) * m - loadSigned(a) * n;
                    int256 j = loadSigned(outer + 0x20) * m - loadSigned(a + 0x20) * n;
                    int256 k = loadSigned(outer + 0x40) * m - loadSigned(a + 0x40) * n;
                    uint256 shift = excess(uint256(magnitude(i) | magnitude(j) | magnitude(k)), VALUE_BITS);
                    storeSigned(end, i >> shift);
                    storeSigned(end + 0x20, j >> shift);
                    storeSigned(end + 0x40, k >> shift);
                    end += POLYGON_CORNER;
                }
                if (isInside) {
                    assembly ("memory-safe") {
                        mcopy(end, b, 0x60) // its place in the face, not its distance
                    }
                    end += POLYGON_CORNER;
                }
                a = b;
            }
        }
    }
}
