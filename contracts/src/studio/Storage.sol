// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {SSTORE2} from "solady/src/utils/SSTORE2.sol";
import {PARTS, kindOf} from "../mesh/Kinds.sol";
import {StudioErrors} from "../interfaces/StudioErrors.sol";

/// @notice Stores bytes permanently as contract code that cannot run. The address is derived from the bytes and from the storing contract
/// (CREATE2): the same bytes have one address, and no other bytes can be placed there.
/// @dev Bytes that exceed the size limit of a contract are stored in parts, together with a list: PARTS, then the addresses of the parts.
library Storage {
    /// @notice The maximum size of a part: 24,576 bytes, less the leading STOP instruction.
    uint256 internal constant MAX_PART = 24575;
    /// @notice The maximum total size of the parts of a list, in bytes.
    uint256 internal constant MAX_SIZE = 1 << 20;

    /// @notice Stores bytes unless they are already stored.
    /// @return pointer The address of the stored bytes.
    /// @return created Whether they were not stored before.
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

    /// @notice Stores a list of parts, which represents the concatenation of their bytes. For data too large for one transaction.
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

    /// @notice Stores up to MAX_PART bytes without checking their kind.
    function keepPart(bytes memory data) internal returns (address pointer, bool created) {
        pointer = SSTORE2.predictCounterfactualAddress(data, 0);
        if (pointer.code.length == 0) return (SSTORE2.writeCounterfactual(data, 0), true);
    }

    /// @notice Returns the stored bytes. Rejects code that this contract did not store: the code of some accounts can change.
    function read(address pointer) internal view returns (bytes memory data) {
        unchecked {
            data = readPart(pointer);
            if (kindOf(data) != PARTS) return data;
            bytes memory list = data;
            uint256 size = sizeOf(list);
            // read all parts directly to their final places
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
                // check each part as `bytes`: its length temporarily replaces the preceding word, which is the length of `data` or the end
                // of the previous part
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

    /// @dev Returns the total size of the parts of a list, in bytes.
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

    /// @dev Reverts unless the address is the one at which this contract stores these bytes.
    function check(address pointer, bytes memory data) private view {
        if (SSTORE2.predictCounterfactualAddress(data, 0) != pointer) revert StudioErrors.NothingKept(pointer);
    }
}
