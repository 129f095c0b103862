"""shackled render"""

from __future__ import annotations

import hashlib
import json
import sys
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from ..chain import CHAINS, open_place
from ..datasets import Piece
from ..image import Image, check_output
from ..load import locate
from ..render import render as render_scene
from .look import Changes, load_changed
from .parse import parse_background, parse_color, parse_light, parse_shading, parse_size, parse_vector


def _option(name: str, text: str, kind: str | None = None, panel: str | None = None) -> Any:
    return typer.Option(*name.split(), help=text, metavar=kind, rich_help_panel=panel, show_default=False)


def render(
    input: Annotated[
        str, typer.Argument(help="A mesh or scene file, or a piece of a dataset.", metavar="INPUT", show_default=False)
    ],
    output: Annotated[
        str | None,
        _option("-o --output", ".png .bmp .svg or .gif; else INPUT's name and .png, in this folder.", "FILE"),
    ] = None,
    size: Annotated[str | None, _option("--size", "Pixels, as 128 or 320x200.", "SIZE")] = None,
    chain: Annotated[
        str | None, _option("--chain", f"Where it is computed: {', '.join(CHAINS)}; else the fastest EVM here.", "NAME")
    ] = None,
    rpc: Annotated[
        str | None,
        typer.Option(
            "--rpc",
            help="A node that computes it, with nothing deployed.",
            metavar="URL",
            envvar="SHACKLED_RPC",
            show_default=False,
        ),
    ] = None,
    as_json: Annotated[bool, _option("--json", "Print one JSON object instead of words.")] = False,
    max_triangles: Annotated[int | None, _option("--max-triangles", "Simplify meshes of more.", "N")] = None,
    rotate: Annotated[
        str | None,
        _option("--rotate", "Turn the scene about x, then y, then z, in degrees.", "X,Y,Z", "Camera"),
    ] = None,
    eye: Annotated[str | None, _option("--eye", "Where the eye is.", "X,Y,Z", "Camera")] = None,
    target: Annotated[str | None, _option("--target", "What it looks at.", "X,Y,Z", "Camera")] = None,
    up: Annotated[str | None, _option("--up", "What appears upward in the picture.", "X,Y,Z", "Camera")] = None,
    fov: Annotated[
        float | None, _option("--fov", "Vertical field of view in degrees, perspective only.", "DEGREES", "Camera")
    ] = None,
    half_height: Annotated[
        float | None,
        _option("--half-height", "Half the height of what is seen, perspective: at distance 1.", "H", "Camera"),
    ] = None,
    near: Annotated[float | None, _option("--near", "Distance of the near plane.", "DISTANCE", "Camera")] = None,
    orthographic: Annotated[
        bool | None, _option("--orthographic/--perspective", "How the camera projects.", None, "Camera")
    ] = None,
    light: Annotated[
        list[str] | None,
        _option(
            "--light",
            "In place of the scene's, up to four: directional:x,y,z or point:x,y,z, then :#rrggbb if wanted.",
            "LIGHT",
            "Look",
        ),
    ] = None,
    ambient: Annotated[float | None, _option("--ambient", "Share of ambient light, 0..4.", "K", "Look")] = None,
    diffuse: Annotated[float | None, _option("--diffuse", "Share of diffuse light, 0..4.", "K", "Look")] = None,
    specular: Annotated[float | None, _option("--specular", "Strength of highlights, 0..4.", "K", "Look")] = None,
    shininess: Annotated[int | None, _option("--shininess", "Exponent of highlights, 1..128.", "N", "Look")] = None,
    color: Annotated[str | None, _option("--color", "One colour for all meshes.", "#RRGGBB", "Look")] = None,
    background: Annotated[
        str | None, _option("--background", "A colour, or two from top to bottom.", "#RRGGBB[,#RRGGBB]", "Look")
    ] = None,
    shading: Annotated[str | None, _option("--shading", "unlit, flat or smooth.", "KIND", "Look")] = None,
    smooth: Annotated[bool, _option("--smooth", "As --shading smooth.", None, "Look")] = False,
    unlit: Annotated[bool, _option("--unlit", "As --shading unlit.", None, "Look")] = False,
    cull: Annotated[bool | None, _option("--cull/--no-cull", "Leave out faces that turn away.", None, "Look")] = None,
    wireframe: Annotated[
        bool | None, _option("--wireframe/--filled", "Draw the edges only, or whole faces.", None, "Look")
    ] = None,
    invert: Annotated[
        bool | None, _option("--invert/--no-invert", "Turn each value v into 255 - v.", None, "Look")
    ] = None,
) -> None:
    """Render a mesh file, a scene file or a piece of a dataset to a picture."""
    source = locate(input)
    stem = source.file_stem if isinstance(source, Piece) else source.stem
    path = check_output(output if output is not None else f"{stem or 'picture'}.png")
    changes = Changes(
        size=None if size is None else parse_size(size),
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
        invert=invert,
    )
    place = open_place(chain, rpc)
    scene = load_changed(source, changes)
    image = render_scene(scene, chain=place, max_triangles=max_triangles)
    image.save(path)
    if path.suffix.lower() == ".gif":
        _warn_of_palette(image)
    if as_json:
        print(json.dumps(_report(image, input, path)))
    else:
        print(_words(image, path))


def _report(image: Image, input: str, path: Path) -> dict[str, Any]:
    return {
        "input": input,
        "width": image.width,
        "height": image.height,
        "triangles": image.triangles,
        "lit_pixels": image.lit_pixels,
        "gas": image.gas,
        "intrinsic_gas": image.intrinsic_gas,
        "seconds": round(image.seconds, 6),
        "chain": image.chain,
        "output": str(path),
        "sha256": hashlib.sha256(image.pixels.tobytes()).hexdigest(),
    }


def _words(image: Image, path: Path) -> str:
    gas = "none is counted"
    if image.gas is not None and image.intrinsic_gas is not None:
        gas = f"{image.gas:,} (and {image.intrinsic_gas:,} to send the scene)"
    rows = {
        "picture": f"{path}, {image.width} x {image.height} pixels",
        "drawn": f"{image.triangles:,} triangles, {image.lit_pixels:,} lit pixels",
        "gas": gas,
        "chain": image.chain,
        "time": f"{image.seconds:.3f} s",
    }
    return "\n".join(f"{name:8} {value}" for name, value in rows.items())


def _warn_of_palette(image: Image) -> None:
    colors = len(np.unique(image.pixels.reshape(-1, 3), axis=0))
    if colors > 256:
        print(f"a GIF holds 256 colours; the {colors:,} of the picture were brought to the nearest", file=sys.stderr)
