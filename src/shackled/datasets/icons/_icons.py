"""The icons, in the order in which they are listed: solids with a pose, a light and a background."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike

from ...base.checks import Floats
from ...scene._camera import Camera
from ...scene._effects import Background
from ...scene._light import Light
from ...scene._look import stage
from ...scene._object import Material, Object
from ...scene._packed import NORMAL_UNIT
from ...scene._scene import Scene
from ...scene._staging import view_axes
from .._pieces import Piece
from .modelling import (
    Solid,
    Where,
    above,
    around,
    below,
    bevelled_box,
    both,
    box,
    cone,
    cylinder,
    from_axis,
    icosphere,
    link,
    loft,
    pixels,
    prism,
    revolve,
    shared,
    sphere,
    sweep,
    torus,
    tube,
    union,
)
from .outlines import arc, chamfered, regular, star, stroke

GOLD, BRASS, STEEL, INK = "#f0a818", "#f5b324", "#b4bfcc", "#1a1420"

DULL = Material("smooth", ambient=0.42, diffuse=0.68, specular=0, shininess=10)
GLOSSY = Material("smooth", ambient=0.4, diffuse=0.66, specular=0.5, shininess=36)
METAL = Material("smooth", ambient=0.42, diffuse=0.68, specular=0.6, shininess=24)
FACETED = Material("flat", ambient=0.44, diffuse=0.68, specular=0.3, shininess=16)
SPARKLING = Material("flat", ambient=0.58, diffuse=0.54, specular=0.4, shininess=10)

#: Toward the light, right, up and toward the viewer: from the upper left, low enough for upright objects.
LIGHT = (-0.45, 0.5, 0.9)
#: `half_height` of the camera: a long lens, with little perspective distortion.
LENS = 0.2
#: Edges are sharp where a surface turns by more than these degrees.
CREASE = 42.0

Model = Callable[[], Solid]
#: All icons, in the order of their functions.
ICONS: list[Piece] = []


def icon(
    title: str,
    top: str,
    bottom: str,
    material: Material = DULL,
    *,
    view: tuple[float, float] = (20, 12),
    turn: ArrayLike = (0, 0, 0),
    light: ArrayLike = LIGHT,
    margin: float = 0.06,
    licence: str = "MIT",
    crease: float = CREASE,
) -> Callable[[Model], Model]:
    """Add an icon to `ICONS`, named as the function that models it.

    top, bottom: the colours of the background. view: azimuth and elevation of the viewer; turn: of the model about x, y
    and z; all in degrees. light: direction toward the only light, in the directions right, up and toward the viewer.
    margin: as in `load`. crease: as in `Solid.mesh`.
    """

    def decorated(model: Model) -> Model:
        def scene() -> Scene:
            staged = stage(
                model().mesh(crease if material.shading == "smooth" else None),
                material=material,
                rotate=turn,
                azimuth=view[0],
                elevation=view[1],
                half_height=LENS,
                margin=margin,
                background=Background(top, bottom),
                lights=Light("directional", np.asarray(light) @ np.stack(view_axes(*view))),
                cull=True,
            )
            return evolve(staged, objects=_cheaper(staged.objects[0], staged.camera))

        ICONS.append(Piece(f"icons/{model.__name__}", "icons", title, licence, scene))
        return model

    return decorated


def _cheaper(o: Object, camera: Camera) -> list[Object]:
    """Return objects that look the same and cost less gas.

    The nearest triangles come first, since what they hide is not lit; flat parts are separated, since they need no
    normals.
    """
    faces = o.mesh.faces
    distance = np.linalg.norm(o.world_positions() - camera.eye, axis=1)[faces].mean(axis=1)
    order = np.argsort(distance, kind="stable")
    if o.mesh.normals is None:
        return [evolve(o, mesh=evolve(o.mesh, faces=faces[order]))]
    positions, colors, normals = (each[faces[order]] for each in (o.mesh.positions, o.mesh.colors, o.mesh.normals))
    flat = np.abs(normals - normals[:, :1]).max(axis=(1, 2)) < 1 / NORMAL_UNIT
    parts = []
    if flat.any():
        material = evolve(o.material, shading="flat")
        parts.append(evolve(o, mesh=shared(positions[flat], colors[flat]), material=material))
    if not flat.all():
        parts.append(evolve(o, mesh=shared(positions[~flat], colors[~flat], normals[~flat])))
    flat_is_nearer = flat.any() and distance[order[flat]].mean() < distance.mean()
    return parts if flat_is_nearer else parts[::-1]


def ring(outline: Floats, y: float, scale: float = 1) -> Floats:
    """Return a polygon (n, 2) around the y axis, (n, 3)."""
    return np.column_stack([scale * outline[:, 0], np.full(len(outline), y), scale * outline[:, 1]])


def socket(radius: float, depth: float, segments: int) -> Solid:
    """Return a lens in the x-y plane, for eyes."""
    return revolve([(0, -depth), (radius, 0), (0, depth)], segments).turned(x=90)


@icon("Ether", "#0f0b2e", "#32277a", SPARKLING, view=(24, 8))
def ethereum() -> Solid:
    """Model an octahedron, cut in two below its waist."""
    upper, lower = (
        loft([ring(regular(4), y, scale) for scale, y in profile])
        for profile in (
            [(0.0, 1.15), (0.74, 0.07), (0.74, 0.02), (0.0, -0.34)],
            [(0.0, -0.56), (0.74, -0.16), (0.74, -0.21), (0.0, -1.15)],
        )
    )
    top = upper.painted("#e6ebff").painted("#9fb0f2", lambda at: at[:, 0] > 0).painted("#5a66c8", below(0))
    bottom = lower.painted("#cdd6ff").painted("#8797f0", lambda at: at[:, 0] > 0)
    return top + bottom.painted("#3a3f94", lambda at: np.abs(at[:, 1] + 0.3) < 0.05)


@icon("Coin", "#123c3a", "#2f8f7f", METAL, view=(0, 0), turn=(-14, -28, 0))
def coin() -> Solid:
    """Model a gold coin with a B of two strokes."""
    profile = [(0, -0.09), (0.8, -0.09), (0.86, -0.15), (1, -0.15), (1, 0.15), (0.86, 0.15), (0.8, 0.09), (0, 0.09)]
    disc = revolve(profile, 30).turned(x=90).painted(GOLD)
    disc = disc.painted("#c47f0c", lambda at: np.hypot(at[:, 0], at[:, 1]) < 0.79)
    upper = np.vstack([[(-0.26, 0.48)], arc(0.22, 90, -90, 6, (0.08, 0.26)), [(-0.26, 0.04)]])
    lower = np.vstack([[(-0.26, 0.0)], arc(0.24, 90, -90, 6, (0.12, -0.24)), [(-0.26, -0.48)]])
    lines = [upper, lower, np.array([(-0.24, -0.48), (-0.24, 0.48)])]
    ticks = [[(x, y), (x, 1.34 * y)] for x in (-0.1, 0.1) for y in (0.5, -0.5)]
    letter = [prism(stroke(line, 0.15), 0.16) for line in lines] + [prism(stroke(t, 0.11), 0.16) for t in ticks]
    return disc + union(*letter).moved(z=0.11).painted("#fff0b0")


@icon("Chain", "#3a1418", "#a8483c", METAL, view=(0, 0), turn=(0, 0, 40))
def chain() -> Solid:
    """Model three links of steel, the middle one of gold."""
    one = link(1.15, 0.56, 0.15, 4, 8)
    side = one.turned(x=52).painted(STEEL)
    return side.moved(x=-0.98) + one.turned(x=-38).painted(GOLD) + side.moved(x=0.98)


@icon("Ball and shackle", "#5c2f18", "#e0b070", METAL, view=(0, 12))
def shackle() -> Solid:
    """Model a ball of iron, a chain, and the shackle for an ankle."""
    ball = sphere(0.66, 11, 8).painted("#343944").moved(x=-0.5, y=-0.24)
    small = link(0.5, 0.3, 0.088, 3, 5).painted(STEEL)
    places = [(-0.36, 0.5, 84, 60), (-0.12, 0.84, 34, -30), (0.28, 0.88, -26, 60), (0.58, 0.58, -64, -30)]
    links = [small.turned(x=roll).turned(z=turn).moved(x, y) for x, y, turn, roll in places]
    section = [(0.43, -0.2), (0.54, -0.2), (0.54, 0.2), (0.43, 0.2)]
    cuff = revolve(section, 15, closed=True).painted("#7c8798").turned(x=28, z=-18).moved(x=0.76, y=0.0)
    return union(ball, cuff, *links)


@icon("Padlock", "#20324f", "#6f93bd", METAL, view=(20, 10))
def padlock() -> Solid:
    """Model a brass padlock, shut."""
    body = prism(chamfered(1.5, 1.2, 0.16), 0.62, 0.08).painted(GOLD).moved(y=-0.45)
    path = np.vstack([[(0.47, -0.1)], arc(0.47, 0, 180, 8, (0, 0.52)), [(-0.47, -0.1)]])
    shackle = tube(np.column_stack([path, 0 * path[:, 0]]), 0.13, 9).painted("#d3dae2")
    hole = prism(regular(10, 0.17), 0.06).moved(y=-0.36)
    slot = prism([(-0.06, -0.75), (0.06, -0.75), (0.04, -0.4), (-0.04, -0.4)], 0.058).scaled(x=1.9)
    plate = (hole + slot).moved(z=0.31).painted("#3a2408")
    return union(body, shackle, plate)


@icon("Key", "#4a1e3c", "#c77a9a", METAL, view=(0, 0), turn=(0, -22, 45))
def key() -> Solid:
    """Model an old key of gold."""
    bow = torus(0.42, 0.12, 18, 7).turned(x=90).moved(x=-0.86)
    shaft = cylinder(0.115, 1.5, 10).turned(z=90).moved(x=0.3)
    collars = [cylinder(0.19, 0.12, 10).turned(z=90).moved(x=x) for x in (-0.36, -0.12)]
    bits = [box(0.17, 0.48, 0.13).moved(0.92, -0.26), box(0.17, 0.36, 0.13).moved(0.62, -0.2)]
    tip = sphere(0.15, 10, 6).moved(x=1.05)
    return union(bow, shaft, tip, *collars, *bits).painted("#ffc53a")


@icon("Block", "#0f2a33", "#3c8f86", FACETED, view=(36, 24), light=(0, 0.4, 1))
def block() -> Solid:
    """Model a block with a face on each side."""
    cube = bevelled_box(2, 2, 2, 0.14).painted("#ffb52e")
    cube = cube.painted("#ff7a5c", lambda at: np.abs(at[:, 0]) > 0.99)
    cube = cube.painted("#5bd1c4", lambda at: np.abs(at[:, 1]) > 0.99)
    eye = box(0.26, 0.5, 0.06).painted("#2a1b2e").moved(y=0.22)
    eyes = eye.moved(x=-0.42) + eye.moved(x=0.42)
    smile = prism(stroke(arc(0.5, 205, 335, 6, (0, -0.08)), 0.14), 0.06).painted("#2a1b2e")
    mouth = prism(regular(10, 0.24), 0.06).painted("#2a1b2e").moved(y=-0.42)
    shut = prism(stroke(arc(0.22, 20, 160, 4), 0.13), 0.06).painted("#2a1b2e").moved(y=0.1)
    sleep = union(shut.moved(x=-0.42), shut.moved(x=0.42), box(0.4, 0.13, 0.06).painted("#2a1b2e").moved(y=-0.42))
    happy, amazed, asleep = (face.moved(z=1) for face in (eyes + smile, eyes + mouth, sleep))
    sides = [happy.turned(y=turn) for turn in (0, 180)] + [amazed.turned(y=turn) for turn in (90, -90)]
    return union(cube, *sides, *(asleep.turned(x=turn) for turn in (90, -90)))


@icon("Diamond", "#2a1a4a", "#8a4fa0", SPARKLING, view=(0, 18), turn=(0, 8, 0))
def diamond() -> Solid:
    """Model a cut stone."""
    levels = [(0.62, 0.62, 22.5), (1.0, 0.22, 0), (0.98, 0.14, 0), (0.46, -0.42, 22.5), (0, -1.05, 0)]
    stone = loft([ring(regular(8, radius, start), y) for radius, y, start in levels]).painted("#7fe3f5")
    tints = (("#8fe9ff", "#6fd8ff"), ("#4fc0ea", "#38a4e4"), ("#c4f7ff", "#9fe8ff"), ("#39a9e0", "#2788d0"))
    for number, (light, dark) in enumerate(tints):
        stone = stone.painted(light, _facets(number)).painted(dark, _facets(number, top=0.13))
    return stone.painted("#e8feff", above(0.61))


def _facets(number: int, top: float = 1) -> Where:
    """Select every fourth of the sixteen facets around a stone, up to that height."""
    return lambda at: (np.rint(np.arctan2(at[:, 2], at[:, 0]) * 8 / np.pi) % 4 == number) & (at[:, 1] < top)


@icon("Crystals", "#0d2430", "#2f6f78", FACETED, view=(0, 10))
def crystals() -> Solid:
    """Model a cluster of crystals on a rock."""

    def crystal(height: float, radius: float) -> Solid:
        levels = [(0.8 * radius, 0), (radius, 0.72 * height), (0, height)]
        return loft([ring(regular(6), y, scale) for scale, y in levels]).shaded("#7a1fc4", "#ff9df0")

    grown = [
        crystal(2.1, 0.36).turned(y=20, z=-3),
        crystal(1.6, 0.3).turned(y=40, z=24).moved(x=-0.2),
        crystal(1.5, 0.29).turned(z=-27).moved(x=0.22),
        crystal(1.0, 0.24).turned(y=10, z=52).moved(x=-0.3, z=0.1),
        crystal(1.0, 0.22).turned(x=30, z=-52).moved(x=0.3, z=0.1),
        crystal(0.95, 0.25).turned(x=34, z=-8).moved(x=0.05, z=0.25),
    ]
    levels = [(0.7, -0.2, 0), (0.86, 0.0, 20), (0.55, 0.2, 10), (0, 0.26, 0)]
    rock = loft([ring(regular(9, radius, start), y) for radius, y, start in levels])
    return union(*grown, rock.scaled(z=0.8).painted("#5a6472"))


@icon("Crown", "#1d1450", "#5f50b8", FACETED, view=(0, 16))
def crown() -> Solid:
    """Model a crown of seven points."""
    points, zigzag = 7, np.tile([0.62, 0.08], 7)

    def wall(radius: float, top: float) -> list[Floats]:
        low, high = (ring(regular(2 * points, reach, 90), -0.55) for reach in (radius, top))
        high[:, 1] = zigzag
        return [low, high]

    outer, inner = wall(0.86, 1.0), wall(0.78, 0.92)
    body = loft([*outer, *inner[::-1]], closed=True).painted("#ffc42e")
    band = revolve([(0.8, -0.62), (0.94, -0.62), (0.94, -0.36), (0.8, -0.36)], 14, closed=True).painted("#d98c12")
    ball = sphere(0.13, 6, 4).painted("#f0284a").moved(x=0.96, y=0.68)
    jewel = loft([ring(regular(4), y, scale) for scale, y in ((0, -0.12), (0.12, 0), (0, 0.12))])
    jewel = jewel.scaled(x=0.5).moved(x=0.93, y=-0.49)
    red, blue = jewel.painted("#ff2d4a"), jewel.painted("#2ad0ff")
    jewels = union(*((red if i % 2 else blue).turned(y=360 * i / 14) for i in range(14)))
    return union(body, band, around(ball, points, -90), jewels)


@icon("Trophy", "#16233f", "#4c6a9c", METAL, view=(0, 18))
def trophy() -> Solid:
    """Model a cup of gold."""
    profile = [(0, 0.1), (0.34, 0.14), (0.56, 0.42), (0.64, 1.15), (0.7, 1.2), (0.62, 1.2), (0.5, 0.5), (0, 0.3)]
    cup = revolve(profile, 16).painted(BRASS)
    stem = revolve([(0.34, -0.5), (0.3, -0.42), (0.1, -0.3), (0.1, 0.02), (0.2, 0.16)], 12).painted("#d98c12")
    foot = bevelled_box(0.9, 0.34, 0.9, 0.06).moved(y=-0.64).painted("#3b2417")
    handle = [(0.56, 1.02, 0), (0.86, 1.06, 0), (1.02, 0.86, 0), (0.92, 0.58, 0), (0.66, 0.44, 0), (0.46, 0.42, 0)]
    one = tube(handle, 0.075, 6).painted("#d98c12")
    badge = prism(star(5, 0.24, 0.1), 0.1).painted("#fffbe6").moved(y=0.74, z=0.62)
    return union(cup, stem, foot, one, one.mirrored(), badge)


@icon("Sword", "#2b1414", "#8a3b2e", METAL, view=(0, 0), turn=(0, 24, -42), margin=0.04, crease=30)
def sword() -> Solid:
    """Model a sword with a gem in its pommel."""
    section = np.array([(0.21, 0.0), (0.0, 0.06), (-0.21, 0.0), (0.0, -0.06)])
    blade = loft([ring(section, y, scale) for scale, y in ((1.0, -0.3), (0.86, 1.35), (0.0, 1.75))])
    blade = blade.painted("#dfe7f0").painted("#9fb0c4", lambda at: at[:, 0] > 0)
    left = [(-0.4, -0.34), (-0.58, -0.26), (-0.55, -0.42), (-0.4, -0.5)]
    right = [(0.4, -0.5), (0.55, -0.42), (0.58, -0.26), (0.4, -0.34)]
    guard = prism([*left[2:], *right, *left[:2]], 0.22, 0.04)
    grip = cylinder(0.085, 0.6, 8).painted("#5a2f1a").moved(y=-0.78)
    wraps = [torus(0.085, 0.03, 8, 4).painted("#2b150b").moved(y=y) for y in (-0.64, -0.78, -0.92)]
    pommel = sphere(0.16, 8, 6).painted(BRASS).moved(y=-1.14)
    gem = sphere(0.09, 6, 4).painted("#ff2d4a").moved(y=-1.14, z=0.12)
    return union(blade, guard.painted(BRASS), grip, *wraps, pommel, gem)


@icon("Hourglass", "#1c3a3a", "#79a89a", GLOSSY, view=(20, 10))
def hourglass() -> Solid:
    """Model an hourglass, half run down."""
    half = [(0.07, 0.0), (0.16, 0.12), (0.5, 0.46), (0.56, 0.6), (0.5, 0.98)]
    glass = revolve([(r, -y) for r, y in half[:0:-1]] + half, 14).painted("#cfeef5")
    glass = glass.painted("#f2b84b", lambda at: (at[:, 1] < 0.47) & (at[:, 1] > -0.02) | (at[:, 1] < -0.5))
    plate = cylinder(0.78, 0.16, 14).painted("#8a4b20")
    post = cylinder(0.07, 2.1, 6).painted("#b8692f").moved(x=0.64)
    return union(glass, plate.moved(y=1.04), plate.moved(y=-1.04), around(post, 4, 45))


@icon("Bell", "#3a2a5c", "#9a7fc4", METAL, view=(0, -6), turn=(0, 0, 14))
def bell() -> Solid:
    """Model a bell that swings."""
    profile = [(0.0, 0.74), (0.26, 0.7), (0.44, 0.5), (0.52, 0.1), (0.62, -0.3), (0.88, -0.6), (0.88, -0.7)]
    shell = revolve([*profile, (0.74, -0.7), (0.0, -0.4)], 20).painted(BRASS)
    shell = shell.painted("#7a4a08", lambda at: (at[:, 1] < -0.45) & (from_axis(at) < 0.7))
    clapper = sphere(0.22, 10, 6).moved(x=-0.08, y=-0.86).painted("#b86a08")
    loop = torus(0.17, 0.07, 10, 6).turned(x=90).moved(y=0.86).painted("#d98c12")
    return union(shell, clapper, loop)


@icon("Skull", "#3a0d2e", "#a02f5f", DULL, view=(18, 4))
def skull() -> Solid:
    """Model a skull."""
    bone = "#f3ead2"
    cranium = icosphere(1, 2).scaled(0.92, 0.84, 1.0).moved(y=0.32, z=-0.12).painted(bone)
    cheeks = bevelled_box(1.16, 0.62, 0.9, 0.14).painted(bone).moved(y=-0.34, z=0.36)
    jaw = bevelled_box(0.86, 0.36, 0.66, 0.1).painted("#e4d8ba").moved(y=-0.86, z=0.4)
    eye = socket(0.26, 0.11, 12).scaled(y=1.1).turned(x=6, y=20).painted(INK).moved(0.36, 0.13, 0.75)
    nose = prism([(-0.13, -0.32), (0.13, -0.32), (0, -0.08)], 0.1).painted(INK).moved(z=0.82)
    teeth = [box(0.035, 0.3, 0.06).painted(INK).moved(x, -0.7, 0.8) for x in (-0.24, -0.08, 0.08, 0.24)]
    line = box(0.66, 0.04, 0.06).painted(INK).moved(y=-0.7, z=0.79)
    return union(cranium, cheeks, jaw, both(eye), nose, line, *teeth)


@icon("Pixel head", "#2b5fb0", "#9fd0f0", FACETED, view=(26, 10))
def head() -> Solid:
    """Model a head in pixels, with a cap and headphones."""
    palette = {"s": "#c98a5e", "d": "#a86a44", "c": "#e8413c", "w": "#ffffff", "k": INK, "m": "#7a2f2a"}
    skull = pixels(["ssssssssss"] * 9, palette, 8)
    features = pixels(
        [
            " wkk  wkk ",
            " wkk  wkk ",
            "          ",
            "    dd    ",
            "    dd    ",
            "  m    m  ",
            "   mmmm   ",
        ],
        palette,
        1,
    ).moved(y=-0.9, z=4)
    cap = pixels(["  cccccc  ", " cccccccc ", "cccccccccc"], palette, 9.4).moved(y=5.8)
    brim = box(11, 1, 4).painted("#a8242a").moved(y=4.2, z=5)
    neck = box(5, 3, 5).painted("#a86a44").moved(y=-5.6)
    shirt = pixels([" ffffffffff ", "ffffffffffff"], {"f": "#3b3f8f"}, 6).moved(y=-7.6)
    ear = bevelled_box(1.8, 4.4, 4.4, 0.8).painted("#f4f4f4").moved(x=5.7)
    ear += box(0.4, 2, 2).painted("#23c4b0").moved(x=6.5)
    band = prism(stroke(arc(6.1, 0, 180, 8) * (1, 1.28), 1.0), 1.6).painted("#f4f4f4")
    return union(skull, features, cap, brim, neck, shirt, both(ear), band).scaled(0.1, 0.1, 0.1)


@icon("Glasses", "#f0e0b8", "#d8b06a", FACETED, view=(30, 14), margin=0.04, licence="CC0")
def glasses() -> Solid:
    """Model square glasses in pixels, after the noggles, which are in the public domain."""
    front = pixels(
        [
            "rrrrrr rrrrrr",
            "rwwkkr rwwkkr",
            "rwwkkrrrwwkkr",
            "rwwkkr rwwkkr",
            "rwwkkr rwwkkr",
            "rrrrrr rrrrrr",
        ],
        {"r": "#e0283a", "w": "#ffffff", "k": INK},
        1.2,
    )
    arm = box(1, 1, 7).moved(x=7, y=0.5, z=-3.6) + box(1, 2, 1).moved(x=7, y=-0.99, z=-6.6)
    hinge = box(1, 1, 1.2).moved(x=7, y=0.5)
    return union(front, both((arm + hinge).painted("#e0283a"))).scaled(0.1, 0.1, 0.1)


@icon("Cat", "#e8a04a", "#f7d9a0", DULL, view=(22, 10))
def cat() -> Solid:
    """Model a black cat that sits and waits."""
    fur, light = "#3a3f52", "#f2f2f2"
    body = revolve([(0, -1.1), (0.5, -1.08), (0.62, -0.8), (0.46, -0.2), (0.28, 0.2), (0, 0.3)], 12).painted(fur)
    chest = sphere(0.3, 6, 5).scaled(0.8, 1.3, 0.6).moved(y=-0.28, z=0.3).painted(light)
    skull = sphere(0.52, 10, 8).scaled(1.08, 0.9, 0.92).moved(y=0.5, z=0.16).painted(fur)
    ear = cone(0.24, 0.46, 4).turned(y=45).scaled(z=0.5).turned(z=-18).moved(0.33, 0.78, 0.14).painted(fur)
    inner = cone(0.14, 0.3, 3).turned(y=90).scaled(z=0.4).turned(z=-18).moved(0.33, 0.8, 0.24).painted("#f08fa0")
    eye = socket(0.14, 0.07, 8).moved(0.21, 0.55, 0.59).painted("#a8f04a")
    pupil = box(0.06, 0.2, 0.06).moved(0.21, 0.55, 0.645).painted(INK)
    muzzle = sphere(0.17, 6, 5).scaled(1.2, 0.7, 0.6).moved(y=0.34, z=0.58).painted(light)
    nose = prism([(-0.07, 0.05), (0.07, 0.05), (0, -0.04)], 0.1).moved(y=0.4, z=0.68).painted("#f08fa0")
    paw = sphere(0.2, 6, 4).scaled(0.9, 0.6, 1.2).moved(0.22, -1.04, 0.5).painted(light)
    tail = [(0.4, -1.0, -0.2), (0.8, -1.0, -0.1), (1.02, -0.78, 0), (0.98, -0.5, 0), (0.8, -0.36, 0), (0.78, -0.2, 0)]
    return union(
        body, chest, skull, both(union(ear, inner, eye, pupil, paw)), muzzle, nose, tube(tail, 0.12, 6).painted(fur)
    )


@icon("Robot", "#24304a", "#c8703c", METAL, view=(22, 8))
def robot() -> Solid:
    """Model a robot that waves."""
    shell, dark = "#9fd4e0", "#3a4a5f"
    skull = bevelled_box(1.3, 0.96, 0.96, 0.12).painted(shell).moved(y=0.62)
    screen = prism(chamfered(1.02, 0.62, 0.1), 0.08).painted("#14202e").moved(y=0.62, z=0.47)
    eye = cylinder(0.14, 0.1, 10).turned(x=90).painted("#ffe14a").moved(0.26, 0.7, 0.5)
    mouth = box(0.44, 0.08, 0.1).painted("#ff6a4a").moved(y=0.44, z=0.5)
    rod = cylinder(0.05, 0.36, 6).painted(dark).moved(y=1.22)
    lamp = sphere(0.13, 8, 6).painted("#ff3a4a").moved(y=1.46)
    ear = cylinder(0.2, 0.16, 8).turned(z=90).painted(dark).moved(x=0.7, y=0.62)
    neck = cylinder(0.22, 0.24, 8).painted(dark).moved(y=0.08)
    body = bevelled_box(1.1, 0.9, 0.7, 0.1).painted(shell).moved(y=-0.46)
    panel = box(0.6, 0.4, 0.06).painted("#f2f2f2").moved(y=-0.42, z=0.35)
    buttons = [
        box(0.11, 0.11, 0.06).painted(c).moved(x, -0.42, 0.38)
        for x, c in ((-0.18, "#ff3a4a"), (0, "#ffb52e"), (0.18, "#2fd07f"))
    ]
    down = tube([(0.56, -0.16, 0), (0.8, -0.4, 0.05), (0.82, -0.8, 0.2)], 0.11, 6).painted(dark)
    up = tube([(-0.56, -0.16, 0), (-0.86, -0.3, 0.1), (-1.02, 0.14, 0.2)], 0.11, 6).painted(dark)
    hands = [sphere(0.18, 6, 4).painted(shell).moved(*at) for at in ((0.82, -0.86, 0.22), (-1.04, 0.22, 0.22))]
    leg = box(0.3, 0.4, 0.4).painted(dark).moved(0.28, -1.06, 0.04)
    return union(
        skull, screen, both(eye), mouth, rod, lamp, both(ear), neck, body, panel, *buttons, down, up, *hands, both(leg)
    )


@icon("Heart", "#ffe3e6", "#f2a9b4", GLOSSY, view=(18, 6), crease=60)
def heart() -> Solid:
    """Model a heart, as on playing cards, but round."""
    # without the thin end of the curve
    t = np.linspace(0, 2 * np.pi, 32, endpoint=False)[np.r_[:14, 16, 19:32]]
    x = 16 * np.sin(t) ** 3
    y = 13 * np.cos(t) - 5 * np.cos(2 * t) - 2 * np.cos(3 * t) - np.cos(4 * t)
    outline = np.column_stack([x, np.maximum(y, -15.6) + 2]) / 16
    levels = [(0.0, 0.5), (0.4, 0.47), (0.72, 0.36), (0.92, 0.2), (1.0, 0.0)]
    rings = [np.column_stack([s * outline, np.full(len(t), z)]) for s, z in levels]
    back = [ring * (1, 1, -1) for ring in rings[-2::-1]]
    return loft([*rings, *back]).painted("#e8203a")


@icon("Lightning", "#1c1440", "#5d3fb0", FACETED, view=(24, 6))
def lightning() -> Solid:
    """Model a bolt of lightning."""
    bolt = [(0.1, 1.2), (-0.62, -0.12), (-0.08, -0.12), (-0.3, -1.2), (0.64, 0.28), (0.08, 0.28), (0.52, 1.2)]
    return prism(bolt, 0.36, 0.07).painted("#ffd52e").painted("#ff9d1e", lambda at: at[:, 2] < 0.17)


@icon("Mushroom", "#2f5a2f", "#a8cf6a", DULL, view=(14, 14))
def mushroom() -> Solid:
    """Model a red mushroom with white spots; not for eating."""
    cap = revolve([(0.0, 0.02), (0.7, 0.0), (0.98, 0.04), (1.0, 0.18), (0.86, 0.56), (0.52, 0.84), (0.0, 0.95)], 16)
    cap = cap.painted("#e02a2a").painted("#f2e2c4", below(0.03))
    stem = revolve([(0.4, -1.0), (0.36, -0.8), (0.26, -0.3), (0.3, 0.1)], 10).painted("#f7ecd4")
    skirt = revolve([(0.27, -0.12), (0.46, -0.32), (0.27, -0.26)], 9, closed=True).painted("#fff8e8")
    spot = revolve([(0.19, -0.06), (0.16, 0.03), (0, 0.06)], 8)
    middle = spot.turned(z=-32).moved(x=0.6, y=0.75)
    low = spot.turned(z=-66).moved(x=0.925, y=0.36)
    spots = union(spot.moved(y=0.94), around(middle, 4, 30), around(low, 5, -5)).painted("#ffffff")
    return union(cap, stem, skirt, spots)


@icon("Cactus", "#f2b06a", "#fbe0b0", DULL, view=(0, 12))
def cactus() -> Solid:
    """Model a cactus in a pot, in bloom."""
    section = star(8, 0.34, 0.25, 0)
    trunk = [(0, y, 0) for y in (-0.6, 0.5, 0.78, 0.94, 1.0)]
    stem = sweep(section, trunk, scales=[1, 1, 0.86, 0.5, 0.12]).painted("#2f9a4a")

    def arm(points: list[tuple[float, float]]) -> Solid:
        path = [(x, y, 0.0) for x, y in points]
        return tube(path, 0.19, 8, scales=[1] * (len(path) - 2) + [0.75, 0.2]).painted("#3aae58")

    left = arm([(-0.2, -0.1), (-0.52, -0.1), (-0.7, 0.06), (-0.72, 0.4), (-0.72, 0.54), (-0.72, 0.6)])
    right = arm([(0.2, 0.14), (0.48, 0.14), (0.66, 0.3), (0.68, 0.62), (0.68, 0.76), (0.68, 0.82)])
    profile = [(0.42, -1.2), (0.56, -0.72), (0.64, -0.72), (0.64, -0.52), (0.54, -0.52), (0.5, -0.6)]
    pot = revolve(profile, 14).painted("#c8552e")
    pot = pot.painted("#4a2a1a", lambda at: (at[:, 1] > -0.61) & (from_axis(at) < 0.5))
    petals = prism(star(8, 0.24, 0.17), 0.1).turned(x=-35).painted("#ff4f9a").moved(y=1.1, z=0.05)
    heart = sphere(0.1, 6, 4).painted("#ffe14a").moved(y=1.12, z=0.1)
    return union(stem, left, right, pot, petals, heart)


@icon("Rocket", "#0b1030", "#3d2f7a", GLOSSY, view=(0, 6), turn=(0, 30, -32))
def rocket() -> Solid:
    """Model a rocket on its way."""
    profile = [(0.26, -0.72), (0.42, -0.4), (0.47, 0.0), (0.4, 0.5), (0.24, 0.9), (0.0, 1.25)]
    hull = revolve(profile, 14).painted("#f2f4f8").painted("#f0383c", above(0.6))
    hull = hull.painted("#f0383c", lambda at: (at[:, 1] < -0.45) & (at[:, 1] > -0.7))
    window = torus(0.2, 0.05, 12, 5).turned(x=90).painted("#8a94a8").moved(y=0.22, z=0.43)
    pane = sphere(0.2, 10, 5).scaled(z=0.4).painted("#3ab4f5").moved(y=0.22, z=0.42)
    outline = [(0.3, -0.3), (0.36, -0.62), (0.78, -1.02), (0.84, -0.66), (0.62, -0.28), (0.42, -0.02)]
    fin = prism(outline, 0.1).painted("#d8242c")
    nozzle = cylinder(0.27, 0.16, 10, 0.2).painted("#4a5060").moved(y=-0.78)
    flame = revolve([(0.0, -1.75), (0.17, -1.2), (0.22, -1.0), (0.14, -0.84)], 10).shaded("#ff4a1e", "#ffe95a")
    return union(hull, window, pane, around(fin, 4, 45), nozzle, flame)


@icon("Ringed planet", "#050816", "#1d2350", DULL, view=(0, 16), turn=(0, 0, -22))
def planet() -> Solid:
    """Model a planet with a ring."""
    globe = sphere(0.72, 16, 10).painted("#c8743c")
    # from circle to circle of the sphere
    bands = ((-54, "#e8a45a"), (-36, "#f5cf8f"), (-18, "#d9884a"), (0, "#f5cf8f"), (18, "#e8a45a"), (54, "#c8743c"))
    for latitude, color in bands:
        globe = globe.painted(color, above(0.72 * np.sin(np.radians(latitude))))
    ring = revolve([(0.92, -0.02), (1.4, -0.02), (1.4, 0.02), (1.18, 0.02), (0.92, 0.02)], 24, closed=True)
    ring = ring.painted("#8fa8e0").painted("#d9e2ff", lambda at: from_axis(at) > 1.14)
    return globe + ring


@icon("Flying saucer", "#0a1a24", "#23566a", METAL, view=(0, 10), turn=(8, 0, -10))
def saucer() -> Solid:
    """Model a flying saucer."""
    profile = [(0.0, -0.3), (0.45, -0.26), (1.15, -0.02), (1.18, 0.06), (0.6, 0.24), (0.0, 0.26)]
    hull = revolve(profile, 20).painted("#b0bccb").painted("#6f7d92", below(-0.03))
    dome = revolve([(0.56, 0.2), (0.52, 0.42), (0.36, 0.62), (0.0, 0.72)], 14).painted("#7ff0e0")
    lamp = sphere(0.1, 6, 4).moved(x=0.9, y=0.17).painted("#ffe14a")
    beam = cylinder(0.85, 1.0, 14, 0.35).moved(y=-0.7).shaded("#23566a", "#d8ffb0")
    return union(hull, dome, around(lamp, 8, 22.5), beam)


@icon("Die", "#0f3d2a", "#2f9a63", FACETED, view=(36, 26), light=(-0.15, 0.4, 1))
def die() -> Solid:
    """Model a die; opposite faces add up to seven."""
    cube = bevelled_box(2, 2, 2, 0.2).painted("#f5f2ea")
    pip = prism(regular(7, 0.19), 0.04).painted("#c8182a")
    one, two, four = [(0.0, 0.0)], [(-0.5, 0.5), (0.5, -0.5)], [(-0.5, 0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, -0.5)]
    sides = [one, two, one + two, four, four + one, [*four, (-0.5, 0.0), (0.5, 0.0)]]
    turns = [(0, 0), (0, 90), (-90, 0), (90, 0), (0, -90), (0, 180)]
    pips = [pip.moved(*at, 1).turned(x, y) for places, (x, y) in zip(sides, turns, strict=True) for at in places]
    return union(cube, *pips)


@icon("Candlesticks", "#0c1220", "#26344f", FACETED, view=(-24, 10))
def candles() -> Solid:
    """Model five days of a market."""
    days = [(-0.9, -0.35), (-0.3, -0.75), (-0.7, 0.1), (-0.05, 0.75), (0.45, 1.15)]
    sticks = []
    for day, (opened, closed) in enumerate(days):
        color = "#2fd07f" if closed > opened else "#f2485a"
        middle, size = (opened + closed) / 2, abs(closed - opened)
        body = bevelled_box(0.46, size, 0.46, 0.05)
        sticks.append((body + box(0.1, size + 0.5, 0.1)).painted(color).moved(0.58 * (day - 2), middle))
    return union(*sticks)


def pieces() -> list[Piece]:
    """Return all icons."""
    return list(ICONS)
