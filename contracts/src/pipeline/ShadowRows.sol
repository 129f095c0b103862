// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {BOTTOM_AT, CONSTANT_AT, LAST_SHADOW, LEFT_AT, RIGHT_AT, ROW_MASK, TOP_AT, X_AT, Y_AT} from "../shadows/Receivers.sol";
import "./Registers.sol";

// The samples of a row that are in the shadow: a word of four lanes for each pixel, of which the highest bit of each is set where all
// functions of a shadow, see Receivers, are at least 0. In most of the pixels of a shadow all samples are in it: only at its edges the
// functions are taken at the samples.
//
// The light that casts shadows is weakened by the share of the samples of a fragment that it reaches.

/// @dev The share of a fragment of which the light reaches all samples.
uint256 constant ALL_SAMPLES = 1 << 8;
uint256 constant SHADOW_COUNT_MASK = 0xff;
/// @dev Bytes of an entry, and where it is in a word; that of a dark face.
uint256 constant SHADOW_ENTRY_SIZE = 4;
uint256 constant SHADOW_ENTRY_AT = 224;
uint256 constant SHADOW_DARK = 1;
/// @dev In rows of fewer pixels the functions are taken at all samples.
uint256 constant SHORT_SPAN = 8;
/// @dev How far the value of a function is below the top of a word, and where it is there.
uint256 constant CONSTANT_TO_TOP = 96;
uint256 constant LANE_AT_TOP = 192;

