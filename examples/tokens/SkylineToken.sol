// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {ERC721A} from "erc721a/contracts/ERC721A.sol";
import {Base64} from "solady/src/utils/Base64.sol";
import {IStudio} from "shackled-contracts/interfaces/IStudio.sol";
import {Scene} from "shackled-contracts/scene/Scene.sol";
import {Model, ModelMaker, Stage, StageMaker} from "shackled-contracts/building/SceneBuilder.sol";

/// @notice Tokens whose pictures are generated from their numbers alone: a town of 5 by 5 houses, different for each token.
contract SkylineToken is ERC721A("Skylines", "SKY") {
    IStudio public immutable studio;

    constructor(IStudio studio_) {
        studio = studio_;
    }

    function mint() external {
        _mint(msg.sender, 1);
    }

    function tokenURI(uint256 id) public view override returns (string memory) {
        if (!_exists(id)) revert URIQueryForNonexistentToken();
        string memory image = studio.drawDataURI(town(id), 4);
        string memory json = string.concat('{"name":"Skyline ', _toString(id), '","image":"', image, '"}');
        return string.concat("data:application/json;base64,", Base64.encode(bytes(json)));
    }

    /// @notice Returns the whole scene: 25 houses on a plate, seen from above, in the evening sun.
    function town(uint256 id) public pure returns (Scene memory) {
        Model memory houses = ModelMaker.model(26 * 8, 26 * 12);
        houses.box(-280, -20, -280, 280, 0, 280, 0x39424e);
        for (int256 place; place < 25; ++place) {
            uint256 random = uint256(keccak256(abi.encode(id, place)));
            (int256 x, int256 z) = ((place % 5) * 100 - 240, (place / 5) * 100 - 240);
            int256 width = int256(50 + random % 31);
            int256 height = int256(30 + ((random >> 8) % 60) * ((random >> 16) % 6));
            houses.box(x, 0, z, x + width, height, z + width, wall(random >> 32));
        }
        Stage memory stage = StageMaker.stage(128, 128, 1);
        stage.background(0x27406b, 0xf2a65a);
        stage.look(StageMaker.units(540, 400, 640), StageMaker.units(0, 45, 0));
        stage.sun(StageMaker.units(-3, 2, 4), 0xffe2b8);
        stage.add(houses.pack(), StageMaker.flat(35, 75, 10, 12));
        return stage.scene;
    }

    /// @dev Returns one of five colours.
    function wall(uint256 random) private pure returns (uint256) {
        return uint24(uint256(0xc8553d_f3e9dc_5e8c9a_d9b44a_8a5a83) >> (24 * (random % 5)));
    }
}
