// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Bytes} from "@openzeppelin/contracts/utils/Bytes.sol";
import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {Scene} from "../scene/Scene.sol";
import {IGenesis} from "../interfaces/IGenesis.sol";
import {IPngEncoder} from "../interfaces/IPngEncoder.sol";
import {IRenderer} from "../interfaces/IRenderer.sol";
import {IWithEncoder} from "../interfaces/IWithRenderer.sol";
import {Piece, Traits} from "../interfaces/Piece.sol";
import {Json} from "./Json.sol";
import {PieceScene} from "../genesis/PieceScene.sol";
import {Placeholder} from "./Placeholder.sol";

/// @title GenesisMetadata: the metadata of the Genesis collection.
/// @notice Has no storage and no owner, and cannot be changed. A separate contract because of the size limit of contracts.
contract GenesisMetadata {
    using Bytes for bytes;
    using Strings for uint256;

    string internal constant NAME = "Shackled Genesis";
    string internal constant SYMBOL = "SHKG";
    string internal constant DESCRIPTION =
        "1024 pictures of 3D scenes. Scene, colours and every pixel are computed by contracts, from a seed that nobody could choose. "
        "Not by the authors of the Shackled contracts of 2021, nor endorsed by them.";

    /// @dev The enlargement of pictures.
    uint256 internal constant SCALE = 4;

    /// @notice The contract that generates and draws pieces.
    IGenesis public immutable genesis;
    /// @notice The renderer that draws those pictures.
    IRenderer public immutable renderer;
    /// @notice The encoder of PNG files.
    IPngEncoder public immutable encoder;

    /// @notice The address has no code.
    error NoGenesis(address genesis);

    constructor(IGenesis genesis_, IPngEncoder encoder_) {
        if (address(genesis_).code.length == 0) revert NoGenesis(address(genesis_));
        if (address(encoder_).code.length == 0) revert IWithEncoder.NoEncoder(address(encoder_));
        (genesis, renderer, encoder) = (genesis_, genesis_.renderer(), encoder_);
    }

    /// @notice Returns the final seed for a drawn one, and the traits of its piece. A drawn seed that has a piece is final. Very few seeds
    /// (about one in 6,000) have none; each is replaced by its hash.
    function settle(bytes32 drawn) external view returns (bytes32 seed, Traits memory traits) {
        Piece memory piece;
        (seed, piece) = pieceOf(drawn);
        traits = piece.traits;
    }

    /// @notice Returns the metadata of a token.
    /// @param drawn The drawn seed of the token, as for `settle`.
    /// @return A `data:` URI of JSON that contains the picture as a PNG of 512 x 512 pixels.
    function tokenURI(uint256 tokenId, bytes32 drawn) external view returns (string memory) {
        (bytes32 seed, Piece memory piece) = pieceOf(drawn);
        string memory digits = uint256(seed).toHexString(32);
        uint256 color = piece.background.top;
        if (piece.traits.invert) color ^= 0xffffff;
        string memory fields = string.concat(
            Json.field("external_url", Json.link(address(genesis), string.concat("/render/", digits, "?mime.content=image/bmp"))),
            Json.field("background_color", hexadecimal(color))
        );
        string memory description = string.concat(DESCRIPTION, " Seed ", digits, ".");
        show(Json.token(title(tokenId), description, fields, list(piece.traits)), PieceScene.make(piece));
    }

    /// @notice Returns the metadata of a token whose seed is not drawn or not revealed yet. All such tokens show the same picture.
    /// @param blockNumber The block that determines the seed.
    function hiddenURI(uint256 tokenId, uint256 blockNumber) external view returns (string memory) {
        string memory description = string.concat(
            DESCRIPTION,
            " This one is not revealed yet: block ",
            blockNumber.toString(),
            " draws its seed, and anyone may reveal it after that."
        );
        show(Json.token(title(tokenId), description, "", Json.trait("Revealed", false)), cover());
    }

    /// @notice Returns the metadata of the collection (ERC-7572).
    function contractURI() external view returns (string memory) {
        Scene memory banner = Placeholder.scene(Placeholder.BANNER_WIDTH, Placeholder.BANNER_HEIGHT);
        show(Json.collection(NAME, SYMBOL, DESCRIPTION, encoder.dataURI(renderer.render(banner), SCALE)), cover());
    }

    function pieceOf(bytes32 drawn) private view returns (bytes32 seed, Piece memory piece) {
        seed = drawn;
        while (true) {
            (bool done, bytes memory answer) = address(genesis).staticcall(abi.encodeCall(IGenesis.generate, (seed)));
            if (done) return (seed, abi.decode(answer, (Piece)));
            // ignore no other error: a lack of gas must not change the picture
            bytes4 reason = bytes4(answer);
            if (answer.length != 4 || (reason != IGenesis.NoTriangle.selector && reason != IGenesis.NoPrismToChoose.selector)) {
                assembly ("memory-safe") {
                    revert(add(answer, 0x20), mload(answer))
                }
            }
            seed = keccak256(abi.encode(seed));
        }
    }

    function title(uint256 tokenId) private pure returns (string memory) {
        return string.concat("Genesis #", tokenId.toString());
    }

    function list(Traits memory traits) private pure returns (string memory) {
        string memory names = string.concat(Json.trait("Structure", traits.structure), ",", Json.trait("Chroma", traits.chroma), ",");
        names = string.concat(names, Json.trait("Pseudosymmetry", traits.pseudosymmetry), ",", Json.trait("Prisms", traits.prisms), ",");
        return string.concat(names, Json.trait("Wireframe", traits.wireframe), ",", Json.trait("Inversion", traits.invert));
    }

    function cover() private pure returns (Scene memory) {
        return Placeholder.scene(PieceScene.SIDE, PieceScene.SIDE);
    }

    /// @dev Returns the six hexadecimal digits of a colour.
    function hexadecimal(uint256 color) private pure returns (string memory) {
        return string(bytes(color.toHexString(3)).slice(2));
    }

    /// @dev Ends the call with the `data:` URI of a document.
    /// @param head The document up to its picture.
    /// @param scene The scene of the picture.
    function show(bytes memory head, Scene memory scene) private view {
        bytes memory data = abi.encodeCall(IRenderer.render, (scene));
        (address target, bytes4 selector) = (address(renderer), IPngEncoder.dataURI.selector);
        uint256 begin;
        uint256 size;
        assembly ("memory-safe") {
            // the returned bitmap, behind the head of the next call: selector, offset and scale
            let bitmap := add(mload(0x40), 0x40)
            let done := staticcall(gas(), target, add(data, 0x20), mload(data), 0, 0)
            returndatacopy(bitmap, 0, returndatasize())
            if iszero(done) { revert(bitmap, returndatasize()) }
            // the scale replaces the offset of the bitmap
            mstore(bitmap, SCALE)
            mstore(sub(bitmap, 0x20), 0x40)
            begin := sub(bitmap, 0x24)
            mstore(sub(bitmap, 0x40), shr(224, selector))
            size := add(0x24, returndatasize())
        }
        Json.answer(head, address(encoder), begin, size);
    }
}
