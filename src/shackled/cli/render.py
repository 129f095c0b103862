"""shackled render"""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from ..animation import DURATION, MOST_COLORS, Animation, check_animation, check_duration, colors
from ..chain import CHAINS, open_chain
from ..datasets import Piece
from ..errors import InputError
from ..image import Image, check_output
from ..load import locate
from ..parallel import Where, render_frames
from ..parallel.store import folder_of, remove_parts
from ..render import render_whole, simplify_scene
from ..scene.scene import Scene
from ..scene.turning import full_turn
from .job_progress import JobProgress
from .look import Changes, load_changed
from .parse import parse_background, parse_color, parse_light, parse_shading, parse_size, parse_tile, parse_vector


def _option(name: str, text: str, kind: str | None = None, panel: str | None = None) -> Any:
    return typer.Option(*name.split(), help=text, metavar=kind, rich_help_panel=panel, show_default=False)


def render(
    context: typer.Context,
    input: Annotated[
        str, typer.Argument(help="A mesh or scene file, or a piece of a dataset.", metavar="INPUT", show_default=False)
    ],
    output: Annotated[
        str | None,
        _option(
            "-o --output",
            ".png .bmp .svg or .gif, of a turntable .gif, .png or a folder; else INPUT's name, in this folder.",
            "FILE",
        ),
    ] = None,
    size: Annotated[str | None, _option("--size", "Pixels, as 128 or 320x200, up to 2048 a side.", "SIZE")] = None,
    as_json: Annotated[bool, _option("--json", "Print one JSON object instead of words.")] = False,
    max_triangles: Annotated[int | None, _option("--max-triangles", "Simplify meshes of more.", "N")] = None,
    turntable: Annotated[
        int | None,
        _option("--turntable", "A full turn in so many frames; the contract turns it.", "FRAMES", "Turntable"),
    ] = None,
    duration: Annotated[
        int | None, _option("--duration", f"How long a frame is shown; else {DURATION}.", "MILLISECONDS", "Turntable")
    ] = None,
    chain: Annotated[
        str | None,
        _option("--chain", f"Where it is computed: {', '.join(CHAINS)}; else the fastest EVM here.", "NAME", "Where"),
    ] = None,
    jobs: Annotated[
        int | None, _option("--jobs", "So many worker processes, or calls at a time to each node.", "N", "Where")
    ] = None,
    rpc: Annotated[
        list[str] | None,
        typer.Option(
            "--rpc",
            help="A node that computes it, with nothing deployed if need be; several share the work.",
            metavar="URL",
            envvar="SHACKLED_RPC",
            show_default=False,
            rich_help_panel="Where",
        ),
    ] = None,
    address: Annotated[
        str | None, _option("--address", "A renderer that is deployed there, to be called.", "ADDRESS", "Where")
    ] = None,
    rpc_timeout: Annotated[
        float | None, _option("--rpc-timeout", "How long a node may take for a call.", "SECONDS", "Where")
    ] = None,
    cluster: Annotated[
        str | None,
        _option(
            "--cluster", "A dask scheduler, as tcp://host:8786; without an address, one here.", "[ADDRESS]", "Where"
        ),
    ] = None,
    gas_limit: Annotated[
        int | None, _option("--gas-limit", "What a call may use; the picture is cut to fit.", "GAS", "Where")
    ] = None,
    tile: Annotated[
        str | None, _option("--tile", "Cut the picture into parts of this size, as 128 or 1024x64.", "SIZE", "Where")
    ] = None,
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
    stem = (source.file_stem if isinstance(source, Piece) else source.stem) or "picture"
    shown = check_duration(DURATION if duration is None else duration)
    if turntable is None:
        if duration is not None:
            raise InputError("--duration is about a --turntable: give that too, or leave it out")
        path = check_output(output if output is not None else f"{stem}.png")
    else:
        path = check_animation(output if output is not None else f"{stem}.gif")
    if (chain is not None or cluster is not None) and _from_environment(context, "rpc"):
        rpc = None  # what is typed goes before what is set for all commands
    where = Where(
        chain=chain,
        jobs=jobs,
        rpc=rpc or (),
        address=address,
        timeout=rpc_timeout,
        cluster=cluster,
        gas_limit=gas_limit,
        tile=None if tile is None else parse_tile(tile),
    )
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
    if chain is not None:
        open_chain(chain)
    scene = load_changed(source, changes)
    if max_triangles is not None:
        scene = simplify_scene(scene, max_triangles)
    made = _made(scene, where, turntable, shown, path)
    if path.suffix.lower() == ".gif":
        _warn_of_palette(made)
    if as_json:
        print(json.dumps(_report(made, input, path)))
    else:
        print(_words(made, path))


def _from_environment(context: typer.Context, parameter: str) -> bool:
    source = context.get_parameter_source(parameter)
    return source is not None and source.name == "ENVIRONMENT"


@dataclass(frozen=True)
class Made:
    """A picture, or the frames of a turntable. calls: how many made it; None for a picture by a single call here."""

    frames: Sequence[Image]
    calls: int | None
    seconds: float

    def total(self, name: str) -> int | None:
        """The sum of a number over all frames; None if one does not have it."""
        values = [getattr(frame, name) for frame in self.frames]
        return None if None in values else sum(values)


def _made(scene: Scene, where: Where, turntable: int | None, duration: int, path: Path) -> Made:
    """Renders the scene, and writes the file."""
    if turntable is None and where.alone:
        image = render_whole(scene, open_chain(where.chain))  # type: ignore[arg-type]
        image.save(path)
        return Made([image], None, image.seconds)
    scenes = [scene] if turntable is None else full_turn(scene, turntable)
    keep = folder_of(path)
    job = render_frames(scenes, where, count=turntable is None, listener=JobProgress(), keep=keep)
    if turntable is None:
        job.images[0].save(path)
    else:
        Animation(job.images, duration).save(path)
    remove_parts(keep)
    return Made(job.images, job.calls, sum(image.seconds for image in job.images))


def _report(made: Made, input: str, path: Path) -> dict[str, Any]:
    image, digest = made.frames[0], hashlib.sha256()
    for frame in made.frames:
        digest.update(frame.pixels.tobytes())
    report = {
        "input": input,
        "width": image.width,
        "height": image.height,
        "triangles": made.total("triangles"),
        "lit_pixels": made.total("lit_pixels"),
        "gas": made.total("gas"),
        "intrinsic_gas": made.total("intrinsic_gas"),
        "seconds": round(made.seconds, 6),
        "chain": image.chain,
        "output": str(path),
        "sha256": digest.hexdigest(),
    }
    return report if made.calls is None else report | {"frames": len(made.frames), "calls": made.calls}


def _words(made: Made, path: Path) -> str:
    image, count = made.frames[0], len(made.frames)
    triangles, lit_pixels = made.total("triangles"), made.total("lit_pixels")
    gas, intrinsic_gas = made.total("gas"), made.total("intrinsic_gas")
    rows = {
        "picture": f"{path}, {f'{count} frames of ' if count > 1 else ''}{image.width} x {image.height} pixels",
    }
    if triangles is not None and lit_pixels is not None:
        rows["drawn"] = f"{triangles:,} triangles, {lit_pixels:,} lit pixels"
    rows["gas"] = "none is counted"
    if gas is not None and intrinsic_gas is not None:
        sent = "the scene" if made.calls in (None, 1) else f"the scene {made.calls} times"
        rows["gas"] = f"{gas:,} (and {intrinsic_gas:,} to send {sent})"
    rows |= {"chain": image.chain, "time": f"{made.seconds:.3f} s"}
    return "\n".join(f"{name:8} {value}" for name, value in rows.items())


def _warn_of_palette(made: Made) -> None:
    found = colors([frame.pixels for frame in made.frames])
    if found > MOST_COLORS:
        whose = "picture" if len(made.frames) == 1 else "frames"
        text = f"a GIF holds {MOST_COLORS} colours; the {found:,} of the {whose} were brought to the nearest"
        print(text, file=sys.stderr)
