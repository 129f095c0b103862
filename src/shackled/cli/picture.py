"""Render one input to a file, and say what was done."""

from __future__ import annotations

import hashlib
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from attrs import evolve

from .._load import load_frames
from .._render import film as draw_film
from .._render import pace, picture, turn
from .._visible import why_nothing
from ..animation import DURATION, Animation, check_duration
from ..base.values import plural
from ..base.whole_file import make_output_folder
from ..chain._opening import open_chain
from ..errors import ChainError, renaming
from ..gas._limits import Fit, fits_as_json, fits_of, headline, render_call
from ..gas._search import suffices
from ..image import MOST_COLORS, Image, colors, total
from ..parallel._scheduler import Listener
from ..parallel._store import folder_of, remove_parts
from ..parallel.places import RenderOptions
from ..scene._files.picture import PICTURE, scene_chunk, shows_scene
from ..scene._scene import Scene
from .look_options import load_with
from .option import exclude, need, option, with_options
from .progress import LateBar
from .streams import OUTPUT, STREAM, write_stdout


@dataclass(frozen=True)
class Source:
    """An input of a command.

    name: as it was given. place: a path, or the name of a piece. stem: of the name of its picture. stored: what
    messages call it, if it is standard input or a pipe, which is stored in a file at its place.
    """

    name: str
    place: str
    stem: str
    stored: str | None = None

    @property
    def is_picture(self) -> bool:
        """Whether its scene is in a picture."""
        return self.stored is None and self.place.lower().endswith(PICTURE)

    @contextmanager
    def named(self) -> Iterator[None]:
        """Let messages not name the file in which it is stored."""
        with nullcontext() if self.stored is None else renaming(self.place, self.stored):
            yield


@dataclass(frozen=True)
class FilmOptions:
    """Which frames are rendered, if several are."""

    turntable: int | None = option("--turntable", "Render a full turn in this many frames.", "FRAMES")
    frames: int | None = option(
        "--frames", "Render an animation, the first one by default, in this many frames.", "N", "glTF files"
    )
    duration: int | None = option(
        "--duration",
        f"Duration of a frame (default: {DURATION}, or the pace of the animation of the file).",
        "MILLISECONDS",
        "Turntable",
    )
    one_call: bool = option(
        "--one-call", "Make the whole animated PNG in one call of a contract, as for a token.", None, "Turntable"
    )

    @property
    def is_film(self) -> bool:
        """Whether there are several frames."""
        return self.turntable is not None or self.frames is not None

    def check(self) -> None:
        """Raise InputError for options that exclude or need each other."""
        if self.duration is not None:
            check_duration(self.duration)
        need("--turntable or --frames", self.is_film, {"--duration": self.duration})
        need("--turntable", self.turntable, {"--one-call": self.one_call})
        exclude("--turntable", self.turntable, {"--frames": self.frames})


@dataclass(frozen=True)
class Task:
    """What is to be done with each input: the options of `shackled render`."""

    look: dict[str, Any]
    fit: str | None
    film: FilmOptions
    scene: bool | None
    how: RenderOptions
    #: Whether triangles and lit pixels are counted, by a second call.
    count: bool = True
    #: Whether a file that shows the same scene is left as it is.
    skip_existing: bool = False


