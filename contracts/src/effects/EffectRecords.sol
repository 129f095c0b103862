// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Extensions} from "../scene/Extensions.sol";
import {openMesh} from "../scene/Mesh.sol";
import {loadCalldata} from "../words/Memory.sol";
import "../words/Records.sol";
import {Scene} from "../scene/Scene.sol";
import {SceneErrors} from "../scene/SceneErrors.sol";

// Computes `records_of` of picture.py for effects, and checks them.
// The contents of effect records: see `Extensions.sol`, and `words/Records.sol` for what they belong to. Colours are three bytes: red,
// green, blue.
//
//   HEMISPHERE   the colour of the light from above (+y), then of the light from below
//   RIM          the colour of the light at silhouettes; the exponent of its falloff, 1 byte, 1..16
//   FOG          its colour; the distances along the line of sight at which it begins and at which it is opaque, 8 bytes each, Q32,
//                0 to 2^58, the second above the first
//   TONE         the exposure, by which the final light is multiplied, 4 bytes, Q16, above 0, up to 64; flags, 1 byte: see TONE_FILMIC
//   TEXTURE      of an object, padded with zeros to words of 32 bytes:
//                flags         1 byte    sum of TEXTURE_BILINEAR and TEXTURE_CLAMP
//                sides         2 bytes   width - 1 and height - 1
//                bits          1 byte    bits of a texel: 1, 2, 4, 8, or 24
//                palette                 2^bits colours of 3 bytes; absent if texels have 24 bits, which are colours themselves
//                texels                  rows from the top, without gaps; padded with zeros to a whole byte
//                coordinates             u and v of each vertex, 3 bytes each, Q16, signed; (0, 0) is the upper left corner of the
//                                        image, (1, 1) the lower right one
//   OPACITIES    of an object: 1 byte for each vertex of the mesh, 255 being opaque, padded with zeros to words
//   SHADOW       of the light that casts shadows, at most one: a word, which selects the casting faces of culled objects: see SHADOWS_ALL
//   GROUND       of an object that casts no shadow and fades into the background: a word, whose upper half contains two distances from
//                the object's position, at which it begins to fade and at which it vanishes, 8 bytes each, Q32, 0 to 2^58, the second
//                above the first
//   EMISSION     of an object: the colour of the light that it emits, a word, 0xRRGGBB
//   ALPHA        of an object with a TEXTURE: the least opacity of texels that are drawn, 1 byte: these are opaque; if it is 0, they are
//                blended. Then the image of opacities as flags, sides, bits, palette and texels of a TEXTURE, of whose colours the blue
//                counts; padded with zeros to words
//
// `SurfaceLight`, `Texture` and `Ground` implement them.

uint256 constant MAX_RIM_POWER = 16;
/// @dev 2^26 units, Q32.
int256 constant MAX_FOG_DISTANCE = 1 << 58;
/// @dev Q16.
uint256 constant MAX_EXPOSURE = 64 << 16;
/// @dev Bytes before the palette; bits of a texel that contains a colour; bytes of a pair of coordinates; 2^bits for all bits that a texel
/// can have, ORed.
uint256 constant TEXTURE_HEADER = 4;
uint256 constant TEXTURE_COLOR_BITS = 24;
uint256 constant UV_SIZE = 6;
uint256 constant BITS_ALLOWED = 0x1000116;
/// @dev Bytes before the image of an ALPHA.
uint256 constant ALPHA_HEADER = 1;
/// @dev The maximum radius of a GROUND: 2^26 units, Q32.
uint256 constant MAX_FADE = 1 << 58;

