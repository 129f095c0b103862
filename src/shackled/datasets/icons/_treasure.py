"""Icons of treasures and prizes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ._icon import FACETED, GLOSSY, METAL, SPARKLING, icon
from .modelling import (
    Solid,
    Where,
    above,
    around,
    bevelled_box,
    cylinder,
    from_axis,
    loft,
    prism,
    revolve,
    sphere,
    torus,
    tube,
    union,
)
from .outlines import regular, star

Points = NDArray[np.float64]

GOLD = "#f5b324"


def ring(sides: int, radius: float, y: float, start: float = 0) -> Points:
    """Return a regular polygon around the y axis, (sides, 3)."""
    corners = regular(sides, radius, start)
    return np.column_stack([corners[:, 0], np.full(sides, y), corners[:, 1]])


@icon("Diamond", "#2a1a4a", "#8a4fa0", SPARKLING, view=(0, 18), turn=(0, 8, 0))
def diamond() -> Solid:
    """Model a cut stone."""
    rings = [
        ring(8, 0.62, 0.62, 22.5),
        ring(8, 1.0, 0.22),
        ring(8, 0.98, 0.14),
        ring(8, 0.46, -0.42, 22.5),
        ring(8, 0, -1.05),
    ]
    stone = loft(rings).painted("#7fe3f5")
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
        rings = [ring(6, 0.8 * radius, 0), ring(6, radius, 0.72 * height), ring(6, 0, height)]
        return loft(rings).shaded("#7a1fc4", "#ff9df0")

    grown = [
        crystal(2.1, 0.36).turned(y=20, z=-3),
        crystal(1.6, 0.3).turned(y=40, z=24).moved(x=-0.2),
        crystal(1.5, 0.29).turned(z=-27).moved(x=0.22),
        crystal(1.0, 0.24).turned(y=10, z=52).moved(x=-0.3, z=0.1),
        crystal(1.0, 0.22).turned(x=30, z=-52).moved(x=0.3, z=0.1),
        crystal(0.95, 0.25).turned(x=34, z=-8).moved(x=0.05, z=0.25),
    ]
    rock = loft([ring(9, 0.7, -0.2), ring(9, 0.86, 0.0, 20), ring(9, 0.55, 0.2, 10), ring(9, 0, 0.26)])
    return union(*grown, rock.scaled(z=0.8).painted("#5a6472"))


@icon("Crown", "#1d1450", "#5f50b8", FACETED, view=(0, 16))
def crown() -> Solid:
    """Model a crown of seven points."""
    points, zigzag = 7, np.tile([0.62, 0.08], 7)

    def wall(radius: float, top: float) -> list[Points]:
        low = ring(2 * points, radius, -0.55, 90)
        high = ring(2 * points, top, 0, 90)
        high[:, 1] = zigzag
        return [low, high]

    outer, inner = wall(0.86, 1.0), wall(0.78, 0.92)
    body = loft([*outer, *inner[::-1]], closed=True).painted("#ffc42e")
    band = revolve([(0.8, -0.62), (0.94, -0.62), (0.94, -0.36), (0.8, -0.36)], 14, closed=True).painted("#d98c12")
    ball = sphere(0.13, 6, 4).painted("#f0284a").moved(x=0.96, y=0.68)
    jewel = loft([ring(4, 0, -0.12), ring(4, 0.12, 0), ring(4, 0, 0.12)]).scaled(x=0.5).moved(x=0.93, y=-0.49)
    red, blue = jewel.painted("#ff2d4a"), jewel.painted("#2ad0ff")
    jewels = union(*((red if i % 2 else blue).turned(y=360 * i / 14) for i in range(14)))
    return union(body, band, around(ball, points, -90), jewels)


@icon("Trophy", "#16233f", "#4c6a9c", METAL, view=(0, 18))
def trophy() -> Solid:
    """Model a cup of gold."""
    profile = [(0, 0.1), (0.34, 0.14), (0.56, 0.42), (0.64, 1.15), (0.7, 1.2), (0.62, 1.2), (0.5, 0.5), (0, 0.3)]
    cup = revolve(profile, 16).painted(GOLD)
    stem = revolve([(0.34, -0.5), (0.3, -0.42), (0.1, -0.3), (0.1, 0.02), (0.2, 0.16)], 12).painted("#d98c12")
    foot = bevelled_box(0.9, 0.34, 0.9, 0.06).moved(y=-0.64).painted("#3b2417")
    handle = [(0.56, 1.02, 0), (0.86, 1.06, 0), (1.02, 0.86, 0), (0.92, 0.58, 0), (0.66, 0.44, 0), (0.46, 0.42, 0)]
    one = tube(handle, 0.075, 6).painted("#d98c12")
    badge = prism(star(5, 0.24, 0.1), 0.1).painted("#fffbe6").moved(y=0.74, z=0.62)
    return union(cup, stem, foot, one, one.mirrored(), badge)


@icon("Bell", "#3a2a5c", "#9a7fc4", METAL, view=(0, -6), turn=(0, 0, 14))
def bell() -> Solid:
    """Model a bell that swings."""
    profile = [
        (0.0, 0.74),
        (0.26, 0.7),
        (0.44, 0.5),
        (0.52, 0.1),
        (0.62, -0.3),
        (0.88, -0.6),
        (0.88, -0.7),
        (0.74, -0.7),
        (0.0, -0.4),
    ]
    shell = revolve(profile, 20).painted(GOLD)
    shell = shell.painted("#7a4a08", lambda at: (at[:, 1] < -0.45) & (from_axis(at) < 0.7))
    clapper = sphere(0.22, 10, 6).moved(x=-0.08, y=-0.86).painted("#b86a08")
    loop = torus(0.17, 0.07, 10, 6).turned(x=90).moved(y=0.86).painted("#d98c12")
    return union(shell, clapper, loop)


@icon("Hourglass", "#1c3a3a", "#79a89a", GLOSSY, view=(20, 10))
def hourglass() -> Solid:
    """Model an hourglass, half run down."""
    half = [(0.07, 0.0), (0.16, 0.12), (0.5, 0.46), (0.56, 0.6), (0.5, 0.98)]
    glass = revolve([(r, -y) for r, y in half[:0:-1]] + half, 14).painted("#cfeef5")
    glass = glass.painted("#f2b84b", lambda at: (at[:, 1] < 0.47) & (at[:, 1] > -0.02) | (at[:, 1] < -0.5))
    plate = cylinder(0.78, 0.16, 14).painted("#8a4b20")
    post = cylinder(0.07, 2.1, 6).painted("#b8692f").moved(x=0.64)
    return union(glass, plate.moved(y=1.04), plate.moved(y=-1.04), around(post, 4, 45))


@icon("Sword", "#2b1414", "#8a3b2e", METAL, view=(0, 0), turn=(0, 24, -42), margin=0.04, crease=30)
def sword() -> Solid:
    """Model a sword with a gem in its pommel."""
    section = np.array([(0.21, 0.0), (0.0, 0.06), (-0.21, 0.0), (0.0, -0.06)])
    levels = [(1.0, -0.3), (0.86, 1.35), (0.0, 1.75)]
    blade = loft([np.column_stack([s * section[:, 0], np.full(4, y), s * section[:, 1]]) for s, y in levels])
    blade = blade.painted("#dfe7f0").painted("#9fb0c4", lambda at: at[:, 0] > 0)
    guard = prism(
        [
            (-0.55, -0.42),
            (-0.4, -0.5),
            (0.4, -0.5),
            (0.55, -0.42),
            (0.58, -0.26),
            (0.4, -0.34),
            (-0.4, -0.34),
            (-0.58, -0.26),
        ],
        0.22,
        0.04,
    )
    grip = cylinder(0.085, 0.6, 8).painted("#5a2f1a").moved(y=-0.78)
    wraps = [torus(0.085, 0.03, 8, 4).painted("#2b150b").moved(y=y) for y in (-0.64, -0.78, -0.92)]
    pommel = sphere(0.16, 8, 6).painted(GOLD).moved(y=-1.14)
    gem = sphere(0.09, 6, 4).painted("#ff2d4a").moved(y=-1.14, z=0.12)
    return union(blade, guard.painted(GOLD), grip, *wraps, pommel, gem)
