// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Blockhash} from "@openzeppelin/contracts/utils/Blockhash.sol";
import {SafeCast} from "@openzeppelin/contracts/utils/math/SafeCast.sol";
import {Header} from "./Header.sol";

/// @title Rounds: randomness of blocks to come.
/// @notice Blocks are counted in rounds of 32. Each round has one block, at least 128 blocks after any of its own, and the randomness of
/// the round is PREVRANDAO of that block: no choice is left to anybody, neither which block it is nor when it is looked up.
///
/// PREVRANDAO can be read only while its block is made. But it stands in the header of the block, and the hash of the header can be read
/// afterwards. So whoever reveals a round shows the header; every other header has another hash. The chain knows the hashes of the last
/// 8,191 blocks (EIP-2935; 256 without). Older ones are proven by a chain of headers, each of which has the hash of the one before: a late
/// reveal costs more, and says the same.
abstract contract Rounds {
    using Header for bytes;

    /// @notice Blocks in a round.
    uint256 public constant ROUND = 32;
    /// @notice Blocks from the end of a round to that of its randomness. More than two epochs of 32: while a round lasts, nobody can know
    /// who will propose the blocks that its randomness is made of.
    uint256 public constant DELAY = 128;

    /// @notice The first block of round 0.
    uint256 public immutable firstBlock;

    /// @notice The randomness of a round; zero until it is revealed.
    mapping(uint256 round => bytes32) public randomnessOf;
    /// @dev Hashes of blocks that were written down.
    mapping(uint256 blockNumber => bytes32) private kept;

    event Revealed(uint256 indexed round, uint256 indexed blockNumber, bytes32 randomness);
    event HashKept(uint256 indexed blockNumber, bytes32 hash);

    error AsManyHeadersAsRounds(uint256 headers, uint256 rounds);
    /// @notice The block is still to come, or is this one.
    error BlockToCome(uint256 blockNumber);
    /// @notice The chain has forgotten the hash: prove it by the headers of later blocks, with `keepHash`.
    error BlockForgotten(uint256 blockNumber);
    error WrongHeader(uint256 blockNumber, bytes32 hash, bytes32 hashOfHeader);
    /// @notice A chain without randomness.
    error NoRandomness(uint256 blockNumber);

    constructor() {
        firstBlock = block.number;
    }

    /// @notice The round of the block that is being made.
    function currentRound() public view returns (uint256) {
        return (block.number - firstBlock) / ROUND;
    }

    /// @notice The block whose randomness is that of a round.
    function blockOf(uint256 round) public view returns (uint256) {
        return firstBlock + (round + 1) * ROUND - 1 + DELAY;
    }

    /// @notice The hash of a block, if the chain or this contract knows it; else zero.
    function hashOf(uint256 blockNumber) public view returns (bytes32 hash) {
        hash = kept[blockNumber];
        if (hash == 0) hash = Blockhash.blockHash(blockNumber);
    }

    /// @notice Writes down the randomness of rounds. Anyone may; it is the same whoever does, whenever. Rounds that are revealed already
    /// are passed over.
    /// @param headers Of each round the header of its block, in RLP as it is hashed.
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

    /// @notice Writes down the hash of a block for the time when the chain will have forgotten it. With headers, that of an older block.
    /// @param blockNumber A block whose hash is known (`hashOf`).
    /// @param headers Those of this block, of the one before it, and so on; the hash of the block before the last of them is written down.
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

    /// @dev What to do after rounds were revealed.
    function revealed() internal virtual;

    /// @dev The present round as a number of 24 bits, which fits beside the owner of a token: enough for 500 million blocks.
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