library EffectRecords {
    /// @notice Checks all effect records.
    function check(Scene calldata scene) internal pure {
        unchecked {
            (uint256 record, uint256 end) = Extensions.behind(scene, ANTIALIAS);
            bool hasShadow;
            for (; record != end; record += RECORD_HEADER + Extensions.sizeOf(record)) {
                uint256 key = Extensions.keyOf(record);
                (uint256 kind, uint256 index) = (key >> 16, key & 0xffff);
                Extensions.checkHeader(scene, record);
                uint256 content = loadCalldata(record + RECORD_HEADER);
                if (kind == TEXTURE_OF || kind == OPACITIES_OF || kind == ALPHA_OF) checkSize(scene, record, kind, index);
                if (kind == RIM) checkRim(content);
                if (kind == FOG) checkFog(content);
                if (kind == TONE) checkTone(content);
                if (kind == GROUND) checkGround(content, index);
                if (kind == EMISSION_OF && content > 0xffffff) revert SceneErrors.EmissionNotAColor(index, content);
                if (kind == SHADOW) {
                    if (hasShadow) revert SceneErrors.SeveralShadows(index);
                    hasShadow = true;
                    if (content == 0 || content > SHADOWS_FRONT_FACES) revert SceneErrors.ShadowRuleOutOfRange(index, content);
                }
            }
        }
    }

    /// @dev Checks the size of a record that has data for each vertex.
    function checkSize(Scene calldata scene, uint256 record, uint256 kind, uint256 index) private pure {
        unchecked {
            uint256 size = Extensions.sizeOf(record);
            uint256 expected = openMesh(scene.objects[index].mesh).vertexCount;
            if (kind != OPACITIES_OF) {
                if (size == 0) revert SceneErrors.ExtensionSize(kind, index, 32, 0);
                uint256 begin = record + RECORD_HEADER;
                record = begin;
                if (kind == ALPHA_OF) {
                    if (Extensions.find(scene, TEXTURE_OF, index) == 0) revert SceneErrors.AlphaWithoutTexture(index);
                    expected = 0;
                    record += ALPHA_HEADER;
                }
                uint256 header = loadCalldata(record) >> 224;
                (uint256 flags, uint256 bits) = (header >> 24, header & 0xff);
                if (flags > TEXTURE_BILINEAR | TEXTURE_CLAMP || (BITS_ALLOWED >> bits) & 1 == 0) {
                    revert SceneErrors.TextureFormat(index, flags, bits);
                }
                expected = UV_SIZE * expected + uvsOf(record) - begin;
            }
            expected = expected == 0 ? 32 : (expected + 31) & ~uint256(31);
            if (size != expected) revert SceneErrors.ExtensionSize(kind, index, expected, size);
        }
    }

    /// @notice Returns the position of the texture coordinates in the content of a TEXTURE.
    function uvsOf(uint256 texture) internal pure returns (uint256) {
        unchecked {
            uint256 header = loadCalldata(texture) >> 224;
            uint256 bits = header & 0xff;
            uint256 texels = (((header >> 16) & 0xff) + 1) * (((header >> 8) & 0xff) + 1);
            return texture + TEXTURE_HEADER + (bits == TEXTURE_COLOR_BITS ? 0 : 3 << bits) + (texels * bits + 7) / 8;
        }
    }

    /// @notice Returns the exponent of a RIM.
    function rimPower(uint256 content) internal pure returns (uint256) {
        return (content >> 224) & 0xff;
    }

    /// @notice Returns the distances of a FOG, Q32.
    function fogDistances(uint256 content) internal pure returns (int256 near, int256 far) {
        return (int256(content << 24) >> 192, int256(content << 88) >> 192);
    }

    /// @notice Returns the exposure of a TONE, Q16, and its flags.
    function toneOf(uint256 content) internal pure returns (uint256 exposure, uint256 flags) {
        return (content >> 224, (content >> 216) & 0xff);
    }

    /// @notice Returns the radii of a GROUND, Q32.
    function radiiOf(uint256 content) internal pure returns (uint256 inner, uint256 outer) {
        return (content >> 192, (content >> 128) & type(uint64).max);
    }

    function checkRim(uint256 content) private pure {
        uint256 power = rimPower(content);
        if (power == 0 || power > MAX_RIM_POWER) revert SceneErrors.RimPowerOutOfRange(power);
    }

    function checkFog(uint256 content) private pure {
        (int256 near, int256 far) = fogDistances(content);
        if (near < 0 || near >= far || far > MAX_FOG_DISTANCE) revert SceneErrors.FogOutOfRange(near, far);
    }

    function checkTone(uint256 content) private pure {
        (uint256 exposure, uint256 flags) = toneOf(content);
        if (exposure == 0 || exposure > MAX_EXPOSURE) revert SceneErrors.ExposureOutOfRange(exposure);
        if (flags > TONE_FILMIC | TONE_GAMMA) revert SceneErrors.UnknownToneFlags(flags);
    }

    function checkGround(uint256 content, uint256 object) private pure {
        (uint256 inner, uint256 outer) = radiiOf(content);
        if (inner >= outer || outer > MAX_FADE) revert SceneErrors.GroundOutOfRange(object, inner, outer);
    }
}
