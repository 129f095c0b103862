// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "./scene/Scene.sol";
import {MAX_SHININESS, MAX_COORDINATE, MAX_COEFFICIENT, MAX_EXTENT} from "./scene/Checks.sol";
import {WIDE} from "./scene/Mesh.sol";
import {Base64} from "./encode/Base64.sol";
import {Text} from "./encode/Text.sol";
import {HEADER_SIZE, FACE_SIZE} from "./mesh/PackedMesh.sol";
import {IRenderer} from "./interfaces/IRenderer.sol";
import {WithRenderer} from "./WithRenderer.sol";

/// @title Original: the interface of the first Shackled contracts, implemented with this renderer.
/// @notice Accepts the calls of `render(RenderParams, int256, bool)`. Geometry, camera, culling, wireframe, background and inversion are
/// the same, except where the original drew them incorrectly. The light becomes one directional light: the colour of the surface is shown
/// in full, as in the original; the highlight is the original's; the diffuse term is multiplied by the colour of the surface. The ambient
/// power, and a diffuse colour of another hue than the highlight, have no counterpart.
contract Original is WithRenderer {
    struct LightingParams {
        bool applyLighting;
        int256 lightAmbiPower;
        int256 lightDiffPower;
        int256 lightSpecPower;
        uint256 inverseShininess;
        int256[3] lightPos;
        int256[3] lightColSpec;
        int256[3] lightColDiff;
        int256[3] lightColAmbi;
    }

    /// @param faces Three vertex indices each, counter-clockwise.
    /// @param cols The colour of each vertex that a face uses: red, green, blue, 0..255.
    /// @param backgroundColor The colours at the top and at the bottom.
    struct RenderParams {
        uint256[3][] faces;
        int256[3][] verts;
        int256[3][] cols;
        int256[3] objPosition;
        int256 objScale;
        int256[3][2] backgroundColor;
        LightingParams lightingParams;
        bool perspCamera;
        bool backfaceCulling;
        bool invert;
        bool wireframe;
    }

    /// @dev 1 / 2.145: half the height of the picture at distance 1, a field of view of about 50 degrees.
    Fixed internal constant HALF_HEIGHT = Fixed.wrap(2002315756);
    /// @dev Half the units that the orthographic camera spans for each pixel of the canvas.
    uint256 internal constant ORTHOGRAPHIC_UNITS = 500;
    uint256 internal constant MAX_COUNT = 65535;

    /// @notice A mesh can have at most 65,535 faces.
    error TooManyFaces(uint256 count);
    /// @notice A mesh can have at most 65,535 vertices.
    error TooManyVertices(uint256 count);
    /// @notice A face uses a vertex that has no position or no colour.
    error NoVertex(uint256 face, uint256 vertex);
    /// @notice The coordinates of a mesh, also when multiplied by the part of the scale above 16, must be -2^23 to 2^23 - 1.
    error VertexOutOfRange(uint256 vertex, int256 x, int256 y, int256 z);
    /// @notice The channels of a vertex colour must be 0 to 255, those of a light 0 to 2^64 - 1.
    error ColorOutOfRange(int256 red, int256 green, int256 blue);
    /// @notice The number must be -2^26 to 2^26.
    error NumberOutOfRange(int256 value);
    /// @notice `lightPos` is the direction to the light and must not be zero.
    error NoLightDirection();

    constructor(IRenderer renderer_) WithRenderer(renderer_) {}

    /// @notice Draws a scene in the original's format.
    /// @param canvasDim The width and height in pixels.
    /// @param returnSVG Whether to return the `data:` URI of an SVG instead of a bitmap.
    function render(RenderParams calldata params, int256 canvasDim, bool returnSVG) external view returns (string memory) {
        Scene memory scene = toScene(params, canvasDim);
        return returnSVG ? svgUri(renderer.renderSVG(scene)) : renderer.renderDataURI(scene);
    }

    /// @notice Returns the scene that `render` draws.
    function toScene(RenderParams calldata params, int256 canvasDim) public pure returns (Scene memory scene) {
        unchecked {
            uint256 side = uint256(canvasDim);
            scene.canvas = Canvas(side, side);
            Camera memory camera = scene.camera;
            camera.target.z = -ONE;
            camera.up.y = ONE;
            // the renderer rejects an invalid canvas size
            camera.projection = params.perspCamera ? PERSPECTIVE : ORTHOGRAPHIC;
            camera.halfHeight =
                params.perspCamera ? HALF_HEIGHT : Fixed.wrap(int256((ORTHOGRAPHIC_UNITS * (side & 0xffff)) << 32));
            camera.near = params.perspCamera ? ONE : Fixed.wrap(-MAX_COORDINATE);
            scene.background = Background(toColor(params.backgroundColor[0]), toColor(params.backgroundColor[1]));
            scene.invert = params.invert ? 1 : 0;
            scene.ambientLight = 0xffffff;

            scene.objects = new Object[](1);
            Object memory object = scene.objects[0];
            object.position = toVector(params.objPosition);
            object.rotation = Quaternion(ZERO, ZERO, ZERO, ONE);
            Fixed scale = toFixed(params.objScale < 0 ? -params.objScale : params.objScale);
            (uint256 bits, uint256 shift) = toFormat(params.verts, scale);
            object.mesh = pack(params, bits, shift);
            object.scale = Fixed.wrap(scale.raw() >> shift);
            object.flags = (params.backfaceCulling ? CULL_BACKFACES : 0) + (params.wireframe ? WIREFRAME : 0);
            object.material = Material(UNLIT, ONE, ZERO, ZERO, 1);
            if (params.lightingParams.applyLighting) setLight(scene, object.material, params.lightingParams);
        }
    }

    function setLight(Scene memory scene, Material memory material, LightingParams calldata lighting) private pure {
        unchecked {
            Vector memory direction = toVector(lighting.lightPos);
            int256[3] calldata p = lighting.lightPos;
            int256 square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
            if (square == 0) revert NoLightDirection();
            bool hasHighlight = lighting.lightSpecPower > 0 && largest(lighting.lightColSpec) > 0;
            // a light has one colour: that of the highlight if there is one
            int256[3] calldata color = hasHighlight ? lighting.lightColSpec : lighting.lightColDiff;
            (uint256 hue, int256 sum) = toHue(color);
            scene.lights = new Light[](1);
            scene.lights[0] = Light(DIRECTIONAL, direction, hue);
            material.shading = FLAT;
            material.diffuse = coefficient(lighting.lightDiffPower, total(lighting.lightColDiff), square * sum);
            material.specular = coefficient(lighting.lightSpecPower, largest(lighting.lightColSpec), square * 255);
            uint256 shininess = lighting.inverseShininess;
            material.shininess = shininess == 0 ? 1 : shininess > MAX_SHININESS ? MAX_SHININESS : shininess;
        }
    }

    /// @dev Returns power * color / divisor, limited to 0..4.
    function coefficient(int256 power, int256 color, int256 divisor) private pure returns (Fixed) {
        unchecked {
            if (power <= 0 || divisor == 0) return ZERO;
            if (power >> 64 != 0) power = 1 << 64;
            int256 value = ((power * color) << 32) / divisor;
            return Fixed.wrap(value > MAX_COEFFICIENT ? MAX_COEFFICIENT : value);
        }
    }

    /// @dev Returns the colour scaled so that its largest channel is 255, and the sum of its channels.
    function toHue(int256[3] calldata color) private pure returns (uint256 hue, int256 sum) {
        unchecked {
            int256 most = largest(color);
            for (uint256 i; i != 3; ++i) {
                int256 part = most == 0 ? int256(255) : (510 * color[i] + most) / (2 * most);
                hue = (hue << 8) | uint256(part);
                sum += part;
            }
        }
    }

    function largest(int256[3] calldata color) private pure returns (int256 most) {
        for (uint256 i; i != 3; ++i) {
            // the original allows powers as part of the colours
            if (color[i] < 0 || color[i] >> 64 != 0) revert ColorOutOfRange(color[0], color[1], color[2]);
            if (color[i] > most) most = color[i];
        }
    }

    function total(int256[3] calldata color) private pure returns (int256) {
        largest(color);
        return color[0] + color[1] + color[2];
    }

    /// @dev Returns the bits needed for a coordinate, and the bits by which the scale must be moved into the coordinates to be within its
    /// limit. If no format is wide enough, `pack` or the renderer reverts.
    function toFormat(int256[3][] calldata verts, Fixed scale) private pure returns (uint256 bits, uint256 shift) {
        unchecked {
            uint256 used;
            for (uint256 i; i != verts.length; ++i) {
                for (uint256 j; j != 3; ++j) {
                    int256 value = verts[i][j];
                    used |= uint256(value < 0 ? -value : value);
                }
            }
            for (bits = 16; bits <= 24; bits += 8) {
                for (shift = 0; scale.raw() >> shift > MAX_EXTENT >> (bits - 1);) ++shift;
                if (used >> (bits - 1 - shift) == 0) return (bits, shift);
            }
            bits = 24;
        }
    }

    /// @notice Returns the mesh in the format of `Mesh.sol`.
    function pack(RenderParams calldata params, uint256 bits, uint256 shift) private pure returns (bytes memory mesh) {
        unchecked {
            (uint256 vertices, uint256 faces) = (params.verts.length, params.faces.length);
            if (vertices > MAX_COUNT) revert TooManyVertices(vertices);
            if (faces > MAX_COUNT) revert TooManyFaces(faces);
            uint256 vertexSize = 3 * bits / 8 + 3;
            mesh = new bytes(HEADER_SIZE + vertexSize * vertices + FACE_SIZE * faces);
            uint256 target;
            assembly ("memory-safe") {
                target := add(mesh, 32)
            }
            target = write(target, ((bits == 24 ? WIDE : 0) << 32) | (vertices << 16) | faces, HEADER_SIZE);
            // the original allows a negative scale: mirror the mesh at its origin instead
            int256 factor = (params.objScale < 0 ? -1 : int256(1)) << shift;
            uint256 colored = params.cols.length;
            for (uint256 i; i != vertices; ++i) {
                uint256 color = i < colored ? toColor(params.cols[i]) : 0;
                target = write(target, (toPosition(params.verts[i], factor, bits, i) << 24) | color, vertexSize);
            }
            uint256 usable = colored < vertices ? colored : vertices;
            for (uint256 i; i != faces; ++i) {
                uint256[3] calldata f = params.faces[i];
                for (uint256 j; j != 3; ++j) if (f[j] >= usable) revert NoVertex(i, f[j]);
                target = write(target, (f[0] << 32) | (f[1] << 16) | f[2], FACE_SIZE);
            }
        }
    }

    function write(uint256 target, uint256 value, uint256 size) private pure returns (uint256) {
        unchecked {
            for (uint256 i = size; i-- != 0; value >>= 8) {
                assembly ("memory-safe") {
                    mstore8(add(target, i), value)
                }
            }
            return target + size;
        }
    }

    /// @dev Returns three coordinates, packed.
    function toPosition(int256[3] calldata v, int256 factor, uint256 bits, uint256 vertex) private pure returns (uint256 packed) {
        unchecked {
            for (uint256 i; i != 3; ++i) {
                if (v[i] != int24(v[i]) || factor * v[i] != int24(factor * v[i])) revert VertexOutOfRange(vertex, v[0], v[1], v[2]);
                packed = (packed << bits) | (uint256(factor * v[i]) & ((1 << bits) - 1));
            }
        }
    }

    function toColor(int256[3] calldata color) private pure returns (uint256) {
        unchecked {
            (uint256 red, uint256 green, uint256 blue) = (uint256(color[0]), uint256(color[1]), uint256(color[2]));
            if (red | green | blue > 255) revert ColorOutOfRange(color[0], color[1], color[2]);
            return (red << 16) | (green << 8) | blue;
        }
    }

    function toVector(int256[3] calldata v) private pure returns (Vector memory) {
        return Vector(toFixed(v[0]), toFixed(v[1]), toFixed(v[2]));
    }

    function toFixed(int256 value) private pure returns (Fixed) {
        unchecked {
            if (value > MAX_COORDINATE >> 32 || value < -MAX_COORDINATE >> 32) revert NumberOutOfRange(value);
            return Fixed.wrap(value << 32);
        }
    }

    /// @dev Returns an SVG document as a `data:` URI.
    function svgUri(string memory svg) private pure returns (string memory uri) {
        unchecked {
            uint256 size = bytes(svg).length;
            string memory head = "data:image/svg+xml;base64,";
            // with room for the bytes that Base64 writes beyond the end
            uri = new string(bytes(head).length + 4 * ((size + 2) / 3) + Base64.MARGIN);
            uint256 data;
            uint256 begin;
            assembly ("memory-safe") {
                data := add(svg, 32)
                begin := add(uri, 32)
            }
            uint256 end = Base64.encode(data, size, Text.write(begin, head));
            assembly ("memory-safe") {
                mstore(uri, sub(end, begin))
            }
        }
    }
}
