// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BOTTOM_AT, LAST_EDGE, ROW_MASK, TOP_AT, X_AT, Y_AT} from "./Receivers.sol";
import "../words/EffectRegisters.sol";

// The samples of a row that are in shadow: a word of four lanes for each pixel; the highest bit of each lane is set if more shadows begin
// than end to the left of the sample: see Receivers. Each edge changes the words of the pixels it crosses; the prefix sums of the words
// from the left are the result.
//
// The light that casts shadows is switched off while what is in shadow is drawn.

/// @dev The size of an entry in bytes, and its position in a word; the entry of a dark face.
uint256 constant SHADOW_ENTRY_SIZE = 4;
uint256 constant SHADOW_ENTRY_AT = 224;
uint256 constant SHADOW_DARK = 1;
/// @dev The distance of a function's value from the top of a word, and its position there.
uint256 constant CONSTANT_TO_TOP = 96;
uint256 constant LANE_AT_TOP = 192;

library ShadowRows {
    function loadCalldata(uint256 place) private pure returns (uint256 value) {
        assembly ("memory-safe") {
            value := calldataload(place)
        }
    }

    /// @notice Finds the entries of the faces of an object, and its light from the shadow-casting lamp.
    /// @param object The number of the object in the scene.
    function setObject(uint256 object) internal pure {
        unchecked {
            uint256 shadows = load(SHADOWS);
            store(SHADOW_FACES, shadows + loadCalldata(shadows + 32 * object));
            uint256 light = load(SHADOW_LIGHT);
            store(SHADOW_COLOR, load(light + LIGHT_COLOR));
            store(SHADOW_DIFFUSE, load(light + LIGHT_DIFFUSE));
            store(IS_DARK, 0);
        }
    }

    /// @notice Finds the shadows on the face at FACE, and switches the light on or off if all of it is lit or in shadow.
    /// @return mode IS_PARTLY_DARK if parts of it are in shadow, otherwise 0.
    function setFace() internal pure returns (uint256 mode) {
        unchecked {
            uint256 entry = load(SHADOW_FACES) + SHADOW_ENTRY_SIZE * ((load(FACE) - load(MESH_FACES)) / FACE_SIZE);
            entry = loadCalldata(entry) >> SHADOW_ENTRY_AT;
            if (entry > SHADOW_DARK) {
                store(SHADOW_BEGIN, entry + load(SHADOWS));
                return IS_PARTLY_DARK;
            }
            setLight(entry);
        }
    }

    /// @notice Sets the words of a row of the triangle from `column` (inclusive) to `end` (exclusive). Rows must ascend.
    function prepare(uint256 column, uint256 end, uint256 row) internal pure {
        assembly ("memory-safe") {
            // Adds an edge that crosses rows of samples from q on, four for each row of pixels. `words` is the address of the word of the
            // canvas's first pixel, which may lie outside the buffer. Returns the address of the first changed word, or wordsEnd.
            function addEdge(word, q, words, column_, wordsEnd) -> first {
                // the lanes of the samples in its rows
                let crossed := TOPS_64
                let cut := and(shr(TOP_AT, word), ROW_MASK)
                if gt(cut, q) { crossed := shl(shl(6, sub(cut, q)), crossed) }
                cut := and(shr(BOTTOM_AT, word), ROW_MASK)
                if lt(cut, add(q, 4)) { crossed := and(crossed, shr(shl(6, sub(add(q, 4), cut)), TOPS_64)) }
                let x := sar(X_AT, word)
                let y := sar(X_AT, shl(sub(X_AT, Y_AT), word))
                let value := add(sar(LANE_AT_TOP, shl(CONSTANT_TO_TOP, word)), mul(y, shl(1, q)))
                let lanes := add(add(mul(value, ONES_64), TOPS_64), add(mul(x, SAMPLE_X_8), mul(y, SAMPLE_Y_8)))
                cut := sar(255, y)
                // more than the change from the centre to a sample
                value := add(value, mul(3, add(x, sub(xor(y, cut), cut))))
                x := shl(3, x)
                value := sdiv(sub(0, value), x)
                if sgt(value, column_) { column_ := value }
                x := mul(x, ONES_64)
                lanes := add(lanes, mul(x, column_))
                first := add(words, shl(5, column_))
                let before := 0
                for { let p := first } lt(p, wordsEnd) { p := add(p, 0x20) } {
                    let right := and(lanes, crossed)
                    let change := shr(63, xor(right, before))
                    if and(word, 1) { change := sub(0, change) }
                    mstore(p, add(mload(p), change))
                    if eq(right, crossed) { break }
                    before := right
                    lanes := add(lanes, x)
                }
            }

            let words := sub(mload(SHADOW_ROW), shl(5, mload(COLUMN_BEGIN)))
            end := add(words, shl(5, end))
            let first := add(words, shl(5, column))
            calldatacopy(first, calldatasize(), sub(end, first))
            words := add(words, shl(5, PIXEL_BIAS))
            column := sub(column, PIXEL_BIAS)
            row := shl(2, sub(row, PIXEL_BIAS))
            first := end
            let isLeading := 1
            let edge := mload(SHADOW_BEGIN)
            for {} 1 {} {
                let word := calldataload(edge)
                if gt(and(shr(TOP_AT, word), ROW_MASK), add(row, 3)) { break }
                if gt(and(shr(BOTTOM_AT, word), ROW_MASK), row) {
                    isLeading := 0
                    let changed := addEdge(word, row, words, column, end)
                    if lt(changed, first) { first := changed }
                }
                if and(word, LAST_EDGE) { break }
                edge := add(edge, 0x20)
                // edges above are skipped from now on
                if isLeading { mstore(SHADOW_BEGIN, edge) }
            }
            let sum := sub(TOPS_64, ONES_64)
            for {} lt(first, end) { first := add(first, 0x20) } {
                sum := add(sum, mload(first))
                mstore(first, sum)
            }
        }
    }

    /// @notice Returns which of the samples of a pixel are in shadow: the highest bits of their lanes.
    function darkOf(uint256 samples, uint256 column) internal pure returns (uint256) {
        unchecked {
            return samples & load(load(SHADOW_ROW) + 32 * (column - load(COLUMN_BEGIN)));
        }
    }

    /// @notice Switches the light on, or off if `dark` is not zero.
    function setLight(uint256 dark) internal pure {
        unchecked {
            if (dark != 0) dark = UNIFORM_DARK - UNIFORM_LIT;
            if (dark == load(IS_DARK)) return;
            store(IS_DARK, dark);
            uint256 light = load(SHADOW_LIGHT);
            store(light + LIGHT_COLOR, dark == 0 ? load(SHADOW_COLOR) : 0);
            store(light + LIGHT_DIFFUSE, dark == 0 ? load(SHADOW_DIFFUSE) : 0);
        }
    }
}
