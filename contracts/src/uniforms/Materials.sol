// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Light, Material, Scene, POINT, FLAT} from "../scene/Scene.sol";
import {Specular} from "./Specular.sol";
import {View} from "./View.sol";
import "../pipeline/Registers.sol";

/// @dev A reach, in squares of sub-pixels, that nothing exceeds.
uint256 constant UNBOUNDED_REACH = 1 << 60;

/// @notice How a surface that is lit answers the lights, and how finely it has to be shaded for that.
library Materials {
    /// @return mode What the material adds to OBJECT_MODE.
    function set(View memory view_, Scene calldata scene, Material calldata material) internal pure returns (uint256 mode) {
        unchecked {
            setReach(view_, scene.lights, material);
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
            // without lights the normal makes no difference
            if (material.shading == FLAT || lights.length == 0) {
                mode |= IS_FLAT;
                store(FRAGMENT_SQUARE, ONE_48);
                store(FRAGMENT_NORMAL_LENGTH, ONE_24);
            } else {
                store(FACE_LIGHT_40, load(AMBIENT) << (Q40 - Q16));
                uint256 focal = uint256(view_.focal) >> Q32;
                bool isPoint = load(LIGHTS + LIGHT_IS_POINT) != 0;
                store(SMOOTH_REACH, smoothReach(focal, uint256(material.diffuse.raw()), isPoint));
                store(HALF_REACH, Specular.halfReach(uint256(material.specular.raw()), material.shininess));
                // with several lights most of the work would be done for each of them all the same
                if (lights.length == 1 && mode & IS_SPOT_LIT == 0 && !(view_.orthographic && isPoint) && !Specular.isBroad(material)) {
                    mode |= IS_QUADRATIC;
                }
                mode |= IS_SMOOTH | IS_LIT | IS_DIFFUSE;
            }
        }
    }

    /// @dev Colour bytes times a coefficient (Q32), lanes of Q16 where 255 is one.
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

    /// @dev A highlight cos^n changes with its angle by n * angle^2 / 2 about its middle, so over d pixels linear interpolation is
    /// off by n * (d / 2f)^2 / 8, where the focal length f turns pixels into the angle of V, and H turns half as far as V.
    /// One and a half levels of 255 are allowed.
    function setReach(View memory view_, Light[] calldata lights, Material calldata material) private pure {
        unchecked {
            uint256 focal = uint256(view_.focal) >> Q32;
            uint256 strength = material.shininess * uint256(material.specular.raw());
            bool point;
            for (uint256 i; i != lights.length; ++i) if (lights[i].kind == POINT) point = true;
            if (point) strength += 2 * uint256(material.diffuse.raw());
            strength *= lights.length;
            if (view_.orthographic) store(REACH, point ? 0 : UNBOUNDED_REACH);
            else store(REACH, strength == 0 ? UNBOUNDED_REACH : (48 * focal * focal << Q32) / (255 * strength));
            if (Specular.isBroad(material)) store(REACH, 0);
        }
    }

    /// @dev The sum of the squares of two edges, in sub-pixels, up to which directions to a lamp may be interpolated in a triangle. Their
    /// error is at most sum w_i w_j e_ij^2 / 2, where e is an edge by the distance of the lamp, or 5/4 of it by that of the eye: 5/4 is the
    /// square of how much nearer lamps may be. The sum is at most a quarter of that of two edges. Four levels of 255 are allowed.
    function smoothReach(uint256 focal, uint256 coefficient, bool isPoint) private pure returns (uint256) {
        unchecked {
            // 4 * 4 * 4 / 5 = 13
            return isPoint && coefficient != 0 ? (13 * focal * focal << Q32) / (255 * coefficient) : UNBOUNDED_REACH;
        }
    }
}
