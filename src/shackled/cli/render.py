"""shackled render and stages"""

from __future__ import annotations

import io
import json
import sys
from contextlib import ExitStack, redirect_stderr
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from PIL import Image as PillowImage

from ..animation import FORMATS as FILMS
from ..base.whole_file import check_output_folder, make_output_folder, write_output
from ..chain._connection import PATIENCE
from ..chain._opening import CHAINS, open_chain
from ..errors import InputError
from ..image import FORMATS, check_alpha, one_of
from ..parallel.places import VERIFY, Cluster, Nodes, On, Processes, RenderOptions
from ..scene._files.picture import PICTURE
from .look_options import FIT, INPUT, load_with, parse_sides
from .option import exclude, is_from_environment, need, option
from .picture import FilmOptions, Task, Work
from .progress import JobProgress
from .several import INPUTS, inputs_of, outputs_of, parse_shard, render_all

EVM = option("--evm", f"EVM to draw in: {', '.join(CHAINS)}; default: revm.", "NAME", "Where")


@dataclass(frozen=True)
class WhereOptions:
    """Where calls run, and how a picture is split."""

    evm: str | None = EVM
    jobs: int | None = option(
        "--jobs",
        "Number of concurrent calls, on this machine or per node; number of processes if there are several inputs.",
        "N",
        "Where",
    )
    rpc: tuple[str, ...] = option(
        "--rpc",
        "Node to render on, with or without deployed contracts; may be repeated to share the work.",
        "URL",
        "Where",
        envvar="SHACKLED_RPC",
    )
    address: str | None = option("--address", "Address of a deployed renderer.", "ADDRESS", "Where")
    rpc_timeout: float | None = option(
        "--rpc-timeout", f"Timeout of a call to a node (default: {PATIENCE:g}).", "SECONDS", "Where"
    )
    cluster: str | None = option("--cluster", "Address of a dask scheduler, as tcp://host:8786.", "ADDRESS", "Where")
    gas_limit: int | None = option("--gas-limit", "Gas limit of a call; the picture is split to fit.", "GAS", "Where")
    tile: tuple[int, int] | None = option(
        "--tile", "Split the picture into parts of this size, as 128 or 1024x64.", "SIZE", "Where", parse=parse_sides
    )
    verify: str | None = option(
        "--verify",
        f"Pixels from nodes to verify locally: {', '.join(VERIFY)}; default: all, or some for large pictures.",
        "PART",
        "Where",
    )

    def on(self, rpc_is_set: bool) -> On | None:
        """Return where to render. InputError for options that exclude or need each other.

        rpc_is_set: whether nodes are from the environment, which other options override.
        """
        evm, cluster, jobs = self.evm, self.cluster, self.jobs
        rpc = () if rpc_is_set and not (evm is None and cluster is None) else self.rpc or ()
        need("--rpc or --cluster", rpc or cluster, {"--verify": self.verify})
        need("--rpc", rpc, {"--address": self.address, "--rpc-timeout": self.rpc_timeout})
        exclude("--rpc", rpc, {"--cluster": cluster, "--evm": evm})
        if evm is not None and "://" in evm:
            raise InputError(f"--evm is the name of an EVM: give --rpc for the node {evm!r:.60}")
        if cluster is not None:
            return Cluster(cluster, evm, self.verify)
        if rpc:
            calls = 1 if jobs is None else jobs
            return Nodes(*rpc, address=self.address, timeout=self.rpc_timeout, jobs=calls, verify=self.verify)
        return evm if jobs is None else Processes(jobs, evm)


def render(
    film: FilmOptions,
    where: WhereOptions,
    inputs: tuple[str, ...] = INPUTS,
    output: str | None = option(
        "-o --output",
        f"Output file: {one_of(FORMATS)}; for animations {one_of(FILMS)} or a folder. Named after INPUT by default. "
        "For several inputs, a folder such as out/ or a pattern such as 'out/{stem}.webp'; - is standard output.",
        "FILE",
    ),
    scene: bool | None = option(
        "--scene/--no-scene",
        "Write the scene into PNG files, which are then scene files too (default: if it takes at most 64 KB).",
        None,
        "Files",
    ),
    transparent: bool = option(
        "--transparent", "Make the background transparent, at twice the gas; same as --background none.", None, "Canvas"
    ),
    fit: str | None = FIT,
    skip_existing: bool = option(
        "--skip-existing", "Leave PNG files that show the same scene already as they are.", None, "Files"
    ),
    shard: tuple[int, int] | None = option(
        "--shard", "Render only the I-th of N parts of the inputs, as 2/4.", "I/N", "Files", parse=parse_shard
    ),
    as_json: bool = option("--json", "Print a JSON object instead of text, for each input.", None, "Files"),
    quiet: bool = option("-q --quiet", "Print only errors, and the output of --json.", None, "Files"),
    **look: Any,
) -> None:
    """Render mesh files, scene files or pieces of datasets."""
    with ExitStack() as stack:
        if quiet:
            stack.enter_context(redirect_stderr(io.StringIO()))
        sources = inputs_of(inputs, stack)
        film.check()
        paths = outputs_of(sources, output, film.is_film)
        extensions = {PICTURE if path is None else path.suffix.lower() for path in paths} - {""}
        if transparent:
            for extension in extensions:
                check_alpha(extension, FILMS if film.is_film else FORMATS)
        how = RenderOptions(where.on(is_from_environment("rpc")), where.gas_limit, where.tile, transparent=transparent)
        if where.evm is not None:
            open_chain(where.evm)
        parts = {"--tile": where.tile, "--gas-limit": where.gas_limit}
        exclude("--fit", fit, {**parts, "--turntable": film.turntable, "--frames": film.frames})
        exclude("--scene", scene, {"--one-call": film.one_call})
        exclude("--transparent", transparent, {"--one-call": film.one_call})
        exclude("--skip-existing", skip_existing, {"--no-scene": scene is False})
        exclude("--skip-existing", skip_existing, {"--turntable": film.turntable, "--frames": film.frames})
        if scene and extensions - {PICTURE}:
            raise InputError(f"--scene needs a {PICTURE} file, not {paths[0]}")
        if skip_existing and (None in paths or extensions - {PICTURE}):
            raise InputError(f"--skip-existing needs {PICTURE} files, which say what they show, not {paths[0] or '-'}")
        is_batch = len(sources) > 1
        count = as_json or not (quiet or is_batch)
        task = Task(look, fit, film, scene, how, count, skip_existing)
        work = [Work(source, path, task) for source, path in zip(sources, paths, strict=True)]
        if is_batch or shard is not None:
            first, step = shard or (1, 1)
            render_all(work[first - 1 :: step], "json" if as_json else None if quiet else "line")
            return
        done = work[0].render(JobProgress())
        if as_json or not quiet:
            print(
                json.dumps(done.report) if as_json else done.words, file=sys.stderr if paths[0] is None else sys.stdout
            )


def stages(
    input: str = INPUT,
    output: str = option("-o --output", "Folder for the pictures.", "DIR"),
    evm: str | None = EVM,
    **look: Any,
) -> None:
    """Draw the result of each stage of the pipeline: six pictures, and a strip with all of them."""
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
