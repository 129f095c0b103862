// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {WIREFRAME} from "../scene/Scene.sol";
import "../words/Registers.sol";

// Computes the order of objects of `draw` of picture.py.
// Assigns objects to engines, and determines the order: the opaque objects in the order of the scene, then the others. Consecutive objects
// with the same engine are a run: one call. Everything is read from the uniforms in the calldata: see Uniforms.

/// @dev The engine and pass of objects.
uint256 constant BY_FACES = 0;
uint256 constant BY_FRAGMENTS = 1;
uint256 constant BLENDED = 2;
/// @dev Opaque surfaces with IS_QUADRATIC, if pixels have four samples.
uint256 constant BY_QUADRATIC = 3;

/// @param first The number of the first object, and `count` the number of objects; 0 if there is nothing left to draw.
/// @param position The address of the uniforms of the first object; `end` is the end of those of the last one.
struct Run {
    uint256 turn;
    uint256 first;
    uint256 count;
    uint256 position;
    uint256 end;
}

library Runs {
    /// @notice Returns the first run of a call.
    function begin(uint256 data) internal pure returns (Run memory) {
        uint256 objects = startOf(data);
        return next(data, Run(BY_FACES, 0, 0, objects, objects));
    }

    /// @notice Returns the run after another one.
    function next(uint256 data, Run memory run) internal pure returns (Run memory found) {
        unchecked {
            uint256 objects = load(registerOf(data, OBJECT_TOTAL));
            uint256 number = run.first + run.count;
            uint256 position = run.end;
            bool isBlended = run.turn == BLENDED;
            while (true) {
                for (; number != objects; ++number) {
                    uint256 turn = turnOf(position);
                    if (found.count != 0 && turn != found.turn) return found;
                    if ((turn == BLENDED) == isBlended) {
                        if (found.count == 0) found = Run(turn, number, 0, position, 0);
                        ++found.count;
                        found.end = position + load(position);
                    }
                    position += load(position);
                }
                if (found.count != 0 || isBlended) return found;
                // once more from the beginning, for translucent objects
                isBlended = true;
                number = 0;
                position = startOf(data);
            }
        }
    }

    /// @param position The address of the uniforms of an object.
    function turnOf(uint256 position) private pure returns (uint256) {
        unchecked {
            uint256 mode = load(position + OBJECT_MODE - OBJECT_BYTES);
            if (mode & IS_BLENDED != 0) return BLENDED;
            // a single engine draws everything
            if (load(EFFECTS_SIZE) != 0) return BY_FACES;
            if (load(position + OBJECT_FLAGS - OBJECT_BYTES) & WIREFRAME != 0) return BY_FRAGMENTS;
            if (mode & IS_QUADRATIC != 0 && load(FRAME_IS_ANTIALIASED) != 0) return BY_QUADRATIC;
            return mode & (IS_SMOOTH | IS_SPOT_LIT) != 0 ? BY_FRAGMENTS : BY_FACES;
        }
    }

    /// @notice Changes the calldata so that a run is drawn.
    /// @param isLast Whether nothing is drawn after it.
    function set(uint256 data, Run memory run, bool isLast) internal pure {
        unchecked {
            store(registerOf(data, OBJECTS), run.position - data);
            store(registerOf(data, OBJECT_FIRST), run.first);
            store(registerOf(data, OBJECT_COUNT), run.count);
            store(registerOf(data, RETURNS_DEPTHS), isLast ? 0 : 1);
            store(registerOf(data, INVERT), isLast ? load(INVERT) : 0);
            store(registerOf(data, COUNT_PIXELS), isLast ? load(COUNT_PIXELS) : 0);
        }
    }

    /// @notice Sets the number of objects in the calldata.
    function setCount(uint256 data, uint256 count) internal pure {
        store(registerOf(data, OBJECT_COUNT), count);
        store(registerOf(data, OBJECT_TOTAL), count);
    }

    /// @notice Sets the address of the pixels and depths drawn before in the calldata.
    function setDrawn(uint256 data, uint256 drawn) internal pure {
        unchecked {
            store(registerOf(data, DRAWN_BEFORE), drawn - data);
        }
    }

    /// @notice Changes the calldata so that the triangles of all objects are counted, and nothing is drawn.
    function setOnlyCounts(uint256 data) internal pure {
        store(registerOf(data, ONLY_COUNTS), 1);
    }

    /// @dev Returns the address of the uniforms of the first object.
    function startOf(uint256 data) private pure returns (uint256) {
        unchecked {
            return data + load(registerOf(data, OBJECTS_BEGIN));
        }
    }

    /// @dev Returns the address of a frame register in the calldata.
    function registerOf(uint256 data, uint256 register) private pure returns (uint256) {
        unchecked {
            return data + 4 + register - FRAME_BEGIN;
        }
    }
}
