// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {forward} from "../encode/Forward.sol";
import {Genesis} from "../genesis/Genesis.sol";
import {Traits} from "../genesis/Piece.sol";
import {Collection, Terms} from "./Collection.sol";
import {Allowance} from "./Sale.sol";
import {GenesisMetadata} from "./GenesisMetadata.sol";
import {Rounds} from "./Rounds.sol";

/// @title GenesisCollection: 1024 pictures, each made on chain from a seed that nobody could choose.
/// @notice A token keeps the round in which it was minted. The randomness of the round comes at least 128 blocks later (`Rounds`); with
/// the number of the token it gives the seed, and the seed gives the picture, by contracts that nobody can change.
contract GenesisCollection is Collection, Rounds {
    /// @notice How many tokens there will ever be, numbered from 0.
    uint256 public constant SUPPLY = 1024;

    /// @notice What makes metadata of seeds.
    GenesisMetadata public immutable metadata;
    /// @notice What makes pieces of seeds, and pictures of pieces.
    Genesis public immutable genesis;
    /// @notice Of each token, in wei.
    uint256 public immutable price;
    /// @notice How many tokens are kept for the team.
    uint256 public immutable reserve;

    /// @notice How many of those have been minted.
    uint256 public reserveMinted;

    error NoMetadata(address metadata);
    error Reserve(uint256 reserve, uint256 supply);
    /// @notice The round of the token is not revealed yet: see `blockOf`, `reveal`.
    error NotRevealed(uint256 tokenId, uint256 round);

    /// @param metadata_ What makes metadata of seeds, and knows what makes pictures of them.
    /// @param price_ Of each token, in wei.
    /// @param reserve_ How many tokens are kept for the team.
    constructor(GenesisMetadata metadata_, uint256 price_, uint256 reserve_, Terms memory terms)
        Collection("Shackled Genesis", "SHKG", terms)
    {
        if (address(metadata_).code.length == 0) revert NoMetadata(address(metadata_));
        if (reserve_ > SUPPLY) revert Reserve(reserve_, SUPPLY);
        (metadata, genesis) = (metadata_, metadata_.genesis());
        (price, reserve) = (price_, reserve_);
    }

    // ---- minting ----

    /// @notice Mints tokens to the caller, while the sale is public. Exactly `quantity * price` must be sent along.
    function mint(uint256 quantity) external payable {
        requirePhase(Phase.Public);
        checkQuantity(quantity);
        sell(quantity);
    }

    /// @notice Mints tokens to the caller, who is on the allow-list by a Merkle proof.
    /// @param allowed How many tokens the list allows the caller to mint in all.
    function mintWithProof(uint256 quantity, uint256 allowed, bytes32[] calldata proof) external payable {
        spendByProof(quantity, allowed, proof);
        sell(quantity);
    }

    /// @notice Mints tokens to the caller, who is on the allow-list by a signature.
    function mintWithSignature(uint256 quantity, Allowance calldata allowance, bytes calldata signature) external payable {
        spendBySignature(quantity, allowance, signature);
        sell(quantity);
    }

    /// @notice Mints tokens of the reserve to anyone, in any phase.
    function mintReserve(address to, uint256 quantity) external onlyOwner {
        checkQuantity(quantity);
        uint256 unminted = reserve - reserveMinted;
        if (quantity > unminted) revert NothingLeft(quantity, unminted);
        reserveMinted += quantity;
        _safeMint(to, quantity);
    }

    /// @notice How many tokens are left to be sold.
    function left() public view returns (uint256) {
        return SUPPLY - (reserve - reserveMinted) - _totalMinted();
    }

    function sell(uint256 quantity) private {
        checkPayment(quantity * price);
        uint256 available = left();
        if (quantity > available) revert NothingLeft(quantity, available);
        _safeMint(msg.sender, quantity);
    }

    /// @dev A token keeps the round of its mint, whoever owns it.
    function _extraData(address from, address, uint24 previous) internal view override returns (uint24) {
        return from == address(0) ? roundToKeep() : previous;
    }

    // ---- revealing ----

    /// @notice The round in which a token was minted.
    function roundOf(uint256 tokenId) public view returns (uint256) {
        return _ownershipOf(tokenId).extraData;
    }

    /// @notice The rounds of tokens `first` to `last` that are not revealed, each once; such as `reveal` takes, once their blocks are
    /// there.
    function hiddenRounds(uint256 first, uint256 last) external view returns (uint256[] memory rounds) {
        rounds = new uint256[](last - first + 1);
        uint256 count;
        for (uint256 tokenId = first; tokenId <= last; ++tokenId) {
            uint256 round = roundOf(tokenId);
            if (randomnessOf[round] == 0 && (count == 0 || rounds[count - 1] != round)) rounds[count++] = round;
        }
        assembly ("memory-safe") {
            mstore(rounds, count)
        }
    }

    function revealed() internal override {
        if (_totalMinted() != 0) emit BatchMetadataUpdate(0, _totalMinted() - 1);
    }

    /// @notice The seed of a token, of which `genesis` makes its picture. It never changes.
    function seedOf(uint256 tokenId) external view returns (bytes32 seed) {
        (seed,) = metadata.settle(drawn(tokenId));
    }

    /// @notice The traits of a token.
    function traitsOf(uint256 tokenId) external view returns (Traits memory traits) {
        (, traits) = metadata.settle(drawn(tokenId));
    }

    function drawn(uint256 tokenId) private view returns (bytes32) {
        uint256 round = roundOf(tokenId);
        bytes32 randomness = randomnessOf[round];
        if (randomness == 0) revert NotRevealed(tokenId, round);
        return keccak256(abi.encode(randomness, address(this), tokenId));
    }

    // ---- what tokens show ----

    /// @notice The metadata of a token; until its round is revealed with a picture that all such tokens share.
    /// @return A `data:` URI of JSON, the picture in it a PNG of 512 x 512 pixels.
    function tokenURI(uint256 tokenId) public view override(ERC721A, IERC721A) returns (string memory) {
        if (!_exists(tokenId)) revert URIQueryForNonexistentToken();
        uint256 round = roundOf(tokenId);
        forward(
            address(metadata),
            randomnessOf[round] == 0
                ? abi.encodeCall(GenesisMetadata.hiddenURI, (tokenId, blockOf(round)))
                : abi.encodeCall(GenesisMetadata.tokenURI, (tokenId, drawn(tokenId)))
        );
    }

    /// @inheritdoc Collection
    function contractURI() external view override returns (string memory) {
        forward(address(metadata), abi.encodeCall(GenesisMetadata.contractURI, ()));
    }

    /// @notice The picture of a token.
    /// @return A Windows bitmap of 128 x 128 pixels.
    function render(uint256 tokenId) external view returns (bytes memory) {
        (bytes32 seed,) = metadata.settle(drawn(tokenId));
        return genesis.render(seed);
    }
}
