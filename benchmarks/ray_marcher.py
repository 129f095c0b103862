"""Compare the renderer with a ray marcher on chain that draws the same picture.

    python -m benchmarks.ray_marcher

compiles RayMarcher.sol, which sphere-traces the exact shape, draws a sphere and a torus with it and with the Renderer,
which draws meshes of them, and rewrites ray_marcher.json and its table in benchmarks/README.md. Needs `npm ci` in
contracts/.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from tools.build_contracts import compile_once, request, settings

from shackled import Background, Camera, Light, Material, Object, Scene, render
from shackled.bench._report import table
from shackled.datasets.common import shapes
from shackled.errors import RenderError
from shackled.ethereum._abi import Interface
from shackled.evm._instance import Instance, Status
from shackled.scene._arithmetic import from_euler, rotate
from shackled.scene._mesh import Mesh
from shackled.scene._staging import painted

from . import flip, publish, read_figures, run_main

CONTRACT = Path(__file__).with_name("RayMarcher.sol")
FILE = Path(__file__).with_name("ray_marcher.json")
recorded = partial(read_figures, FILE)
#: 1 in the numbers of the contract.
ONE = 1 << 24
SIDES = (64, 128)
HALF_HEIGHT = 1.15
AMBIENT, DIFFUSE = 0.25, 0.75
COLOR, SKY = (230, 150, 90), (20, 24, 40)
LIGHT = np.array([1.0, 2.0, 3.0])
ANGLES = (50, 20, 0)
ADDRESS = b"ray marcher".rjust(20, b"\0")
GAS = 1 << 40

Pixels = NDArray[np.uint8]


@dataclass(frozen=True)
class Shape:
    """A shape for both: radii of ring and tube, zeros for a ball of radius 1, and a mesh of it."""

    torus: tuple[float, float]
    mesh: Mesh


def all_shapes() -> dict[str, Shape]:
    """Return the shapes by name."""
    return {
        "sphere": Shape((0, 0), shapes.icosphere(3)),
        "torus": Shape((0.72, 0.28), shapes.torus(0.72, 0.28, 48, 24)),
    }


def scene(shape: Shape, side: int) -> Scene:
    """Return the scene that the Renderer draws."""
    mesh = painted(shape.mesh, COLOR)
    thing = Object(mesh, rotation=from_euler(ANGLES), material=Material("smooth", AMBIENT, DIFFUSE, 0))
    camera = Camera((0, 0, 3), projection="orthographic", half_height=HALF_HEIGHT)
    return Scene([thing], camera, [Light("directional", LIGHT)], Background(SKY), width=side, height=side)


def numbers(shape: Shape, side: int) -> tuple[Any, ...]:
    """Return the struct of the ray marcher for the same picture, in the frame of the shape."""
    # the axes of the shape in the world; each column is an axis of the world in the frame of the shape
    axes = rotate(from_euler(ANGLES), np.eye(3))
    right, up, back = axes.T
    light = axes @ (LIGHT / np.linalg.norm(LIGHT))

    def fixed(values: Any) -> list[int]:
        return [round(float(value) * ONE) for value in np.ravel(values)]

    return (
        side,
        *fixed(HALF_HEIGHT),
        fixed(shape.torus),
        *(fixed(vector) for vector in (light, right, up, back)),
        *fixed([AMBIENT, DIFFUSE]),
        COLOR,
        SKY,
    )


def compiled() -> tuple[bytes, Interface]:
    """Return the runtime code of the ray marcher, and its interface."""
    asked = request(
        {CONTRACT.name: CONTRACT.read_text("utf-8")},
        settings(1_000_000, inline=True),
        {"*": {"*": ["abi", "evm.deployedBytecode.object"]}},
    )
    built = compile_once(asked)[CONTRACT.name]["RayMarcher"]
    return bytes.fromhex(built["evm"]["deployedBytecode"]["object"]), Interface(built["abi"])


def march(shape: Shape, side: int) -> tuple[int, Pixels]:
    """Return gas and picture of the ray marcher. RenderError if the call fails."""
    code, interface = compiled()
    evm = Instance()
    evm.put(ADDRESS, code)
    answer = evm.call(ADDRESS, interface.encode("render", numbers(shape, side)), GAS)
    if answer.status != Status.SUCCESS:
        raise RenderError(f"the ray marcher ended with {answer.status.name}")
    pixels = interface.decode("render", answer.output)
    return answer.gas, np.frombuffer(pixels, np.uint8).reshape(side, side, 3)


def measure(shape: Shape, side: int) -> dict[str, Any]:
    """Return the gas of both pictures, and how far they differ."""
    gas, marched = march(shape, side)
    drawn = render(scene(shape, side))
    return {
        "ray marcher": gas,
        "renderer": drawn.gas,
        "triangles": len(shape.mesh.faces),
        "pixels": side * side,
        "lit pixels": int((marched != SKY).any(axis=2).sum()),
        "FLIP": round(flip(marched, drawn.pixels), 4),
        "mean error": round(float(np.abs(marched.astype(float) - drawn.pixels).mean()), 2),
    }


def text(figures: dict[str, Any]) -> str:
    """Return the figures as Markdown."""
    head = ["picture", "ray marcher, gas", "a pixel", "a lit pixel", "triangles", "Renderer, gas", "a pixel"]
    head += ["ratio", "FLIP", "mean error, levels"]
    lines = []
    for name, each in figures.items():
        marched, drawn = each["ray marcher"], each["renderer"]
        cells = [f"{marched:,}", f"{marched / each['pixels']:,.0f}", f"{marched / each['lit pixels']:,.0f}"]
        cells += [f"{each['triangles']:,}", f"{drawn:,}", f"{drawn / each['pixels']:,.0f}", f"{marched / drawn:.1f}"]
        lines.append([name, *cells, f"{each['FLIP']:.4f}", f"{each['mean error']:.2f}"])
    ratios = [each["ray marcher"] / each["renderer"] for each in figures.values()]
    times = f"{min(ratios):.1f} to {max(ratios):.1f} times"
    return f"The ray marcher takes {times} the gas of the Renderer.\n\n{table(head, lines)}"


def main() -> int:
    """Measure all pictures, and write the figures and the table."""
    figures = {
        f"{name}, {side} x {side}": measure(shape, side) for name, shape in all_shapes().items() for side in SIDES
    }
    return publish("ray_marcher", figures, text(figures))


if __name__ == "__main__":
    run_main(main)
