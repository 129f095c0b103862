// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @notice The square root of `x`, with an error below one and below 2^-22 of it.
/// @dev With h such that x = m * 4^h and 1 <= m < 4, the line 0.343 * (m + 2) is within 3 % of the root of m; each of the two steps
/// of Newton's method, r' = (r + x/r) / 2, squares the relative error and halves it. The search for the highest bit is that of solady's
/// LibBit (https://github.com/vectorized/solady).
function sqrt(uint256 x) pure returns (uint256 r) {
    assembly ("memory-safe") {
        // the branch keeps the compiler from copying all of this to each place of use
        if x {
            // 2h = floor(log2(x)) without its last bit, a bit of it at a time
            let h := shl(7, lt(0xffffffffffffffffffffffffffffffff, x))
            h := or(h, shl(6, lt(0xffffffffffffffff, shr(h, x))))
            h := or(h, shl(5, lt(0xffffffff, shr(h, x))))
            h := or(h, shl(4, lt(0xffff, shr(h, x))))
            h := or(h, shl(3, lt(0xff, shr(h, x))))
            h := or(h, shl(2, lt(0xf, shr(h, x))))
            h := shr(1, or(h, shl(1, lt(0x3, shr(h, x)))))
            // 0.343 * (m + 2) * 2^h, where 351 / 1024 = 0.343
            r := shr(10, mul(351, add(shr(h, x), shl(h, 2))))
            r := shr(1, add(r, div(x, r)))
            r := shr(1, add(r, div(x, r)))
        }
    }
}
