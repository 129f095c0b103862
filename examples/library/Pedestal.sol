// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {ILibrary} from "shackled-contracts/interfaces/ILibrary.sol";
import {IStudio} from "shackled-contracts/interfaces/IStudio.sol";
import {Item} from "shackled-contracts/interfaces/Item.sol";
import {Fixed} from "shackled-contracts/math/Fixed.sol";
import {Object, Scene} from "shackled-contracts/scene/Scene.sol";
import {Framing, Model, ModelMaker, Stage, StageMaker} from "shackled-contracts/building/SceneBuilder.sol";

/// @notice Places items of the library in other scenes.
contract Pedestal {
    ILibrary public immutable items;
    IStudio public immutable studio;

    constructor(ILibrary items_, IStudio studio_) {
        (items, studio) = (items_, studio_);
    }

    /// @notice Returns the picture of an item as it is stored, as a data: URI.
    function portrait(string calldata name) external view returns (string memory) {
        return studio.renderDataURI(items.find(name).scene, 4);
    }

    /// @notice Returns a picture of 512 x 512 pixels as a data: URI.
    function image(string calldata name) external view returns (string memory) {
        return studio.drawDataURI(onPedestal(name), 4);
    }

    /// @notice Returns the scene of an item on a pedestal.
    function onPedestal(string memory name) public view returns (Scene memory) {
        Item memory item = items.find(name);
        Object[] memory parts = items.objects(name, StageMaker.unit(100)); // its longest side
        Stage memory stage = StageMaker.stage(128, 128);
        for (uint256 k; k != parts.length; ++k) {
            Object memory part = stage.add(parts[k].mesh, parts[k].material, Framing.box(item.low, item.high));
            (part.position, part.scale) = (parts[k].position, parts[k].scale);
            part.position.y = Fixed.wrap(-item.low[1] * part.scale.raw()); // the lowest point at 0
        }
        Model memory stone = ModelMaker.model();
        stone.box(-60, -30, -60, 60, 0, 60, 0xb9b2a6);
        stage.add(stone.pack(), StageMaker.flat(35, 65, 10, 12));
        stage.fit(StageMaker.units(3, 2, 5));
        stage.antialias();
        return stage.scene;
    }

    /// @notice Returns the scene of three items side by side, each rotated, and fitted to its compartment.
    function inCompartments(string[3] calldata names) external view returns (Scene memory) {
        Stage memory stage = StageMaker.stage(384, 128);
        for (uint256 k; k != 3; ++k) place(stage, names[k], 120 * int256(k));
        stage.fit(StageMaker.units(0, 1, 6));
        stage.antialias();
        return stage.scene;
    }

    function place(Stage memory stage, string memory name, int256 x) private view {
        Item memory item = items.find(name);
        Object[] memory parts = items.objects(name, StageMaker.unit(100));
        for (uint256 k; k != parts.length; ++k) {
            Object memory part = stage.add(parts[k].mesh, parts[k].material, Framing.box(item.low, item.high));
            part.rotation = StageMaker.turned(0, 20, 0);
            stage.place(Framing.box(x, 0, 0, x + 100, 100, 100));
        }
    }
}
