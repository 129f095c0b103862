"""The options of a look, generated from the table of settings, for all commands that render."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import wraps
from inspect import Parameter, Signature, signature
from typing import Annotated, Any

from .._frames import load_frames
from .._load import load, load_picture, locate
from ..datasets import Piece
from ..scene import ALL, SETTINGS, Kind, Scene, Setting, checked_look
from .option import OPTIONS, option, parse_color_and, parse_colors, parse_light, parse_size, parse_vector
from .progress import LateBar

#: The type of a value for typer, its metavar, and its converter.
_KINDS: dict[Kind, tuple[Any, str | None, Callable[[Any, str], Any]]] = {
    "size": (str, "SIZE", parse_size),
    "whole": (int, "N", lambda value, name: value),
    "count": (str, f"N|{ALL}", lambda text, name: int(text) if text.isdecimal() else text),
    "number": (float, "NUMBER", lambda value, name: value),
    "vector": (str, "X,Y,Z", parse_vector),
    "rotation": (str, "X,Y,Z", parse_vector),
    "flag": (bool, None, lambda value, name: value),
    "color": (str, "COLOR", lambda text, name: text),
    "background": (str, "COLOR[,COLOR]", lambda text, name: parse_colors(text, name)),
    "choice": (str, "KIND", lambda text, name: text),
    "hemisphere": (str, "SKY[,GROUND]", lambda text, name: parse_colors(text, name)),
    "rim": (str, "COLOR[,EXPONENT]", lambda text, name: parse_color_and(("exponent",), text, name)),
    "ground": (str, "COLOR", lambda text, name: text),
    "fog": (str, "COLOR[,NEAR,FAR]", lambda text, name: parse_color_and(("near", "far"), text, name)),
    "lights": (list[str], "KIND:X,Y,Z[:COLOR]", lambda texts, name: [parse_light(text) for text in texts] or None),
    "entry": (str, "NAME|N", lambda text, name: text),
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


def with_look(command: Callable[..., None]) -> Callable[..., None]:
    """Return the command with the options of a look in place of its parameter `look`."""
    given = signature(command, eval_str=True).parameters.values()
    parameters: list[Parameter] = []
    for each in given:
        parameters += map(_parameter, SETTINGS) if each.name == "look" else [each.replace(kind=Parameter.KEYWORD_ONLY)]
    parameters.sort(key=lambda each: COMMON.index(each.name) if each.name in COMMON else len(COMMON))

    @wraps(command)
    def whole(**values: Any) -> None:
        if "transparent" in values and (values["background"] or "").strip().lower() == "none":
            values |= {"background": None, "transparent": True}
        look = _look({setting.name: values.pop(setting.name) for setting in SETTINGS})
        command(**values, look=look)

    # typer reads both
    whole.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    whole.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    return whole


#: The option of commands that can make a picture fit.
FIT = option(
    "--fit",
    "Lower antialiasing, size and triangles until the picture fits: transaction, or call, a node's read call.",
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
    from ..gas import fit_scene

    with LateBar("fitting"):
        fitted = fit_scene(scene, fit, look.get("crease"))
    print(f"shackled: note: {fitted.sentence}", file=sys.stderr)
    return fitted.scene


def load_frames_with(input: str, frames: int, look: dict[str, Any]) -> tuple[list[Scene], float]:
    """Return the scenes of an animation of a glTF file, with a look, and its length in seconds."""
    with LateBar("reading"):
        return load_frames(input, frames, **look)


def option_of(setting: Setting) -> str:
    """Return the option of a setting, such as "--max-triangles" or "--cull/--no-cull"."""
    return setting.option or f"--{setting.name.replace('_', '-')}"


# messages of the library also name keywords of a look
OPTIONS.update({setting.name: option_of(setting).partition("/")[0] for setting in SETTINGS})


def _look(values: dict[str, Any]) -> dict[str, Any]:
    look: dict[str, Any] = {}
    for setting in SETTINGS:
        value = values[setting.name]
        if value is not None:
            look[setting.name] = _KINDS[setting.kind][2](value, option_of(setting))
    checked_look(look)
    return look


def _parameter(setting: Setting) -> Parameter:
    kind, metavar, _ = _KINDS[setting.kind]
    if setting.kind == "number" and setting.unit:
        metavar = setting.unit.upper()
    text = f"{setting.help}{_MORE.get(setting.name, '')}"
    panel = None if setting.name in COMMON else setting.group
    declared = option(option_of(setting), text, metavar, panel)
    return Parameter(setting.name, Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[kind | None, declared])
