// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

// Contracts that try what must not work, and some that only look odd.

interface Collection {
    function mint(uint256 quantity) external payable;
    function transferFrom(address from, address to, uint256 tokenId) external payable;
    function seedOf(uint256 tokenId) external view returns (bytes32);
    function tokenURI(uint256 tokenId) external view returns (string memory);
    function totalSupply() external view returns (uint256);
    function withdraw(address payable to) external;
    function acceptOwnership() external;
}

/// @notice Takes tokens and ether, and calls what it was told while the first token arrives.
contract Receiver {
    address public target;
    bytes public data;
    uint256 public value;
    uint256 public arrived;
    bool public swallow;

    receive() external payable {}

    function prepare(address target_, bytes calldata data_, uint256 value_, bool swallow_) external {
        (target, data, value, swallow) = (target_, data_, value_, swallow_);
    }

    function execute(address to, bytes calldata what, uint256 amount) public returns (bytes memory) {
        (bool done, bytes memory answer) = to.call{value: amount}(what);
        if (!done) {
            assembly {
                revert(add(answer, 0x20), mload(answer))
            }
        }
        return answer;
    }

    function onERC721Received(address, address, uint256, bytes calldata) external returns (bytes4) {
        ++arrived;
        address to = target;
        if (to != address(0)) {
            // once
            target = address(0);
            (bool done, bytes memory answer) = to.call{value: value}(data);
            if (!done && !swallow) {
                assembly {
                    revert(add(answer, 0x20), mload(answer))
                }
            }
        }
        return Receiver.onERC721Received.selector;
    }
}

/// @notice Mints, looks at what it has, and undoes it if it does not like that.
contract Looker {
    error DoNotLike();

    bool public fromOnERC721Received;

    function mintAndLook(Collection collection, bool lookWhileItArrives) external payable {
        fromOnERC721Received = lookWhileItArrives;
        collection.mint{value: msg.value}(1);
        if (!lookWhileItArrives) look(collection, collection.totalSupply() - 1);
    }

    function onERC721Received(address, address, uint256 tokenId, bytes calldata) external view returns (bytes4) {
        if (fromOnERC721Received) look(Collection(msg.sender), tokenId);
        return Looker.onERC721Received.selector;
    }

    function look(Collection collection, uint256 tokenId) private view {
        if (uint256(collection.seedOf(tokenId)) % 16 != 0) revert DoNotLike();
    }
}

/// @notice Takes tokens, but no ether.
contract Refuser {
    function execute(address to, bytes calldata what) external payable returns (bytes memory) {
        (bool done, bytes memory answer) = to.call{value: msg.value}(what);
        if (!done) {
            assembly {
                revert(add(answer, 0x20), mload(answer))
            }
        }
        return answer;
    }

    function onERC721Received(address, address, uint256, bytes calldata) external pure returns (bytes4) {
        return Refuser.onERC721Received.selector;
    }
}

/// @notice Calls once more what it was told whenever ether arrives, until that fails.
contract Greedy {
    address public target;
    bytes public data;
    uint256 public again;

    function execute(address to, bytes calldata what) external payable {
        (target, data) = (to, what);
        (bool done, bytes memory answer) = to.call{value: msg.value}(what);
        if (!done) {
            assembly {
                revert(add(answer, 0x20), mload(answer))
            }
        }
    }

    receive() external payable {
        (bool done,) = target.call(data);
        if (done) ++again;
    }

    function onERC721Received(address, address, uint256, bytes calldata) external pure returns (bytes4) {
        return Greedy.onERC721Received.selector;
    }
}

/// @notice A contract that knows nothing of tokens.
contract Deaf {
    function execute(address to, bytes calldata what) external payable {
        (bool done, bytes memory answer) = to.call{value: msg.value}(what);
        if (!done) {
            assembly {
                revert(add(answer, 0x20), mload(answer))
            }
        }
    }
}

/// @notice Answers ether with a megabyte.
contract Bomb {
    receive() external payable {
        assembly {
            return(0, 1000000)
        }
    }
}

/// @notice Signs for whoever deployed it (ERC-1271).
contract Signer {
    bytes32 public signed;

    function sign(bytes32 hash) external {
        signed = hash;
    }

    function isValidSignature(bytes32 hash, bytes calldata) external view returns (bytes4) {
        return hash == signed ? bytes4(0x1626ba7e) : bytes4(0);
    }
}
