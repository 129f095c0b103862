// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {sqrtNear} from "../../math/Roots.sol";
import "../../words/Registers.sol";

// The light of lamps on smooth surfaces at vertices, at the midpoints of edges on the screen, and in the middle of triangles. Vertex records
// keep that of vertices, and a table that of edges, since both belong to several triangles.
//
// The light of a lamp is a word of two lanes, both Q24: the square of the cosine between normal and half vector in the lower 85 bits, N * L
// of unit vectors, which may be negative, above.

/// @dev 1, Q80; conversions.
uint256 constant ONE_80 = 1 << 80;
uint256 constant Q80_TO_Q16 = 64;
uint256 constant Q20_TO_Q36 = 16;
uint256 constant HALF_OF_Q48_TO_Q24 = 25;
/// @dev 1/2, Q48: further steps of Newton's method for shorter normals.
uint256 constant HALF_48 = 1 << 47;
uint256 constant ROOT_STEPS = 12;
/// @dev The table of edges: a multiplier that mixes keys, the position of the index in the product, its bits, and the bytes of an entry.
uint256 constant EDGE_HASH = 0x9e3779b97f4a7c15;
uint256 constant EDGE_HASH_AT = 56;
uint256 constant EDGE_HASH_MASK = 0x3ff;
uint256 constant EDGE_SIZE = 128;

