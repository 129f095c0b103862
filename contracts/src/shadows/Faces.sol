// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BUCKETS, CUBE, EVERYWHERE, Frame, HIGH_AT, LightSpace, PLACE_BOX} from "./LightSpace.sol";
import "../words/Registers.sol";

// Finds the faces that `Shadow.on` of picture.py must test.
// Faces in light space, and the search for those that may shade a face.
//
// A face with the vertices a, b, c has six words: their addresses, and its ranges (FACE_ in Words.sol); its normal n, the cross product of
// two sides; its side, positive if it faces the light, 0 if edge-on; and the results for its shadows.
//
// Shadow casters are numbered, and each is a bit in the sets of faces by ranges of coordinates. There are five tables of sets: faces that
// reach a range in x or beyond it; faces that begin in it or before; the same for y; faces in a range of depths or nearer to the light. The
// faces that may shade a face are the intersection of five of these sets: four `and`s test 256 faces. Each side of a cube has its own
// tables.

uint256 constant FACE_RECORD_SIZE = 0xc0;
uint256 constant FACE_SIDE = 0x80;
uint256 constant FACE_ENTRY = 0xa0;
/// @dev The highest bit of each lane of a vertex's ranges, and the bits below it.
uint256 constant LANE_GUARDS = 0x800080008000;
uint256 constant BELOW_GUARD = 15;
/// @dev The bytes of ranges in a word: the minimum and the maximum of each coordinate.
uint256 constant LOW_X = 31;
uint256 constant HIGH_X = 30;
uint256 constant LOW_Y = 29;
uint256 constant HIGH_Y = 28;
uint256 constant LOW_Z = 27;
uint256 constant HIGH_Z = 26;
/// @dev The faces of a word of a set, 2^8; the bits of a number within it.
uint256 constant SET_SHIFT = 8;
uint256 constant INDEX_IN_SET = 0xff;

/// @dev The functions of a face, positive in shadow: three sides, each opposite to a corner, with the factors of x and y, and that of z for
/// a point light, otherwise a constant; and the half-space behind the face, with the factors of x, y and z and a constant.
uint256 constant SIDE_SIZE = 0x60;
uint256 constant BEHIND = 0x120;
uint256 constant PLANES_SIZE = 0x1a0;

/// @dev A shadow caster: the address of its face, and the x, y and z of its corners, signed lanes of 85 bits, so that evaluating a function
/// at three corners takes as many products as at one.
uint256 constant CASTER_SIZE = 0x80;
uint256 constant LANE = 85;
/// @dev 1 in each lane; its highest bit, which added to a lane is set if the value is at least 0; that bit of all lanes; a lane.
uint256 constant LANE_ONES = 0x4000000000000000000002000000000000000000001;
uint256 constant LANE_TOP = 0x1000000000000000000000;
uint256 constant LANE_TOPS = 0x4000000000000000000002000000000000000000001000000000000000000000;
uint256 constant LANE_MASK = 0x1fffffffffffffffffffff;

