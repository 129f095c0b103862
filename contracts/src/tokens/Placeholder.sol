// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Scene, Canvas, Background, Material, Object, UNLIT, WIREFRAME, Quaternion, Fixed, ZERO, ONE} from "../scene/Scene.sol";

/// @notice The picture of tokens that have no picture yet: the edges of an octahedron, grey on black.
library Placeholder {
    /// @dev Six vertices, 100 units from the centre, and eight faces, in the format of `Mesh.sol`.
    bytes internal constant OCTAHEDRON = hex"00" hex"0006" hex"0008"
        hex"0064" hex"0000" hex"0000" hex"8c929e" hex"ff9c" hex"0000" hex"0000" hex"8c929e" hex"0000" hex"0064" hex"0000" hex"d8dce4"
        hex"0000" hex"ff9c" hex"0000" hex"4c525e" hex"0000" hex"0000" hex"0064" hex"8c929e" hex"0000" hex"0000" hex"ff9c" hex"4c525e"
        hex"000000020004" hex"000200010004" hex"000100030004" hex"000300000004"
        hex"000200000005" hex"000100020005" hex"000300010005" hex"000000030005";

    /// @dev The width and height of the banner of a collection, in pixels.
    uint256 internal constant BANNER_WIDTH = 256;
    uint256 internal constant BANNER_HEIGHT = 64;

    /// @notice Returns the scene of the octahedron, slightly rotated.
    /// @param width The width of the picture in pixels; `height` likewise.
    function scene(uint256 width, uint256 height) internal pure returns (Scene memory made) {
        made.canvas = Canvas(width, height);
        made.camera.target.z = -ONE;
        made.camera.up.y = ONE;
        made.camera.halfHeight = Fixed.wrap(1 << 31);
        made.camera.near = ONE;
        made.background = Background(0x23262e, 0x0c0d10);
        made.objects = new Object[](1);
        Object memory solid = made.objects[0];
        solid.mesh = OCTAHEDRON;
        solid.position.z = Fixed.wrap(-300 << 32);
        // about 27 degrees about the axis (1, 2, 0)
        solid.rotation = Quaternion(Fixed.wrap(1 << 32), Fixed.wrap(2 << 32), ZERO, Fixed.wrap(9 << 32));
        solid.scale = ONE;
        solid.material = Material(UNLIT, ONE, ZERO, ZERO, 1);
        solid.flags = WIREFRAME;
    }
}
