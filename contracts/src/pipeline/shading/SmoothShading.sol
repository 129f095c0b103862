// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Quadratic} from "./Quadratic.sol";
import {SmoothNodes} from "./SmoothNodes.sol";
import {Rasterizer} from "../geometry/Rasterizer.sol";
import {firstRowOf, max} from "../geometry/Screen.sol";
import {Shading} from "./Shading.sol";
import "../../words/Registers.sol";

// Selects the shading of triangles whose fragments are lit: smooth surfaces, and all that no other method draws.

/// @dev The results of `changeOf`: the middle must be checked; each fragment must be exact.
uint256 constant UNSURE = 1;
uint256 constant TOO_MUCH = 2;
/// @dev 0.36, Q92; 0.5, Q20; 9 times 1.75 levels of 255, Q24; 2 levels, Q56: see above. Just before the last entry of the table, Q40.
uint256 constant MOST_CURVE = 0x5c28f5c28f5c28000000000;
uint256 constant SAFE_TURN = 0x80000;
uint256 constant N_DOT_L_ERROR = 1036239;
uint256 constant SHINE_ERROR = 0x2020202020202;
uint256 constant BEFORE_SPECULAR_LAST = 0x3fffffffffff;
/// @dev The bytes of the table of the highlight; from its format to that of SHINE_TABLE.
uint256 constant SPECULAR_SIZE = 0x820;
uint256 constant Q16_TO_Q42 = 26;
/// @dev The shift that leaves the colours of an attribute word.
uint256 constant COLORS_TO_TOP = 88;
/// @dev Prevents colours (Q42) from being rounded below zero: 1/32 of a level.
uint256 constant SMOOTH_BIAS = 0x100000000000020000000000000200000000000002000000000;

