"""A picture as a contract in Solidity, which holds the scene and calls the renderer with it."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Sequence
from string import Template
from typing import Any

import numpy as np

from ..image import Image
from ..scene import (
    CULL_BACKFACES,
    LIGHTS,
    ONE,
    PROJECTIONS,
    SHADINGS,
    TWO_SIDED,
    WIREFRAME,
    Scene,
    extensions,
    fit,
    pack,
)
from ._programs import Subject

#: Bytes of meshes and extensions that fit into a contract (EIP-170 allows 24,576 with its code), and overhead of each
#: object.
MAX_CONSTANT, PER_OBJECT = 18_000, 400
#: Hexadecimal digits of a string literal on one line.
DIGITS = 120

#: SPDX identifiers of permissive licences, by the names that sources of meshes use.
FREE = {"MIT": "MIT", "CC0": "CC0-1.0", "CC0-1.0": "CC0-1.0"}
#: Licence of the contract without the meshes.
OWN = "MIT"

_IMPORTED = (
    "Background",
    "Camera",
    "Canvas",
    "Fixed",
    "Light",
    "Material",
    "Object",
    "Quaternion",
    "IRenderer",
    "Scene",
)

_CONTRACT = Template("""\
// SPDX-License-Identifier: $licence
pragma solidity ^0.8.25;

import {IRenderer} from "shackled-contracts/interfaces/IRenderer.sol";
import {Fixed} from "shackled-contracts/math/Fixed.sol";
import {Quaternion} from "shackled-contracts/math/Quaternion.sol";
import {Vector} from "shackled-contracts/math/Vector.sol";
import {Background, Camera, Canvas, Light, Material, Object, Scene} from "shackled-contracts/scene/Scene.sol";

