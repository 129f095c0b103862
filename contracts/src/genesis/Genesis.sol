// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Fixed, ZERO, ONE} from "../math/Fixed.sol";
import {Quaternion} from "../math/Quaternion.sol";
import {
    Scene, Canvas, Camera, Background, Light, Material, Object, DIRECTIONAL, FLAT, CULL_BACKFACES, WIREFRAME
} from "../scene/Scene.sol";
import {Renderer} from "../Renderer.sol";
import {Seed, Tag, Random} from "./Random.sol";
import {Structures, SWARM} from "./Structures.sol";
import {Layout, Layouts} from "./Layout.sol";
import {Prisms, PrismMaker} from "./Prisms.sol";
import {Scheme, Schemes, SUNSET, STONE_AND_GOLD, VIVID_ALABASTER, VIVID_INK} from "./Schemes.sol";
import {Colors} from "./Colors.sol";
import {PieceMesh} from "./PieceMesh.sol";

/// @notice What a piece is called.
/// @param structure How its prisms are arranged. chroma The scheme of its colours. pseudosymmetry Its mirrors.
struct Traits {
    string structure;
    string chroma;
    string pseudosymmetry;
    uint256 prisms;
    bool wireframe;
    bool invert;
}

/// @notice What a seed stands for.
/// @param culling Whether faces that turn away are left out.
/// @param mesh In the format of `Mesh.sol`: six vertices and seven faces a prism.
struct Piece {
    Traits traits;
    Background background;
    bool culling;
    bytes mesh;
}

/// @title Genesis: a collection of pictures made from nothing but a seed of 32 bytes.
/// @notice The seed gives a piece, the piece a scene, and the renderer its picture, in one call.
contract Genesis {
    using Random for Seed;

    Renderer public immutable renderer;

    /// @dev The side of a picture in pixels.
    uint256 internal constant SIDE = 128;

    Tag internal constant WIRES = Tag.wrap(bytes32("wireframe") | bytes32(uint256(9)));
    Tag internal constant INVERSION = Tag.wrap(bytes32("invert") | bytes32(uint256(6)));

    error NoRenderer(address renderer);
    /// @notice No triangle fits: the seed has no piece.
    error NoTriangle();

    constructor(Renderer renderer_) {
        if (address(renderer_).code.length == 0) revert NoRenderer(address(renderer_));
        renderer = renderer_;
    }

    /// @notice The piece of a seed.
    function generate(bytes32 seed) public pure returns (Piece memory piece) {
        (Layout memory laid, Scheme memory scheme) = plan(Seed.wrap(seed));
        piece.traits = describe(laid, scheme);
        piece.background = Background(scheme.top, scheme.bottom);
        piece.culling = !piece.traits.wireframe;
        Prisms memory prisms = PrismMaker.make(laid);
        piece.mesh = PieceMesh.pack(prisms, Colors.paint(Seed.wrap(seed), scheme, prisms));
    }

    /// @notice What a piece is called.
    function traits(bytes32 seed) external pure returns (Traits memory) {
        (Layout memory laid, Scheme memory scheme) = plan(Seed.wrap(seed));
        return describe(laid, scheme);
    }

    /// @notice How a piece is drawn.
    function scene(bytes32 seed) external pure returns (Scene memory) {
        return toScene(generate(seed));
    }

    /// @notice The picture of a piece.
    /// @return A Windows bitmap of 24 bits a pixel.
    function render(bytes32 seed) external view returns (bytes memory) {
        answer(abi.encodeCall(Renderer.render, (toScene(generate(seed)))));
    }

    /// @notice The picture of a piece.
    /// @return A `data:` URI of the bitmap.
    function renderDataURI(bytes32 seed) external view returns (string memory) {
        answer(abi.encodeCall(Renderer.renderDataURI, (toScene(generate(seed)))));
    }

    /// @notice The picture of a piece.
    /// @return An SVG document that shows the bitmap at any size without smoothing.
    function renderSVG(bytes32 seed) external view returns (string memory) {
        answer(abi.encodeCall(Renderer.renderSVG, (toScene(generate(seed)))));
    }

    /// @dev Ends the call with what the renderer answers, or why it refuses, as it is: the compiler would copy a picture twice.
    function answer(bytes memory data) private view {
        address target = address(renderer);
        assembly {
            let done := staticcall(gas(), target, add(data, 0x20), mload(data), 0, 0)
            returndatacopy(0, 0, returndatasize())
            if iszero(done) {
                revert(0, returndatasize())
            }
            return(0, returndatasize())
        }
    }

    function plan(Seed seed) private pure returns (Layout memory laid, Scheme memory scheme) {
        laid = Layouts.lay(seed, Structures.choose(seed));
        if (laid.count == 0) revert NoTriangle();
        scheme = Schemes.choose(seed, laid.count);
    }

    function describe(Layout memory laid, Scheme memory scheme) private pure returns (Traits memory found) {
        (uint256 structure, uint256 chroma) = (laid.structure.index, scheme.index);
        found.structure = Structures.name(structure);
        found.chroma = Schemes.name(chroma);
        found.pseudosymmetry =
            laid.mirrorX ? (laid.mirrorY ? "Diagonal" : "Horizontal") : (laid.mirrorY ? "Vertical" : "Scattered");
        found.prisms = laid.count;
        found.wireframe = structure != SWARM && laid.seed.draw(WIRES, 1, 100) > 95;
        found.invert = chroma != SUNSET && chroma != STONE_AND_GOLD && chroma != VIVID_ALABASTER && chroma != VIVID_INK
            && laid.seed.draw(INVERSION, 1, 10) > 6;
    }

    /// @dev Seen from the front, lit from the left, its colours in full.
    function toScene(Piece memory piece) private pure returns (Scene memory made) {
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
