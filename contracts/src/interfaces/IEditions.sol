// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {StudioErrors} from "./StudioErrors.sol";
import {Edition} from "./Edition.sol";
import {IStudio} from "./IStudio.sol";

/// @title IEditions: a collection in which anyone can publish scenes as limited or open editions of tokens.
/// @notice There is no owner. The account that adds a scene is the artist of the edition, and has no power over other editions. The
/// picture, name, price, supply and royalty of an edition never change; its artist can only close it and withdraw its proceeds.
interface IEditions is StudioErrors {
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
    /// @notice Declared by the library that formats addresses as text. Never thrown.
    error StringsInsufficientHexLength(uint256 value, uint256 length);

    /// @notice Returns the supply value of an open edition, which has no limit until its artist closes it.
    function OPEN() external view returns (uint32);

    /// @notice Returns the gas limit for the metadata of a new edition: that of a transaction on Ethereum (EIP-7825).
    function DRAWING_GAS() external view returns (uint256);

    /// @notice Returns the Studio, which stores and draws the scenes.
    function studio() external view returns (IStudio);

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
    ) external returns (uint256 edition);

    /// @notice Closes an edition permanently. Only its artist.
    function close(uint256 edition) external;

    /// @notice Sends the unwithdrawn proceeds of the caller's editions to `to`. Reverts if `to` does not accept them; nothing is lost, and
    /// another address can be used.
    /// @return amount The amount sent, in wei.
    function withdraw(uint256[] calldata ofEditions, address payable to) external returns (uint256 amount);

    /// @notice Mints tokens of an edition to the caller. The payment must be exactly `quantity` times the price.
    /// @param quantity 1..100.
    function mint(uint256 edition, uint256 quantity) external payable;

    /// @notice Returns the number of editions. They are numbered from 0.
    function editionCount() external view returns (uint256);

    /// @notice Returns an edition.
    function editionAt(uint256 edition) external view returns (Edition memory);

    /// @notice Returns the edition of a token.
    function editionOf(uint256 tokenId) external view returns (uint256);

    /// @notice Returns how many tokens of an edition can still be minted.
    function left(uint256 edition) external view returns (uint256);

    /// @notice Returns the amount that the artist can withdraw from an edition, in wei.
    function proceeds(uint256 edition) external view returns (uint256);

    /// @notice Returns the metadata of an edition: that of its tokens, without a number in the name.
    /// @return A `data:` URI of JSON that contains the picture as a PNG.
    function editionURI(uint256 edition) external view returns (string memory);

    /// @notice Returns the metadata of the collection (ERC-7572). Its picture is a fixed octahedron wireframe.
    /// @return A `data:` URI of JSON.
    function contractURI() external view returns (string memory);

    /// @notice Returns the royalty of a resale (ERC-2981), which goes to the artist of the token's edition.
    function royaltyInfo(uint256 tokenId, uint256 salePrice) external view returns (address receiver, uint256 royaltyAmount);

    // ---- ERC-721, as implemented by ERC-721A ----

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

    /// @notice The start of the range is not less than its end.
    error InvalidQueryRange();

    /// @param addr The owner of the token.
    /// @param startTimestamp The Unix time at which the ownership began.
    /// @param burned Always false.
    /// @param extraData The number of the edition.
    struct TokenOwnership {
        address addr;
        uint64 startTimestamp;
        bool burned;
        uint24 extraData;
    }

    /// @notice Returns the owner of a token and the start of the ownership; all zero if the token does not exist.
    function explicitOwnershipOf(uint256 tokenId) external view returns (TokenOwnership memory);

    /// @notice Returns the ownership of several tokens.
    function explicitOwnershipsOf(uint256[] calldata tokenIds) external view returns (TokenOwnership[] memory);

    /// @notice Returns the tokens of an account. The gas grows with the total supply, which anyone can raise by minting,
    /// beyond what a node allows for a call: use `tokensOfOwnerIn`, range by range.
    function tokensOfOwner(address owner) external view returns (uint256[] memory);

    /// @notice Returns the tokens of an account in the range from `start` (inclusive) to `stop` (exclusive).
    function tokensOfOwnerIn(address owner, uint256 start, uint256 stop) external view returns (uint256[] memory);

    /// @notice Returns the number of tokens. They are numbered from 0, and cannot be burned.
    function totalSupply() external view returns (uint256);

    /// @notice Returns whether the contract implements an interface (ERC-165).
    function supportsInterface(bytes4 interfaceId) external view returns (bool);

    /// @notice Returns the number of tokens of an account.
    function balanceOf(address owner) external view returns (uint256 balance);

    /// @notice Returns the owner of a token.
    function ownerOf(uint256 tokenId) external view returns (address owner);

    /// @notice Transfers a token. A receiver with code must accept it. Accepts no ether.
    function safeTransferFrom(address from, address to, uint256 tokenId, bytes calldata data) external payable;

    /// @notice As above, without data.
    function safeTransferFrom(address from, address to, uint256 tokenId) external payable;

    /// @notice Transfers a token without calling the receiver. Accepts no ether.
    function transferFrom(address from, address to, uint256 tokenId) external payable;

    /// @notice Approves an account to transfer a token once. Accepts no ether.
    function approve(address to, uint256 tokenId) external payable;

    /// @notice Approves or revokes an operator for all tokens of the caller.
    function setApprovalForAll(address operator, bool approved) external;

    /// @notice Returns the account approved for a token; zero if there is none.
    function getApproved(uint256 tokenId) external view returns (address operator);

    /// @notice Returns whether an account is an operator for all tokens of another account.
    function isApprovedForAll(address owner, address operator) external view returns (bool);

    /// @notice Returns the name of the collection.
    function name() external view returns (string memory);

    /// @notice Returns the symbol of the collection.
    function symbol() external view returns (string memory);

    /// @notice Returns the metadata of a token, which never changes.
    /// @return A `data:` URI of JSON that contains the picture as a PNG.
    function tokenURI(uint256 tokenId) external view returns (string memory);
}
