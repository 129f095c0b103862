// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {IERC2981} from "@openzeppelin/contracts/interfaces/IERC2981.sol";
import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {Edition} from "../interfaces/Edition.sol";
import {IEditionsCore} from "../interfaces/IEditionsCore.sol";
import {IStudio} from "../interfaces/IStudio.sol";
import {Json} from "./Json.sol";
import {Placeholder} from "./Placeholder.sol";
import {Token} from "./Token.sol";
import {WithStudio} from "./WithStudio.sol";

/// @title Editions: a collection in which anyone can publish scenes as limited or open editions of tokens.
/// @notice There is no owner. The account that adds a scene is the artist of the edition, and has no power over other editions. The
/// picture, name, price, supply and royalty of an edition never change; its artist can only close it and withdraw its proceeds.
contract Editions is Token, WithStudio, IEditionsCore {
    using Strings for address;
    using Strings for uint256;

    string internal constant DESCRIPTION =
        "A scene, kept and drawn by contracts: every pixel is computed on chain. Anybody can add scenes to this collection, under any "
        "name; the attribute Artist is the account that added this one. "
        "Not by the authors of the Shackled contracts of 2021, nor endorsed by them.";

    uint32 public constant OPEN = type(uint32).max;
    uint256 public constant DRAWING_GAS = 1 << 24;
    /// @dev Bounds the number of tokens that ERC-721A scans for the owner of a token.
    uint256 internal constant MOST_AT_ONCE = 100;
    /// @dev The picture of the collection: its side in pixels, and its enlargement.
    uint256 internal constant SIDE = 128;
    uint256 internal constant SCALE = 4;

    Edition[] private editions;

    constructor(IStudio studio_) ERC721A("Shackled Editions", "SHKE") WithStudio(studio_) {}

    // ---- artists ----

    function add(
        string calldata name_, address scene, uint8 scale, bool model, uint96 price, uint32 supply, uint16 royalty, uint32 copies
    ) external returns (uint256 edition) {
        edition = editions.length;
        // the number of an edition is stored in 24 bits next to the owner of a token
        if (edition > type(uint24).max) revert TooManyEditions(edition);
        checkName(name_);
        if (supply == 0) revert NoSupply();
        if (royalty > HIGHEST_ROYALTY) revert Royalty(royalty, HIGHEST_ROYALTY);
        if (copies > MOST_AT_ONCE) revert Quantity(copies, MOST_AT_ONCE);
        if (copies > supply) revert NothingLeft(copies, supply);
        editions.push(Edition(msg.sender, price, supply, copies, copies, false, royalty, scale, model, scene, name_));
        draw(edition, scene);
        emit EditionAdded(edition, msg.sender, scene, name_, scale, model, price, supply, royalty);
        if (copies != 0) hand(msg.sender, copies, uint24(edition));
    }

    function close(uint256 edition) external {
        Edition storage it = ofCaller(edition);
        if (it.closed) revert AlreadyClosed(edition);
        it.closed = true;
        emit EditionClosed(edition, it.minted);
    }

    function withdraw(uint256[] calldata ofEditions, address payable to) external returns (uint256 amount) {
        for (uint256 k; k < ofEditions.length; ++k) {
            Edition storage it = ofCaller(ofEditions[k]);
            amount += unsettled(it);
            it.settled = it.minted;
        }
        pay(to, amount);
        emit Withdrawn(msg.sender, to, amount);
    }

    // ---- minting ----

    function mint(uint256 edition, uint256 quantity) external payable {
        Edition storage it = known(edition);
        if (quantity == 0 || quantity > MOST_AT_ONCE) revert Quantity(quantity, MOST_AT_ONCE);
        uint256 due = quantity * it.price;
        if (msg.value != due) revert Payment(msg.value, due);
        if (it.closed) revert AlreadyClosed(edition);
        uint256 available = it.supply - it.minted;
        if (quantity > available) revert NothingLeft(quantity, available);
        it.minted += uint32(quantity);
        hand(msg.sender, quantity, uint24(edition));
    }

    // ---- editions ----

    function editionCount() external view returns (uint256) {
        return editions.length;
    }

    function editionAt(uint256 edition) external view returns (Edition memory) {
        return known(edition);
    }

    function editionOf(uint256 tokenId) public view returns (uint256) {
        return numberOf(tokenId);
    }

    function left(uint256 edition) external view returns (uint256) {
        Edition storage it = known(edition);
        return it.closed ? 0 : it.supply - it.minted;
    }

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

    function editionURI(uint256 edition) external view returns (string memory) {
        known(edition);
        showEdition(edition, "");
    }

    function contractURI() external view returns (string memory) {
        string memory banner = studio.drawDataURI(Placeholder.scene(Placeholder.BANNER_WIDTH, Placeholder.BANNER_HEIGHT), SCALE);
        bytes memory request = abi.encodeCall(IStudio.drawDataURI, (Placeholder.scene(SIDE, SIDE), SCALE));
        show(Json.collection(name(), symbol(), DESCRIPTION, banner), request);
    }

    function royaltyInfo(uint256 tokenId, uint256 salePrice) external view returns (address receiver, uint256 royaltyAmount) {
        Edition storage it = editions[editionOf(tokenId)];
        return (it.artist, salePrice * it.royalty / 10_000);
    }

    /// @notice Returns whether the contract implements an interface (ERC-165).
    function supportsInterface(bytes4 interfaceId) public view override(ERC721A, IERC721A) returns (bool) {
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
        show(Json.token(name_, DESCRIPTION, fields, traits), it.scene, it.scale);
    }
}
