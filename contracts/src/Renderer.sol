// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Fixed} from "./math/Fixed.sol";
import {Quaternion} from "./math/Quaternion.sol";
import {fromEuler} from "./math/Euler.sol";
import {Scene, Rectangle} from "./scene/Scene.sol";
import {checkScene} from "./scene/Checks.sol";
import {SceneErrors} from "./scene/SceneErrors.sol";
import {Bmp} from "./encode/Bmp.sol";
import {Svg} from "./encode/Svg.sol";
import {Engine} from "./Engine.sol";

/// @title Renderer: pictures of 3D scenes.
/// @notice Stateless. What is wrong with a scene is told by the errors of `SceneErrors.sol`.
contract Renderer is SceneErrors {
    /// @notice What computes the pixels.
    Engine public immutable engine;

    /// @notice The address has no code.
    error NoEngine(address engine);

    /// @dev A bitmap in memory. There are 128 free bytes before it and a word of zeros after it.
    struct File {
        uint256 begin;
        uint256 size;
        uint256 triangles;
        uint256 litPixels;
    }

    constructor(Engine engine_) {
        if (address(engine_).code.length == 0) revert NoEngine(address(engine_));
        engine = engine_;
    }

    /// @notice Draws a scene.
    /// @return A Windows bitmap of 24 bits a pixel.
    function render(Scene calldata scene) external view returns (bytes memory) {
        File memory file = draw(scene, whole(scene), false);
        returnBytes(file.begin, file.size);
    }

    /// @notice Draws a part of the canvas as a bitmap of its own. The parts of a picture together equal the whole, byte for byte.
    function renderTile(Scene calldata scene, Rectangle calldata tile) external view returns (bytes memory) {
        File memory file = draw(scene, tile, false);
        returnBytes(file.begin, file.size);
    }

    /// @notice Draws a scene and counts what was drawn.
    /// @return bmp As `render` returns it.
    /// @return triangles How many triangles were left after culling and clipping.
    /// @return litPixels How many pixels any of them covers.
    function renderCounted(Scene calldata scene) external view returns (bytes memory bmp, uint256 triangles, uint256 litPixels) {
        File memory file = draw(scene, whole(scene), true);
        (triangles, litPixels) = (file.triangles, file.litPixels);
        assembly ("memory-safe") {
            let size := mload(add(file, 0x20))
            let data := sub(mload(file), 0x80)
            mstore(data, 0x60)
            mstore(add(data, 0x20), triangles)
            mstore(add(data, 0x40), litPixels)
            mstore(add(data, 0x60), size)
            // the file stands where the bytes of `bmp` belong
            bmp := add(data, 0x60)
            return(data, add(0x80, and(add(size, 31), not(31))))
        }
    }

    /// @notice Draws a scene.
    /// @return A `data:` URI of the bitmap.
    function renderDataURI(Scene calldata scene) external view returns (string memory) {
        unchecked {
            File memory file = draw(scene, whole(scene), false);
            uint256 text = file.begin + file.size + 96;
            returnBytes(text, Svg.writeUri(text, file.begin, file.size) - text);
        }
    }

    /// @notice Draws a scene.
    /// @return An SVG document that shows the bitmap at any size without smoothing.
    function renderSVG(Scene calldata scene) external view returns (string memory) {
        unchecked {
            File memory file = draw(scene, whole(scene), false);
            uint256 text = file.begin + file.size + 96;
            returnBytes(text, Svg.write(text, file.begin, file.size, scene.canvas.width, scene.canvas.height) - text);
        }
    }

    /// @notice The rotation about the x axis, then y, then z, by angles in degrees (Q32), for an object of a scene.
    function eulerRotation(Fixed x, Fixed y, Fixed z) external pure returns (Quaternion memory) {
        return fromEuler(x, y, z);
    }

    function whole(Scene calldata scene) private pure returns (Rectangle memory) {
        return Rectangle(0, 0, scene.canvas.width, scene.canvas.height);
    }

    function draw(Scene calldata scene, Rectangle memory tile, bool countPixels) private view returns (File memory file) {
        unchecked {
            checkScene(scene, tile);
            uint256 pixels = callEngine(scene, tile, countPixels);
            assembly ("memory-safe") {
                mstore(add(file, 0x40), mload(sub(pixels, 0x40)))
                mstore(add(file, 0x60), mload(sub(pixels, 0x20)))
            }
            file.begin = pixels - Bmp.HEADER;
            file.size = Bmp.finish(pixels, tile.width, tile.height);
            uint256 end = file.begin + file.size;
            assembly ("memory-safe") {
                mstore(end, 0)
            }
        }
    }

    /// @dev Hands the scene on as it is: the call is made by hand because the compiler would take it apart and put it together again.
    /// @return pixels Their address. The rest of memory is free.
    function callEngine(Scene calldata scene, Rectangle memory tile, bool countPixels) private view returns (uint256 pixels) {
        address target = address(engine);
        bytes4 selector = Engine.drawTile.selector;
        bytes4 outOfGas = OutOfGas.selector;
        assembly ("memory-safe") {
            // behind the texts that encoders will allocate
            let data := add(mload(0x40), 0x400)
            mstore(data, selector)
            // offset of the scene, four words of the tile, one of the flag
            mstore(add(data, 0x04), 0xc0)
            mcopy(add(data, 0x24), tile, 0x80)
            mstore(add(data, 0xa4), countPixels)
            let size := sub(calldatasize(), scene)
            calldatacopy(add(data, 0xc4), scene, size)
            if iszero(staticcall(gas(), target, data, add(size, 0xc4), 0, 0)) {
                if iszero(returndatasize()) {
                    mstore(0, outOfGas)
                    revert(0, 4)
                }
                returndatacopy(data, 0, returndatasize())
                revert(data, returndatasize())
            }
            // room for the head of the answer and the header of the file
            pixels := add(data, 0x100)
            returndatacopy(sub(pixels, 0x40), 0, returndatasize())
        }
    }

    /// @dev Ends the call with bytes from where they are; up to 32 bytes behind them are cleared.
    function returnBytes(uint256 begin, uint256 size) private pure {
        assembly ("memory-safe") {
            let data := sub(begin, 0x40)
            mstore(data, 0x20)
            mstore(add(data, 0x20), size)
            mstore(add(begin, size), 0)
            return(data, add(0x40, and(add(size, 31), not(31))))
        }
    }
}
