// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../words/Records.sol";
import {loadCalldata} from "../words/Memory.sol";
import {Scene, POINT} from "./Scene.sol";
import {SceneErrors} from "./SceneErrors.sol";

// Properties of a scene, its lights and its objects beyond the fields of their structs. New properties therefore change no selector, and
// stored scenes remain valid. `Scene.extensions` is a sequence of records, all numbers big-endian:
//
//   kind     1 byte    one of the following
//   index    2 bytes   the number of the light or object, from 0; 0 for the scene
//   size     2 bytes   the size of the content: in bytes; for kinds from 8 on, in words of 32 bytes
//   content            depends on the kind:
//   SPOT               of a point light, limits it to a cone:
//                      3 numbers of 8 bytes: the direction of its axis, Q32, any length but zero
//                      2 numbers of 8 bytes: the cosines of the angles from the axis at which the light begins to fade, and at which
//                      it vanishes, Q32, -1..1
//   OPACITY            of an object: 4 bytes, Q24, below 1
//   ANTIALIAS          of the scene: empty; edges are smoothed
//   4 and above        effects, of the scene or of an object: see `EffectRecords.sol`. The EffectsEngine draws scenes that have any
//
// The pairs of kind and index, as one number, must strictly ascend. A missing record means the default, so each property has one encoding.

/// @dev One, as Q24.
uint256 constant OPAQUE = 1 << 24;

/// @notice Reads records in calldata.
library Extensions {
    /// @dev Bounds of coordinates (2^26 units), and 1; Q32.
    int256 private constant MAX_COORDINATE = 1 << 58;
    int256 private constant ONE = 1 << 32;

    /// @notice Checks every record of a scene. The lights and objects must have been checked.
    function check(Scene calldata scene) internal pure {
        unchecked {
            bytes calldata records = scene.extensions;
            (uint256 record, uint256 end) = bounds(scene);
            uint256 least;
            while (record != end) {
                uint256 place = records.length - (end - record);
                if (end - record < RECORD_HEADER) revert SceneErrors.ExtensionCutOff(place);
                uint256 size = sizeOf(record);
                if (size > end - record - RECORD_HEADER) revert SceneErrors.ExtensionCutOff(place);
                uint256 key = keyOf(record);
                (uint256 kind, uint256 index) = (key >> 16, key & 0xffff);
                if (key < least) revert SceneErrors.ExtensionOrder(kind, index);
                least = key + 1;
                if (kind > ANTIALIAS) {
                    record += RECORD_HEADER + size;
                    continue;
                }
                checkHeader(scene, record);
                if (kind == SPOT) {
                    if (scene.lights[index].kind != POINT) revert SceneErrors.SpotIsNoPoint(index);
                    checkSpot(record, index);
                }
                if (kind == OPACITY_OF && opacityOf(record) >= OPAQUE) {
                    revert SceneErrors.OpacityOutOfRange(index, opacityOf(record));
                }
                record += RECORD_HEADER + size;
            }
        }
    }

    /// @notice Checks the kind of a record, that its light or object exists, and its size unless it may have any number of words.
    function checkHeader(Scene calldata scene, uint256 record) internal pure {
        unchecked {
            (uint256 kind, uint256 index) = (keyOf(record) >> 16, keyOf(record) & 0xffff);
            uint256 owner = (RECORD_OWNERS >> 2 * kind) & 3;
            if (owner == 0) revert SceneErrors.UnknownExtension(kind, index);
            uint256 count = owner == OF_OBJECT ? scene.objects.length : owner == OF_LIGHT ? scene.lights.length : 1;
            if (index >= count) revert SceneErrors.ExtensionIndex(kind, index, count);
            uint256 expected = (RECORD_SIZES >> 8 * kind) & 0xff;
            if (expected != ANY_WORDS && expected != sizeOf(record)) {
                revert SceneErrors.ExtensionSize(kind, index, expected, sizeOf(record));
            }
        }
    }

    function checkSpot(uint256 record, uint256 light) private pure {
        (int256 x, int256 y, int256 z) = (spotNumber(record, 0), spotNumber(record, 1), spotNumber(record, 2));
        if (!inRange(x) || !inRange(y) || !inRange(z)) revert SceneErrors.SpotOutOfRange(light, x, y, z);
        if (x | y | z == 0) revert SceneErrors.SpotWithoutDirection(light);
        (int256 inner, int256 outer) = (spotNumber(record, 3), spotNumber(record, 4));
        if (inner > ONE || outer < -ONE || inner < outer) revert SceneErrors.SpotAngles(light, inner, outer);
    }

    function inRange(int256 value) private pure returns (bool) {
        return value >= -MAX_COORDINATE && value <= MAX_COORDINATE;
    }

    /// @return record The position of the first record of a scene.
    /// @return end The position after the last one.
    function bounds(Scene calldata scene) internal pure returns (uint256 record, uint256 end) {
        unchecked {
            bytes calldata records = scene.extensions;
            assembly ("memory-safe") {
                record := records.offset
            }
            end = record + records.length;
        }
    }

    /// @notice Returns the first record of a kind above `kind`, or the end.
    function behind(Scene calldata scene, uint256 kind) internal pure returns (uint256 record, uint256 end) {
        unchecked {
            (record, end) = bounds(scene);
            while (record != end && keyOf(record) >> 16 <= kind) record += RECORD_HEADER + sizeOf(record);
        }
    }

    /// @notice Returns the position of the content of the record of this kind and index; 0 if there is none.
    function find(Scene calldata scene, uint256 kind, uint256 index) internal pure returns (uint256) {
        unchecked {
            (uint256 record, uint256 end) = behind(scene, kind - 1);
            while (record != end && keyOf(record) < (kind << 16 | index)) record += RECORD_HEADER + sizeOf(record);
            return isOf(record, end, kind, index) ? record + RECORD_HEADER : 0;
        }
    }

    /// @notice Returns whether fragments of an object may be translucent though it has no OPACITY_OF.
    function isBlended(Scene calldata scene, uint256 object) internal pure returns (bool) {
        if (find(scene, OPACITIES_OF, object) != 0) return true;
        uint256 alpha = find(scene, ALPHA_OF, object);
        // without a least opacity
        return alpha != 0 && loadCalldata(alpha) >> 248 == 0;
    }

    /// @notice Returns whether any record contains data of vertices or faces.
    function isLong(Scene calldata scene) internal pure returns (bool) {
        (uint256 record, uint256 end) = behind(scene, LONG_KINDS - 1);
        return record != end;
    }

    /// @notice Returns the size of a record's content in bytes.
    function sizeOf(uint256 record) internal pure returns (uint256) {
        unchecked {
            uint256 header = loadCalldata(record) >> 216;
            return (header & 0xffff) << (header >> 32 < LONG_KINDS ? 0 : 5);
        }
    }

    /// @notice Returns whether the next record has this kind and index; false at the end.
    function isOf(uint256 record, uint256 end, uint256 kind, uint256 index) internal pure returns (bool) {
        return record != end && keyOf(record) == (kind << 16 | index);
    }

    /// @notice Returns the kind and index as one number.
    function keyOf(uint256 record) internal pure returns (uint256) {
        return loadCalldata(record) >> 232;
    }

    /// @return Number `i` of a SPOT.
    function spotNumber(uint256 record, uint256 i) internal pure returns (int256) {
        unchecked {
            return int256(loadCalldata(record + RECORD_HEADER + 8 * i)) >> 192;
        }
    }

    function opacityOf(uint256 record) internal pure returns (uint256) {
        unchecked {
            return loadCalldata(record + RECORD_HEADER) >> 224;
        }
    }
}
