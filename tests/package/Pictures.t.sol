// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {ShackledTest} from "shackled-contracts/test/ShackledTest.sol";
import {Scene} from "shackled-contracts/scene/Scene.sol";
import {PictureToken} from "../src/PictureToken.sol";
import {SkylineToken} from "../src/SkylineToken.sol";
import {Tetrahedron} from "../src/Tetrahedron.sol";

contract PicturesTest is ShackledTest {
    event log_named_bytes(string name, bytes value);

    function testTown() external {
        Scene memory town = new SkylineToken(studio).town(3);
        emit log_named_bytes("bitmap", renderer.render(town));
        emit log_named_bytes("png", studio.drawPNG(town, 1));
    }

    function testTetrahedron() external {
        emit log_named_bytes("uri", bytes(new Tetrahedron(renderer, pngEncoder).image(-25)));
    }

    function testStoredScene() external {
        address pointer = studio.storeScene(new SkylineToken(studio).town(3));
        PictureToken token = new PictureToken(studio, pointer);
        token.mint();
        require(bytes(token.tokenURI(0)).length > 10_000);
    }
}
