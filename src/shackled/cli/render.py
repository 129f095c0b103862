"""shackled render and stages"""

from __future__ import annotations

import io
import sys
from contextlib import ExitStack, redirect_stderr
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from PIL import Image as PillowImage

from .._on import VERIFY, Bounds, Cluster, Nodes, On, Processes, place_of
from ..animation import FORMATS as FILMS
from ..chain import CHAINS, PATIENCE, open_chain
from ..errors import InputError
from ..image import FORMATS, check_alpha, one_of
from ..scene import PICTURE
from ..whole_file import check_output_folder, make_output_folder, write_output
from .look_options import FIT, Input, Look, load_with, parse_sides
from .option import is_from_environment, option
from .picture import FilmOptions, Task, render_to
from .progress import JobProgress
from .several import Inputs, inputs_of, outputs_of, render_all
from .streams import FORMATS as KINDS

#: The address that stands for a cluster on this machine.
LOCAL = "local"

Evm = Annotated[str | None, option("--evm", f"EVM to draw in: {', '.join(CHAINS)}; default: revm.", "NAME", "Where")]


@dataclass(frozen=True)
class WhereOptions:
    """Where calls run, and how a picture is split."""

    evm: Evm = None
    jobs: Annotated[
        int | None,
        option(
            "--jobs",
            "Number of concurrent calls on this machine, of processes if there are several inputs, or of concurrent "
            "calls per node.",
            "N",
            "Where",
        ),
    ] = None
    rpc: Annotated[
        list[str] | None,
        option(
            "--rpc",
            "Node to render on, with or without deployed contracts; may be repeated to share the work.",
            "URL",
            "Where",
            envvar="SHACKLED_RPC",
        ),
    ] = None
    address: Annotated[str | None, option("--address", "Address of a deployed renderer.", "ADDRESS", "Where")] = None
    rpc_timeout: Annotated[
        float | None,
        option("--rpc-timeout", f"Timeout of a call to a node (default: {PATIENCE:g}).", "SECONDS", "Where"),
    ] = None
    cluster: Annotated[
        str | None,
        option(
            "--cluster", "A dask scheduler, as tcp://host:8786, or local for one on this machine.", "ADDRESS", "Where"
        ),
    ] = None
    gas_limit: Annotated[
        int | None, option("--gas-limit", "Gas limit of a call; the picture is split to fit.", "GAS", "Where")
    ] = None
    tile: Annotated[
        str | None, option("--tile", "Split the picture into parts of this size, as 128 or 1024x64.", "SIZE", "Where")
    ] = None
    verify: Annotated[
        str | None,
        option(
            "--verify",
            f"Pixels from nodes to verify locally: {', '.join(VERIFY)}; all by default, some of large pictures.",
            "PART",
            "Where",
        ),
    ] = None

    @property
    def sides(self) -> tuple[int, int] | None:
        """The sides of --tile."""
        return None if self.tile is None else parse_sides(self.tile, "--tile")

    def on(self, rpc_is_set: bool) -> On | None:
        """Return where to render. InputError for options that exclude or need each other.

        rpc_is_set: whether nodes are from the environment, which other options override.
        """
        evm, cluster, jobs = self.evm, self.cluster, self.jobs
        rpc = () if rpc_is_set and not (evm is None and cluster is None) else self.rpc or ()
        if self.verify is not None and not rpc and cluster is None:
            raise InputError("--verify needs --rpc or --cluster")
        for name, given in (("--cluster", cluster), ("--evm", evm)):
            if rpc and given is not None:
                raise InputError(f"--rpc and {name} exclude each other: give one of them")
        if evm is not None and "://" in evm:
            raise InputError(f"--evm is the name of an EVM: give --rpc for the node {evm!r:.60}")
        for name, value in (("--address", self.address), ("--rpc-timeout", self.rpc_timeout)):
            if value is not None and not rpc:
                raise InputError(f"{name} needs --rpc")
        if cluster is not None:
            if cluster != LOCAL and ":" not in cluster:
                raise InputError(f"--cluster must be {LOCAL} or an address such as tcp://host:8786, not {cluster!r}")
            return Cluster(None if cluster == LOCAL else cluster, jobs, evm, self.verify)
        if rpc:
            calls = 1 if jobs is None else jobs
            return Nodes(*rpc, address=self.address, timeout=self.rpc_timeout, jobs=calls, verify=self.verify)
        return evm if jobs is None else Processes(jobs, evm)


def render(
    inputs: Inputs,
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
    *,
    film: FilmOptions,
    where: WhereOptions,
    look: Look,
) -> None:
    """Render mesh files, scene files or pieces of datasets."""
    with ExitStack() as stack:
        if quiet:
            stack.enter_context(redirect_stderr(io.StringIO()))
        sources = inputs_of(inputs, kind, stack)
        film.check()
        paths = outputs_of(sources, output, film.is_film)
        extensions = {PICTURE if path is None else path.suffix.lower() for path in paths} - {""}
        if transparent:
            for extension in extensions:
                check_alpha(extension, FILMS if film.is_film else FORMATS)
        on, sides = where.on(is_from_environment("rpc")), where.sides
        place_of(on)
        Bounds(where.gas_limit, sides)
        if where.evm is not None:
            open_chain(where.evm)
        exclusive = {
            "--tile": where.tile,
            "--gas-limit": where.gas_limit,
            "--turntable": film.turntable,
            "--frames": film.frames,
        }
        for name, given in exclusive.items():
            if fit is not None and given is not None:
                raise InputError(f"--fit and {name} exclude each other: give one of them")
        if scene and film.one_call:
            raise InputError("--scene and --one-call exclude each other: the contract's file has no scene")
        if transparent and film.one_call:
            raise InputError("--transparent and --one-call exclude each other: the contract's file has a background")
        if scene and extensions - {PICTURE}:
            raise InputError(f"--scene needs a {PICTURE} file, not {paths[0]}")
        task = Task(look, fit, film, transparent, scene, on, where.gas_limit, sides)
        if len(sources) > 1:
            render_all(sources, paths, task, "json" if as_json else None if quiet else "line")
            return
        done = render_to(sources[0], paths[0], task, JobProgress())
        if as_json or not quiet:
            print(done.json if as_json else done.words, file=sys.stderr if paths[0] is None else sys.stdout)


def stages(
    input: Input,
    output: Annotated[str, option("-o --output", "Folder for the pictures.", "DIR")],
    *,
    look: Look,
    evm: Evm = None,
) -> None:
    """Draw the result of each stage of the pipeline: six pictures, and a strip of all."""
    from ..stages import draw_stages, strip

    folder = check_output_folder(Path(output))
    made = draw_stages(load_with(input, look), open_chain(evm))
    pictures = {stage.name: PillowImage.fromarray(stage.pixels) for stage in made} | {"strip": strip(made)}
    make_output_folder(folder)
    for name, picture in pictures.items():
        stream = io.BytesIO()
        picture.save(stream, "png", optimize=True)
        write_output(folder / f"{name}.png", stream.getvalue())
    for stage in made:
        print(f"{folder / stage.name}.png: {stage.title.lower()}, {stage.detail}")
    print(folder / "strip.png")
