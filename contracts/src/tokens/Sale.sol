// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A} from "erc721a/contracts/ERC721A.sol";
import {Ownable} from "@openzeppelin/contracts/access/Ownable.sol";
import {Ownable2Step} from "@openzeppelin/contracts/access/Ownable2Step.sol";
import {EIP712} from "@openzeppelin/contracts/utils/cryptography/EIP712.sol";
import {MerkleProof} from "@openzeppelin/contracts/utils/cryptography/MerkleProof.sol";
import {SignatureChecker} from "@openzeppelin/contracts/utils/cryptography/SignatureChecker.sol";
import {Token} from "./Token.sol";

/// @notice An entry of the allow list, signed by `allowListSigner` as EIP-712 typed data.
/// @param account The account that may mint. No other account can use the entry.
/// @param quantity The total number of tokens that the account may mint from the allow list, including those it has already minted.
/// @param deadline The last second at which the entry is valid, in Unix time.
struct Allowance {
    address account;
    uint256 quantity;
    uint256 deadline;
}

/// @title Sale: phases of minting, the allow list, and the proceeds.
/// @notice Payments must be exact. The ether stays in the contract until the owner withdraws it. An account proves its place on the allow
/// list by a Merkle proof or by a signature; both state the total number of tokens it may mint, so neither can be used twice.
abstract contract Sale is Token, Ownable2Step, EIP712 {
    enum Phase {
        Closed,
        AllowList,
        Public
    }

    bytes32 internal constant ALLOWANCE_TYPE = keccak256("Allowance(address account,uint256 quantity,uint256 deadline)");

    /// @notice The maximum number of tokens per call.
    uint256 public immutable perTransaction;

    /// @notice The current phase, which determines who may mint.
    Phase public phase;
    /// @notice The Merkle root of the allow list; zero if there is none.
    bytes32 public allowListRoot;
    /// @notice The account or contract that signs allowances; zero if there is none.
    address public allowListSigner;

    /// @notice Emitted when the phase changes.
    event PhaseChanged(Phase phase);
    /// @notice Emitted when the allow list changes.
    event AllowListChanged(bytes32 root, address indexed signer);
    /// @notice Emitted when the proceeds are withdrawn, in wei.
    event Withdrawn(address indexed to, uint256 amount);

    /// @notice The limit per call must be 1 to 100 tokens: it bounds the number of tokens that ERC-721A scans for the owner of a token.
    error PerTransaction(uint256 perTransaction);
    /// @notice The sale is not in the needed phase.
    error WrongPhase(Phase phase, Phase needed);
    /// @notice The Merkle proof does not prove that the account may mint this total quantity.
    error NotOnAllowList(address account, uint256 quantity);
    /// @notice The allowance belongs to another account.
    error AllowanceOfAnother(address account, address sender);
    /// @notice The deadline of the allowance has passed.
    error AllowanceExpired(uint256 deadline, uint256 time);
    /// @notice The allowance is not signed by the current signer.
    error AllowanceNotSigned(address signer);
    /// @notice The mint would exceed the account's allowance.
    error AllowanceExceeded(uint256 minted, uint256 quantity, uint256 allowance);
    /// @notice The collection cannot be without an owner.
    error OwnerNeeded();

    constructor(string memory name_, string memory symbol_, address owner_, uint256 perTransaction_)
        ERC721A(name_, symbol_) Ownable(owner_) EIP712(name_, "1")
    {
        if (perTransaction_ == 0 || perTransaction_ > 100) revert PerTransaction(perTransaction_);
        perTransaction = perTransaction_;
    }

    // ---- owner ----

    /// @notice Sets the phase, which determines who may mint.
    function setPhase(Phase phase_) public virtual onlyOwner {
        phase = phase_;
        emit PhaseChanged(phase_);
    }

    /// @notice Replaces the allow list. Tokens minted from the old list count toward the limits of the new one.
    /// @param root The root of a tree with leaves keccak256(keccak256(abi.encode(account, quantity))) and sorted pairs; zero for none.
    /// @param signer The signer of `Allowance`s, an account or a contract (ERC-1271); zero for none.
    function setAllowList(bytes32 root, address signer) external onlyOwner {
        (allowListRoot, allowListSigner) = (root, signer);
        emit AllowListChanged(root, signer);
    }

    /// @notice Sends all ether of the contract to `to`. Reverts if `to` does not accept it; nothing is lost, and another address can be
    /// used.
    function withdraw(address payable to) external onlyOwner {
        uint256 amount = address(this).balance;
        pay(to, amount);
        emit Withdrawn(to, amount);
    }

    /// @notice Always reverts: without an owner, the proceeds could not be withdrawn.
    function renounceOwnership() public pure override {
        revert OwnerNeeded();
    }

    // ---- allow list ----

    /// @notice Returns the number of tokens that an account has minted from the allow list.
    function mintedFromAllowList(address account) public view returns (uint256) {
        return _getAux(account);
    }

    /// @notice Returns the EIP-712 hash to sign for an allowance.
    function allowanceHash(Allowance calldata allowance) public view returns (bytes32) {
        return _hashTypedDataV4(keccak256(abi.encode(ALLOWANCE_TYPE, allowance.account, allowance.quantity, allowance.deadline)));
    }

    /// @dev Counts tokens against an allowance proven by the Merkle tree.
    function spendByProof(uint256 quantity, uint256 allowed, bytes32[] calldata proof) internal {
        // hashed twice so that an inner node of the tree cannot pass as a leaf
        bytes32 leaf = keccak256(bytes.concat(keccak256(abi.encode(msg.sender, allowed))));
        if (allowListRoot == 0 || !MerkleProof.verifyCalldata(proof, allowListRoot, leaf)) {
            revert NotOnAllowList(msg.sender, allowed);
        }
        spend(quantity, allowed);
    }

    /// @dev Counts tokens against a signed allowance.
    function spendBySignature(uint256 quantity, Allowance calldata allowance, bytes calldata signature) internal {
        if (allowance.account != msg.sender) revert AllowanceOfAnother(allowance.account, msg.sender);
        if (block.timestamp > allowance.deadline) revert AllowanceExpired(allowance.deadline, block.timestamp);
        address signer = allowListSigner;
        if (signer == address(0) || !SignatureChecker.isValidSignatureNowCalldata(signer, allowanceHash(allowance), signature)) {
            revert AllowanceNotSigned(signer);
        }
        spend(quantity, allowance.quantity);
    }

    function spend(uint256 quantity, uint256 allowed) private {
        requirePhase(Phase.AllowList);
        uint256 minted = _getAux(msg.sender);
        if (quantity > allowed || minted > allowed - quantity) revert AllowanceExceeded(minted, quantity, allowed);
        // 64 bits suffice: `checkQuantity` limits each call to 100
        checkQuantity(quantity);
        _setAux(msg.sender, uint64(minted + quantity));
    }

    // ---- checks of a mint ----

    function requirePhase(Phase needed) internal view {
        if (phase != needed) revert WrongPhase(phase, needed);
    }

    function checkQuantity(uint256 quantity) internal view {
        if (quantity == 0 || quantity > perTransaction) revert Quantity(quantity, perTransaction);
    }

    function checkPayment(uint256 due) internal view {
        if (msg.value != due) revert Payment(msg.value, due);
    }
}
