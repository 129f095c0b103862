"""Icons with faces."""

from __future__ import annotations

from ._icon import DULL, FACETED, METAL, icon
from .modelling import (
    Solid,
    bevelled_box,
    both,
    box,
    cone,
    cylinder,
    icosphere,
    pixels,
    prism,
    revolve,
    sphere,
    tube,
    union,
)
from .outlines import arc, chamfered, stroke

INK = "#1a1420"


def socket(radius: float, depth: float, segments: int) -> Solid:
    """Return a lens in the x-y plane, for eyes."""
    return revolve([(0, -depth), (radius, 0), (0, depth)], segments).turned(x=90)


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
