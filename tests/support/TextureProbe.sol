// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Texture} from "../../contracts/src/effects/Texture.sol";

/// @notice Samples textures.
contract TextureProbe {
    function sample(bytes calldata texture, int256[2][] calldata places) external pure returns (uint256[] memory colors) {
        colors = new uint256[](places.length);
        uint256 place;
        assembly ("memory-safe") {
            place := texture.offset
        }
        for (uint256 i; i < places.length; ++i) colors[i] = Texture.sample(place, uint256(places[i][0]), uint256(places[i][1]));
    }
}
