// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Addresses} from "../Addresses.sol";
import {IGenesis} from "../interfaces/IGenesis.sol";
import {IPngEncoder} from "../interfaces/IPngEncoder.sol";
import {IRenderer} from "../interfaces/IRenderer.sol";
import {IStudio} from "../interfaces/IStudio.sol";
import {ShackledCode} from "./ShackledCode.sol";

/// @dev What is needed of Foundry's cheatcodes.
interface Cheats {
    function deployCode(string calldata artifact) external returns (address);
    function etch(address target, bytes calldata code) external;
}

/// @title ShackledTest: a Foundry test with the contracts at their addresses, the same bytes as on every chain.
/// @notice `ShackledCode`, which holds the bytes, is compiled once: the test reads it as an artifact of the project.
abstract contract ShackledTest {
    IStudio internal constant studio = IStudio(Addresses.STUDIO);
    IRenderer internal constant renderer = IRenderer(Addresses.RENDERER);
    IPngEncoder internal constant pngEncoder = IPngEncoder(Addresses.PNG_ENCODER);
    IGenesis internal constant genesis = IGenesis(Addresses.GENESIS);

    Cheats private constant CHEATS = Cheats(0x7109709ECfa91a80626fF3989D68f67F5b1DD12D);

    constructor() {
        placeShackled();
    }

    /// @notice Places all contracts whose addresses have no code. To be called again after a fork is selected.
    function placeShackled() internal {
        ShackledCode codes = ShackledCode(CHEATS.deployCode("ShackledCode.sol:ShackledCode"));
        uint256 count = codes.count();
        for (uint256 k; k < count; ++k) {
            (address target, bytes memory code) = codes.get(k);
            if (target.code.length == 0) CHEATS.etch(target, code);
        }
    }
}
