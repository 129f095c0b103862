"""shackled render"""

from __future__ import annotations

import hashlib
import json
import sys
import time
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Annotated, Any

import typer

from .._load import locate
from .._on import VERIFY, Cluster, Nodes, On, Processes, where_of
from .._render import render as draw
from .._render import turntable as turn
from ..animation import DURATION, Animation, check_animation, check_duration
from ..animation import FORMATS as FILMS
from ..chain import CHAINS, PATIENCE, ContractChain, open_chain
from ..datasets import Piece
from ..errors import ChainError, InputError
from ..gas import Fit, fits_of, headline, render_call, suffices
from ..image import FORMATS, Image, check_alpha, check_output, most, one_of
from ..palette import MOST_COLORS, Pixels, colors
from ..parallel import folder_of, remove_parts
from ..scene import PICTURE, Scene, scene_chunk
from ..values import plural
from .look_options import FIT, load_with, with_look
from .option import option, parse_sides
from .progress import JobProgress, LateBar

#: The address that stands for a cluster on this machine.
LOCAL = "local"


@with_look
def render(
    context: typer.Context,
    input: Annotated[str, typer.Argument(help="Mesh file, scene file, or name of a piece.", metavar="INPUT")],
    output: Annotated[
        str | None,
        option(
            "-o --output",
            f"Output file: {one_of(FORMATS)}; of turntables {one_of(FILMS)} or a folder. Named after INPUT by default.",
            "FILE",
        ),
    ] = None,
    scene: Annotated[
        bool | None,
        option(
            "--scene/--no-scene",
            "Write the scene into PNG files, which are then scene files too (default: if it takes at most 64 KB).",
        ),
    ] = None,
    transparent: Annotated[
        bool, option("--transparent", "Make the background transparent: .png or .svg, at twice the gas.")
    ] = False,
    fit: Annotated[str | None, FIT] = None,
    as_json: Annotated[bool, option("--json", "Print a JSON object instead of text.")] = False,
    turntable: Annotated[
        int | None,
        option("--turntable", "Render a full turn in this many frames.", "FRAMES", "Turntable"),
    ] = None,
    duration: Annotated[
        int | None,
        option("--duration", f"Duration of a frame (default: {DURATION}).", "MILLISECONDS", "Turntable"),
    ] = None,
    one_call: Annotated[
        bool,
        option(
            "--one-call", "Make the whole animated PNG in one call of a contract, as for a token.", None, "Turntable"
        ),
    ] = False,
    chain: Annotated[
        str | None,
        option("--chain", f"EVM to draw in: {', '.join(CHAINS)}; default: revm.", "NAME", "Where"),
    ] = None,
    jobs: Annotated[
        int | None, option("--jobs", "Number of worker processes, or of concurrent calls per node.", "N", "Where")
    ] = None,
    rpc: Annotated[
        list[str] | None,
        typer.Option(
            "--rpc",
            help="Node to render on, with or without deployed contracts; may be repeated to share the work.",
            metavar="URL",
            envvar="SHACKLED_RPC",
            show_default=False,
            rich_help_panel="Where",
        ),
    ] = None,
    address: Annotated[str | None, option("--address", "Address of a deployed renderer.", "ADDRESS", "Where")] = None,
    rpc_timeout: Annotated[
        float | None,
        option("--rpc-timeout", f"Timeout of a call to a node (default: {PATIENCE:g}).", "SECONDS", "Where"),
    ] = None,
    cluster: Annotated[
        str | None,
        option(
            "--cluster", "A dask scheduler, as tcp://host:8786, or local for one on this machine.", "ADDRESS", "Where"
        ),
    ] = None,
    gas_limit: Annotated[
        int | None, option("--gas-limit", "Gas limit of a call; the picture is split to fit.", "GAS", "Where")
    ] = None,
    tile: Annotated[
        str | None, option("--tile", "Split the picture into parts of this size, as 128 or 1024x64.", "SIZE", "Where")
    ] = None,
    verify: Annotated[
        str | None,
        option(
            "--verify",
            f"Pixels from nodes to verify locally: {', '.join(VERIFY)}; all by default, some of large pictures.",
            "PART",
            "Where",
        ),
    ] = None,
    *,
    look: dict[str, Any],
) -> None:
    """Render a mesh file, a scene file or a piece of a dataset."""
    source = locate(input)
    stem = (source.file_stem if isinstance(source, Piece) else source.stem) or "picture"
    if isinstance(source, Path) and source.suffix.lower() == PICTURE:
        stem += "-rendered"  # not over INPUT
    shown = check_duration(DURATION if duration is None else duration)
    if turntable is None:
        if duration is not None:
            raise InputError("--duration needs --turntable")
        if one_call:
            raise InputError("--one-call needs --turntable")
        path = check_output(output if output is not None else f"{stem}.png")
        if transparent:
            check_alpha(path.suffix.lower())
    else:
        if transparent:
            raise InputError("--transparent and --turntable exclude each other: a turntable has a background")
        path = check_animation(output if output is not None else f"{stem}.gif")
    if (chain is not None or cluster is not None) and _from_environment(context, "rpc"):
        rpc = None  # options override the environment
    on = _on(chain, jobs, rpc or (), address, rpc_timeout, cluster, verify)
    sides = None if tile is None else parse_sides(tile, "--tile")
    where = where_of(on, gas_limit, sides)
    for name, given in (("--tile", tile), ("--gas-limit", gas_limit), ("--turntable", turntable)):
        if fit is not None and given is not None:
            raise InputError(f"--fit and {name} exclude each other: give one of them")
    if chain is not None:
        open_chain(chain)
    if scene and one_call:
        raise InputError("--scene and --one-call exclude each other: the contract's file has no scene")
    if scene and path.suffix.lower() not in (PICTURE, ""):
        raise InputError(f"--scene needs a {PICTURE} file, not {path}")
    loaded = load_with(input, look, fit)
    if scene:
        scene_chunk(loaded).check()
    in_parts = not one_call and (turntable is not None or not where.is_one_call(loaded))
    started = time.perf_counter()
    listener = JobProgress()
    keep = folder_of(path) if in_parts else None
    told: dict[str, Any] = {"gas_limit": gas_limit, "tile": sides, "listener": listener, "keep": keep}
    with nullcontext() if in_parts else LateBar("rendering"):
        made: Image | Animation
        if turntable is None:
            made = draw(loaded, on=on, transparent=transparent, **told)
        else:
            made = turn(loaded, turntable, duration=shown, on=on, one_call=one_call, **told)
    try:
        with LateBar("writing"):
            made.save(path, scene=scene)
    except BaseException:
        if keep is not None and keep.is_dir():
            listener.warned(f"finished parts are kept in {keep}: run the same command to resume")
        raise
    if keep is not None:
        remove_parts(keep)
    frames = [made] if isinstance(made, Image) else made.frames
    chunk = frames[0].scene_chunk if path.suffix.lower() in (PICTURE, "") and scene is not False else None
    written = len(chunk.data) if chunk is not None and (scene or chunk.is_small) else None
    with LateBar("counting"):
        counts, shows_something = _counted(made)
        fits = _fits(made, loaded)
    several = in_parts or transparent or turntable is not None
    report = _report(made, input, path, time.perf_counter() - started, counts, written, fits, several)
    if not shows_something:
        print("nothing is visible; the picture shows only the background", file=sys.stderr)
    if path.suffix.lower() == ".gif":
        _warn_of_palette([frame.pixels for frame in frames])
    print(json.dumps(report) if as_json else _words(report, None if chunk is None else len(chunk.data), fits))


