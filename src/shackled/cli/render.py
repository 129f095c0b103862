"""shackled render"""

from __future__ import annotations

import hashlib
import json
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from ..animation import DURATION, Animation, check_animation, check_duration
from ..chain import CHAINS, open_chain
from ..datasets import Piece
from ..errors import InputError
from ..image import Image, check_output
from ..load import locate
from ..palette import MOST_COLORS, colors
from ..parallel import Where, render_frames
from ..parallel.store import folder_of, remove_parts
from ..parallel.where import VERIFY
from ..render import render_whole
from ..scene.scene import Scene
from ..scene.turning import full_turn
from .job_progress import JobProgress
from .late_bar import LateBar
from .look import Changes, load_changed
from .look_options import with_look
from .option import option
from .parse import parse_tile


@with_look
def render(
    context: typer.Context,
    input: Annotated[
        str, typer.Argument(help="A mesh or scene file, or a piece of a dataset.", metavar="INPUT", show_default=False)
    ],
    output: Annotated[
        str | None,
        option(
            "-o --output",
            ".png .bmp .svg or .gif, of a turntable .gif, .png or a folder; else INPUT's name, in this folder.",
            "FILE",
        ),
    ] = None,
    as_json: Annotated[bool, option("--json", "Print one JSON object instead of words.")] = False,
    turntable: Annotated[
        int | None,
        option("--turntable", "A full turn in so many frames; the contract turns it.", "FRAMES", "Turntable"),
    ] = None,
    duration: Annotated[
        int | None, option("--duration", f"How long a frame is shown; else {DURATION}.", "MILLISECONDS", "Turntable")
    ] = None,
    chain: Annotated[
        str | None,
        option("--chain", f"Where it is computed: {', '.join(CHAINS)}; else the fastest EVM here.", "NAME", "Where"),
    ] = None,
    jobs: Annotated[
        int | None, option("--jobs", "So many worker processes, or calls at a time to each node.", "N", "Where")
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
        str | None, option("--address", "A renderer that is deployed there, to be called.", "ADDRESS", "Where")
    ] = None,
    rpc_timeout: Annotated[
        float | None, option("--rpc-timeout", "How long a node may take for a call.", "SECONDS", "Where")
    ] = None,
    cluster: Annotated[
        str | None,
        option(
            "--cluster", "A dask scheduler, as tcp://host:8786; without an address, one here.", "[ADDRESS]", "Where"
        ),
    ] = None,
    gas_limit: Annotated[
        int | None, option("--gas-limit", "What a call may use; the picture is cut to fit.", "GAS", "Where")
    ] = None,
    tile: Annotated[
        str | None, option("--tile", "Cut the picture into parts of this size, as 128 or 1024x64.", "SIZE", "Where")
    ] = None,
    verify: Annotated[
        str | None,
        option(
            "--verify",
            f"How much of what nodes draw is compared here: {', '.join(VERIFY)}; else all, or some of large pictures.",
            "MUCH",
            "Where",
        ),
    ] = None,
    *,
    changes: Changes,
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
        verify=verify,
    )
    if chain is not None:
        open_chain(chain)
    scene = load_changed(source, changes)
    made = _made(scene, where, turntable, shown, path)
    if not any(frame.lit_pixels for frame in made.frames):
        print("nothing of the scene is seen: the picture shows its background only", file=sys.stderr)
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
    """A picture, or the frames of a turntable.

    calls: how many made it; None for a picture by a single call here. seconds: from the scene to the file.
    triangles, lit_pixels: None for a turntable.
    """

    frames: Sequence[Image]
    calls: int | None
    seconds: float
    triangles: int | None = None
    lit_pixels: int | None = None

    def total(self, name: str) -> int | None:
        """The sum of a number over all frames; None if one does not have it."""
        values = [getattr(frame, name) for frame in self.frames]
        return None if None in values else sum(values)


def _made(scene: Scene, where: Where, turntable: int | None, duration: int, path: Path) -> Made:
    """Renders the scene, and writes the file."""
    started = time.perf_counter()
    if turntable is None and where.alone:
        with LateBar("rendering"):
            image = render_whole(scene, open_chain(where.chain))  # type: ignore[arg-type]
            triangles, lit_pixels = image.triangles, image.lit_pixels
        image.save(path)
        return Made([image], None, time.perf_counter() - started, triangles, lit_pixels)
    scenes = [scene] if turntable is None else full_turn(scene, turntable)
    keep = folder_of(path)
    listener = JobProgress()
    job = render_frames(scenes, where, listener=listener, keep=keep)
    try:
        with LateBar("writing"):
            if turntable is None:
                job.images[0].save(path)
            else:
                Animation(job.images, duration).save(path)
    except BaseException:
        if keep.is_dir():
            listener.warned(f"finished parts are kept in {keep}: the same command goes on from there")
        raise
    remove_parts(keep)
    image = job.images[0]
    counts = (image.triangles, image.lit_pixels) if turntable is None else (None, None)
    return Made(job.images, job.calls, time.perf_counter() - started, *counts)


def _report(made: Made, input: str, path: Path) -> dict[str, Any]:
    image, digest = made.frames[0], hashlib.sha256()
    for frame in made.frames:
        digest.update(frame.pixels.tobytes())
    report = {
        "input": input,
        "width": image.width,
        "height": image.height,
        "triangles": made.triangles,
        "lit_pixels": made.lit_pixels,
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
    gas, intrinsic_gas = made.total("gas"), made.total("intrinsic_gas")
    rows = {
        "picture": f"{path}, {f'{count} frames of ' if count > 1 else ''}{image.width} x {image.height} pixels",
    }
    if made.triangles is not None and made.lit_pixels is not None:
        rows["drawn"] = f"{made.triangles:,} triangles, {made.lit_pixels:,} lit pixels"
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
