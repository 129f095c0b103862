// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {GlbErrors} from "../encode/GlbErrors.sol";
import {PngErrors} from "../encode/PngErrors.sol";
import {MeshErrors} from "../mesh/MeshErrors.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {TurntableErrors} from "./TurntableErrors.sol";

/// @title StudioErrors: what can be wrong with what the Studio keeps, with changes of it, and with its pictures.
interface StudioErrors is SceneErrors, MeshErrors, PngErrors, GlbErrors, TurntableErrors {
    /// @notice Nothing is kept there by this contract.
    error NothingKept(address pointer);
    /// @notice There is nothing to be kept, or its first byte is that of a list of parts.
    error NotToBeKept();
    /// @notice The parts of a list have more bytes together than are read at once.
    error PartsTooLarge(uint256 size, uint256 largest);
    /// @notice The chain did not create the contract that was to keep the bytes.
    error DeploymentFailed();
    /// @notice The first byte of what is to be stored, or of what is kept there, is not that of a mesh (256: there is none).
    error NotAMesh(uint256 kind);
    /// @notice What is kept there is no scene.
    error NotAScene(address pointer);
    /// @notice A field is named that there is not.
    error UnknownChanges(uint256 fields);
    error ColorOutOfRange(uint256 color);
    /// @notice The rotation is zero, or a part of it is larger than 2^16.
    error TurnOutOfRange();
    /// @notice The scale of the object is so small that nothing of it can be seen. Lengths are Q32 numbers: for 1, pass 2^32 = 4294967296.
    error ScaleLooksUnscaled(uint256 object, int256 scale);
    /// @notice The eye is less than 2^-16 units from the target. Lengths are Q32 numbers: for (0, 0, 300), pass (0, 0, 300 * 2^32).
    error CameraLooksUnscaled(int256 eyeX, int256 eyeY, int256 eyeZ);
    /// @notice The largest coefficient of the object's material is below 2^-20, so that it is black. Coefficients are Q32 numbers: for 1,
    /// pass 2^32 = 4294967296.
    error MaterialLooksUnscaled(uint256 object, int256 coefficient);
}
