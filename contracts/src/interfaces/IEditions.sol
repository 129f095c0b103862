// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {IEditionsCore} from "./IEditionsCore.sol";

/// @title IEditions: a collection in which anyone can publish scenes as limited or open editions of tokens.
/// @notice `IEditionsCore` has its own functions, events and errors; here are those of ERC-721, as implemented by ERC-721A, which the
/// contract takes from that library.
interface IEditions is IEditionsCore {
    /// @notice Declared by the library that formats addresses as text. Never thrown.
    error StringsInsufficientHexLength(uint256 value, uint256 length);

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
