"""Several inputs of one command: which they are, the names of their pictures, and what becomes of each."""

from __future__ import annotations

import io
import json
import os
import re
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, closing, redirect_stderr
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Literal, TypeVar

from attrs import evolve

from .._load import locate
from .._render import picture
from ..animation import check_animation
from ..base.untrusted import plain
from ..base.workers import each
from ..datasets._pieces import Piece
from ..errors import InputError, InputWarning, ShackledError
from ..image import check_output
from ..parallel.places import Cluster, Processes
from ..scene._files.content import is_pipe, read_pipe, stored
from ..scene._files.link import Link
from ..scene._files.mesh_file import READERS
from ..scene._files.picture import PICTURE
from ..scene._files.signatures import format_by_name
from .option import argument, with_options
from .output import Action, action, noting, print_note
from .picture import Done, Source, Work
from .progress import LateBar, Notes
from .streams import INPUT, STREAM, is_output, stdin_file

#: The argument of commands with several inputs.
INPUTS = argument(
    "Mesh or scene files, names of pieces, folders of mesh files, or - for standard input.", "INPUT", required=True
)
#: What stands for the name of an input, without folder and extension, in a pattern of outputs.
STEM = "{stem}"
#: The name of the picture of standard input.
UNNAMED = "picture"

#: How pictures are reported.
Report = Literal["json", "line"] | None

#: A picture that was rendered, or why not; and what was said meanwhile.
Outcome = tuple[Done | ShackledError, str]

Result = TypeVar("Result")
#: The most inputs that a line names.
MOST_NAMES = 3


def parse_shard(text: str, name: str) -> tuple[int, int]:
    """Return I and N of "I/N": a part of the inputs, numbered from 1, and the number of parts."""
    match = re.fullmatch(r"(\d{1,6})/(\d{1,6})", text)
    if not match or not 1 <= int(match[1]) <= int(match[2]):
        raise InputError(f"{name} must be the number of a part and of all parts, such as 1/4 to 4/4, not {text!r}")
    return int(match[1]), int(match[2])


def inputs_of(names: Sequence[str], stack: ExitStack) -> list[Source]:
    """Return the inputs with these names; of a folder, all mesh files in it.

    stack: removes the file in which standard input is stored.
    """
    if names.count(STREAM) > 1:
        raise InputError(f"{STREAM}, standard input, is one file: give it once")
    sources: list[Source] = []
    for name in names:
        if name == STREAM or is_pipe(name):  # which can be read once
            path = stack.enter_context(stdin_file() if name == STREAM else stored(read_pipe(name), name))
            sources.append(Source(name, str(path), UNNAMED, INPUT if name == STREAM else name))
            continue
        try:
            found = locate(name)
        except InputError:
            if len(names) == 1:
                raise
            found = Path(name)  # which fails when it is read, without stopping the others
        if isinstance(found, Piece):
            sources.append(Source(name, name, found.file_stem))
        elif isinstance(found, Link):
            sources.append(Source(str(found), name, found.stem))
        else:
            members = _meshes(found)
            if not members and len(names) == 1 and found.is_dir():
                raise InputError(f"the folder {name} has no mesh files in it, {' '.join(READERS)}")
            found_names = members or [name]
            sources += [Source(each, each, Path(each.removesuffix(".gz")).stem or UNNAMED) for each in found_names]
    return sources


def _meshes(folder: Path) -> list[str]:
    try:
        return sorted(str(path) for path in folder.iterdir() if format_by_name(path) in READERS and path.is_file())
    except OSError:  # not a folder, or reading it reports what is wrong
        return []


def outputs_of(sources: Sequence[Source], output: str | None, are_films: bool) -> list[Path | None]:
    """Return the files to write, None for standard output. InputError if two are one, or one cannot be written."""
    if is_output(output):
        if len(sources) > 1:
            raise InputError(f"standard output takes one picture, not {len(sources)}: give -o a folder or {STEM}.png")
        return [None]
    ending = ".gif" if are_films else PICTURE
    # a folder, or a pattern, whose folders are made if they do not exist
    is_pattern = output is not None and (STEM in output or output.endswith(("/", os.sep)))
    if output is None:
        # not over a picture whose scene is drawn
        names = [f"{each.stem}{'-rendered' if each.is_picture else ''}{ending}" for each in sources]
    elif STEM in output:
        names = [output.replace(STEM, each.stem) for each in sources]
    elif not are_films and (is_pattern or os.path.isdir(output)):
        names = [os.path.join(output, each.stem + ending) for each in sources]
    elif len(sources) == 1:
        names = [output]
    else:
        right = f"a pattern, such as out/{STEM}.gif" if are_films else f"a folder, such as out/, or out/{STEM}.png"
        raise InputError(f"{len(sources)} inputs need more than one file: give -o {right}, not {output}")
    check = check_animation if are_films else check_output
    paths = [check(name, is_pattern) for name in names]
    if len(sources) > 1:
        _check_overwriting(sources, paths)
    return [*paths]


