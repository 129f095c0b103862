// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @notice Returns the square root of `x`, with an error below 1 and a relative error below 2^-22.
/// @dev With h such that x = m * 4^h and 1 <= m < 4, the line 0.343 * (m + 2) approximates the root of m within 3 %; each of the two steps
/// of Newton's method, r' = (r + x/r) / 2, squares the relative error and halves it. The search for the highest bit follows solady's LibBit
/// (https://github.com/vectorized/solady).
function sqrt(uint256 x) pure returns (uint256 r) {
    assembly ("memory-safe") {
        // the branch prevents the compiler from inlining this at each use
        if x {
            // 2h = floor(log2(x)) without its last bit, computed bit by bit
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

/// @notice Returns the square root of `x` as `sqrt` does.
/// @param hint The address of h for the last root of the same kind, which is kept there: neighbours have similar magnitudes.
function sqrtNear(uint256 x, uint256 hint) pure returns (uint256 r) {
    assembly ("memory-safe") {
        let h := mload(hint)
        if gt(sub(shr(shl(1, h), x), 1), 2) {
            // not 1 <= m < 4
            h := shl(7, lt(0xffffffffffffffffffffffffffffffff, x))
            h := or(h, shl(6, lt(0xffffffffffffffff, shr(h, x))))
            h := or(h, shl(5, lt(0xffffffff, shr(h, x))))
            h := or(h, shl(4, lt(0xffff, shr(h, x))))
            h := or(h, shl(3, lt(0xff, shr(h, x))))
            h := or(h, shl(2, lt(0xf, shr(h, x))))
            h := shr(1, or(h, shl(1, lt(0x3, shr(h, x)))))
            mstore(hint, h)
        }
        r := shr(10, mul(351, add(shr(h, x), shl(h, 2))))
        r := shr(1, add(r, div(x, r)))
        r := shr(1, add(r, div(x, r)))
    }
}
