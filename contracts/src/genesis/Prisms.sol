// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Elements} from "./Elements.sol";
import {Seed, Tag, Random} from "./Random.sol";
import {Layout, Triangle} from "./Layout.sol";
import {Trigonometry} from "./Trigonometry.sol";

/// @notice The prisms over the triangles of a layout, tilted.
/// @param flatX The x coordinates of the triangles' centroids, scaled and rotated in their plane.
/// @param flatY The y coordinates.
/// @param flatRadius The distances of the centroids from the first corners, truncated.
/// @param x The x coordinates of six points for each prism, three at the far end and three at the near one, not yet centred.
/// @param y The y coordinates.
/// @param z The z coordinates, increasing away from the viewer.
/// @param center The centre of the piece.
/// @param half Half of the mean extent of both ends.
struct Prisms {
    int256[] flatX;
    int256[] flatY;
    int256[] flatRadius;
    int256[] x;
    int256[] y;
    int256[] z;
    int256[2] center;
    int256[2] half;
}

/// @title PrismMaker: makes prisms from triangles.
library PrismMaker {
    using Random for Seed;
    using Elements for int256[];

    /// @dev The larger of the width and height of a piece before it is rotated.
    int256 internal constant EXTENT = 2000;

    Tag private constant TURN = Tag.wrap(bytes32("rotZ") | bytes32(uint256(4)));
    Tag private constant TILT_X = Tag.wrap(bytes32("rotX") | bytes32(uint256(4)));
    Tag private constant TILT_Y = Tag.wrap(bytes32("rotY") | bytes32(uint256(4)));

    /// @dev The rotation and tilt of the prisms of a piece.
    struct Turn {
        int256 size;
        bool turned;
        int256 cosineX;
        int256 sineX;
        int256 cosineY;
        int256 sineY;
    }

    function make(Layout memory laid) internal pure returns (Prisms memory prisms) {
        unchecked {
            Seed seed = laid.seed;
            Turn memory turn;
            turn.size = extent(laid);
            turn.turned = seed.draw(TURN, 0, 1) == 1;
            (turn.cosineX, turn.sineX) = tiltOf(seed, TILT_X);
            (turn.cosineY, turn.sineY) = tiltOf(seed, TILT_Y);
            uint256 count = laid.count;
            (prisms.flatX, prisms.flatY, prisms.flatRadius) = (new int256[](count), new int256[](count), new int256[](count));
            (prisms.x, prisms.y, prisms.z) = (new int256[](6 * count), new int256[](6 * count), new int256[](6 * count));
            for (uint256 k; k != count; ++k) erect(laid.slots[k], turn, prisms, k);
            center(prisms);
        }
    }

    /// @dev Returns the larger of the width and height of all triangles.
    function extent(Layout memory laid) private pure returns (int256) {
        unchecked {
            (int256 left, int256 right) = (type(int256).max, type(int256).min);
            (int256 bottom, int256 top) = (left, right);
            for (uint256 k; k != laid.count; ++k) {
                int256[6] memory corners = laid.slots[k].corners;
                for (uint256 i; i != 6; i += 2) {
                    (int256 x, int256 y) = (corners[i], corners[i + 1]);
                    if (x < left) left = x;
                    if (x > right) right = x;
                    if (y < bottom) bottom = y;
                    if (y > top) top = y;
                }
            }
            return right - left > top - bottom ? right - left : top - bottom;
        }
    }

    function tiltOf(Seed seed, Tag tag) private pure returns (int256 cosine, int256 sine) {
        return seed.draw(tag, 0, 1) == 0
            ? (Trigonometry.COSINE_12, Trigonometry.SINE_12)
            : (Trigonometry.COSINE_348, Trigonometry.SINE_348);
    }

    /// @dev Makes prism `k` from a triangle.
    function erect(Triangle memory triangle, Turn memory turn, Prisms memory prisms, uint256 k) private pure {
        unchecked {
            int256[6] memory c;
            for (uint256 i; i != 6; i += 2) {
                int256 x = triangle.corners[i] * EXTENT / turn.size;
                int256 y = triangle.corners[i + 1] * EXTENT / turn.size;
                if (turn.turned) (x, y) = Trigonometry.rotate(x, y, Trigonometry.COSINE_30, Trigonometry.SINE_30);
                (c[i], c[i + 1]) = (x, y);
                tilt(prisms, 6 * k + i / 2, turn, x, y, triangle.far);
                tilt(prisms, 6 * k + 3 + i / 2, turn, x, y, triangle.near);
            }
            (int256 cx, int256 cy) = ((c[0] + c[2] + c[4]) / 3, (c[1] + c[3] + c[5]) / 3);
            (prisms.flatX[k], prisms.flatY[k]) = (cx, cy);
            int256 square = (cx - c[0]) * (cx - c[0]) + (cy - c[1]) * (cy - c[1]);
            prisms.flatRadius[k] = int256(Trigonometry.root(uint256(square), uint256(triangle.radius * EXTENT / turn.size + 1)));
        }
    }

    function tilt(Prisms memory prisms, uint256 i, Turn memory turn, int256 x, int256 y, int256 z) private pure {
        if (turn.turned) {
            (x, z) = Trigonometry.rotate(x, z, turn.cosineY, turn.sineY);
            (y, z) = Trigonometry.rotate(y, z, turn.cosineX, turn.sineX);
        } else {
            (y, z) = Trigonometry.rotate(y, z, turn.cosineX, turn.sineX);
            (x, z) = Trigonometry.rotate(x, z, turn.cosineY, turn.sineY);
        }
        prisms.x.put(i, x);
        prisms.y.put(i, y);
        prisms.z.put(i, z);
    }

    /// @dev Computes the centre between the minimum and maximum coordinate, each averaged over both ends.
    function center(Prisms memory prisms) private pure {
        unchecked {
            for (uint256 axis; axis != 2; ++axis) {
                int256[] memory values = axis == 0 ? prisms.x : prisms.y;
                (int256 low, int256 high) = bounds(values, 3);
                (int256 farLow, int256 farHigh) = bounds(values, 0);
                (low, high) = ((low + farLow) / 2, (high + farHigh) / 2);
                prisms.center[axis] = (low + high) / 2;
                prisms.half[axis] = (high - low) / 2;
            }
        }
    }

    /// @dev Returns the minimum and maximum coordinate at one end of all prisms.
    /// @param first 0 for the far end, 3 for the near one.
    function bounds(int256[] memory values, uint256 first) private pure returns (int256 low, int256 high) {
        unchecked {
            low = high = values.get(first);
            for (uint256 k = first; k < values.length; k += 6) {
                for (uint256 i = k; i != k + 3; ++i) {
                    int256 value = values.get(i);
                    if (value < low) low = value;
                    if (value > high) high = value;
                }
            }
        }
    }
}
