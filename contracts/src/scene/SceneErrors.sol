// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title SceneErrors: what can be wrong with a scene.
/// @notice Contracts that draw scenes for others inherit this, so that their ABIs have these errors, wherever they arise. Indices of
/// lights, objects, faces count from 0; lengths are Q32. The bounds stand in `Checks.sol`.
interface SceneErrors {
    /// @notice The number at this place of the call, an offset or a length, leads beyond the end of the call.
    error MalformedScene(uint256 position);
    error CanvasSize(uint256 width, uint256 height);
    error RectangleOutsideCanvas(uint256 x, uint256 y, uint256 width, uint256 height);
    error UnknownProjection(uint256 projection);
    error HalfHeightOutOfRange(int256 halfHeight);
    error NearOutOfRange(int256 near);
    /// @notice The eye, the target or `up`.
    error CameraOutOfRange(int256 x, int256 y, int256 z);
    /// @notice The eye is at the target, or `up` is zero or points along the line of sight.
    error NoViewDirection();
    /// @notice A colour of the background, or that of the ambient light.
    error NotAColor(uint256 value);
    error NotAFlag(uint256 value);
    error TooManyLights(uint256 count);
    error UnknownLight(uint256 light, uint256 kind);
    error LightOutOfRange(uint256 light, int256 x, int256 y, int256 z);
    error LightNotAColor(uint256 light, uint256 value);
    error LightWithoutDirection(uint256 light);
    /// @notice The header is not that of a mesh: `format` has bits that mean nothing, or the bytes end before it is complete.
    error MeshHeader(uint256 object, uint256 format, uint256 length);
    /// @notice The counts of the header ask for `expected` bytes in all, `actual` were given.
    error MeshLength(uint256 object, uint256 expected, uint256 actual);
    error PositionOutOfRange(uint256 object, int256 x, int256 y, int256 z);
    error UnknownShading(uint256 object, uint256 shading);
    /// @notice Smooth shading needs normals in the mesh.
    error NoNormals(uint256 object);
    error CoefficientOutOfRange(uint256 object, int256 value);
    error ShininessOutOfRange(uint256 object, uint256 shininess);
    error UnknownFlags(uint256 object, uint256 flags);
    error ScaleOutOfRange(uint256 object, int256 scale);
    error RotationOutOfRange(uint256 object, int256 x, int256 y, int256 z, int256 w);
    error RotationIsZero(uint256 object);
    /// @notice The extensions end within the record that begins at this byte of them.
    error ExtensionCutOff(uint256 position);
    error UnknownExtension(uint256 kind, uint256 index);
    /// @notice The record does not come after the one before it: kinds ascend, and the indices of a kind.
    error ExtensionOrder(uint256 kind, uint256 index);
    error ExtensionSize(uint256 kind, uint256 index, uint256 expected, uint256 actual);
    /// @notice There are only `count` lights or objects, or the one scene.
    error ExtensionIndex(uint256 kind, uint256 index, uint256 count);
    /// @notice A light that is no point light has a cone.
    error SpotIsNoPoint(uint256 light);
    error SpotOutOfRange(uint256 light, int256 x, int256 y, int256 z);
    error SpotWithoutDirection(uint256 light);
    /// @notice The cosines are from -1 to 1, and the outer one is not the greater.
    error SpotAngles(uint256 light, int256 cosInner, int256 cosOuter);
    /// @notice Opacities are below 1, 2^24: what is opaque has none.
    error OpacityOutOfRange(uint256 object, uint256 opacity);
    /// @notice The power of a rim is from 1 to 16.
    error RimPowerOutOfRange(uint256 power);
    /// @notice Fog begins at a distance from 0 on, and hides everything farther away, 2^58 at most (Q32).
    error FogOutOfRange(int256 near, int256 far);
    /// @notice An exposure is above 0, and 64 at most (Q16).
    error ExposureOutOfRange(uint256 exposure);
    /// @notice The flags of a tone are 1 and 2.
    error UnknownToneFlags(uint256 flags);
    /// @notice One light casts shadows at most; this is a second one.
    error SeveralShadows(uint256 light);
    /// @notice The rule is 1, 2 or 3.
    error ShadowRuleOutOfRange(uint256 light, uint256 rule);
    /// @notice The inner radius of a ground is below its outer one, which is 2^58 at most (Q32).
    error GroundOutOfRange(uint256 object, uint256 inner, uint256 outer);
    /// @notice The flags of a texture are 0 to 3, and its texels have 1, 2, 4, 8 or 24 bits.
    error TextureFormat(uint256 object, uint256 flags, uint256 bits);
    error IndexOutOfRange(uint256 object, uint256 face, uint256 vertexCount);
    /// @notice The engine has used up the gas of the call.
    error OutOfGas();
}
