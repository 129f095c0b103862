"""Options of commands: their declaration, their values, and their names in messages."""

from __future__ import annotations

import re
from typing import Any

import typer

from ..errors import InputError
from ..scene import INNER_ANGLE, LIGHT_KINDS, MAX_SIDE, WHITE, Light

#: The options of parameters that messages of the library name in backticks.
OPTIONS = {
    "address": "--address",
    "any_chain": "--any-chain",
    "arg": "--arg",
    "chain": "--evm",
    "cluster": "--cluster",
    "contract": "--contract",
    "contracts": "--contracts",
    "evm": "--evm",
    "fit": "--fit",
    "frames": "--frames",
    "gas_limit": "--gas-limit",
    "host": "--host",
    "jobs": "--jobs",
    "licence": "--licence",
    "max_fee": "--max-fee",
    "max_triangles": "--max-triangles",
    "on": "--evm",
    "one_call": "--one-call",
    "port": "--port",
    "rpc": "--rpc",
    "salt": "--salt",
    "setup": "--setup",
    "size": "--size",
    "tile": "--tile",
    "timeout": "--rpc-timeout",
    "transparent": "--transparent",
    "url": "--rpc",
    "urls": "--rpc",
    "verify": "--verify",
}

#: Other words for commands and options, and what is meant.
MEANT = {
    "mint": "store, which mints no token; `shackled token mint` does",
    "turntable": "render INPUT --turntable FRAMES",
    "animate": "render INPUT --frames N",
    "convert": "export",
    "serve": "creator",
    "gui": "creator",
    "--alpha": "--transparent",
    "--antialiasing": "--antialias",
    "--bg": "--background",
    "--chain": "--evm",
    "--colour": "--color",
    "--fps": "--duration",
    "--height": "--size",
    "--license": "--licence",
    "--network": "--rpc",
    "--out": "--output",
    "--processes": "--jobs",
    "--res": "--size",
    "--resolution": "--size",
    "--threads": "--jobs",
    "--width": "--size",
    "--workers": "--jobs",
}


def option(name: str, text: str, kind: str | None = None, panel: str | None = None, **more: Any) -> Any:
    """Declare an option: its names, its help, the word for its value there, and the panel in which it is listed."""
    return typer.Option(*name.split(), help=text, metavar=kind, rich_help_panel=panel, **more)


def with_options(message: str) -> str:
    """Return a message of the library in one line, with options in place of the parameters that it names."""
    return re.sub(r"`(\w+)`", lambda match: OPTIONS.get(match[1], match[0]), " ".join(message.split()))


def parse_sides(text: str, name: str) -> tuple[int, int]:
    """Return width and height of "128" or "320x200"."""
    match = re.fullmatch(r"(\d{1,9})(?:[xX](\d{1,9}))?", text)
    if not match:
        raise InputError(f"{name} must be a side such as 128 or WIDTHxHEIGHT such as 320x200, not {text!r}")
    return int(match[1]), int(match[2] or match[1])


def parse_size(text: str, name: str = "--size") -> tuple[int, int]:
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
