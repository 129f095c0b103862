// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Seed, Tag, Random} from "./Random.sol";

uint256 constant VERTICALIZED = 0;
uint256 constant ADJOINT = 1;
uint256 constant CETACEAN = 2;
uint256 constant SWARM = 3;
uint256 constant ISOMORPHIC = 4;
uint256 constant EXTRUDED = 5;
uint256 constant UNIFORM = 6;

/// @notice The rules of a layout.
/// @param firstRadius The radius of the first triangle.
/// @param sizesVary Whether triangles differ in size.
/// @param opposite The probability in percent that a triangle is placed corner to corner with another one, rather than beside it.
/// @param oppositeAgain The probabilities that another one of the same kind follows.
struct Structure {
    uint256 index;
    uint256 firstRadius;
    uint256 maxPrisms;
    uint256 minRadius;
    uint256 maxRadius;
    bool sizesVary;
    uint256 opposite;
    uint256 oppositeAgain;
    uint256 adjacentAgain;
}

/// @title Structures: the arrangements of a piece's prisms.
library Structures {
    using Random for Seed;

    Tag private constant KIND = Tag.wrap(bytes32("specId") | bytes32(uint256(6)));
    Tag private constant MAX_PRISMS = Tag.wrap(bytes32("maxPrisms") | bytes32(uint256(9)));
    Tag private constant SIZE = Tag.wrap(bytes32("size") | bytes32(uint256(4)));

    function choose(Seed seed) internal pure returns (Structure memory structure) {
        unchecked {
            int256 value = seed.draw(KIND, 0, 8000);
            uint256 most = uint256(seed.draw(MAX_PRISMS, 8, 16));
            if (value <= 1000) structure = Structure(VERTICALIZED, 12000, most, 4800, 14400, true, 100, 100, 0);
            else if (value <= 3000) structure = Structure(ADJOINT, 12000, most, 4800, 14400, true, 0, 0, 100);
            else if (value <= 3500) structure = Structure(CETACEAN, 0, 8, 14400, 19200, true, 50, 50, 50);
            else if (value <= 4500) structure = Structure(SWARM, 0, 16, 4800, 9600, true, 50, 0, 0);
            else if (value <= 5000) structure = Structure(ISOMORPHIC, 0, most, 4800, 14400, false, 50, 50, 50);
            else if (value <= 6000) structure = Structure(EXTRUDED, 0, 10, 4800, 14400, true, 50, 50, 50);
            else structure = Structure(UNIFORM, 0, 12, 4800, 14400, true, 50, 50, 50);
            if (structure.firstRadius == 0) {
                structure.firstRadius = uint256(seed.draw(SIZE, int256(structure.minRadius), int256(structure.maxRadius)));
            }
        }
    }

    function name(uint256 index) internal pure returns (string memory) {
        if (index == VERTICALIZED) return "Verticalized";
        if (index == ADJOINT) return "Adjoint";
        if (index == CETACEAN) return "Cetacean";
        if (index == SWARM) return "Swarm";
        if (index == ISOMORPHIC) return "Isomorphic";
        if (index == EXTRUDED) return "Extruded";
        return "Uniform";
    }
}