def _on(
    chain: str | None,
    jobs: int | None,
    rpc: Sequence[str],
    address: str | None,
    timeout: float | None,
    cluster: str | None,
    verify: str | None,
) -> On | None:
    """Return where to render. InputError for options that exclude or need each other."""
    if verify is not None and not rpc and cluster is None:
        raise InputError("--verify needs --rpc or --cluster")
    if rpc and cluster is not None:
        raise InputError("--rpc and --cluster exclude each other: give one of them")
    if rpc and chain is not None:
        raise InputError("--rpc and --chain exclude each other: give one of them")
    if chain is not None and "://" in chain:
        raise InputError(f"--chain is the name of an EVM: give --rpc for the node {chain!r:.60}")
    for name, value in (("--address", address), ("--rpc-timeout", timeout)):
        if value is not None and not rpc:
            raise InputError(f"{name} needs --rpc")
    if cluster is not None:
        if cluster != LOCAL and ":" not in cluster:
            raise InputError(f"--cluster must be {LOCAL} or an address such as tcp://host:8786, not {cluster!r}")
        return Cluster(None if cluster == LOCAL else cluster, jobs, chain, verify)
    if rpc:
        return Nodes(*rpc, address=address, timeout=timeout, jobs=1 if jobs is None else jobs, verify=verify)
    return chain if jobs is None else Processes(jobs, chain)


