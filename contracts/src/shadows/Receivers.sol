// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {VertexShader} from "../pipeline/geometry/VertexShader.sol";
import "../words/Registers.sol";
import {
    ADDRESS_MASK,
    BEHIND,
    CASTER_SIZE,
    FACE_B_AT,
    FACE_C_AT,
    FACE_SIDE,
    Faces,
    HAS_PLANES,
    LANE,
    LANE_MASK,
    LANE_ONES,
    LANE_TOP,
    LANE_TOPS,
    PLANES_SIZE,
    SIDE_SIZE
} from "./Faces.sol";

// Computes the edges of all shadows on a face. A sample is in shadow if more of them begin than end to the left of it. Where two shadows
// meet, one ends and the other begins: both edges cancel, so that for most objects little more than the outline is left. Each corner of a
// caster has one position on the canvas, shared by all its faces, so that there are no gaps.
//
// An edge is a word. A position on the canvas, in eighths of a pixel, is to the right of the edge if its function is at least 0:
//
//   bits 208 to 255   the change of the function to the right; signed, like the next two
//   bits 160 to 207   its change downward
//   bits  96 to 159   its value at the centre of the canvas's first pixel
//   bits  80 to  95   the first row of samples, four for each row of pixels, that the edge crosses
//   bits  64 to  79   the row after the last
//   bit    8          whether it is the last edge of the list
//   bit    0          whether a shadow ends at it, or begins
//
// Lists are sorted by the first row of pixels.

uint256 constant X_AT = 208;
uint256 constant Y_AT = 160;
uint256 constant CONSTANT_AT = 96;
uint256 constant TOP_AT = 80;
uint256 constant BOTTOM_AT = 64;
uint256 constant LAST_EDGE = 1 << 8;
uint256 constant ROW_MASK = 0xffff;
uint256 constant LANE_48 = 0xffffffffffff;

/// @dev The bits of the distances of vertices, and of other homogeneous coordinates.
uint256 constant DISTANCE_BITS = 38;
uint256 constant CLIP_BITS = 60;
/// @dev The bits of the change of an edge's function per eighth of a pixel.
uint256 constant EDGE_BITS = 40;
/// @dev The bits of the coordinates of a face, including the sign, for which all functions fit lanes. The functions of a wider face are
/// divided by a power of two: factors have WIDE_BITS then, constants CONSTANT_BITS more, without the sign.
uint256 constant NARROW_BITS = 27;
uint256 constant WIDE_BITS = 60;
uint256 constant CONSTANT_BITS = 22;
/// @dev The bits of the coordinates of corners made by clipping polygons.
uint256 constant VALUE_BITS = 83;
/// @dev The index of a bit is found by a table, indexed by the remainder of the word.
uint256 constant BIT_REMAINDERS = 269;

/// @dev A position on the canvas: the row in the upper half of 128 bits, the column in the lower half, integers with this many bits below
/// the pixel, plus POINT_BIAS. In sub-pixels they are below 2^POINT_GUARD.
uint256 constant POINT_BITS = 20;
uint256 constant POINT_BIAS = 0x10000000000;
uint256 constant POINT_GUARD = 22;
uint256 constant SUBPIXEL_TO_POINT = 12;
uint256 constant POINT_MASK = 0xffffffffffffffff;
/// @dev Where a vertex stores such a position, or 0, in the upper bits, replacing its ranges; the address of the face is below, with this
/// bit.
uint256 constant PLACE_POINT = 0x60;
uint256 constant POINT_TAG = 1 << 63;
/// @dev The first row of samples not above a position: its row plus this, shifted by the next constant; and the bias after that.
uint256 constant ROW_UP = 0x9ffff;
uint256 constant ROW_SHIFT = 18;
uint256 constant ROW_BIAS = 0x400000;
/// @dev From eighths of a pixel to the unit of positions.
uint256 constant EIGHTH = 17;

