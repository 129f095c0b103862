// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Elements} from "./Elements.sol";
import {Seed, Tag, Random} from "./Random.sol";
import {Structure, EXTRUDED, UNIFORM} from "./Structures.sol";
import {Trigonometry, SINES, ONE} from "./Trigonometry.sol";

/// @notice A counter-clockwise triangle in the plane, and the heights of the two ends of its prism.
/// @param corners x and y of each corner.
/// @param far The height of the far end.
/// @param near The height of the near end.
/// @param x The x coordinate of the centroid.
/// @param y The y coordinate of the centroid.
/// @param radius The distance from the centroid to the first corner, truncated.
/// @param isUp Whether one corner points upward, rather than two.
/// @param edges Four numbers for each side, from corner to next corner: dx, dy; offset = dx * y - dy * x of either corner, so that the
/// distance of a point p from the line through them is (offset + dy * p.x - dx * p.y) / |dx, dy|; and the clearance, times |dx, dy|.
struct Triangle {
    int256[6] corners;
    int256 far;
    int256 near;
    int256 x;
    int256 y;
    int256 radius;
    bool isUp;
    int256[12] edges;
}

/// @notice The triangles of a piece.
/// @param seed The seed of the piece.
/// @param structure The rules of the layout.
/// @param unit The unit of heights.
/// @param mirrorX Whether each triangle is accompanied by its mirror image at the y axis.
/// @param mirrorY The same at the x axis; with both, the image is rotated by 180 degrees.
/// @param count The number of triangles kept.
/// @param slots The triangles kept. There can be one more: in a piece mirrored at the x axis, the first triangle is not part of the piece,
/// only the reference for the following ones.
/// @param spare The triangle to be tried next, written in place.
/// @param sines The table of `Trigonometry`.
struct Layout {
    Seed seed;
    Structure structure;
    int256 unit;
    bool mirrorX;
    bool mirrorY;
    uint256 count;
    Triangle[] slots;
    Triangle spare;
    bytes sines;
}

