// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../words/EffectRegisters.sol";

// Computes the fading of `surface` of picture.py.
// A ground is an object on which others stand: it casts no shadow and fades into the background. At distance d from its position it is
// opaque up to the inner radius r and vanishes from the outer radius R on:
//
//   opacity = (R^2 - d^2) / (R^2 - r^2), clamped to 0..1

library Ground {
    /// @notice Returns the opacity of a ground at a fragment, Q24.
    /// @param attribute The accumulator.
    /// @param x, y As for FragmentLight.
    function opacityAt(uint256 attribute, uint256 x, uint256 y) internal pure returns (uint256 opacity) {
        assembly ("memory-safe") {
            let z := shl(DEPTH_FRACTION, mload(DEPTH_SCALE)) // scale
            attribute := shr(ACCUMULATOR_DEPTH_AT, attribute) // from here on, the depth
            switch mload(FRAME_IS_ORTHOGRAPHIC) // as for the fog
            case 0 {
                z := div(z, attribute) // the fragment in camera space: (x, y, z), Q32
                x := sar(Q24, mul(x, z)) // from a ray to a position
                y := sar(Q24, mul(y, z))
            }
            default { z := sub(z, attribute) } // scale - depth
            x := sub(x, mload(FADE_X)) // from here on, relative to the object
            y := sub(y, mload(FADE_Y))
            z := sub(z, mload(FADE_Z)) // d
            opacity := sub(mload(FADE_SQUARE), add(add(mul(x, x), mul(y, y)), mul(z, z))) // R^2 - d^2
            opacity := div(shl(Q24, mul(opacity, sgt(opacity, 0))), mload(FADE_RANGE)) // / (R^2 - r^2)
            if gt(opacity, ONE_24) { opacity := ONE_24 }
        }
    }
}
