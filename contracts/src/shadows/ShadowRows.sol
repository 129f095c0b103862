// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../words/EffectRegisters.sol";

// Computes `Shadow.on` of picture.py for the samples of a row.
// The samples of a row that are in shadow: a word of four lanes for each pixel; the highest bit of each lane is set if more shadows begin
// than end to the left of the sample: see Outlines. Each edge changes the words of the pixels it crosses; the prefix sums of the words
// from the left are the result.
//
// The light that casts shadows is switched off while what is in shadow is drawn.

/// @dev The size of an entry in bytes, and its position in a word; the entry of a dark face.
uint256 constant SHADOW_ENTRY_SIZE = 4;
uint256 constant SHADOW_ENTRY_AT = 224;
uint256 constant SHADOW_DARK = 1;
/// @dev The distance of a function's value, and of its change downward, from the top of a word; the position of such a value at the top.
uint256 constant VALUE_TO_TOP = 96;
uint256 constant DY_TO_TOP = 48;
uint256 constant VALUE_AT_TOP = 192;
/// @dev The samples of a row have lanes of 2^6 bits; the rows of samples of a pixel, 2^2; the distance of sample positions, 2^3.
uint256 constant LANE_SHIFT = 6;
uint256 constant SAMPLE_ROWS_SHIFT = 2;
uint256 constant EIGHTHS_SHIFT = 3;

library ShadowRows {
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
                let crossed := TOPS_64 // the lanes of the samples in its rows
                let cut := and(shr(SHADOW_EDGE_TOP_AT, word), SHADOW_EDGE_TOP_MASK) // the first row of samples that it crosses
                if gt(cut, q) { crossed := shl(shl(LANE_SHIFT, sub(cut, q)), crossed) } // not the cut - q uppermost rows
                cut := and(shr(SHADOW_EDGE_BOTTOM_AT, word), SHADOW_EDGE_BOTTOM_MASK) // the row after the last
                if lt(cut, add(q, 4)) { crossed := and(crossed, shr(shl(LANE_SHIFT, sub(add(q, 4), cut)), TOPS_64)) } // not those below
                let x := sar(SHADOW_EDGE_DX_AT, word) // the changes per eighth of a pixel
                let y := sar(SHADOW_EDGE_DX_AT, shl(DY_TO_TOP, word)) // downward, signed
                let value := add(sar(VALUE_AT_TOP, shl(VALUE_TO_TOP, word)), mul(y, shl(1, q))) // at the row's pixel centres: 8 y a row
                let lanes := add(add(mul(value, ONES_64), TOPS_64), add(mul(x, SAMPLE_X_8), mul(y, SAMPLE_Y_8))) // at samples
                cut := sar(SIGN_AT, y) // from here on, the sign of y
                // more than the change from the centre to a sample
                value := add(value, mul(3, add(x, sub(xor(y, cut), cut)))) // 3 (x + |y|): at the sample farthest to the right
                x := shl(EIGHTHS_SHIFT, x) // from here on, the change per pixel
                value := sdiv(sub(0, value), x) // from here on, a column left of which all samples are left of the edge
                if sgt(value, column_) { column_ := value } // at least column_
                x := mul(x, ONES_64) // in each lane
                lanes := add(lanes, mul(x, column_)) // the values at column_
                first := add(words, shl(WORD_SHIFT, column_)) // the word of column_
                let before := 0 // the samples to the right of the edge in the column before
                for { let p := first } lt(p, wordsEnd) { p := add(p, 0x20) } { // from there to the right
                    let right := and(lanes, crossed) // the highest bits: values of at least 0
                    let change := shr(TOP_64_AT, xor(right, before)) // 1 where a sample is the first to the right
                    if and(word, ENDS_SHADOW) { change := sub(0, change) } // one less, if a shadow ends
                    mstore(p, add(mload(p), change)) // in each lane
                    if eq(right, crossed) { break } // so are all after it
                    before := right // for the next column
                    lanes := add(lanes, x) // one pixel to the right
                }
            }

            let words := sub(mload(SHADOW_ROW), shl(WORD_SHIFT, mload(COLUMN_BEGIN))) // the address of column 0's word
            end := add(words, shl(WORD_SHIFT, end)) // from here on, an address
            let first := add(words, shl(WORD_SHIFT, column)) // the first word of the span
            calldatacopy(first, calldatasize(), sub(end, first)) // zeros
            words := add(words, shl(WORD_SHIFT, PIXEL_BIAS)) // from here on, columns and rows of the canvas
            column := sub(column, PIXEL_BIAS) // from here on, of the canvas
            row := shl(SAMPLE_ROWS_SHIFT, sub(row, PIXEL_BIAS)) // from here on, a row of samples
            first := end // from here on, the first changed word
            let isLeading := 1 // all edges so far are above the row
            let edge := mload(SHADOW_BEGIN) // the first edge that is not above the row
            for {} 1 {} {
                let word := calldataload(edge) // SHADOW_EDGE_
                if gt(and(shr(SHADOW_EDGE_TOP_AT, word), SHADOW_EDGE_TOP_MASK), add(row, 3)) { break } // below, as all after it
                if gt(and(shr(SHADOW_EDGE_BOTTOM_AT, word), SHADOW_EDGE_BOTTOM_MASK), row) { // not above the row
                    isLeading := 0 // later rows need it
                    let changed := addEdge(word, row, words, column, end)
                    if lt(changed, first) { first := changed } // the leftmost
                }
                if and(word, LAST_EDGE) { break } // the list is at its end
                edge := add(edge, 0x20)
                if isLeading { mstore(SHADOW_BEGIN, edge) } // skipped from now on
            }
            let sum := sub(TOPS_64, ONES_64) // 2^63 - 1 in each lane: 1 more sets the highest bit
            for {} lt(first, end) { first := add(first, 0x20) } {
                sum := add(sum, mload(first)) // of all changes to the left
                mstore(first, sum) // the highest bits: samples in shadow
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
