// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {answer} from "./Redirect.sol";
import {Png} from "./Png.sol";
import {IPngEncoder} from "../interfaces/IPngEncoder.sol";
import {TransparentPng} from "./TransparentPng.sol";

/// @title PngEncoder: encodes the renderer's bitmaps as PNG files, for the Studio and for contracts that do not include the code.
contract PngEncoder is IPngEncoder {
    function encode(bytes calldata bmp, uint256 scale) external pure returns (bytes memory) {
        answer(Png.encode(bmp, scale));
    }

    function compress(bytes calldata bmp, uint256 scale) external pure returns (bytes memory) {
        answer(Png.compress(bmp, scale));
    }

    function dataURI(bytes calldata bmp, uint256 scale) external pure returns (string memory) {
        answer(bytes(Png.dataURI(bmp, scale)));
    }

    function encodeTransparent(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (bytes memory) {
        answer(TransparentPng.encode(black, white, scale));
    }

    function transparentDataURI(bytes calldata black, bytes calldata white, uint256 scale) external pure returns (string memory) {
        answer(bytes(TransparentPng.dataURI(black, white, scale)));
    }

    function svg(bytes calldata bmp, uint256 scale) external pure returns (string memory) {
        answer(bytes(Png.svg(bmp, scale)));
    }
}
