// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {LONG_KINDS, RECORD_HEADER} from "../words/Records.sol";
import {SceneErrors} from "./SceneErrors.sol";

// Adds records to `Scene.extensions` in memory. External contracts import this file, so it must compile for any EVM version.

/// @notice Adds a record. It replaces one of the same kind and index.
/// @dev Avoids MCOPY, which older EVMs lack.
function addRecord(bytes memory records, uint256 kind, uint256 index, bytes memory content) pure returns (bytes memory more) {
    unchecked {
        // in words from LONG_KINDS on
        uint256 size = content.length >> (kind < LONG_KINDS ? 0 : 5);
        bytes memory record = abi.encodePacked(uint8(kind), uint16(index), uint16(size), content);
        uint256 key = kind << 16 | index;
        // the position of the record, and of the records after it
        (uint256 place, uint256 next) = (0, 0);
        while (next < records.length) {
            uint256 header;
            assembly ("memory-safe") {
                header := shr(216, mload(add(add(records, 32), next)))
            }
            if (header >> 16 > key) break;
            uint256 end = next + RECORD_HEADER + ((header & 0xffff) << (header >> 32 < LONG_KINDS ? 0 : 5));
            if (end > records.length) revert SceneErrors.ExtensionCutOff(next);
            next = end;
            if (header >> 16 < key) place = next;
        }
        more = new bytes(place + record.length + records.length - next);
        copyBytes(more, 0, records, 0, place);
        copyBytes(more, place, record, 0, record.length);
        copyBytes(more, place + record.length, records, next, records.length - next);
    }
}

/// @notice Copies exactly `size` bytes. If the ranges overlap, only toward lower addresses.
function copyBytes(bytes memory target, uint256 to, bytes memory source, uint256 from, uint256 size) pure {
    assembly ("memory-safe") {
        to := add(add(target, 32), to)
        from := add(add(source, 32), from)
        let end := add(to, and(size, not(31)))
        for {} lt(to, end) {} {
            mstore(to, mload(from))
            to := add(to, 32)
            from := add(from, 32)
        }
        let behind := shr(shl(3, and(size, 31)), not(0))
        mstore(to, or(and(mload(from), not(behind)), and(mload(to), behind)))
    }
}
