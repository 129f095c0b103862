// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {fromEuler} from "./math/Euler.sol";
import {Scene, Rectangle, Fixed, Quaternion} from "./scene/Scene.sol";
import {BAND_PIXELS, Pipeline} from "./pipeline/Pipeline.sol";
import {checkScene} from "./scene/Checks.sol";
import {IRenderer} from "./interfaces/IRenderer.sol";
import {Bmp} from "./encode/Bmp.sol";
import {Svg} from "./encode/Svg.sol";
import {AntialiasedEngine} from "./engines/AntialiasedEngine.sol";
import {AntialiasedFragmentEngine} from "./engines/AntialiasedFragmentEngine.sol";
import {AntialiasedSmoothEngine} from "./engines/AntialiasedSmoothEngine.sol";
import {Effects} from "./effects/Effects.sol";
import {EffectsEngine} from "./engines/EffectsEngine.sol";
import {Engine} from "./engines/Engine.sol";
import {FragmentEngine} from "./engines/FragmentEngine.sol";
import {Extensions} from "./scene/Extensions.sol";
import {ANTIALIAS} from "./words/Records.sol";
import {BY_FACES, BY_QUADRATIC, Run, Runs} from "./uniforms/Runs.sol";
import {Uniforms} from "./uniforms/Uniforms.sol";
import "./words/Registers.sol";

