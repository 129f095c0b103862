// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed, ZERO, ONE} from "shackled-contracts/math/Fixed.sol";
import {Vector} from "shackled-contracts/math/Vector.sol";
import {
    Background,
    Camera,
    Canvas,
    Light,
    Material,
    Object,
    Scene,
    CULL_BACKFACES,
    DIRECTIONAL,
    FLAT,
    PERSPECTIVE
} from "shackled-contracts/scene/Scene.sol";
import {IPngEncoder} from "shackled-contracts/interfaces/IPngEncoder.sol";
import {IRenderer} from "shackled-contracts/interfaces/IRenderer.sol";

/// @notice A contract that draws a tetrahedron, rotated as the caller chooses, as a PNG file or as a bitmap.
contract Tetrahedron {
    IRenderer public immutable renderer;
    IPngEncoder public immutable encoder;

    constructor(IRenderer renderer_, IPngEncoder encoder_) {
        (renderer, encoder) = (renderer_, encoder_);
    }

    /// @notice Returns the `image` of a token: a `data:` URI of a PNG file, each pixel enlarged to a square of 4 x 4 pixels.
    function image(int256 degrees_) external view returns (string memory) {
        return encoder.dataURI(bitmap(degrees_), 4);
    }

    function bitmap(int256 degrees_) public view returns (bytes memory) {
        return renderer.render(scene(degrees_));
    }

    /// @notice Returns the whole scene for the renderer. Lengths are Q32 fixed-point numbers: value * 2^32.
    function scene(int256 degrees_) public view returns (Scene memory s) {
        s.canvas = Canvas(64, 64);
        s.camera = Camera({
            eye: vector(0, 2, 6),
            target: vector(0, 0, 0),
            up: vector(0, 1, 0),
            projection: PERSPECTIVE,
            halfHeight: fixed_(2) / fixed_(5),
            near: ONE
        });
        s.background = Background({top: 0x1d2433, bottom: 0x8794ad});
        s.ambientLight = 0xffffff;

        s.lights = new Light[](1);
        s.lights[0] = Light(DIRECTIONAL, vector(-1, 2, 3), 0xfff1dc);

        s.objects = new Object[](1);
        s.objects[0] = Object({
            mesh: mesh(),
            position: vector(0, 0, 0),
            rotation: renderer.eulerRotation(ZERO, fixed_(degrees_), ZERO),
            scale: ONE / fixed_(100),
            material: Material({
                shading: FLAT,
                ambient: ONE / fixed_(4),
                diffuse: fixed_(3) / fixed_(4),
                specular: ONE / fixed_(3),
                shininess: 20
            }),
            flags: CULL_BACKFACES
        });
    }

    /// @notice Returns four vertices, six bytes for the position and three for the colour, and four faces of three vertex indices of two
    /// bytes: see shackled-contracts/scene/Mesh.sol.
    function mesh() public pure returns (bytes memory) {
        return bytes.concat(
            // format, vertices, faces
            abi.encodePacked(uint8(0), uint16(4), uint16(4)),
            abi.encodePacked(int16(120), int16(120), int16(120), uint24(0xe0503c)),
            abi.encodePacked(int16(-120), int16(-120), int16(120), uint24(0xe0b040)),
            abi.encodePacked(int16(-120), int16(120), int16(-120), uint24(0x3f8fb5)),
            abi.encodePacked(int16(120), int16(-120), int16(-120), uint24(0x58b368)),
            // counter-clockwise as seen from outside
            hex"0000_0002_0001_0000_0001_0003_0000_0003_0002_0001_0002_0003"
        );
    }

    function vector(int256 x, int256 y, int256 z) private pure returns (Vector memory) {
        return Vector(fixed_(x), fixed_(y), fixed_(z));
    }

    function fixed_(int256 whole) private pure returns (Fixed) {
        return Fixed.wrap(whole << 32);
    }
}
