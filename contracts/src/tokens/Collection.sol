// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {ERC2981} from "@openzeppelin/contracts/token/common/ERC2981.sol";
import {Sale} from "./Sale.sol";

/// @param owner Who opens the sale and fetches the ether.
/// @param perTransaction The most tokens that one call mints, 1 to 100.
/// @param royaltyReceiver To whom marketplaces are to pay a part of each resale.
/// @param royalty That part, in hundredths of a percent: 0 to 1,000.
struct Terms {
    address owner;
    uint256 perTransaction;
    address royaltyReceiver;
    uint96 royalty;
}

/// @title Collection: what all collections here have in common beside their sale.
/// @notice Royalties (ERC-2981), metadata of the collection (ERC-7572), news of changed metadata (ERC-4906), and ERC-165 for all of it.
abstract contract Collection is Sale, ERC2981 {
    bytes4 internal constant ERC4906 = 0x49064906;
    /// @dev `owner` and `transferOwnership`.
    bytes4 internal constant ERC173 = 0x7f5828d0;
    uint96 internal constant HIGHEST_ROYALTY = 1000;

    /// @notice ERC-7572: the metadata of the collection has changed.
    event ContractURIUpdated();
    /// @notice ERC-4906: the metadata of these tokens has changed.
    event BatchMetadataUpdate(uint256 _fromTokenId, uint256 _toTokenId);

    error Royalty(uint256 royalty, uint256 highest);

    constructor(string memory name_, string memory symbol_, Terms memory terms)
        Sale(name_, symbol_, terms.owner, terms.perTransaction)
    {
        royalize(terms.royaltyReceiver, terms.royalty);
    }

    /// @notice Changes the royalties.
    /// @param receiver To whom they are paid.
    /// @param royalty In hundredths of a percent: 0 to 1,000.
    function setRoyalty(address receiver, uint96 royalty) external onlyOwner {
        royalize(receiver, royalty);
    }

    /// @notice ERC-7572: the metadata of the collection.
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
