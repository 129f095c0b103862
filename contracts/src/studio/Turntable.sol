// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Apng} from "../encode/Apng.sol";
import {DataUri} from "../encode/DataUri.sol";
import {answer} from "../encode/Redirect.sol";
import {IPngEncoder} from "../interfaces/IPngEncoder.sol";
import {IRenderer} from "../interfaces/IRenderer.sol";
import {ITurntable} from "../interfaces/ITurntable.sol";
import {Turn} from "../interfaces/Turn.sol";
import {sinCosOfHalf} from "../math/Euler.sol";
import {inRange} from "../scene/Checks.sol";
import {Object, Scene, Fixed, Vector, Quaternion} from "../scene/Scene.sol";
import {WithEncoder} from "../WithRenderer.sol";
import {FollowingCamera} from "./FollowingCamera.sol";
import {SceneChanges} from "./SceneChanges.sol";

/// @title Turntable: makes animated PNG files of rotating scenes, for the Studio and any contract.
/// @notice Stateless. Each frame is drawn by a separate call and only its compressed bytes are kept, because memory cost grows
/// quadratically.
contract Turntable is WithEncoder, ITurntable {
    uint256 internal constant MAX_FRAMES = 360;
    uint256 internal constant MIN_DELAY = 20;
    uint256 internal constant MAX_DELAY = 10000;

    constructor(IRenderer renderer_, IPngEncoder encoder_) WithEncoder(renderer_, encoder_) {}

    function animate(Scene memory scene, Turn memory spin) external view returns (bytes memory) {
        answer(film(scene, spin));
    }

    function animateDataURI(Scene memory scene, Turn memory spin) external view returns (string memory) {
        string memory head = "data:image/png;base64,";
        answer(bytes(DataUri.wrap(head, film(scene, spin), "")));
    }

    function film(Scene memory scene, Turn memory spin) private view returns (bytes memory file) {
        unchecked {
            Vector memory axis = check(spin);
            SceneChanges.checkPlaces(scene);
            Vector memory center = SceneChanges.middle(scene);
            if (spin.hold) FollowingCamera.hold(scene, center, axis);
            Object[] memory still = copied(scene.objects);
            uint256 begin;
            assembly ("memory-safe") {
                file := mload(0x40)
                begin := add(file, 32)
            }
            uint256 end = begin;
            for (uint256 k; k != spin.frames; ++k) {
                // the memory of a frame begins behind the finished frames, and is freed
                assembly ("memory-safe") {
                    mstore(0x40, and(add(end, 63), not(31)))
                }
                if (k != 0) turn(scene, still, center, axis, Fixed.wrap(int256((k * 360 << 32) / spin.frames)));
                bytes memory png = encoder.compress(renderer.render(scene), spin.scale);
                if (k == 0) end = Apng.begin(end, png, spin.frames);
                end = Apng.frame(end, png, k, spin.delay);
            }
            end = Apng.finish(end);
            assembly ("memory-safe") {
                mstore(file, sub(end, begin))
                mstore(0x40, and(add(end, 63), not(31)))
            }
        }
    }

    /// @return axis The unit axis.
    function check(Turn memory spin) private pure returns (Vector memory axis) {
        if (spin.frames < 2 || spin.frames > MAX_FRAMES) revert FramesOutOfRange(spin.frames, 2, MAX_FRAMES);
        if (spin.delay < MIN_DELAY || spin.delay > MAX_DELAY) revert DelayOutOfRange(spin.delay, MIN_DELAY, MAX_DELAY);
        axis = spin.axis;
        bool fits = inRange(axis.x.raw()) && inRange(axis.y.raw()) && inRange(axis.z.raw());
        if (!fits || axis.isZero()) revert AxisOutOfRange();
        axis = axis.normalize();
    }

    /// @dev Copies positions and rotations of the objects. Both arrays share the same vectors and quaternions.
    function copied(Object[] memory objects) private pure returns (Object[] memory copies) {
        copies = new Object[](objects.length);
        for (uint256 k; k < objects.length; ++k) {
            (copies[k].position, copies[k].rotation) = (objects[k].position, objects[k].rotation);
        }
    }

    /// @dev Rotates the objects by an angle from their original orientation.
    function turn(Scene memory scene, Object[] memory still, Vector memory center, Vector memory axis, Fixed degrees_) private pure {
        for (uint256 k; k < still.length; ++k) {
            (scene.objects[k].position, scene.objects[k].rotation) = (still[k].position, still[k].rotation);
        }
        (Fixed sine, Fixed cosine) = sinCosOfHalf(degrees_.raw());
        SceneChanges.turn(scene, Quaternion(axis.x * sine, axis.y * sine, axis.z * sine, cosine), center);
    }
}
