// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

interface IStudio {
    function MAX_SCALE() external view returns (uint256);
}

/// @notice Tokens that are right, and tokens that are wrong in one way each.
contract Odd {
    error Absent(uint256 id, string why);

    address public immutable studio;
    uint256 public immutable price;
    uint256 public minted;

    constructor(IStudio studio_, uint256 price_) {
        (studio, price) = (address(studio_), price_);
    }

    function mint(uint256 count) external payable {
        require(msg.value == count * price, "the price");
        minted += count;
    }

    function tokenURI(uint256 id) external view returns (string memory) {
        if (id >= minted) revert Absent(id, "not minted");
        string memory head = string.concat('data:application/json,{"name":"Odd ', id == 0 ? "0" : "1", '","image":"');
        if (id == 1) return string.concat(head, 'data:image/png;base64,iVBORw0KGgo="}');
        if (id == 2) {
            uint256 begin = gasleft();
            while (begin - gasleft() < 20_000_000) {}
        }
        return string.concat(head, "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg'/%3E", '"}');
    }

    function picture() external view returns (bytes memory) {
        return bytes.concat("<svg xmlns='http://www.w3.org/2000/svg' id='", bytes1(uint8(0x61 + studio.code.length % 2)), "'/>");
    }
}
