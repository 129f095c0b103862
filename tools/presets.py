"""Make contracts/src/building/Presets.sol: the table of src/shackled/scene/presets.toml, for contracts."""

from __future__ import annotations

from pathlib import Path

from shackled.base.checks import Color
from shackled.scene import PRESETS
from shackled.scene._codec import ONE
from shackled.scene._presets import Preset

FILE = Path(__file__).resolve().parent.parent / "contracts" / "src" / "building" / "Presets.sol"

HEAD = """// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

// Written by tools/presets.py from the table of src/shackled/scene/presets.toml.

import {Background, DIRECTIONAL, Light, Fixed, Vector} from "../scene/Scene.sol";
import {OWN_COLORS, Preset, StageMaker} from "./StageMaker.sol";

/// @title Presets: looks for `stage.preset`, the same as in Python and on the command line.
library Presets {
"""
TAIL = """    /// @dev Returns a light in a direction, Q32: to the right, up, and toward the camera.
    function light(int256 right, int256 up, int256 toward, uint256 color) private pure returns (Light memory) {
        return Light(DIRECTIONAL, Vector(Fixed.wrap(right), Fixed.wrap(up), Fixed.wrap(toward)), color);
    }
}
"""


def function(preset: Preset) -> str:
    """Return the source of the function of a preset."""
    material = preset.material
    shares = [str(round(100 * each)) for each in (material.ambient, material.diffuse, material.specular)]
    numbers = "" if material.shading == "unlit" else ", ".join([*shares, str(material.shininess)])
    background = preset.background
    lines = [
        f"look.material = StageMaker.{material.shading}({numbers})",
        f"look.color = {'OWN_COLORS' if preset.color is None else hexadecimal(preset.color)}",
        f"look.background = Background({hexadecimal(background.top)}, {hexadecimal(background.bottom)})",
        f"look.ambientLight = {hexadecimal(preset.ambient_light)}",
        *(f"look.{name} = true" for name in ("wireframe", "invert") if getattr(preset, name)),
    ]
    lights = preset.lights(0)
    lines += [f"look.lights = new Light[]({len(lights)})"] if lights else []
    for number, light in enumerate(lights):
        x, y, z = (round(each * ONE) for each in light.vector.tolist())
        lines.append(f"look.lights[{number}] = light({x}, {y}, {z}, {hexadecimal(light.color)})")
    body = "".join(f"        {line};\n" for line in lines)
    head = f"    function {preset.name}() internal pure returns (Preset memory look) {{\n"
    return f"    /// @notice {preset.title}. {preset.help}\n{head}{body}    }}\n\n"


def hexadecimal(color: Color) -> str:
    """Return a colour as Solidity writes it."""
    return "0x{:02x}{:02x}{:02x}".format(*color)


def files() -> dict[Path, str]:
    """Return the text of the file, by its path."""
    return {FILE: HEAD + "".join(map(function, PRESETS)) + TAIL}
