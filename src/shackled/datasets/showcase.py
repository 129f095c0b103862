"""The showcase: twelve scenes that show the options of the renderer, and how they are drawn into a folder.

Lengths are about those of the still life, whose teapot is 3 high and stands on y = 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike, NDArray

from ..scene import (
    Background,
    Camera,
    Fog,
    Hemisphere,
    Light,
    Material,
    Mesh,
    Object,
    Rim,
    Scene,
    Texture,
    Tone,
    from_euler,
    look_at,
    painted,
    stage,
    view_axes,
)
from ..whole_file import write_output
from ._drawing import Thumbnail, sheet
from ._pieces import Piece, require
from ._teapot import teapot
from .common import shapes

Array = NDArray[np.float64]

#: Of every scene.
SIZE = (320, 240)
UNLIT = Material("unlit")
#: The scene that is drawn as a turntable, its frames, and their duration in milliseconds.
TURNED, FRAMES, DURATION = "showcase/rocket", 16, 90
COLUMNS = 4


def _scene(
    objects: Sequence[Object], camera: Camera, lights: Sequence[Light], background: Background, **fields: Any
) -> Scene:
    return Scene(objects, camera, lights, background, width=SIZE[0], height=SIZE[1], antialias=True, **fields)


def _put(
    mesh: Mesh,
    material: Material,
    color: str = "",
    position: ArrayLike = (0, 0, 0),
    turn: tuple[float, float, float] = (0, 0, 0),
    scale: float = 1,
    cull: bool = True,
    opacity: float = 1,
) -> Object:
    mesh = painted(mesh, color) if color else mesh
    return Object(mesh, position, from_euler(turn), scale, material, cull, opacity=opacity)


def _floor(color: str, ambient: float = 0.45, diffuse: float = 0.6, reach: float = 9.0) -> Object:
    """Return a matte plane at y = 0 that fades into the background; it comes before what shines through."""
    plane = _terrain(np.array([-1.0, 1.0]), np.array([-1.0, 1.0]), 0.0)
    matte = Material("flat", ambient=ambient, diffuse=diffuse, specular=0, shininess=1)
    return Object(painted(plane, color), scale=reach, material=matte, fade=(0.35 * reach, reach))


def _sun(toward: ArrayLike, color: str) -> Light:
    """Return a directional light that casts shadows."""
    return evolve(Light.directional(toward=toward, color=color), shadow=True)


def _terrain(xs: Array, zs: Array, height: float | Array) -> Mesh:
    """Return a surface over a grid, seen from above."""
    z, x = np.meshgrid(zs, xs, indexing="ij")
    points = np.stack([x, np.broadcast_to(height, x.shape), z], axis=-1).reshape(-1, 3)
    return Mesh(points, shapes.cells(*x.shape))


def still_life() -> Scene:
    """Return the still life of examples/scene.toml in the light of a sun, with shadows."""
    glaze = Material("smooth", ambient=0.25, diffuse=0.85, specular=0.7, shininess=48)
    polished = Material("smooth", ambient=0.25, diffuse=0.8, specular=0.9, shininess=80)
    soft = Material("smooth", ambient=0.3, diffuse=0.8, specular=0.6, shininess=40)
    wires = Object(painted(shapes.icosphere(2), "#f4f6ff"), (0.2, 0.9, 3.4), scale=0.9, material=UNLIT, wireframe=True)
    return _scene(
        [
            _put(teapot(5), glaze, "#c8553d", (-0.9, 0, -0.6), (0, -20, 0), cull=False),
            _put(_goblet(), soft, "#3f7f86", (3.6, 0, -1.6), scale=1.25, cull=False),
            _put(shapes.sphere(28, 14), polished, "#e0b040", (2.2, 0.75, 1.7), scale=0.75),
            _put(shapes.torus(1.0, 0.32, 36, 12), soft, "#5b6bb0", (-2.5, 0.32, 2.6)),
            wires,
            _chessboard(),
        ],
        Camera.perspective((0.8, 4.6, 11.5), (0.25, 1.15, 0), fov=38),
        [_sun((-8, 6.5, 3.2), "#fff1dc"), Light.directional(toward=(0.9, 0.5, 0.4), color="#3c4866")],
        Background("#27314a", "#c9a68a"),
        ambient_light="#c8d4ff",
    )


def _goblet() -> Mesh:
    """Return a goblet, 2.6 high, standing on y = 0, open at the top."""
    height = np.linspace(1, 0, 21)
    radius = 0.42 + 0.42 * np.sin(2.6 * np.pi * height**0.8 + 0.4) * (1 - 0.55 * height)
    return _lathe(np.append(radius, 0), np.append(2.6 * height, 0), 24)


def _lathe(radius: ArrayLike, height: ArrayLike, around: int) -> Mesh:
    """Return the surface that a profile, from the top down, sweeps about the y axis."""
    angle = 2 * np.pi * np.linspace(0, 1, around + 1)[:, None]
    points = shapes.around(angle, np.asarray(height)[::-1], np.asarray(radius)[::-1])
    return shapes.smooth(points.reshape(-1, 3), shapes.cells(*points.shape[:2]))


def _chessboard(side: int = 12) -> Object:
    """Return squares of side 1, at y = 0, about the origin: one square with a texture."""
    row, column = np.indices((side, side))
    pixels = np.where(((row + column) % 2 == 0)[..., None], (214, 205, 190), (92, 84, 84))
    material = Material("flat", 0.25, 0.8, 0.15, 20, Texture(pixels, "nearest", "clamp"))
    line = np.array([-side / 2, side / 2])
    mesh = evolve(_terrain(line, line, 0.0), colors="#ffffff", uvs=[(0, 0), (1, 0), (0, 1), (1, 1)])
    return Object(mesh, material=material)


def glass() -> Scene:
    """Return bottles, a tumbler and marbles of glass before solid things, which shine through."""
    clear = Material("smooth", ambient=0.55, diffuse=0.6, specular=1.6, shininess=70)
    dull = Material("smooth", ambient=0.35, diffuse=0.75, specular=0.3, shininess=24)
    glossy = Material("smooth", ambient=0.35, diffuse=0.7, specular=1.0, shininess=60)
    bottle = _lathe(
        [0, 0.26, 0.31, 0.31, 0.26, 0.27, 0.32, 0.62, 0.73, 0.74, 0.74, 0.66, 0],
        [3.5, 3.5, 3.44, 3.26, 3.2, 2.7, 2.45, 2.05, 1.75, 1.4, 0.16, 0, 0],
        36,
    )
    tumbler = _lathe([0.74, 0.6, 0.52, 0], [1.75, 0.12, 0, 0], 36)
    return _scene(
        [
            _floor("#c9b49a"),
            _put(shapes.sphere(), dull, "#e2502c", (-1.3, 0.9, -1.9), scale=0.9),
            _put(shapes.cylinder(), dull, "#f2b632", (1.55, 0.9, -2.3)),
            _put(shapes.sphere(), glossy, "#c43a80", (1.05, 0.42, 1.3), scale=0.42),
            _put(shapes.sphere(), glossy, "#168aa8", (-0.4, 0.34, 1.7), scale=0.34),
            _put(bottle, clear, "#0d8a5c", (0.15, 0, -0.5), opacity=0.5),
            _put(bottle, clear, "#2a62c4", (2.45, 0, 0.0), scale=0.82, opacity=0.5),
            _put(tumbler, clear, "#b8e2f0", (-2.05, 0, 0.4), opacity=0.42, cull=False),
        ],
        Camera.perspective((0.4, 2.7, 9.2), (0.2, 1.5, 0), fov=29),
        [_sun((-0.6, 0.8, 0.5), "#fff4e4")],
        Background("#e9dccb", "#e9dccb"),
        ambient_light="#f0ece4",
        rim=Rim("#3c4048", 4),
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
    mesh = Mesh(points.reshape(-1, 3), faces, "#ffffff", normals.reshape(-1, 3), uvs.reshape(-1, 2))
    clay = Material("smooth", ambient=0.42, diffuse=0.7, specular=0.45, shininess=36, texture=Texture(_bands()))
    return _scene(
        [_floor("#d8c8b0"), _put(mesh, clay, turn=(0, 20, 0))],
        Camera.perspective((0, 2.0, 6.8), (0, 1.28, 0), fov=27),
        [_sun((-0.6, 0.75, 0.55), "#fff2dc")],
        Background("#efe6d6"),
        ambient_light="#e8e4f0",
    )


def _bands() -> Array:
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
    trees = [_fir(rng, x, float(_hill(x, z)), z) for x, z in zip(sides, depths.tolist(), strict=True)]
    xs, zs = np.linspace(-32, 32, 25), np.linspace(-46, 9, 25)
    z, x = np.meshgrid(zs, xs, indexing="ij")
    land = _terrain(xs, zs, _hill(x, z))
    return _scene(
        [_put(shapes.joined(*trees), matt), _put(land, matt, "#80874c")],
        Camera.perspective((0, 2.2, 11), (0, 2.6, 0), fov=38),
        [_sun((-0.9, 0.6, 0.2), "#ffcf94")],
        Background("#6f9cc4", "#ffe2c0"),
        ambient_light="#6c7890",
        hemisphere=Hemisphere("#5a7898", "#181c14"),
        fog=Fog("#ecdccb", 7, 36),
    )


def _hill(x: ArrayLike, z: ArrayLike) -> Array:
    x, z = np.asarray(x), np.asarray(z)
    return 0.35 * np.sin(0.31 * x + 0.4) * np.cos(0.23 * z) - 0.02 * z + 0.012 * x**2 - 0.4


def _fir(rng: np.random.Generator, x: float, y: float, z: float) -> Mesh:
    size, turn = rng.uniform(1.7, 3.3), rng.uniform(0, 6)
    green = rng.uniform(-10, 14)
    parts = [_cone(0.07, 0.08, 0.0, 0.3, 5, "#4a3626", turn)]
    for level, (reach, low, high) in enumerate(((0.4, 0.16, 0.6), (0.32, 0.4, 0.82), (0.22, 0.62, 1.08))):
        parts.append(_cone(0, reach, low, high, 7, ("#2a5c3a", "#326a42", "#3c7a4a")[level], turn + level))
    mesh = shapes.joined(*parts)
    colors = np.clip(mesh.colors + np.array([green, green, 0]), 0, 255).astype(np.uint8)
    return Mesh(size * mesh.positions + (x, y - 0.05, z), mesh.faces, colors)


def _cone(top: float, bottom: float, low: float, high: float, sides: int, color: str, turn: float) -> Mesh:
    """Return the side of a cone, cut off unless its radius at the top is 0."""
    angle = turn + 2 * np.pi * np.arange(sides) / sides
    points = np.concatenate([shapes.around(angle, y, radius) for y, radius in ((low, bottom), (high, top))])
    k, following = np.arange(sides), np.roll(np.arange(sides), -1)
    lower, upper = (k, following, sides + k), (following, sides + following, sides + k)
    return painted(Mesh(points, np.hstack([lower, upper] if top else [lower]).T), color)


def skull() -> Scene:
    """Return the icon of a skull in the dark, outlined by cold light."""
    scene = _piece("icons/skull", azimuth=-30, elevation=4, margin=0.12)
    right, up, back = view_axes(-30, 4)
    return evolve(
        scene,
        objects=[evolve(o, material=evolve(o.material, ambient=0.1, diffuse=0.7)) for o in scene.objects],
        lights=[Light.directional(toward=0.9 * right + 0.55 * up + 0.35 * back, color="#ff8a4a")],
        background=Background("#0a0d18", "#1e1434"),
        ambient_light="#8090c0",
        rim=Rim("#4cb8ff", 3),
        tone=Tone(1.1, filmic=True, gamma=True),
    )


def _piece(name: str, **look: Any) -> Scene:
    """Return a piece of another dataset on the canvas of the showcase."""
    return look_at(require(name).make(), {"size": SIZE, "antialias": True, **look})


def genesis() -> Scene:
    """Return a piece of Genesis, antialiased."""
    return _piece("genesis/21")


def rocket() -> Scene:
    """Return the icon of a rocket, of which the showcase draws a turntable."""
    look = {"background": Background("#141638", "#3c2a68"), "ambient_light": (200, 205, 255), "margin": 0.04}
    return evolve(_piece("icons/rocket", **look), rim=Rim("#5c78ff", 3))


def knot() -> Scene:
    """Return a knot in bright coloured lights, added up in linear space and compressed as on film."""
    porcelain = Material("smooth", ambient=0.03, diffuse=0.75, specular=0.9, shininess=70)
    return _scene(
        [_put(shapes.torus_knot(2, 3, 0.2, 150, 18), porcelain, "#f4efe8")],
        Camera.perspective((0, 0.4, 5.0), (0, 0, 0), fov=27),
        [
            Light.directional(toward=(-1, 0.2, 0.35), color="#ff3a20"),
            Light.directional(toward=(1, 0.1, 0.3), color="#2050ff"),
            Light.directional(toward=(0.05, 1, 0.3), color="#ffd9a0"),
        ],
        Background("#121018", "#2c2438"),
        tone=Tone(1.5, filmic=True, gamma=True),
    )


def plaster() -> Scene:
    """Return solids of plaster under a blue sky, on warm ground that shines back."""
    chalk = Material("smooth", ambient=0.85, diffuse=0.55, specular=0, shininess=1)
    facets = evolve(chalk, shading="flat")
    color = "#f6f3ee"
    return _scene(
        [
            _floor("#f2bf86", 0.5, 0.75),
            _put(shapes.torus(), chalk, color, (-2.15, 1.0, -0.2), (90, 0, 0)),
            _put(shapes.dodecahedron(), facets, color, (0.1, 0.98, -0.9), (10, 20, 0), 1.2),
            _put(shapes.cone(60), chalk, color, (2.35, 0.9, -0.3)),
            _put(shapes.sphere(40, 20), chalk, color, (-0.9, 0.55, 1.5), scale=0.55),
            _put(shapes.superellipsoid(), chalk, color, (1.05, 0.62, 1.5), (0, 35, 0), 0.62),
        ],
        Camera.perspective((0, 2.7, 9.9), (0.08, 1.0, 0), fov=28),
        [_sun((-0.7, 0.75, 0.4), "#ffe9c4")],
        Background("#bcd6ee"),
        ambient_light="#181818",
        hemisphere=Hemisphere("#7ea8e8", "#c0702c"),
        tone=Tone(1.15, gamma=True),
    )


def wires() -> Scene:
    """Return hills as a net of wires that fades into the night, before a low sun."""
    rng = np.random.default_rng(3)
    xs, zs = np.linspace(-16, 16, 33), np.linspace(-26, 6, 25)
    z, x = np.meshgrid(zs, xs, indexing="ij")
    valley = np.clip(np.abs(x) / 7 - 0.35, 0, 1) ** 1.5
    height = valley * (1.6 + 1.2 * np.sin(0.9 * x + 0.5 * z) + rng.uniform(-0.8, 1.2, x.shape))
    hills = painted(_terrain(xs, zs, height), "#ff5fa8")
    angle = 2 * np.pi * np.arange(64) / 64
    rim = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    k = np.arange(64)
    disc = Mesh(np.concatenate([[(0, 0, 0)], rim]), np.stack([0 * k, 1 + k, 1 + (k + 1) % 64], axis=1))
    sun = shapes.shaded(disc, "#ff2f7e", "#ffd25a")
    return _scene(
        [
            Object(sun, (0, 4.8, -40), scale=7.5, material=UNLIT),
            Object(hills, material=UNLIT, wireframe=True, cull=False),
        ],
        Camera.perspective((0, 2.4, 9.5), (0, 2.5, 0), fov=40),
        [],
        Background("#0d0630", "#4a1060"),
    )


def cornell_box() -> Scene:
    """Return the Cornell box with shadows, its light added up in linear space."""
    scene = _piece("cornell-box")
    lamp = evolve(scene.lights[0], shadow=True)
    return evolve(scene, lights=[lamp], tone=Tone(0.9, filmic=True, gamma=True))


def shell() -> Scene:
    """Return a seashell by the sea: light from the sky and from the sand, and a fine rim."""
    pearl = Material("smooth", ambient=0.6, diffuse=0.6, specular=0.5, shininess=50)
    mesh = shapes.shaded(shapes.seashell(180, 28), "#d9735b", "#f7e3c9")
    return evolve(
        stage(mesh, SIZE, material=pearl, antialias=True, azimuth=20, elevation=14, margin=0.1, cull=False),
        background=Background("#1d5a72", "#bfe0d8"),
        ambient_light="#303030",
        hemisphere=Hemisphere("#a8d4e8", "#d09860"),
        rim=Rim("#ffe4c0", 5),
        tone=Tone(1.0, gamma=True),
    )


def pieces() -> list[Piece]:
    """Return all scenes, in the order in which they are shown."""
    titles = {
        still_life: "Still life with shadows, antialiased",
        glass: "Glass: opacity and a rim",
        vase: "A texture, and a ground",
        forest: "Fog",
        skull: "An icon with a rim",
        knot: "Linear light and a filmic curve",
        plaster: "Hemisphere light and shadows",
        shell: "Light from sky and sand",
        wires: "Wires, antialiased",
        cornell_box: "The Cornell box, with shadows, in linear light",
        genesis: "A piece of Genesis, antialiased",
        rocket: "A turntable, made by a contract",
    }
    names = {make: make.__name__.replace("_", "-") for make in titles}
    return [Piece(f"showcase/{names[make]}", "showcase", title, "MIT", make) for make, title in titles.items()]


def draw_showcase(folder: Path, chosen: Sequence[Piece] = ()) -> Iterator[Thumbnail]:
    """Draw scenes into a folder, which must exist, and yield each when it is done; then sheet.png.

    chosen: the scenes; all if it is empty. OutputError where the disk is full or fails.
    """
    listed, drawings = chosen or pieces(), {}
    for piece in listed:
        drawing = drawings[piece.name] = _draw(piece)
        write_output(folder / f"{piece.name.partition('/')[2]}.png", drawing.png)
        yield drawing
    write_output(folder / "sheet.png", sheet(listed, drawings, SIZE, min(COLUMNS, len(listed))))


def _draw(piece: Piece) -> Thumbnail:
    from .._render import render
    from ..studio import make_apng

    scene = piece.make()
    if piece.name == TURNED:
        film = make_apng(scene, FRAMES, DURATION, scale=SIZE[0] // scene.width)
        return Thumbnail(piece.name, scene.triangles, film.gas, film.content)
    image = render(scene)
    return Thumbnail(piece.name, scene.triangles, image.gas, image.encode(".png"))
