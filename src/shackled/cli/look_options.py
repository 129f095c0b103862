"""The options of a look, generated from the table of settings, for all commands that render, and their values."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

import click

from .._load import load, load_picture, locate
from ..datasets._pieces import Piece
from ..errors import InputError
from ..scene._fields import LIGHT_KINDS
from ..scene._light import INNER_ANGLE, WHITE, Light
from ..scene._scene import Scene
from ..scene._settings import ALL, SETTINGS, Kind, Setting, checked_look
from ..scene._staging import MAX_SIDE
from .option import argument, option, parameter
from .progress import LateBar


def parse_sides(text: str, name: str) -> tuple[int, int]:
    """Return width and height of "128" or "320x200"."""
    match = re.fullmatch(r"(\d{1,9})(?:[xX](\d{1,9}))?", text)
    if not match:
        raise InputError(f"{name} must be a side such as 128 or WIDTHxHEIGHT such as 320x200, not {text!r}")
    return int(match[1]), int(match[2] or match[1])


def parse_size(text: str, name: str) -> tuple[int, int]:
    """Return width and height of a picture, as `parse_sides`."""
    width, height = parse_sides(text, name)
    if not (1 <= width <= MAX_SIDE and 1 <= height <= MAX_SIDE):
        raise InputError(f"{name} must be from 1 to {MAX_SIDE} pixels a side, not {text!r}")
    return width, height


def parse_vector(text: str, name: str) -> tuple[float, float, float]:
    """Return the three numbers of "x,y,z"."""
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise InputError(f"{name} must be three numbers x,y,z such as 0,1.5,-2, not {text!r}") from None
    return x, y, z


def parse_colors(text: str, name: str) -> str | tuple[str, str]:
    """Return the colour of "#rrggbb" or a name, or two, the upper one first, separated by a comma."""
    parts = [part.strip() for part in text.split(",")]
    if len(parts) > 2:
        raise InputError(f"{name} must be one colour or two, #rrggbb,#rrggbb, not {text!r}")
    return parts[0] if len(parts) == 1 else (parts[0], parts[1])


def parse_color_and(numbers: tuple[str, ...], text: str, name: str) -> str | tuple[Any, ...]:
    """Return the colour of "#rrggbb" or a name, with these numbers after it, separated by commas, or alone."""
    color, *given = (part.strip() for part in text.split(","))
    try:
        values = [int(part) if part.isdigit() else float(part) for part in given]
    except ValueError:
        values = [0.0] * (len(numbers) + 1)
    if values and len(values) != len(numbers):
        raise InputError(f"{name} must be a colour, or #rrggbb,{','.join(numbers)}, not {text!r}")
    return (color, *values) if values else color


def parse_light(text: str) -> Light:
    """Return the light of "directional:x,y,z", "point:x,y,z", "spot:x,y,z:x,y,z:outer" or "...:inner,outer".

    A colour may follow, as ":#rrggbb" or ":name".
    """
    kind, *rest = text.split(":")
    needed = 3 if kind == "spot" else 1
    if kind not in LIGHT_KINDS or not needed <= len(rest) <= needed + 1:
        raise InputError(
            "--light must be directional:x,y,z, point:x,y,z or spot:position:direction:angle, and may end in :#rrggbb, "
            f"not {text!r}"
        )
    color = rest[needed] if len(rest) > needed else WHITE
    vector = parse_vector(rest[0], "--light")
    if kind != "spot":
        return Light(kind, vector, color)
    angles = rest[2].split(",")
    try:
        inner, outer = [*([INNER_ANGLE] if len(angles) == 1 else []), *map(float, angles)]
    except ValueError:
        raise InputError(
            f"--light spot needs its outer angle in degrees, or inner,outer, between which it fades, not {rest[2]!r}"
        ) from None
    return Light(kind, vector, color, parse_vector(rest[1], "--light"), inner, outer)


#: The metavar of a setting, the type of its value, and the converter of one that is written differently than in Python.
_KINDS: dict[Kind, tuple[str | None, Any, Callable[[Any, str], Any] | None]] = {
    "size": ("SIZE", str, parse_size),
    "whole": ("N", int, None),
    "count": (f"N|{ALL}", str, lambda text, _: int(text) if text.isdecimal() else text),
    "number": ("NUMBER", float, None),
    "vector": ("X,Y,Z", str, parse_vector),
    "rotation": ("X,Y,Z", str, parse_vector),
    "flag": (None, bool | None, None),
    "color": ("COLOR", str, None),
    "background": ("COLOR[,COLOR]", str, parse_colors),
    "choice": ("KIND", str, None),
    "hemisphere": ("SKY[,GROUND]", str, parse_colors),
    "rim": ("COLOR[,EXPONENT]", str, partial(parse_color_and, ("exponent",))),
    "ground": ("COLOR", str, None),
    "fog": ("COLOR[,NEAR,FAR]", str, partial(parse_color_and, ("near", "far"))),
    "lights": ("KIND:X,Y,Z[:COLOR]", tuple[str, ...], lambda texts, _: [parse_light(text) for text in texts]),
    "entry": ("NAME|N", str, None),
}

#: Additions to the help, where values are written differently than in Python.
_MORE = {
    "size": " Written as 128 or 320x200.",
    "hemisphere": " `none` removes it.",
    "rim": " From 1, wide, to 16; 3 by default. `none` removes it.",
    "fog": " `none` removes it.",
    "ground": " `none` removes it.",
    "lights": " Written as directional:x,y,z, point:x,y,z or spot:x,y,z:direction:angle, each optionally with :color;"
    " may be repeated.",
}


#: Inputs, and the options that are needed most, which help lists first; those of a look without the title of a group.
COMMON = (
    *("input", "inputs", "output"),
    *("size", "background", "color", "azimuth", "elevation", "max_triangles", "turntable"),
)


def with_look(parameters: Iterable[click.Parameter]) -> list[click.Parameter]:
    """Return the parameters of a command with the options of a look."""
    found = [*parameters, *map(_option, SETTINGS)]
    return sorted(found, key=lambda each: COMMON.index(each.name) if each.name in COMMON else len(COMMON))


def take_look(values: dict[str, Any]) -> dict[str, Any]:
    """Remove the settings from the values of a command, and return those that were given.

    `--background none` is --transparent where that exists.
    """
    if "transparent" in values and str(values["background"] or "").lower() == "none":
        values |= {"background": None, "transparent": True}
    given = {each.name: values.pop(each.name) for each in SETTINGS}
    look = {name: value for name, value in given.items() if value not in (None, ())}
    checked_look(look)
    return look


#: What a look is of.
INPUT = argument("Mesh file, scene file, or name of a piece.", "INPUT")

#: The option of commands that can make a picture fit.
FIT = option(
    "--fit",
    "Reduce antialiasing, size and triangles until the picture fits a node's read call (call), a transaction on "
    "Ethereum (transaction), or one on another chain (base, optimism, monad, arbitrum, polygon).",
    "LIMIT",
    "Canvas",
)


def load_with(input: str, look: dict[str, Any], fit: str | None = None, is_picture: bool = True) -> Scene:
    """Return the scene of a file or piece, with a look. Print the credit and terms of a piece on stderr.

    fit: a limit that the picture is to fit; what was done for that is printed, too. is_picture: whether mesh files have
    no more triangles than the canvas shows.
    """
    source = locate(input)
    scene = load_picture(source, **look) if is_picture else load(source, **{"size": None, **look})
    if isinstance(source, Piece) and source.notice:
        print(source.notice, file=sys.stderr)
    if fit is None:
        return scene
    from ..gas._fitting import fit_scene

    with LateBar("fitting"):
        fitted = fit_scene(scene, fit, look.get("crease"))
    print(f"shackled: note: {fitted.sentence}", file=sys.stderr)
    return fitted.scene


def _option(setting: Setting) -> click.Parameter:
    metavar, kind, parse = _KINDS[setting.kind]
    if setting.kind == "number" and setting.unit:
        metavar = setting.unit.upper()
    panel = None if setting.name in COMMON else setting.group
    text = f"{setting.help}{_MORE.get(setting.name, '')}"
    declared = option(setting.option, text, metavar, panel, required=False, parse=parse)
    return parameter(setting.name, kind, declared)
