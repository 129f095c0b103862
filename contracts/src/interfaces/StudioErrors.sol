// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {GlbErrors} from "./GlbErrors.sol";
import {PngErrors} from "./PngErrors.sol";
import {MeshErrors} from "./MeshErrors.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {TurntableErrors} from "./TurntableErrors.sol";

/// @title StudioErrors: the errors of stored data, of changes to scenes, and of their pictures.
interface StudioErrors is SceneErrors, MeshErrors, PngErrors, GlbErrors, TurntableErrors {
    /// @notice This contract has stored nothing at the pointer.
    error NothingKept(address pointer);
    /// @notice The data is empty, or begins like a list of parts.
    error NotToBeKept();
    /// @notice The total size of the parts exceeds the limit.
    error PartsTooLarge(uint256 size, uint256 largest);
    /// @notice The contract that holds the bytes could not be created.
    error DeploymentFailed();
    /// @notice The first byte of the data is not that of a mesh (256: the data is empty).
    error NotAMesh(uint256 kind);
    /// @notice The stored data is not a scene.
    error NotAScene(address pointer);
    /// @notice `fields` has unknown bits.
    error UnknownChanges(uint256 fields);
    /// @notice The colour is not 0xRRGGBB.
    error ColorOutOfRange(uint256 color);
    /// @notice The rotation is zero, or one of its components is larger than 2^16.
    error TurnOutOfRange();
    /// @notice The scale of the object is so small that nothing of it is visible. Lengths are Q32 numbers: for 1, pass 2^32 = 4294967296.
    error ScaleLooksUnscaled(uint256 object, int256 scale);
    /// @notice The eye is less than 2^-16 units from the target. Lengths are Q32 numbers: for (0, 0, 300), pass (0, 0, 300 * 2^32).
    error CameraLooksUnscaled(int256 eyeX, int256 eyeY, int256 eyeZ);
    /// @notice The largest coefficient of the object's material is below 2^-20, so it is black. Coefficients are Q32 numbers: for 1, pass
    /// 2^32 = 4294967296.
    error MaterialLooksUnscaled(uint256 object, int256 coefficient);
}