@dataclass(frozen=True)
class Done:
    """What was done.

    report: the object of --json. scene: size of the scene in bytes, or None to omit the line.
    """

    report: dict[str, Any]
    scene: int | None = None
    fits: tuple[Fit, ...] | None = None

    @property
    def is_skipped(self) -> bool:
        """Whether the file was there already."""
        return "skipped" in self.report

    @property
    def words(self) -> str:
        """The report in several lines."""
        if self.is_skipped:
            return self.line
        report, scene, fits = self.report, self.scene, self.fits
        frames, calls = report["frames"], report["calls"]
        several = f"{frames} frames of " if frames > 1 else ""
        output = OUTPUT if report["output"] == STREAM else report["output"]
        rows = {"picture": f"{output}, {several}{report['width']} x {report['height']} pixels"}
        if report["triangles"] is not None and report["lit_pixels"] is not None:
            rows["drawn"] = f"{plural(report['triangles'], 'triangle')}, {plural(report['lit_pixels'], 'lit pixel')}"
        rows["gas"] = "not counted"
        if report["gas"] is not None and report["intrinsic_gas"] is not None:
            sent = "the scene" if calls == 1 else f"the scene {calls} times"
            rows["gas"] = f"{report['gas']:,}{_in_calls(report)} (and {report['intrinsic_gas']:,} to send {sent})"
        if fits is not None:
            each = f"each of its {calls} calls: " if calls > 1 else ""
            rows["fits"] = each + headline(fits)
        if scene is not None:
            size = f"{scene / 1024:.1f} KB"
            left_out = f"not in the file, as it takes {size}: --scene writes it"
            rows["scene"] = left_out if report["scene_bytes"] is None else f"in the file, {size}"
        rows |= {"chain": report["chain"], "time": f"{report['seconds']:.3f} s"}
        return "\n".join(f"{name:8} {value}" for name, value in rows.items())

    @property
    def line(self) -> str:
        """The report in one line."""
        report = self.report
        if self.is_skipped:
            return f"{report['input']} -> {report['output']}: skipped, as it shows the same scene already"
        gas = "" if report["gas"] is None else f", {report['gas']:,} gas{_in_calls(report)}"
        fits = "" if self.fits is None else f"; {headline(self.fits)}"
        size = f"{report['width']} x {report['height']} pixels"
        frames = f", {report['frames']} frames" if report["frames"] > 1 else ""
        return f"{report['input']} -> {report['output']}: {size}{frames}{gas}{fits}"


def _in_calls(report: dict[str, Any]) -> str:
    """Return what is said of the gas of a picture that took several calls, which is more than that of one."""
    calls = report["calls"] // report["frames"]
    return (f" in {calls} calls" + (" for each frame" if report["frames"] > 1 else "")) if calls > 1 else ""


