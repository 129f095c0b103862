// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title SceneErrors: the errors of invalid scenes.
/// @notice Inherited by contracts that draw scenes through others, so that their ABIs include these errors. Indices of lights, objects and
/// faces count from 0; lengths are Q32. `Checks.sol` contains the bounds.
interface SceneErrors {
    /// @notice The offset or length at this calldata position points beyond the end of the calldata.
    error MalformedScene(uint256 position);
    error CanvasSize(uint256 width, uint256 height);
    error RectangleOutsideCanvas(uint256 x, uint256 y, uint256 width, uint256 height);
    error UnknownProjection(uint256 projection);
    error HalfHeightOutOfRange(int256 halfHeight);
    error NearOutOfRange(int256 near);
    /// @notice The eye, the target or `up` has a coordinate out of range.
    error CameraOutOfRange(int256 x, int256 y, int256 z);
    /// @notice The eye is at the target, or `up` is zero or points along the line of sight.
    error NoViewDirection();
    /// @notice A colour of the background, or the ambient light, is not 0xRRGGBB.
    error NotAColor(uint256 value);
    error NotAFlag(uint256 value);
    error TooManyLights(uint256 count);
    error UnknownLight(uint256 light, uint256 kind);
    error LightOutOfRange(uint256 light, int256 x, int256 y, int256 z);
    error LightNotAColor(uint256 light, uint256 value);
    error LightWithoutDirection(uint256 light);
    /// @notice The header of the mesh is invalid: `format` has unknown bits, or the data ends within the header.
    error MeshHeader(uint256 object, uint256 format, uint256 length);
    /// @notice The mesh must have `expected` bytes by the counts in its header, but has `actual`.
    error MeshLength(uint256 object, uint256 expected, uint256 actual);
    error PositionOutOfRange(uint256 object, int256 x, int256 y, int256 z);
    error UnknownShading(uint256 object, uint256 shading);
    /// @notice Smooth shading requires normals in the mesh.
    error NoNormals(uint256 object);
    error CoefficientOutOfRange(uint256 object, int256 value);
    error ShininessOutOfRange(uint256 object, uint256 shininess);
    error UnknownFlags(uint256 object, uint256 flags);
    error ScaleOutOfRange(uint256 object, int256 scale);
    error RotationOutOfRange(uint256 object, int256 x, int256 y, int256 z, int256 w);
    error RotationIsZero(uint256 object);
    /// @notice The extensions end within the record that begins at this byte.
    error ExtensionCutOff(uint256 position);
    error UnknownExtension(uint256 kind, uint256 index);
    /// @notice The record is out of order: kinds must ascend, and indices within a kind.
    error ExtensionOrder(uint256 kind, uint256 index);
    error ExtensionSize(uint256 kind, uint256 index, uint256 expected, uint256 actual);
    /// @notice The index of the record must be below `count`, the number of lights or objects, or 1 for the scene.
    error ExtensionIndex(uint256 kind, uint256 index, uint256 count);
    /// @notice Only point lights can be spot lights.
    error SpotIsNoPoint(uint256 light);
    error SpotOutOfRange(uint256 light, int256 x, int256 y, int256 z);
    error SpotWithoutDirection(uint256 light);
    /// @notice The cosines must be -1 to 1, and the outer one must not exceed the inner one.
    error SpotAngles(uint256 light, int256 cosInner, int256 cosOuter);
    /// @notice An opacity must be below 1 (2^24): opaque objects have no such record.
    error OpacityOutOfRange(uint256 object, uint256 opacity);
    /// @notice The exponent of a rim must be 1 to 16.
    error RimPowerOutOfRange(uint256 power);
    /// @notice Fog must begin at a distance of at least 0 and become opaque farther away, at most at 2^58 (Q32).
    error FogOutOfRange(int256 near, int256 far);
    /// @notice An exposure must be above 0 and at most 64 (Q16).
    error ExposureOutOfRange(uint256 exposure);
    /// @notice The flags of a tone have unknown bits; the valid ones are 1 and 2.
    error UnknownToneFlags(uint256 flags);
    /// @notice At most one light can cast shadows; this is a second one.
    error SeveralShadows(uint256 light);
    /// @notice The shadow rule must be 1, 2 or 3.
    error ShadowRuleOutOfRange(uint256 light, uint256 rule);
    /// @notice The inner radius of a ground must be below the outer one, which must be at most 2^58 (Q32).
    error GroundOutOfRange(uint256 object, uint256 inner, uint256 outer);
    /// @notice The flags of a texture must be 0 to 3, and its texels must have 1, 2, 4, 8 or 24 bits.
    error TextureFormat(uint256 object, uint256 flags, uint256 bits);
    error IndexOutOfRange(uint256 object, uint256 face, uint256 vertexCount);
    /// @notice The engine ran out of gas.
    error OutOfGas();
}
