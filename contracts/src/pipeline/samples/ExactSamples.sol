// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {FragmentLight} from "../shading/FragmentLight.sol";
import {SampleRasterizer} from "./SampleRasterizer.sol";
import {Samples} from "./Samples.sol";
import "../../words/Registers.sol";

// Computes `fill` of picture.py with `shade` at each fragment.
// Shades every fragment individually, at the centroid of the samples that the triangle covers.
abstract contract ExactSamples is SampleRasterizer {
    function drawExact(uint256 p, uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure virtual override {
        unchecked {
            uint256 z = Samples.depthsOf(attribute);
            uint256 seen = covered & (z + BELOW_TOPS_64 - load(p));
            if (seen == 0) return;
            z |= colorAt(attribute, covered, column, row) * ONES_64;
            if (seen == TOPS_64) Samples.paint(p, z);
            else Samples.write(p, z, seen);
        }
    }

    /// @dev Returns the colour at the centroid of the covered samples: three bytes, blue uppermost.
    function colorAt(uint256 attribute, uint256 covered, uint256 column, uint256 row) internal pure virtual returns (uint256) {
        (uint256 there, uint256 x, uint256 y) = Samples.centroid(attribute, covered, column, row);
        return Samples.bytesOf(FragmentLight.colorOf(there, x, y));
    }
}