/// @title Renderer: draws 3D scenes.
/// @notice Stateless. `SceneErrors.sol` declares the errors of invalid scenes.
contract Renderer is IRenderer {
    address public immutable engine;
    address public immutable fragmentEngine;
    address public immutable antialiasedEngine;
    address public immutable antialiasedFragmentEngine;
    address public immutable antialiasedSmoothEngine;
    address public immutable effectsEngine;
    address public immutable effects;

    /// @dev A bitmap in memory. It is preceded by 128 free bytes and followed by a zero word.
    struct File {
        uint256 begin;
        uint256 size;
        uint256 triangles;
        uint256 litPixels;
    }

    /// @dev The offset of the engine's answer from the beginning of the call: room for the file header.
    uint256 private constant ANSWER = 0xc0;
    /// @dev Memory before the pixels for the text that encoders allocate.
    uint256 private constant TEXTS = 0x400;

    constructor(
        Engine engine_,
        FragmentEngine fragmentEngine_,
        AntialiasedEngine antialiasedEngine_,
        AntialiasedFragmentEngine antialiasedFragmentEngine_,
        AntialiasedSmoothEngine antialiasedSmoothEngine_,
        EffectsEngine effectsEngine_,
        Effects effects_
    ) {
        engine = withCode(address(engine_));
        fragmentEngine = withCode(address(fragmentEngine_));
        antialiasedEngine = withCode(address(antialiasedEngine_));
        antialiasedFragmentEngine = withCode(address(antialiasedFragmentEngine_));
        antialiasedSmoothEngine = withCode(address(antialiasedSmoothEngine_));
        effectsEngine = withCode(address(effectsEngine_));
        effects = withCode(address(effects_));
    }

    function withCode(address engine_) private view returns (address) {
        if (engine_.code.length == 0) revert NoEngine(engine_);
        return engine_;
    }

    function render(Scene calldata scene) external view returns (bytes memory) {
        File memory file = draw(scene, whole(scene));
        returnBytes(file.begin, file.size);
    }

    function renderTile(Scene calldata scene, Rectangle calldata tile) external view returns (bytes memory) {
        File memory file = draw(scene, tile);
        returnBytes(file.begin, file.size);
    }

    function renderCounted(Scene calldata scene) external view returns (bytes memory bmp, uint256 triangles, uint256 litPixels) {
        return counted(scene, whole(scene));
    }

    function renderTileCounted(Scene calldata scene, Rectangle calldata tile)
        external view returns (bytes memory bmp, uint256 triangles, uint256 litPixels)
    {
        return counted(scene, tile);
    }

    function renderDataURI(Scene calldata scene) external view returns (string memory) {
        unchecked {
            File memory file = draw(scene, whole(scene));
            uint256 text = file.begin + file.size + 96;
            returnBytes(text, Svg.writeUri(text, file.begin, file.size) - text);
        }
    }

    function renderSVG(Scene calldata scene) external view returns (string memory) {
        unchecked {
            File memory file = draw(scene, whole(scene));
            uint256 text = file.begin + file.size + 96;
            returnBytes(text, Svg.write(text, file.begin, file.size, scene.canvas.width, scene.canvas.height) - text);
        }
    }

    function eulerRotation(Fixed x, Fixed y, Fixed z) external pure returns (Quaternion memory) {
        return fromEuler(x, y, z);
    }

    function engineCall(Scene calldata scene, Rectangle calldata tile) external view returns (bytes memory) {
        unchecked {
            checkScene(scene, tile);
            prepareEffects(scene);
            (uint256 begin, uint256 end) = writeCall(scene, tile);
            returnBytes(begin, end - begin);
        }
    }

    function whole(Scene calldata scene) private pure returns (Rectangle memory) {
        return Rectangle(0, 0, scene.canvas.width, scene.canvas.height);
    }

    /// @dev Ends the call with the counted picture.
    function counted(Scene calldata scene, Rectangle memory tile)
        private view returns (bytes memory bmp, uint256 triangles, uint256 litPixels)
    {
        store(COUNT_PIXELS, 1);
        File memory file = draw(scene, tile);
        (triangles, litPixels) = (file.triangles, file.litPixels);
        assembly ("memory-safe") {
            let size := mload(add(file, 0x20))
            let data := sub(mload(file), 0x80)
            mstore(data, 0x60)
            mstore(add(data, 0x20), triangles)
            mstore(add(data, 0x40), litPixels)
            mstore(add(data, 0x60), size)
            // place the file at the bytes of `bmp`
            bmp := add(data, 0x60)
            return(data, add(0x80, and(add(size, 31), not(31))))
        }
    }

    function draw(Scene calldata scene, Rectangle memory tile) private view returns (File memory file) {
        unchecked {
            checkScene(scene, tile);
            prepareEffects(scene);
            (uint256 data, uint256 end) = writeCall(scene, tile);
            uint256 pixels;
            uint256 free = freeMemory();
            bool isOneRun = Runs.next(data, Runs.begin(data)).count == 0;
            setFreeMemory(free);
            if (tile.width * tile.height > BAND_PIXELS && !isOneRun) {
                (pixels, file.triangles, file.litPixels) = drawBands(scene, tile);
            } else {
                (pixels, file.triangles, file.litPixels) = callEngines(data, end);
            }
            file.begin = pixels - Bmp.HEADER;
            file.size = Bmp.finish(pixels, tile.width, tile.height);
            end = file.begin + file.size;
            assembly ("memory-safe") {
                mstore(end, 0)
            }
        }
    }

    /// @dev Calls Effects if the scene has effects. The answer stays in memory, at EFFECTS_AT.
    function prepareEffects(Scene calldata scene) private view {
        unchecked {
            (uint256 record, uint256 end) = Extensions.behind(scene, ANTIALIAS);
            if (record == end) return;
            reserveRegisters(REGISTERS, REGISTERS_END);
            uint256 data = freeMemory();
            bytes4 selector = Effects.prepare.selector;
            assembly ("memory-safe") {
                let size := sub(calldatasize(), scene)
                mstore(data, selector)
                mstore(add(data, 4), 0x20)
                calldatacopy(add(data, 36), scene, size)
                end := add(add(data, 36), size)
            }
            uint256 answered = callEngine(address(effects), data, end, data);
            store(EFFECTS_AT, data);
            store(EFFECTS_SIZE, answered);
            setFreeMemory(data + answered);
        }
    }

    /// @dev Writes the calldata of an engine: see Uniforms.
    function writeCall(Scene calldata scene, Rectangle memory tile) private pure returns (uint256 data, uint256 end) {
        unchecked {
            (data, end) = Uniforms.write(Pipeline.drawTile.selector, scene, tile, TEXTS);
            uint256 size = load(EFFECTS_SIZE);
            if (size == 0) return (data, end);
            store(data + 4 + EFFECTS_OFFSET - REGISTERS, end - data);
            uint256 source = load(EFFECTS_AT);
            assembly ("memory-safe") {
                mcopy(end, source, size)
                end := add(end, size)
            }
        }
    }

    /// @dev Draws a large picture that needs several engines, band by band, since the pixels and depths drawn by one engine are passed to
    /// the next.
    function drawBands(Scene calldata scene, Rectangle memory tile)
        private view returns (uint256 pixels, uint256 triangles, uint256 litPixels)
    {
        unchecked {
            uint256 rows = BAND_PIXELS / tile.width;
            uint256 free = freeMemory();
            pixels = free + TEXTS + 0x100;
            uint256 target = pixels;
            // the buffer of the bands follows the file, including its padding
            uint256 behind = (pixels + 3 * tile.width * tile.height + 4 * tile.height + 0x3f) & ~uint256(31);
            for (uint256 bottom = tile.height; bottom != 0;) {
                setFreeMemory(behind);
                uint256 top = bottom < rows ? 0 : bottom - rows;
                Rectangle memory band = Rectangle(tile.x, tile.y + top, tile.width, bottom - top);
                (uint256 data, uint256 end) = writeCall(scene, band);
                (uint256 source,, uint256 lit) = callEngines(data, end);
                litPixels += lit;
                uint256 size = 3 * tile.width * (bottom - top);
                assembly ("memory-safe") {
                    mcopy(target, source, size)
                    target := add(target, size)
                }
                bottom = top;
            }
            if (load(COUNT_PIXELS) != 0) triangles = countTriangles(scene, tile);
            setFreeMemory(free);
        }
    }

    /// @dev Calls the engines one after the other, each for a run of objects.
    /// @param data The beginning of the calldata; `end` is its end. The memory behind is free.
    /// @return pixels The address of the pixels. The memory behind them is free.
    /// @return triangles The number of triangles left after culling and clipping.
    /// @return litPixels The number of pixels they cover, if counted.
    function callEngines(uint256 data, uint256 end) private view returns (uint256 pixels, uint256 triangles, uint256 litPixels) {
        unchecked {
            // allocations here and in each iteration are freed: the calldata follows them
            uint256 free = freeMemory();
            Run memory run = Runs.begin(data);
            uint256 kept = freeMemory();
            uint256 size = end;
            while (true) {
                Run memory next = Runs.next(data, run);
                Runs.set(data, run, next.count == 0);
                if (next.count == 0) break;
                uint256 answered = callEngine(engineOf(run), data, size, end);
                triangles += load(end);
                // skip the two words before the pixels
                Runs.setDrawn(data, end + 0x40);
                size = end + answered;
                (run.turn, run.first, run.count, run.position, run.end) = (next.turn, next.first, next.count, next.position, next.end);
                setFreeMemory(kept);
            }
            callEngine(engineOf(run), data, size, data + ANSWER);
            setFreeMemory(free);
            pixels = data + ANSWER + 0x40;
            triangles += load(data + ANSWER);
            litPixels = load(data + ANSWER + 0x20);
        }
    }

    /// @dev Returns the number of triangles of all objects left after culling and clipping.
    function countTriangles(Scene calldata scene, Rectangle memory tile) private view returns (uint256) {
        (uint256 data, uint256 end) = Uniforms.write(Pipeline.drawTile.selector, scene, tile, TEXTS);
        Runs.setOnlyCounts(data);
        callEngine(address(engine), data, end, data);
        return load(data);
    }

    function engineOf(Run memory run) private view returns (address) {
        if (load(EFFECTS_SIZE) != 0) return address(effectsEngine);
        if (run.turn == BY_QUADRATIC) return address(antialiasedSmoothEngine);
        if (load(FRAME_IS_ANTIALIASED) == 0) return run.turn == BY_FACES ? address(engine) : address(fragmentEngine);
        return run.turn == BY_FACES ? address(antialiasedEngine) : address(antialiasedFragmentEngine);
    }

    /// @param answer The address for the answer.
    /// @return size The size of the answer in bytes.
    function callEngine(address target, uint256 data, uint256 end, uint256 answer) private view returns (uint256 size) {
        bytes4 outOfGas = OutOfGas.selector;
        assembly ("memory-safe") {
            if iszero(staticcall(gas(), target, data, sub(end, data), 0, 0)) {
                if iszero(returndatasize()) {
                    mstore(0, outOfGas)
                    revert(0, 4)
                }
                returndatacopy(data, 0, returndatasize())
                revert(data, returndatasize())
            }
            size := returndatasize()
            returndatacopy(answer, 0, size)
        }
    }

    /// @dev Returns bytes from their place in memory and ends the call. Clears up to 32 bytes behind them.
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
