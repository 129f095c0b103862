// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Extensions} from "../scene/Extensions.sol";
import {RECORD_HEADER, SPOT} from "../words/Records.sol";
import {Light, Scene, POINT, Fixed, Vector, normalize} from "../scene/Scene.sol";
import {View} from "./View.sol";
import "../words/Registers.sol";

// Prepares `toward` and `through_cone` of picture.py: the lights in camera space.

/// @dev The minimum difference of the cosines between which a spot light fades, 2^-10, Q24: 1/1000 in glTF.
int256 constant MIN_CONE = int256(ONE_24 >> 10);

library Lights {
    /// @notice Sets the lights in camera space.
    /// @return extension The first record of the scene's extensions that does not belong to a light.
    function set(View memory view_, Scene calldata scene) internal pure returns (uint256 extension) {
        unchecked {
            Light[] calldata lights = scene.lights;
            uint256 end;
            (extension, end) = Extensions.bounds(scene);
            uint256 record = LIGHTS;
            for (uint256 i; i != lights.length; ++i) {
                Light calldata light = lights[i];
                bool isPoint = light.kind == POINT;
                store(record + LIGHT_IS_POINT, isPoint ? 1 : 0);
                Vector memory v = light.vector;
                v = view_.toCamera(isPoint ? v.sub(view_.eye) : normalize(v));
                uint256 shift = isPoint ? Q32 - Q16 : Q32 - Q24;
                storeSigned(record + LIGHT_X, v.x.raw() >> shift);
                storeSigned(record + LIGHT_Y, v.y.raw() >> shift);
                storeSigned(record + LIGHT_Z, v.z.raw() >> shift);
                store(record + LIGHT_COLOR, colorLanes(light.color));
                if (Extensions.isOf(extension, end, SPOT, i)) {
                    setSpot(view_, extension, record);
                    extension += RECORD_HEADER + Extensions.sizeOf(extension);
                }
                record += LIGHT_SIZE;
            }
            // fragments are lit by at least one light, if necessary a black one
            if (lights.length == 0 && load(EFFECTS_SIZE) != 0) record += LIGHT_SIZE;
            store(LIGHTS_END, record);
        }
    }

    /// @dev Sets the cone of a light. Differences of the cosines below 2^-10 are widened to that.
    function setSpot(View memory view_, uint256 extension, uint256 record) private pure {
        unchecked {
            Vector memory axis = Vector(
                Fixed.wrap(Extensions.spotNumber(extension, 0)),
                Fixed.wrap(Extensions.spotNumber(extension, 1)),
                Fixed.wrap(Extensions.spotNumber(extension, 2))
            );
            axis = view_.toCamera(normalize(axis));
            storeSigned(record + LIGHT_AXIS_X, axis.x.raw() >> (Q32 - Q24));
            storeSigned(record + LIGHT_AXIS_Y, axis.y.raw() >> (Q32 - Q24));
            storeSigned(record + LIGHT_AXIS_Z, axis.z.raw() >> (Q32 - Q24));
            int256 outer = Extensions.spotNumber(extension, 4) >> (Q32 - Q24);
            int256 cone = (Extensions.spotNumber(extension, 3) >> (Q32 - Q24)) - outer;
            storeSigned(record + LIGHT_COS_OUTER, outer);
            storeSigned(record + LIGHT_CONE, cone < MIN_CONE ? MIN_CONE : cone);
        }
    }

    /// @return The colour as lanes of bytes.
    function colorLanes(uint256 color) internal pure returns (uint256) {
        return (color & BLUE) | ((color & GREEN) << GREEN_TO_LANE) | ((color & RED) << RED_TO_LANE);
    }
}
