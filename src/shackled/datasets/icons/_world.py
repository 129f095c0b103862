"""Icons of plants, vehicles and other things."""

from __future__ import annotations

import numpy as np

from ._icon import DULL, FACETED, GLOSSY, METAL, icon
from .modelling import (
    Solid,
    above,
    around,
    below,
    bevelled_box,
    cylinder,
    from_axis,
    loft,
    prism,
    revolve,
    sphere,
    sweep,
    torus,
    tube,
    union,
)
from .outlines import regular, star


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
    pot = revolve([(0.42, -1.2), (0.56, -0.72), (0.64, -0.72), (0.64, -0.52), (0.54, -0.52), (0.5, -0.6)], 14).painted(
        "#c8552e"
    )
    pot = pot.painted("#4a2a1a", lambda at: (at[:, 1] > -0.61) & (from_axis(at) < 0.5))
    petals = prism(star(8, 0.24, 0.17), 0.1).turned(x=-35).painted("#ff4f9a").moved(y=1.1, z=0.05)
    heart = sphere(0.1, 6, 4).painted("#ffe14a").moved(y=1.12, z=0.1)
    return union(stem, left, right, pot, petals, heart)


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
