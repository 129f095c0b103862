"""The scenes of the showcase. Lengths are about those of the still life, whose teapot is 3 high and stands on y = 0."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike, NDArray

from ...scene import (
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
    Tone,
    from_euler,
    look_at,
    painted,
    view_axes,
)
from .. import require, teapot
from ..common import shapes
from ..icons import modelling

Array = NDArray[np.float64]

#: Of every scene.
SIZE = (360, 270)
UNLIT = Material("unlit")


def _scene(
    objects: Sequence[Object], camera: Camera, lights: Sequence[Light], background: Background, **fields: object
) -> Scene:
    width, height = SIZE
    return Scene(objects, camera, lights, background, width=width, height=height, antialias=True, **fields)


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


def _plane(side: float, color: str, cells: int = 1) -> Mesh:
    """Return a square at y = 0."""
    line = np.linspace(-side / 2, side / 2, cells + 1)
    grid = modelling_grid(line, line)
    return painted(grid, color)


def modelling_grid(xs: Array, zs: Array, height: float | Array = 0.0) -> Mesh:
    """Return a terrain over a grid, seen from above."""
    z, x = np.meshgrid(zs, xs, indexing="ij")
    points = np.stack([x, np.broadcast_to(height, x.shape), z], axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape(x.shape)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    faces = np.stack([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)], axis=-2).reshape(-1, 3)
    return Mesh(points, faces)


# ---- still life ----


def still_life() -> Scene:
    """Return the still life of examples/scene.toml."""
    glaze = Material("smooth", ambient=0.25, diffuse=0.85, specular=0.7, shininess=48)
    polished = Material("smooth", ambient=0.25, diffuse=0.8, specular=0.9, shininess=80)
    soft = Material("smooth", ambient=0.3, diffuse=0.8, specular=0.6, shininess=40)
    wires = Object(painted(shapes.icosphere(2), "#f4f6ff"), (0.2, 0.9, 3.4), scale=0.9, material=UNLIT, wireframe=True)
    return _scene(
        [
            _put(teapot(8), glaze, "#c8553d", (-0.9, 0, -0.6), (0, -20, 0), cull=False),
            _put(_goblet(), soft, "#3f7f86", (3.6, 0, -1.6), scale=1.25, cull=False),
            _put(shapes.sphere(), polished, "#e0b040", (2.2, 0.75, 1.7), scale=0.75),
            _put(shapes.torus(1.0, 0.32, 40, 16), soft, "#5b6bb0", (-2.5, 0.32, 2.6)),
            wires,
            _put(_chessboard(), Material("flat", ambient=0.25, diffuse=0.8, specular=0.15, shininess=20)),
        ],
        Camera.perspective((0.8, 4.6, 11.5), (0.25, 1.15, 0), fov=38),
        [Light.point((-5, 8, 6.5), "#fff1dc"), Light.directional((0.9, 0.5, 0.4), "#3c4866")],
        Background("#27314a", "#c9a68a"),
        ambient_light="#c8d4ff",
    )


def _goblet() -> Mesh:
    """Return a goblet, 2.6 high, standing on y = 0, open at the top."""
    height = np.linspace(1, 0, 21)
    radius = 0.42 + 0.42 * np.sin(2.6 * np.pi * height**0.8 + 0.4) * (1 - 0.55 * height)
    return _lathe(np.append(radius, 0), np.append(2.6 * height, 0), 28)


def _lathe(radius: ArrayLike, height: ArrayLike, around: int) -> Mesh:
    """Return the surface that a profile, from the top down, sweeps about the y axis."""
    r, h = np.asarray(radius, np.float64), np.asarray(height, np.float64)

    def surface(u: Array, v: Array) -> Array:
        place = np.linspace(0, 1, len(r))
        reach, y, angle = np.interp(1 - v, place, r), np.interp(1 - v, place, h), 2 * np.pi * u
        return np.stack([reach * np.cos(angle), y, -reach * np.sin(angle)], axis=-1)

    return shapes.patch(surface, around, len(r) - 1)


def _chessboard(side: int = 12) -> Mesh:
    """Return squares of side 1, at y = 0, about the origin."""
    x, z = (c.reshape(-1) for c in np.meshgrid(np.arange(side), np.arange(side), indexing="ij"))
    places = np.stack([x, z], axis=1)[:, None] + [(0, 0), (0, 1), (1, 1), (1, 0)] - np.array(side / 2)
    positions = np.stack([places[..., 0], np.zeros(places.shape[:2]), places[..., 1]], axis=-1).reshape(-1, 3)
    colors = np.where(((x + z) % 2 == 0)[:, None], (214, 205, 190), (92, 84, 84)).repeat(4, axis=0)
    corners = np.arange(4 * side * side).reshape(-1, 4)
    return Mesh(positions, np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]), colors)


# ---- glass ----


def glass() -> Scene:
    """Return a glass, bottles and marbles before a low sun: what is behind shines through."""
    clear = Material("smooth", ambient=0.35, diffuse=0.5, specular=2.2, shininess=90)
    dull = Material("smooth", ambient=0.3, diffuse=0.75, specular=0.25, shininess=20)
    bottle = _lathe(
        [0, 0.28, 0.3, 0.26, 0.27, 0.62, 0.72, 0.72, 0.7, 0], [3.4, 3.4, 3.2, 3.1, 2.5, 2.1, 1.7, 0.6, 0.02, 0], 28
    )
    return _scene(
        [
            _put(_plane(60, "#cfa98a"), Material("flat", ambient=0.42, diffuse=0.55, specular=0, shininess=1)),
            _put(shapes.sphere(), dull, "#d9482b", (-1.55, 0.85, -1.7), scale=0.85),
            _put(shapes.cylinder(), dull, "#f0b43c", (1.5, 0.9, -2.2)),
            _put(bottle, clear, "#2f8f6b", (0.1, 0, -0.4), opacity=0.42),
            _put(bottle, clear, "#3f6fb0", (2.35, 0, 0.1), scale=0.8, opacity=0.42),
            _put(_tumbler(), clear, "#e8f4ff", (-1.75, 0, 0.7), opacity=0.3),
            _put(shapes.sphere(), clear, "#c86ba8", (0.9, 0.42, 1.5), scale=0.42, opacity=0.5),
            _put(shapes.sphere(), clear, "#8fd0e8", (-0.35, 0.34, 1.9), scale=0.34, opacity=0.45),
        ],
        Camera.perspective((0.5, 2.9, 9.2), (0.2, 1.25, 0), fov=29),
        [Light.directional((-0.5, 0.75, 0.6), "#fff0dc"), Light.directional((0.9, 0.4, -0.5), "#ffb070")],
        Background("#f3ddc4"),
        ambient_light="#f4e4d8",
        fog=Fog("#f3ddc4", 9.5, 30),
        rim=Rim("#ffffff", 3),
    )


def _tumbler() -> Mesh:
    return _lathe([0.62, 0.5, 0.48, 0], [1.7, 0.06, 0, 0], 28)


# ---- fog ----


def forest() -> Scene:
    """Return firs on a slope, paler and paler in the fog of a morning."""
    rng = np.random.default_rng(8)
    bark = Material("flat", ambient=0.5, diffuse=0.6, specular=0, shininess=1)
    depth = np.concatenate([np.linspace(-3, -34, 64), [3.2, 1.8]])
    side = np.concatenate([rng.uniform(-1, 1, 64) * (3.5 - 0.36 * depth[:-2]), [-3.3, 3.1]])
    trees = [_fir(rng, x, _hill(x, z), z) for x, z in zip(side, depth, strict=True)]
    xs, zs = np.linspace(-26, 26, 25), np.linspace(-44, 9, 25)
    z, x = np.meshgrid(zs, xs, indexing="ij")
    land = modelling_grid(xs, zs, _hill(x, z))
    return _scene(
        [_put(shapes.joined(*trees), bark), _put(land, bark, "#6f7f4f")],
        Camera.perspective((0, 2.6, 10), (0, 2.75, 0), fov=42),
        [Light.directional((-0.9, 0.55, -0.35), "#ffd9a0")],
        Background("#8fb4cf", "#fbf3e4"),
        ambient_light="#8694a8",
        hemisphere=Hemisphere("#54708a", "#202818"),
        fog=Fog("#cbd9df", 7, 40),
    )


def _hill(x: ArrayLike, z: ArrayLike) -> Array:
    x, z = np.asarray(x), np.asarray(z)
    return 0.5 * np.sin(0.31 * x + 0.4) * np.cos(0.23 * z) - 0.03 * z + 0.004 * x**2 - 0.6


def _fir(rng: np.random.Generator, x: float, y: float, z: float) -> Mesh:
    size, turn = rng.uniform(1.6, 3.1), rng.uniform(0, 6)
    parts = [_cone(0.13, 0.16, 0.0, 0.3, 5, "#4a3626", turn)]
    for level, (reach, low, high) in enumerate(((0.5, 0.2, 0.62), (0.4, 0.42, 0.82), (0.27, 0.65, 1.05))):
        parts.append(_cone(0, reach, low, high, 7, ("#2c5a3c", "#346b45", "#3f7d4e")[level], turn + level))
    mesh = shapes.joined(*parts)
    return Mesh(size * mesh.positions * (0.8, 1, 0.8) + (x, y - 0.05, z), mesh.faces, mesh.colors)


def _cone(top: float, bottom: float, low: float, high: float, sides: int, color: str, turn: float) -> Mesh:
    """Return the side of a cone, cut off at the top unless that is a tip."""
    angle = turn + 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.cos(angle), 0 * angle, -np.sin(angle)], axis=1)
    k = np.arange(sides)
    following = (k + 1) % sides
    points = np.concatenate([bottom * ring + (0, low, 0), top * ring + (0, high, 0)])
    faces = [np.stack([k, following, sides + k], axis=1)]
    if top:
        faces.append(np.stack([following, sides + following, sides + k], axis=1))
    else:
        points = np.concatenate([points[:sides], [(0, high, 0)]])
        faces = [np.stack([k, following, 0 * k + sides], axis=1)]
    return painted(Mesh(points, np.concatenate(faces)), color)


# ---- rim ----


def skull() -> Scene:
    """Return the icon of a skull in the dark, outlined by light from behind."""
    scene = _piece("icons/skull", azimuth=-32, elevation=6, margin=0.1)
    right, up, back = view_axes(-32, 6)
    return evolve(
        scene,
        objects=[_lit(o, 0.1, 0.6) for o in scene.objects],
        lights=[Light.directional(0.8 * right + 0.5 * up + 0.3 * back, "#ff8a4a")],
        background=Background("#0b0e1a", "#1c1230"),
        rim=Rim("#58c4ff", 2),
        ambient_light="#8090c0",
        tone=Tone(1.1, filmic=True, gamma=True),
    )


def _lit(o: Object, ambient: float, diffuse: float) -> Object:
    return evolve(o, material=evolve(o.material, ambient=ambient, diffuse=diffuse))


def _piece(name: str, **look: object) -> Scene:
    """Return a piece of another dataset on the canvas of the showcase."""
    return look_at(require(name).make(), {"size": SIZE, "antialias": True, **look})


# ---- Genesis ----


def genesis() -> Scene:
    """Return a piece of Genesis, antialiased; it is lit as its contract draws it."""
    return _piece("genesis/21")


# ---- turntable ----


def rocket() -> Scene:
    """Return the icon of a rocket; the Turntable contract makes the frames."""
    return look_at(
        require("icons/rocket").make(),
        {
            "size": (180, 135),
            "antialias": True,
            "margin": 0.16,
            "rim": Rim("#6f8cff", 3),
            "ambient_light": (200, 205, 255),
        },
    )


# ---- tone ----


def knot() -> Scene:
    """Return a knot in bright coloured lights, added up in linear space and compressed as on film."""
    porcelain = Material("smooth", ambient=0.04, diffuse=0.9, specular=0.9, shininess=60)
    return _scene(
        [_put(shapes.torus_knot(2, 3, 0.2, 120, 14), porcelain, "#f4efe8")],
        Camera.perspective((0, 0.5, 5.6), (0, 0, 0), fov=27),
        [
            Light.directional((-0.9, 0.6, 0.5), "#ff5a3c"),
            Light.directional((0.9, 0.4, 0.5), "#3c7bff"),
            Light.directional((0.1, 0.9, 0.2), "#ffe9c8"),
        ],
        Background("#191724", "#3a3048"),
        tone=Tone(1.9, filmic=True, gamma=True),
    )


# ---- hemisphere ----


def plaster() -> Scene:
    """Return solids of plaster under a blue sky, on warm ground that shines back."""
    chalk = Material("smooth", ambient=0.75, diffuse=0.5, specular=0, shininess=1)
    facets = evolve(chalk, shading="flat")
    color = "#f2efe9"
    return _scene(
        [
            _put(_plane(60, "#e2b07a"), Material("flat", ambient=0.75, diffuse=0.5, specular=0, shininess=1)),
            _put(shapes.torus(), chalk, color, (-2.1, 1.0, -0.2), (90, 0, 0)),
            _put(shapes.dodecahedron(), facets, color, (0.15, 0.98, -0.8), (10, 20, 0), 1.2),
            _put(shapes.cone(), chalk, color, (2.3, 0.9, -0.3)),
            _put(shapes.sphere(), chalk, color, (-0.85, 0.55, 1.5), scale=0.55),
            _put(shapes.superellipsoid(), chalk, color, (1.05, 0.62, 1.5), (0, 35, 0), 0.62),
        ],
        Camera.perspective((0, 3.0, 9.6), (0.05, 0.85, 0), fov=28),
        [Light.directional((-0.6, 0.8, 0.35), "#fff3dc")],
        Background("#cfe0ee"),
        ambient_light="#202020",
        hemisphere=Hemisphere("#a8c4ea", "#b0763c"),
        fog=Fog("#cfe0ee", 10, 32),
        tone=Tone(1.0, gamma=True),
    )


# ---- wires ----


def wires() -> Scene:
    """Return a range of hills as a net of wires that fades into the night, before a low sun."""
    rng = np.random.default_rng(3)
    xs, zs = np.linspace(-14, 14, 29), np.linspace(-26, 6, 33)
    z, x = np.meshgrid(zs, xs, indexing="ij")
    valley = np.clip(np.abs(x) / 7 - 0.35, 0, 1) ** 1.5
    height = valley * (1.6 + 1.2 * np.sin(0.9 * x + 0.5 * z) + rng.uniform(-0.8, 1.2, x.shape))
    hills = painted(modelling_grid(xs, zs, height), "#ff5fa8")
    angle = 2 * np.pi * np.arange(64) / 64
    rim = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    k = np.arange(64)
    disc = Mesh(np.concatenate([[(0, 0, 0)], rim]), np.stack([0 * k, 1 + k, 1 + (k + 1) % 64], axis=1))
    sun = shapes.shaded(disc, "#ff2f7e", "#ffd25a")
    return _scene(
        [
            Object(sun, (0, 4.6, -40), scale=7.5, material=UNLIT),
            Object(hills, material=UNLIT, wireframe=True),
        ],
        Camera.perspective((0, 2.0, 9.5), (0, 2.3, 0), fov=40),
        [],
        Background("#0d0630", "#4a1060"),
    )


# ---- the Cornell box ----


def cornell_box() -> Scene:
    """Return the Cornell box, its light added up in linear space."""
    return evolve(_piece("cornell-box"), tone=Tone(0.9, filmic=True, gamma=True))


# ---- crystals ----


def shell() -> Scene:
    """Return a seashell under a hazy sky, outlined against the sea."""
    pearl = Material("smooth", ambient=0.35, diffuse=0.7, specular=0.6, shininess=40)
    scene = look_at(require("seashell").make(), {"size": SIZE, "antialias": True, "margin": 0.1})
    return evolve(
        scene,
        objects=[evolve(o, material=pearl) for o in scene.objects],
        background=Background("#173a4a", "#7fb4b4"),
        ambient_light="#404040",
        hemisphere=Hemisphere("#9cc4d4", "#c89060"),
        rim=Rim("#ffd9b0", 4),
        tone=Tone(1.0, gamma=True),
    )
