// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Addresses} from "../Addresses.sol";
import {IGenesis} from "../interfaces/IGenesis.sol";
import {IPngEncoder} from "../interfaces/IPngEncoder.sol";
import {IRenderer} from "../interfaces/IRenderer.sol";
import {IStudio} from "../interfaces/IStudio.sol";
import {ShackledCode} from "./ShackledCode.sol";

/// @dev The Foundry cheatcodes used here.
interface Cheats {
    function deployCode(string calldata artifact) external returns (address);
    function etch(address target, bytes calldata code) external;
}

/// @dev A contract of ShackledCode.sol.
interface CodeHolder {
    function get() external view returns (bytes memory code);
}

/// @title ShackledTest: a Foundry test with the contracts at their addresses, with the same bytecode as on every chain.
/// @notice The contracts of ShackledCode.sol, which contain the bytecode, are compiled once: tests read them as artifacts of the project.
abstract contract ShackledTest {
    IStudio internal constant studio = IStudio(Addresses.STUDIO);
    IRenderer internal constant renderer = IRenderer(Addresses.RENDERER);
    IPngEncoder internal constant pngEncoder = IPngEncoder(Addresses.PNG_ENCODER);
    IGenesis internal constant genesis = IGenesis(Addresses.GENESIS);

    Cheats private constant CHEATS = Cheats(0x7109709ECfa91a80626fF3989D68f67F5b1DD12D);

    constructor() {
        placeShackled();
    }

    /// @notice Places all contracts whose addresses have no code. Call it again after selecting a fork.
    function placeShackled() internal {
        (string[] memory names, address[] memory targets) = ShackledCode.all();
        for (uint256 k; k < names.length; ++k) {
            if (targets[k].code.length != 0) continue;
            address holder = CHEATS.deployCode(string.concat("ShackledCode.sol:", names[k]));
            CHEATS.etch(targets[k], CodeHolder(holder).get());
        }
    }
}
