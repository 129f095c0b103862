// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {ERC721AQueryable} from "erc721a/contracts/extensions/ERC721AQueryable.sol";
import {IERC2981} from "@openzeppelin/contracts/interfaces/IERC2981.sol";
import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {IERC165} from "@openzeppelin/contracts/utils/introspection/IERC165.sol";
import {Studio} from "../studio/Studio.sol";
import {StudioErrors} from "../interfaces/StudioErrors.sol";
import {Edition} from "../interfaces/Edition.sol";
import {Json} from "./Json.sol";
import {Placeholder} from "./Placeholder.sol";
import {Utf8} from "./Utf8.sol";

/// @title Editions: a collection in which anyone can publish scenes as limited or open editions of tokens.
/// @notice There is no owner. The account that adds a scene is the artist of the edition, and has no power over other editions. The
/// picture, name, price, supply and royalty of an edition never change; its artist can only close it and withdraw its proceeds.
contract Editions is ERC721AQueryable, IERC2981, StudioErrors {
    using Strings for address;
    using Strings for uint256;

    string internal constant DESCRIPTION =
        "A scene, kept and drawn by contracts: every pixel is computed on chain. Anybody can add scenes to this collection, under any "
        "name; the attribute Artist is the account that added this one. "
        "Not by the authors of the Shackled contracts of 2021, nor endorsed by them.";

    /// @notice The supply value of an open edition, which has no limit until its artist closes it.
    uint32 public constant OPEN = type(uint32).max;
    /// @notice The gas limit for the metadata of a new edition: that of a transaction on Ethereum (EIP-7825).
    uint256 public constant DRAWING_GAS = 1 << 24;
    uint256 internal constant MAX_NAME = 64;
    uint256 internal constant HIGHEST_ROYALTY = 1000;
    /// @dev Bounds the number of tokens that ERC-721A scans for the owner of a token.
    uint256 internal constant MOST_AT_ONCE = 100;
    /// @dev The picture of the collection: its side in pixels, and its enlargement.
    uint256 internal constant SIDE = 128;
    uint256 internal constant SCALE = 4;
    /// @dev The width and height of the collection's banner, in pixels.
    uint256 internal constant BANNER_WIDTH = 256;
    uint256 internal constant BANNER_HEIGHT = 64;

    /// @notice The Studio, which stores and draws the scenes.
    Studio public immutable studio;

    Edition[] private editions;
    /// @dev The edition of the tokens that are being minted.
    uint24 private transient minting;

    /// @notice Emitted when an edition is added.
    event EditionAdded(
        uint256 indexed edition,
        address indexed artist,
        address indexed scene,
        string name,
        uint256 scale,
        bool model,
        uint256 price,
        uint256 supply,
        uint256 royalty
    );
    /// @notice Emitted when an edition is closed. No more of its tokens can be minted.
    event EditionClosed(uint256 indexed edition, uint256 minted);
    /// @notice Emitted when an artist withdraws proceeds, in wei.
    event Withdrawn(address indexed artist, address indexed to, uint256 amount);

    /// @notice The address has no code.
    error NoStudio(address studio);
    /// @notice The number of the edition is not below the number of editions.
    error UnknownEdition(uint256 edition, uint256 editions);
    /// @notice The maximum number of editions is reached.
    error TooManyEditions(uint256 editions);
    /// @notice The name must have 1 to `longest` bytes.
    error NameLength(uint256 length, uint256 longest);
    /// @notice The bytes of the name from this position on are not valid UTF-8.
    error NameNotUtf8(uint256 position);
    /// @notice The supply must not be 0.
    error NoSupply();
    /// @notice The royalty exceeds the highest one, in basis points.
    error Royalty(uint256 royalty, uint256 highest);
    /// @notice Drawing the scene ran out of gas: it needs more than `gasLimit`, or the transaction has too little.
    error DrawingOutOfGas(address scene, uint256 gasLimit);
    /// @notice The caller is not the artist of the edition.
    error NotTheArtist(uint256 edition, address artist, address account);
    /// @notice The edition is already closed.
    error AlreadyClosed(uint256 edition);
    /// @notice The quantity is out of range: at most `perTransaction`; for `mint`, at least 1.
    error Quantity(uint256 quantity, uint256 perTransaction);
    /// @notice The payment must be exactly `due`, in wei.
    error Payment(uint256 sent, uint256 due);
    /// @notice Transfers and approvals accept no ether.
    error PaymentForNothing(uint256 sent);
    /// @notice The quantity exceeds the number of tokens left.
    error NothingLeft(uint256 quantity, uint256 left);
    /// @notice The receiver did not accept the ether.
    error WithdrawalRefused(address to, uint256 amount);

    constructor(Studio studio_) ERC721A("Shackled Editions", "SHKE") {
        if (address(studio_).code.length == 0) revert NoStudio(address(studio_));
        studio = studio_;
    }

    // ---- artists ----

    /// @notice Adds an edition whose artist is the caller. Draws the whole picture, as `tokenURI` does, and reverts with the error of the
    /// drawing if it fails, or if it needs more gas than `DRAWING_GAS`.
    /// @param name_ The name: 1 to 64 bytes of UTF-8.
    /// @param scene The pointer to the scene, as the Studio returned it.
    /// @param scale The enlargement of the picture in `tokenURI`, 1..8: each pixel becomes a square of `scale` x `scale` pixels.
    /// @param model Whether the metadata contains the scene as a GLB model, in `animation_url`.
    /// @param price The price of a token, in wei.
    /// @param supply The maximum number of tokens, including `copies`; `OPEN` for no limit.
    /// @param royalty The royalty of a resale, in basis points: 0..1,000.
    /// @param copies The number of tokens minted to the artist for free, 0..100.
    /// @return edition The number of the edition.
    function add(
        string calldata name_,
        address scene,
        uint8 scale,
        bool model,
        uint96 price,
        uint32 supply,
        uint16 royalty,
        uint32 copies
    ) external returns (uint256 edition) {
        edition = editions.length;
        // the number of an edition is stored in 24 bits next to the owner of a token
        if (edition > type(uint24).max) revert TooManyEditions(edition);
        if (bytes(name_).length == 0 || bytes(name_).length > MAX_NAME) revert NameLength(bytes(name_).length, MAX_NAME);
        uint256 valid = Utf8.validLength(bytes(name_));
        if (valid != bytes(name_).length) revert NameNotUtf8(valid);
        if (supply == 0) revert NoSupply();
        if (royalty > HIGHEST_ROYALTY) revert Royalty(royalty, HIGHEST_ROYALTY);
        if (copies > MOST_AT_ONCE) revert Quantity(copies, MOST_AT_ONCE);
        if (copies > supply) revert NothingLeft(copies, supply);
        editions.push(Edition(msg.sender, price, supply, copies, copies, false, royalty, scale, model, scene, name_));
        draw(edition, scene);
        emit EditionAdded(edition, msg.sender, scene, name_, scale, model, price, supply, royalty);
        if (copies != 0) hand(edition, copies);
    }

    /// @notice Closes an edition permanently. Only its artist.
    function close(uint256 edition) external {
        Edition storage it = ofCaller(edition);
        if (it.closed) revert AlreadyClosed(edition);
        it.closed = true;
        emit EditionClosed(edition, it.minted);
    }

    /// @notice Sends the unwithdrawn proceeds of the caller's editions to `to`. Reverts if `to` does not accept them; nothing is lost, and
    /// another address can be used.
    /// @return amount The amount sent, in wei.
    function withdraw(uint256[] calldata ofEditions, address payable to) external returns (uint256 amount) {
        for (uint256 k; k < ofEditions.length; ++k) {
            Edition storage it = ofCaller(ofEditions[k]);
            amount += unsettled(it);
            it.settled = it.minted;
        }
        bool done = to != address(0);
        // copies no return data, so a receiver cannot make the call expensive
        assembly ("memory-safe") {
            if done { done := call(gas(), to, amount, 0, 0, 0, 0) }
        }
        if (!done) revert WithdrawalRefused(to, amount);
        emit Withdrawn(msg.sender, to, amount);
    }

    // ---- minting ----

    /// @notice Mints tokens of an edition to the caller. The payment must be exactly `quantity` times the price.
    /// @param quantity 1..100.
    function mint(uint256 edition, uint256 quantity) external payable {
        Edition storage it = known(edition);
        if (quantity == 0 || quantity > MOST_AT_ONCE) revert Quantity(quantity, MOST_AT_ONCE);
        uint256 due = quantity * it.price;
        if (msg.value != due) revert Payment(msg.value, due);
        if (it.closed) revert AlreadyClosed(edition);
        uint256 available = it.supply - it.minted;
        if (quantity > available) revert NothingLeft(quantity, available);
        it.minted += uint32(quantity);
        hand(edition, quantity);
    }

    function hand(uint256 edition, uint256 quantity) private {
        minting = uint24(edition);
        _safeMint(msg.sender, quantity);
    }

    /// @dev Keeps the edition of a token across transfers.
    function _extraData(address from, address, uint24 previous) internal view override returns (uint24) {
        return from == address(0) ? minting : previous;
    }

    // ---- editions ----

    /// @notice Returns the number of editions. They are numbered from 0.
    function editionCount() external view returns (uint256) {
        return editions.length;
    }

    /// @notice Returns an edition.
    function editionAt(uint256 edition) external view returns (Edition memory) {
        return known(edition);
    }

    /// @notice Returns the edition of a token.
    function editionOf(uint256 tokenId) public view returns (uint256) {
        return _ownershipOf(tokenId).extraData;
    }

    /// @notice Returns how many tokens of an edition can still be minted.
    function left(uint256 edition) external view returns (uint256) {
        Edition storage it = known(edition);
        return it.closed ? 0 : it.supply - it.minted;
    }

    /// @notice Returns the amount that the artist can withdraw from an edition, in wei.
    function proceeds(uint256 edition) external view returns (uint256) {
        return unsettled(known(edition));
    }

    function unsettled(Edition storage it) private view returns (uint256) {
        return uint256(it.minted - it.settled) * it.price;
    }

    function known(uint256 edition) private view returns (Edition storage) {
        if (edition >= editions.length) revert UnknownEdition(edition, editions.length);
        return editions[edition];
    }

    function ofCaller(uint256 edition) private view returns (Edition storage it) {
        it = known(edition);
        if (it.artist != msg.sender) revert NotTheArtist(edition, it.artist, msg.sender);
    }

    // ---- metadata and royalties ----

    /// @notice Returns the metadata of a token, which never changes.
    /// @return A `data:` URI of JSON that contains the picture as a PNG.
    function tokenURI(uint256 tokenId) public view override(ERC721A, IERC721A) returns (string memory) {
        if (!_exists(tokenId)) revert URIQueryForNonexistentToken();
        showEdition(editionOf(tokenId), string.concat(" #", tokenId.toString()));
    }

    /// @notice Returns the metadata of an edition: that of its tokens, without a number in the name.
    /// @return A `data:` URI of JSON that contains the picture as a PNG.
    function editionURI(uint256 edition) external view returns (string memory) {
        known(edition);
        showEdition(edition, "");
    }

    /// @notice Returns the metadata of the collection (ERC-7572). Its picture is a fixed octahedron wireframe.
    /// @return A `data:` URI of JSON.
    function contractURI() external view returns (string memory) {
        string memory banner = studio.drawDataURI(Placeholder.scene(BANNER_WIDTH, BANNER_HEIGHT), SCALE);
        bytes memory request = abi.encodeCall(Studio.drawDataURI, (Placeholder.scene(SIDE, SIDE), SCALE));
        show(Json.collection(name(), symbol(), DESCRIPTION, banner), request);
    }

    /// @notice Returns the royalty of a resale (ERC-2981), which goes to the artist of the token's edition.
    function royaltyInfo(uint256 tokenId, uint256 salePrice) external view returns (address receiver, uint256 royaltyAmount) {
        Edition storage it = editions[editionOf(tokenId)];
        return (it.artist, salePrice * it.royalty / 10_000);
    }

    /// @notice Returns whether the contract implements an interface (ERC-165).
    function supportsInterface(bytes4 interfaceId) public view override(ERC721A, IERC721A, IERC165) returns (bool) {
        return interfaceId == type(IERC2981).interfaceId || super.supportsInterface(interfaceId);
    }

    // ---- pictures ----

    /// @dev Computes the metadata of an edition and discards it. Reverts as the drawing does.
    function draw(uint256 edition, address scene) private view {
        bytes memory request = abi.encodeCall(this.editionURI, (edition));
        uint256 available = gasleft();
        bool done;
        uint256 answered;
        assembly ("memory-safe") {
            done := staticcall(DRAWING_GAS, address(), add(request, 0x20), mload(request), 0, 0)
            answered := returndatasize()
            if iszero(or(done, iszero(answered))) {
                let begin := mload(0x40)
                returndatacopy(begin, 0, answered)
                revert(begin, answered)
            }
        }
        if (done) return;
        // bytes that cannot be decoded as a scene also revert without data, but use little gas
        uint256 limit = available < DRAWING_GAS ? available : DRAWING_GAS;
        if (available - gasleft() < limit / 2) revert NotAScene(scene);
        revert DrawingOutOfGas(scene, DRAWING_GAS);
    }

    /// @dev Ends the call with the metadata of an edition.
    /// @param suffix The end of the name.
    function showEdition(uint256 edition, string memory suffix) private view {
        Edition storage it = editions[edition];
        string memory name_ = string.concat(Strings.escapeJSON(it.name), suffix);
        string memory supply = it.supply == OPEN ? "open" : uint256(it.supply).toString();
        string memory traits = string.concat(
            Json.trait("Edition", edition), ",", Json.trait("Artist", it.artist.toChecksumHexString()), ",", Json.trait("Supply", supply)
        );
        string memory fields = Json.field("external_url", Json.picture(address(studio), it.scene, it.scale));
        if (it.model) fields = string.concat(fields, Json.field("animation_url", studio.glbDataURI(it.scene)));
        bytes memory request = abi.encodeWithSignature("renderDataURI(address,uint256)", it.scene, it.scale);
        show(Json.token(name_, DESCRIPTION, fields, traits), request);
    }

    /// @dev Ends the call with the `data:` URI of a document.
    /// @param head The document up to its picture.
    /// @param request The calldata with which the Studio draws the picture.
    function show(bytes memory head, bytes memory request) private view {
        uint256 data;
        assembly ("memory-safe") {
            data := add(request, 0x20)
        }
        Json.answer(head, address(studio), data, request.length);
    }

    // ---- ERC-721A's payable functions ----

    function approve(address to, uint256 tokenId) public payable override(ERC721A, IERC721A) {
        if (msg.value != 0) revert PaymentForNothing(msg.value);
        super.approve(to, tokenId);
    }

    function _beforeTokenTransfers(address from, address, uint256, uint256) internal view override {
        if (from != address(0) && msg.value != 0) revert PaymentForNothing(msg.value);
    }
}