def _from_environment(context: typer.Context, parameter: str) -> bool:
    source = context.get_parameter_source(parameter)
    return source is not None and source.name == "ENVIRONMENT"


def _counted(made: Image | Animation) -> tuple[tuple[int | None, int | None], bool]:
    """Return the triangles and covered pixels of a picture, None where they are not known, and whether anything shows.

    The picture is already written: what fails here is only told.
    """
    try:
        if isinstance(made, Image):
            return (made.triangles, made.covered_pixels), made.covered_pixels != 0
        return (None, None), any(frame.covered_pixels != 0 for frame in made.frames)
    except ChainError as error:
        print(f"shackled: triangles and lit pixels were not counted: {error}", file=sys.stderr)
        return (None, None), True


def _fits(made: Image | Animation, scene: Scene) -> tuple[Fit, ...] | None:
    """Return how each call that made a picture fits into the known limits; None where no gas is counted."""
    if isinstance(made, Image):
        gas = made.call_gas
    else:
        gas = most(frame.call_gas for frame in made.frames) if made.file is None else made.gas
    if gas is None or made.intrinsic_gas is None:
        return None
    data, enough = render_call(scene), None
    if made.calls == 1 and isinstance(made, Image):
        # gas is the same everywhere
        chain = open_chain()
        assert isinstance(chain, ContractChain)
        enough = suffices(chain, "Renderer", data)
    return fits_of(gas, -(-made.intrinsic_gas // made.calls), data, enough)


def _report(
    made: Image | Animation,
    input: str,
    path: Path,
    seconds: float,
    counts: tuple[int | None, int | None],
    scene_bytes: int | None,
    fits: tuple[Fit, ...] | None,
    several: bool,
) -> dict[str, Any]:
    """Return the object of --json; with the number of frames and calls for pictures in parts and turntables."""
    frames = [made] if isinstance(made, Image) else made.frames
    digest = hashlib.sha256()
    for frame in frames:
        digest.update(frame.channels.tobytes())
    report = {
        "input": input,
        "width": frames[0].width,
        "height": frames[0].height,
        "triangles": counts[0],
        "lit_pixels": counts[1],
        "gas": made.gas,
        "intrinsic_gas": made.intrinsic_gas,
        "seconds": round(seconds, 6),
        "chain": frames[0].made_by,
        "output": str(path),
        "sha256": digest.hexdigest(),
        "scene_bytes": scene_bytes,
        "fits": None if fits is None else [fit.to_json() for fit in fits],
    }
    return report | {"frames": len(frames), "calls": made.calls} if several else report


def _words(report: dict[str, Any], scene: int | None, fits: tuple[Fit, ...] | None) -> str:
    """Return the report as text. scene: the bytes of the scene in the file, or that it would have; None for no line."""
    frames, calls = report.get("frames", 1), report.get("calls", 1)
    several = f"{frames} frames of " if frames > 1 else ""
    rows = {"picture": f"{report['output']}, {several}{report['width']} x {report['height']} pixels"}
    if report["triangles"] is not None and report["lit_pixels"] is not None:
        rows["drawn"] = f"{plural(report['triangles'], 'triangle')}, {plural(report['lit_pixels'], 'lit pixel')}"
    rows["gas"] = "not counted"
    if report["gas"] is not None and report["intrinsic_gas"] is not None:
        sent = "the scene" if calls == 1 else f"the scene {calls} times"
        rows["gas"] = f"{report['gas']:,} (and {report['intrinsic_gas']:,} to send {sent})"
    if fits is not None:
        each = f"each of its {calls} calls: " if calls > 1 else ""
        rows["fits"] = each + headline(fits).removeprefix("fits ")
    if scene is not None:
        size = f"{scene / 1024:.1f} KB"
        left_out = f"not in the file, as it takes {size}: --scene writes it"
        rows["scene"] = left_out if report["scene_bytes"] is None else f"in the file, {size}"
    rows |= {"chain": report["chain"], "time": f"{report['seconds']:.3f} s"}
    return "\n".join(f"{name:8} {value}" for name, value in rows.items())


def _warn_of_palette(frames: Sequence[Pixels]) -> None:
    found = colors(frames)
    if found > MOST_COLORS:
        whose = "picture" if len(frames) == 1 else "frames"
        text = f"a GIF has at most {MOST_COLORS} colours; the {found:,} of the {whose} were mapped to the nearest"
        print(text, file=sys.stderr)
