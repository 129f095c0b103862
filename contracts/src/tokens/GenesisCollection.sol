// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {forward} from "../encode/Redirect.sol";
import {IGenesis} from "../interfaces/IGenesis.sol";
import {Traits} from "../interfaces/Piece.sol";
import {Collection, Terms} from "./Collection.sol";
import {Allowance} from "./Sale.sol";
import {GenesisMetadata} from "./GenesisMetadata.sol";
import {Rounds} from "./Rounds.sol";

/// @title GenesisCollection: 1024 pictures, each generated on chain from a random seed.
/// @notice A token stores the round in which it was minted. The randomness of the round comes from a block at least 128 blocks later
/// (`Rounds`). The randomness and the number of the token determine the seed, and immutable contracts generate the picture from it.
contract GenesisCollection is Collection, Rounds {
    /// @notice The maximum number of tokens. They are numbered from 0.
    uint256 public constant SUPPLY = 1024;

    /// @notice The contract that makes metadata from seeds.
    GenesisMetadata public immutable metadata;
    /// @notice The contract that generates and draws pieces.
    IGenesis public immutable genesis;
    /// @notice The price of a token, in wei.
    uint256 public immutable price;
    /// @notice The number of tokens reserved for the team.
    uint256 public immutable reserve;

    /// @notice The number of reserved tokens already minted.
    uint256 public reserveMinted;

    /// @notice The address has no code.
    error NoMetadata(address metadata);
    /// @notice The reserve exceeds the supply.
    error Reserve(uint256 reserve, uint256 supply);
    /// @notice The round of the token is not revealed yet: see `blockOf` and `reveal`.
    error NotRevealed(uint256 tokenId, uint256 round);

    /// @param metadata_ The contract that makes metadata from seeds. It also provides `genesis`.
    /// @param price_ The price of a token, in wei.
    /// @param reserve_ The number of tokens reserved for the team.
    constructor(GenesisMetadata metadata_, uint256 price_, uint256 reserve_, Terms memory terms)
        Collection("Shackled Genesis", "SHKG", terms)
    {
        if (address(metadata_).code.length == 0) revert NoMetadata(address(metadata_));
        if (reserve_ > SUPPLY) revert Reserve(reserve_, SUPPLY);
        (metadata, genesis) = (metadata_, metadata_.genesis());
        (price, reserve) = (price_, reserve_);
    }

    // ---- minting ----

    /// @notice Mints tokens to the caller while the sale is public. The payment must be exactly `quantity * price`.
    function mint(uint256 quantity) external payable {
        requirePhase(Phase.Public);
        checkQuantity(quantity);
        sell(quantity);
    }

    /// @notice Mints tokens to the caller, who proves a place on the allow list by a Merkle proof.
    /// @param allowed The total number of tokens that the list allows the caller to mint.
    function mintWithProof(uint256 quantity, uint256 allowed, bytes32[] calldata proof) external payable {
        spendByProof(quantity, allowed, proof);
        sell(quantity);
    }

    /// @notice Mints tokens to the caller, who proves a place on the allow list by a signature.
    function mintWithSignature(uint256 quantity, Allowance calldata allowance, bytes calldata signature) external payable {
        spendBySignature(quantity, allowance, signature);
        sell(quantity);
    }

    /// @notice Mints reserved tokens to any account, in any phase. Only the owner.
    function mintReserve(address to, uint256 quantity) external onlyOwner {
        checkQuantity(quantity);
        uint256 unminted = reserve - reserveMinted;
        if (quantity > unminted) revert NothingLeft(quantity, unminted);
        reserveMinted += quantity;
        _safeMint(to, quantity);
    }

    /// @notice Returns the number of tokens left for sale.
    function left() public view returns (uint256) {
        return SUPPLY - (reserve - reserveMinted) - _totalMinted();
    }

    function sell(uint256 quantity) private {
        checkPayment(quantity * price);
        uint256 available = left();
        if (quantity > available) revert NothingLeft(quantity, available);
        _safeMint(msg.sender, quantity);
    }

    /// @dev A token keeps the round of the block in which it is minted.
    function _extraData(address from, address, uint24 previous) internal view override returns (uint24) {
        return from == address(0) ? roundToKeep() : previous;
    }

    // ---- reveal ----

    /// @notice Returns the round in which a token was minted.
    function roundOf(uint256 tokenId) public view returns (uint256) {
        return numberOf(tokenId);
    }

    /// @notice Returns the unrevealed rounds of tokens `first` to `last`, without repetition, for `reveal` once their blocks are mined.
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

    /// @notice Returns the seed of a token, from which `genesis` generates its picture. It never changes.
    function seedOf(uint256 tokenId) external view returns (bytes32 seed) {
        (seed,) = metadata.settle(drawn(tokenId));
    }

    /// @notice Returns the traits of a token.
    function traitsOf(uint256 tokenId) external view returns (Traits memory traits) {
        (, traits) = metadata.settle(drawn(tokenId));
    }

    function drawn(uint256 tokenId) private view returns (bytes32) {
        uint256 round = roundOf(tokenId);
        bytes32 randomness = randomnessOf[round];
        if (randomness == 0) revert NotRevealed(tokenId, round);
        return keccak256(abi.encode(randomness, address(this), tokenId));
    }

    // ---- metadata and pictures ----

    /// @notice Returns the metadata of a token. Until its round is revealed, all tokens show the same picture.
    /// @return A `data:` URI of JSON that contains the picture as a PNG of 512 x 512 pixels.
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

    /// @notice Returns the picture of a token.
    /// @return A Windows bitmap of 128 x 128 pixels.
    function render(uint256 tokenId) external view returns (bytes memory) {
        (bytes32 seed,) = metadata.settle(drawn(tokenId));
        return genesis.render(seed);
    }
}
