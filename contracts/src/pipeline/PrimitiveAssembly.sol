// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Mesh} from "../scene/Mesh.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";
import {Clipper} from "./Clipper.sol";
import {MUST_CLIP, IS_OUTSIDE} from "./VertexShader.sol";
import "./Registers.sol";

// From vertices and faces to triangles that are to be drawn: those that face the viewer (or all), cut where they leave the guard
// band. Each becomes one word:
//
//   bits 0..31, 32..63, 64..95   addresses of the third, second and first vertex record
//   bits 96..111, 112..127       the first row that may be covered, and the row after the last
//   bits 128..143                the tag of the face
//   bits 144..146                which edges belong to the face: first to second vertex, second to third, third to first
//   bit 147                      whether it reaches beyond the left or right border of the tile
//
// The first vertex is the topmost, and the three run counter-clockwise on the screen.

uint256 constant ALL_EDGES = 0x00000007000000000000000000000000000000000000;
uint256 constant OUTSIDE_BIT = 147;

library PrimitiveAssembly {
    /// @param records Address of the vertex records, 2^shift bytes each.
    /// @param list Where to write the triangles.
    /// @return end The end of the list.
    /// @return free The first free address.
    /// @return drawn How many faces are to be drawn: they face the viewer, or both sides are drawn, and something of them is inside the
    /// guard band.
    function run(Mesh memory mesh, uint256 records, uint256 shift, uint256 list, bool cull, uint256 object)
        internal
        pure
        returns (uint256 end, uint256 free, uint256 drawn)
    {
        unchecked {
            uint256 faces = mesh.faces;
            uint256 count = mesh.faceCount;
            uint256 bound = records + (mesh.vertexCount << shift);
            uint256 bad;
            uint256 clipped;
            (end, drawn, clipped, bad) = assemble(faces, faces + 6 * count, records, shift, bound, list, cull);
            if (bad != 0) revert SceneErrors.IndexOutOfRange(object, (bad - faces) / 6, mesh.vertexCount);
            free = end;
            if (clipped != 0) {
                uint256 cut;
                (end, free, cut) = Clipper.run(mesh, records, shift, end, clipped, cull);
                drawn += cut;
            }
        }
    }

    /// @return end The end of the list.
    /// @return drawn How many triangles face the viewer.
    /// @return clipped How many have to be clipped first; they are not in the list.
    /// @return bad Where a face has a vertex number that is out of range, if any.
    function assemble(uint256 face, uint256 last, uint256 records, uint256 shift, uint256 bound, uint256 list, bool cull)
        private
        pure
        returns (uint256 end, uint256 drawn, uint256 clipped, uint256 bad)
    {
        assembly ("memory-safe") {
            // face numbers are counted in the place where the list wants them
            let tag := ALL_EDGES
            for {} lt(face, last) {
                face := add(face, 6)
                tag := add(tag, 0x100000000000000000000000000000000)
            } {
                let c := calldataload(face)
                let a := add(records, shl(shift, shr(240, c)))
                let b := add(records, shl(shift, and(shr(224, c), 0xffff)))
                c := add(records, shl(shift, and(shr(208, c), 0xffff)))
                if iszero(and(and(lt(a, bound), lt(b, bound)), lt(c, bound))) {
                    bad := face
                    break
                }
                a := mload(a)
                b := mload(b)
                c := mload(c)
                let all := or(or(a, b), c)
                if and(all, MUST_CLIP) {
                    clipped := add(clipped, 1)
                    continue
                }
                {
                    // Twice the area, (xc - xa) * (yb - ya) - (xb - xa) * (yc - ya), turned round, as the middle part of the product
                    // of K * (yb - ya) + (xb - xa) and K * (yc - ya) - (xc - xa), where K = 2^64; 2^63 rounds the part below away.
                    // The lower 20 bits of a screen word, the column, are turned round by taking them from 2^20 - 1.
                    let from := shr(64, a)
                    let area := sub(xor(shr(64, c), 0xfffff), xor(from, 0xfffff))
                    area := add(mul(sub(shr(64, b), from), area), 0x8000000000000000)
                    if iszero(and(area, 0x80000000000000000000000000000000)) {
                        if or(cull, iszero(and(area, 0xffffffffffffffff0000000000000000))) { continue }
                        from := b
                        b := c
                        c := from
                    }
                }
                drawn := add(drawn, 1)
                // the topmost first, without changing the sense of rotation
                if lt(b, a) {
                    if lt(b, c) {
                        let t := a
                        a := b
                        b := c
                        c := t
                    }
                }
                if lt(c, a) {
                    let t := c
                    c := b
                    b := a
                    a := t
                }
                let bottom := b
                if gt(c, b) { bottom := c }
                bottom := shr(136, add(bottom, mload(ROUND_BOTTOM)))
                let top := shr(136, add(a, mload(ROUND_TOP)))
                if lt(top, bottom) {
                    mstore(list, or(or(or(or(tag, shl(106, and(all, IS_OUTSIDE))), shl(112, bottom)), or(shl(96, top), shl(64, and(a, 0xffffffff)))), or(shl(32, and(b, 0xffffffff)), and(c, 0xffffffff))))
                    list := add(list, 32)
                }
            }
            end := list
        }
    }

    /// @notice The three vertex numbers of a face, 16 bits each.
    function readIndices(uint256 face) internal pure returns (uint256 indices) {
        assembly ("memory-safe") {
            indices := shr(208, calldataload(face))
        }
    }

    /// @notice Appends one triangle to the list, as `assemble` does.
    /// @param a The screen words of its vertices.
    /// @param edges Which edges belong to the face, three bits as in the list.
    function append(uint256 list, uint256 a, uint256 b, uint256 c, uint256 edges, uint256 face, bool cull) internal pure returns (uint256) {
        unchecked {
            int256 area = (column(c) - column(a)) * (row(b) - row(a)) - (column(b) - column(a)) * (row(c) - row(a));
            if (area == 0 || (cull && area < 0)) return list;
            if (area < 0) {
                (b, c) = (c, b);
                edges = (edges >> 2) | (edges & 2) | ((edges & 1) << 2);
            }
            while (a > b || a > c) {
                (a, b, c) = (b, c, a);
                edges = (edges >> 1) | ((edges & 1) << 2);
            }
            uint256 top = (a + load(ROUND_TOP)) >> 136;
            uint256 bottom = ((b > c ? b : c) + load(ROUND_BOTTOM)) >> 136;
            if (top >= bottom) return list;
            uint256 outside = ((a | b | c) & IS_OUTSIDE) << 106;
            store(
                list,
                (edges << 144) | (face << 128) | outside | (bottom << 112) | (top << 96) | ((a & 0xffffffff) << 64)
                    | ((b & 0xffffffff) << 32) | (c & 0xffffffff)
            );
            return list + 32;
        }
    }

    function column(uint256 screenWord) private pure returns (int256) {
        return int256((screenWord >> 64) & 0xfffff);
    }

    function row(uint256 screenWord) private pure returns (int256) {
        return int256(screenWord >> 128);
    }
}
