// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Edition} from "./Edition.sol";
import {IWithStudio} from "./IWithStudio.sol";
import {TokenErrors} from "./TokenErrors.sol";

/// @title IEditionsCore: what Editions adds to ERC-721. Anyone can publish scenes as limited or open editions of tokens.
/// @notice There is no owner. The account that adds a scene is the artist of the edition, and has no power over other editions. The
/// picture, name, price, supply and royalty of an edition never change; its artist can only close it and withdraw its proceeds.
interface IEditionsCore is IWithStudio, TokenErrors {
    /// @notice Emitted when an edition is added.
    event EditionAdded(
        uint256 indexed edition, address indexed artist, address indexed scene, string name, uint256 scale, bool model, uint256 price,
        uint256 supply, uint256 royalty
    );
    /// @notice Emitted when an edition is closed. No more of its tokens can be minted.
    event EditionClosed(uint256 indexed edition, uint256 minted);
    /// @notice Emitted when an artist withdraws proceeds, in wei.
    event Withdrawn(address indexed artist, address indexed to, uint256 amount);

    /// @notice The number of the edition is not below the number of editions.
    error UnknownEdition(uint256 edition, uint256 editions);
    /// @notice The maximum number of editions is reached.
    error TooManyEditions(uint256 editions);
    /// @notice The supply must not be 0.
    error NoSupply();
    /// @notice Drawing the scene ran out of gas: it needs more than `gasLimit`, or the transaction has too little.
    error DrawingOutOfGas(address scene, uint256 gasLimit);
    /// @notice The caller is not the artist of the edition.
    error NotTheArtist(uint256 edition, address artist, address account);
    /// @notice The edition is already closed.
    error AlreadyClosed(uint256 edition);

    /// @notice Returns the supply value of an open edition, which has no limit until its artist closes it.
    function OPEN() external view returns (uint32);

    /// @notice Returns the gas limit for the metadata of a new edition: that of a transaction on Ethereum (EIP-7825).
    function DRAWING_GAS() external view returns (uint256);

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
        string calldata name_, address scene, uint8 scale, bool model, uint96 price, uint32 supply, uint16 royalty, uint32 copies
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
}
