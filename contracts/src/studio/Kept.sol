// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {SSTORE2} from "solady/src/utils/SSTORE2.sol";
import {PARTS, kindOf} from "../mesh/Kinds.sol";
import {StudioErrors} from "./StudioErrors.sol";

/// @notice Bytes kept for ever as the code of contracts that cannot run, at addresses made of the bytes themselves and of the contract that
/// keeps them: the same bytes have one address, and nobody can put others there.
/// @dev What is longer than a contract may be is kept in parts, together with a list of them: PARTS, then their addresses.
library Kept {
    /// @notice Bytes that one contract can hold: 24,576, less the instruction in front that stops all calls.
    uint256 internal constant MAX_PART = 24575;
    /// @notice The most bytes that all parts of a list have together.
    uint256 internal constant MAX_SIZE = 1 << 20;

    /// @notice Keeps bytes, unless they are kept already.
    /// @return pointer Where they are.
    /// @return created Whether they were not.
    function keep(bytes memory data) internal returns (address pointer, bool created) {
        unchecked {
            if (data.length == 0 || kindOf(data) == PARTS) revert StudioErrors.NotToBeKept();
            if (data.length <= MAX_PART) return keepPart(data);
            uint256 count = (data.length + MAX_PART - 1) / MAX_PART;
            address[] memory parts = new address[](count);
            for (uint256 k; k != count; ++k) {
                uint256 size = k + 1 == count ? data.length - k * MAX_PART : MAX_PART;
                bytes memory part = new bytes(size);
                assembly ("memory-safe") {
                    mcopy(add(part, 32), add(add(data, 32), mul(k, MAX_PART)), size)
                }
                (parts[k],) = keepPart(part);
            }
            return join(parts);
        }
    }

    /// @notice Keeps a list of parts, whose bytes one after the other are what is meant; for what does not fit one transaction.
    function join(address[] memory parts) internal returns (address pointer, bool created) {
        unchecked {
            bytes memory list = new bytes(1 + 20 * parts.length);
            list[0] = bytes1(uint8(PARTS));
            for (uint256 k; k != parts.length; ++k) {
                address part = parts[k];
                assembly ("memory-safe") {
                    let place := add(add(list, 33), mul(20, k))
                    mstore(place, or(shl(96, part), shr(160, shl(160, mload(place)))))
                }
            }
            sizeOf(list);
            return keepPart(list);
        }
    }

    /// @notice Keeps up to MAX_PART bytes, whatever they are.
    function keepPart(bytes memory data) internal returns (address pointer, bool created) {
        pointer = SSTORE2.predictCounterfactualAddress(data, 0);
        if (pointer.code.length == 0) return (SSTORE2.writeCounterfactual(data, 0), true);
    }

    /// @notice The bytes that are kept there. Code that others have put anywhere does not count: that of some accounts can change.
    function read(address pointer) internal view returns (bytes memory data) {
        unchecked {
            data = readPart(pointer);
            if (kindOf(data) != PARTS) return data;
            bytes memory list = data;
            uint256 size = sizeOf(list);
            // all parts together are read to where they belong
            data = new bytes(0);
            uint256 target;
            assembly ("memory-safe") {
                data := mload(0x40)
                target := add(data, 32)
            }
            uint256 end = target + size;
            for (uint256 k; target != end; ++k) {
                address part = partAt(list, k);
                size = part.code.length;
                // read as bytes whose length stands in the word before, which is that of `data` or the end of the last part
                bytes memory here;
                uint256 neighbour;
                assembly ("memory-safe") {
                    here := sub(target, 32)
                    neighbour := mload(here)
                    mstore(here, sub(size, 1))
                    extcodecopy(part, target, 1, sub(size, 1))
                    target := add(target, sub(size, 1))
                }
                check(part, here);
                assembly ("memory-safe") {
                    mstore(here, neighbour)
                }
            }
            assembly ("memory-safe") {
                mstore(data, sub(target, add(data, 32)))
                mstore(target, 0)
                mstore(0x40, and(add(target, 63), not(31)))
            }
        }
    }

    /// @dev How many bytes the parts of a list have together.
    function sizeOf(bytes memory list) private view returns (uint256 size) {
        unchecked {
            uint256 count = (list.length - 1) / 20;
            for (uint256 k; k != count; ++k) {
                address part = partAt(list, k);
                uint256 length = part.code.length;
                if (length == 0) revert StudioErrors.NothingKept(part);
                size += length - 1;
            }
            if (size > MAX_SIZE) revert StudioErrors.PartsTooLarge(size, MAX_SIZE);
        }
    }

    function partAt(bytes memory list, uint256 k) private pure returns (address part) {
        assembly ("memory-safe") {
            part := shr(96, mload(add(add(list, 33), mul(20, k))))
        }
    }

    function readPart(address pointer) private view returns (bytes memory data) {
        if (pointer.code.length == 0) revert StudioErrors.NothingKept(pointer);
        data = SSTORE2.read(pointer);
        check(pointer, data);
    }

    /// @dev Whether the address is that at which this contract keeps these bytes.
    function check(address pointer, bytes memory data) private view {
        if (SSTORE2.predictCounterfactualAddress(data, 0) != pointer) revert StudioErrors.NothingKept(pointer);
    }
}
