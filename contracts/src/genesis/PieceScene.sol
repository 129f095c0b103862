// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {
    Scene, Canvas, Camera, Light, Material, Object, DIRECTIONAL, FLAT, CULL_BACKFACES, WIREFRAME, Fixed, ZERO, ONE, Quaternion
} from "../scene/Scene.sol";
import {Piece} from "../interfaces/Piece.sol";

/// @notice Makes the scene of a piece. A library, so that callers that already have the piece need not generate it again.
library PieceScene {
    /// @dev The side of a picture in pixels.
    uint256 internal constant SIDE = 128;

    /// @dev Returns the scene: seen from the front, lit from the left.
    function make(Piece memory piece) internal pure returns (Scene memory made) {
        unchecked {
            made.canvas = Canvas(SIDE, SIDE);
            Camera memory camera = made.camera;
            camera.target.z = -ONE;
            camera.up.y = ONE;
            // 1 / 2.145: a field of view of about 50 degrees
            camera.halfHeight = Fixed.wrap(2002315756);
            camera.near = ONE;
            made.background = piece.background;
            made.invert = piece.traits.invert ? 1 : 0;
            made.ambientLight = 0xffffff;
            made.lights = new Light[](1);
            made.lights[0].kind = DIRECTIONAL;
            made.lights[0].vector.x = Fixed.wrap(-50 << 32);
            made.lights[0].color = 0xffffff;
            made.objects = new Object[](1);
            Object memory object = made.objects[0];
            object.mesh = piece.mesh;
            object.position.z = Fixed.wrap(-2500 << 32);
            object.rotation = Quaternion(ZERO, ZERO, ZERO, ONE);
            object.scale = ONE;
            // 0.8 and 1.2
            object.material = Material(FLAT, ONE, Fixed.wrap(3435973837), Fixed.wrap(5153960755), 10);
            object.flags = (piece.culling ? CULL_BACKFACES : 0) + (piece.traits.wireframe ? WIREFRAME : 0);
        }
    }
}