/// @dev An edge during collection: its ends, the upper one first; the number of shadows that begin at it minus those that end; the next
/// edge of the same chain; the previous edge.
uint256 constant EDGE_SIZE = 0x80;
uint256 constant EDGE_COUNT = 0x20;
uint256 constant EDGE_NEXT = 0x40;
uint256 constant EDGE_BEFORE = 0x60;
/// @dev The number of chains, indexed by a remainder of the ends.
uint256 constant CHAINS = 509;

/// @dev The data after the functions of the receiving face: its coordinates; for a potential caster, its corners relative to the receiver's
/// sides, and their distances behind it, lanes; 1 if none of them is behind, otherwise 0; two polygons; and the table of bits.
uint256 constant OWN_COORDINATES = 0x1a0;
uint256 constant SIDES = 0x200;
uint256 constant HEIGHTS = 0x260;
uint256 constant IS_IN_FRONT = 0x280;
uint256 constant POLYGON_1 = 0x2a0;
uint256 constant POLYGON_2 = 0x720;
uint256 constant BIT_TABLE = 0xba0;
uint256 constant RECEIVER_SIZE = 0xce0;
/// @dev A corner of a polygon: relative to the sides of the face, and its distance from a boundary.
uint256 constant POLYGON_CORNER = 0x80;

/// @notice The state of the face that receives shadows.
/// @param planes Its functions, and the data after them.
/// @param isPoint Whether the light is a point light.
/// @param isWide Whether its functions do not fit lanes: it is much larger than the casters.
/// @param places Its corners on the canvas, homogeneous: column and row in sub-pixels, and the distance.
/// @param isVisible Whether it is on the canvas, and not seen edge-on.
/// @param isFlipped Whether the shadow of a face turned away from the light has the opposite orientation on the canvas.
/// @param top, bottom The rows of samples that bound it, with ROW_BIAS; `right`: the column that bounds it, in the unit of positions.
/// @param chains CHAINS addresses of edges, 0 if empty; `last`: the address of the last edge.
/// @param begin The address of the edges.
/// @param tag Identifies this face next to the position on the canvas cached at a caster's corner.
struct Receiver {
    uint256 planes;
    bool isPoint;
    bool isWide;
    bool isPlaced;
    bool isVisible;
    bool isFlipped;
    uint256 top;
    uint256 bottom;
    uint256 right;
    uint256 chains;
    uint256 last;
    uint256 begin;
    uint256 tag;
    int256[9] places;
}

uint256 constant MISSED = 0;
uint256 constant COVERED = 1;
uint256 constant MIXED_SHADOW = 2;

