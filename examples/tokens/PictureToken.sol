// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {ERC721A} from "erc721a/contracts/ERC721A.sol";
import {Base64} from "solady/src/utils/Base64.sol";
import {Fixed, ZERO} from "shackled-contracts/math/Fixed.sol";
import {fromEuler} from "shackled-contracts/math/Euler.sol";
import {IStudio} from "shackled-contracts/interfaces/IStudio.sol";
import {Changes, TURN} from "shackled-contracts/interfaces/Changes.sol";

/// @notice Tokens that show a scene stored in the Studio, rotated by ten degrees more for each token.
contract PictureToken is ERC721A("Pictures", "PIC") {
    IStudio public immutable studio;
    address public immutable picture;

    constructor(IStudio studio_, address picture_) {
        (studio, picture) = (studio_, picture_);
    }

    function mint() external {
        _mint(msg.sender, 1);
    }

    function tokenURI(uint256 id) public view override returns (string memory) {
        if (!_exists(id)) revert URIQueryForNonexistentToken();
        Changes memory changes;
        (changes.fields, changes.turn) = (TURN, fromEuler(ZERO, Fixed.wrap(int256(id * 10) << 32), ZERO));
        string memory image = studio.renderDataURI(picture, 4, changes);
        string memory json = string.concat('{"name":"Picture ', _toString(id), '","image":"', image, '"}');
        return string.concat("data:application/json;base64,", Base64.encode(bytes(json)));
    }
}
