// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Light, Material, Scene, POINT, FLAT} from "../scene/Scene.sol";
import {Specular, UNBOUNDED_REACH} from "./Specular.sol";
import {View} from "./View.sol";
import "../words/Registers.sol";

// Computes the factors of `radiance` of picture.py: lights times coefficients of the material.

/// @notice Computes how a lit surface reflects the lights, and the precision of shading it requires.
library Materials {
    /// @return mode The bits that the material adds to OBJECT_MODE.
    function set(View memory view_, Scene calldata scene, Material calldata material) internal pure returns (uint256 mode) {
        unchecked {
            setReach(view_, scene, material);
            store(AMBIENT, scaled(scene.ambientLight, material.ambient.raw()));
            Light[] calldata lights = scene.lights;
            uint256 record = LIGHTS;
            bool grey = isGrey(load(AMBIENT));
            for (uint256 i; i != lights.length; ++i) {
                uint256 diffuse = scaled(lights[i].color, material.diffuse.raw());
                grey = grey && isGrey(diffuse);
                store(record + LIGHT_DIFFUSE, diffuse);
                if (load(record + LIGHT_CONE) != 0) mode = IS_SPOT_LIT;
                record += LIGHT_SIZE;
            }
            if (material.specular.raw() != 0) mode |= HAS_SPECULAR;
            if (grey) mode |= IS_GREY;
            Specular.setTable(uint256(material.specular.raw()), material.shininess);
            // without lights the normal has no effect
            if (material.shading == FLAT || (lights.length == 0 && load(EFFECTS_SIZE) == 0)) {
                mode |= IS_FLAT;
                store(FRAGMENT_SQUARE, ONE_48);
                store(FRAGMENT_NORMAL_LENGTH, ONE_24);
            } else {
                store(FACE_LIGHT_40, load(AMBIENT) << (Q40 - Q16));
                uint256 focal = uint256(view_.focal) >> Q32;
                bool isPoint = load(LIGHTS + LIGHT_IS_POINT) != 0;
                if (lights.length > 1 && load(LIGHTS + LIGHT_SIZE + LIGHT_IS_POINT) != 0) isPoint = true;
                // the errors of two lamps may add up
                uint256 reach = smoothReach(focal, uint256(material.diffuse.raw()) * lights.length, isPoint);
                if (view_.orthographic) focal = 0;
                Specular.setReaches(uint256(material.specular.raw()) * lights.length, material.shininess, reach, focal);
                Specular.setTurn(uint256(material.specular.raw()), material.shininess);
                // more lamps than a word of AntialiasedSmoothEngine has lanes for, or, without anti-aliasing, more than one, whose work
                // would mostly be done for each, are lit at each fragment
                bool isFew = lights.length == 1 || (lights.length == 2 && load(FRAME_IS_ANTIALIASED) != 0);
                if (isFew && mode & IS_SPOT_LIT == 0 && !(view_.orthographic && isPoint) && !Specular.isBroad(material)) {
                    mode |= IS_QUADRATIC;
                }
                mode |= IS_SMOOTH | IS_LIT | IS_DIFFUSE;
            }
        }
    }

    /// @dev Returns colour bytes times a coefficient (Q32): lanes of Q16 where 255 is one.
    function scaled(uint256 color, int256 coefficient) private pure returns (uint256) {
        unchecked {
            uint256 k = uint256(coefficient) >> (Q32 - Q16);
            return ((color & BLUE) * k / 255) | (((color >> GREEN_AT) & BLUE) * k / 255) << MIDDLE_AT
                | ((color >> RED_AT) * k / 255) << UPPER_AT;
        }
    }

    function isGrey(uint256 light) private pure returns (bool) {
        unchecked {
            return light == (light & LANE_32) * ONES;
        }
    }

    /// @dev A highlight cos^n changes with its angle by n * angle^2 / 2 about its centre, so linear interpolation over d pixels has an
    /// error of n * (d / 2f)^2 / 8, where the focal length f converts pixels to the angle of V, and H turns by half as much as V. One and a
    /// half levels of 255 are allowed.
    ///
    /// H turns by up to as much as V, divided by |L + V|. If the square of that may be below 4/3 on the canvas, which happens for lights
    /// ahead of the camera, it is taken into account.
    function setReach(View memory view_, Scene calldata scene, Material calldata material) private pure {
        unchecked {
            uint256 focal = uint256(view_.focal) >> Q32;
            uint256 strength = material.shininess * uint256(material.specular.raw());
            bool point;
            Light[] calldata lights = scene.lights;
            for (uint256 i; i != lights.length; ++i) if (lights[i].kind == POINT) point = true;
            if (point) strength += 2 * uint256(material.diffuse.raw());
            strength *= lights.length;
            uint256 reach = UNBOUNDED_REACH;
            if (view_.orthographic) reach = point ? 0 : UNBOUNDED_REACH;
            else if (strength != 0) reach = (48 * focal * focal << Q32) / (255 * strength);
            if (!view_.orthographic && material.specular.raw() != 0) reach = reach * turning(scene) >> Q24;
            store(REACH, Specular.isBroad(material) ? 0 : reach);
        }
    }

    /// @return least A lower bound of 3/4 of |L + V|^2 = 2 + 2 L.V on the canvas, for all directional lights, Q24: 0 to 1.
    function turning(Scene calldata scene) private pure returns (uint256 least) {
        least = (2 * ONE_24 + 2) / 3;
        uint256 width = scene.canvas.width;
        uint256 height = scene.canvas.height;
        assembly ("memory-safe") {
            function size(v) -> s { s := xor(v, sar(255, v)) }
            let x := shr(1, mul(width, mload(RAY_STEP)))
            let y := shr(1, mul(height, mload(RAY_STEP)))
            for { let record := LIGHTS } lt(record, mload(LIGHTS_END)) { record := add(record, LIGHT_SIZE) } {
                if iszero(mload(add(record, LIGHT_IS_POINT))) {
                    // V = -(x, y, 1) or shorter
                    let part := add(mul(size(mload(add(record, LIGHT_X))), x), mul(size(mload(add(record, LIGHT_Y))), y))
                    part := sub(sub(ONE_24, shr(Q24, part)), mload(add(record, LIGHT_Z)))
                    if slt(part, least) { least := part }
                }
            }
            least := shr(1, mul(mul(3, least), sgt(least, 0)))
        }
    }

    /// @dev Returns the maximum sum of the squares of two edges, in sub-pixels, for which directions to a lamp can be interpolated in a
    /// triangle. The error is at most sum w_i w_j e_ij^2 / 2, where e is an edge divided by the distance of the lamp, or 5/4 of the edge
    /// divided by the distance of the eye: 5/4 is the square of how much nearer lamps may be. The sum is at most a quarter of that of two
    /// edges. Four levels of 255 are allowed.
    function smoothReach(uint256 focal, uint256 coefficient, bool isPoint) private pure returns (uint256) {
        unchecked {
            // 4 * 4 * 4 / 5 = 13
            return isPoint && coefficient != 0 ? (13 * focal * focal << Q32) / (255 * coefficient) : UNBOUNDED_REACH;
        }
    }
}
