// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Clipping, POINT_BIAS, ROW_BIAS, ROW_SHIFT, ROW_UP} from "./Clipping.sol";
import {FACE_SIDE} from "./Faces.sol";
import {Receiver} from "./Receivers.sol";
import "../words/Registers.sol";

// Computes `Shadow.on` of picture.py as edges on the screen.
// Computes the edges of all shadows on a face: SHADOW_EDGE_ in Words.sol. A sample is in shadow if more of them begin than end to the left
// of it. Where two shadows meet, one ends and the other begins: both edges cancel, so that for most objects little more than the outline is
// left. Lists are sorted by the first row of pixels.

/// @dev The bits of the change of an edge's function per eighth of a pixel.
uint256 constant EDGE_BITS = 40;
/// @dev From eighths of a pixel to the unit of positions.
uint256 constant EIGHTH = 17;
/// @dev An edge during collection: its ends, the upper one first; the number of shadows that begin at it minus those that end; the next
/// edge of the same chain; the previous edge.
uint256 constant EDGE_SIZE = 0x80;
uint256 constant EDGE_COUNT = 0x20;
uint256 constant EDGE_NEXT = 0x40;
uint256 constant EDGE_BEFORE = 0x60;
/// @dev The position of the upper end, and of its row.
uint256 constant UPPER_END_AT = 128;
uint256 constant UPPER_ROW_AT = 192;
/// @dev The number of chains, indexed by a remainder of the ends.
uint256 constant CHAINS = 509;