library SmoothNodes {
    /// @notice Writes the node of a vertex to `place`.
    /// @param u The address of the vertex record.
    function setVertex(uint256 u, uint256 place) internal pure {
        unchecked {
            if (load(u + VERTEX_META) == 0) {
                uint256 none = load(ZERO_SLOT) + NO_VERTEX;
                compute(u, none, none, 1);
                copy(u + VERTEX_NODE, none - NO_VERTEX + FRAGMENT_NODE);
            }
            copy(place, u + VERTEX_NODE);
        }
    }

    /// @notice Writes the node at the midpoint of an edge to `place`.
    /// @param u, v The addresses of the vertex records, in any order.
    function setEdge(uint256 u, uint256 v, uint256 place) internal pure {
        uint256 entry;
        uint256 key;
        bool isKnown;
        assembly ("memory-safe") {
            // sum and product determine both addresses
            key := mul(u, v)
            entry := add(mload(EDGE_NODES), mul(EDGE_SIZE, and(shr(EDGE_HASH_AT, mul(key, EDGE_HASH)), EDGE_HASH_MASK)))
            key := or(shl(128, add(u, v)), key)
            isKnown := eq(mload(entry), key)
        }
        unchecked {
            if (!isKnown) {
                uint256 none = load(ZERO_SLOT);
                compute(u, v, none + NO_VERTEX, 2);
                store(entry, key);
                copy(entry + 32, none + FRAGMENT_NODE);
            }
            copy(place, entry + 32);
        }
    }

    function copy(uint256 target, uint256 source) private pure {
        assembly ("memory-safe") {
            mcopy(target, source, NODE_SIZE)
        }
    }

    /// @notice Reserves the memory of the table.
    function open() internal pure {
        unchecked {
            store(EDGE_NODES, freeMemory());
            setFreeMemory(freeMemory() + EDGE_SIZE * (EDGE_HASH_MASK + 1));
        }
    }

    /// @notice Computes the node at the mean of the positions of vertices on the screen, at FRAGMENT_NODE.
    /// @param u, v, w The addresses of the records of one, two or three vertices, `count`, and NO_VERTEX.
    function compute(uint256 u, uint256 v, uint256 w, uint256 count) private pure {
        uint256 x;
        uint256 y;
        uint256 depth;
        uint256 turn;
        assembly ("memory-safe") {
            // from here on w: the normal, Q36
            switch count
            case 1 {
                y := mload(u)
                depth := shl(DEPTH_FRACTION, shr(ATTRIBUTE_DEPTH_AT, mload(add(u, VERTEX_ATTRIBUTES))))
                w := shl(Q20_TO_Q36, mload(add(u, VERTEX_NORMAL)))
            }
            default {
                y := add(add(mload(u), mload(v)), mload(w))
                // perspective-correct weights, Q16: depths divided by their sum
                let k := shr(ATTRIBUTE_DEPTH_AT, mload(add(u, VERTEX_ATTRIBUTES)))
                let l := shr(ATTRIBUTE_DEPTH_AT, mload(add(v, VERTEX_ATTRIBUTES)))
                let m := shr(ATTRIBUTE_DEPTH_AT, mload(add(w, VERTEX_ATTRIBUTES)))
                depth := add(add(k, l), m)
                let inverse := div(ONE_80, depth)
                depth := div(shl(DEPTH_FRACTION, depth), count)
                u := mload(add(u, VERTEX_NORMAL)) // u, v, w: the normals
                v := mload(add(v, VERTEX_NORMAL))
                w := mul(shr(Q80_TO_Q16, mul(m, inverse)), mload(add(w, VERTEX_NORMAL)))
                w := add(w, add(mul(shr(Q80_TO_Q16, mul(k, inverse)), u), mul(shr(Q80_TO_Q16, mul(l, inverse)), v)))
                u := add(sub(u, v), NORMAL_20_BIAS) // the change of the normal
                v := sub(and(u, NORMAL_20_MASK), NORMAL_20_HALF) // each coordinate, Q20
                turn := mul(v, v)
                v := sub(and(shr(NORMAL_Y_20_AT, u), NORMAL_20_MASK), NORMAL_20_HALF)
                turn := add(turn, mul(v, v))
                v := sub(shr(NORMAL_Z_20_AT, u), NORMAL_20_HALF)
                turn := shr(Q20, add(turn, mul(v, v)))
            }
            // the ray; y is a sum of screen words until here
            count := shl(SUBPIXEL_BITS, count)
            x := add(mload(RAY_LEFT), sdiv(mul(and(shr(SCREEN_COLUMN_AT, y), LANE_32), mload(RAY_STEP)), count))
            y := add(mload(RAY_TOP), sdiv(mul(shr(SCREEN_ROW_AT, y), mload(RAY_STEP)), count))
            if mload(FRAME_IS_ORTHOGRAPHIC) {
                x := 0
                y := 0
            }
            mstore(add(FRAGMENT_NODE, NODE_META), or(IS_NODE, shl(NODE_TURN_AT, turn)))
            // the normal, N.N and N.r: as in FragmentLight
            w := add(w, NORMAL_BIAS)
            v := sub(and(shr(NORMAL_X_AT, w), NORMAL_MASK), NORMAL_HALF) // each of its coordinates, Q24
            mstore(FRAGMENT_NORMAL_X, v)
            turn := mul(v, v) // turn: N.N, Q48
            count := mul(v, x) // count: N.r, Q48
            v := sub(and(shr(NORMAL_Y_AT, w), NORMAL_MASK), NORMAL_HALF)
            mstore(FRAGMENT_NORMAL_Y, v)
            turn := add(turn, mul(v, v))
            count := add(count, mul(v, y))
            v := sub(shr(NORMAL_Z_AT, w), NORMAL_HALF)
            mstore(FRAGMENT_NORMAL_Z, v)
            turn := add(turn, mul(v, v))
            mstore(FRAGMENT_NORMAL_RAY, add(count, shl(Q24, v)))
            mstore(FRAGMENT_SQUARE, turn)
            // its root: (1 + x) / 2 near one, and steps of Newton's method; 2^-16 of it for N.N above 1/4
            v := shr(HALF_OF_Q48_TO_Q24, add(ONE_48, turn))
            v := shr(1, add(v, div(turn, v)))
            v := shr(1, add(v, div(turn, v)))
            if lt(turn, HALF_48) {
                for { let steps := ROOT_STEPS } steps { steps := sub(steps, 1) } { v := shr(1, add(v, div(turn, v))) }
            }
            mstore(FRAGMENT_NORMAL_LENGTH, v)
            // |r|, as in FragmentLight.rayLength
            turn := add(add(mul(x, x), mul(y, y)), ONE_48)
            w := add(mload(LENGTH_AT_0), shr(Q48, mul(turn, mload(LENGTH_SLOPE))))
            w := shr(1, add(w, div(turn, w)))
            for { let steps := mload(LENGTH_STEPS) } steps { steps := sub(steps, 1) } { w := shr(1, add(w, div(turn, w))) }
        }
        light(x, y, depth, w);
    }

    /// @dev Computes the light of the lamps: see FragmentLight.
    /// @param x, y The ray, and `length` its length.
    function light(uint256 x, uint256 y, uint256 depth, uint256 length) private pure {
        unchecked {
            uint256 place = FRAGMENT_NODE;
            for (uint256 record = LIGHTS; record != load(LIGHTS_END); record += LIGHT_SIZE) {
                uint256 lx;
                uint256 ly;
                uint256 lz;
                uint256 distance = ONE_24;
                uint256 isPoint;
                assembly ("memory-safe") {
                    lx := mload(add(record, LIGHT_X))
                    ly := mload(add(record, LIGHT_Y))
                    lz := mload(add(record, LIGHT_Z))
                    isPoint := mload(record)
                    if isPoint {
                        // from the node to the light, Q16
                        distance := div(shl(DEPTH_FRACTION, mload(DEPTH_SCALE)), depth) // from the eye along its axis, Q32
                        lx := sub(lx, sar(Q40, mul(x, distance))) // Q24 * Q32 to Q16
                        ly := sub(ly, sar(Q40, mul(y, distance)))
                        lz := sub(lz, shr(Q16, distance))
                        let eye := shr(Q40, mul(distance, length)) // from the eye, Q16
                        distance := add(add(mul(lx, lx), mul(ly, ly)), mul(lz, lz)) // |L|^2, Q32
                        if gt(shl(2, mul(eye, eye)), mul(5, distance)) { // much nearer than the eye
                            mstore(add(FRAGMENT_NODE, NODE_META), or(mload(add(FRAGMENT_NODE, NODE_META)), NODE_TURNS_FAST))
                        }
                    }
                }
                if (isPoint != 0) distance = sqrtNear(distance, record + LIGHT_HINT);
                assembly ("memory-safe") {
                    let t := add(mul(mload(FRAGMENT_NORMAL_X), lx), mul(mload(FRAGMENT_NORMAL_Y), ly))
                    t := add(t, mul(mload(FRAGMENT_NORMAL_Z), lz)) // N.L times lengths
                    let lambert := sdiv(shl(Q24, t), mul(distance, mload(FRAGMENT_NORMAL_LENGTH))) // of unit vectors, Q24
                    t := sub(mul(t, length), mul(distance, mload(FRAGMENT_NORMAL_RAY))) // N.L |r| - N.r d
                    t := mul(t, sgt(t, 0))
                    lx := add(add(mul(lx, x), mul(ly, y)), shl(Q24, lz)) // lx from here on: L.r
                    ly := mul(distance, length) // ly: d |r|
                    lx := mul(shl(1, ly), sub(ly, lx)) // 2 d |r| (d |r| - L.r): the square of d |r| |L + V| for unit vectors
                    t := div(shl(Q24, mul(t, t)), mul(mload(FRAGMENT_SQUARE), lx)) // (N.H)^2, Q24
                    mstore(place, add(shl(MIDDLE_85_AT, lambert), t))
                    if and(sgt(lambert, 0), lt(mload(SPECULAR_BEGIN), t)) {
                        ly := mul(ly, ly)
                        t := add(NODE_SHINES, add(mul(NODE_TURNS, lt(lx, mul(3, ly))), mul(NODE_TURNS_FAST, lt(lx, ly))))
                        mstore(add(FRAGMENT_NODE, NODE_META), or(mload(add(FRAGMENT_NODE, NODE_META)), t))
                    }
                }
                place += 32;
            }
        }
    }

    /// @notice Computes the node in the middle of a triangle, at FRAGMENT_NODE.
    function setMiddle(uint256 u, uint256 v, uint256 w) internal pure {
        compute(u, v, w, 3);
    }
}