/// @title Layouts: arranges the triangles of which prisms are made. Each one is placed beside another one, or corner to corner with it,
/// wherever it fits.
/// @dev The tests are ordered so that the cheapest rejects first; a triangle is kept only if it passes all. They use no root or division
/// where a comparison of squares or products is equivalent.
library Layouts {
    using Random for Seed;
    using Elements for int256[6];

    uint256 internal constant ATTEMPTS = 150;
    /// @dev The maximum rounding error of a triangle's corners and centroid; and of its radius.
    int256 internal constant ROUNDING = 8;
    /// @dev The minimum distance between a corner and the line through an edge.
    int256 internal constant CLEARANCE = 8;

    Tag private constant UNIT = Tag.wrap(bytes32("depthMult") | bytes32(uint256(9)));
    Tag private constant MIRROR_X = Tag.wrap(bytes32("symmX") | bytes32(uint256(5)));
    Tag private constant MIRROR_Y = Tag.wrap(bytes32("symmY") | bytes32(uint256(5)));
    Tag private constant TURN = Tag.wrap(bytes32("rot") | bytes32(uint256(3)));
    Tag private constant REFERENCE = Tag.wrap(bytes32("refIdx") | bytes32(uint256(6)));
    Tag private constant OPPOSITE = Tag.wrap(bytes32("adj") | bytes32(uint256(3)));
    Tag private constant OPPOSITE_SIDE = Tag.wrap(bytes32("vertOppSideIdx") | bytes32(uint256(14)));
    Tag private constant OPPOSITE_DOUBLE = Tag.wrap(bytes32("vertOppScale1") | bytes32(uint256(13)));
    Tag private constant OPPOSITE_EQUAL = Tag.wrap(bytes32("vertOppScale2") | bytes32(uint256(13)));
    Tag private constant OPPOSITE_AGAIN = Tag.wrap(bytes32("recursiveVertOpp") | bytes32(uint256(16)));
    Tag private constant ADJACENT_SIDE = Tag.wrap(bytes32("sideIdx") | bytes32(uint256(7)));
    Tag private constant ADJACENT_SCALE = Tag.wrap(bytes32("scaleAdj") | bytes32(uint256(8)));
    Tag private constant ADJACENT_LATERAL = Tag.wrap(bytes32("lateralOffset") | bytes32(uint256(13)));
    Tag private constant ADJACENT_AGAIN = Tag.wrap(bytes32("addAdjRecursive") | bytes32(uint256(15)));
    Tag private constant HEIGHT = Tag.wrap(bytes32("calcZ") | bytes32(uint256(5)));

    function lay(Seed seed, Structure memory structure) internal pure returns (Layout memory laid) {
        unchecked {
            laid.seed = seed;
            laid.structure = structure;
            laid.unit = seed.draw(UNIT, 80, 120);
            laid.mirrorX = seed.draw(MIRROR_X, 0, 2) > 0;
            laid.mirrorY = seed.draw(MIRROR_Y, 0, 2) > 0;
            laid.sines = SINES;
            uint256 most = structure.maxPrisms;
            laid.slots = emptySlots(most);

            Triangle memory first = laid.spare;
            place(laid, 0, 0, int256(structure.firstRadius), seed.draw(TURN, 0, 1) == 0 ? 1 : 7);
            (first.far, first.near) = heights(laid, 0);
            setEdges(first);
            store(laid);
            // the triangle stays in its slot until another one overwrites it
            if (laid.mirrorY) laid.count = 0;

            for (uint256 i; i != ATTEMPTS && laid.count < most; ++i) {
                uint256 base = uint256(seed.draw(REFERENCE, i, 0, int256(laid.count) - 1));
                if (seed.chance(OPPOSITE, i, laid.count, structure.opposite)) layOpposite(laid, i, base);
                else layAdjacent(laid, i, base);
            }
        }
    }

    /// @dev Places triangles beside a side of the reference, then beside that side of the new one, and so on, with decreasing size.
    /// @param base The slot of the reference.
    function layAdjacent(Layout memory laid, uint256 i, uint256 base) private pure {
        unchecked {
            Seed seed = laid.seed;
            Structure memory structure = laid.structure;
            uint256 side = uint256(seed.draw(ADJACENT_SIDE, i, 0, 0, 2));
            int256 scale = structure.sizesVary ? seed.draw(ADJACENT_SCALE, i, 0, 333, 800) : int256(1000);
            for (uint256 depth;; ++depth) {
                Triangle memory beside = laid.spare;
                Triangle[] memory slots = laid.slots;
                assembly ("memory-safe") {
                    // slots[base], without a bounds check
                    beside := mload(add(add(slots, 0x20), shl(5, base)))
                }
                int256 size = limited(structure, scale * beside.radius / 1000);
                if (isTooSmall(structure, size)) return;
                uint256 turn = 4 * side + (beside.isUp ? 2 : 0);
                {
                    int256 lateral = (1000 - scale) * (beside.radius * 8660 / 10000) / 1000;
                    if (seed.draw(ADJACENT_LATERAL, i, depth, 0, 1) == 0) lateral = -lateral;
                    int256 away = beside.radius / 2 * (1000 + scale) / 1000 + 6000;
                    (int256 cosine, int256 sine) = Trigonometry.ofTurn(laid.sines, turn);
                    (int256 dx, int256 dy) = Trigonometry.rotate(lateral, away, cosine, sine);
                    // minus 30 degrees
                    place(laid, beside.x + dx, beside.y + dy, size, turn + 11);
                }
                if (!fits(laid)) return;
                (laid.spare.far, laid.spare.near) = heights(laid, laid.count);
                add(laid);
                if (!seed.chance(ADJACENT_AGAIN, i, depth, structure.adjacentAgain)) return;
                base = laid.count - 1;
                if (structure.sizesVary) scale = 666;
            }
        }
    }

    /// @dev Places triangles corner to corner with the reference, smaller or larger.
    function layOpposite(Layout memory laid, uint256 i, uint256 base) private pure {
        unchecked {
            Seed seed = laid.seed;
            Structure memory structure = laid.structure;
            uint256 side = uint256(seed.draw(OPPOSITE_SIDE, i, 0, 0, 2));
            int256 scale = 1000;
            if (structure.sizesVary) {
                if (seed.chance(OPPOSITE_DOUBLE, i, 0, 33)) scale = 2000;
                else if (seed.chance(OPPOSITE_EQUAL, i, 0, 50)) scale = 500;
            }
            for (uint256 depth;; ++depth) {
                // read each time: the slot filled last may be chosen
                Triangle memory other = laid.spare;
                Triangle[] memory slots = laid.slots;
                assembly ("memory-safe") {
                    other := mload(add(add(slots, 0x20), shl(5, base)))
                }
                int256 size = limited(structure, scale * other.radius / 1000);
                if (isTooSmall(structure, size)) return;
                uint256 turn = 4 * side + 2 + (other.isUp ? 2 : 0);
                {
                    int256 away = other.radius * (1000 + scale) / 1000 + 64;
                    (int256 cosine, int256 sine) = Trigonometry.ofTurn(laid.sines, turn);
                    (int256 dx, int256 dy) = Trigonometry.rotate(0, away, cosine, sine);
                    // minus 210 degrees
                    place(laid, other.x + dx, other.y + dy, size, turn + 5);
                }
                if (!fits(laid)) return;
                laid.spare.far = other.far;
                (, laid.spare.near) = heights(laid, laid.count);
                add(laid);
                if (!seed.chance(OPPOSITE_AGAIN, i, depth, structure.oppositeAgain)) return;
                if (structure.sizesVary) scale = 666;
            }
        }
    }

    function limited(Structure memory structure, int256 radius) private pure returns (int256) {
        return radius > int256(structure.maxRadius) ? int256(structure.maxRadius) : radius;
    }

    /// @dev Returns whether a triangle of this radius is below the minimum, even after rounding.
    function isTooSmall(Structure memory structure, int256 radius) private pure returns (bool) {
        unchecked {
            return radius + ROUNDING < int256(structure.minRadius);
        }
    }

    /// @dev Returns the heights of a triangle for slot `index`.
    function heights(Layout memory laid, uint256 index) private pure returns (int256 far, int256 near) {
        unchecked {
            int256 unit = laid.unit;
            uint256 structure = laid.structure.index;
            if (structure == UNIFORM) return (unit, -unit);
            uint256 value = laid.seed.hash(HEIGHT, index, 0, 1);
            uint256 choice = value % 11;
            int256 factor = choice == 10 ? int256(10) : choice >= 6 ? int256(8) : int256(1);
            if (structure == EXTRUDED) return ((factor + 10) * unit, (8 - int256(value % 19)) * unit);
            return (factor * unit, -2 * unit);
        }
    }

    /// @dev Keeps the spare triangle, which fits, and then its mirror image if that fits.
    function add(Layout memory laid) private pure {
        Triangle memory triangle = laid.spare;
        store(laid);
        if (laid.mirrorX || laid.mirrorY) {
            mirror(laid, triangle);
            if (fits(laid)) store(laid);
        }
    }

    /// @dev Moves the spare triangle into the next slot.
    function store(Layout memory laid) private pure {
        unchecked {
            Triangle memory triangle = laid.spare;
            laid.slots[laid.count++] = triangle;
            laid.spare = newTriangle();
            // approximates the side of an equilateral triangle
            uint256 guess = uint256(triangle.radius * 1732 / 1000);
            int256[12] memory e = triangle.edges;
            e[3] = nearness(e[0], e[1], guess);
            e[7] = nearness(e[4], e[5], guess);
            e[11] = nearness(e[8], e[9], guess);
        }
    }

    /// @dev Returns the clearance of an edge, times its length.
    /// @param guess An approximation of the length.
    function nearness(int256 dx, int256 dy, uint256 guess) private pure returns (int256) {
        unchecked {
            return CLEARANCE * int256(Trigonometry.root(uint256(dx * dx + dy * dy), guess)) - 1;
        }
    }

    /// @dev Makes the spare triangle equilateral.
    /// @param turn The direction of the first corner, in units of 30 degrees.
    function place(Layout memory laid, int256 x, int256 y, int256 radius, uint256 turn) private pure {
        unchecked {
            int256[6] memory corners = laid.spare.corners;
            for (uint256 k; k != 3; ++k) {
                (int256 cosine, int256 sine) = Trigonometry.ofTurn(laid.sines, turn + 4 * k);
                corners.put(2 * k, x + radius * cosine / ONE);
                corners.put(2 * k + 1, y + radius * sine / ONE);
            }
            measure(laid.spare, radius);
        }
    }

    /// @dev Makes the spare triangle the mirror image of another one, with corners ordered to keep the winding.
    function mirror(Layout memory laid, Triangle memory triangle) private pure {
        unchecked {
            Triangle memory image = laid.spare;
            (int256 signX, int256 signY) = (laid.mirrorX ? -1 : int256(1), laid.mirrorY ? -1 : int256(1));
            bool turned = signX == signY;
            for (uint256 k; k != 3; ++k) {
                uint256 from = turned ? k : 2 - k;
                image.corners[2 * k] = signX * triangle.corners[2 * from];
                image.corners[2 * k + 1] = signY * triangle.corners[2 * from + 1];
            }
            (image.far, image.near) = (triangle.far, triangle.near);
            measure(image, triangle.radius);
        }
    }

    /// @dev Computes centroid, radius and edges.
    /// @param radius An approximation of the radius.
    function measure(Triangle memory triangle, int256 radius) private pure {
        unchecked {
            int256[6] memory c = triangle.corners;
            int256 x = (c[0] + c[2] + c[4]) / 3;
            int256 y = (c[1] + c[3] + c[5]) / 3;
            (triangle.x, triangle.y) = (x, y);
            int256 square = (x - c[0]) * (x - c[0]) + (y - c[1]) * (y - c[1]);
            triangle.radius = int256(Trigonometry.root(uint256(square), uint256(radius)));
            triangle.isUp = (c[1] > y ? 1 : 0) + (c[3] > y ? 1 : 0) + (c[5] > y ? 1 : 0) == 1;
        }
    }

    /// @dev Returns whether the spare triangle can be added.
    function fits(Layout memory laid) private pure returns (bool) {
        unchecked {
            Triangle memory triangle = laid.spare;
            uint256 count = laid.count;
            if (count >= laid.structure.maxPrisms || triangle.radius < int256(laid.structure.minRadius)) return false;
            Triangle[] memory slots = laid.slots;
            (int256 x, int256 y, int256 half) = (triangle.x, triangle.y, triangle.radius >> 1);
            // any initial value: the compiler would allocate a new triangle
            Triangle memory old = triangle;
            for (uint256 k; k != count; ++k) {
                assembly ("memory-safe") {
                    // slots[k], without a bounds check
                    old := mload(add(add(slots, 0x20), shl(5, k)))
                }
                (int256 dx, int256 dy) = (x - old.x, y - old.y);
                int256 least = half + (old.radius >> 1);
                if (dx * dx + dy * dy < least * least) return false;
            }
            setEdges(triangle);
            for (uint256 k; k != count; ++k) {
                assembly ("memory-safe") {
                    old := mload(add(add(slots, 0x20), shl(5, k)))
                }
                if (!isApart(triangle, old)) return false;
            }
            return true;
        }
    }

    /// @dev Computes the lines through the corners.
    function setEdges(Triangle memory triangle) private pure {
        unchecked {
            int256[6] memory c = triangle.corners;
            int256[12] memory e = triangle.edges;
            (e[0], e[1]) = (c[2] - c[0], c[3] - c[1]);
            (e[4], e[5]) = (c[4] - c[2], c[5] - c[3]);
            (e[8], e[9]) = (c[0] - c[4], c[1] - c[5]);
            e[2] = e[0] * c[1] - e[1] * c[0];
            e[6] = e[4] * c[3] - e[5] * c[2];
            e[10] = e[8] * c[5] - e[9] * c[4];
        }
    }

    /// @dev Returns whether a new triangle keeps the required distance from an existing one, apart from the distance of the centroids.
    function isApart(Triangle memory triangle, Triangle memory old) private pure returns (bool) {
        unchecked {
            int256[6] memory c = triangle.corners;
            if (!isClear(old.edges, c[0], c[1]) || !isClear(old.edges, c[2], c[3]) || !isClear(old.edges, c[4], c[5])) return false;
            (int256 dx, int256 dy) = (triangle.x - old.x, triangle.y - old.y);
            int256 reach = triangle.radius + old.radius + 2 * ROUNDING;
            if (dx * dx + dy * dy > reach * reach) return true;
            c = old.corners;
            int256[12] memory e = triangle.edges;
            return !contains(e, c[0], c[1]) && !contains(e, c[2], c[3]) && !contains(e, c[4], c[5]);
        }
    }

    /// @dev Returns whether a point keeps clear of the lines of a triangle and lies outside. If it keeps clear, the signs of its distances
    /// are exact, and it lies inside if all are negative.
    function isClear(int256[12] memory edges, int256 x, int256 y) private pure returns (bool clear) {
        assembly ("memory-safe") {
            // distance * length = offset + dy * x - dx * y
            let a := sub(add(mload(add(edges, 0x40)), mul(mload(add(edges, 0x20)), x)), mul(mload(edges), y))
            let near := mload(add(edges, 0x60))
            // |a| > near, as one unsigned comparison
            if gt(add(a, near), shl(1, near)) {
                let b := sub(add(mload(add(edges, 0xc0)), mul(mload(add(edges, 0xa0)), x)), mul(mload(add(edges, 0x80)), y))
                near := mload(add(edges, 0xe0))
                if gt(add(b, near), shl(1, near)) {
                    let c := sub(add(mload(add(edges, 0x140)), mul(mload(add(edges, 0x120)), x)), mul(mload(add(edges, 0x100)), y))
                    near := mload(add(edges, 0x160))
                    // and at least one of the three is on the outer side
                    clear := and(gt(add(c, near), shl(1, near)), iszero(slt(and(and(a, b), c), 0)))
                }
            }
        }
    }

    /// @dev Returns whether a point lies inside: all of its barycentric coordinates are at least 10^-6.
    function contains(int256[12] memory e, int256 x, int256 y) private pure returns (bool) {
        unchecked {
            int256 area = e[0] * e[5] - e[1] * e[4];
            int256 a = -1e6 * (e[6] + e[5] * x - e[4] * y);
            if (a < area) return false;
            int256 b = -1e6 * (e[10] + e[9] * x - e[8] * y);
            return b >= area && a / area + b / area < 1e6;
        }
    }

    function newTriangle() private pure returns (Triangle memory) {}

    /// @dev Returns an array without allocated triangles: the compiler would allocate one for each element.
    function emptySlots(uint256 count) private pure returns (Triangle[] memory slots) {
        assembly ("memory-safe") {
            slots := mload(0x40)
            mstore(slots, count)
            mstore(0x40, add(slots, shl(5, add(count, 1))))
        }
    }
}
