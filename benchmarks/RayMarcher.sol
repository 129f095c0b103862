// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

/// @notice Draws a sphere or a torus by sphere tracing, as shaders do: the baseline of ray_marcher.py.
/// @dev Numbers are fixed-point, 1 being 2^24. The shape is at the origin of its own frame and lies in a ball of radius
/// 1. Rays are parallel. A ray that misses the ball, and one that has taken MOST steps, shows the background.
contract RayMarcher {
    int256 private constant ONE = 1 << 24;
    /// @dev A ray hits the surface if it is nearer than this: a 4,096th.
    int256 private constant NEAR = ONE >> 12;
    uint256 private constant MOST = 64;

    /// @param torus Radius of the ring and of the tube; for a sphere of radius 1, zero.
    /// @param light Unit vector toward the light, in the frame of the shape, as are the next.
    /// @param right,up,back Unit vectors of the picture: `back` points from the shape to the eye.
    struct Scene {
        uint256 side;
        int256 halfHeight;
        int256[2] torus;
        int256[3] light;
        int256[3] right;
        int256[3] up;
        int256[3] back;
        int256 ambient;
        int256 diffuse;
        uint8[3] color;
        uint8[3] background;
    }

    /// @return pixels Red, green and blue, from the upper left.
    function render(Scene calldata scene) external pure returns (bytes memory pixels) {
        unchecked {
            Scene memory s = scene;
            uint256 side = s.side;
            pixels = new bytes(3 * side * side);
            uint256 place;
            for (uint256 row; row < side; ++row) {
                int256 y = s.halfHeight - (s.halfHeight * int256(2 * row + 1)) / int256(side);
                for (uint256 column; column < side; ++column) {
                    int256 x = (s.halfHeight * int256(2 * column + 1)) / int256(side) - s.halfHeight;
                    int256 light = _light(s, x, y);
                    for (uint256 k; k < 3; ++k) {
                        uint256 level = s.background[k];
                        if (light >= 0) {
                            level = (uint256(s.color[k]) * uint256(light) + uint256(ONE >> 1)) >> 24;
                            if (level > 255) level = 255;
                        }
                        pixels[place++] = bytes1(uint8(level));
                    }
                }
            }
        }
    }

    /// @return light What the surface gets that the ray through (x, y) hits; -1 if it hits none.
    function _light(Scene memory s, int256 x, int256 y) private pure returns (int256 light) {
        unchecked {
            int256 half = ONE * ONE - x * x - y * y;
            if (half <= 0) return -1;
            // from where the ray enters the ball
            int256 entry = _root(half);
            int256 end = -entry;
            int256 px = (x * s.right[0] + y * s.up[0]) >> 24;
            int256 py = (x * s.right[1] + y * s.up[1]) >> 24;
            int256 pz = (x * s.right[2] + y * s.up[2]) >> 24;
            int256 ring = s.torus[0];
            for (uint256 step; step < MOST && entry > end; ++step) {
                int256 qx = px + ((entry * s.back[0]) >> 24);
                int256 qy = py + ((entry * s.back[1]) >> 24);
                int256 qz = pz + ((entry * s.back[2]) >> 24);
                if (ring == 0) {
                    int256 distance = _root(qx * qx + qy * qy + qz * qz) - ONE;
                    if (distance < NEAR) return _shade(s, qx, qy, qz, ONE);
                    entry -= distance;
                } else {
                    int256 around = _root(qx * qx + qz * qz);
                    int256 out = around - ring;
                    int256 tube = _root(out * out + qy * qy);
                    int256 distance = tube - s.torus[1];
                    if (distance < NEAR) {
                        return _shade(s, (qx * out) / around, qy, (qz * out) / around, tube);
                    }
                    entry -= distance;
                }
            }
            return -1;
        }
    }

    /// @dev Lambert's law for a normal of this length.
    function _shade(Scene memory s, int256 x, int256 y, int256 z, int256 length) private pure returns (int256) {
        unchecked {
            int256 cosine = (x * s.light[0] + y * s.light[1] + z * s.light[2]) / length;
            return s.ambient + (cosine > 0 ? (s.diffuse * cosine) >> 24 : int256(0));
        }
    }

    /// @dev The square root, rounded down: a first guess by the bits, and Newton's method. For less than 2^64.
    function _root(int256 square) private pure returns (int256 root) {
        assembly ("memory-safe") {
            root := 1
            let rest := square
            if gt(rest, 0xffffffff) {
                root := shl(16, root)
                rest := shr(32, rest)
            }
            if gt(rest, 0xffff) {
                root := shl(8, root)
                rest := shr(16, rest)
            }
            if gt(rest, 0xff) {
                root := shl(4, root)
                rest := shr(8, rest)
            }
            if gt(rest, 0xf) {
                root := shl(2, root)
                rest := shr(4, rest)
            }
            if gt(rest, 3) { root := shl(1, root) }
            // 3/2 of it is nearer on average
            root := shr(1, mul(3, root))
            root := shr(1, add(root, div(square, root)))
            root := shr(1, add(root, div(square, root)))
            root := shr(1, add(root, div(square, root)))
            root := shr(1, add(root, div(square, root)))
            root := sub(root, gt(root, div(square, root)))
        }
    }
}
