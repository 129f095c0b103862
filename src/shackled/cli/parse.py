"""What is written on the command line, as values."""

from __future__ import annotations

import re

from ..errors import InputError
from ..scene import INNER_ANGLE, LIGHT_KINDS, MAX_SIDE, WHITE, Light


def parse_size(text: str) -> tuple[int, int]:
    """Return width and height, of "128" or "320x200"."""
    match = re.fullmatch(r"(\d{1,9})(?:[xX](\d{1,9}))?", text)
    if not match:
        raise InputError(f"--size must be a side such as 128 or WIDTHxHEIGHT such as 320x200, not {text!r}")
    width, height = int(match[1]), int(match[2] or match[1])
    if not (1 <= width <= MAX_SIDE and 1 <= height <= MAX_SIDE):
        raise InputError(f"--size must be from 1 to {MAX_SIDE} pixels a side, not {text!r}")
    return width, height


def parse_tile(text: str) -> tuple[int, int]:
    """Return width and height, of "64" or "1024x64"."""
    match = re.fullmatch(r"([1-9]\d{0,8})(?:[xX]([1-9]\d{0,8}))?", text)
    if not match:
        raise InputError(f"--tile must be a side such as 128 or WIDTHxHEIGHT such as 1024x64, not {text!r}")
    return int(match[1]), int(match[2] or match[1])


def parse_vector(text: str, name: str) -> tuple[float, float, float]:
    """Return three numbers, of "x,y,z"."""
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise InputError(f"{name} must be three numbers x,y,z such as 0,1.5,-2, not {text!r}") from None
    return x, y, z


def parse_background(text: str) -> str | tuple[str, str]:
    """Return a colour, or those of the top and the bottom of a gradient, of "#rrggbb" or "#rrggbb,#rrggbb" or names."""
    parts = [part.strip() for part in text.split(",")]
    if len(parts) > 2:
        raise InputError(f"--background must be one colour or two, #rrggbb,#rrggbb, not {text!r}")
    return parts[0] if len(parts) == 1 else (parts[0], parts[1])


def parse_light(text: str) -> Light:
    """Return a light, of "directional:x,y,z", "point:x,y,z", "spot:x,y,z:x,y,z:outer" or "...:inner,outer".

    A colour may follow each of them, as ":#rrggbb" or a name.
    """
    kind, *rest = text.split(":")
    needed = 3 if kind == "spot" else 1
    if kind not in LIGHT_KINDS or not needed <= len(rest) <= needed + 1:
        raise InputError(
            "--light must be directional:x,y,z, point:x,y,z or spot:position:direction:angle, with :#rrggbb if wanted, "
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
            "--light spot needs the angle in degrees at which its light ends, or inner,outer, between which it fades, "
            f"not {rest[2]!r}"
        ) from None
    return Light(kind, vector, color, parse_vector(rest[1], "--light"), inner, outer)
