// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {ERC2981} from "@openzeppelin/contracts/token/common/ERC2981.sol";
import {Sale} from "./Sale.sol";

/// @param owner The account that controls the sale and withdraws the proceeds.
/// @param perTransaction The maximum number of tokens per call, 1..100.
/// @param royaltyReceiver The receiver of royalties.
/// @param royalty The royalty of a resale, in basis points: 0..1,000.
struct Terms {
    address owner;
    uint256 perTransaction;
    address royaltyReceiver;
    uint96 royalty;
}

/// @title Collection: the common part of the collections, on top of `Sale`.
/// @notice Royalties (ERC-2981), collection metadata (ERC-7572), metadata updates (ERC-4906), and interface detection (ERC-165).
abstract contract Collection is Sale, ERC2981 {
    bytes4 internal constant ERC4906 = 0x49064906;
    /// @dev The interface ID of ERC-173: `owner` and `transferOwnership`.
    bytes4 internal constant ERC173 = 0x7f5828d0;

    /// @notice Emitted when the metadata of the collection changes (ERC-7572).
    event ContractURIUpdated();
    /// @notice Emitted when the metadata of these tokens changes (ERC-4906).
    event BatchMetadataUpdate(uint256 _fromTokenId, uint256 _toTokenId);

    constructor(string memory name_, string memory symbol_, Terms memory terms)
        Sale(name_, symbol_, terms.owner, terms.perTransaction)
    {
        royalize(terms.royaltyReceiver, terms.royalty);
    }

    /// @notice Sets the royalties.
    /// @param receiver The receiver of royalties.
    /// @param royalty The royalty of a resale, in basis points: 0..1,000.
    function setRoyalty(address receiver, uint96 royalty) external onlyOwner {
        royalize(receiver, royalty);
    }

    /// @notice Returns the metadata of the collection (ERC-7572).
    /// @return A `data:` URI of JSON.
    function contractURI() external view virtual returns (string memory);

    /// @inheritdoc ERC2981
    function supportsInterface(bytes4 interfaceId) public view virtual override(ERC721A, IERC721A, ERC2981) returns (bool) {
        return interfaceId == ERC4906 || interfaceId == ERC173 || ERC721A.supportsInterface(interfaceId)
            || ERC2981.supportsInterface(interfaceId);
    }

    function royalize(address receiver, uint96 royalty) private {
        if (royalty > HIGHEST_ROYALTY) revert Royalty(royalty, HIGHEST_ROYALTY);
        _setDefaultRoyalty(receiver, royalty);
    }
}