@dataclass(frozen=True)
class Work:
    """An input, the file of its picture, which is None for standard output, and what is to be done."""

    source: Source
    path: Path | None
    task: Task

    def load(self) -> tuple[list[Scene], int] | Done:
        """Return the scene, or the frames of an animation, and their duration; what was done if that is all."""
        source, path, task = self.source, self.path, self.task
        with source.named():
            if task.film.frames is None:
                scenes, length = [load_with(source.place, task.look, task.fit)], None
            else:
                with LateBar("reading"):
                    scenes, length = load_frames(source.place, task.film.frames, **task.look)
        if task.scene:
            scene_chunk(scenes[0]).check()
        if task.skip_existing and path is not None and shows_scene(path, scenes[0], task.how.transparent):
            return Done({"input": source.name, "output": str(path), "skipped": True})
        if path is not None:
            make_output_folder(path.parent)
        if task.film.duration is not None:
            return scenes, task.film.duration
        return scenes, DURATION if length is None else pace(length, len(scenes))

    def render(self, listener: Listener) -> Done:
        """Render the input to the file."""
        loaded = self.load()
        if isinstance(loaded, Done):
            return loaded
        scenes, duration = loaded
        scene, path, task, film = scenes[0], self.path, self.task, self.task.film
        in_parts = not film.one_call and (film.is_film or not task.how.is_one_call(scene))
        keep = folder_of(path) if in_parts and path is not None else None
        how = evolve(task.how, listener=listener, keep=keep)
        started = time.perf_counter()
        made: Image | Animation
        with nullcontext() if in_parts else LateBar("rendering"):
            if film.turntable is not None:
                made = turn(scene, film.turntable, duration, how, film.one_call)
            else:
                made = picture(scene, how) if film.frames is None else draw_film(scenes, duration, how)
        try:
            done = self.write(made, scene, started)
        except BaseException:
            if keep is not None and keep.is_dir():
                listener.warned(f"finished parts are kept in {keep}: run the same command to resume")
            raise
        if keep is not None:
            remove_parts(keep)
        return done

    def write(self, made: Image | Animation, scene: Scene, started: float) -> Done:
        """Write what was drawn of a scene since a time of `perf_counter`, and count what it shows."""
        path, task = self.path, self.task
        extension = PICTURE if path is None else path.suffix.lower()
        with LateBar("writing"):
            if path is None:
                write_stdout(made.encode(PICTURE, task.scene))
            else:
                made.save(path, scene=task.scene)
        frames = [made] if isinstance(made, Image) else made.frames
        chunk = frames[0].scene_chunk if extension in (PICTURE, "") and task.scene is not False else None
        written = len(chunk.data) if chunk is not None and (task.scene or chunk.is_small) else None
        with LateBar("counting"):
            triangles, lit_pixels, shows_something = _counted(made, task.count)
            fits = fits_of_made(made, scene)
        digest = hashlib.sha256()
        for frame in frames:
            digest.update(frame.channels.tobytes())
        report = {
            "input": self.source.name,
            "width": scene.width,
            "height": scene.height,
            "triangles": triangles,
            "lit_pixels": lit_pixels,
            "gas": made.gas,
            "intrinsic_gas": made.intrinsic_gas,
            "seconds": round(time.perf_counter() - started, 6),
            "chain": frames[0].made_by,
            "output": STREAM if path is None else str(path),
            "sha256": digest.hexdigest(),
            "scene_bytes": written,
            "fits": None if fits is None else fits_as_json(fits),
            "frames": len(frames),
            "calls": made.calls,
        }
        if not shows_something:
            tell_why_nothing(scene, frames[0].evm)
        if extension == ".gif" and (found := colors([frame.pixels for frame in frames])) > MOST_COLORS:
            whose = "picture" if len(frames) == 1 else "frames"
            text = f"a GIF has at most {MOST_COLORS} colours; the {found:,} of the {whose} were mapped to the nearest"
            print(text, file=sys.stderr)
        return Done(report, None if chunk is None else len(chunk.data), fits)


def tell_why_nothing(scene: Scene, evm: str | None = None) -> None:
    """Print that a picture shows only the background, and the likely cause."""
    with suppress(ChainError):
        print(with_options(why_nothing(scene, evm)), file=sys.stderr)
    print("nothing is visible; the picture shows only the background", file=sys.stderr)


def _counted(made: Image | Animation, count: bool) -> tuple[int | None, int | None, bool]:
    """Return the triangles and lit pixels of a picture, None where they are not known, and whether anything shows.

    The picture is already written: what fails here is only told.
    """
    frames = [made] if isinstance(made, Image) else made.frames
    try:
        # a background has one colour in each row: only what looks like one is compared with it
        shows = any((each.pixels != each.pixels[:, :1]).any() or each.visible_pixels != 0 for each in frames)
        if count and isinstance(made, Image):
            return made.triangles, made.visible_pixels, shows
        return None, None, shows
    except ChainError as error:
        print(f"shackled: triangles and lit pixels were not counted: {error}", file=sys.stderr)
        return None, None, True


def fits_of_made(made: Image | Animation, scene: Scene) -> tuple[Fit, ...] | None:
    """Return how each call that made a picture fits into the known limits; None where no gas is counted."""
    if isinstance(made, Image):
        gas = made.call_gas
    else:
        gas = total((frame.call_gas for frame in made.frames), max) if made.file is None else made.gas
    if gas is None:
        return None
    data = render_call(scene)
    # gas is the same everywhere
    enough = suffices(open_chain(), "Renderer", data) if made.calls == 1 and isinstance(made, Image) else None
    return fits_of(gas, data, enough)