library ShadowRows {
    function loadCalldata(uint256 place) private pure returns (uint256 value) {
        assembly ("memory-safe") {
            value := calldataload(place)
        }
    }

    /// @notice Finds the entries of the faces of an object.
    /// @param object Its number in the scene.
    function setObject(uint256 object) internal pure {
        unchecked {
            uint256 shadows = load(SHADOWS);
            if (shadows != 0) store(SHADOW_FACES, shadows + loadCalldata(shadows + 32 * object));
        }
    }

    /// @notice Finds what shades the face at FACE.
    function setFace() internal pure {
        unchecked {
            uint256 entry = load(SHADOW_FACES) + SHADOW_ENTRY_SIZE * ((load(FACE) - load(MESH_FACES)) / FACE_SIZE);
            entry = loadCalldata(entry) >> SHADOW_ENTRY_AT;
            if (entry > SHADOW_DARK) entry += load(SHADOWS);
            store(SHADOW_LIST, entry);
            store(SHADOW_BEGIN, entry);
        }
    }

    /// @notice Sets the words of a row of the triangle from `column` to before `end`. Rows must ascend.
    function prepare(uint256 column, uint256 end, uint256 row) internal pure {
        assembly ("memory-safe") {
            // Reads the functions in a row: each at the samples of the first pixel of the canvas, and its change from pixel to pixel.
            // From `first` to before `last` pixels may have samples in the shadow, from `inner` to before `innerEnd` all are.
            function setFunctions(shadow, shadowEnd, y8, column_, end_) -> first, last, inner, innerEnd {
                first := column_
                last := end_
                inner := column_
                // ranges would cost more than the few pixels
                if iszero(lt(sub(end_, column_), SHORT_SPAN)) { innerEnd := end_ }
                let target := SHADOW_FUNCTIONS
                for {} lt(shadow, shadowEnd) { shadow := add(shadow, 32) } {
                    let word := calldataload(shadow)
                    let x := sar(X_AT, word)
                    let y := sar(X_AT, shl(sub(X_AT, Y_AT), word))
                    word := add(sar(LANE_AT_TOP, shl(CONSTANT_TO_TOP, word)), mul(y, y8))
                    mstore(target, add(add(mul(word, ONES_64), TOPS_64), add(mul(x, SAMPLE_X_8), mul(y, SAMPLE_Y_8))))
                    mstore(add(target, 0x20), mul(shl(3, x), ONES_64))
                    target := add(target, 0x40)
                    if innerEnd {
                        // more than the change from the centre to a sample
                        let sign := sar(255, y)
                        let change := sub(xor(y, sign), sign)
                        sign := sar(255, x)
                        let step := sub(xor(x, sign), sign)
                        change := mul(3, add(change, step))
                        step := shl(3, step)
                        switch sign
                        case 0 {
                            // the least whole number that is not below -(word + change) / step; where that is 0, it is 0
                            let bound := sub(step, 1)
                            let t := sdiv(sub(bound, add(word, change)), step)
                            if sgt(t, first) { first := t }
                            t := sdiv(add(bound, sub(change, word)), step)
                            if sgt(t, inner) { inner := t }
                            if lt(step, slt(word, change)) { inner := end_ }
                        }
                        default {
                            let t := sdiv(add(step, add(word, change)), step)
                            if slt(t, last) { last := t }
                            t := sdiv(add(step, sub(word, change)), step)
                            if slt(t, innerEnd) { innerEnd := mul(t, sgt(t, 0)) }
                        }
                    }
                }
                for {} lt(target, SHADOW_FUNCTIONS_END) { target := add(target, 0x40) } {
                    mstore(target, TOPS_64)
                    mstore(add(target, 0x20), 0)
                }
            }
            // Adds a shadow to words of which not all samples need be in it.
            function mix(pixel, column_, end_) {
                for {} slt(column_, end_) { column_ := add(column_, 1) } {
                    let lanes := add(mload(SHADOW_FUNCTIONS), mul(column_, mload(SHADOW_STEP_0)))
                    lanes := and(lanes, add(mload(SHADOW_FUNCTION_1), mul(column_, mload(SHADOW_STEP_1))))
                    lanes := and(lanes, add(mload(SHADOW_FUNCTION_2), mul(column_, mload(SHADOW_STEP_2))))
                    lanes := and(lanes, add(mload(SHADOW_FUNCTION_3), mul(column_, mload(SHADOW_STEP_3))))
                    mstore(pixel, or(mload(pixel), lanes))
                    pixel := add(pixel, 0x20)
                }
            }

            let words := sub(mload(SHADOW_ROW), shl(5, mload(COLUMN_BEGIN)))
            calldatacopy(add(words, shl(5, column)), calldatasize(), shl(5, sub(end, column)))
            words := add(words, shl(5, PIXEL_BIAS))
            column := sub(column, PIXEL_BIAS)
            end := sub(end, PIXEL_BIAS)
            row := sub(row, PIXEL_BIAS)
            let isLeading := 1
            let shadow := mload(SHADOW_BEGIN)
            for {} 1 {} {
                let word := calldataload(shadow)
                if gt(and(shr(TOP_AT, word), ROW_MASK), row) { break }
                let next := add(shadow, shl(5, and(word, SHADOW_COUNT_MASK)))
                if gt(and(shr(BOTTOM_AT, word), ROW_MASK), row) {
                    isLeading := 0
                    let first := and(shr(LEFT_AT, word), ROW_MASK)
                    let last := and(shr(RIGHT_AT, word), ROW_MASK)
                    if lt(first, column) { first := column }
                    if gt(last, end) { last := end }
                    if lt(first, last) {
                        let inner, innerEnd
                        first, last, inner, innerEnd := setFunctions(shadow, next, shl(3, row), first, last)
                        if iszero(lt(inner, innerEnd)) { inner := last }
                        mix(add(words, shl(5, first)), first, inner)
                        for {} lt(inner, innerEnd) { inner := add(inner, 1) } { mstore(add(words, shl(5, inner)), TOPS_64) }
                        mix(add(words, shl(5, inner)), inner, last)
                    }
                }
                if and(word, LAST_SHADOW) { break }
                shadow := next
                // those above are passed over from now on
                if isLeading { mstore(SHADOW_BEGIN, shadow) }
            }
        }
    }

    /// @notice Weakens the light by what is in the shadow of a fragment.
    /// @param covered The highest bit of the lane of each sample of the fragment.
    function setShare(uint256 covered, uint256 column) internal pure {
        unchecked {
            uint256 dark;
            bool isKnown;
            assembly ("memory-safe") {
                let list := mload(SHADOW_LIST)
                if list {
                    dark := covered
                    if gt(list, SHADOW_DARK) { dark := and(dark, mload(add(mload(SHADOW_ROW), shl(5, sub(column, mload(COLUMN_BEGIN)))))) }
                }
                isKnown := iszero(or(dark, sub(mload(SHADOW_SHARE), ALL_SAMPLES)))
            }
            if (isKnown) return;
            uint256 total = count(covered);
            uint256 visible = total - count(dark);
            uint256 share = visible == total ? ALL_SAMPLES : visible == 0 ? 0 : (visible << 4) | total;
            if (share == load(SHADOW_SHARE)) return;
            store(SHADOW_SHARE, share);
            uint256 light = load(SHADOW_LIGHT);
            store(light + LIGHT_COLOR, part(load(SHADOW_COLOR), visible, total));
            store(light + LIGHT_DIFFUSE, part(load(SHADOW_DIFFUSE), visible, total));
        }
    }

    /// @dev How many of the highest bits of four lanes are set.
    function count(uint256 lanes) private pure returns (uint256) {
        unchecked {
            return ((lanes >> 63) * ONES_64) >> 192;
        }
    }

    /// @dev So many parts of the lanes of a colour.
    function part(uint256 color, uint256 visible, uint256 total) private pure returns (uint256 weaker) {
        unchecked {
            for (uint256 i; i != 3 * MIDDLE_AT; i += MIDDLE_AT) weaker |= (((color >> i) & LANE_32) * visible / total) << i;
        }
    }
}
