"""Draw pictures of the documentation, and write their gas to pictures.json: `make pictures`.

The contracts compute every pixel of the pictures. The strip has several pictures side by side; contact sheets have the
names of pieces below them.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Unpack

import numpy as np
from attrs import evolve
from examples import showcase
from numpy.typing import NDArray
from PIL import Image as PillowImage
from PIL import ImageDraw, ImageFont

from shackled import Background, Camera, Image, Light, Material, Object, Scene, load, render
from shackled.datasets import teapot
from shackled.datasets.common import builtin, shapes
from shackled.datasets.genesis import generate, picture_on_chain, seed_of
from shackled.datasets.icons import pieces as icons
from shackled.scene import PRESETS, stage
from shackled.scene._settings import LookOptions
from shackled.scene._staging import painted
from shackled.stages import draw_stages
from shackled.stages import strip as stages_strip
from shackled.studio import make_apng
from tools.pages import IMAGES, ROOT

EXAMPLES = ROOT / "examples"

CREAM = Background("#f3e9dc", "#c7b8a6")
NIGHT = Background("#10141f", "#2a3550")
KEY = Light("directional", (-0.2, 0.8, 0.9), "#fff6ea")
CLAY = "#c8553d"
UNLIT = Material("unlit")
GLAZED = Material("smooth", ambient=0.25, diffuse=0.85, specular=0.6, shininess=30)


def pot(divisions: int, size: int, material: Material, **look: Unpack[LookOptions]) -> Scene:
    """Return a scene of the teapot, its spout to the right."""
    posed: LookOptions = {"rotate": (0, 12, 0), "azimuth": 30, "elevation": 20, **look}
    return stage(teapot(divisions), size, material=material, **posed)


def smooth() -> Image:
    """Draw the picture of `make demo`."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, str(EXAMPLES / "meshes.py"), "--into", folder, "teapot"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return render(Path(folder, "teapot.obj"), rotate=(0, 12, 0), color=CLAY)


