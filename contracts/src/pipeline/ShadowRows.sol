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

    /// @notice Finds the entries of the faces of an object, and what the light is to it where it shines.
    /// @param object Its number in the scene.
    function setObject(uint256 object) internal pure {
        unchecked {
            uint256 shadows = load(SHADOWS);
            store(SHADOW_FACES, shadows + loadCalldata(shadows + 32 * object));
            uint256 light = load(SHADOW_LIGHT);
            store(SHADOW_COLOR, load(light + LIGHT_COLOR));
            store(SHADOW_DIFFUSE, load(light + LIGHT_DIFFUSE));
            store(SHADOW_SHARE, ALL_SAMPLES);
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
        unchecked {
            uint256 pixel = load(SHADOW_ROW) + 32 * (column - load(COLUMN_BEGIN));
            uint256 shadow = load(SHADOW_BEGIN);
            assembly ("memory-safe") {
                calldatacopy(pixel, calldatasize(), shl(5, sub(end, column)))
            }
            (column, end, row) = (column - PIXEL_BIAS, end - PIXEL_BIAS, row - PIXEL_BIAS);
            bool isLeading = true;
            while (true) {
                uint256 word = loadCalldata(shadow);
                if ((word >> TOP_AT) & ROW_MASK > row) return;
                uint256 next = shadow + 32 * (word & SHADOW_COUNT_MASK);
                if ((word >> BOTTOM_AT) & ROW_MASK > row) {
                    isLeading = false;
                    uint256 first;
                    uint256 last;
                    assembly ("memory-safe") {
                        first := and(shr(LEFT_AT, word), ROW_MASK)
                        last := and(shr(RIGHT_AT, word), ROW_MASK)
                        if lt(first, column) { first := column }
                        if gt(last, end) { last := end }
                    }
                    uint256 inner;
                    uint256 innerEnd;
                    if (first < last) (first, last, inner, innerEnd) = setFunctions(shadow, next, row, first, last);
                    if (first < last) fill(pixel + 32 * (first - column), first, last, inner, innerEnd, next - shadow);
                }
                if (word & LAST_SHADOW != 0) return;
                shadow = next;
                // those above are passed over from now on
                if (isLeading) store(SHADOW_BEGIN, shadow);
            }
        }
    }

    /// @dev Writes the functions in a row: each at the samples of the first pixel of the canvas, and its change from pixel to pixel.
    /// @return first The first pixel that may have samples in the shadow.
    /// @return last The one after the last.
    /// @return inner The first pixel of which all samples are in the shadow.
    /// @return innerEnd The one after the last.
    function setFunctions(uint256 shadow, uint256 shadowEnd, uint256 row, uint256 column, uint256 end)
        private
        pure
        returns (uint256 first, uint256 last, uint256 inner, uint256 innerEnd)
    {
        assembly ("memory-safe") {
            // the least whole number that is not below n / d, and not below low
            function from(n, d, low) -> result {
                result := low
                if sgt(n, 0) {
                    result := div(add(n, sub(d, 1)), d)
                    if lt(result, low) { result := low }
                }
            }
            // 1 more than the greatest whole number that is not above n / d, and not above high
            function to(n, d, high) -> result {
                if sgt(n, not(0)) {
                    result := add(div(n, d), 1)
                    if gt(result, high) { result := high }
                }
            }

            first := column
            last := end
            inner := column
            innerEnd := end
            let target := SHADOW_FUNCTIONS
            for {} lt(shadow, shadowEnd) { shadow := add(shadow, 32) } {
                let word := calldataload(shadow)
                let x := sar(X_AT, word)
                let y := sar(X_AT, shl(sub(X_AT, Y_AT), word))
                let value := add(sar(LANE_AT_TOP, shl(CONSTANT_TO_TOP, word)), mul(y, shl(3, row)))
                mstore(
                    target,
                    add(add(mul(value, ONES_64), TOPS_64), add(mul(x, SAMPLE_X_8), mul(y, SAMPLE_Y_8)))
                )
                mstore(add(target, 0x20), mul(shl(3, x), ONES_64))
                target := add(target, 0x40)
                // ranges would cost more than the few pixels
                if lt(sub(end, column), SHORT_SPAN) {
                    innerEnd := 0
                    continue
                }
                // more than the change from the centre to a sample
                let sign := sar(255, y)
                let change := sub(xor(y, sign), sign)
                sign := sar(255, x)
                let step := sub(xor(x, sign), sign)
                change := mul(3, add(change, step))
                switch step
                case 0 {
                    if slt(add(value, change), 0) { last := 0 }
                    if slt(value, change) { innerEnd := 0 }
                }
                default {
                    step := shl(3, step)
                    switch sign
                    case 0 {
                        first := from(sub(0, add(value, change)), step, first)
                        inner := from(sub(change, value), step, inner)
                    }
                    default {
                        last := to(add(value, change), step, last)
                        innerEnd := to(sub(value, change), step, innerEnd)
                    }
                }
            }
        }
    }

    /// @dev Adds a shadow to the words of a row.
    /// @param pixel The address of the word of the first pixel.
    /// @param size Bytes of the functions in calldata.
    function fill(uint256 pixel, uint256 first, uint256 last, uint256 inner, uint256 innerEnd, uint256 size) private pure {
        assembly ("memory-safe") {
            size := add(SHADOW_FUNCTIONS, shl(1, size))
            for {} lt(first, last) { first := add(first, 1) } {
                switch or(and(lt(first, innerEnd), iszero(lt(first, inner))), eq(mload(pixel), TOPS_64))
                case 1 { mstore(pixel, TOPS_64) }
                default {
                    let lanes := TOPS_64
                    for { let p := SHADOW_FUNCTIONS } lt(p, size) { p := add(p, 0x40) } {
                        lanes := and(lanes, add(mload(p), mul(first, mload(add(p, 0x20)))))
                    }
                    mstore(pixel, or(mload(pixel), lanes))
                }
                pixel := add(pixel, 0x20)
            }
        }
    }

    /// @notice Weakens the light by what is in the shadow of a fragment.
    /// @param covered The highest bit of the lane of each sample of the fragment.
    function setShare(uint256 covered, uint256 column) internal pure {
        unchecked {
            uint256 list = load(SHADOW_LIST);
            uint256 dark;
            if (list == SHADOW_DARK) dark = covered;
            else if (list != 0) dark = load(load(SHADOW_ROW) + 32 * (column - load(COLUMN_BEGIN))) & covered;
            uint256 share = load(SHADOW_SHARE);
            if (dark == 0 && share == ALL_SAMPLES) return;
            uint256 total = count(covered);
            uint256 visible = total - count(dark);
            uint256 before = share;
            share = visible == total ? ALL_SAMPLES : visible == 0 ? 0 : (visible << 4) | total;
            if (share == before) return;
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
