// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Quadratic} from "./Quadratic.sol";
import {Rasterizer} from "../geometry/Rasterizer.sol";
import {firstRowOf, max} from "../geometry/Screen.sol";
import {Shading} from "./Shading.sol";
import {SmoothTriangle, STEEP_LIGHT, UNBOUNDED_LIGHT} from "./SmoothTriangle.sol";
import "../../words/Registers.sol";

// Chooses how `shade` of picture.py is computed in a triangle.
// Selects the shading of triangles whose fragments are lit: smooth surfaces, and all that no other method draws.

/// @dev Prevents colours (Q42) from being rounded below zero: 1/32 of a level.
uint256 constant SMOOTH_BIAS = 0x100000000000020000000000000200000000000002000000000;

abstract contract SmoothShading is Rasterizer {
    function isSmooth() internal pure override returns (bool) {
        return load(OBJECT_MODE) & IS_SMOOTH != 0;
    }

    function hasBacks() internal pure override returns (bool) {
        return load(BACK_COUNT) != 0;
    }

    function shade(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure virtual override {
        unchecked {
            uint256 mode = load(OBJECT_MODE);
            uint256 kind = UNBOUNDED_LIGHT;
            if (mode & (IS_QUADRATIC | IS_BLENDED) == IS_QUADRATIC) {
                uint256 size = Shading.squareSize(a, b, c);
                // skip triangles that are too large
                if (size < load(SMOOTH_REACH_3)) kind = SmoothTriangle.setLight(a, b, c, size, true);
            }
            if (kind == UNBOUNDED_LIGHT) return shadeExact(a, b, c, crossing);
            (uint256 attributesA, uint256 attributesB, uint256 attributesC) = Shading.attributesOf(a, b, c);
            Quadratic.setDifferences(a, b, c, max(firstRowOf(a), load(BAND_TOP)));
            if (kind == STEEP_LIGHT && !Shading.isAffine(attributesA, attributesB, attributesC, a, b, c)) {
                mode |= IS_STEEP;
                uint256 nearest = max(attributesA, max(attributesB, attributesC)) >> ATTRIBUTE_DEPTH_AT;
                store(NEAREST, nearest << Q24);
                attributesA = weighted(attributesA, nearest);
                attributesB = weighted(attributesB, nearest);
                attributesC = weighted(attributesC, nearest);
            }
            store(MODE, mode | crossing);
            store(ATTRIBUTE_0, (attributesA << ACCUMULATOR_FRACTION) + SMOOTH_BIAS);
            store(DELTA_1, attributesB - attributesA);
            store(DELTA_2, attributesC - attributesA);
        }
    }

    /// @notice Selects the shading of every fragment individually.
    function shadeExact(uint256 a, uint256 b, uint256 c, uint256 crossing) internal pure virtual {
        (uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode) = surface(a, b, c, crossing);
        Shading.setExact(a, b, c, attributesA, attributesB, attributesC, mode | crossing);
    }

    /// @dev Returns the attribute words of a triangle and its mode, and sets its normal or normals.
    function surface(uint256 a, uint256 b, uint256 c, uint256 crossing)
        internal pure returns (uint256 attributesA, uint256 attributesB, uint256 attributesC, uint256 mode)
    {
        (attributesA, attributesB, attributesC) = Shading.attributesOf(a, b, c);
        mode = load(OBJECT_MODE) & ~IS_QUADRATIC;
        if (mode & IS_SMOOTH != 0) Shading.setNormals(a, b, c);
        else if (mode & IS_FLAT != 0) {
            (mode, attributesA, attributesB, attributesC) = Shading.setFace(attributesA, attributesB, attributesC, crossing);
        }
    }

    /// @dev Returns the attribute word with its colour multiplied by its depth relative to the nearest (Q10).
    function weighted(uint256 word, uint256 nearest) private pure returns (uint256) {
        unchecked {
            uint256 depth = word >> ATTRIBUTE_DEPTH_AT;
            return (depth << ATTRIBUTE_DEPTH_AT) | ((((word & LANES_24) * ((depth << Q10) / nearest)) >> Q10) & LANES_24);
        }
    }
}
