// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @title SceneErrors: the errors of invalid scenes.
/// @notice Inherited by contracts that draw scenes through others, so that their ABIs include these errors. Indices of lights, objects and
/// faces count from 0; lengths are Q32. `Checks.sol` contains the bounds.
interface SceneErrors {
    /// @notice The offset or length at this calldata position points beyond the end of the calldata.
    error MalformedScene(uint256 position);
    /// @notice The canvas must be 1 to 2,048 pixels wide and high.
    error CanvasSize(uint256 width, uint256 height);
    /// @notice The rectangle must not be empty, and must lie within the canvas.
    error RectangleOutsideCanvas(uint256 x, uint256 y, uint256 width, uint256 height);
    /// @notice The projection must be PERSPECTIVE (0) or ORTHOGRAPHIC (1).
    error UnknownProjection(uint256 projection);
    /// @notice `halfHeight` must be 2^-10 to 2^10 for a perspective camera, 2^-12 to 2^26 units for an orthographic one (Q32).
    error HalfHeightOutOfRange(int256 halfHeight);
    /// @notice `near` must be above 0 for a perspective camera, at least -2^26 for an orthographic one, and at most 2^26 units (Q32).
    error NearOutOfRange(int256 near);
    /// @notice The eye, the target or `up` has a coordinate out of range.
    error CameraOutOfRange(int256 x, int256 y, int256 z);
    /// @notice The eye is at the target, or `up` is zero or points along the line of sight.
    error NoViewDirection();
    /// @notice A colour of the background, or the ambient light, is not 0xRRGGBB.
    error NotAColor(uint256 value);
    /// @notice `invert` must be 0 or 1.
    error NotAFlag(uint256 value);
    /// @notice A scene can have at most 4 lights.
    error TooManyLights(uint256 count);
    /// @notice The kind of a light must be DIRECTIONAL (0) or POINT (1).
    error UnknownLight(uint256 light, uint256 kind);
    /// @notice The coordinates of a light must be at most 2^26 in magnitude (Q32).
    error LightOutOfRange(uint256 light, int256 x, int256 y, int256 z);
    /// @notice The colour of a light must be 0xRRGGBB.
    error LightNotAColor(uint256 light, uint256 value);
    error LightWithoutDirection(uint256 light);
    /// @notice The header of the mesh is invalid: `format` has unknown bits, or the data ends within the header.
    error MeshHeader(uint256 object, uint256 format, uint256 length);
    /// @notice The mesh must have `expected` bytes by the counts in its header, but has `actual`.
    error MeshLength(uint256 object, uint256 expected, uint256 actual);
    /// @notice The position of an object must be at most 2^26 units from the origin along each axis (Q32).
    error PositionOutOfRange(uint256 object, int256 x, int256 y, int256 z);
    /// @notice The shading must be UNLIT (0), FLAT (1) or SMOOTH (2).
    error UnknownShading(uint256 object, uint256 shading);
    /// @notice Smooth shading requires normals in the mesh.
    error NoNormals(uint256 object);
    /// @notice The coefficients of a material must be 0 to 4 (Q32).
    error CoefficientOutOfRange(uint256 object, int256 value);
    /// @notice The shininess must be 1 to 128.
    error ShininessOutOfRange(uint256 object, uint256 shininess);
    /// @notice `flags` has unknown bits; the valid ones are CULL_BACKFACES (1), WIREFRAME (2) and TWO_SIDED (4).
    error UnknownFlags(uint256 object, uint256 flags);
    /// @notice The scale must be at least 0 and at most 2^59 / 2^(bits - 1) as a Q32 number, for mesh coordinates of 16 or 24 bits.
    error ScaleOutOfRange(uint256 object, int256 scale);
    /// @notice The components of a rotation must be at most 2^26 in magnitude (Q32).
    error RotationOutOfRange(uint256 object, int256 x, int256 y, int256 z, int256 w);
    /// @notice A rotation must not be zero; the identity is (0, 0, 0, 1).
    error RotationIsZero(uint256 object);
    /// @notice The extensions end within the record that begins at this byte.
    error ExtensionCutOff(uint256 position);
    error UnknownExtension(uint256 kind, uint256 index);
    /// @notice The record is out of order: kinds must ascend, and indices within a kind.
    error ExtensionOrder(uint256 kind, uint256 index);
    /// @notice The content of the record must have `expected` bytes.
    error ExtensionSize(uint256 kind, uint256 index, uint256 expected, uint256 actual);
    /// @notice The index of the record must be below `count`, the number of lights or objects, or 1 for the scene.
    error ExtensionIndex(uint256 kind, uint256 index, uint256 count);
    /// @notice Only point lights can be spot lights.
    error SpotIsNoPoint(uint256 light);
    /// @notice The coordinates of a spot light's direction must be at most 2^26 in magnitude (Q32).
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
    /// @notice The light that an object emits must be 0xRRGGBB.
    error EmissionNotAColor(uint256 object, uint256 value);
    /// @notice Texels have opacities, but the object has no texture.
    error AlphaWithoutTexture(uint256 object);
    /// @notice The flags of a texture, or of an image of opacities, must be 0 to 3, and its texels must have 1, 2, 4, 8 or 24 bits.
    error TextureFormat(uint256 object, uint256 flags, uint256 bits);
    /// @notice The face has a vertex index that is not below `vertexCount`.
    error IndexOutOfRange(uint256 object, uint256 face, uint256 vertexCount);
    /// @notice The engine ran out of gas.
    error OutOfGas();
}
