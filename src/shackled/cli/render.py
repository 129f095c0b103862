"""shackled render"""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from contextlib import ExitStack, redirect_stderr
from typing import Annotated

import click

from .._on import VERIFY, Bounds, Cluster, Nodes, On, Processes, place_of
from ..animation import DURATION, check_duration
from ..animation import FORMATS as FILMS
from ..chain import CHAINS, PATIENCE, open_chain
from ..errors import InputError
from ..image import FORMATS, check_alpha, one_of
from ..scene import PICTURE
from .look_options import FIT, Look, parse_sides
from .option import argument, option
from .picture import Task, render_to
from .progress import JobProgress
from .several import inputs_of, outputs_of, render_all
from .streams import FORMATS as KINDS

#: The address that stands for a cluster on this machine.
LOCAL = "local"


def render(
    context: click.Context,
    inputs: Annotated[
        list[str],
        argument("Mesh or scene files, names of pieces, folders of mesh files, or - for standard input.", "INPUT"),
    ],
    output: Annotated[
        str | None,
        option(
            "-o --output",
            f"Output file: {one_of(FORMATS)}; of animations {one_of(FILMS)} or a folder. Named after INPUT by default. "
            "Of several inputs a folder, as out/, or a pattern, as 'out/{stem}.webp'; - is standard output.",
            "FILE",
        ),
    ] = None,
    kind: Annotated[
        str | None,
        option(
            "--format", f"Format of standard input: {', '.join(KINDS)}; default: by its content.", "FORMAT", "Files"
        ),
    ] = None,
    scene: Annotated[
        bool | None,
        option(
            "--scene/--no-scene",
            "Write the scene into PNG files, which are then scene files too (default: if it takes at most 64 KB).",
            None,
            "Files",
        ),
    ] = None,
    transparent: Annotated[
        bool,
        option(
            "--transparent",
            "Make the background transparent, at twice the gas; same as --background none.",
            None,
            "Canvas",
        ),
    ] = False,
    fit: Annotated[str | None, FIT] = None,
    as_json: Annotated[
        bool, option("--json", "Print a JSON object instead of text, for each input.", None, "Files")
    ] = False,
    quiet: Annotated[bool, option("-q --quiet", "Print errors only, and what --json prints.", None, "Files")] = False,
    turntable: Annotated[
        int | None,
        option("--turntable", "Render a full turn in this many frames.", "FRAMES"),
    ] = None,
    frames: Annotated[
        int | None,
        option("--frames", "Render an animation, the first one by default, in this many frames.", "N", "glTF files"),
    ] = None,
    duration: Annotated[
        int | None,
        option(
            "--duration",
            f"Duration of a frame (default: {DURATION}, or the pace of the animation of the file).",
            "MILLISECONDS",
            "Turntable",
        ),
    ] = None,
    one_call: Annotated[
        bool,
        option(
            "--one-call", "Make the whole animated PNG in one call of a contract, as for a token.", None, "Turntable"
        ),
    ] = False,
    evm: Annotated[
        str | None,
        option("--evm", f"EVM to draw in: {', '.join(CHAINS)}; default: revm.", "NAME", "Where"),
    ] = None,
    jobs: Annotated[
        int | None,
        option(
            "--jobs",
            "Number of concurrent calls on this machine, of processes if there are several inputs, or of concurrent "
            "calls per node.",
            "N",
            "Where",
        ),
    ] = None,
    rpc: Annotated[
        list[str] | None,
        option(
            "--rpc",
            "Node to render on, with or without deployed contracts; may be repeated to share the work.",
            "URL",
            "Where",
            envvar="SHACKLED_RPC",
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
    look: Look,
) -> None:
    """Render mesh files, scene files or pieces of datasets."""
    with ExitStack() as stack:
        if quiet:
            stack.enter_context(redirect_stderr(io.StringIO()))
        sources = inputs_of(inputs, kind, stack)
        if duration is not None:
            check_duration(duration)
            if turntable is None and frames is None:
                raise InputError("--duration needs --turntable or --frames")
        if one_call and turntable is None:
            raise InputError("--one-call needs --turntable")
        if turntable is not None and frames is not None:
            raise InputError("--turntable and --frames exclude each other: give one of them")
        are_films = turntable is not None or frames is not None
        paths = outputs_of(sources, output, are_films)
        extensions = {PICTURE if path is None else path.suffix.lower() for path in paths} - {""}
        if transparent:
            for extension in extensions:
                check_alpha(extension, FILMS if are_films else FORMATS)
        if (evm is not None or cluster is not None) and _from_environment(context, "rpc"):
            rpc = None  # options override the environment
        on = _on(evm, jobs, rpc or (), address, rpc_timeout, cluster, verify)
        sides = None if tile is None else parse_sides(tile, "--tile")
        place_of(on)
        Bounds(gas_limit, sides)
        for name, given in (
            ("--tile", tile),
            ("--gas-limit", gas_limit),
            ("--turntable", turntable),
            ("--frames", frames),
        ):
            if fit is not None and given is not None:
                raise InputError(f"--fit and {name} exclude each other: give one of them")
        if evm is not None:
            open_chain(evm)
        if scene and one_call:
            raise InputError("--scene and --one-call exclude each other: the contract's file has no scene")
        if transparent and one_call:
            raise InputError("--transparent and --one-call exclude each other: the contract's file has a background")
        if scene and extensions - {PICTURE}:
            raise InputError(f"--scene needs a {PICTURE} file, not {paths[0]}")
        task = Task(look, fit, turntable, frames, duration, one_call, transparent, scene, on, gas_limit, sides)
        if len(sources) > 1:
            render_all(sources, paths, task, "json" if as_json else None if quiet else "line")
            return
        done = render_to(sources[0], paths[0], task, JobProgress())
        if as_json or not quiet:
            print(done.json if as_json else done.words, file=sys.stderr if paths[0] is None else sys.stdout)


def _on(
    evm: str | None,
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
    if rpc and evm is not None:
        raise InputError("--rpc and --evm exclude each other: give one of them")
    if evm is not None and "://" in evm:
        raise InputError(f"--evm is the name of an EVM: give --rpc for the node {evm!r:.60}")
    for name, value in (("--address", address), ("--rpc-timeout", timeout)):
        if value is not None and not rpc:
            raise InputError(f"{name} needs --rpc")
    if cluster is not None:
        if cluster != LOCAL and ":" not in cluster:
            raise InputError(f"--cluster must be {LOCAL} or an address such as tcp://host:8786, not {cluster!r}")
        return Cluster(None if cluster == LOCAL else cluster, jobs, evm, verify)
    if rpc:
        return Nodes(*rpc, address=address, timeout=timeout, jobs=1 if jobs is None else jobs, verify=verify)
    return evm if jobs is None else Processes(jobs, evm)


def _from_environment(context: click.Context, parameter: str) -> bool:
    source = context.get_parameter_source(parameter)
    return source is not None and source.name == "ENVIRONMENT"
