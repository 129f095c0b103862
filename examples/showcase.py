"""Draw the showcase: twelve scenes that show the options of the renderer.

python examples/showcase.py                     all of them, in build/showcase
python examples/showcase.py --into DIR glass    one of them, into another folder

Lengths are about those of the still life, whose teapot is 3 high and stands on y = 0.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shackled import Camera, Light, Material, Mesh, Object, Scene, Texture, Tone, load, render, replace, turntable
from shackled.datasets import teapot
from shackled.datasets.common import shapes
from shackled.scene import stage, view_axes

Array = NDArray[np.float64]

#: Where the pictures go, and the size of each.
FOLDER, SIZE = Path("build", "showcase"), (320, 240)
UNLIT = Material("unlit")


def still_life() -> Scene:
    """Return the still life of examples/scene.toml in the light of a sun, with shadows."""
    glaze = Material("smooth", ambient=0.25, diffuse=0.85, specular=0.7, shininess=48)
    polished = Material("smooth", ambient=0.25, diffuse=0.8, specular=0.9, shininess=80)
    soft = Material("smooth", ambient=0.3, diffuse=0.8, specular=0.6, shininess=40)
    # a goblet, 2.6 high, open at the top
    height = np.linspace(1, 0, 21)
    radius = 0.42 + 0.42 * np.sin(2.6 * np.pi * height**0.8 + 0.4) * (1 - 0.55 * height)
    goblet = lathe(np.append(radius, 0), np.append(2.6 * height, 0), 24)
    return scene(
        [
            put(teapot(5), glaze, "#c8553d", (-0.9, 0, -0.6), (0, -20, 0), cull=False),
            put(goblet, soft, "#3f7f86", (3.6, 0, -1.6), scale=1.25, cull=False),
            put(shapes.sphere(28, 14), polished, "#e0b040", (2.2, 0.75, 1.7), scale=0.75),
            put(shapes.torus(1.0, 0.32, 36, 12), soft, "#5b6bb0", (-2.5, 0.32, 2.6)),
            put(shapes.icosphere(2), UNLIT, "#f4f6ff", (0.2, 0.9, 3.4), scale=0.9, wireframe=True),
            chessboard(),
        ],
        Camera.perspective((0.8, 4.6, 11.5), (0.25, 1.15, 0), fov=38),
        [
            Light.directional(toward=(-8, 6.5, 3.2), color="#fff1dc", shadow=True),
            Light.directional(toward=(0.9, 0.5, 0.4), color="#3c4866"),
        ],
        ("#27314a", "#c9a68a"),
        ambient_light="#c8d4ff",
    )


def chessboard(side: int = 12) -> Object:
    """Return squares of side 1, at y = 0, about the origin: one square with a texture."""
    row, column = np.indices((side, side))
    pixels = np.where(((row + column) % 2 == 0)[..., None], (214, 205, 190), (92, 84, 84))
    material = Material("flat", 0.25, 0.8, 0.15, 20, Texture(pixels, "nearest", "clamp"))
    line = np.array([-side / 2, side / 2])
    mesh = replace(terrain(line, line, 0.0), colors="white", uvs=[(0, 0), (1, 0), (0, 1), (1, 1)])
    return Object(mesh, material=material)


def glass() -> Scene:
    """Return bottles, a tumbler and marbles of glass before solid things, which shine through."""
    clear = Material("smooth", ambient=0.55, diffuse=0.6, specular=1.6, shininess=70)
    dull = Material("smooth", ambient=0.35, diffuse=0.75, specular=0.3, shininess=24)
    glossy = Material("smooth", ambient=0.35, diffuse=0.7, specular=1.0, shininess=60)
    bottle = lathe(
        [0, 0.26, 0.31, 0.31, 0.26, 0.27, 0.32, 0.62, 0.73, 0.74, 0.74, 0.66, 0],
        [3.5, 3.5, 3.44, 3.26, 3.2, 2.7, 2.45, 2.05, 1.75, 1.4, 0.16, 0, 0],
        36,
    )
    tumbler = lathe([0.74, 0.6, 0.52, 0], [1.75, 0.12, 0, 0], 36)
    return scene(
        [
            floor("#c9b49a"),
            put(shapes.sphere(), dull, "#e2502c", (-1.3, 0.9, -1.9), scale=0.9),
            put(shapes.cylinder(), dull, "#f2b632", (1.55, 0.9, -2.3)),
            put(shapes.sphere(), glossy, "#c43a80", (1.05, 0.42, 1.3), scale=0.42),
            put(shapes.sphere(), glossy, "#168aa8", (-0.4, 0.34, 1.7), scale=0.34),
            put(bottle, clear, "#0d8a5c", (0.15, 0, -0.5), opacity=0.5),
            put(bottle, clear, "#2a62c4", (2.45, 0, 0.0), scale=0.82, opacity=0.5),
            put(tumbler, clear, "#b8e2f0", (-2.05, 0, 0.4), opacity=0.42, cull=False),
        ],
        Camera.perspective((0.4, 2.7, 9.2), (0.2, 1.5, 0), fov=29),
        Light.directional(toward=(-0.6, 0.8, 0.5), color="#fff4e4", shadow=True),
        "#e9dccb",
        ambient_light="#f0ece4",
        rim=("#3c4048", 4),
    )


def vase() -> Scene:
    """Return an amphora, painted by a texture."""
    corners = np.array(
        [
            (0.0, 2.56), (0.3, 2.56), (0.36, 2.62), (0.43, 2.6), (0.42, 2.5), (0.31, 2.4), (0.26, 2.2), (0.28, 2.0),
            (0.5, 1.84), (0.78, 1.62), (0.93, 1.32), (0.92, 1.0), (0.76, 0.66), (0.5, 0.36), (0.31, 0.2), (0.3, 0.14),
            (0.46, 0.08), (0.47, 0.0), (0.0, 0.0),
        ]
    )  # fmt: skip
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1))])
    steps = np.linspace(0, along[-1], 65)
    radius, height = (np.interp(steps, along, corners[:, axis]) for axis in (0, 1))
    outward = np.stack([-np.gradient(height), np.gradient(radius)])
    u = np.linspace(0, 1, 57)[:, None]
    points, normals = (shapes.around(2 * np.pi * u, y, x) for x, y in ((radius, height), outward))
    uvs = np.stack(np.broadcast_arrays(2 * u, 1 - height / 2.62), axis=-1)
    faces = shapes.cells(len(u), len(height))[:, ::-1]
    mesh = Mesh(points.reshape(-1, 3), faces, "white", normals.reshape(-1, 3), uvs.reshape(-1, 2))
    clay = Material("smooth", ambient=0.42, diffuse=0.7, specular=0.45, shininess=36, texture=Texture(bands()))
    return scene(
        [floor("#d8c8b0"), Object(mesh, rotation=(0, 20, 0), material=clay)],
        Camera.perspective((0, 2.0, 6.8), (0, 1.28, 0), fov=27),
        Light.directional(toward=(-0.6, 0.75, 0.55), color="#fff2dc", shadow=True),
        "#efe6d6",
        ambient_light="#e8e4f0",
    )


def bands() -> Array:
    """Return half of the painting around the amphora, (256, 256, 3): glaze, meanders, rays and waves."""
    clay, glaze = np.array([206, 108, 58]), np.array([38, 30, 30])
    row, column = np.mgrid[:256, :256] / 256
    black = (row < 0.29) | (row > 0.93)
    # tongues on the shoulder
    black |= (row > 0.3) & (row < 0.36) & (np.abs(column * 32 % 1 - 0.5) < 0.34 - 2 * np.maximum(row - 0.33, 0))
    # lines between the bands
    for line in (0.375, 0.5, 0.62, 0.75):
        black |= np.abs(row - line) < 0.009
    # a meander: 8 by 7 cells, of which there are 8 around
    key = ["########", "#......#", "#.####.#", "#.#..#.#", "#.##.#.#", "#....#.#", "######.#"]
    cells = np.array([[cell == "#" for cell in line] for line in key])
    inside = (row > 0.395) & (row < 0.48)
    down = np.clip(((row - 0.395) / 0.085 * 7).astype(int), 0, 6)
    black |= inside & cells[down, (column * 64).astype(int) % 8]
    # waves
    phase = 2 * np.pi * 8 * column
    black |= (row > 0.52) & (row < 0.605) & (row > 0.5625 + 0.03 * np.sin(phase + 1.1 * np.sin(phase)))
    black |= (row > 0.64) & (row < 0.73)
    # rays at the foot
    black |= (row > 0.76) & (row < 0.93) & (np.abs(column * 12 % 1 - 0.5) < 0.5 * (row - 0.76) / 0.17)
    return np.where(black[..., None], glaze, clay)


def forest() -> Scene:
    """Return firs on both sides of a valley, paler and paler in the haze of a morning."""
    rng = np.random.default_rng(12)
    matt = Material("flat", ambient=0.6, diffuse=0.85, specular=0, shininess=1)
    depths = np.concatenate([np.linspace(-34, 3.5, 96), [4.6, 5.4]])
    sides = [float(rng.choice([-1, 1]) * (1.6 + rng.exponential(0.17 * (12 - z)))) for z in depths[:-2]] + [-3.3, 3.4]
    trees = [fir(rng, x, float(hill(x, z)), z) for x, z in zip(sides, depths.tolist(), strict=True)]
    xs, zs = np.linspace(-32, 32, 25), np.linspace(-46, 9, 25)
    return scene(
        [Object(shapes.joined(*trees), material=matt), put(terrain(xs, zs, hill(xs, zs[:, None])), matt, "#80874c")],
        Camera.perspective((0, 2.2, 11), (0, 2.6, 0), fov=38),
        Light.directional(toward=(-0.9, 0.6, 0.2), color="#ffcf94", shadow=True),
        ("#6f9cc4", "#ffe2c0"),
        ambient_light="#6c7890",
        hemisphere=("#5a7898", "#181c14"),
        fog=("#ecdccb", 7, 36),
    )


def hill(x: ArrayLike, z: ArrayLike) -> Array:
    """Return the height of the valley."""
    x, z = np.asarray(x), np.asarray(z)
    return 0.35 * np.sin(0.31 * x + 0.4) * np.cos(0.23 * z) - 0.02 * z + 0.012 * x**2 - 0.4


def fir(rng: np.random.Generator, x: float, y: float, z: float) -> Mesh:
    """Return a tree of three cones on a trunk, of a size and a green of its own."""
    size, turn = rng.uniform(1.7, 3.3), rng.uniform(0, 6)
    green = rng.uniform(-10, 14)
    parts = [cone(0.07, 0.08, 0.0, 0.3, 5, "#4a3626", turn)]
    for level, (reach, low, high) in enumerate(((0.4, 0.16, 0.6), (0.32, 0.4, 0.82), (0.22, 0.62, 1.08))):
        parts.append(cone(0, reach, low, high, 7, ("#2a5c3a", "#326a42", "#3c7a4a")[level], turn + level))
    mesh = shapes.joined(*parts)
    colors = np.clip(mesh.colors + np.array([green, green, 0]), 0, 255).astype(np.uint8)
    return Mesh(size * mesh.positions + (x, y - 0.05, z), mesh.faces, colors)


def cone(top: float, bottom: float, low: float, high: float, sides: int, color: str, turn: float) -> Mesh:
    """Return the side of a cone, cut off unless its radius at the top is 0."""
    angle = turn + 2 * np.pi * np.arange(sides) / sides
    points = np.concatenate([shapes.around(angle, y, radius) for y, radius in ((low, bottom), (high, top))])
    k, following = np.arange(sides), np.roll(np.arange(sides), -1)
    lower, upper = (k, following, sides + k), (following, sides + following, sides + k)
    return Mesh(points, np.hstack([lower, upper] if top else [lower]).T, color)


def skull() -> Scene:
    """Return the icon of a skull in the dark, outlined by cold light."""
    right, up, back = view_axes(-30, 4)
    return load(
        "icons/skull",
        SIZE,
        azimuth=-30,
        elevation=4,
        margin=0.12,
        ambient=0.1,
        diffuse=0.7,
        lights=Light.directional(toward=0.9 * right + 0.55 * up + 0.35 * back, color="#ff8a4a"),
        background=("#0a0d18", "#1e1434"),
        ambient_light="#8090c0",
        rim=("#4cb8ff", 3),
        exposure=1.1,
        filmic=True,
        gamma=True,
    )


def knot() -> Scene:
    """Return a knot in bright coloured lights, added up in linear space and compressed as on film."""
    porcelain = Material("smooth", ambient=0.03, diffuse=0.75, specular=0.9, shininess=70)
    return scene(
        [put(shapes.torus_knot(2, 3, 0.2, 150, 18), porcelain, "#f4efe8")],
        Camera.perspective((0, 0.4, 5.0), (0, 0, 0), fov=27),
        [
            Light.directional(toward=(-1, 0.2, 0.35), color="#ff3a20"),
            Light.directional(toward=(1, 0.1, 0.3), color="#2050ff"),
            Light.directional(toward=(0.05, 1, 0.3), color="#ffd9a0"),
        ],
        ("#121018", "#2c2438"),
        tone=Tone(1.5, filmic=True, gamma=True),
    )


def plaster() -> Scene:
    """Return solids of plaster under a blue sky, on warm ground that shines back."""
    chalk = Material("smooth", ambient=0.85, diffuse=0.55, specular=0, shininess=1)
    facets = replace(chalk, shading="flat")
    color = "#f6f3ee"
    return scene(
        [
            floor("#f2bf86", 0.5, 0.75),
            put(shapes.torus(), chalk, color, (-2.15, 1.0, -0.2), (90, 0, 0)),
            put(shapes.dodecahedron(), facets, color, (0.1, 0.98, -0.9), (10, 20, 0), 1.2),
            put(shapes.cone(60), chalk, color, (2.35, 0.9, -0.3)),
            put(shapes.sphere(40, 20), chalk, color, (-0.9, 0.55, 1.5), scale=0.55),
            put(shapes.superellipsoid(), chalk, color, (1.05, 0.62, 1.5), (0, 35, 0), 0.62),
        ],
        Camera.perspective((0, 2.7, 9.9), (0.08, 1.0, 0), fov=28),
        Light.directional(toward=(-0.7, 0.75, 0.4), color="#ffe9c4", shadow=True),
        "#bcd6ee",
        ambient_light="#181818",
        hemisphere=("#7ea8e8", "#c0702c"),
        tone=Tone(1.15, gamma=True),
    )


def shell() -> Scene:
    """Return a seashell by the sea: light from the sky and from the sand, and a fine rim."""
    return stage(
        shapes.shaded(shapes.seashell(180, 28), "#d9735b", "#f7e3c9"),
        SIZE,
        material=Material("smooth", ambient=0.6, diffuse=0.6, specular=0.5, shininess=50),
        antialias=True,
        azimuth=20,
        elevation=14,
        margin=0.1,
        cull=False,
        background=("#1d5a72", "#bfe0d8"),
        ambient_light="#303030",
        hemisphere=("#a8d4e8", "#d09860"),
        rim=("#ffe4c0", 5),
        gamma=True,
    )


def wires() -> Scene:
    """Return hills as a net of wires that fades into the night, before a low sun."""
    rng = np.random.default_rng(3)
    xs, zs = np.linspace(-16, 16, 33), np.linspace(-26, 6, 25)
    z, x = np.meshgrid(zs, xs, indexing="ij")
    valley = np.clip(np.abs(x) / 7 - 0.35, 0, 1) ** 1.5
    height = valley * (1.6 + 1.2 * np.sin(0.9 * x + 0.5 * z) + rng.uniform(-0.8, 1.2, x.shape))
    k = np.arange(64)
    angle = 2 * np.pi * k / 64
    rim = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    disc = Mesh(np.concatenate([[(0, 0, 0)], rim]), np.stack([0 * k, 1 + k, 1 + (k + 1) % 64], axis=1))
    sun = shapes.shaded(disc, "#ff2f7e", "#ffd25a")
    return scene(
        [
            Object(sun, (0, 4.8, -40), scale=7.5, material=UNLIT),
            put(terrain(xs, zs, height), UNLIT, "#ff5fa8", wireframe=True, cull=False),
        ],
        Camera.perspective((0, 2.4, 9.5), (0, 2.5, 0), fov=40),
        [],
        ("#0d0630", "#4a1060"),
    )


def cornell_box() -> Scene:
    """Return the Cornell box with shadows, its light added up in linear space."""
    return load("cornell-box", SIZE, shadow=True, exposure=0.9, filmic=True, gamma=True)


def genesis() -> Scene:
    """Return a piece of Genesis, antialiased."""
    return load("genesis/21", SIZE)


def rocket() -> Scene:
    """Return the icon of a rocket, of which a turntable is drawn."""
    background, rim = ("#141638", "#3c2a68"), ("#5c78ff", 3)
    return load("icons/rocket", SIZE, margin=0.04, background=background, ambient_light=(200, 205, 255), rim=rim)


# ---- parts of the above ----


def scene(objects: list[Object], camera: Camera, lights: Any, background: Any, **fields: Any) -> Scene:
    """Return a scene of the size of all."""
    return Scene(objects, camera, lights, background, width=SIZE[0], height=SIZE[1], antialias=True, **fields)


def put(
    mesh: Mesh,
    material: Material,
    color: str,
    position: ArrayLike = (0, 0, 0),
    rotation: ArrayLike = (0, 0, 0),
    scale: float = 1,
    **fields: Any,
) -> Object:
    """Return a mesh in one colour, in its place. rotation: degrees about x, then y, then z."""
    return Object(replace(mesh, colors=color), position, rotation, scale, material, **fields)


def floor(color: str, ambient: float = 0.45, diffuse: float = 0.6, reach: float = 9.0) -> Object:
    """Return a matte plane at y = 0 that fades into the background; it comes before what shines through."""
    matte = Material("flat", ambient=ambient, diffuse=diffuse, specular=0, shininess=1)
    line = np.array([-1.0, 1.0])
    return put(terrain(line, line, 0.0), matte, color, scale=reach, fade=(0.35 * reach, reach))


def terrain(xs: Array, zs: Array, height: float | Array) -> Mesh:
    """Return a surface over a grid, seen from above."""
    z, x = np.meshgrid(zs, xs, indexing="ij")
    points = np.stack([x, np.broadcast_to(height, x.shape), z], axis=-1).reshape(-1, 3)
    return Mesh(points, shapes.cells(*x.shape))


def lathe(radius: ArrayLike, height: ArrayLike, around: int) -> Mesh:
    """Return the surface that a profile, from the top down, sweeps about the y axis."""
    angle = 2 * np.pi * np.linspace(0, 1, around + 1)[:, None]
    points = shapes.around(angle, np.asarray(height)[::-1], np.asarray(radius)[::-1])
    return shapes.smooth(points.reshape(-1, 3), shapes.cells(*points.shape[:2]))


# ---- drawing ----


SCENES: dict[str, Callable[[], Scene]] = {
    "still-life": still_life,
    "glass": glass,
    "vase": vase,
    "forest": forest,
    "skull": skull,
    "knot": knot,
    "plaster": plaster,
    "shell": shell,
    "wires": wires,
    "cornell-box": cornell_box,
    "genesis": genesis,
    "rocket": rocket,
}


def draw(name: str, folder: Path) -> int:
    """Draw a scene into a folder; return the gas."""
    made = SCENES[name]()
    # that of the rocket turns: the contract Turntable makes its file in one call
    drawn = turntable(made, 16, duration=90, one_call=True) if name == "rocket" else render(made)
    drawn.save(folder / f"{name}.png")
    assert drawn.gas is not None
    return drawn.gas


def main() -> None:
    """Draw the scenes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"which: {', '.join(SCENES)}; else all")
    parser.add_argument("--into", type=Path, default=FOLDER, metavar="DIR", help="the folder")
    arguments = parser.parse_args()
    if unknown := set(arguments.names) - SCENES.keys():
        parser.error(f"there is no scene {', '.join(sorted(unknown))}; the scenes are {', '.join(SCENES)}")
    arguments.into.mkdir(parents=True, exist_ok=True)
    for name in arguments.names or SCENES:
        print(f"{arguments.into / name}.png: {draw(name, arguments.into) / 1e6:.1f} million gas", flush=True)


if __name__ == "__main__":
    main()
