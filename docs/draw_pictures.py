"""Draws the pictures of the documentation, and notes what they cost: `make pictures`.

Every pixel is one that the contracts made; the strip puts several pictures side by side.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image as PillowImage

from shackled import Background, Image, Light, Material, Scene, load, render
from shackled.datasets.teapot import teapot
from shackled.scene.rotation import from_euler
from shackled.scene.staging import Look, stage

HERE = Path(__file__).resolve().parent
IMAGES = HERE / "images"
EXAMPLES = HERE.parent / "examples"

CREAM = Background("#f3e9dc", "#c7b8a6")
NIGHT = Background("#10141f", "#2a3550")
KEY = Light("directional", (-0.2, 0.8, 0.9), "#fff6ea")
CLAY = "#c8553d"
GLAZED = Material("smooth", ambient=0.25, diffuse=0.85, specular=0.6, shininess=30)


def pot(divisions: int, look: Look) -> Scene:
    """The teapot, its spout to the right."""
    return stage(teapot(divisions), replace(look, rotation=from_euler((0, 12, 0)), azimuth=30, elevation=20))


def smooth() -> Image:
    """What `make demo` draws."""
    return render(pot(8, Look(256, 256, color=CLAY, material=GLAZED, lights=[KEY], background=CREAM)))


def wireframe() -> Image:
    """Its edges."""
    unlit = Material("unlit")
    return render(pot(4, Look(256, 256, color="#ffb35c", material=unlit, background=NIGHT, wireframe=True, cull=True)))


def still_life() -> Image:
    """examples/scene.toml, larger."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, str(EXAMPLES / "meshes.py"), "--into", f"{folder}/meshes"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        scene = Path(folder, "scene.toml")
        scene.write_bytes((EXAMPLES / "scene.toml").read_bytes())
        return render(load(scene), size=(640, 480))


def strip() -> list[Image]:
    """The same teapot in six ways, 128 x 128 pixels each."""
    base = Look(128, 128, color="#3f8fb5", lights=[KEY], background=NIGHT)
    flat = replace(GLAZED, shading="flat")
    dim = replace(GLAZED, ambient=0.1, diffuse=0.75)
    lamps = [
        Light("point", (-3, 1.5, 1.5), "#ff5040"),
        Light("point", (2.5, 2.5, 2), "#40a0ff"),
        Light("point", (0, -2, 3), "#50ff70"),
    ]
    looks = [
        replace(base, wireframe=True, cull=True, color="#7fd6c2", material=Material("unlit")),
        replace(base, material=Material("unlit")),
        replace(base, material=flat),
        replace(base, material=GLAZED),
        replace(base, material=dim, color="#d8d8d8", lights=lamps),
        replace(base, material=GLAZED, invert=True),
    ]
    return [render(pot(4, look)) for look in looks]


def main() -> None:
    """The command."""
    IMAGES.mkdir(exist_ok=True)
    figures: dict[str, Any] = {}
    for name, draw in {"teapot": smooth, "wireframe": wireframe, "scene": still_life}.items():
        image = draw()
        image.save(IMAGES / f"{name}.png")
        figures[name] = {key: getattr(image, key) for key in ("width", "height", "triangles", "gas")}
    images = strip()
    PillowImage.fromarray(np.hstack([image.pixels for image in images])).save(IMAGES / "strip.png", optimize=True)
    figures["strip"] = {"gas": [image.gas for image in images]}
    print(json.dumps(figures, indent=1))
    (IMAGES / "pictures.json").write_text(json.dumps(figures, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
