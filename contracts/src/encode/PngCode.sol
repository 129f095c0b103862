// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @dev The 9-bit codes of three zeros. The code of another byte is this plus the byte.
uint256 constant LITERALS = 66189564;

/// @notice The Huffman code of the PNG encoder, fitted to pictures of the renderer. Written by tools/png_code.py.
/// @dev All bits are in the order of the stream.
library PngCode {
    /// @notice The 9-bit code of a zero. The code of another byte is this plus the byte.
    uint256 internal constant LITERAL = 252;
    /// @notice The code size of the longest match in bits; 32 such matches at the distance of a pixel; one of a byte.
    uint256 internal constant LONGEST_SIZE = 5;
    uint256 internal constant LONGEST = 0x0000000000000000000000006b5ad6b5ad6b5ad6b5ad6b5ad6b5ad6b5ad6b5ad;
    uint256 internal constant LONGEST_ZEROS = 12;
    /// @notice The bits in which the codes of 259 and 260 bytes, two matches each, differ for the other distance. Codes
    /// of fewer bytes differ in the last bit.
    uint256 internal constant OTHER_DISTANCES = 0x21;

    /// @notice Returns, for each length from 3 to 260, the code of the match at the distance of a pixel (19 bits), and
    /// its size in bits (5 bits).
    function tables() internal pure returns (bytes memory) {
        return
            hex"0001250ffe2f0ffe6f0ffeaf0ffeef0fff2f0001650fff6f1fff301fff701fffb01ffff001fe2c01fe6c0ffd2f0ffd6f0000250000a50000650000e5"
            hex"1ffb301ffbb01ffb701ffbf001fc2c01fcac01fc6c01fcec00782b0078ab00786b0078eb07fa2e07fb2e07faae07fbae07fa6e07fb6e07faee07fbee"
            hex"03fa2d03fb2d03faad03fbad03fa6d03fb6d03faed03fbed00f22c00f32c00f2ac00f3ac00f26c00f36c00f2ec00f3ec07fc2e07fd2e07fcae07fdae"
            hex"07fc6e07fd6e07fcee07fdee00e02c00e22c00e12c00e32c00e0ac00e2ac00e1ac00e3ac00e06c00e26c00e16c00e36c00e0ec00e2ec00e1ec00e3ec"
            hex"01e82d01ea2d01e92d01eb2d01e8ad01eaad01e9ad01ebad01e86d01ea6d01e96d01eb6d01e8ed01eaed01e9ed01ebed01ec2d01ee2d01ed2d01ef2d"
            hex"01ecad01eead01edad01efad01ec6d01ee6d01ed6d01ef6d01eced01eeed01eded01efed01f02d01f22d01f12d01f32d01f0ad01f2ad01f1ad01f3ad"
            hex"01f06d01f26d01f16d01f36d01f0ed01f2ed01f1ed01f3ed03e82e03ec2e03ea2e03ee2e03e92e03ed2e03eb2e03ef2e03e8ae03ecae03eaae03eeae"
            hex"03e9ae03edae03ebae03efae03e86e03ec6e03ea6e03ee6e03e96e03ed6e03eb6e03ef6e03e8ee03ecee03eaee03eeee03e9ee03edee03ebee03efee"
            hex"01c82d01cc2d01ca2d01ce2d01c92d01cd2d01cb2d01cf2d01c8ad01ccad01caad01cead01c9ad01cdad01cbad01cfad01c86d01cc6d01ca6d01ce6d"
            hex"01c96d01cd6d01cb6d01cf6d01c8ed01cced01caed01ceed01c9ed01cded01cbed01cfed01d02d01d42d01d22d01d62d01d12d01d52d01d32d01d72d"
            hex"01d0ad01d4ad01d2ad01d6ad01d1ad01d5ad01d3ad01d7ad01d06d01d46d01d26d01d66d01d16d01d56d01d36d01d76d01d0ed01d4ed01d2ed01d6ed"
            hex"01d1ed01d5ed01d3ed01d7ed01d82d01dc2d01da2d01de2d01d92d01dd2d01db2d01df2d01d8ad01dcad01daad01dead01d9ad01ddad01dbad01dfad"
            hex"01d86d01dc6d01da6d01de6d01d96d01dd6d01db6d01df6d01d8ed01dced01daed01deed01d9ed01dded01dbed0001a53bbd323b7d32";
    }

    /// @notice Returns the header of the block, which defines the code, without the last bits, which fill no byte.
    function header() internal pure returns (bytes memory) {
        return
            hex"b743e009c4103104e38f7bdef7bdef7bdef7bdef7bdef7bdef7bdef7bdef7bdef7bdef7b38270496fd7e5ee5e9b61244c4";
    }

    /// @notice Returns the last bits of the header, and their number.
    function headerRest() internal pure returns (uint256, uint256) {
        return (1, 1);
    }

    /// @notice Returns the end of the block: its bits, and their number.
    function end() internal pure returns (uint256, uint256) {
        return (4092, 12);
    }
}

/// @notice The Huffman code of PNG files with alpha. Pixels have four bytes.
library AlphaCode {
    /// @notice The code of a zero pixel, 36 bits. The bytes of a pixel, spread 9 bits apart, are added to it.
    uint256 internal constant PIXEL = 34426978560;

    /// @notice Returns, for each number of pixels from 1 to 64, the code of the match that repeats one that many times
    /// (19 bits), and its size in bits (5 bits).
    function tables() internal pure returns (bytes memory) {
        return
            hex"0001250002a60000650018e90032aa0033aa000ba80034aa006b2b006b6b006d2b006d6b006f2b006f6b00712b00716b00e62c00e6ac00e66c00e6ec"
            hex"00ea2c00eaac00ea6c00eaec00ee2c00eeac00ee6c00eeec00f22c00f2ac00f26c00f2ec01ec2d01ed2d01ecad01edad01ec6d01ed6d01eced01eded"
            hex"01f42d01f52d01f4ad01f5ad01f46d01f56d01f4ed01f5ed01fc2d01fd2d01fcad01fdad01fc6d01fd6d01fced01fded000c29000d29000ca9000da9"
            hex"000c69000d69000ce9000de9";
    }

    /// @notice Returns the header of the block, which defines the code, without the last bits, which fill no byte.
    function header() internal pure returns (bytes memory) {
        return
            hex"b7c3e030d80c30c00dbffffffffffffffffffffffffffffffffffffffffffffffffffffe50c0100428b65ff50201";
    }

    /// @notice Returns the last bits of the header, and their number.
    function headerRest() internal pure returns (uint256, uint256) {
        return (0, 0);
    }

    /// @notice Returns the end of the block: its bits, and their number.
    function end() internal pure returns (uint256, uint256) {
        return (48, 7);
    }
}