library Receivers {
    /// @notice Writes the data that is common to all faces.
    function open(Receiver memory receiver) internal pure {
        unchecked {
            receiver.planes = freeMemory();
            setFreeMemory(receiver.planes + RECEIVER_SIZE);
            uint256 table = receiver.planes + BIT_TABLE;
            assembly ("memory-safe") {
                for { let i := 0 } lt(i, 256) { i := add(i, 1) } { mstore8(add(table, mod(shl(i, 1), BIT_REMAINDERS)), i) }
            }
        }
    }

    /// @notice Starts a face.
    /// @param face Its record.
    function setFace(Receiver memory receiver, uint256 face) internal pure {
        unchecked {
            uint256 corners = load(face);
            (receiver.last, receiver.begin) = (0, freeMemory());
            receiver.isFlipped = loadSigned(face + FACE_SIDE) > 0;
            receiver.tag = face | POINT_TAG;
            uint256 planes = receiver.planes;
            Faces.writePlanes(face, receiver.isPoint, planes);
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
            if (isWide) {
                fit(planes, planes + BEHIND, receiver.isPoint ? 0 : SIDE_SIZE);
                fit(planes + BEHIND, planes + PLANES_SIZE, PLANES_SIZE - BEHIND);
            }
        }
    }

    /// @dev Divides functions by a power of two, so that they fit lanes.
    /// @param size The size of functions that end with a constant; otherwise 0.
    function fit(uint256 begin, uint256 end, uint256 size) private pure {
        unchecked {
            uint256 most;
            for (uint256 p = begin; p != end; p += 32) {
                bool isConstant = size != 0 && (p + 32 - begin) % size == 0;
                most |= magnitude(loadSigned(p)) >> (isConstant ? CONSTANT_BITS : 0);
            }
            uint256 shift = excess(most, WIDE_BITS);
            for (uint256 p = begin; p != end; p += 32) storeSigned(p, loadSigned(p) >> shift);
        }
    }

    /// @notice Returns the next of up to 256 faces that may shade the receiver: it is in front of it, and inside its sides.
    /// @param bits The set of candidates.
    /// @param casters The address of the first one.
    /// @return caster The address of the face found, with its corners in SIDES and HEIGHTS; or 0.
    /// @return rest The remaining candidates.
    function next(Receiver memory receiver, uint256 bits, uint256 casters) internal pure returns (uint256 caster, uint256 rest) {
        uint256 own = receiver.planes;
        bool isPoint = receiver.isPoint;
        assembly ("memory-safe") {
            for {} bits {} {
                let place_ := and(bits, sub(0, bits))
                bits := xor(bits, place_)
                place_ := and(mload(add(add(own, sub(BIT_TABLE, 31)), mod(place_, BIT_REMAINDERS))), 0xff)
                caster := add(casters, mul(CASTER_SIZE, place_))
                let x := mload(add(caster, 0x20))
                let y := mload(add(caster, 0x40))
                let z := mload(add(caster, 0x60))
                let p := add(own, BEHIND)
                let v := add(mul(x, mload(p)), mul(y, mload(add(p, 0x20))))
                v := add(add(v, mul(z, mload(add(p, 0x40)))), add(mul(LANE_ONES, mload(add(p, 0x60))), LANE_TOPS))
                // all corners are behind it
                if eq(and(v, LANE_TOPS), LANE_TOPS) { continue }
                mstore(add(own, HEIGHTS), v)
                mstore(add(own, IS_IN_FRONT), iszero(and(sub(v, LANE_ONES), LANE_TOPS)))
                if iszero(isPoint) { z := LANE_ONES }
                v := add(add(mul(x, mload(own)), mul(y, mload(add(own, 0x20)))), add(mul(z, mload(add(own, 0x40))), LANE_TOPS))
                // all values are at most 0
                if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) { continue }
                mstore(add(own, SIDES), v)
                v := add(mul(x, mload(add(own, 0x60))), mul(y, mload(add(own, 0x80))))
                v := add(v, add(mul(z, mload(add(own, 0xa0))), LANE_TOPS))
                if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) { continue }
                mstore(add(add(own, SIDES), 0x20), v)
                v := add(mul(x, mload(add(own, 0xc0))), mul(y, mload(add(own, 0xe0))))
                v := add(v, add(mul(z, mload(add(own, 0x100))), LANE_TOPS))
                if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) { continue }
                mstore(add(add(own, SIDES), 0x40), v)
                rest := 1
                break
            }
            caster := mul(caster, rest)
            rest := bits
        }
    }

    /// @notice Returns whether a face found by `next` shades the receiver.
    /// @param caster Its record.
    /// @param plane The address of its functions, or for them.
    /// @return MISSED, COVERED, or MIXED_SHADOW.
    function test(Receiver memory receiver, uint256 caster, uint256 plane) internal pure returns (uint256) {
        unchecked {
            if (receiver.isWide) return MIXED_SHADOW;
            bool isPoint = receiver.isPoint;
            uint256 first = load(caster);
            if (first & HAS_PLANES == 0) {
                Faces.writePlanes(caster, isPoint, plane);
                store(caster, first | HAS_PLANES);
            }
            uint256 own = receiver.planes;
            uint256 all = type(uint256).max;
            bool isMissed;
            assembly ("memory-safe") {
                let x := mload(add(own, OWN_COORDINATES))
                let y := mload(add(add(own, OWN_COORDINATES), 0x20))
                let z := mload(add(add(own, OWN_COORDINATES), 0x40))
                // a caster entirely in front of the receiver is in front of all of it within its sides
                if iszero(mload(add(own, IS_IN_FRONT))) {
                    own := add(plane, BEHIND)
                    all := add(mul(x, mload(own)), mul(y, mload(add(own, 0x20))))
                    all := add(all, add(mul(z, mload(add(own, 0x40))), add(mul(LANE_ONES, mload(add(own, 0x60))), LANE_TOPS)))
                    isMissed := iszero(and(sub(all, LANE_ONES), LANE_TOPS))
                }
                if iszero(isPoint) { z := LANE_ONES }
                for { own := add(plane, BEHIND) } lt(plane, own) { plane := add(plane, SIDE_SIZE) } {
                    let v := add(mul(x, mload(plane)), mul(y, mload(add(plane, 0x20))))
                    v := add(v, add(mul(z, mload(add(plane, 0x40))), LANE_TOPS))
                    all := and(all, v)
                    // all values are at most 0
                    if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) {
                        isMissed := 1
                        break
                    }
                }
            }
            return isMissed ? MISSED : all & LANE_TOPS == LANE_TOPS ? COVERED : MIXED_SHADOW;
        }
    }

    /// @notice Sets the corners on the canvas. The registers must contain the mesh and the matrix of the object.
    /// @param numbers The three vertex indices, 16 bits each.
    function place(Receiver memory receiver, uint256 numbers, uint256 width, uint256 height) internal pure {
        unchecked {
            receiver.isPlaced = true;
            int256[9] memory p = receiver.places;
            uint256 begin;
            assembly ("memory-safe") {
                begin := p
            }
            uint256 placesEnd = begin + 0x120;
            bool isOrthographic = load(FRAME_IS_ORTHOGRAPHIC) != 0;
            uint256 corner = receiver.planes + POLYGON_1;
            bool isPlain = true;
            uint256 most;
            for (uint256 q = begin; q != placesEnd; q += 0x60) {
                VertexShader.clipCoordinates((numbers >> FACE_FIRST_AT) & FACE_INDEX_MASK, corner);
                numbers <<= 16;
                (int256 x, int256 y, int256 w) = (loadSigned(corner), loadSigned(corner + CORNER_Y), loadSigned(corner + CORNER_W));
                if (w < loadSigned(NEAR)) isPlain = false;
                if (isOrthographic) w = int256(ONE_32);
                if (x < 0 || y < 0 || x >= w << GUARD_BITS || y >= w << GUARD_BITS) isPlain = false;
                storeSigned(q, x);
                storeSigned(q + 0x20, y);
                storeSigned(q + 0x40, w);
                if (w > int256(most)) most = uint256(w);
            }
            int256 bias = int256(PIXEL_BIAS << SUBPIXEL_BITS);
            (int256 top, int256 bottom, int256 right) = (0, int256(4 * height), int256(width << POINT_BITS));
            if (!isPlain) {
                // nearer than the near plane, or far beyond the canvas
                most = 0;
                for (uint256 q = begin; q != placesEnd; q += 0x60) {
                    int256 w = loadSigned(q + 0x40);
                    storeSigned(q, loadSigned(q) - bias * w);
                    storeSigned(q + 0x20, loadSigned(q + 0x20) - bias * w);
                    most |= magnitude(loadSigned(q)) | magnitude(loadSigned(q + 0x20)) | magnitude(w);
                }
            }
            uint256 shift = excess(most, isPlain ? DISTANCE_BITS : CLIP_BITS);
            if (isPlain) {
                if (isOrthographic) shift = Q32;
                int256 low = type(int256).max;
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
            int256 determinant = (p[1] * p[5] - p[2] * p[4]) * p[6] + (p[2] * p[3] - p[0] * p[5]) * p[7];
            determinant += (p[0] * p[4] - p[1] * p[3]) * p[8];
            receiver.isVisible = determinant != 0 && top < bottom;
            receiver.isFlipped = receiver.isFlipped != (determinant < 0);
        }
    }

    /// @dev Returns the number of bits by which a value exceeds `bits` bits.
    function excess(uint256 value, uint256 bits) private pure returns (uint256 shift) {
        assembly ("memory-safe") {
            value := shr(bits, value)
            shift := gt(value, 0)
            for { let step := mul(128, shift) } step { step := shr(1, step) } {
                let part := mul(step, gt(shr(step, value), 0))
                value := shr(part, value)
                shift := add(shift, part)
            }
        }
    }

    function magnitude(int256 value) private pure returns (uint256) {
        unchecked {
            return uint256(value < 0 ? -value : value);
        }
    }

    /// @notice Adds the edges of the shadow of a face found by `next`.
    /// @param caster Its record.
    function add(Receiver memory receiver, uint256 caster) internal pure {
        unchecked {
            if (!receiver.isVisible) return;
            uint256 begin = receiver.planes + POLYGON_1;
            uint256 end = begin;
            bool isPlain = load(receiver.planes + IS_IN_FRONT) != 0;
            uint256 corners = load(caster);
            for (uint256 lane; isPlain && lane != 3 * LANE; lane += LANE) {
                uint256 kept = (corners & ADDRESS_MASK) + PLACE_POINT;
                uint256 point = load(kept);
                if (point & POINT_MASK != receiver.tag) {
                    point = (cornerOf(receiver, lane) << 64) | receiver.tag;
                    store(kept, point);
                }
                point >>= 64;
                isPlain = point != 0;
                store(end, point);
                end += 32;
                corners >>= FACE_B_AT;
            }
            if (!isPlain) {
                uint256 polygonEnd;
                (begin, polygonEnd) = clippedPolygon(receiver);
                end = begin;
                for (uint256 p = begin; p != polygonEnd; p += POLYGON_CORNER) {
                    store(end, pointOf(receiver, p));
                    end += 32;
                }
            }
            bool isFlipped = receiver.isFlipped != (loadSigned(caster + FACE_SIDE) > 0);
            uint256 before = load(end - 32);
            for (; begin != end; begin += 32) {
                uint256 point = load(begin);
                (uint256 a, uint256 b) = isFlipped ? (point, before) : (before, point);
                addEdge(receiver, a, b);
                before = point;
            }
        }
    }

    /// @dev Returns the position on the canvas of the shadow of a caster's corner; 0 if it is far outside or does not exist.
    /// @param lane The position of its lane.
    function cornerOf(Receiver memory receiver, uint256 lane) private pure returns (uint256 point) {
        unchecked {
            int256[9] memory places = receiver.places;
            uint256 side = receiver.planes + SIDES;
            assembly ("memory-safe") {
                let a := sub(and(shr(lane, mload(side)), LANE_MASK), LANE_TOP)
                let b := sub(and(shr(lane, mload(add(side, 0x20))), LANE_MASK), LANE_TOP)
                side := sub(and(shr(lane, mload(add(side, 0x40))), LANE_MASK), LANE_TOP)
                let w := add(mul(a, mload(add(places, 0x40))), mul(b, mload(add(places, 0xa0))))
                w := add(w, mul(side, mload(add(places, 0x100))))
                let x := add(mul(a, mload(places)), mul(b, mload(add(places, 0x60))))
                x := add(x, mul(side, mload(add(places, 0xc0))))
                let y := add(mul(a, mload(add(places, 0x20))), mul(b, mload(add(places, 0x80))))
                y := add(y, mul(side, mload(add(places, 0xe0))))
                if and(sgt(add(add(a, b), side), 0), sgt(w, 0)) {
                    let most := shl(POINT_GUARD, w)
                    if iszero(or(gt(add(x, most), shl(1, most)), gt(add(y, most), shl(1, most)))) {
                        point := shl(64, add(sdiv(shl(SUBPIXEL_TO_POINT, y), w), POINT_BIAS))
                        point := or(point, add(sdiv(shl(SUBPIXEL_TO_POINT, x), w), POINT_BIAS))
                    }
                }
            }
        }
    }

    /// @dev Returns the homogeneous position of a polygon's corner.
    function placeOf(Receiver memory receiver, uint256 corner) private pure returns (int256 x, int256 y, int256 w) {
        unchecked {
            int256[9] memory p = receiver.places;
            (int256 a, int256 b, int256 c) = (loadSigned(corner), loadSigned(corner + 0x20), loadSigned(corner + 0x40));
            return (a * p[0] + b * p[3] + c * p[6], a * p[1] + b * p[4] + c * p[7], a * p[2] + b * p[5] + c * p[8]);
        }
    }

    function pointOf(Receiver memory receiver, uint256 corner) private pure returns (uint256 point) {
        (int256 x, int256 y, int256 w) = placeOf(receiver, corner);
        assembly ("memory-safe") {
            point := shl(64, add(sdiv(shl(SUBPIXEL_TO_POINT, y), w), POINT_BIAS))
            point := or(point, add(sdiv(shl(SUBPIXEL_TO_POINT, x), w), POINT_BIAS))
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
                int256 most = w << POINT_GUARD;
                if (sum <= 0 || w <= 0 || x > most || -x > most || y > most || -y > most) isPlain = false;
                storeSigned(p + 0x60, sum);
            }
            if (isPlain) return (polygon, end);
            (polygon, end) = clip(receiver, polygon, end);
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
                    uint256 shift = excess(magnitude(i) | magnitude(j) | magnitude(k), VALUE_BITS);
                    storeSigned(end, i >> shift);
                    storeSigned(end + 0x20, j >> shift);
                    storeSigned(end + 0x40, k >> shift);
                    end += POLYGON_CORNER;
                }
                if (isInside) {
                    assembly ("memory-safe") {
                        mcopy(end, b, 0x60)
                    }
                    end += POLYGON_CORNER;
                }
                a = b;
            }
        }
    }

    /// @dev Adds an edge from one position to another; the shadow is to the right of upward edges.
    function addEdge(Receiver memory receiver, uint256 a, uint256 b) private pure {
        (uint256 top, uint256 bottom, uint256 right) = (receiver.top, receiver.bottom, receiver.right);
        uint256 chains = receiver.chains;
        uint256 last = receiver.last;
        assembly ("memory-safe") {
            let first := shr(ROW_SHIFT, add(shr(64, a), ROW_UP))
            let end := shr(ROW_SHIFT, add(shr(64, b), ROW_UP))
            let more := sub(0, lt(first, end))
            if iszero(more) {
                let other := a
                a := b
                b := other
                other := first
                first := end
                end := other
                more := 1
            }
            // if it crosses a row of the face, and does not lie entirely to the right of it
            if and(
                and(lt(first, end), and(lt(first, bottom), gt(end, top))),
                iszero(and(gt(and(a, POINT_MASK), right), gt(and(b, POINT_MASK), right)))
            ) {
                a := or(shl(128, a), b)
                chains := add(chains, shl(5, mod(a, CHAINS)))
                first := mload(chains)
                end := first
                for {} end { end := mload(add(end, EDGE_NEXT)) } {
                    if eq(mload(end), a) { break }
                }
                switch end
                case 0 {
                    end := mload(0x40)
                    mstore(0x40, add(end, EDGE_SIZE))
                    mstore(end, a)
                    mstore(add(end, EDGE_COUNT), more)
                    mstore(add(end, EDGE_NEXT), first)
                    mstore(add(end, EDGE_BEFORE), last)
                    mstore(chains, end)
                    last := end
                }
                default {
                    end := add(end, EDGE_COUNT)
                    mstore(end, add(mload(end), more))
                }
            }
        }
        receiver.last = last;
    }

    /// @dev Returns the first row of samples that is not above a position, clamped to `top` and `bottom`.
    function rowOf(uint256 point, uint256 top, uint256 bottom) private pure returns (uint256 row) {
        assembly ("memory-safe") {
            row := shr(ROW_SHIFT, add(shr(64, point), ROW_UP))
            if lt(row, top) { row := top }
            if gt(row, bottom) { row := bottom }
        }
    }

    /// @notice Clears all edges.
    function clear(Receiver memory receiver) internal pure {
        unchecked {
            for (uint256 edge = receiver.last; edge != 0; edge = load(edge + EDGE_BEFORE)) {
                store(receiver.chains + 32 * (load(edge) % CHAINS), 0);
            }
            setFreeMemory(receiver.begin);
        }
    }

    /// @notice Writes the remaining edges, sorted by the first row of pixels.
    /// @param heads A zero word for each row of pixels.
    /// @return list The address of the size of the list, followed by the list; 0 if nothing is left.
    function finish(Receiver memory receiver, uint256 heads) internal pure returns (uint256 list) {
        unchecked {
            uint256 count;
            (uint256 top, uint256 bottom) = (receiver.top, receiver.bottom);
            uint256 first = type(uint256).max;
            // insert each edge at the front of its row, starting with the last one
            for (uint256 edge = receiver.last; edge != 0; edge = load(edge + EDGE_BEFORE)) {
                uint256 key = load(edge);
                store(receiver.chains + 32 * (key % CHAINS), 0);
                if (load(edge + EDGE_COUNT) == 0) continue;
                uint256 head = heads + 32 * ((rowOf(key >> 128, top, bottom) - ROW_BIAS) >> 2);
                store(edge + EDGE_NEXT, load(head));
                store(head, edge);
                if (head < first) first = head;
                ++count;
            }
            uint256 begin = freeMemory();
            uint256 end = begin;
            for (; count != 0; first += 32) {
                uint256 edge = load(first);
                if (edge == 0) continue;
                store(first, 0);
                for (; edge != 0; edge = load(edge + EDGE_NEXT)) {
                    --count;
                    int256 more = loadSigned(edge + EDGE_COUNT);
                    uint256 word = wordOf(load(edge), top, bottom);
                    if (more < 0) (word, more) = (word | 1, -more);
                    for (; more != 0; --more) {
                        store(end, word);
                        end += 32;
                    }
                }
            }
            list = receiver.begin;
            uint256 size = end - begin;
            if (size == 0) {
                setFreeMemory(list);
                return 0;
            }
            store(begin - 32, size);
            assembly ("memory-safe") {
                mcopy(list, sub(begin, 0x20), add(size, 0x20))
            }
            setFreeMemory(list + size + 32);
        }
    }

    /// @dev Returns the word of an edge with these ends.
    function wordOf(uint256 key, uint256 top, uint256 bottom) private pure returns (uint256 word) {
        unchecked {
            word = ((rowOf(key >> 128, top, bottom) - ROW_BIAS) << TOP_AT)
                | ((rowOf(key & type(uint128).max, top, bottom) - ROW_BIAS) << BOTTOM_AT);
        }
        assembly ("memory-safe") {
            let x := sub(and(shr(128, key), POINT_MASK), POINT_BIAS)
            let y := sub(shr(192, key), POINT_BIAS)
            let dx := sub(sub(and(key, POINT_MASK), POINT_BIAS), x)
            let dy := sub(sub(and(shr(64, key), POINT_MASK), POINT_BIAS), y)
            let value := sub(mul(y, dx), mul(x, dy))
            y := shl(EIGHTH, sub(0, dx))
            x := shl(EIGHTH, dy)
            // drop the bits of the greater one above EDGE_BITS, at most 16
            dx := sar(255, y)
            dx := sub(xor(y, dx), dx)
            if gt(x, dx) { dx := x }
            dx := shr(EDGE_BITS, dx)
            if dx {
                dy := shl(3, lt(0xff, dx))
                dy := or(dy, shl(2, lt(0xf, shr(dy, dx))))
                dy := or(dy, shl(1, lt(0x3, shr(dy, dx))))
                dy := add(or(dy, lt(1, shr(dy, dx))), 1)
                x := sar(dy, x)
                y := sar(dy, y)
                value := sar(dy, value)
            }
            word := or(or(word, shl(X_AT, x)), or(shl(Y_AT, and(y, LANE_48)), shl(CONSTANT_AT, and(value, LANE_64))))
        }
    }
}
