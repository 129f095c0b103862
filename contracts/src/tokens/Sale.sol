// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {ERC721A, IERC721A} from "erc721a/contracts/ERC721A.sol";
import {ERC721AQueryable} from "erc721a/contracts/extensions/ERC721AQueryable.sol";
import {Ownable} from "@openzeppelin/contracts/access/Ownable.sol";
import {Ownable2Step} from "@openzeppelin/contracts/access/Ownable2Step.sol";
import {EIP712} from "@openzeppelin/contracts/utils/cryptography/EIP712.sol";
import {MerkleProof} from "@openzeppelin/contracts/utils/cryptography/MerkleProof.sol";
import {SignatureChecker} from "@openzeppelin/contracts/utils/cryptography/SignatureChecker.sol";

/// @notice A permission of the allow-list, signed by `allowListSigner` as EIP-712 typed data.
/// @param account Who may mint; nobody else can use it.
/// @param quantity How many tokens the account may mint in all while the allow-list is open, not how many more.
/// @param deadline The last second, in Unix time, at which it holds.
struct Allowance {
    address account;
    uint256 quantity;
    uint256 deadline;
}

/// @title Sale: who may mint when, and where the ether goes.
/// @notice Tokens are paid exactly, with neither change nor refund, and the ether stays here until the owner fetches it. An account on the
/// allow-list is there by a Merkle proof or by a signature; both speak of how many tokens it may mint in all, so that neither is worth
/// anything when it is shown twice.
abstract contract Sale is ERC721AQueryable, Ownable2Step, EIP712 {
    enum Phase {
        Closed,
        AllowList,
        Public
    }

    bytes32 internal constant ALLOWANCE_TYPE = keccak256("Allowance(address account,uint256 quantity,uint256 deadline)");

    /// @notice The most tokens that one call mints.
    uint256 public immutable perTransaction;

    /// @notice Who may mint at present.
    Phase public phase;
    /// @notice The root of the allow-list; zero if there is none.
    bytes32 public allowListRoot;
    /// @notice Whose signatures put accounts on the allow-list; zero if nobody's do.
    address public allowListSigner;

    event PhaseChanged(Phase phase);
    event AllowListChanged(bytes32 root, address indexed signer);
    event Withdrawn(address indexed to, uint256 amount);

    /// @notice The limit of a call must be 1 to 100 tokens: ERC-721A looks for the owner of a token among so many.
    error PerTransaction(uint256 perTransaction);
    error WrongPhase(Phase phase, Phase needed);
    error Quantity(uint256 quantity, uint256 perTransaction);
    error Payment(uint256 sent, uint256 due);
    /// @notice What was sent along with a transfer or an approval.
    error PaymentForNothing(uint256 sent);
    error NotOnAllowList(address account, uint256 quantity);
    error AllowanceOfAnother(address account, address sender);
    error AllowanceExpired(uint256 deadline, uint256 time);
    error AllowanceNotSigned(address signer);
    error AllowanceExceeded(uint256 minted, uint256 quantity, uint256 allowance);
    error NothingLeft(uint256 quantity, uint256 left);
    error WithdrawalRefused(address to, uint256 amount);
    error OwnerNeeded();

    constructor(string memory name_, string memory symbol_, address owner_, uint256 perTransaction_)
        ERC721A(name_, symbol_)
        Ownable(owner_)
        EIP712(name_, "1")
    {
        if (perTransaction_ == 0 || perTransaction_ > 100) revert PerTransaction(perTransaction_);
        perTransaction = perTransaction_;
    }

    // ---- the owner's part ----

    /// @notice Says who may mint from now on.
    function setPhase(Phase phase_) public virtual onlyOwner {
        phase = phase_;
        emit PhaseChanged(phase_);
    }

    /// @notice Replaces the allow-list. What accounts have minted by the old one counts for the new one too.
    /// @param root Of a tree whose leaves are keccak256(keccak256(abi.encode(account, quantity))), pairs sorted; zero for none.
    /// @param signer Of `Allowance`s, an account or a contract (ERC-1271); zero for none.
    function setAllowList(bytes32 root, address signer) external onlyOwner {
        (allowListRoot, allowListSigner) = (root, signer);
        emit AllowListChanged(root, signer);
    }

    /// @notice Sends all ether that is here to `to`. If `to` does not take it, nothing is lost: choose another.
    function withdraw(address payable to) external onlyOwner {
        uint256 amount = address(this).balance;
        bool done = to != address(0);
        // no bytes of the answer are copied: nobody can make them dear
        assembly ("memory-safe") {
            if done { done := call(gas(), to, amount, 0, 0, 0, 0) }
        }
        if (!done) revert WithdrawalRefused(to, amount);
        emit Withdrawn(to, amount);
    }

    /// @notice Never: the ether of the sale would stay here for ever.
    function renounceOwnership() public pure override {
        revert OwnerNeeded();
    }

    // ---- the allow-list ----

    /// @notice How many tokens an account has minted while the allow-list was open.
    function mintedFromAllowList(address account) public view returns (uint256) {
        return _getAux(account);
    }

    /// @notice What is signed to allow an account to mint.
    function allowanceHash(Allowance calldata allowance) public view returns (bytes32) {
        return _hashTypedDataV4(
            keccak256(abi.encode(ALLOWANCE_TYPE, allowance.account, allowance.quantity, allowance.deadline))
        );
    }

    /// @dev Counts tokens against an allowance that is in the tree.
    function spendByProof(uint256 quantity, uint256 allowed, bytes32[] calldata proof) internal {
        // hashed twice, so that no inner node of the tree can be taken for a leaf
        bytes32 leaf = keccak256(bytes.concat(keccak256(abi.encode(msg.sender, allowed))));
        if (allowListRoot == 0 || !MerkleProof.verifyCalldata(proof, allowListRoot, leaf)) {
            revert NotOnAllowList(msg.sender, allowed);
        }
        spend(quantity, allowed);
    }

    /// @dev Counts tokens against an allowance that is signed.
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
        // at most 100 at a time: 64 bits suffice for ever, once `checkQuantity` has been asked
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

    // ---- ERC-721A takes ether where none is due ----

    function approve(address to, uint256 tokenId) public payable override(ERC721A, IERC721A) {
        if (msg.value != 0) revert PaymentForNothing(msg.value);
        super.approve(to, tokenId);
    }

    function _beforeTokenTransfers(address from, address, uint256, uint256) internal view override {
        if (from != address(0) && msg.value != 0) revert PaymentForNothing(msg.value);
    }
}