abstract contract SmoothShading is Rasterizer {
    function shade(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure virtual override {
        unchecked {
            uint256 mode = load(OBJECT_MODE);
            if (mode & (IS_QUADRATIC | IS_BLENDED) != IS_QUADRATIC) return shadeExact(a, b, c, crossing);
            (uint256 u, uint256 v, uint256 w) = (a & SCREEN_RECORD_MASK, b & SCREEN_RECORD_MASK, c & SCREEN_RECORD_MASK);
            uint256 nodes = load(ZERO_SLOT) + NODES; // not a literal: see ZERO_SLOT
            SmoothNodes.setVertex(u, nodes);
            SmoothNodes.setVertex(v, nodes + NODE_TO_B);
            SmoothNodes.setVertex(w, nodes + NODE_TO_C);
            SmoothNodes.setEdge(u, v, nodes + NODE_TO_AB);
            SmoothNodes.setEdge(u, w, nodes + NODE_TO_AC);
            SmoothNodes.setEdge(v, w, nodes + NODE_TO_BC);
            uint256 kind = changeOf(Shading.squareSize(a, b, c));
            if (kind != 0 && (kind == TOO_MUCH || isWrong(u, v, w))) return shadeExact(a, b, c, crossing);
            (uint256 p, uint256 q, uint256 r) = Shading.attributesOf(a, b, c);
            if (((p ^ q) | (p ^ r)) << COLORS_TO_TOP != 0) {
                if (!Shading.isAffine(p, q, r, a, b, c)) return shadeExact(a, b, c, crossing);
                mode |= IS_VARIED;
            } else if ((p << COLORS_TO_TOP) + 1 != load(SAME_COLOR)) {
                setSame(p);
            }
            if (load(LIGHTS_END) != LIGHTS + LIGHT_SIZE) {
                mode |= IS_TWICE_LIT;
                Quadratic.fromNodes(nodes + NODE_SECOND);
                Quadratic.copy(SECOND_1, QUADRATIC_1);
            }
            Quadratic.fromNodes(nodes);
            store(MODE, mode | crossing);
            setDifferences(a, b, c);
            store(ATTRIBUTE_0, (p << ACCUMULATOR_FRACTION) + SMOOTH_BIAS);
            store(DELTA_1, q - p);
            store(DELTA_2, r - p);
        }
    }

    /// @dev Prepares the registers that differ between objects.
    function openSmooth() internal pure {
        unchecked {
            store(SAME_COLOR, 0);
            uint256 mode = load(OBJECT_MODE);
            if (mode & IS_QUADRATIC == 0 || load(SPECULAR_BEGIN) == NO_HIGHLIGHT) return;
            uint256 color = load(LIGHTS + LIGHT_COLOR);
            assembly ("memory-safe") {
                // lanes of 85 bits
                color := add(and(color, LANE_24), add(shl(MIDDLE_56_TO_85, and(color, MIDDLE_LANE_24)), shl(UPPER_56_TO_85, and(color, UPPER_LANE_24))))
                for { let i := 0 } lt(i, SPECULAR_SIZE) { i := add(i, 32) } {
                    mstore(add(SHINE_TABLE, i), shl(Q16_TO_Q42, mul(color, shr(SPECULAR_VALUE_AT, mload(add(SPECULAR_TABLE, i))))))
                }
                mstore(add(SHINE_TABLE, SPECULAR_SIZE), mload(sub(add(SHINE_TABLE, SPECULAR_SIZE), 32)))
            }
        }
    }

    /// @dev Sets the registers of a colour that all vertices have.
    /// @param word An attribute word.
    function setSame(uint256 word) private pure {
        unchecked {
            store(SAME_COLOR, (word << COLORS_TO_TOP) + 1);
            store(SAME_AMBIENT, (product(word, load(AMBIENT)) << Q26_TO_Q58) + HALF_85);
            store(SAME_DIFFUSE, product(word, load(LIGHTS + LIGHT_DIFFUSE)) << Q26_TO_Q34);
            store(SAME_DIFFUSE_2, product(word, load(LIGHTS + LIGHT_SIZE + LIGHT_DIFFUSE)) << Q26_TO_Q34);
        }
    }

    /// @dev Returns a colour, Q10, times light, Q16, both in lanes of 56 bits, in lanes of 85 bits, Q26.
    function product(uint256 color, uint256 light) private pure returns (uint256 lanes) {
        assembly ("memory-safe") {
            lanes := mul(and(color, LANE_24), and(light, LANE_32))
            lanes := add(lanes, shl(MIDDLE_85_AT, mul(and(shr(MIDDLE_AT, color), LANE_24), and(shr(MIDDLE_AT, light), LANE_32))))
            lanes := add(lanes, shl(UPPER_85_AT, mul(and(shr(UPPER_AT, color), LANE_24), shr(UPPER_AT, light))))
        }
    }

    /// @dev Returns how exactly quadratic functions describe the light within a triangle: 0, UNSURE or TOO_MUCH.
    /// @param size The sum of the squares of two edges, in sub-pixels.
    function changeOf(uint256 size) private pure returns (uint256 kind) {
        assembly ("memory-safe") {
            let turn := mload(add(NODE_AB, NODE_META))
            let ac := mload(add(NODE_AC, NODE_META))
            let bc := mload(add(NODE_BC, NODE_META))
            let all := or(or(or(turn, ac), or(bc, mload(add(NODES, NODE_META)))), or(mload(add(NODE_B, NODE_META)), mload(add(NODE_C, NODE_META))))
            if gt(ac, turn) { turn := ac }
            if gt(bc, turn) { turn := bc }
            turn := shr(NODE_TURN_AT, turn) // the largest square of the turn of a normal
            let half := shr(Q32, mul(size, mload(HALF_TURN))) // that of H, if |L + V| is 2
            half := add(half, mul(half, add(1, and(shr(2, all), 2)))) // 4/3 or 4 as much
            turn := add(shr(2, mul(5, turn)), mul(5, half)) // (x + y)^2 <= 5/4 x^2 + 5 y^2
            kind := gt(turn, SAFE_TURN)
            if and(all, NODE_SHINES) { kind := or(kind, gt(mul(mul(turn, mul(turn, turn)), mload(CURVE)), MOST_CURVE)) }
            if or(gt(turn, WIDEST_TURN), and(all, NODE_TURNS_FAST)) { kind := TOO_MUCH }
        }
    }

    /// @dev Returns whether a function differs in the middle of a triangle by more than 1.75 levels from the exact light.
    /// @param u, v, w The vertex records.
    function isWrong(uint256 u, uint256 v, uint256 w) private pure returns (bool yes) {
        SmoothNodes.setMiddle(u, v, w);
        assembly ("memory-safe") {
            u := NODES
            for { let record := LIGHTS } lt(record, mload(LIGHTS_END)) { record := add(record, LIGHT_SIZE) } {
                // nine times a value in the middle: 4 (ab + ac + bc) - (a + b + c)
                v := shl(2, add(add(mload(add(u, NODE_TO_AB)), mload(add(u, NODE_TO_AC))), mload(add(u, NODE_TO_BC))))
                v := sub(v, add(add(mload(u), mload(add(u, NODE_TO_B))), mload(add(u, NODE_TO_C))))
                let exact := mload(add(sub(u, NODES), FRAGMENT_NODE))
                u := add(u, 32)
                w := sub(sar(MIDDLE_85_AT, v), mul(9, sar(MIDDLE_85_AT, exact))) // nine times the error of N.L
                yes := or(yes, gt(add(w, N_DOT_L_ERROR), mul(2, N_DOT_L_ERROR)))
                exact := and(exact, LANE_85)
                w := sdiv(sar(LOWER_85_TO_TOP, shl(LOWER_85_TO_TOP, v)), 9) // the square of a cosine
                v := sub(exact, w)
                v := xor(v, sar(SIGN_AT, v)) // its error
                if slt(exact, w) { exact := w } // max
                if lt(mload(SPECULAR_BEGIN), exact) {
                    exact := mul(sub(exact, mload(SPECULAR_BEGIN)), mload(SPECULAR_SCALE)) // an index into the table, Q40
                    if gt(exact, BEFORE_SPECULAR_LAST) { exact := BEFORE_SPECULAR_LAST }
                    w := and(mload(add(SPECULAR_TABLE, and(shr(SPECULAR_ENTRY_SHIFT, exact), SPECULAR_ENTRY_MASK))), LANE_32) // the increase
                    yes := or(yes, gt(mul(mul(v, mload(SPECULAR_SCALE)), w), SHINE_ERROR))
                }
            }
        }
    }

    /// @notice Calls Quadratic.setDifferences, and adds half a level, if that is not done when the triangle is drawn.
    function setDifferences(uint256 a, uint256 b, uint256 c) internal pure virtual {}

    /// @notice Selects the shading of every fragment individually.
    function shadeExact(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure virtual {
        (uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode) = surface(a, b, c);
        Shading.setExact(a, b, c, attributesA, attributesB, attributesC, mode | crossing);
    }

    /// @dev Returns the attribute words of a triangle and its mode, and sets its normal or normals.
    function surface(uint256 a, uint256 b, uint256 c)
        internal
        pure
        returns (uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode)
    {
        (attributesA, attributesB, attributesC) = Shading.attributesOf(a, b, c);
        mode = load(OBJECT_MODE) & ~IS_QUADRATIC;
        if (mode & IS_SMOOTH != 0) Shading.setNormals(a, b, c);
        else if (mode & IS_FLAT != 0) {
            (mode, attributesA, attributesB, attributesC) = Shading.setFace(attributesA, attributesB, attributesC);
        }
    }
}
