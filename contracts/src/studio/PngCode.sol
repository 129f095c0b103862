// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice The Huffman code of the PNG encoder, fitted to pictures of the renderer. Written by tools/png_code.py.
/// @dev All bits are in the order of the stream.
library PngCode {
    /// @notice Bits of the code of 259 zeros, the most that it can tell at once.
    uint256 internal constant LONGEST_RUN_SIZE = 5;
    /// @notice Nine times that code.
    uint256 internal constant NINE_LONGEST_RUNS = 0x84210842108;

    /// @notice Of each byte the code (12 bits) and its length (4 bits); of each number of zeros from 0 to 259 the codes
    /// of a zero and of a match of the others (19 bits), and their length (5 bits).
    function tables() internal pure returns (bytes memory) {
        return
            hex"00010165017506a70de80df81c291c391c491c591c691c7939ca39da39ea39fa3a0a3a1a3a2a3a3a3a4a3a5a3a6a776b777b778b779b77ab77bb77cb77db77eb"
            hex"77fb780b781b782b783b784bf4ec785b786b787bf4fc788bf50cf51cf52cf53cf54cf55cf56cf57cf58cf59cf5acf5bcf5ccf5dcf5ecf5fcf60cf61cf62cf63c"
            hex"f64cf65cf66cf67cf68cf69cf6acf6bcf6ccf6dcf6ecf6fcf70cf71cf72cf73cf74cf75cf76cf77cf78cf79cf7acf7bcf7ccf7dcf7ecf7fcf80cf81cf82cf83c"
            hex"f84cf85cf86cf87cf88cf89cf8ac789b78ab78bb3a7af8bcf8ccf8dcf8ecf8fcf90cf91cf92cf93cf94cf95cf96cf97cf98cf99cf9acf9bcf9ccf9dcf9ecf9fc"
            hex"fa0cfa1cfa2cfa3cfa4cfa5cfa6cfa7cfa8cfa9cfaacfabcfaccfadcfaecfafcfb0cfb1cfb2cfb3cfb4cfb5c3a8a78cb78db78ebfb6cfb7cfb8cfb9cfbacfbbc"
            hex"fbccfbdcfbecfbfcfc0cfc1cfc2cfc3cfc4cfc5cfc6cfc7cfc8cfc9cfcacfcbcfcccfcdcfcecfcfcfd0cfd1cfd2cfd3cfd4cfd5cfd6cfd7cfd8cfd9cfdacfdbc"
            hex"fdccfddcfdecfdfcfe0cfe1cfe2cfe3cfe4cfe5cfe6cfe7cfe8cfe9cfeacfebcfeccfedcfeecfefcff0c78fbff1c790b791b792bff2c793b794b795b796b797b"
            hex"798b799b79ab79bb79cb79db79eb79fb7a0b7a1b3a9a3aaa3aba3aca3ada3aea3afa3b0a3b1a3b2a3b3a1c891c991ca91cb91cc91cd90e0806b706c701850195"
            hex"00000000000100000200000303fd0e03fd4e03fd8e03fdce03fe0e00028603fe4e03fe8e07fd8f07fdcf03d10e03d14e07fe0f07fe4f07fe8f07fecf00340a00"
            hex"348a00344a0034ca07a30f07a38f07a34f07a3cf0ffe100ffe900ffe500ffed003b40e03b48e03b44e03b4ce0f48100f49100f48900f49900f48500f49500f48"
            hex"d00f49d0076a0f076b0f076a8f076b8f076a4f076b4f076acf076bcf0f4a100f4b100f4a900f4b900f4a500f4b500f4ad00f4bd01ffe111fff111ffe911fff91"
            hex"1ffe511fff511ffed11fffd10ed8100eda100ed9100edb100ed8900eda900ed9900edb900ed8500eda500ed9500edb500ed8d00edad00ed9d00edbd00edc100e"
            hex"de100edd100edf100edc900ede900edd900edf900edc500ede500edd500edf500edcd00eded00eddd00edfd01e98111e9a111e99111e9b111e98911e9a911e99"
            hex"911e9b911e98511e9a511e99511e9b511e98d11e9ad11e99d11e9bd10ee0100ee2100ee1100ee3100ee0900ee2900ee1900ee3900ee0500ee2500ee1500ee350"
            hex"0ee0d00ee2d00ee1d00ee3d01dc8111dcc111dca111dce111dc9111dcd111dcb111dcf111dc8911dcc911dca911dce911dc9911dcd911dcb911dcf911dc8511d"
            hex"cc511dca511dce511dc9511dcd511dcb511dcf511dc8d11dccd11dcad11dced11dc9d11dcdd11dcbd11dcfd11dd0111dd4111dd2111dd6111dd1111dd5111dd3"
            hex"111dd7111dd0911dd4911dd2911dd6911dd1911dd5911dd3911dd7911dd0511dd4511dd2511dd6511dd1511dd5511dd3511dd7511dd0d11dd4d11dd2d11dd6d1"
            hex"1dd1d11dd5d11dd3d11dd7d103680e036c0e036a0e036e0e03690e036d0e036b0e036f0e03688e036c8e036a8e036e8e03698e036d8e036b8e036f8e03684e03"
            hex"6c4e036a4e036e4e03694e036d4e036b4e036f4e0368ce036cce036ace036ece0369ce036dce036bce036fce03700e03740e03720e03760e03710e03750e0373"
            hex"0e03770e03708e03748e03728e03768e03718e03758e03738e03778e03704e03744e03724e03764e03714e03754e03734e03774e0370ce0374ce0372ce0376ce"
            hex"0371ce0375ce0373ce000105";
    }

    /// @notice What tells the code at the beginning of the block, as far as it fills bytes.
    function header() internal pure returns (bytes memory) {
        return
            hex"b703e00124e38e2003177bdded0f717bc9449453def7bdef7bdc4909ef7bdef7824a7bdef7bdef7b8a24a2f7921eef6f6edda6d248a585020a00803766";
    }

    /// @notice The rest of it: bits, and how many.
    function headerRest() internal pure returns (uint256, uint256) {
        return (0, 2);
    }

    /// @notice What ends the block: bits, and how many.
    function end() internal pure returns (uint256, uint256) {
        return (4083, 12);
    }
}
