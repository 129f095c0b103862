// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Extensions, RECORD_HEADER} from "../scene/Extensions.sol";
import {GROUND} from "./Effects.sol";
import "./Registers.sol";

// An object on which others stand: it casts no shadow, and fades into what is behind it. With the distance d from its position it is opaque
// up to the inner radius r, and nothing is left of it from the outer radius R on:
//
//   opacity = (R^2 - d^2) / (R^2 - r^2), between 0 and 1

library Ground {
    /// @notice Sets how the object whose uniforms were read fades.
    /// @param object Its number in the scene.
    function setObject(uint256 object) internal pure {
        unchecked {
            store(FADE_RANGE, 0);
            if (load(OBJECT_MODE) & IS_BLENDED != 0) return;
            uint256 end = load(EFFECTS_END);
            uint256 key = GROUND << 16 | object;
            for (uint256 record = load(EFFECTS); record != end; record += RECORD_HEADER + Extensions.sizeOf(record)) {
                if (Extensions.keyOf(record) != key) continue;
                uint256 content = Extensions.word(record + RECORD_HEADER);
                uint256 inner = content >> 192;
                uint256 outer = (content >> 128) & LANE_64;
                store(FADE_SQUARE, outer * outer);
                store(FADE_RANGE, outer * outer - inner * inner);
                setPlace();
            }
        }
    }

    /// @dev Where its position is in camera space, by the column and the row at which it is seen.
    function setPlace() private pure {
        unchecked {
            uint256 clip = load(MATRIX_T) + CLIP_BIAS;
            int256 w = int256(clip) >> CLIP_W_AT;
            int256 x = int256(clip & CLIP_X_MASK) - int256(CLIP_HALF);
            int256 y = int256((clip >> CLIP_Y_AT) & CLIP_Y_MASK) - int256(CLIP_HALF);
            storeSigned(FADE_Z, w);
            storeSigned(FADE_X, placeOf(loadSigned(RAY_LEFT), x, w));
            storeSigned(FADE_Y, placeOf(loadSigned(RAY_TOP), y, w));
        }
    }

    function placeOf(int256 first, int256 column, int256 w) private pure returns (int256) {
        unchecked {
            int256 step = loadSigned(RAY_STEP);
            if (load(FRAME_IS_ORTHOGRAPHIC) != 0) return first + ((column * step) >> (Q32 + SUBPIXEL_BITS));
            return (first * w + ((column * step) >> SUBPIXEL_BITS)) >> Q24;
        }
    }

    /// @notice How much of a ground is left at a fragment, Q24.
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
