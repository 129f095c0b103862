// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import "../words/EffectRegisters.sol";

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
            let z := shl(8, mload(DEPTH_SCALE))
            attribute := shr(ACCUMULATOR_DEPTH_AT, attribute)
            switch mload(FRAME_IS_ORTHOGRAPHIC)
            case 0 {
                z := div(z, attribute)
                x := sar(24, mul(x, z))
                y := sar(24, mul(y, z))
            }
            default { z := sub(z, attribute) }
            x := sub(x, mload(FADE_X))
            y := sub(y, mload(FADE_Y))
            z := sub(z, mload(FADE_Z))
            opacity := sub(mload(FADE_SQUARE), add(add(mul(x, x), mul(y, y)), mul(z, z)))
            opacity := div(shl(24, mul(opacity, sgt(opacity, 0))), mload(FADE_RANGE))
            if gt(opacity, ONE_24) { opacity := ONE_24 }
        }
    }
}
