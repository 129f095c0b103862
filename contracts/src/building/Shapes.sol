// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {Fixed} from "../math/Fixed.sol";
import {sinCosOfHalf} from "../math/Euler.sol";
import {Model} from "./ModelMaker.sol";

/// @title Shapes: adds boxes, solids of revolution and extrusions to a mesh.
/// @notice Faces point outward. Axes of revolution are parallel to y; rotate the object for other axes. All shapes except open lathes are
/// closed. With `packSmooth`, walls are smooth and the edges of caps are sharp.
library Shapes {
    /// @notice A radius or height must be 1 to 65,535; the radius of a profile must not be negative; a height must not be 0.
    error SizeOutOfRange(int256 size);
    /// @notice A circle must have `least` to 65,535 segments; a sphere `least` to 65,535 rings.
    error SegmentsOutOfRange(uint256 segments, uint256 least);
    /// @notice A profile must have at least 2 points, an outline 3.
    error TooFewPoints(uint256 points, uint256 least);
    /// @notice The outline crosses itself, or encloses no area.
    error NotAnOutline();
    /// @notice The text is not a list of points such as "0,0 50,-10"; `position` is the first wrong character.
    error NotPoints(uint256 position);

    /// @dev Parameters that are common to all rings of a lathe.
    /// @param sines Sines of the angles of the segments, Q32.
    /// @param cosines Their cosines, Q32.
    struct Turn {
        int256 x;
        int256 y;
        int256 z;
        uint256 color;
        int256[] sines;
        int256[] cosines;
        bool inward;
    }

    /// @notice Adds a box between any two opposite corners: 8 vertices, 12 faces. A box without thickness is a sheet that is visible from
    /// both sides.
    /// @param color 0xRRGGBB.
    function box(Model memory m, int256 x0, int256 y0, int256 z0, int256 x1, int256 y1, int256 z1, uint256 color) internal pure {
        unchecked {
            if (x0 > x1) (x0, x1) = (x1, x0);
            if (y0 > y1) (y0, y1) = (y1, y0);
            if (z0 > z1) (z0, z1) = (z1, z0);
            uint256 v = m.vertex(x0, y0, z0, color);
            m.vertex(x1, y0, z0, color);
            m.vertex(x1, y1, z0, color);
            m.vertex(x0, y1, z0, color);
            m.vertex(x0, y0, z1, color);
            m.vertex(x1, y0, z1, color);
            m.vertex(x1, y1, z1, color);
            m.vertex(x0, y1, z1, color);
            m.quad(v + 4, v + 5, v + 6, v + 7);
            m.quad(v, v + 3, v + 2, v + 1);
            m.quad(v + 1, v + 2, v + 6, v + 5);
            m.quad(v, v + 4, v + 7, v + 3);
            m.quad(v + 3, v + 7, v + 6, v + 2);
            m.quad(v, v + 1, v + 5, v + 4);
        }
    }

    /// @notice Adds a sphere with centre (x, y, z): segments * (rings - 1) + 2 vertices, 2 * segments * (rings - 1) faces.
    /// @param segments Number of sides as seen from above, at least 3.
    /// @param rings Number of bands between the poles, at least 2.
    /// @param color 0xRRGGBB.
    function sphere(Model memory m, int256 x, int256 y, int256 z, int256 radius, uint256 segments, uint256 rings, uint256 color)
        internal pure
    {
        checkSize(radius);
        if (rings < 2 || rings > 65535) revert SegmentsOutOfRange(rings, 2);
        lathe(m, x, y, z, arc(radius, rings), segments, color);
    }

    /// @notice Adds a cylinder whose base has its centre at (x, y, z): 4 * segments + 2 vertices, 4 * segments faces.
    /// @param height Height along y; if it is negative, the cylinder extends downward.
    /// @param segments Number of sides, at least 3.
    /// @param color 0xRRGGBB.
    function cylinder(Model memory m, int256 x, int256 y, int256 z, int256 radius, int256 height, uint256 segments, uint256 color)
        internal pure
    {
        checkSize(radius);
        if (height == 0) revert SizeOutOfRange(height);
        int256[2][] memory profile = new int256[2][](6);
        // the edges twice, so that they are sharp
        profile[1][0] = profile[2][0] = profile[3][0] = profile[4][0] = radius;
        profile[3][1] = profile[4][1] = profile[5][1] = height;
        lathe(m, x, y, z, profile, segments, color);
    }

    /// @notice Adds a cone whose base has its centre at (x, y, z): 2 * segments + 2 vertices, 2 * segments faces.
    /// @param height Height of the apex above the base; if it is negative, the cone extends downward.
    /// @param segments Number of sides, at least 3.
    /// @param color 0xRRGGBB.
    function cone(Model memory m, int256 x, int256 y, int256 z, int256 radius, int256 height, uint256 segments, uint256 color)
        internal pure
    {
        checkSize(radius);
        if (height == 0) revert SizeOutOfRange(height);
        int256[2][] memory profile = new int256[2][](4);
        profile[1][0] = profile[2][0] = radius;
        profile[3][1] = height;
        lathe(m, x, y, z, profile, segments, color);
    }

    /// @notice Adds a torus about the vertical axis through (x, y, z): segments * sides vertices, 2 * segments * sides faces.
    /// @param radius Distance from the centre to the middle of the tube, at most 65,535.
    /// @param tube Radius of the tube, at most `radius`.
    /// @param segments Number of segments around the axis, at least 3.
    /// @param sides Number of sides of the tube, at least 3.
    /// @param color 0xRRGGBB.
    function torus(
        Model memory m, int256 x, int256 y, int256 z, int256 radius, int256 tube, uint256 segments, uint256 sides, uint256 color
    ) internal pure {
        lathe(m, x, y, z, section(radius, tube, sides), segments, color);
    }

    /// @notice Adds the solid of revolution of a profile about the vertical axis through (x, y, z), such as a vase or a chess piece. Each
    /// point of the profile adds `segments` vertices, or one if it is on the axis; each line between two points adds 2 * segments faces, or
    /// `segments` if one end is on the axis.
    /// @param profile Radius, at least 0, and height above y of each point, going up or down. Repeat a point for a sharp edge with
    /// `packSmooth`. A profile that begins and ends on the axis, or ends at its first point, gives a closed solid; if an open one can be
    /// seen from inside, clear the object's flag CULL_BACKFACES.
    /// @param segments Number of sides as seen from above, at least 3.
    /// @param color 0xRRGGBB.
    function lathe(
        Model memory m, int256 x, int256 y, int256 z, int256[2][] memory profile, uint256 segments, uint256 color
    ) internal pure {
        unchecked {
            if (segments < 3 || segments > 65535) revert SegmentsOutOfRange(segments, 3);
            uint256 last = profile.length - 1;
            if (profile.length < 2) revert TooFewPoints(profile.length, 2);
            Turn memory turn;
            (turn.x, turn.y, turn.z, turn.color, turn.inward) = (x, y, z, color, goesDown(profile));
            setAngles(turn, segments);
            uint256 first = level(m, turn, profile[0]);
            uint256 lower = first;
            for (uint256 k = 1; k <= last; ++k) {
                // a closed profile shares its first ring
                uint256 upper = k == last && last > 1 && isSame(profile[0], profile[last]) ? first : level(m, turn, profile[k]);
                if (!isSame(profile[k - 1], profile[k])) {
                    band(m, turn, lower, profile[k - 1][0] == 0 ? 0 : 1, upper, profile[k][0] == 0 ? 0 : 1);
                }
                lower = upper;
            }
        }
    }

    /// @notice Adds the extrusion of an outline along z: 4 n vertices and 4 n - 4 faces for n points.
    /// @param outline x and y of its points, clockwise or counter-clockwise. The last point is joined to the first. It may be concave and
    /// must not cross itself. Repeat a point for a sharp edge with `packSmooth`; walls are smooth at other points.
    /// @param z0 One end along z.
    /// @param z1 The other end. If both are equal, the result is a sheet that is visible from both sides.
    /// @param color 0xRRGGBB.
    function extrusion(Model memory m, int256[2][] memory outline, int256 z0, int256 z1, uint256 color) internal pure {
        unchecked {
            if (outline.length < 3) revert TooFewPoints(outline.length, 3);
            if (z0 > z1) (z0, z1) = (z1, z0);
            uint256[] memory cap = corners(outline);
            uint256 front = m.vertexCount;
            for (uint256 k; k != outline.length; ++k) m.vertex(outline[k][0], outline[k][1], z1, color);
            uint256 back = m.vertexCount;
            for (uint256 k; k != outline.length; ++k) m.vertex(outline[k][0], outline[k][1], z0, color);
            checkSimple(outline, cap);
            bool clockwise = doubleArea(outline, cap) < 0;
            cut(m, outline, cap, front, back, clockwise);
            // walls do not share vertices with the caps, so that their edges are sharp
            for (uint256 k; k != outline.length; ++k) m.vertex(outline[k][0], outline[k][1], z1, color);
            for (uint256 k; k != outline.length; ++k) m.vertex(outline[k][0], outline[k][1], z0, color);
            wall(m, outline, clockwise);
        }
    }

    /// @notice Parses points for `lathe` and `extrusion`.
    /// @param text "x,y x,y ...": whole numbers from -65,535 to 65,535, with one comma between x and y and one space between points.
    /// @return list The points (x, y).
    function points(string memory text) internal pure returns (int256[2][] memory list) {
        unchecked {
            bytes memory all = bytes(text);
            list = new int256[2][](all.length / 4 + 1);
            uint256 count;
            for (uint256 place; place <= all.length; ++place) {
                int256 x;
                (x, place) = number(all, place);
                if (place >= all.length || all[place] != ",") revert NotPoints(place);
                int256 y;
                (y, place) = number(all, place + 1);
                if (place < all.length && all[place] != " ") revert NotPoints(place);
                list[count++] = [x, y];
            }
            assembly ("memory-safe") {
                mstore(list, count)
            }
        }
    }

    /// @dev Returns the number at a position of the text, and the position after it.
    function number(bytes memory all, uint256 place) private pure returns (int256 value, uint256) {
        unchecked {
            bool negative = place < all.length && all[place] == "-";
            if (negative) ++place;
            uint256 first = place;
            for (; place < all.length; ++place) {
                uint256 digit = uint256(uint8(all[place])) - 48;
                if (digit > 9) break;
                value = 10 * value + int256(digit);
                if (value > 65535) revert NotPoints(first);
            }
            if (place == first) revert NotPoints(place);
            return (negative ? -value : value, place);
        }
    }

    /// @notice Returns the outline of a regular polygon for `extrusion`, centred at the origin, with a corner at the top.
    /// @param corners_ Number of corners, at least 3.
    function polygon(int256 radius, uint256 corners_) internal pure returns (int256[2][] memory outline) {
        return star(radius, radius, corners_, 1);
    }

    /// @notice Returns the outline of a star for `extrusion`, centred at the origin, with a point at the top.
    /// @param outer Radius of the points.
    /// @param inner Radius of the corners between them.
    /// @param count Number of points, at least 2.
    function star(int256 outer, int256 inner, uint256 count) internal pure returns (int256[2][] memory outline) {
        return star(outer, inner, count, 2);
    }

    /// @dev Returns the corners of a star, or only its points if `step` is 1.
    function star(int256 outer, int256 inner, uint256 count, uint256 step) private pure returns (int256[2][] memory outline) {
        unchecked {
            if (count > 32767 || count * step < 3) revert SegmentsOutOfRange(count, 4 - step);
            checkSize(outer);
            checkSize(inner);
            outline = new int256[2][](count * step);
            for (uint256 k; k != outline.length; ++k) {
                (Fixed sine, Fixed cosine) = sinCosOfHalf(int256((720 * k << 32) / outline.length));
                int256 radius = k % step == 0 ? outer : inner;
                outline[k] = [-times(radius, sine.raw()), times(radius, cosine.raw())];
            }
        }
    }

    /// @dev Returns the cross-section of a torus as a closed profile.
    function section(int256 radius, int256 tube, uint256 sides) private pure returns (int256[2][] memory profile) {
        unchecked {
            checkSize(tube);
            if (radius < tube || radius > 65535) revert SizeOutOfRange(radius);
            if (sides < 3 || sides > 65535) revert SegmentsOutOfRange(sides, 3);
            profile = new int256[2][](sides + 1);
            for (uint256 k; k <= sides; ++k) {
                (Fixed sine, Fixed cosine) = sinCosOfHalf(int256((720 * k << 32) / sides));
                profile[k] = [radius + times(tube, cosine.raw()), times(tube, sine.raw())];
            }
        }
    }

    /// @dev Adds the walls between the last vertices: a front and a back outline.
    function wall(Model memory m, int256[2][] memory outline, bool clockwise) private pure {
        unchecked {
            uint256 count = outline.length;
            uint256 front = m.vertexCount - 2 * count;
            for (uint256 k; k != count; ++k) {
                uint256 next = k + 1 == count ? 0 : k + 1;
                if (isSame(outline[k], outline[next])) continue;
                (uint256 a, uint256 b) = clockwise ? (front + next, front + k) : (front + k, front + next);
                m.quad(a + count, b + count, b, a);
            }
        }
    }

    /// @dev Reverts if two edges cross. Edges may touch, as those of a bridge to a hole do.
    function checkSimple(int256[2][] memory outline, uint256[] memory numbers) private pure {
        unchecked {
            uint256 count = numbers.length;
            for (uint256 j = 2; j < count; ++j) {
                (int256[2] memory c, int256[2] memory d) = (outline[numbers[j]], outline[numbers[j + 1 == count ? 0 : j + 1]]);
                for (uint256 k; k + 1 < j; ++k) {
                    (int256[2] memory a, int256[2] memory b) = (outline[numbers[k]], outline[numbers[k + 1]]);
                    bool isCrossed = haveOppositeSigns(side(a, b, c), side(a, b, d));
                    if (isCrossed && haveOppositeSigns(side(c, d, a), side(c, d, b))) revert NotAnOutline();
                }
            }
        }
    }

    /// @dev Returns whether one number is positive and the other negative.
    function haveOppositeSigns(int256 a, int256 b) private pure returns (bool) {
        return (a < 0 && b > 0) || (a > 0 && b < 0);
    }

    /// @dev Triangulates the front and back caps by ear clipping: an ear is a convex corner whose triangle contains no other point.
    /// Source: G. H. Meisters, "Polygons have ears", The American Mathematical Monthly 82 (1975).
    function cut(Model memory m, int256[2][] memory outline, uint256[] memory rest, uint256 front, uint256 back, bool clockwise)
        private pure
    {
        unchecked {
            if (clockwise) for (uint256 k; k != rest.length / 2; ++k) {
                (rest[k], rest[rest.length - 1 - k]) = (rest[rest.length - 1 - k], rest[k]);
            }
            uint256 ear;
            uint256 tried;
            for (uint256 count = rest.length; count != 2;) {
                if (tried > count) revert NotAnOutline();
                if (ear >= count) ear = 0;
                (uint256 a, uint256 b, uint256 c) = (rest[ear == 0 ? count - 1 : ear - 1], rest[ear], rest[ear + 1 == count ? 0 : ear + 1]);
                if (!isEar(outline, rest, count, [a, b, c])) {
                    ++ear;
                    ++tried;
                    continue;
                }
                m.face(front + a, front + b, front + c);
                m.face(back + c, back + b, back + a);
                --count;
                for (uint256 k = ear; k < count; ++k) rest[k] = rest[k + 1];
                tried = 0;
                // continue at the next corner: a fan about one corner would have thin triangles
                ++ear;
            }
        }
    }

    /// @dev Returns whether the corner b is convex, and no other point lies in or on the triangle a, b, c.
    function isEar(int256[2][] memory outline, uint256[] memory rest, uint256 count, uint256[3] memory abc) private pure returns (bool) {
        unchecked {
            (int256[2] memory a, int256[2] memory b, int256[2] memory c) = (outline[abc[0]], outline[abc[1]], outline[abc[2]]);
            if (side(a, b, c) <= 0) return false;
            for (uint256 k; k != count; ++k) {
                int256[2] memory p = outline[rest[k]];
                if (side(a, b, p) < 0 || side(b, c, p) < 0 || side(c, a, p) < 0) continue;
                if (!isSame(p, a) && !isSame(p, b) && !isSame(p, c)) return false;
            }
            return true;
        }
    }

    /// @dev Returns twice the signed area of a, b, p: positive if p lies to the left of the line from a to b. Coordinates have 16 bits.
    function side(int256[2] memory a, int256[2] memory b, int256[2] memory p) private pure returns (int256) {
        unchecked {
            return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        }
    }

    /// @dev Returns the indices of the points, without those that equal the previous point.
    function corners(int256[2][] memory outline) private pure returns (uint256[] memory numbers) {
        unchecked {
            numbers = new uint256[](outline.length);
            uint256 count;
            for (uint256 k; k != outline.length; ++k) {
                if (!isSame(outline[k], outline[k == 0 ? outline.length - 1 : k - 1])) numbers[count++] = k;
            }
            if (count < 3) revert TooFewPoints(count, 3);
            assembly ("memory-safe") {
                mstore(numbers, count)
            }
        }
    }

    /// @dev Returns twice the signed area of the outline, negative if it is clockwise.
    function doubleArea(int256[2][] memory outline, uint256[] memory numbers) private pure returns (int256 area) {
        unchecked {
            for (uint256 k = 2; k < numbers.length; ++k) {
                area += side(outline[numbers[0]], outline[numbers[k - 1]], outline[numbers[k]]);
            }
            if (area == 0) revert NotAnOutline();
        }
    }

    /// @dev Returns a half circle from the lower pole to the upper one as a profile.
    function arc(int256 radius, uint256 rings) private pure returns (int256[2][] memory profile) {
        unchecked {
            profile = new int256[2][](rings + 1);
            for (uint256 k; k <= rings; ++k) {
                (Fixed sine, Fixed cosine) = sinCosOfHalf(int256((360 * k << 32) / rings));
                profile[k] = [k == rings ? int256(0) : times(radius, sine.raw()), -times(radius, cosine.raw())];
            }
        }
    }

    function setAngles(Turn memory turn, uint256 segments) private pure {
        unchecked {
            (turn.sines, turn.cosines) = (new int256[](segments), new int256[](segments));
            for (uint256 k; k != segments; ++k) {
                (Fixed sine, Fixed cosine) = sinCosOfHalf(int256((720 * k << 32) / segments));
                (turn.sines[k], turn.cosines[k]) = (sine.raw(), cosine.raw());
            }
        }
    }

    /// @dev Adds the vertices of a point of the profile, and returns the index of the first one.
    function level(Model memory m, Turn memory turn, int256[2] memory point) private pure returns (uint256 first) {
        unchecked {
            first = m.vertexCount;
            (int256 radius, int256 y) = (point[0], turn.y + point[1]);
            if (radius < 0 || radius > 65535) revert SizeOutOfRange(radius);
            if (radius == 0) {
                m.vertex(turn.x, y, turn.z, turn.color);
                return first;
            }
            for (uint256 k; k != turn.sines.length; ++k) {
                m.vertex(turn.x + times(radius, turn.sines[k]), y, turn.z + times(radius, turn.cosines[k]), turn.color);
            }
        }
    }

    /// @dev Adds the faces between two rings.
    /// @param step Index step from one vertex of the lower ring to the next: 0 for a point on the axis, otherwise 1. `step2` is the same
    /// for the upper ring.
    function band(Model memory m, Turn memory turn, uint256 lower, uint256 step, uint256 upper, uint256 step2) private pure {
        unchecked {
            uint256 segments = turn.sines.length;
            for (uint256 k; k != segments; ++k) {
                uint256 next = k + 1 == segments ? 0 : k + 1;
                (uint256 left, uint256 right) = turn.inward ? (next, k) : (k, next);
                if (step != 0) m.face(lower + left, lower + right, upper + step2 * right);
                if (step2 != 0) m.face(lower + step * left, upper + right, upper + left);
            }
        }
    }

    /// @dev Returns whether the profile goes down on the outside: its signed volume is negative, or it is a flat disc that faces down.
    function goesDown(int256[2][] memory profile) private pure returns (bool) {
        unchecked {
            int256 volume;
            for (uint256 k = 1; k < profile.length; ++k) {
                (int256 r, int256 s) = (int256(int24(profile[k - 1][0])), int256(int24(profile[k][0])));
                volume += int256(int24(profile[k][1] - profile[k - 1][1])) * (r * r + r * s + s * s);
            }
            return volume < 0 || (volume == 0 && profile[0][0] < profile[profile.length - 1][0]);
        }
    }

    function isSame(int256[2] memory a, int256[2] memory b) private pure returns (bool) {
        return a[0] == b[0] && a[1] == b[1];
    }

    /// @dev Returns the product with a Q32 number, rounded to the nearest whole number.
    function times(int256 value, int256 factor) private pure returns (int256) {
        unchecked {
            return (value * factor + (1 << 31)) >> 32;
        }
    }

    function checkSize(int256 size) private pure {
        if (size < 1 || size > 65535) revert SizeOutOfRange(size);
    }
}
