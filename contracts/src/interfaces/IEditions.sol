// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {StudioErrors} from "../studio/StudioErrors.sol";
import {Edition} from "../tokens/Edition.sol";
import {IStudio} from "./IStudio.sol";

/// @title IEditions: a collection to which anybody adds scenes, each of them an edition of tokens, limited or open.
/// @notice There is no owner. Whoever adds a scene is its artist, and has no power over the editions of others. What an edition shows,
/// costs and is called never changes; all that its artist can do later is to close it, and to withdraw what its tokens have cost.
interface IEditions is StudioErrors {
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
    /// @notice Of the library that writes addresses as text: never thrown.
    error StringsInsufficientHexLength(uint256 value, uint256 length);

    /// @notice The supply of an edition that is open until its artist closes it.
    function OPEN() external view returns (uint32);

    /// @notice The gas in which a scene must be drawn to be added: what a transaction may use on Ethereum (EIP-7825).
    function DRAWING_GAS() external view returns (uint256);

    /// @notice What keeps the scenes, and has them drawn.
    function studio() external view returns (IStudio);

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
    ) external returns (uint256 edition);

    /// @notice Ends the minting of an edition, for ever. For its artist.
    function close(uint256 edition) external;

    /// @notice Sends what tokens of the caller's editions have cost, and was not withdrawn yet, to `to`. If `to` does not take it, nothing
    /// is lost: choose another.
    /// @return amount How much, in wei.
    function withdraw(uint256[] calldata ofEditions, address payable to) external returns (uint256 amount);

    /// @notice Mints tokens of an edition to the caller. Exactly `quantity` times its price must be sent along.
    /// @param quantity 1 to 100.
    function mint(uint256 edition, uint256 quantity) external payable;

    /// @notice How many editions there are, numbered from 0.
    function editionCount() external view returns (uint256);

    /// @notice An edition.
    function editionAt(uint256 edition) external view returns (Edition memory);

    /// @notice The edition that a token is one of.
    function editionOf(uint256 tokenId) external view returns (uint256);

    /// @notice How many tokens of an edition can still be minted.
    function left(uint256 edition) external view returns (uint256);

    /// @notice What the artist can withdraw of an edition, in wei.
    function proceeds(uint256 edition) external view returns (uint256);

    /// @notice ERC-7572: the metadata of the collection. Its picture is nobody's: the edges of a solid of eight faces.
    /// @return A `data:` URI of JSON.
    function contractURI() external view returns (string memory);

    /// @notice ERC-2981: the artist of the token's edition is to be paid a part of each resale.
    function royaltyInfo(uint256 tokenId, uint256 salePrice) external view returns (address receiver, uint256 royaltyAmount);

    // ---- ERC-721, as ERC-721A has it ----

    event Transfer(address indexed from, address indexed to, uint256 indexed tokenId);
    event Approval(address indexed owner, address indexed approved, uint256 indexed tokenId);
    event ApprovalForAll(address indexed owner, address indexed operator, bool approved);
    event ConsecutiveTransfer(uint256 indexed fromTokenId, uint256 toTokenId, address indexed from, address indexed to);

    error ApprovalCallerNotOwnerNorApproved();
    error ApprovalQueryForNonexistentToken();
    error BalanceQueryForZeroAddress();
    error MintERC2309QuantityExceedsLimit();
    error MintToZeroAddress();
    error MintZeroQuantity();
    error NotCompatibleWithSpotMints();
    error OwnerQueryForNonexistentToken();
    error OwnershipNotInitializedForExtraData();
    error SequentialMintExceedsLimit();
    error SequentialUpToTooSmall();
    error SpotMintTokenIdTooSmall();
    error TokenAlreadyExists();
    error TransferCallerNotOwnerNorApproved();
    error TransferFromIncorrectOwner();
    error TransferToNonERC721ReceiverImplementer();
    error TransferToZeroAddress();
    error URIQueryForNonexistentToken();

    /// @notice The first token of the range is not before the last.
    error InvalidQueryRange();

    /// @param addr Who has the token.
    /// @param startTimestamp Since when, in Unix time.
    /// @param burned Never.
    /// @param extraData The edition.
    struct TokenOwnership {
        address addr;
        uint64 startTimestamp;
        bool burned;
        uint24 extraData;
    }

    /// @notice Who has a token and since when; all zero if there is no such token.
    function explicitOwnershipOf(uint256 tokenId) external view returns (TokenOwnership memory);

    /// @notice The same of several.
    function explicitOwnershipsOf(uint256[] calldata tokenIds) external view returns (TokenOwnership[] memory);

    /// @notice The tokens of an account. The gas grows with all tokens: it is meant for reading.
    function tokensOfOwner(address owner) external view returns (uint256[] memory);

    /// @notice The same among the tokens from `start` to before `stop`.
    function tokensOfOwnerIn(address owner, uint256 start, uint256 stop) external view returns (uint256[] memory);

    /// @notice How many tokens there are, numbered from 0. None can be burned.
    function totalSupply() external view returns (uint256);

    /// @notice ERC-165.
    function supportsInterface(bytes4 interfaceId) external view returns (bool);

    /// @notice How many tokens an account has.
    function balanceOf(address owner) external view returns (uint256 balance);

    /// @notice Who has a token.
    function ownerOf(uint256 tokenId) external view returns (address owner);

    /// @notice Transfers a token; a contract must accept it. No ether must be sent along.
    function safeTransferFrom(address from, address to, uint256 tokenId, bytes calldata data) external payable;

    /// @notice The same without data.
    function safeTransferFrom(address from, address to, uint256 tokenId) external payable;

    /// @notice Transfers a token, whether the receiver accepts it or not. No ether must be sent along.
    function transferFrom(address from, address to, uint256 tokenId) external payable;

    /// @notice Allows an account to transfer a token, once. No ether must be sent along.
    function approve(address to, uint256 tokenId) external payable;

    /// @notice Allows an account to transfer all tokens of the caller, or forbids it.
    function setApprovalForAll(address operator, bool approved) external;

    /// @notice Who may transfer a token beside its owner; zero for nobody.
    function getApproved(uint256 tokenId) external view returns (address operator);

    /// @notice Whether an account may transfer all tokens of another one.
    function isApprovedForAll(address owner, address operator) external view returns (bool);

    /// @notice What the collection is called.
    function name() external view returns (string memory);

    /// @notice The same in short.
    function symbol() external view returns (string memory);

    /// @notice The metadata of a token. They never change.
    /// @return A `data:` URI of JSON, the picture in it a PNG.
    function tokenURI(uint256 tokenId) external view returns (string memory);
}
