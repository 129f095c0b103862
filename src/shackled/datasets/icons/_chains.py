"""Icons of chains: coins, locks and keys, links and blocks."""

from __future__ import annotations

import numpy as np

from ._icon import FACETED, METAL, SPARKLING, icon
from .modelling import (
    Solid,
    below,
    bevelled_box,
    box,
    cylinder,
    link,
    loft,
    prism,
    revolve,
    sphere,
    torus,
    tube,
    union,
)
from .outlines import arc, chamfered, regular, stroke

GOLD = "#f0a818"
STEEL = "#b4bfcc"


@icon("Ether", "#0f0b2e", "#32277a", SPARKLING, view=(24, 8))
def ethereum() -> Solid:
    """Model an octahedron, cut in two below its waist."""
    square = regular(4)
    upper = [(0.0, 1.15), (0.74, 0.07), (0.74, 0.02), (0.0, -0.34)]
    lower = [(0.0, -0.56), (0.74, -0.16), (0.74, -0.21), (0.0, -1.15)]
    halves = []
    for profile in (upper, lower):
        rings = [np.column_stack([r * square[:, 0], np.full(4, y), r * square[:, 1]]) for r, y in profile]
        halves.append(loft(rings))
    top = halves[0].painted("#e6ebff").painted("#9fb0f2", lambda at: at[:, 0] > 0)
    top = top.painted("#5a66c8", below(0))
    bottom = halves[1].painted("#cdd6ff").painted("#8797f0", lambda at: at[:, 0] > 0)
    return top + bottom.painted("#3a3f94", lambda at: np.abs(at[:, 1] + 0.3) < 0.05)


@icon("Coin", "#123c3a", "#2f8f7f", METAL, view=(0, 0), turn=(-14, -28, 0))
def coin() -> Solid:
    """Model a gold coin with a B of two strokes."""
    profile = [(0, -0.09), (0.8, -0.09), (0.86, -0.15), (1, -0.15), (1, 0.15), (0.86, 0.15), (0.8, 0.09), (0, 0.09)]
    disc = revolve(profile, 30).turned(x=90).painted(GOLD)
    disc = disc.painted("#c47f0c", lambda at: np.hypot(at[:, 0], at[:, 1]) < 0.79)
    width = 0.15
    upper = np.vstack([[(-0.26, 0.48)], arc(0.22, 90, -90, 6, (0.08, 0.26)), [(-0.26, 0.04)]])
    lower = np.vstack([[(-0.26, 0.0)], arc(0.24, 90, -90, 6, (0.12, -0.24)), [(-0.26, -0.48)]])
    lines = [upper, lower, np.array([(-0.24, -0.48), (-0.24, 0.48)])]
    ticks = [[(x, y), (x, 1.34 * y)] for x in (-0.1, 0.1) for y in (0.5, -0.5)]
    letter = [prism(stroke(line, width), 0.16) for line in lines] + [prism(stroke(t, 0.11), 0.16) for t in ticks]
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
    bow = arc(0.47, 0, 180, 8, (0, 0.52))
    path = np.vstack([[(0.47, -0.1)], bow, [(-0.47, -0.1)]])
    shackle = tube(np.column_stack([path, 0 * path[:, 0]]), 0.13, 9).painted("#d3dae2")
    hole = prism(regular(10, 0.17), 0.06).moved(y=-0.36)
    slot = prism([(-0.06, -0.75), (0.06, -0.75), (0.04, -0.4), (-0.04, -0.4)], 0.058)
    slot = slot.scaled(x=1.9)
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
