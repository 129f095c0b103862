// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {ZERO, ONE} from "../math/Fixed.sol";
import {Vector} from "../math/Vector.sol";
import {CANVAS, Changes} from "../interfaces/Changes.sol";
import {Turn} from "../interfaces/Turn.sol";
import {IStudio} from "../interfaces/IStudio.sol";
import {Collection, Terms} from "./Collection.sol";
import {Allowance} from "./Sale.sol";
import {Json} from "./Json.sol";
import {Placeholder} from "./Placeholder.sol";
import {WithStudio} from "./WithStudio.sol";

/// @notice A kind of token.
/// @param name The name of the icon.
/// @param scene The pointer to the scene, as the Studio returned it.
/// @param scale The enlargement of the picture in `tokenURI`: each pixel becomes a square of `scale` x `scale` pixels.
/// @param price The price of a token, in wei.
/// @param supply The maximum number of tokens of the icon.
/// @param reserve The number of them reserved for the team.
/// @param sold The number of tokens sold.
/// @param reserveMinted The number of reserved tokens minted.
struct Icon {
    string name;
    address scene;
    uint8 scale;
    uint96 price;
    uint32 supply;
    uint32 reserve;
    uint32 sold;
    uint32 reserveMinted;
}

/// @title IconsCollection: a fixed set of stored scenes, each a kind of token with its own supply.
/// @notice The owner adds the icons, then seals the collection. The sale can open only then, and no icon can be added or changed any more.
/// The scenes are stored as contract code and drawn by contracts, all of them immutable.
contract IconsCollection is Collection, WithStudio {
    using Strings for uint256;

    string internal constant DESCRIPTION =
        "Small scenes, kept and drawn by contracts: every pixel is computed on chain. "
        "Not by the authors of the Shackled contracts of 2021, nor endorsed by them.";
    uint256 internal constant MAX_SCALE = 8;
    /// @dev Animations: the number of frames, their side in pixels, and their duration in milliseconds.
    uint256 internal constant FRAMES = 12;
    uint256 internal constant FRAME_SIDE = 64;
    uint256 internal constant FRAME_TIME = 100;

    /// @notice Whether the set of icons is sealed.
    bool public isSealed;

    Icon[] private icons;

    /// @notice Emitted when an icon is added.
    event IconAdded(uint256 indexed icon, string name, address scene, uint256 price, uint256 supply, uint256 reserve);
    /// @notice Emitted when the set of icons is sealed.
    event Sealed(uint256 icons);

    /// @notice The collection is already sealed.
    error AlreadySealed();
    /// @notice The collection is not sealed yet.
    error NotSealed();
    /// @notice The collection has no icons to seal, or too many.
    error NoIcons();
    /// @notice The number of the icon is not below the number of icons.
    error UnknownIcon(uint256 icon, uint256 icons);
    /// @notice The supply must not be 0, and the reserve must not exceed it.
    error Supply(uint256 supply, uint256 reserve);

    constructor(IStudio studio_, Terms memory terms) Collection("Shackled Icons", "SHKI", terms) WithStudio(studio_) {}

    // ---- icons ----

    /// @notice Adds an icon. Only the owner, until the collection is sealed. Reverts with the error of the drawing if the scene cannot be
    /// drawn. `studio().render(scene)` returns a preview.
    /// @param name_ The name: 1 to 64 bytes of UTF-8.
    /// @param scene The pointer to the scene, as the Studio returned it.
    /// @param scale The enlargement of the picture in `tokenURI`, 1..8: each pixel becomes a square of `scale` x `scale` pixels.
    /// @param price The price of a token, in wei.
    /// @param supply The maximum number of tokens of the icon.
    /// @param reserve The number of them reserved for the team.
    /// @return icon The number of the icon.
    function add(string calldata name_, address scene, uint8 scale, uint96 price, uint32 supply, uint32 reserve)
        external onlyOwner returns (uint256 icon)
    {
        if (isSealed) revert AlreadySealed();
        checkName(name_);
        if (scale == 0 || scale > MAX_SCALE) revert PixelScaleOutOfRange(scale, MAX_SCALE);
        if (supply == 0 || reserve > supply) revert Supply(supply, reserve);
        studio.check(scene);
        icon = icons.length;
        icons.push(Icon(name_, scene, scale, price, supply, reserve, 0, 0));
        emit IconAdded(icon, name_, scene, price, supply, reserve);
        if (icon == 0) emit ContractURIUpdated();
    }

    /// @notice Seals the set of icons permanently. Only the owner.
    function seal() external onlyOwner {
        if (isSealed) revert AlreadySealed();
        // the number of an icon is stored in 24 bits next to the owner of a token
        if (icons.length == 0 || icons.length > type(uint24).max) revert NoIcons();
        isSealed = true;
        emit Sealed(icons.length);
    }

    /// @notice Sets the phase, which determines who may mint. Must be `Closed` until the collection is sealed.
    function setPhase(Phase phase_) public override {
        if (phase_ != Phase.Closed && !isSealed) revert NotSealed();
        super.setPhase(phase_);
    }

    /// @notice Returns the number of icons. They are numbered from 0.
    function iconCount() external view returns (uint256) {
        return icons.length;
    }

    /// @notice Returns an icon.
    function iconAt(uint256 icon) external view returns (Icon memory) {
        return known(icon);
    }

    /// @notice Returns the number of tokens of an icon left for sale.
    function left(uint256 icon) public view returns (uint256) {
        Icon storage it = known(icon);
        return it.supply - it.reserve - it.sold;
    }

    // ---- minting ----

    /// @notice Mints tokens of an icon to the caller while the sale is public. The payment must be exactly `quantity` times the price.
    function mint(uint256 icon, uint256 quantity) external payable {
        requirePhase(Phase.Public);
        checkQuantity(quantity);
        sell(icon, quantity);
    }

    /// @notice Mints tokens of an icon to the caller, who proves a place on the allow list by a Merkle proof.
    /// @param allowed The total number of tokens, of all icons together, that the list allows the caller to mint.
    function mintWithProof(uint256 icon, uint256 quantity, uint256 allowed, bytes32[] calldata proof) external payable {
        spendByProof(quantity, allowed, proof);
        sell(icon, quantity);
    }

    /// @notice Mints tokens of an icon to the caller, who proves a place on the allow list by a signature.
    function mintWithSignature(uint256 icon, uint256 quantity, Allowance calldata allowance, bytes calldata signature) external payable {
        spendBySignature(quantity, allowance, signature);
        sell(icon, quantity);
    }

    /// @notice Mints reserved tokens of an icon to any account, in any phase, once the collection is sealed. Only the owner.
    function mintReserve(uint256 icon, address to, uint256 quantity) external onlyOwner {
        if (!isSealed) revert NotSealed();
        checkQuantity(quantity);
        Icon storage it = known(icon);
        uint256 kept = it.reserve - it.reserveMinted;
        if (quantity > kept) revert NothingLeft(quantity, kept);
        // at most 100
        it.reserveMinted += uint32(quantity);
        hand(to, quantity, uint24(icon));
    }

    function sell(uint256 icon, uint256 quantity) private {
        Icon storage it = known(icon);
        checkPayment(quantity * it.price);
        uint256 available = left(icon);
        if (quantity > available) revert NothingLeft(quantity, available);
        it.sold += uint32(quantity);
        hand(msg.sender, quantity, uint24(icon));
    }

    function known(uint256 icon) private view returns (Icon storage) {
        if (icon >= icons.length) revert UnknownIcon(icon, icons.length);
        return icons[icon];
    }

    // ---- metadata and pictures ----

    /// @notice Returns the icon of a token.
    function iconOf(uint256 tokenId) public view returns (uint256) {
        return numberOf(tokenId);
    }

    /// @notice Returns the picture of a token.
    /// @return A Windows bitmap.
    function render(uint256 tokenId) external view returns (bytes memory) {
        return studio.render(icons[iconOf(tokenId)].scene);
    }

    /// @notice Returns the picture of an icon.
    /// @return A Windows bitmap.
    function renderIcon(uint256 icon) external view returns (bytes memory) {
        return studio.render(known(icon).scene);
    }

    /// @notice Returns an animation of the icon of a token rotating about the vertical axis, for pages that show more than `tokenURI`. Much
    /// more expensive than `tokenURI`: 14 to 60 million gas for the icons of the project.
    /// @return A `data:` URI of an animated PNG file: 12 frames of 64 x 64 pixels, enlarged as in `tokenURI`.
    function animation(uint256 tokenId) external view returns (string memory) {
        Icon storage it = icons[iconOf(tokenId)];
        Changes memory changes;
        (changes.fields, changes.canvas.width, changes.canvas.height) = (CANVAS, FRAME_SIDE, FRAME_SIDE);
        return studio.animateDataURI(it.scene, Turn(FRAMES, FRAME_TIME, it.scale, Vector(ZERO, ONE, ZERO), true), changes);
    }

    /// @notice Returns the icon of a token as a binary glTF file, for 3D viewers, in a `data:` URI.
    function model(uint256 tokenId) external view returns (string memory) {
        return studio.glbDataURI(icons[iconOf(tokenId)].scene);
    }

    /// @notice Returns the metadata of a token.
    /// @return A `data:` URI of JSON that contains the picture as a PNG.
    function tokenURI(uint256 tokenId) public view override(ERC721A, IERC721A) returns (string memory) {
        if (!_exists(tokenId)) revert URIQueryForNonexistentToken();
        Icon storage it = icons[iconOf(tokenId)];
        string memory name_ = Strings.escapeJSON(it.name);
        string memory traits = string.concat(Json.trait("Icon", name_), ",", Json.trait("Supply", uint256(it.supply)));
        string memory fields = Json.field("external_url", Json.picture(address(studio), it.scene, it.scale));
        show(Json.token(string.concat(name_, " #", tokenId.toString()), DESCRIPTION, fields, traits), it.scene, it.scale);
    }

    /// @inheritdoc Collection
    function contractURI() external view override returns (string memory) {
        if (icons.length == 0) Json.answer(Json.pictureless(name(), symbol(), DESCRIPTION));
        Icon storage it = icons[0];
        Changes memory wide;
        (wide.fields, wide.canvas.width, wide.canvas.height) = (CANVAS, Placeholder.BANNER_WIDTH, Placeholder.BANNER_HEIGHT);
        show(Json.collection(name(), symbol(), DESCRIPTION, studio.renderDataURI(it.scene, it.scale, wide)), it.scene, it.scale);
    }
}
