// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {IStudio} from "./IStudio.sol";
import {StudioErrors} from "./StudioErrors.sol";

/// @title IWithStudio: a contract that gives names to scenes stored by the Studio.
interface IWithStudio is StudioErrors {
    /// @notice The address has no code.
    error NoStudio(address studio);
    /// @notice The name must have 1 to `longest` bytes.
    error NameLength(uint256 length, uint256 longest);
    /// @notice The bytes of the name from this position on are not valid UTF-8.
    error NameNotUtf8(uint256 position);

    /// @notice Returns the Studio, which stores and draws the scenes.
    function studio() external view returns (IStudio);
}
