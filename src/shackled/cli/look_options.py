"""The options of a look, declared once for all commands that draw."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import Parameter, Signature, signature
from typing import Annotated, Any

from .look import Changes
from .option import option
from .parse import parse_background, parse_color, parse_light, parse_shading, parse_size, parse_vector


def with_look(command: Callable[..., None]) -> Callable[..., None]:
    """The command with all options of a look where it has its parameter `changes`, which is what they say."""
    look = _parameters(chosen_look)
    parameters: list[Parameter] = []
    for name, parameter in _parameters(command).items():
        parameters += look.values() if name == "changes" else [parameter]

    @wraps(command)
    def whole(**given: Any) -> None:
        changes = chosen_look(**{name: given.pop(name) for name in look})
        command(**given, changes=changes)

    # typer reads both
    whole.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    whole.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    return whole


def _parameters(function: Callable[..., Any]) -> dict[str, Parameter]:
    found = signature(function, eval_str=True).parameters
    return {name: parameter.replace(kind=Parameter.KEYWORD_ONLY) for name, parameter in found.items()}


def chosen_look(
    size: Annotated[str | None, option("--size", "Pixels, as 128 or 320x200, up to 2048 a side.", "SIZE")] = None,
    max_triangles: Annotated[int | None, option("--max-triangles", "Simplify meshes of more.", "N")] = None,
    rotate: Annotated[
        str | None,
        option("--rotate", "Turn the scene about x, then y, then z, in degrees.", "X,Y,Z", "Camera"),
    ] = None,
    eye: Annotated[str | None, option("--eye", "Where the eye is.", "X,Y,Z", "Camera")] = None,
    target: Annotated[str | None, option("--target", "What it looks at.", "X,Y,Z", "Camera")] = None,
    up: Annotated[str | None, option("--up", "What appears upward in the picture.", "X,Y,Z", "Camera")] = None,
    fov: Annotated[
        float | None, option("--fov", "Vertical field of view in degrees, perspective only.", "DEGREES", "Camera")
    ] = None,
    half_height: Annotated[
        float | None,
        option("--half-height", "Half the height of what is seen, perspective: at distance 1.", "H", "Camera"),
    ] = None,
    near: Annotated[float | None, option("--near", "Distance of the near plane.", "DISTANCE", "Camera")] = None,
    orthographic: Annotated[
        bool | None, option("--orthographic/--perspective", "How the camera projects.", None, "Camera")
    ] = None,
    light: Annotated[
        list[str] | None,
        option(
            "--light",
            "In place of the scene's, up to four: directional:x,y,z, point:x,y,z or spot:x,y,z:direction:angle, then "
            ":#rrggbb if wanted.",
            "LIGHT",
            "Look",
        ),
    ] = None,
    ambient: Annotated[float | None, option("--ambient", "Share of ambient light, 0..4.", "K", "Look")] = None,
    diffuse: Annotated[float | None, option("--diffuse", "Share of diffuse light, 0..4.", "K", "Look")] = None,
    specular: Annotated[float | None, option("--specular", "Strength of highlights, 0..4.", "K", "Look")] = None,
    shininess: Annotated[int | None, option("--shininess", "Exponent of highlights, 1..128.", "N", "Look")] = None,
    color: Annotated[str | None, option("--color", "One colour for all meshes.", "#RRGGBB", "Look")] = None,
    background: Annotated[
        str | None, option("--background", "A colour, or two from top to bottom.", "#RRGGBB[,#RRGGBB]", "Look")
    ] = None,
    shading: Annotated[str | None, option("--shading", "unlit, flat or smooth.", "KIND", "Look")] = None,
    smooth: Annotated[bool, option("--smooth", "As --shading smooth.", None, "Look")] = False,
    unlit: Annotated[bool, option("--unlit", "As --shading unlit.", None, "Look")] = False,
    cull: Annotated[bool | None, option("--cull/--no-cull", "Leave out faces that turn away.", None, "Look")] = None,
    wireframe: Annotated[
        bool | None, option("--wireframe/--filled", "Draw the edges only, or whole faces.", None, "Look")
    ] = None,
    opacity: Annotated[
        float | None, option("--opacity", "What objects hide of what is behind them, 0..1.", "K", "Look")
    ] = None,
    invert: Annotated[
        bool | None, option("--invert/--no-invert", "Turn each value v into 255 - v.", None, "Look")
    ] = None,
) -> Changes:
    """What the options say. InputError names the one that is wrong."""
    return Changes(
        size=None if size is None else parse_size(size),
        max_triangles=max_triangles,
        rotation=None if rotate is None else parse_vector(rotate, "--rotate"),
        eye=None if eye is None else parse_vector(eye, "--eye"),
        target=None if target is None else parse_vector(target, "--target"),
        up=None if up is None else parse_vector(up, "--up"),
        projection=None if orthographic is None else "orthographic" if orthographic else "perspective",
        fov=fov,
        half_height=half_height,
        near=near,
        lights=[parse_light(text) for text in light or []],
        shading=parse_shading(shading, smooth, unlit),
        ambient=ambient,
        diffuse=diffuse,
        specular=specular,
        shininess=shininess,
        color=None if color is None else parse_color(color, "--color"),
        background=None if background is None else parse_background(background),
        cull=cull,
        wireframe=wireframe,
        opacity=opacity,
        invert=invert,
    )
