// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {forward} from "../encode/Redirect.sol";
import {Scene, Background} from "../scene/Scene.sol";
import {WithRenderer} from "../WithRenderer.sol";
import {Seed, Tag, Random} from "./Random.sol";
import {Structures, SWARM} from "./Structures.sol";
import {Layout, Layouts} from "./Layout.sol";
import {Prisms, PrismMaker} from "./Prisms.sol";
import {Scheme, Schemes, SUNSET, STONE_AND_GOLD, VIVID_ALABASTER, VIVID_INK} from "./Schemes.sol";
import {Colors} from "./Colors.sol";
import {IGenesis} from "../interfaces/IGenesis.sol";
import {IRenderer} from "../interfaces/IRenderer.sol";
import {Piece, Traits} from "../interfaces/Piece.sol";
import {PieceMesh} from "./PieceMesh.sol";
import {PieceScene} from "./PieceScene.sol";

/// @title Genesis: a collection of pictures generated from 32-byte seeds only.
/// @notice The seed determines a piece, the piece a scene, and the renderer draws it, in one call.
contract Genesis is WithRenderer, IGenesis {
    using Random for Seed;

    Tag internal constant WIRES = Tag.wrap(bytes32("wireframe") | bytes32(uint256(9)));
    Tag internal constant INVERSION = Tag.wrap(bytes32("invert") | bytes32(uint256(6)));

    constructor(IRenderer renderer_) WithRenderer(renderer_) {}

    function generate(bytes32 seed) public pure returns (Piece memory piece) {
        (Layout memory laid, Scheme memory scheme) = plan(Seed.wrap(seed));
        piece.traits = describe(laid, scheme);
        piece.background = Background(scheme.top, scheme.bottom);
        piece.culling = !piece.traits.wireframe;
        Prisms memory prisms = PrismMaker.make(laid);
        piece.mesh = PieceMesh.pack(prisms, Colors.paint(Seed.wrap(seed), scheme, prisms));
    }

    function traits(bytes32 seed) external pure returns (Traits memory) {
        (Layout memory laid, Scheme memory scheme) = plan(Seed.wrap(seed));
        return describe(laid, scheme);
    }

    function scene(bytes32 seed) external pure returns (Scene memory) {
        return PieceScene.make(generate(seed));
    }

    function render(bytes32 seed) external view returns (bytes memory) {
        forward(address(renderer), abi.encodeCall(IRenderer.render, (PieceScene.make(generate(seed)))));
    }

    function renderDataURI(bytes32 seed) external view returns (string memory) {
        forward(address(renderer), abi.encodeCall(IRenderer.renderDataURI, (PieceScene.make(generate(seed)))));
    }

    function renderSVG(bytes32 seed) external view returns (string memory) {
        forward(address(renderer), abi.encodeCall(IRenderer.renderSVG, (PieceScene.make(generate(seed)))));
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
}
