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
}
