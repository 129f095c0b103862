// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {FragmentLight} from "../shading/FragmentLight.sol";
import {Samples} from "./Samples.sol";
import "../../words/Registers.sol";

// Shades every fragment individually, at the centroid of the samples that the triangle covers.

library ExactSamples {
    /// @notice Draws a fragment: see SampleRasterizer.drawFragment.
    function fragment(uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure {
        unchecked {
            uint256 p = Samples.place(row, column);
            uint256 depths = Samples.depthsOf(attribute);
            uint256 seen = covered & (depths + BELOW_TOPS_64 - load(p));
            if (seen == 0) return;
            uint256 color = Samples.bytesOf(colorAt(attribute, covered, column, row));
            if (seen == TOPS_64) Samples.paint(p, row, column, depths, color);
            else Samples.write(p, row, column, depths | (color * ONES_64), seen);
        }
    }

    /// @dev Returns the colour at the centroid of the covered samples: signed lanes of 85 bits, Q10.
    function colorAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure returns (uint256) {
        unchecked {
            (uint256 x, uint256 y) = Samples.centroid(covered);
            attribute = Samples.moved(attribute, x, y);
            uint256 step = load(RAY_STEP);
            x = load(RAY_LEFT) + column * step + uint256(int256(x * step) >> 3);
            y = load(RAY_TOP) + row * step + uint256(int256(y * step) >> 3);
            return FragmentLight.colorOf(attribute, x, y);
        }
    }
}
