// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {sqrt} from "../math/Roots.sol";
import {STARTS, STROKES} from "./Glyphs.sol";
import {Model} from "./ModelMaker.sol";
import {Shapes} from "./Shapes.sol";

/// @title Lettering: adds text as solid letters to a mesh.
/// @notice Supports printable ASCII and line feeds. Strokes are a ninth of the height of capitals wide, with mitred corners; each stroke is
/// a closed solid. Use flat shading.
library Lettering {
    /// @notice Text must consist of the characters 0x20 to 0x7e, and 0x0a for a new line.
    error NoSuchLetter(uint256 position, uint256 character);

    /// @dev Parts per step of the grid of the letters. Capitals are 10 steps high, measured between the middle lines of strokes.
    int256 private constant STEP = 4096;
    /// @dev Half the width of a stroke.
    int256 private constant HALF = STEP * 5 / 8;
    /// @dev Height of capitals including the width of strokes.
    int256 private constant CAPITAL = 10 * STEP + 2 * HALF;
    /// @dev Gap between letters, measured between the middle lines of strokes.
    int256 private constant GAP = 3 * STEP;
    int256 private constant SPACE = 5 * STEP;
    /// @dev Distance between lines of text.
    int256 private constant LINE = 18 * STEP;
    /// @dev The y coordinate that is encoded as 0.
    int256 private constant LOWEST = -3;
    uint256 private constant END_OF_STROKE = 0xfe;

    /// @dev Parameters that are common to all strokes.
    /// @param left Left end of the letter, in parts of a step from x.
    /// @param base Baseline of the letter, in parts of a step from y.
    struct Pen {
        int256 x;
        int256 y;
        int256 z0;
        int256 z1;
        int256 height;
        uint256 color;
        int256 left;
        int256 base;
    }

    /// @notice Adds text that is read from +z. A stroke of n points adds 4 n vertices and 8 n - 4 faces; a letter has about 40 faces.
    /// @param x Left end of the text.
    /// @param y Baseline of the first line.
    /// @param z Back of the letters, or their front if `depth` is negative.
    /// @param height Height of capitals, 1 to 65,535; use at least 20 for good shapes. Lines are 1.6 times as far apart.
    /// @param depth Distance from back to front. If it is 0, letters are sheets that are visible from both sides.
    /// @param color 0xRRGGBB.
    function text(
        Model memory m, string memory words, int256 x, int256 y, int256 z, int256 height, int256 depth, uint256 color
    ) internal pure {
        checkHeight(height);
        Pen memory pen;
        (pen.x, pen.y, pen.height, pen.color) = (x, y, height, color);
        (pen.z0, pen.z1) = depth < 0 ? (z + depth, z) : (z, z + depth);
        write(m, bytes(words), pen);
    }

    /// @notice Returns the width of the longest line of a text, in the units of `height`.
    function textWidth(string memory words, int256 height) internal pure returns (int256 width) {
        checkHeight(height);
        unchecked {
            (bytes memory all, bytes memory strokes, bytes memory starts) = (bytes(words), STROKES, STARTS);
            int256 left;
            int256 right;
            for (uint256 k; k != all.length; ++k) {
                if (all[k] == "\n") {
                    left = 0;
                } else if (all[k] == " ") {
                    left += SPACE;
                } else {
                    left += widthOf(strokes, start(starts, all[k], k)) + GAP;
                    if (left > right) right = left;
                }
            }
            if (right != 0) width = scaled(right - GAP + 2 * HALF, height);
        }
    }

    function checkHeight(int256 height) private pure {
        if (height < 1 || height > 65535) revert Shapes.SizeOutOfRange(height);
    }

    function write(Model memory m, bytes memory words, Pen memory pen) private pure {
        unchecked {
            (bytes memory strokes, bytes memory starts) = (STROKES, STARTS);
            for (uint256 k; k != words.length; ++k) {
                if (words[k] == "\n") {
                    (pen.left, pen.base) = (0, pen.base - LINE);
                } else if (words[k] == " ") {
                    pen.left += SPACE;
                } else {
                    uint256 begin = start(starts, words[k], k);
                    letter(m, strokes, begin, pen);
                    pen.left += widthOf(strokes, begin) + GAP;
                }
            }
        }
    }

    /// @dev Returns the offset of the strokes of a character.
    function start(bytes memory starts, bytes1 character, uint256 position) private pure returns (uint256) {
        unchecked {
            uint256 code = uint8(character);
            if (code < 0x21 || code > 0x7e) revert NoSuchLetter(position, code);
            code = 2 * (code - 0x21);
            return uint256(uint8(starts[code])) << 8 | uint8(starts[code + 1]);
        }
    }

    function widthOf(bytes memory strokes, uint256 begin) private pure returns (int256 width) {
        unchecked {
            for (uint256 code; (code = uint8(strokes[begin])) != 0xff; ++begin) {
                int256 x = int256(code >> 4) * STEP;
                if (code != END_OF_STROKE && x > width) width = x;
            }
        }
    }

    function letter(Model memory m, bytes memory strokes, uint256 begin, Pen memory pen) private pure {
        unchecked {
            while (true) {
                uint256 end = begin;
                while (uint8(strokes[end]) < END_OF_STROKE) ++end;
                int256[2][] memory points = new int256[2][](end - begin);
                for (uint256 k; k != points.length; ++k) {
                    uint256 code = uint8(strokes[begin + k]);
                    points[k] = [int256(code >> 4) * STEP, (int256(code & 15) + LOWEST) * STEP];
                }
                stroke(m, points, pen);
                if (uint8(strokes[end]) != END_OF_STROKE) return;
                begin = end + 1;
            }
        }
    }

    /// @dev Adds a stroke. Its ends extend by half its width.
    function stroke(Model memory m, int256[2][] memory points, Pen memory pen) private pure {
        unchecked {
            if (points.length == 1) points = dot(points[0]);
            uint256 last = points.length - 1;
            bool closed = points[0][0] == points[last][0] && points[0][1] == points[last][1];
            int256[2][] memory ways = new int256[2][](last);
            for (uint256 k; k != last; ++k) ways[k] = direction(points[k], points[k + 1]);
            if (!closed) {
                move(points[0], ways[0], -HALF);
                move(points[last], ways[last - 1], HALF);
            }
            uint256 first = m.vertexCount;
            uint256 count = closed ? last : last + 1;
            for (uint256 k; k != count; ++k) {
                corner(m, points[k], ways[k != 0 ? k - 1 : closed ? last - 1 : 0], ways[k != last ? k : k - 1], pen);
            }
            for (uint256 k; k != last; ++k) join(m, first + 4 * k, first + (k + 1 == count ? 0 : 4 * (k + 1)));
            if (closed) return;
            m.quad(first + 2, first + 3, first + 1, first);
            first += 4 * last;
            m.quad(first + 3, first + 2, first, first + 1);
        }
    }

    /// @dev Returns a short line through a point, which becomes a square when its ends are extended.
    function dot(int256[2] memory point) private pure returns (int256[2][] memory points) {
        points = new int256[2][](2);
        (points[0], points[1]) = ([point[0] - 1, point[1]], [point[0] + 1, point[1]]);
    }

    /// @dev Moves a point along a unit vector.
    function move(int256[2] memory point, int256[2] memory way, int256 length) private pure {
        unchecked {
            point[0] += length * way[0] >> 16;
            point[1] += length * way[1] >> 16;
        }
    }

    /// @dev Returns the unit vector from a to b, Q16.
    function direction(int256[2] memory a, int256[2] memory b) private pure returns (int256[2] memory) {
        unchecked {
            (int256 x, int256 y) = (b[0] - a[0], b[1] - a[1]);
            int256 length = int256(sqrt(uint256(x * x + y * y) << 64));
            return [(x << 48) / length, (y << 48) / length];
        }
    }

    /// @dev Adds the four vertices where two segments of a stroke meet: front left, front right, back left, back right.
    /// @param u Direction of the segment before.
    /// @param v Direction of the segment after.
    function corner(Model memory m, int256[2] memory point, int256[2] memory u, int256[2] memory v, Pen memory pen) private pure {
        unchecked {
            // the mitre is the sum of both normals, (-y, x), divided by 1 + their dot product; limited to four times the length of a normal
            int256 divisor = (1 << 16) + ((u[0] * v[0] + u[1] * v[1]) >> 16);
            if (divisor < 1 << 14) divisor = 1 << 14;
            (int256 x, int256 y) = (-HALF * (u[1] + v[1]) / divisor, HALF * (u[0] + v[0]) / divisor);
            sides(m, pen, point[0] + x, point[1] + y, point[0] - x, point[1] - y);
        }
    }

    /// @dev Adds two points at the front and at the back, in parts of a step from the left end and the baseline of the letter.
    function sides(Model memory m, Pen memory pen, int256 x0, int256 y0, int256 x1, int256 y1) private pure {
        (x0, x1) = (pen.x + scaled(pen.left + HALF + x0, pen.height), pen.x + scaled(pen.left + HALF + x1, pen.height));
        (y0, y1) = (pen.y + scaled(pen.base + HALF + y0, pen.height), pen.y + scaled(pen.base + HALF + y1, pen.height));
        m.vertex(x0, y0, pen.z1, pen.color);
        m.vertex(x1, y1, pen.z1, pen.color);
        m.vertex(x0, y0, pen.z0, pen.color);
        m.vertex(x1, y1, pen.z0, pen.color);
    }

    /// @dev Scales parts of a step to units, rounded to the nearest.
    function scaled(int256 value, int256 height) private pure returns (int256) {
        unchecked {
            int256 twice = 2 * value * height / CAPITAL;
            return (twice + (twice < 0 ? -1 : int256(1))) / 2;
        }
    }

    /// @dev Adds the faces between two corners: front, back, right and left.
    function join(Model memory m, uint256 a, uint256 b) private pure {
        unchecked {
            m.quad(a + 1, b + 1, b, a);
            m.quad(a + 3, a + 2, b + 2, b + 3);
            m.quad(a + 3, b + 3, b + 1, a + 1);
            m.quad(b + 2, a + 2, a, b);
        }
    }
}
