// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Object, Rectangle, Fixed, Vector, Matrix} from "../scene/Scene.sol";
import {View} from "./View.sol";
import "../words/Registers.sol";

// Combines `object_of`, `Camera.seen` and `Camera.project` of picture.py, all but the division, into one map.

/// @notice Sets the transformation of an object's vertices to the screen.
library Transform {
    /// @notice Combines rotation, scale, position, camera and viewport into one affine map from mesh space to clip coordinates.
    function setMatrix(View memory view_, Object calldata object, Matrix memory rotation) internal pure {
        Fixed scale = object.scale;
        store(MATRIX_X, clipLanes(view_, view_.toCamera(rotation.x).scale(scale), 0));
        store(MATRIX_Y, clipLanes(view_, view_.toCamera(rotation.y).scale(scale), 0));
        store(MATRIX_Z, clipLanes(view_, view_.toCamera(rotation.z).scale(scale), 0));
        Vector memory position = object.position;
        store(MATRIX_T, clipLanes(view_, view_.toCamera(position.sub(view_.eye)), 1 << 32));
    }

    /// @dev Returns one column of the map. `w` is the last coordinate of the column, Q32: 1 for the translation.
    function clipLanes(View memory view_, Vector memory v, int256 w) private pure returns (uint256) {
        unchecked {
            if (!view_.orthographic) w = v.z.raw();
            int256 x = ((view_.focal * v.x.raw()) >> 32) + ((view_.centerX * w) >> 1);
            int256 y = ((view_.focal * v.y.raw()) >> 32) + ((view_.centerY * w) >> 1);
            return uint256(x) + (uint256(y) << CLIP_Y_AT) + (uint256(v.z.raw()) << CLIP_W_AT);
        }
    }

    /// @notice Sets the rotation of normals into camera space, divided by the 511 of the mesh format.
    function setNormalMatrix(View memory view_, Matrix memory rotation) internal pure {
        store(NORMAL_X, normalLanes(view_.toCamera(rotation.x)));
        store(NORMAL_Y, normalLanes(view_.toCamera(rotation.y)));
        store(NORMAL_Z, normalLanes(view_.toCamera(rotation.z)));
    }

    function normalLanes(Vector memory v) private pure returns (uint256) {
        unchecked {
            return uint256(v.x.raw() / (4096 * 511)) + (uint256(v.y.raw() / (4096 * 511)) << MIDDLE_85_AT)
                + (uint256(v.z.raw() / (4096 * 511)) << UPPER_85_AT);
        }
    }

    /// @dev Sets the rows and columns that a vertex touches: for a face the pixel centres from it on, for a line the pixels nearest to it;
    /// with four samples the outermost of them, and for a line, which is one pixel wide, those half a pixel farther.
    function setRounding(Rectangle memory tile, bool wireframe) internal pure {
        unchecked {
            uint256 wider = wireframe ? 0 : 127;
            uint256 down = HALF_PIXEL + wider;
            uint256 up = wireframe ? HALF_PIXEL + 256 : SUBPIXEL_MASK;
            if (load(FRAME_IS_ANTIALIASED) != 0) {
                wider = wireframe ? 127 : 0;
                down = SUBPIXEL_MASK - OUTERMOST_SAMPLE - (wireframe ? HALF_PIXEL : 0);
                up = 2 * SUBPIXEL_MASK - down;
            }
            store(TILE_LEFT, ((tile.x + PIXEL_BIAS) << SUBPIXEL_BITS) - HALF_PIXEL - wider);
            store(TILE_SPAN, (tile.width << SUBPIXEL_BITS) - 1 + 2 * wider + (wider & 2));
            store(TILE_TOP, ((tile.y + PIXEL_BIAS) << SUBPIXEL_BITS) - HALF_PIXEL - wider);
            store(TILE_ROWS, (tile.height << SUBPIXEL_BITS) - 1 + 2 * wider + (wider & 2));
            store(ROUND_TOP, down << SCREEN_ROW_AT);
            store(ROUND_BOTTOM, up << SCREEN_ROW_AT);
        }
    }
}
