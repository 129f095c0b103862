// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {magnitude} from "../math/Bits.sol";
import {sqrt} from "../math/Roots.sol";
import {Mesh} from "../scene/Mesh.sol";
import {Light, Object, POINT, Fixed, Vector, normalize, Matrix} from "../scene/Scene.sol";
import "../words/Registers.sol";

// Computes `toward` of picture.py in a space of the light.
// Light space. The z axis points toward a directional light, or from a point light to the shadow casters. The origin is the centre of the
// casters, or the point light. The farthest point of a caster has coordinates of 20 bits, including the sign.
//
// Coordinates are divided into ranges for the search for casters: x, y and z, or x / z, y / z and -z. A point light among the casters is
// the centre of a cube, and each side of the cube, z, -z, x, -x, y, -y, has its own ranges, with its axis in place of z.
//
// A vertex has four words: x, y, z, and its ranges (BOX_ in Words.sol), or BESIDE.

/// @dev The bits of the coordinates of a caster's farthest point, without the sign.
uint256 constant COORDINATE_BITS = 19;
/// @dev The number of ranges into which coordinates are divided, and the last of them.
uint256 constant BUCKETS = 128;
uint256 constant LAST_BUCKET = 127;
uint256 constant PLACE_SIZE = 0x80;
uint256 constant PLACE_BOX = 0x60;
/// @dev The position of the maximum in a lane of ranges.
uint256 constant HIGH_AT = 8;
/// @dev The extra fraction bits in the product of a length, Q32, and a factor, 2^64 / radius (Q32), compared to a coordinate.
uint256 constant PLACE_SHIFT = 77;
/// @dev The bits of x / z and y / z.
uint256 constant SLOPE_BITS = 16;
/// @dev A point light from which the casters span a larger slope is among them.
int256 constant WIDEST = 2 << 16;
/// @dev The number of sides of a cube.
uint256 constant CUBE = 6;
/// @dev All ranges of x and y, and of z from the minimum on.
uint256 constant EVERYWHERE = 0x7f007f007f00;
/// @dev If the y component of a direction exceeds this, Q32, the y axis does not define the second axis.
int256 constant UPRIGHT = 3 << 30;

/// @param axis Three times three numbers: 2^64 / radius times the components of the axes.
/// @param low, factor The origin and scale of the ranges, Q32.
/// @param sides The number of cube sides that have ranges: CUBE or 1.
struct Frame {
    bool isPoint;
    int256 radius;
    int256[3] origin;
    int256[9] axis;
    int256[3] low;
    int256[3] factor;
    uint256 sides;
}