def still_life() -> Image:
    """Draw examples/scene.toml, larger."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, str(EXAMPLES / "meshes.py"), "--into", f"{folder}/meshes"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        scene = Path(folder, "scene.toml")
        scene.write_bytes((EXAMPLES / "scene.toml").read_bytes())
        return render(load(scene), size=(640, 480))


def smoothed() -> PillowImage.Image:
    """Draw a crown without and with anti-aliasing, each pixel enlarged to 4 x 4."""
    pair = [render("icons/crown", size=96, antialias=flag).pixels for flag in (False, True)]
    return PillowImage.fromarray(np.hstack(pair)).resize((8 * 96, 4 * 96), PillowImage.Resampling.NEAREST)


def transparent() -> tuple[PillowImage.Image, int | None]:
    """Draw a mushroom behind glass, with its background and over a checkerboard; also return the gas of the latter."""
    scene = load("icons/mushroom", 256, antialias=True)
    pane = load("cube", color="#d8f4ff").objects[0]
    glass = Material("flat", ambient=0.6, diffuse=0.4, specular=0.3, shininess=20)
    pane = evolve(
        pane, position=(0.5, -0.32, 0.9), scale=0.4, rotation=(0.1, -0.25, 0.08, 1), material=glass, opacity=0.45
    )
    scene = evolve(scene, objects=[*scene.objects, pane])
    whole, cut = render(scene), render(scene, transparent=True)
    checks = np.add(*np.indices((256, 256)) // 16) % 2 * 30 + 205
    board = PillowImage.fromarray(checks.astype(np.uint8)).convert("RGBA")
    board.alpha_composite(cut.to_pil())
    return PillowImage.fromarray(np.hstack([whole.pixels, np.asarray(board.convert("RGB"))])), cut.gas


def glass() -> list[Image]:
    """Draw a teapot in front of balls: opaque, with one opacity, and with opacities that increase toward its foot."""
    scene = pot(6, 192, GLAZED, color="#2f7fa8", lights=KEY, background=CREAM, antialias=True)
    (vessel,) = scene.objects
    balls = [
        Object(painted(shapes.icosphere(3), color), place, scale=size, material=GLAZED)
        for color, place, size in ((CLAY, (-0.3, -0.1, -0.7), 0.45), ("#e8b53a", (0.25, 0.0, -1.0), 0.36))
    ]
    heights = vessel.mesh.positions[:, 1]
    opacities = np.interp(heights, [heights.min(), heights.max()], [1.0, 0.1])
    vessels = [
        vessel,
        evolve(vessel, opacity=0.45),
        evolve(vessel, mesh=evolve(vessel.mesh, opacities=opacities)),
    ]
    return [render(evolve(scene, objects=[*balls, each])) for each in vessels]


def strip() -> list[Image]:
    """Draw the same teapot with six looks, 128 x 128 pixels each."""
    flat = evolve(GLAZED, shading="flat")
    dim = evolve(GLAZED, ambient=0.1, diffuse=0.75)
    lamps = [
        Light("point", (-3, 1.5, 1.5), "#ff5040"),
        Light("point", (2.5, 2.5, 2), "#40a0ff"),
        Light("point", (0, -2, 3), "#50ff70"),
    ]
    base = LookOptions(color="#3f8fb5", lights=KEY, background=NIGHT)
    looks: list[tuple[Material, LookOptions]] = [
        (UNLIT, {"wireframe": True, "cull": True, "color": "#7fd6c2"}),
        (UNLIT, {}),
        (flat, {}),
        (GLAZED, {}),
        (dim, {"color": "#d8d8d8", "lights": lamps}),
        (GLAZED, {"invert": True}),
    ]
    images = []
    for material, look in looks:
        whole: LookOptions = {**base, **look}
        images.append(render(pot(4, 128, material, **whole)))
    return images


def presets() -> tuple[PillowImage.Image, list[int | None]]:
    """Draw the same teapot with all presets, in two rows; return the gas of each, too."""
    images = [render(pot(4, 160, GLAZED, preset=each.name, antialias=True)) for each in PRESETS]
    half = (len(images) + 1) // 2
    rows = [np.hstack([image.pixels for image in part]) for part in (images[:half], images[half:])]
    return PillowImage.fromarray(np.vstack(rows)), [image.gas for image in images]


def effects() -> dict[str, list[Image]]:
    """Draw the rows of docs/light.md, 192 x 192 pixels each, the first without the effect."""
    chalk = Material("smooth", ambient=0.6, diffuse=0.5, specular=0.1, shininess=20)
    pale = pot(6, 192, chalk, color="#f0ece4", lights=KEY, ambient_light="#a0a0a0", background="#c4d8ec")
    dark = pot(6, 192, evolve(GLAZED, ambient=0.12), color=CLAY, lights=KEY, background=NIGHT)
    spheres = [Object(shapes.icosphere(3), (-1.5 + 1.25 * k, 0, 2 - 2.5 * k), material=GLAZED) for k in range(6)]
    row = Scene(
        [evolve(each, mesh=painted(each.mesh, CLAY)) for each in spheres],
        Camera.perspective((0, 2.2, 9.0), (0.1, -0.1, 0), fov=42),
        KEY,
        "#dfe6ea",
        width=192,
        height=192,
    )
    lamps = [
        Light.directional(toward=(-1, 0.3, 0.5), color="#ff5a3c"),
        Light.directional(toward=(1, 0.3, 0.5), color="#3c7bff"),
    ]
    lit = pot(
        6,
        192,
        evolve(GLAZED, ambient=0.05, diffuse=0.7),
        color="#d8d0c8",
        lights=[evolve(KEY, color="#ffd9a8"), *lamps],
        background=NIGHT,
    )
    solids = [
        (shapes.torus(), (196, 86, 60), -1.3, 0.1, 0.9),
        (shapes.icosphere(2), (236, 184, 60), 0.5, -0.7, 0.8),
        (shapes.cube(), (70, 120, 190), 0.6, 1.3, 0.55),
    ]
    table = Scene(
        [
            Object(painted(mesh, color), (x, -scale * float(mesh.positions[:, 1].min()), z), scale=scale)
            for mesh, color, x, z, scale in solids
        ],
        Camera.perspective((0, 3.6, 7.0), (0.1, 0.3, 0.2), fov=36),
        Light.directional(toward=(-1, 1.1, 0.35)),
        "#e9e4da",
        width=192,
        height=192,
    )
    grounded: LookOptions = {"ground": "#cfc6b4"}
    looks: dict[str, tuple[Scene, list[LookOptions]]] = {
        "shadow": (table, [grounded, {**grounded, "shadow": True}]),
        "hemisphere": (pale, [{}, {"ambient_light": "#181818", "hemisphere": ("#a8ccff", "#c07838")}]),
        "rim": (dark, [{}, {"rim": ("#7ab8ff", 2)}, {"rim": ("#7ab8ff", 5)}]),
        "fog": (row, [{}, {"fog": "#dfe6ea"}, {"fog": ("#dfe6ea", 8, 14)}]),
        "tone": (lit, [{}, {"filmic": True}, {"gamma": True}, {"gamma": True, "filmic": True}]),
    }
    rendered: dict[str, list[Image]] = {}
    for name, (scene, rows) in looks.items():
        smoothed: list[LookOptions] = [{"antialias": True, **look} for look in rows]
        rendered[name] = [render(scene, **look) for look in smoothed]
    return rendered


def contact_sheet(pictures: Sequence[NDArray[np.uint8]], names: Iterable[str], columns: int) -> PillowImage.Image:
    """Return pictures of the same size in rows, with their names below."""
    (height, width), label = pictures[0].shape[:2], 22
    sheet = PillowImage.new("RGB", (columns * width, -(-len(pictures) // columns) * (height + label)), "#14161c")
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(13)
    for number, (pixels, name) in enumerate(zip(pictures, names, strict=True)):
        x, y = number % columns * width, number // columns * (height + label)
        sheet.paste(PillowImage.fromarray(pixels), (x, y))
        pen.text((x + width // 2, y + height + label // 2), name.split("/")[-1], "#c8ccd4", font, anchor="mm")
    return sheet


def genesis() -> tuple[PillowImage.Image, list[int]]:
    """Draw the first 24 pieces of the collection, each with one call from its seed; also return the gas of each."""
    images = [picture_on_chain(generate(seed_of(number))) for number in range(24)]
    rows = [np.hstack([image.pixels for image in images[start : start + 8]]) for start in (0, 8, 16)]
    return PillowImage.fromarray(np.vstack(rows)), [image.gas or 0 for image in images]


def main() -> None:
    """Draw all pictures, and write pictures.json."""
    IMAGES.mkdir(exist_ok=True)
    figures: dict[str, Any] = {}
    for name, draw in {"teapot": smooth, "scene": still_life}.items():
        image = draw()
        # in the site, pictures with a scene can be turned
        image.save(IMAGES / f"{name}.png", scene=True)
        figures[name] = {key: getattr(image, key) for key in ("width", "height", "triangles", "gas")}
    stages_strip(draw_stages(load("teapot", 256, antialias=False))).save(IMAGES / "stages.png", optimize=True)
    smoothed().save(IMAGES / "antialiasing.png", optimize=True)
    both, gas = transparent()
    both.save(IMAGES / "transparent.png", optimize=True)
    figures["transparent"] = {"gas": gas}
    in_rows, each_gas = presets()
    in_rows.save(IMAGES / "presets.png", optimize=True)
    figures["presets"] = {"gas": each_gas}
    film = make_apng(load("icons/rocket", 64, antialias=False), frames=12, duration=100, scale=4)
    film.save(IMAGES / "motion.png")
    figures["motion"] = {"frames": 12, "gas": film.gas}
    for name, row in effects().items():
        PillowImage.fromarray(np.hstack([each.pixels for each in row])).save(IMAGES / f"{name}.png", optimize=True)
        figures[name] = {"gas": [each.gas for each in row]}
    with tempfile.TemporaryDirectory() as folder:
        figures["showcase"] = {name: showcase.draw(name, Path(folder)) for name in showcase.SCENES}
        drawn = [PillowImage.open(Path(folder, f"{name}.png")).convert("RGB") for name in showcase.SCENES]
    sheet = contact_sheet([np.asarray(each) for each in drawn], showcase.SCENES, 4)
    sheet.save(IMAGES / "showcase.png", optimize=True)
    for name, images in {"strip": strip(), "glass": glass()}.items():
        PillowImage.fromarray(np.hstack([image.pixels for image in images])).save(IMAGES / f"{name}.png", optimize=True)
        figures[name] = {"gas": [image.gas for image in images]}
    for name, pieces, columns in (("icons", list(icons()), 7), ("common", builtin.pieces(), 8)):
        images = [render(piece.make(), size=128) for piece in pieces]
        sheet = contact_sheet([image.pixels for image in images], (piece.name for piece in pieces), columns)
        sheet.save(IMAGES / f"{name}.png", optimize=True)
        figures[name] = {"gas": [image.gas for image in images]}
    sheet, costs = genesis()
    sheet.save(IMAGES / "genesis.png", optimize=True)
    figures["genesis"] = {"gas": costs}
    print(json.dumps(figures, indent=1))
    (IMAGES / "pictures.json").write_text(json.dumps(figures, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
