// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {ERC721AQueryable} from "erc721a/contracts/extensions/ERC721AQueryable.sol";
import {IERC2981} from "@openzeppelin/contracts/interfaces/IERC2981.sol";
import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {IERC165} from "@openzeppelin/contracts/utils/introspection/IERC165.sol";
import {Studio} from "../studio/Studio.sol";
import {StudioErrors} from "../studio/StudioErrors.sol";
import {Edition} from "./Edition.sol";
import {Json} from "./Json.sol";
import {Placeholder} from "./Placeholder.sol";
import {Utf8} from "./Utf8.sol";

/// @title Editions: a collection to which anybody adds scenes, each of them an edition of tokens, limited or open.
/// @notice There is no owner. Whoever adds a scene is its artist, and has no power over the editions of others. What an edition shows,
/// costs and is called never changes; all that its artist can do later is to close it, and to withdraw what its tokens have cost.
contract Editions is ERC721AQueryable, IERC2981, StudioErrors {
    using Strings for address;
    using Strings for uint256;

    string internal constant DESCRIPTION =
        "A scene, kept and drawn by contracts: every pixel is computed on chain. Anybody can add scenes to this collection, under any "
        "name; the attribute Artist is the account that added this one. "
        "Not by the authors of the Shackled contracts of 2021, nor endorsed by them.";

    /// @notice The supply of an edition that is open until its artist closes it.
    uint32 public constant OPEN = type(uint32).max;
    /// @notice The gas in which a scene must be drawn to be added: what a transaction may use on Ethereum (EIP-7825).
    uint256 public constant DRAWING_GAS = 1 << 24;
    uint256 internal constant MAX_NAME = 64;
    uint256 internal constant HIGHEST_ROYALTY = 1000;
    /// @dev ERC-721A looks for the owner of a token among so many.
    uint256 internal constant MOST_AT_ONCE = 100;
    /// @dev Of the picture of the collection: its side in pixels, and how many pixels each of them becomes.
    uint256 internal constant SIDE = 128;
    uint256 internal constant SCALE = 4;
    /// @dev The sides of the collection's wide picture, in pixels.
    uint256 internal constant BANNER_WIDTH = 256;
    uint256 internal constant BANNER_HEIGHT = 64;

    /// @notice What keeps the scenes, and has them drawn.
    Studio public immutable studio;

    Edition[] private editions;
    /// @dev The edition of the tokens that are being minted.
    uint24 private transient minting;

    event EditionAdded(
        uint256 indexed edition,
        address indexed artist,
        address indexed scene,
        string name,
        uint256 scale,
        uint256 price,
        uint256 supply,
        uint256 royalty
    );
    /// @notice No more tokens of the edition can be minted.
    event EditionClosed(uint256 indexed edition, uint256 minted);
    event Withdrawn(address indexed artist, address indexed to, uint256 amount);

    error NoStudio(address studio);
    error UnknownEdition(uint256 edition, uint256 editions);
    error TooManyEditions(uint256 editions);
    error NameLength(uint256 length, uint256 longest);
    /// @notice The bytes of the name that begin here are no character of UTF-8.
    error NameNotUtf8(uint256 position);
    error NoSupply();
    error Royalty(uint256 royalty, uint256 highest);
    /// @notice Drawing the scene runs out of gas: it needs more than `gasLimit`, or the transaction has too little.
    error DrawingOutOfGas(address scene, uint256 gasLimit);
    error NotTheArtist(uint256 edition, address artist, address account);
    error AlreadyClosed(uint256 edition);
    error Quantity(uint256 quantity, uint256 perTransaction);
    error Payment(uint256 sent, uint256 due);
    /// @notice What was sent along with a transfer or an approval.
    error PaymentForNothing(uint256 sent);
    error NothingLeft(uint256 quantity, uint256 left);
    error WithdrawalRefused(address to, uint256 amount);

    constructor(Studio studio_) ERC721A("Shackled Editions", "SHKE") {
        if (address(studio_).code.length == 0) revert NoStudio(address(studio_));
        studio = studio_;
    }

    // ---- the artist's part ----

    /// @notice Adds an edition, whose artist is the caller. The whole picture is drawn, as `tokenURI` draws it: what cannot be drawn in
    /// `DRAWING_GAS` is refused, with the error that drawing it has.
    /// @param name_ 1 to 64 bytes of text in UTF-8.
    /// @param scene Where the studio keeps the scene.
    /// @param scale How many pixels each pixel of the scene becomes in `tokenURI`: 1 to 8; 4 makes 512 of 128.
    /// @param price Of each token, in wei.
    /// @param supply The most tokens that there will ever be, `copies` among them; `OPEN` sets no limit.
    /// @param royalty What the artist is to be paid of each resale, in hundredths of a percent: 0 to 1,000.
    /// @param copies How many tokens the artist receives at once, for nothing: 0 to 100.
    /// @return edition Its number.
    function add(
        string calldata name_,
        address scene,
        uint8 scale,
        uint96 price,
        uint32 supply,
        uint16 royalty,
        uint32 copies
    ) external returns (uint256 edition) {
        edition = editions.length;
        // the number of an edition is kept in 24 bits beside the owner of a token
        if (edition > type(uint24).max) revert TooManyEditions(edition);
        if (bytes(name_).length == 0 || bytes(name_).length > MAX_NAME) revert NameLength(bytes(name_).length, MAX_NAME);
        uint256 valid = Utf8.validLength(bytes(name_));
        if (valid != bytes(name_).length) revert NameNotUtf8(valid);
        if (supply == 0) revert NoSupply();
        if (royalty > HIGHEST_ROYALTY) revert Royalty(royalty, HIGHEST_ROYALTY);
        if (copies > MOST_AT_ONCE) revert Quantity(copies, MOST_AT_ONCE);
        if (copies > supply) revert NothingLeft(copies, supply);
        draw(scene, scale);
        editions.push(Edition(msg.sender, price, supply, copies, copies, false, royalty, scale, scene, name_));
        emit EditionAdded(edition, msg.sender, scene, name_, scale, price, supply, royalty);
        if (copies != 0) hand(edition, copies);
    }

    /// @notice Ends the minting of an edition, for ever. For its artist.
    function close(uint256 edition) external {
        Edition storage it = ofCaller(edition);
        if (it.closed) revert AlreadyClosed(edition);
        it.closed = true;
        emit EditionClosed(edition, it.minted);
    }

    /// @notice Sends what tokens of the caller's editions have cost, and was not withdrawn yet, to `to`. If `to` does not take it, nothing
    /// is lost: choose another.
    /// @return amount How much, in wei.
    function withdraw(uint256[] calldata ofEditions, address payable to) external returns (uint256 amount) {
        for (uint256 k; k < ofEditions.length; ++k) {
            Edition storage it = ofCaller(ofEditions[k]);
            amount += unsettled(it);
            it.settled = it.minted;
        }
        bool done = to != address(0);
        // no bytes of the answer are copied: nobody can make them dear
        assembly ("memory-safe") {
            if done { done := call(gas(), to, amount, 0, 0, 0, 0) }
        }
        if (!done) revert WithdrawalRefused(to, amount);
        emit Withdrawn(msg.sender, to, amount);
    }

    // ---- minting ----

    /// @notice Mints tokens of an edition to the caller. Exactly `quantity` times its price must be sent along.
    /// @param quantity 1 to 100.
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

    /// @dev A token keeps its edition, whoever owns it.
    function _extraData(address from, address, uint24 previous) internal view override returns (uint24) {
        return from == address(0) ? minting : previous;
    }

    // ---- editions ----

    /// @notice How many editions there are, numbered from 0.
    function editionCount() external view returns (uint256) {
        return editions.length;
    }

    /// @notice An edition.
    function editionAt(uint256 edition) external view returns (Edition memory) {
        return known(edition);
    }

    /// @notice The edition that a token is one of.
    function editionOf(uint256 tokenId) public view returns (uint256) {
        return _ownershipOf(tokenId).extraData;
    }

    /// @notice How many tokens of an edition can still be minted.
    function left(uint256 edition) external view returns (uint256) {
        Edition storage it = known(edition);
        return it.closed ? 0 : it.supply - it.minted;
    }

    /// @notice What the artist can withdraw of an edition, in wei.
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

    // ---- what marketplaces ask ----

    /// @notice The metadata of a token. They never change.
    /// @return A `data:` URI of JSON, the picture in it a PNG.
    function tokenURI(uint256 tokenId) public view override(ERC721A, IERC721A) returns (string memory) {
        if (!_exists(tokenId)) revert URIQueryForNonexistentToken();
        uint256 edition = editionOf(tokenId);
        Edition storage it = editions[edition];
        string memory name_ = string.concat(Strings.escapeJSON(it.name), " #", tokenId.toString());
        string memory supply = it.supply == OPEN ? "open" : uint256(it.supply).toString();
        string memory traits = string.concat(
            Json.trait("Edition", edition), ",", Json.trait("Artist", it.artist.toChecksumHexString()), ",", Json.trait("Supply", supply)
        );
        string memory fields = Json.field("external_url", Json.picture(address(studio), it.scene, it.scale));
        show(Json.token(name_, DESCRIPTION, fields, traits), drawing(it.scene, it.scale));
    }

    /// @notice ERC-7572: the metadata of the collection. Its picture is nobody's: the edges of a solid of eight faces.
    /// @return A `data:` URI of JSON.
    function contractURI() external view returns (string memory) {
        string memory banner = studio.drawDataURI(Placeholder.scene(BANNER_WIDTH, BANNER_HEIGHT), SCALE);
        bytes memory request = abi.encodeCall(Studio.drawDataURI, (Placeholder.scene(SIDE, SIDE), SCALE));
        show(Json.collection(name(), symbol(), DESCRIPTION, banner), request);
    }

    /// @notice ERC-2981: the artist of the token's edition is to be paid a part of each resale.
    function royaltyInfo(uint256 tokenId, uint256 salePrice) external view returns (address receiver, uint256 royaltyAmount) {
        Edition storage it = editions[editionOf(tokenId)];
        return (it.artist, salePrice * it.royalty / 10_000);
    }

    /// @notice ERC-165.
    function supportsInterface(bytes4 interfaceId) public view override(ERC721A, IERC721A, IERC165) returns (bool) {
        return interfaceId == type(IERC2981).interfaceId || super.supportsInterface(interfaceId);
    }

    // ---- pictures ----

    /// @dev Draws a scene, and forgets the picture.
    function draw(address scene, uint256 scale) private view {
        bytes memory request = drawing(scene, scale);
        bool done;
        uint256 answered;
        address source = address(studio);
        assembly ("memory-safe") {
            done := staticcall(DRAWING_GAS, source, add(request, 0x20), mload(request), 0, 0)
            answered := returndatasize()
            if iszero(or(done, iszero(answered))) {
                let begin := mload(0x40)
                returndatacopy(begin, 0, answered)
                revert(begin, answered)
            }
        }
        if (!done) revert DrawingOutOfGas(scene, DRAWING_GAS);
    }

    /// @dev The call of the studio that draws a scene.
    function drawing(address scene, uint256 scale) private pure returns (bytes memory) {
        return abi.encodeWithSignature("renderDataURI(address,uint256)", scene, scale);
    }

    /// @dev Ends the call with the `data:` URI of a document.
    /// @param head The document up to its picture.
    /// @param request The call of the studio that draws the picture.
    function show(bytes memory head, bytes memory request) private view {
        uint256 data;
        assembly ("memory-safe") {
            data := add(request, 0x20)
        }
        Json.answer(head, address(studio), data, request.length);
    }

    // ---- ERC-721A takes ether where none is due ----

    function approve(address to, uint256 tokenId) public payable override(ERC721A, IERC721A) {
        if (msg.value != 0) revert PaymentForNothing(msg.value);
        super.approve(to, tokenId);
    }

    function _beforeTokenTransfers(address from, address, uint256, uint256) internal view override {
        if (from != address(0) && msg.value != 0) revert PaymentForNothing(msg.value);
    }
}