library Outlines {
    /// @notice Adds the edges of the shadow of a face found by Receivers.next.
    /// @param caster Its record.
    function add(Receiver memory receiver, uint256 caster) internal pure {
        unchecked {
            if (!receiver.isVisible) return;
            (uint256 begin, uint256 end) = Clipping.cornersOf(receiver, load(caster));
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

    /// @dev Adds an edge from one position to another; the shadow is to the right of upward edges.
    function addEdge(Receiver memory receiver, uint256 a, uint256 b) private pure {
        (uint256 top, uint256 bottom, uint256 right) = (receiver.top, receiver.bottom, receiver.right);
        uint256 chains = receiver.chains;
        uint256 last = receiver.last;
        assembly ("memory-safe") {
            let first := shr(ROW_SHIFT, add(shr(POINT_ROW_AT, a), ROW_UP)) // the first row of samples not above a
            let end := shr(ROW_SHIFT, add(shr(POINT_ROW_AT, b), ROW_UP)) // that of b
            let more := sub(0, lt(first, end)) // -1: downward edges end a shadow
            if iszero(more) { // upward, or level
                let other := a // a is the upper end from here on
                a := b
                b := other
                other := first // first is the row of the upper end
                first := end
                end := other
                more := 1 // 1: upward edges begin a shadow
            }
            // if it crosses a row of the face, and does not lie entirely to the right of it
            if and(
                and(lt(first, end), and(lt(first, bottom), gt(end, top))), // first < end, and both overlap top .. bottom
                iszero(and(gt(and(a, POINT_COLUMN_MASK), right), gt(and(b, POINT_COLUMN_MASK), right))) // not a.x > right and b.x > right
            ) {
                a := or(shl(UPPER_END_AT, a), b) // from here on, both ends
                chains := add(chains, shl(WORD_SHIFT, mod(a, CHAINS))) // from here on, the address of its chain
                first := mload(chains) // from here on, the address of the chain's first edge
                end := first // from here on, that of the same edge, or 0
                for {} end { end := mload(add(end, EDGE_NEXT)) } { // search the chain
                    if eq(mload(end), a) { break } // the edge exists, with either direction
                }
                switch end // found, or 0
                case 0 {
                    end := mload(0x40) // a new edge, in front of the chain
                    mstore(0x40, add(end, EDGE_SIZE))
                    mstore(end, a) // its ends
                    mstore(add(end, EDGE_COUNT), more) // one shadow more or less
                    mstore(add(end, EDGE_NEXT), first) // the rest of the chain
                    mstore(add(end, EDGE_BEFORE), last) // the edge added before
                    mstore(chains, end) // the first of its chain
                    last := end // the last edge added
                }
                default {
                    end := add(end, EDGE_COUNT) // from here on, the address of its count
                    mstore(end, add(mload(end), more)) // 0: both cancel
                }
            }
        }
        receiver.last = last;
    }

    /// @dev Returns the first row of samples that is not above a position, clamped to `top` and `bottom`.
    function rowOf(uint256 point, uint256 top, uint256 bottom) private pure returns (uint256 row) {
        assembly ("memory-safe") {
            row := shr(ROW_SHIFT, add(shr(POINT_ROW_AT, point), ROW_UP)) // ceil
            if lt(row, top) { row := top } // at least top
            if gt(row, bottom) { row := bottom } // at most bottom
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
                uint256 head = heads + 32 * ((rowOf(key >> UPPER_END_AT, top, bottom) - ROW_BIAS) >> 2);
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
                    if (more < 0) (word, more) = (word | ENDS_SHADOW, -more);
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
                mcopy(list, sub(begin, 0x20), add(size, 0x20)) // over the edges, which are not needed any more
            }
            setFreeMemory(list + size + 32);
        }
    }

    /// @dev Returns the word of an edge with these ends.
    function wordOf(uint256 key, uint256 top, uint256 bottom) private pure returns (uint256 word) {
        unchecked {
            word = ((rowOf(key >> UPPER_END_AT, top, bottom) - ROW_BIAS) << SHADOW_EDGE_TOP_AT)
                | ((rowOf(key & LANE_128, top, bottom) - ROW_BIAS) << SHADOW_EDGE_BOTTOM_AT);
        }
        assembly ("memory-safe") {
            let x := sub(and(shr(UPPER_END_AT, key), POINT_COLUMN_MASK), POINT_BIAS) // the upper end
            let y := sub(shr(UPPER_ROW_AT, key), POINT_BIAS) // its row
            let dx := sub(sub(and(key, POINT_COLUMN_MASK), POINT_BIAS), x) // to the lower end
            let dy := sub(sub(and(shr(POINT_ROW_AT, key), LANE_64), POINT_BIAS), y) // rows to the lower end, positive
            let value := sub(mul(y, dx), mul(x, dy)) // of dy X - dx Y + value at X = Y = 0, which is 0 at both ends
            y := shl(EIGHTH, sub(0, dx)) // from here on, the change downward
            x := shl(EIGHTH, dy) // from here on, the change to the right, which is positive
            // drop the bits of the greater one above EDGE_BITS, at most 16
            dx := sar(SIGN_AT, y)
            dx := sub(xor(y, dx), dx) // |y|
            if gt(x, dx) { dx := x } // max(|y|, x)
            dx := shr(EDGE_BITS, dx) // from here on, what is above EDGE_BITS
            if dx { // too large by at least one bit
                dy := shl(3, lt(0xff, dx)) // from here on, the number of its bits
                dy := or(dy, shl(2, lt(0xf, shr(dy, dx)))) // more than 4, 2, 1 bits
                dy := or(dy, shl(1, lt(0x3, shr(dy, dx))))
                dy := add(or(dy, lt(1, shr(dy, dx))), 1) // + 1
                x := sar(dy, x) // drop as many of all three
                y := sar(dy, y)
                value := sar(dy, value)
            }
            word := or(word, shl(SHADOW_EDGE_DX_AT, x)) // signed, at the top
            word := or(word, shl(SHADOW_EDGE_DY_AT, and(y, SHADOW_EDGE_DY_MASK))) // 48 bits
            word := or(word, shl(SHADOW_EDGE_VALUE_AT, and(value, SHADOW_EDGE_VALUE_MASK))) // 64 bits
        }
    }
}
