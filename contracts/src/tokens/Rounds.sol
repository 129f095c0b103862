// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Blockhash} from "@openzeppelin/contracts/utils/Blockhash.sol";
import {SafeCast} from "@openzeppelin/contracts/utils/math/SafeCast.sol";
import {Header} from "./Header.sol";

/// @title Rounds: randomness from future blocks.
/// @notice Blocks are grouped into rounds of 32. Each round is assigned one block, at least 128 blocks after any of its own; the randomness
/// of the round is the PREVRANDAO value of that block. Nobody can choose the block, and the time of the reveal has no effect.
///
/// PREVRANDAO can be read directly only within its own block. It is, however, a field of the block header, and the hash of the header
/// remains available. A reveal therefore submits the header and checks its hash. The chain provides the hashes of the last 8,191 blocks
/// (EIP-2935; 256 without it). Older blocks are proven by a chain of headers, each of which contains the hash of its parent: a late reveal
/// costs more, but has the same result.
abstract contract Rounds {
    using Header for bytes;

    /// @notice The number of blocks in a round.
    uint256 public constant ROUND = 32;
    /// @notice The number of blocks from the end of a round to the block of its randomness. More than two epochs of 32 blocks: during a
    /// round, the proposers of the blocks that determine its randomness are not yet known.
    uint256 public constant DELAY = 128;

    /// @notice The first block of round 0.
    uint256 public immutable firstBlock;

    /// @notice The randomness of a round; zero until it is revealed.
    mapping(uint256 round => bytes32) public randomnessOf;
    /// @dev Block hashes stored by `keepHash`.
    mapping(uint256 blockNumber => bytes32) private kept;

    /// @notice Emitted when the randomness of a round is stored.
    event Revealed(uint256 indexed round, uint256 indexed blockNumber, bytes32 randomness);
    /// @notice Emitted when the hash of a block is stored.
    event HashKept(uint256 indexed blockNumber, bytes32 hash);

    /// @notice The number of headers must equal the number of rounds.
    error AsManyHeadersAsRounds(uint256 headers, uint256 rounds);
    /// @notice Blocks of rounds after `last` have numbers that no chain reaches.
    error RoundTooLarge(uint256 round, uint256 last);
    /// @notice The block is not yet mined, or is the current one.
    error BlockToCome(uint256 blockNumber);
    /// @notice The hash of the block is no longer available: prove it with the headers of later blocks, by `keepHash`.
    error BlockForgotten(uint256 blockNumber);
    /// @notice The header does not have the hash of the block.
    error WrongHeader(uint256 blockNumber, bytes32 hash, bytes32 hashOfHeader);
    /// @notice PREVRANDAO is zero: the chain provides no randomness.
    error NoRandomness(uint256 blockNumber);

    constructor() {
        firstBlock = block.number;
    }

    /// @notice Returns the round of the current block.
    function currentRound() public view returns (uint256) {
        return (block.number - firstBlock) / ROUND;
    }

    /// @notice Returns the block whose PREVRANDAO value is the randomness of a round.
    function blockOf(uint256 round) public view returns (uint256) {
        if (round > type(uint64).max) revert RoundTooLarge(round, type(uint64).max);
        return firstBlock + (round + 1) * ROUND - 1 + DELAY;
    }

    /// @notice Returns the hash of a block if it is available from the chain or stored by this contract; zero otherwise.
    function hashOf(uint256 blockNumber) public view returns (bytes32 hash) {
        hash = kept[blockNumber];
        if (hash == 0) hash = Blockhash.blockHash(blockNumber);
    }

    /// @notice Stores the randomness of rounds. Anyone can call it, at any later time, with the same result. Rounds already revealed are
    /// skipped.
    /// @param headers For each round, the header of its block, as the RLP encoding whose hash is the block hash.
    function reveal(uint256[] calldata rounds, bytes[] calldata headers) external {
        if (headers.length != rounds.length) revert AsManyHeadersAsRounds(headers.length, rounds.length);
        bool news;
        for (uint256 i = 0; i < rounds.length; ++i) {
            uint256 round = rounds[i];
            if (randomnessOf[round] != 0) continue;
            uint256 number = blockOf(round);
            bytes memory header = headers[i];
            checkHeader(number, knownHash(number), header);
            bytes32 randomness = header.prevRandao();
            if (randomness == 0) revert NoRandomness(number);
            randomnessOf[round] = randomness;
            news = true;
            emit Revealed(round, number, randomness);
        }
        if (news) revealed();
    }

    /// @notice Stores the hash of a block before the chain discards it; given headers, the hash of an older block.
    /// @param blockNumber A block whose hash is available (`hashOf`).
    /// @param headers The headers of this block, of its parent, and so on. The parent hash in the last one is stored; without headers, the
    /// hash of this block.
    function keepHash(uint256 blockNumber, bytes[] calldata headers) external {
        bytes32 hash = knownHash(blockNumber);
        for (uint256 i = 0; i < headers.length; ++i) {
            bytes memory header = headers[i];
            checkHeader(blockNumber, hash, header);
            hash = header.parentHash();
            --blockNumber;
        }
        kept[blockNumber] = hash;
        emit HashKept(blockNumber, hash);
    }

    /// @dev Called after rounds were revealed.
    function revealed() internal virtual;

    /// @dev Returns the current round as 24 bits, to be stored next to the owner of a token: enough for 500 million blocks.
    function roundToKeep() internal view returns (uint24) {
        return SafeCast.toUint24(currentRound());
    }

    function knownHash(uint256 blockNumber) private view returns (bytes32 hash) {
        if (blockNumber >= block.number) revert BlockToCome(blockNumber);
        hash = hashOf(blockNumber);
        if (hash == 0) revert BlockForgotten(blockNumber);
    }

    function checkHeader(uint256 blockNumber, bytes32 hash, bytes memory header) private pure {
        bytes32 hashOfHeader = keccak256(header);
        if (hashOfHeader != hash) revert WrongHeader(blockNumber, hash, hashOfHeader);
    }
}
