// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

// Everything that a contract needs to build a scene, in one import: meshes, shapes, lettering, framing, stages and presets.

import {Lettering} from "./Lettering.sol";
import {Model, ModelMaker} from "./ModelMaker.sol";
import {Shapes} from "./Shapes.sol";
import {Box, Framing} from "./Framing.sol";
import {Preset, Stage, StageMaker} from "./StageMaker.sol";
import {Presets} from "./Presets.sol";
