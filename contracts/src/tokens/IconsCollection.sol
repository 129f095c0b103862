// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {ZERO, ONE} from "../math/Fixed.sol";
import {Vector} from "../math/Vector.sol";
import {CANVAS, Changes} from "../studio/Changes.sol";
import {Spin} from "../studio/Spin.sol";
import {Studio} from "../studio/Studio.sol";
import {StudioErrors} from "../studio/StudioErrors.sol";
import {Collection, Terms} from "./Collection.sol";
import {Allowance} from "./Sale.sol";
import {Json} from "./Json.sol";
import {Utf8} from "./Utf8.sol";

/// @notice A kind of token.
/// @param name What it is called.
/// @param scene Where the studio keeps the scene that it shows.
/// @param scale How many pixels each pixel of the scene becomes in `tokenURI`, both ways.
/// @param price Of each token, in wei.
/// @param supply How many tokens of it there will ever be.
/// @param reserve How many of those are kept for the team.
/// @param sold How many have been sold.
/// @param reserveMinted How many of the reserve have been minted.
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

/// @title IconsCollection: a fixed set of scenes that are kept on chain, each a kind of token with a supply of its own.
/// @notice The owner adds the icons, then seals the collection: from then on no icon can be added or changed, and only then the sale opens.
/// What an icon shows is kept as the code of contracts that cannot change, and drawn by contracts that cannot change.
contract IconsCollection is Collection, StudioErrors {
    using Strings for uint256;

    string internal constant DESCRIPTION =
        "Small scenes, kept and drawn by contracts: every pixel is computed on chain. "
        "Not by the authors of the Shackled contracts of 2021, nor endorsed by them.";
    uint256 internal constant MAX_SCALE = 8;
    uint256 internal constant MAX_NAME = 64;
    /// @dev Of animations: how many frames, their sides in pixels, and how long each is shown, in milliseconds.
    uint256 internal constant FRAMES = 12;
    uint256 internal constant FRAME_SIDE = 64;
    uint256 internal constant FRAME_TIME = 100;
    /// @dev The sides of the collection's wide picture, in pixels.
    uint256 internal constant BANNER_WIDTH = 256;
    uint256 internal constant BANNER_HEIGHT = 64;

    /// @notice What keeps the scenes, and has them drawn.
    Studio public immutable studio;

    /// @notice Whether the set of icons is fixed.
    bool public isSealed;

    Icon[] private icons;
    /// @dev The icon of the tokens that are being minted.
    uint24 private transient minting;

    event IconAdded(uint256 indexed icon, string name, address scene, uint256 price, uint256 supply, uint256 reserve);
    /// @notice The set of icons is fixed now.
    event Sealed(uint256 icons);

    error NoStudio(address studio);
    error AlreadySealed();
    error NotSealed();
    error NoIcons();
    error UnknownIcon(uint256 icon, uint256 icons);
    error NameLength(uint256 length, uint256 longest);
    /// @notice The bytes of the name that begin here are no character of UTF-8.
    error NameNotUtf8(uint256 position);
    error Supply(uint256 supply, uint256 reserve);

    constructor(Studio studio_, Terms memory terms) Collection("Shackled Icons", "SHKI", terms) {
        if (address(studio_).code.length == 0) revert NoStudio(address(studio_));
        studio = studio_;
    }

    // ---- the set of icons ----

    /// @notice Adds an icon, until the collection is sealed. What cannot be drawn is refused, with the error that drawing it has. Look at
    /// it first: `studio().render(scene)`.
    /// @param name_ 1 to 64 bytes of text in UTF-8.
    /// @param scene Where the studio keeps the scene.
    /// @param scale How many pixels each pixel of the scene becomes in `tokenURI`: 1 to 8; 4 makes 512 of 128.
    /// @param price Of each token, in wei.
    /// @param supply How many tokens of it there will ever be.
    /// @param reserve How many of those are kept for the team.
    /// @return icon Its number.
    function add(string calldata name_, address scene, uint8 scale, uint96 price, uint32 supply, uint32 reserve)
        external
        onlyOwner
        returns (uint256 icon)
    {
        if (isSealed) revert AlreadySealed();
        if (bytes(name_).length == 0 || bytes(name_).length > MAX_NAME) revert NameLength(bytes(name_).length, MAX_NAME);
        uint256 valid = Utf8.validLength(bytes(name_));
        if (valid != bytes(name_).length) revert NameNotUtf8(valid);
        if (scale == 0 || scale > MAX_SCALE) revert PixelScaleOutOfRange(scale, MAX_SCALE);
        if (supply == 0 || reserve > supply) revert Supply(supply, reserve);
        studio.check(scene);
        icon = icons.length;
        icons.push(Icon(name_, scene, scale, price, supply, reserve, 0, 0));
        emit IconAdded(icon, name_, scene, price, supply, reserve);
        if (icon == 0) emit ContractURIUpdated();
    }

    /// @notice Fixes the set of icons for ever.
    function seal() external onlyOwner {
        if (isSealed) revert AlreadySealed();
        // the number of an icon is kept in 24 bits beside the owner of a token
        if (icons.length == 0 || icons.length > type(uint24).max) revert NoIcons();
        isSealed = true;
        emit Sealed(icons.length);
    }

    /// @notice Says who may mint from now on: nobody, until the collection is sealed.
    function setPhase(Phase phase_) public override {
        if (phase_ != Phase.Closed && !isSealed) revert NotSealed();
        super.setPhase(phase_);
    }

    /// @notice How many icons there are, numbered from 0.
    function iconCount() external view returns (uint256) {
        return icons.length;
    }

    /// @notice An icon.
    function iconAt(uint256 icon) external view returns (Icon memory) {
        return known(icon);
    }

    /// @notice How many tokens of an icon are left to be sold.
    function left(uint256 icon) public view returns (uint256) {
        Icon storage it = known(icon);
        return it.supply - it.reserve - it.sold;
    }

    // ---- minting ----

    /// @notice Mints tokens of an icon to the caller, while the sale is public. Exactly `quantity` times its price must be sent along.
    function mint(uint256 icon, uint256 quantity) external payable {
        requirePhase(Phase.Public);
        checkQuantity(quantity);
        sell(icon, quantity);
    }

    /// @notice Mints tokens of an icon to the caller, who is on the allow-list by a Merkle proof.
    /// @param allowed How many tokens, of all icons together, the list allows the caller to mint in all.
    function mintWithProof(uint256 icon, uint256 quantity, uint256 allowed, bytes32[] calldata proof) external payable {
        spendByProof(quantity, allowed, proof);
        sell(icon, quantity);
    }

    /// @notice Mints tokens of an icon to the caller, who is on the allow-list by a signature.
    function mintWithSignature(uint256 icon, uint256 quantity, Allowance calldata allowance, bytes calldata signature)
        external
        payable
    {
        spendBySignature(quantity, allowance, signature);
        sell(icon, quantity);
    }

    /// @notice Mints tokens of the reserve of an icon to anyone, in any phase, once the collection is sealed.
    function mintReserve(uint256 icon, address to, uint256 quantity) external onlyOwner {
        if (!isSealed) revert NotSealed();
        checkQuantity(quantity);
        Icon storage it = known(icon);
        uint256 kept = it.reserve - it.reserveMinted;
        if (quantity > kept) revert NothingLeft(quantity, kept);
        // at most 100
        it.reserveMinted += uint32(quantity);
        hand(to, icon, quantity);
    }

    function sell(uint256 icon, uint256 quantity) private {
        Icon storage it = known(icon);
        checkPayment(quantity * it.price);
        uint256 available = left(icon);
        if (quantity > available) revert NothingLeft(quantity, available);
        it.sold += uint32(quantity);
        hand(msg.sender, icon, quantity);
    }

    function hand(address to, uint256 icon, uint256 quantity) private {
        minting = uint24(icon);
        _safeMint(to, quantity);
    }

    /// @dev A token keeps its icon, whoever owns it.
    function _extraData(address from, address, uint24 previous) internal view override returns (uint24) {
        return from == address(0) ? minting : previous;
    }

    function known(uint256 icon) private view returns (Icon storage) {
        if (icon >= icons.length) revert UnknownIcon(icon, icons.length);
        return icons[icon];
    }

    // ---- what tokens show ----

    /// @notice The icon that a token is one of.
    function iconOf(uint256 tokenId) public view returns (uint256) {
        return _ownershipOf(tokenId).extraData;
    }

    /// @notice The picture of a token.
    /// @return A Windows bitmap.
    function render(uint256 tokenId) external view returns (bytes memory) {
        return studio.render(icons[iconOf(tokenId)].scene);
    }

    /// @notice The picture of an icon.
    /// @return A Windows bitmap.
    function renderIcon(uint256 icon) external view returns (bytes memory) {
        return studio.render(known(icon).scene);
    }

    /// @notice The icon of a token turning about the vertical axis, for pages that show more than `tokenURI`. Much dearer than that: the
    /// icons of the project take 14 to 60 million gas.
    /// @return A `data:` URI of an animated PNG file: 12 frames of 64 x 64 pixels, each enlarged as in `tokenURI`.
    function animation(uint256 tokenId) external view returns (string memory) {
        Icon storage it = icons[iconOf(tokenId)];
        Changes memory changes;
        (changes.fields, changes.canvas.width, changes.canvas.height) = (CANVAS, FRAME_SIDE, FRAME_SIDE);
        return studio.animateDataURI(it.scene, Spin(FRAMES, FRAME_TIME, it.scale, Vector(ZERO, ONE, ZERO), true), changes);
    }

    /// @notice The icon of a token as a model, which viewers turn: a `data:` URI of a binary glTF file.
    function model(uint256 tokenId) external view returns (string memory) {
        return studio.glbDataURI(icons[iconOf(tokenId)].scene);
    }

    /// @notice The metadata of a token.
    /// @return A `data:` URI of JSON, the picture in it a PNG.
    function tokenURI(uint256 tokenId) public view override(ERC721A, IERC721A) returns (string memory) {
        if (!_exists(tokenId)) revert URIQueryForNonexistentToken();
        Icon storage it = icons[iconOf(tokenId)];
        string memory name_ = Strings.escapeJSON(it.name);
        string memory traits = string.concat(Json.trait("Icon", name_), ",", Json.trait("Supply", uint256(it.supply)));
        string memory fields = Json.field("external_url", Json.picture(address(studio), it.scene, it.scale));
        show(Json.token(string.concat(name_, " #", tokenId.toString()), DESCRIPTION, fields, traits), it);
    }

    /// @inheritdoc Collection
    function contractURI() external view override returns (string memory) {
        if (icons.length == 0) Json.answer(Json.pictureless(name(), symbol(), DESCRIPTION));
        Icon storage it = icons[0];
        Changes memory wide;
        (wide.fields, wide.canvas.width, wide.canvas.height) = (CANVAS, BANNER_WIDTH, BANNER_HEIGHT);
        show(Json.collection(name(), symbol(), DESCRIPTION, studio.renderDataURI(it.scene, it.scale, wide)), it);
    }

    /// @dev Ends the call with the `data:` URI of a document.
    /// @param head The document up to its picture.
    function show(bytes memory head, Icon storage it) private view {
        bytes memory request = abi.encodeWithSignature("renderDataURI(address,uint256)", it.scene, it.scale);
        uint256 data;
        assembly ("memory-safe") {
            data := add(request, 0x20)
        }
        Json.answer(head, address(studio), data, request.length);
    }
}
