// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {magnitude, excess} from "../math/Bits.sol";
import {BEHIND, CASTER_SIZE, FACE_SIDE, Faces, LANE_ONES, LANE_TOPS, PLANES_SIZE, SIDE_SIZE} from "./Faces.sol";
import "../words/Registers.sol";

// Computes which planes of `Shadow` of picture.py reach a face.
// Finds the faces that shade a face, the receiver. A caster shades it if it is in front of it, and inside its sides as seen from the light.

/// @dev The bits of the coordinates of a face, including the sign, for which all functions fit lanes. The functions of a wider face are
/// divided by a power of two: factors have WIDE_BITS then, constants CONSTANT_BITS more, without the sign.
uint256 constant NARROW_BITS = 27;
uint256 constant WIDE_BITS = 60;
uint256 constant CONSTANT_BITS = 22;
/// @dev The index of a bit is found by a table, indexed by the remainder of the word.
uint256 constant BIT_REMAINDERS = 269;
uint256 constant BYTE_MASK = 0xff;

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
/// @dev Identifies a receiver next to the position on the canvas cached at a caster's corner: the address of its face, with this bit.
uint256 constant POINT_TAG = 1 << 63;

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

/// @dev Whether a caster shades a receiver: no part of it, all of it, or what the outlines of shadows will tell.
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
            (uint256 a, uint256 b, uint256 c) = Faces.cornersOf(load(face));
            (receiver.last, receiver.begin) = (0, freeMemory());
            receiver.isFlipped = loadSigned(face + FACE_SIDE) > 0;
            receiver.tag = face | POINT_TAG;
            uint256 planes = receiver.planes;
            Faces.writePlanes(planes, face, a, b, c, receiver.isPoint);
            Faces.pack(planes + OWN_COORDINATES, a, b, c);
            bool isWide;
            assembly ("memory-safe") {
                let bias := shl(sub(NARROW_BITS, 1), 1) // half the range, which makes numbers within it positive
                for { let i := 0 } lt(i, 0x60) { i := add(i, 0x20) } { // x, y, z
                    let all := or(add(mload(add(a, i)), bias), or(add(mload(add(b, i)), bias), add(mload(add(c, i)), bias))) // of a, b, c
                    isWide := or(isWide, gt(shr(NARROW_BITS, all), 0)) // a bit above the range
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
            int256 most;
            for (uint256 p = begin; p != end; p += 32) {
                bool isConstant = size != 0 && (p + 32 - begin) % size == 0;
                most |= magnitude(loadSigned(p)) >> (isConstant ? CONSTANT_BITS : 0);
            }
            uint256 shift = excess(uint256(most), WIDE_BITS);
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
                let place_ := and(bits, sub(0, bits)) // the lowest bit
                bits := xor(bits, place_) // remove it
                place_ := and(mload(add(add(own, sub(BIT_TABLE, 31)), mod(place_, BIT_REMAINDERS))), BYTE_MASK) // from here on, its index
                caster := add(casters, mul(CASTER_SIZE, place_)) // its record
                let x := mload(add(caster, 0x20)) // of three corners each
                let y := mload(add(caster, 0x40))
                let z := mload(add(caster, 0x60))
                let p := add(own, BEHIND) // the half-space behind the receiver
                let v := add(mul(x, mload(p)), mul(y, mload(add(p, 0x20)))) // their distances behind the receiver, plus LANE_TOPS
                v := add(add(v, mul(z, mload(add(p, 0x40)))), add(mul(LANE_ONES, mload(add(p, 0x60))), LANE_TOPS)) // n . p + constant
                if eq(and(v, LANE_TOPS), LANE_TOPS) { continue } // all corners are behind it: v >= 0
                mstore(add(own, HEIGHTS), v) // kept for clipping
                mstore(add(own, IS_IN_FRONT), iszero(and(sub(v, LANE_ONES), LANE_TOPS))) // no corner is behind it: v <= 0
                if iszero(isPoint) { z := LANE_ONES } // the third term of sides is a constant
                v := add(add(mul(x, mload(own)), mul(y, mload(add(own, 0x20)))), add(mul(z, mload(add(own, 0x40))), LANE_TOPS))
                if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) { continue } // all are outside the first side: v <= 0
                mstore(add(own, SIDES), v) // kept as weights
                v := add(mul(x, mload(add(own, 0x60))), mul(y, mload(add(own, 0x80)))) // the second side
                v := add(v, add(mul(z, mload(add(own, 0xa0))), LANE_TOPS)) // + z or the constant
                if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) { continue } // all are outside
                mstore(add(add(own, SIDES), 0x20), v)
                v := add(mul(x, mload(add(own, 0xc0))), mul(y, mload(add(own, 0xe0)))) // the third side
                v := add(v, add(mul(z, mload(add(own, 0x100))), LANE_TOPS)) // + z or the constant
                if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) { continue } // all are outside
                mstore(add(add(own, SIDES), 0x40), v)
                rest := 1 // found
                break
            }
            caster := mul(caster, rest) // 0 if none is found
            rest := bits // what remains after it
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
                (uint256 a, uint256 b, uint256 c) = Faces.cornersOf(first);
                Faces.writePlanes(plane, caster, a, b, c, isPoint);
                store(caster, first | HAS_PLANES);
            }
            uint256 own = receiver.planes;
            uint256 all = type(uint256).max;
            bool isMissed;
            assembly ("memory-safe") {
                let x := mload(add(own, OWN_COORDINATES)) // of the receiver's three corners each
                let y := mload(add(add(own, OWN_COORDINATES), 0x20)) // y
                let z := mload(add(add(own, OWN_COORDINATES), 0x40))
                // a caster entirely in front of the receiver is in front of all of it within its sides
                if iszero(mload(add(own, IS_IN_FRONT))) { // some corner of the caster is behind the receiver
                    own := add(plane, BEHIND) // from here on, an address of the caster's functions
                    all := add(mul(x, mload(own)), mul(y, mload(add(own, 0x20)))) // distances behind the caster, plus LANE_TOPS
                    all := add(all, add(mul(z, mload(add(own, 0x40))), add(mul(LANE_ONES, mload(add(own, 0x60))), LANE_TOPS)))
                    isMissed := iszero(and(sub(all, LANE_ONES), LANE_TOPS)) // none is behind it: all <= 0
                }
                if iszero(isPoint) { z := LANE_ONES } // as in next
                for { own := add(plane, BEHIND) } lt(plane, own) { plane := add(plane, SIDE_SIZE) } { // the caster's three sides
                    let v := add(mul(x, mload(plane)), mul(y, mload(add(plane, 0x20)))) // relative to this side, plus LANE_TOPS
                    v := add(v, add(mul(z, mload(add(plane, 0x40))), LANE_TOPS))
                    all := and(all, v) // the highest bits: corners inside all sides so far
                    if iszero(and(sub(v, LANE_ONES), LANE_TOPS)) { // all are outside this side: v <= 0
                        isMissed := 1 // it casts its shadow elsewhere
                        break
                    }
                }
            }
            return isMissed ? MISSED : all & LANE_TOPS == LANE_TOPS ? COVERED : MIXED_SHADOW;
        }
    }
}