library LightSpace {
    /// @notice Writes the vertices of an object in world space, Q32.
    /// @param vertex The address to write to.
    function writeWorld(Object calldata object, Mesh memory mesh, Matrix memory rotation, uint256 vertex) internal pure {
        unchecked {
            Fixed size = object.scale;
            int256[12] memory m;
            (Vector memory x, Vector memory y, Vector memory z) = (rotation.x.scale(size), rotation.y.scale(size), rotation.z.scale(size));
            (m[0], m[1], m[2], m[3]) = (x.x.raw(), y.x.raw(), z.x.raw(), object.position.x.raw());
            (m[4], m[5], m[6], m[7]) = (x.y.raw(), y.y.raw(), z.y.raw(), object.position.y.raw());
            (m[8], m[9], m[10], m[11]) = (x.z.raw(), y.z.raw(), z.z.raw(), object.position.z.raw());
            uint256 source = mesh.vertices;
            uint256 bits = mesh.bits;
            uint256 stride = mesh.stride;
            uint256 end = vertex + PLACE_SIZE * mesh.vertexCount;
            assembly ("memory-safe") {
                for {} lt(vertex, end) { vertex := add(vertex, PLACE_SIZE) } { // for each vertex
                    let data := calldataload(source) // three signed numbers at the top
                    let rest := sub(256, bits) // bits below a number at the top
                    let i := sar(rest, data) // the vertex of the mesh: (i, j, k)
                    data := shl(bits, data) // drop i
                    let j := sar(rest, data)
                    let k := sar(rest, shl(bits, data)) // k, below j
                    let row := m // a row of the matrix m
                    for { let target := vertex } lt(target, add(vertex, PLACE_BOX)) { target := add(target, 0x20) } { // x, y, z
                        let value := add(mload(add(row, 0x60)), mul(i, mload(row))) // m[3] + i m[0] + j m[1] + k m[2]
                        mstore(target, add(value, add(mul(j, mload(add(row, 0x20))), mul(k, mload(add(row, 0x40))))))
                        row := add(row, 0x80) // the next row
                    }
                    source := add(source, stride)
                }
            }
        }
    }

    /// @notice Widens bounds to include vertices.
    /// @param bounds The minimum coordinates, then the maximum ones.
    function widen(int256[6] memory bounds, uint256 vertex, uint256 end) internal pure {
        assembly ("memory-safe") {
            for {} lt(vertex, end) { vertex := add(vertex, PLACE_SIZE) } {
                for { let i := 0 } lt(i, 0x60) { i := add(i, 0x20) } {
                    let value := mload(add(vertex, i)) // a coordinate
                    let bound := add(bounds, i) // of the minimum
                    if slt(value, mload(bound)) { mstore(bound, value) } // the minimum
                    bound := add(bound, 0x60) // from here on, of the maximum
                    if sgt(value, mload(bound)) { mstore(bound, value) }
                }
            }
        }
    }

    /// @notice Returns the space of a light.
    /// @param bounds The bounds of the casters in world space.
    function frameOf(Light calldata light, int256[6] memory bounds) internal pure returns (Frame memory frame) {
        unchecked {
            frame.isPoint = light.kind == POINT;
            frame.sides = 1;
            int256[3] memory vector = [light.vector.x.raw(), light.vector.y.raw(), light.vector.z.raw()];
            int256[3] memory middle;
            int256[3] memory reach;
            for (uint256 i; i != 3; ++i) {
                middle[i] = (bounds[i] + bounds[i + 3]) >> 1;
                reach[i] = bounds[i + 3] - bounds[i];
            }
            int256 half = (length(reach) >> 1) + 1;
            Vector memory z;
            if (frame.isPoint) {
                frame.origin = vector;
                int256[3] memory across;
                for (uint256 i; i != 3; ++i) {
                    int256 low = magnitude(bounds[i] - vector[i]);
                    int256 high = magnitude(bounds[i + 3] - vector[i]);
                    reach[i] = low > high ? low : high;
                    across[i] = middle[i] - vector[i];
                }
                frame.radius = length(reach) + 1;
                z = normalize(toVector(across));
                if (z.isZero()) z.z = Fixed.wrap(1 << 32);
                setCone(frame, half, length(across));
            } else {
                (frame.origin, frame.radius) = (middle, half);
                z = normalize(toVector(vector));
                for (uint256 i; i != 3; ++i) {
                    frame.low[i] = -int256(1 << COORDINATE_BITS);
                    frame.factor[i] = int256((BUCKETS << Q32) / (2 << COORDINATE_BITS));
                }
            }
            Vector memory up;
            if (magnitude(z.y.raw()) < UPRIGHT) up.y = Fixed.wrap(1 << 32);
            else up.x = Fixed.wrap(1 << 32);
            Vector memory x = normalize(z.cross(up));
            setAxis(frame, 0, x);
            setAxis(frame, 3, z.cross(x));
            setAxis(frame, 6, z);
        }
    }

    /// @dev Sets the ranges in the cone from a point light around the bounding sphere of the casters.
    /// @param half The radius of the sphere; `distance` is that of its centre from the light.
    function setCone(Frame memory frame, int256 half, int256 distance) private pure {
        unchecked {
            int256 size = (half << COORDINATE_BITS) / frame.radius + 2;
            distance = (distance << COORDINATE_BITS) / frame.radius;
            int256 lowest = distance + size;
            int256 depth = 2 * size;
            int256 across = distance > size ? (size << SLOPE_BITS) / (distance - size) + 1 : WIDEST + 1;
            if (across > WIDEST) {
                frame.sides = CUBE;
                across = int256(1 << SLOPE_BITS);
                lowest = int256(1 << COORDINATE_BITS);
                depth = lowest;
            }
            (frame.low[0], frame.low[1], frame.low[2]) = (-across, -across, -lowest);
            frame.factor[0] = int256(BUCKETS << Q32) / (2 * across);
            frame.factor[1] = frame.factor[0];
            frame.factor[2] = int256(BUCKETS << Q32) / depth;
        }
    }

    function setAxis(Frame memory frame, uint256 first, Vector memory v) private pure {
        unchecked {
            frame.axis[first] = (v.x.raw() << 64) / frame.radius;
            frame.axis[first + 1] = (v.y.raw() << 64) / frame.radius;
            frame.axis[first + 2] = (v.z.raw() << 64) / frame.radius;
        }
    }

    function toVector(int256[3] memory v) private pure returns (Vector memory) {
        return Vector(Fixed.wrap(v[0]), Fixed.wrap(v[1]), Fixed.wrap(v[2]));
    }

    function length(int256[3] memory v) private pure returns (int256) {
        unchecked {
            return int256(sqrt(uint256(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])));
        }
    }

    /// @notice Transforms vertices from world space to light space.
    function place(Frame memory frame, uint256 vertex, uint256 end) internal pure {
        unchecked {
            for (; vertex != end; vertex += PLACE_SIZE) {
                (int256 x, int256 y, int256 z) = placeOf(frame, loadSigned(vertex), loadSigned(vertex + 0x20), loadSigned(vertex + 0x40));
                storeSigned(vertex, x);
                storeSigned(vertex + 0x20, y);
                storeSigned(vertex + 0x40, z);
                uint256 side = 0;
                if (frame.isPoint) {
                    if (frame.sides != 1) {
                        side = mainSide(x, y, z);
                        (x, y, z) = turned(x, y, z, side);
                    }
                    if (4 * z <= magnitude(x) || 4 * z <= magnitude(y)) {
                        store(vertex + PLACE_BOX, BESIDE);
                        continue;
                    }
                    (x, y, z) = ((x << SLOPE_BITS) / z, (y << SLOPE_BITS) / z, -z);
                }
                store(vertex + PLACE_BOX, buckets(frame, x, y, z) | (side << BOX_SIDE_AT));
            }
        }
    }

    /// @dev Returns the ranges of a point, each in the lower byte of its lane.
    function buckets(Frame memory frame, int256 x, int256 y, int256 z) private pure returns (uint256 box) {
        assembly ("memory-safe") {
            let low := mload(add(frame, 0x80)) // the address of frame.low
            let factor := mload(add(frame, 0xa0)) // that of frame.factor
            x := sar(Q32, mul(sub(x, mload(low)), mload(factor))) // from here on, the range of x
            x := mul(x, sgt(x, 0)) // at least 0
            if gt(x, LAST_BUCKET) { x := LAST_BUCKET } // at most the last
            y := sar(Q32, mul(sub(y, mload(add(low, 0x20))), mload(add(factor, 0x20)))) // from here on, that of y
            y := mul(y, sgt(y, 0))
            if gt(y, LAST_BUCKET) { y := LAST_BUCKET }
            z := sar(Q32, mul(sub(z, mload(add(low, 0x40))), mload(add(factor, 0x40)))) // from here on, that of z
            z := mul(z, sgt(z, 0))
            if gt(z, LAST_BUCKET) { z := LAST_BUCKET }
            box := or(x, or(shl(BOX_Y_AT, y), shl(BOX_Z_AT, z)))
        }
    }

    /// @dev Returns the side of the cube on which a point lies.
    function mainSide(int256 x, int256 y, int256 z) private pure returns (uint256) {
        unchecked {
            (int256 i, int256 j, int256 k) = (magnitude(x), magnitude(y), magnitude(z));
            if (k >= i && k >= j) return z < 0 ? 1 : 0;
            if (i >= j) return x < 0 ? 3 : 2;
            return y < 0 ? 5 : 4;
        }
    }

    /// @dev Returns a point with the axis of a side in place of z.
    function turned(int256 x, int256 y, int256 z, uint256 side) private pure returns (int256, int256, int256) {
        unchecked {
            if (side > 3) (x, y, z) = (z, x, y);
            else if (side > 1) (x, y, z) = (y, z, x);
            return (x, y, side & 1 == 0 ? z : -z);
        }
    }

    function placeOn(uint256 vertex, uint256 side) private pure returns (int256, int256, int256) {
        return turned(loadSigned(vertex), loadSigned(vertex + 0x20), loadSigned(vertex + 0x40), side);
    }

    /// @notice Returns the ranges, on one side of the cube, of a face that spans several sides.
    /// @param places Three addresses of vertices.
    /// @return box As in Faces, and HAS_BOX; 0 if the face does not reach that side.
    function boxOn(Frame memory frame, uint256[3] memory places, uint256 side) internal pure returns (uint256 box) {
        unchecked {
            int256 far;
            int256 near = type(int256).max;
            uint256 outside = 15;
            for (uint256 i; i != 3; ++i) {
                (int256 x, int256 y, int256 z) = placeOn(places[i], side);
                if (z > far) far = z;
                if (z < near) near = z;
                outside &= (x > z ? 1 : 0) | (-x > z ? 2 : 0) | (y > z ? 4 : 0) | (-y > z ? 8 : 0);
            }
            if (far <= 0 || outside != 0) return 0;
            if (near <= 0) return HAS_BOX | EVERYWHERE | buckets(frame, -WIDEST, -WIDEST, -far);
            (int256 left, int256 low) = (type(int256).max, type(int256).max);
            (int256 right, int256 high) = (type(int256).min, type(int256).min);
            for (uint256 i; i != 3; ++i) {
                (int256 x, int256 y, int256 z) = placeOn(places[i], side);
                (x, y) = ((x << SLOPE_BITS) / z, (y << SLOPE_BITS) / z);
                if (x < left) left = x;
                if (x > right) right = x;
                if (y < low) low = y;
                if (y > high) high = y;
            }
            return HAS_BOX | buckets(frame, left, low, -far) | (buckets(frame, right, high, -near) << HIGH_AT);
        }
    }

    /// @notice Transforms a point from world space to light space.
    function placeOf(Frame memory frame, int256 x, int256 y, int256 z) internal pure returns (int256, int256, int256) {
        unchecked {
            return directionOf(frame, x - frame.origin[0], y - frame.origin[1], z - frame.origin[2]);
        }
    }

    /// @notice Transforms a difference of points from world space to light space.
    function directionOf(Frame memory frame, int256 x, int256 y, int256 z) internal pure returns (int256 i, int256 j, int256 k) {
        assembly ("memory-safe") {
            let half := shl(sub(PLACE_SHIFT, 1), 1) // rounds to nearest
            let axis := mload(add(frame, 0x60)) // x, then y, then z
            i := sar(PLACE_SHIFT, add(add(half, mul(x, mload(axis))), add(mul(y, mload(add(axis, 0x20))), mul(z, mload(add(axis, 0x40))))))
            axis := add(axis, 0x60) // y
            j := sar(PLACE_SHIFT, add(add(half, mul(x, mload(axis))), add(mul(y, mload(add(axis, 0x20))), mul(z, mload(add(axis, 0x40))))))
            axis := add(axis, 0x60) // z
            k := sar(PLACE_SHIFT, add(add(half, mul(x, mload(axis))), add(mul(y, mload(add(axis, 0x20))), mul(z, mload(add(axis, 0x40))))))
        }
    }
}