def _check_overwriting(sources: Sequence[Source], paths: Sequence[Path]) -> None:
    taken: dict[str, str] = {}
    for source in sources:
        if os.path.isfile(source.place):
            taken[os.path.normcase(os.path.realpath(source.place))] = f"the input {source.name}"
    for source, path in zip(sources, paths, strict=True):
        where = os.path.normcase(os.path.realpath(path))
        if where in taken:
            raise InputError(f"the picture of {source.name} would overwrite {taken[where]}: {path}; nothing was drawn")
        taken[where] = f"that of {source.name}"


def render_all(work: Sequence[Work], report: Report) -> None:
    """Render each input, and print a report on it. ExceptionGroup of the errors of those that failed."""
    started, skipped = time.monotonic(), 0
    failed: list[ShackledError] = []
    notes: dict[str, list[str]] = {}
    with LateBar("rendering") as bar:
        for number, (place, (result, said)) in enumerate(_outcomes(work, bar), 1):
            name = work[place].source.name
            for line in said.splitlines():
                # the same note on other inputs is printed once
                alike = notes.setdefault(line.replace(name, STEM), [])
                alike.append(name)
                if len(alike) == 1:
                    bar.print(line if name in line or line.startswith("shackled:") else f"{name}: {line}")
            if isinstance(result, Done):
                skipped += result.is_skipped
                if report is not None:
                    bar.print(json.dumps(result.report) if report == "json" else plain(result.line), to_stdout=True)
            else:
                text = with_options(str(result))
                failed.append(ShackledError(text if name in text else f"{name}: {text}"))
                if report == "json":
                    bar.print(json.dumps({"input": name, "error": text}), to_stdout=True)
            bar.set(number, len(work))
    for first, *others in notes.values():
        if others:
            more = f" and {len(others) - MOST_NAMES} more" if len(others) > MOST_NAMES else ""
            print_note(f"shackled: the note on {first} is also true of {', '.join(others[:MOST_NAMES])}{more}")
    counts = f"{len(work) - len(failed) - skipped} rendered, " + (f"{skipped} skipped, " if skipped else "")
    summary = f"{counts}{len(failed)} failed, in {time.monotonic() - started:.1f} s"
    if failed:
        raise ExceptionGroup(summary, failed)
    print(summary, file=sys.stderr)


def _outcomes(work: Sequence[Work], bar: LateBar) -> Iterator[tuple[int, Outcome]]:
    """Yield the number of each input and what became of it, as they are done."""
    jobs, on = 1, work[0].task.how.on if work else None
    if isinstance(on, Cluster) and on.verify is None and not work[0].task.film.is_film:
        return enumerate(_on_cluster(work, on, bar))
    if isinstance(on, Processes):
        # a process for each input, instead of several for the parts of one
        how = evolve(work[0].task.how, on=on.evm)
        jobs, work = on.count, [replace(each, task=replace(each.task, how=how)) for each in work]
    return each(partial(_render, action()), work, jobs, lambda error: (error, ""))


def _render(notes: Action, work: Work) -> Outcome:
    return _heard(partial(work.render, Notes()), notes)


def _on_cluster(work: Sequence[Work], on: Cluster, bar: LateBar) -> Iterator[Outcome]:
    """Read inputs and write pictures here, in order, and draw each picture whole on a worker of a cluster."""
    from ..parallel._cluster import ClusterBackend

    task, notes = work[0].task, action()
    drawn = partial(picture, how=evolve(task.how, on=on.evm))

    def begun(each: Work) -> Callable[[], Outcome]:
        """Read an input, and have it drawn; return what waits for the picture and writes it."""
        loaded, said = _heard(each.load, notes)
        if isinstance(loaded, Done | ShackledError):
            return lambda: (loaded, said)
        scene = loaded[0][0]
        future = backend.submit(drawn, scene)

        def ended() -> Outcome:
            made = backend.wait(future, bar.warned)
            if isinstance(made, ShackledError):
                return made, said
            image = evolve(made, made_by=backend.name)
            done, more = _heard(partial(each.write, image, scene, time.perf_counter() - made.seconds), notes)
            return done, said + more

        return ended

    with closing(ClusterBackend(on.address, on.evm, task.how.gas_limit)) as backend:
        waiting = deque[Callable[[], Outcome]]()
        for each in work:
            waiting.append(begun(each))
            if len(waiting) > backend.slots:
                yield waiting.popleft()()
        while waiting:
            yield waiting.popleft()()


def _heard(function: Callable[[], Result], notes: Action) -> tuple[Result | ShackledError, str]:
    """Call a function; return its result or its error, and what it printed on stderr."""
    said = io.StringIO()
    with redirect_stderr(said), noting(notes):
        try:
            return function(), said.getvalue()
        except InputWarning as note:
            return InputError(str(note)), said.getvalue()
        except ShackledError as error:
            return error, said.getvalue()
