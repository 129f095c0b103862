// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {load, loadSigned, store} from "../words/Memory.sol";
import {BESIDE, BUCKETS, CUBE, EVERYWHERE, Frame, LightSpace, PLACE_BUCKETS, SIDE_AT} from "./LightSpace.sol";

// Faces in light space, and the search for those that may shade a face.
//
// A face has six words: a word of addresses and ranges (FACE_); its normal, the cross product of two sides; its side, positive if it faces
// the light, 0 if edge-on; and the results for its shadows.
//
// Shadow casters are numbered, and each is a bit in the sets of faces by ranges of coordinates. There are five tables of sets: faces that
// reach a range in x or beyond it; faces that begin in it or before; the same for y; faces in a range of depths or nearer to the light. The
// faces that may shade a face are the intersection of five of these sets: four `and`s test 256 faces. Each side of a cube has its own
// tables.

uint256 constant FACE_RECORD_SIZE = 0xc0;
uint256 constant FACE_NORMAL = 0x20;
uint256 constant FACE_SIDE = 0x80;
uint256 constant FACE_ENTRY = 0xa0;
/// @dev The first word: the addresses of the vertices, HAS_PLANES, and the ranges of x, y, z, minimum and maximum, in bytes.
uint256 constant FACE_B_AT = 32;
uint256 constant FACE_C_AT = 64;
/// @dev Whether its functions are written.
uint256 constant HAS_PLANES = 1 << 96;
uint256 constant FACE_BOX_AT = 128;
uint256 constant ADDRESS_MASK = 0xffffffff;
uint256 constant BOX_MASK = 0xffffffffffffffff;
/// @dev The highest bit of each lane of a vertex's ranges.
uint256 constant LANE_GUARDS = 0x800080008000;

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
                let x := mload(a)
                let y := mload(add(a, 0x20))
                let z := mload(add(a, 0x40))
                let bx := sub(mload(b), x)
                let by := sub(mload(add(b, 0x20)), y)
                let bz := sub(mload(add(b, 0x40)), z)
                let cx := sub(mload(c), x)
                let cy := sub(mload(add(c, 0x20)), y)
                let cz := sub(mload(add(c, 0x40)), z)
                let i := sub(mul(by, cz), mul(bz, cy))
                let j := sub(mul(bz, cx), mul(bx, cz))
                let k := sub(mul(bx, cy), mul(by, cx))
                mstore(add(face, 0x20), i)
                mstore(add(face, 0x40), j)
                mstore(add(face, 0x60), k)
                side := k
                if isPoint { side := sub(0, add(mul(i, x), add(mul(j, y), mul(k, z)))) }
                mstore(add(face, FACE_SIDE), side)
            }
            store(face, boxOf(a, b, c) | (c << FACE_C_AT) | (b << FACE_B_AT) | a);
        }
    }

    /// @dev Returns the ranges of three vertices: the minimum in the lower byte of each lane, the maximum in the upper one; BESIDE if a
    /// vertex is, or if they are on several sides of the cube.
    function boxOf(uint256 a, uint256 b, uint256 c) private pure returns (uint256 box) {
        assembly ("memory-safe") {
            a := mload(add(a, PLACE_BUCKETS))
            b := mload(add(b, PLACE_BUCKETS))
            c := mload(add(c, PLACE_BUCKETS))
            switch or(and(or(or(a, b), c), BESIDE), shr(SIDE_AT, or(xor(a, b), xor(b, c))))
            case 0 {
                // the mask has ones in each lane of a that is not less than that of b
                let mask := and(sub(or(a, LANE_GUARDS), b), LANE_GUARDS)
                let change := and(xor(a, b), sub(mask, shr(15, mask)))
                let high := xor(b, change)
                let low := xor(a, change)
                mask := and(sub(or(c, LANE_GUARDS), high), LANE_GUARDS)
                high := xor(high, and(xor(c, high), sub(mask, shr(15, mask))))
                mask := and(sub(or(low, LANE_GUARDS), c), LANE_GUARDS)
                low := xor(low, and(xor(c, low), sub(mask, shr(15, mask))))
                box := shl(FACE_BOX_AT, or(low, shl(8, high)))
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
        internal
        pure
        returns (uint256 end)
    {
        unchecked {
            uint256 box = (corners >> FACE_BOX_AT) & BOX_MASK;
            uint256 size = 5 * BUCKETS * 32 * words;
            if (corners & BESIDE == 0 || frame.sides == 1) {
                // faces beside a point light may shade everything
                store(target, tables + (box >> SIDE_AT & 7) * size);
                store(target + 0x20, corners & BESIDE == 0 ? box : EVERYWHERE);
                return target + 0x40;
            }
            uint256[3] memory places =
                [corners & ADDRESS_MASK, (corners >> FACE_B_AT) & ADDRESS_MASK, (corners >> FACE_C_AT) & ADDRESS_MASK];
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
            let bit := shl(and(index, 0xff), 1)
            let size := shl(5, words)
            let set := add(sets, shl(5, shr(8, index)))
            // the maximum and minimum x, the maximum and minimum y, the maximum z
            let p := add(set, mul(size, byte(30, box)))
            mstore(p, or(mload(p), bit))
            set := add(set, mul(BUCKETS, size))
            p := add(set, mul(size, byte(31, box)))
            mstore(p, or(mload(p), bit))
            set := add(set, mul(BUCKETS, size))
            p := add(set, mul(size, byte(28, box)))
            mstore(p, or(mload(p), bit))
            set := add(set, mul(BUCKETS, size))
            p := add(set, mul(size, byte(29, box)))
            mstore(p, or(mload(p), bit))
            set := add(set, mul(BUCKETS, size))
            p := add(set, mul(size, byte(26, box)))
            mstore(p, or(mload(p), bit))
        }
    }

    /// @notice Adds to each set the sets of the ranges beyond it, or before it.
    function complete(uint256 sets, uint256 words) internal pure {
        assembly ("memory-safe") {
            let size := shl(5, words)
            let table := mul(BUCKETS, size)
            for { let t := 0 } lt(t, 5) { t := add(t, 1) } {
                let begin := add(sets, mul(t, table))
                let end := add(begin, table)
                switch and(t, 1)
                case 0 {
                    for { let p := sub(end, size) } gt(p, begin) {} {
                        p := sub(p, 0x20)
                        mstore(p, or(mload(p), mload(add(p, size))))
                    }
                }
                default {
                    for { let p := add(begin, size) } lt(p, end) { p := add(p, 0x20) } {
                        mstore(p, or(mload(p), mload(sub(p, size))))
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
            let size := shl(5, words)
            let set := add(sets, offset)
            bits := mload(add(set, mul(size, byte(31, box))))
            set := add(set, mul(BUCKETS, size))
            bits := and(bits, mload(add(set, mul(size, byte(30, box)))))
            set := add(set, mul(BUCKETS, size))
            bits := and(bits, mload(add(set, mul(size, byte(29, box)))))
            set := add(set, mul(BUCKETS, size))
            bits := and(bits, mload(add(set, mul(size, byte(28, box)))))
            set := add(set, mul(BUCKETS, size))
            bits := and(bits, mload(add(set, mul(size, byte(27, box)))))
        }
    }

    /// @notice Writes the coordinates of three corners as lanes.
    /// @param corners The first word of a face record.
    function pack(uint256 target, uint256 corners) internal pure {
        assembly ("memory-safe") {
            let a := and(corners, ADDRESS_MASK)
            let b := and(shr(FACE_B_AT, corners), ADDRESS_MASK)
            let c := and(shr(FACE_C_AT, corners), ADDRESS_MASK)
            for { let i := 0 } lt(i, 0x60) { i := add(i, 0x20) } {
                mstore(add(target, i), add(mload(add(a, i)), shl(LANE, add(mload(add(b, i)), shl(LANE, mload(add(c, i)))))))
            }
        }
    }

    /// @notice Writes the four functions of a face.
    function writePlanes(uint256 face, bool isPoint, uint256 plane) internal pure {
        unchecked {
            uint256 corners = load(face);
            uint256 a = corners & ADDRESS_MASK;
            uint256 b = (corners >> FACE_B_AT) & ADDRESS_MASK;
            uint256 c = (corners >> FACE_C_AT) & ADDRESS_MASK;
            int256 sign = loadSigned(face + FACE_SIDE) > 0 ? int256(1) : int256(-1);
            writeSide(plane, b, c, sign, isPoint);
            writeSide(plane + SIDE_SIZE, c, a, sign, isPoint);
            writeSide(plane + 2 * SIDE_SIZE, a, b, sign, isPoint);
            assembly ("memory-safe") {
                plane := add(plane, BEHIND)
                sign := sub(0, sign)
                let x := mul(sign, mload(add(face, 0x20)))
                let y := mul(sign, mload(add(face, 0x40)))
                let z := mul(sign, mload(add(face, 0x60)))
                mstore(plane, x)
                mstore(add(plane, 0x20), y)
                mstore(add(plane, 0x40), z)
                x := add(mul(x, mload(a)), add(mul(y, mload(add(a, 0x20))), mul(z, mload(add(a, 0x40)))))
                mstore(add(plane, 0x60), sub(0, x))
            }
        }
    }

    function writeSide(uint256 plane, uint256 p, uint256 q, int256 sign, bool isPoint) private pure {
        assembly ("memory-safe") {
            let px := mload(p)
            let py := mload(add(p, 0x20))
            let qx := mload(q)
            let qy := mload(add(q, 0x20))
            switch isPoint
            case 0 {
                mstore(plane, mul(sign, sub(py, qy)))
                mstore(add(plane, 0x20), mul(sign, sub(qx, px)))
                mstore(add(plane, 0x40), mul(sign, sub(mul(px, qy), mul(py, qx))))
            }
            default {
                let pz := mload(add(p, 0x40))
                let qz := mload(add(q, 0x40))
                mstore(plane, mul(sign, sub(mul(pz, qy), mul(py, qz))))
                mstore(add(plane, 0x20), mul(sign, sub(mul(px, qz), mul(pz, qx))))
                mstore(add(plane, 0x40), mul(sign, sub(mul(py, qx), mul(px, qy))))
            }
        }
    }
}