$about
contract $name {
    IRenderer public immutable renderer;

    constructor(IRenderer renderer_) {
        renderer = renderer_;
    }

    /// @notice An SVG that shows the picture at any size, for web pages. Marketplaces that resize pictures show it
    /// empty: for a token, let PngEncoder or Studio make a PNG of `scene`.
    function svg($parameters) external view returns (string memory) {
        return renderer.renderSVG(scene($arguments));
    }

    /// @notice A bitmap of 24 bits a pixel.
    function bitmap($parameters) external view returns (bytes memory) {
        return renderer.render(scene($arguments));
    }

    /// @notice Lengths are Q32 fixed-point numbers: value * 2^32.
    function scene($parameters) public pure returns (Scene memory s) {
$body
    }

    function fixed_(int256 raw) private pure returns (Fixed) {
        return Fixed.wrap(raw);
    }

    function vector(int256 x, int256 y, int256 z) private pure returns (Vector memory) {
        return Vector(Fixed.wrap(x), Fixed.wrap(y), Fixed.wrap(z));
    }
}
""")


def solidity_contract(subject: Subject, image: Image) -> str:
    """Return a source that compiles with the contracts of Shackled, imported as the package "shackled-contracts".

    Meshes and extensions that do not fit into a contract become parameters, as in the calldata. image: the picture.
    """
    fitted = fit(subject.scene)
    meshes = [pack(o.mesh, smooth=o.material.shading == "smooth") for o in fitted.objects]
    more = extensions(fitted)
    inside = sum(map(len, [*meshes, more])) + PER_OBJECT * len(meshes) <= MAX_CONSTANT
    given = {} if inside else {"meshes": "bytes[]"} | ({"extensions": "bytes"} if more else {})
    about = [
        f"@notice {image.width} x {image.height} pixels, {image.triangles:,} triangles, {image.gas or 0:,} gas.",
        f"SHA-256 of the pixels: {hashlib.sha256(image.pixels.tobytes()).hexdigest()}",
        *subject.comments,
    ]
    if not inside:
        about.append(
            f"@dev {' and '.join(given)} have {sum(map(len, [*meshes, more])):,} bytes, too many for a contract: the"
        )
        about.append("caller passes them. The SHA-256 of each:")
        about += [hashlib.sha256(each).hexdigest() for each in ([*meshes, more] if more else meshes)]
    return _CONTRACT.substitute(
        licence=spdx(subject.facts.licence) if inside else OWN,
        about="\n".join(f"/// {line}" for line in about),
        name=contract_name(subject.stem),
        parameters=", ".join(f"{kind} calldata {name}" for name, kind in given.items()),
        arguments=", ".join(given),
        body="\n".join(_indented(_body(fitted, meshes if inside else None, more, _notices(subject)), 8)),
    )


def spdx(licence: str) -> str:
    """Return the SPDX identifier of a licence as a source states it; UNLICENSED if it is unknown."""
    if licence in FREE:
        return FREE[licence]
    name = re.sub(r"[^0-9A-Za-z.]+", "-", licence)[:60].strip("-.")
    return f"LicenseRef-{name}" if name else "UNLICENSED"


def _notices(subject: Subject) -> list[str]:
    """Return the comments of a mesh: attribution and licence."""
    facts = subject.facts
    if not facts.licence:
        return [
            "The licence of this mesh is unknown: it is that of the uploaded file.",
            "Put its identifier into the first line, and do not publish the mesh without permission.",
        ]
    return [" ".join((facts.notice or f"The licence of this mesh: {facts.licence}").split())]


def contract_name(stem: str) -> str:
    """Return a name for Solidity: "icons-coin" becomes IconsCoin."""
    name = "".join(word[:1].upper() + word[1:] for word in stem.split("-"))
    return name if name[:1].isalpha() and name not in (*_IMPORTED, "Vector") else f"Picture{name}"


def _body(scene: Scene, meshes: Sequence[bytes] | None, more: bytes, notices: Sequence[str]) -> list[str]:
    """Return the lines that make a scene. meshes: None if they and the extensions, `more`, are parameters."""
    camera = scene.camera
    lines = [
        f"s.canvas = Canvas({scene.width}, {scene.height});",
        "s.camera = Camera({",
        f"    eye: {_vector(camera.eye)},",
        f"    target: {_vector(camera.target)},",
        f"    up: {_vector(camera.up)},",
        f"    projection: {PROJECTIONS[camera.projection]}, // {camera.projection}",
        f"    halfHeight: {_fixed(camera.half_height)},",
        f"    near: {_fixed(camera.near or 0.0)}",
        "});",
        f"s.background = Background({_color(scene.background.top)}, {_color(scene.background.bottom)});",
        *(["s.invert = 1;"] if scene.invert else []),
        f"s.ambientLight = {_color(scene.ambient_light)};",
        "",
        f"s.lights = new Light[]({len(scene.lights)});",
        *(
            f"s.lights[{i}] = Light({LIGHTS[w.kind]}, {_vector(w.vector)}, {_color(w.color)}); // {w.kind}"
            for i, w in enumerate(scene.lights)
        ),
        "",
        f"s.objects = new Object[]({len(scene.objects)});",
    ]
    for i, o in enumerate(scene.objects):
        material = o.material
        if meshes is None:
            mesh = [f"    mesh: meshes[{i}],"]
        else:
            mesh = [*(f"    // {line}" for line in notices), "    mesh: bytes.concat(", *_literal(meshes[i]), "    ),"]
        x, y, z, w = (_fixed(value) for value in o.rotation.tolist())
        lines += [
            f"s.objects[{i}] = Object({{",
            *mesh,
            f"    position: {_vector(o.position)},",
            f"    rotation: Quaternion({x}, {y}, {z}, {w}),",
            f"    scale: {_fixed(o.scale)},",
            "    material: Material({",
            f"        shading: {SHADINGS[material.shading]}, // {material.shading}",
            f"        ambient: {_fixed(material.ambient)},",
            f"        diffuse: {_fixed(material.diffuse)},",
            f"        specular: {_fixed(material.specular)},",
            f"        shininess: {material.shininess}",
            "    }),",
            f"    flags: {CULL_BACKFACES * o.cull + WIREFRAME * o.wireframe + TWO_SIDED * o.two_sided}",
            "});",
        ]
    if more:
        value = "extensions" if meshes is None else f'hex"{more.hex()}"'
        lines += ["", "// what the structs do not hold: see Extensions.sol", f"s.extensions = {value};"]
    return lines


def _literal(mesh: bytes) -> list[str]:
    """Return a long string literal; adjacent literals are concatenated by the compiler."""
    digits = mesh.hex()
    pieces = [f'        hex"{digits[at : at + DIGITS]}"' for at in range(0, len(digits), DIGITS)]
    return pieces


def _indented(lines: Iterable[str], by: int) -> list[str]:
    return [" " * by + line if line else "" for line in lines]


def _fixed(value: float) -> str:
    return f"fixed_({round(value * ONE)})"


def _vector(values: Any) -> str:
    return f"vector({', '.join(str(round(value * ONE)) for value in np.asarray(values, dtype=np.float64).tolist())})"


def _color(color: Any) -> str:
    red, green, blue = color
    return f"0x{red:02x}{green:02x}{blue:02x}"