library Faces {
    /// @notice Writes the record of a face.
    /// @param face The address for the record.
    /// @param a, b, c The addresses of its vertices.
    function write(uint256 face, uint256 a, uint256 b, uint256 c, bool isPoint) internal pure {
        unchecked {
            uint256 side;
            assembly ("memory-safe") {
                let x := mload(a) // a
                let y := mload(add(a, 0x20))
                let z := mload(add(a, 0x40))
                let bx := sub(mload(b), x) // b - a
                let by := sub(mload(add(b, 0x20)), y) // b.y - a.y
                let bz := sub(mload(add(b, 0x40)), z)
                let cx := sub(mload(c), x) // c - a
                let cy := sub(mload(add(c, 0x20)), y) // c.y - a.y
                let cz := sub(mload(add(c, 0x40)), z)
                let i := sub(mul(by, cz), mul(bz, cy)) // n = (b - a) x (c - a)
                let j := sub(mul(bz, cx), mul(bx, cz)) // n.y
                let k := sub(mul(bx, cy), mul(by, cx)) // n.z
                mstore(add(face, 0x20), i) // n
                mstore(add(face, 0x40), j)
                mstore(add(face, 0x60), k)
                side := k // n . z: z points toward a directional light
                if isPoint { side := sub(0, add(mul(i, x), add(mul(j, y), mul(k, z)))) } // n . (0 - a): a point light is at 0
                mstore(add(face, FACE_SIDE), side) // positive toward the light
            }
            store(face, boxOf(a, b, c) | (c << FACE_C_AT) | (b << FACE_B_AT) | a);
        }
    }

    /// @dev Returns the ranges of three vertices: the minimum in the lower byte of each lane, the maximum in the upper one; BESIDE if a
    /// vertex is, or if they are on several sides of the cube.
    function boxOf(uint256 a, uint256 b, uint256 c) private pure returns (uint256 box) {
        assembly ("memory-safe") {
            a := mload(add(a, PLACE_BOX)) // the ranges of the vertices
            b := mload(add(b, PLACE_BOX))
            c := mload(add(c, PLACE_BOX))
            switch or(and(or(or(a, b), c), BESIDE), shr(BOX_SIDE_AT, or(xor(a, b), xor(b, c)))) // one is beside, or sides differ
            case 0 {
                let mask := and(sub(or(a, LANE_GUARDS), b), LANE_GUARDS) // a >= b, in each lane
                let change := and(xor(a, b), sub(mask, shr(BELOW_GUARD, mask))) // a ^ b in these lanes
                let high := xor(b, change) // max(a, b)
                let low := xor(a, change) // min(a, b)
                mask := and(sub(or(c, LANE_GUARDS), high), LANE_GUARDS) // c >= high
                high := xor(high, and(xor(c, high), sub(mask, shr(BELOW_GUARD, mask)))) // max(high, c)
                mask := and(sub(or(low, LANE_GUARDS), c), LANE_GUARDS) // low >= c
                low := xor(low, and(xor(c, low), sub(mask, shr(BELOW_GUARD, mask)))) // min(low, c)
                box := shl(FACE_BOX_AT, or(low, shl(HIGH_AT, high))) // minimum in the lower byte, maximum in the upper
            }
            default { box := BESIDE }
        }
    }

    /// @notice Writes where to search for faces that may shade a face: for each side of the cube on which it lies, the tables and the
    /// ranges.
    /// @param target The address to write to.
    /// @param tables The address of the first side's tables.
    /// @param corners The first word of its record.
    /// @return end The address after the last of these pairs.
    function writeBoxes(uint256 target, uint256 tables, uint256 words, Frame memory frame, uint256 corners)
        internal pure returns (uint256 end)
    {
        unchecked {
            uint256 box = (corners >> FACE_BOX_AT) & FACE_BOX_MASK;
            uint256 size = 5 * BUCKETS * 32 * words;
            if (corners & BESIDE == 0 || frame.sides == 1) {
                // faces beside a point light may shade everything
                store(target, tables + (box >> BOX_SIDE_AT & BOX_SIDE_MASK) * size);
                store(target + 0x20, corners & BESIDE == 0 ? box : EVERYWHERE);
                return target + 0x40;
            }
            uint256[3] memory places;
            (places[0], places[1], places[2]) = cornersOf(corners);
            for (uint256 side; side != CUBE; ++side) {
                box = LightSpace.boxOn(frame, places, side);
                if (box != 0) {
                    store(target, tables + side * size);
                    store(target + 0x20, box);
                    target += 0x40;
                }
            }
            return target;
        }
    }

    /// @notice Inserts a face into the sets of its ranges.
    /// @param sets Tables of sets of `words` words each.
    function insert(uint256 sets, uint256 words, uint256 index, uint256 box) internal pure {
        assembly ("memory-safe") {
            let bit := shl(and(index, INDEX_IN_SET), 1) // 1 << (index % 256)
            let size := shl(WORD_SHIFT, words) // bytes of a set
            let set := add(sets, shl(WORD_SHIFT, shr(SET_SHIFT, index))) // of the first range of the first table
            let p := add(set, mul(size, byte(HIGH_X, box))) // reaches its maximum x or beyond it
            mstore(p, or(mload(p), bit)) // its bit is set in this range
            set := add(set, mul(BUCKETS, size)) // the next table
            p := add(set, mul(size, byte(LOW_X, box))) // begins at its minimum x or before
            mstore(p, or(mload(p), bit))
            set := add(set, mul(BUCKETS, size))
            p := add(set, mul(size, byte(HIGH_Y, box))) // the same for y
            mstore(p, or(mload(p), bit))
            set := add(set, mul(BUCKETS, size))
            p := add(set, mul(size, byte(LOW_Y, box))) // begins at its minimum y or before
            mstore(p, or(mload(p), bit))
            set := add(set, mul(BUCKETS, size))
            p := add(set, mul(size, byte(HIGH_Z, box))) // is at this depth or nearer to the light
            mstore(p, or(mload(p), bit))
        }
    }

    /// @notice Adds to each set the sets of the ranges beyond it, or before it.
    function complete(uint256 sets, uint256 words) internal pure {
        assembly ("memory-safe") {
            let size := shl(WORD_SHIFT, words) // bytes of a set
            let table := mul(BUCKETS, size) // bytes of a table
            for { let t := 0 } lt(t, 5) { t := add(t, 1) } {
                let begin := add(sets, mul(t, table)) // its first range
                let end := add(begin, table) // behind its last
                switch and(t, 1) // whether it is of minima
                case 0 { // of maxima, or depths
                    for { let p := sub(end, size) } gt(p, begin) {} { // downward: what is in a range is in all before it
                        p := sub(p, 0x20)
                        mstore(p, or(mload(p), mload(add(p, size)))) // range r has all of r + 1
                    }
                }
                default {
                    for { let p := add(begin, size) } lt(p, end) { p := add(p, 0x20) } { // upward: in all after it
                        mstore(p, or(mload(p), mload(sub(p, size)))) // range r has all of r - 1
                    }
                }
            }
        }
    }

    /// @notice Returns which of 256 faces may shade a face.
    /// @param box The ranges of the face.
    /// @param offset The offset of the word in each set.
    function candidates(uint256 sets, uint256 words, uint256 box, uint256 offset) internal pure returns (uint256 bits) {
        assembly ("memory-safe") {
            let size := shl(WORD_SHIFT, words) // bytes of a set
            let set := add(sets, offset) // a word of the first range
            bits := mload(add(set, mul(size, byte(LOW_X, box)))) // those that reach the face's minimum x
            set := add(set, mul(BUCKETS, size)) // the next table
            bits := and(bits, mload(add(set, mul(size, byte(HIGH_X, box))))) // those that begin before its maximum x
            set := add(set, mul(BUCKETS, size))
            bits := and(bits, mload(add(set, mul(size, byte(LOW_Y, box))))) // the same for y
            set := add(set, mul(BUCKETS, size))
            bits := and(bits, mload(add(set, mul(size, byte(HIGH_Y, box))))) // begin before its maximum y
            set := add(set, mul(BUCKETS, size))
            bits := and(bits, mload(add(set, mul(size, byte(LOW_Z, box))))) // those that are nearer to the light than its minimum
        }
    }

    /// @notice Returns the addresses of the vertices of a face.
    /// @param corners The first word of its record.
    function cornersOf(uint256 corners) internal pure returns (uint256 a, uint256 b, uint256 c) {
        (a, b, c) = (corners & FACE_A_MASK, (corners >> FACE_B_AT) & FACE_B_MASK, (corners >> FACE_C_AT) & FACE_C_MASK);
    }

    /// @notice Writes the coordinates of three vertices as lanes.
    function pack(uint256 target, uint256 a, uint256 b, uint256 c) internal pure {
        assembly ("memory-safe") {
            for { let i := 0 } lt(i, 0x60) { i := add(i, 0x20) } { // x, y, z
                mstore(add(target, i), add(mload(add(a, i)), shl(LANE, add(mload(add(b, i)), shl(LANE, mload(add(c, i)))))))
            }
        }
    }

    /// @notice Writes the four functions of a face.
    /// @param a, b, c The addresses of its vertices.
    function writePlanes(uint256 plane, uint256 face, uint256 a, uint256 b, uint256 c, bool isPoint) internal pure {
        unchecked {
            int256 sign = loadSigned(face + FACE_SIDE) > 0 ? int256(1) : int256(-1);
            writeSide(plane, b, c, sign, isPoint);
            writeSide(plane + SIDE_SIZE, c, a, sign, isPoint);
            writeSide(plane + 2 * SIDE_SIZE, a, b, sign, isPoint);
            assembly ("memory-safe") {
                plane := add(plane, BEHIND) // from here on, the address of the fourth
                sign := sub(0, sign) // the normal away from the light
                let x := mul(sign, mload(add(face, 0x20))) // -sign n
                let y := mul(sign, mload(add(face, 0x40)))
                let z := mul(sign, mload(add(face, 0x60)))
                mstore(plane, x) // the factors of x, y and z
                mstore(add(plane, 0x20), y)
                mstore(add(plane, 0x40), z)
                x := add(mul(x, mload(a)), add(mul(y, mload(add(a, 0x20))), mul(z, mload(add(a, 0x40))))) // n . a
                mstore(add(plane, 0x60), sub(0, x)) // n . (p - a) > 0 behind the face
            }
        }
    }

    /// @dev Writes the function of the side from p to q: of a directional light, the area to the left of the line through them; of a point
    /// light, the volume on one side of the plane through them and the light.
    function writeSide(uint256 plane, uint256 p, uint256 q, int256 sign, bool isPoint) private pure {
        assembly ("memory-safe") {
            let px := mload(p) // p
            let py := mload(add(p, 0x20))
            let qx := mload(q) // q
            let qy := mload(add(q, 0x20))
            switch isPoint // or toward a directional light
            case 0 {
                mstore(plane, mul(sign, sub(py, qy))) // the factor of x
                mstore(add(plane, 0x20), mul(sign, sub(qx, px))) // that of y
                mstore(add(plane, 0x40), mul(sign, sub(mul(px, qy), mul(py, qx)))) // the constant: 0 at p and q
            }
            default {
                let pz := mload(add(p, 0x40)) // p.z
                let qz := mload(add(q, 0x40))
                mstore(plane, mul(sign, sub(mul(pz, qy), mul(py, qz)))) // the factors are those of q x p
                mstore(add(plane, 0x20), mul(sign, sub(mul(px, qz), mul(pz, qx)))) // (q x p).y
                mstore(add(plane, 0x40), mul(sign, sub(mul(py, qx), mul(px, qy)))) // (q x p).z
            }
        }
    }
}
