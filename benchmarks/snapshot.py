"""The gas snapshot: exact figures in git, so that every change shows its price.

    python -m benchmarks.snapshot

measures everything and rewrites gas.json; what changed is printed. The figures of scenes that are not there are kept.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from attrs import evolve

from shackled import Camera, Light
from shackled.artifacts import artifact
from shackled.bench import scenes as paper
from shackled.datasets.genesis import seed_of
from shackled.scene.codec import Rectangle

from . import shared
from .measure import call, contract_figures, gas
from .original import original_call
from .scenes import (
    GLOSSY,
    LAMP,
    SUN,
    UNLIT,
    cube,
    cube_mesh,
    cubes,
    empty,
    room,
    square,
    staged_teapot,
)

FILE = Path(__file__).with_name("gas.json")

Figures = dict[str, int]
Snapshot = dict[str, Figures]

FOUR_LIGHTS = (
    SUN,
    LAMP,
    Light("directional", (-3, 1, 2), (255, 120, 60)),
    Light("point", (-400, -300, -1500), (60, 120, 255)),
)


def own_figures() -> Figures:
    """Scenes that need no file."""
    scenes = {
        "cube, 128": cube(128),
        "cube, 512": cube(512),
        "cube, orthographic, 128": evolve(cube(128), camera=Camera(projection="orthographic", half_height=1000)),
        "cube, point light, 128": cube(128, lights=(LAMP,)),
        "cube, unlit, 512": cube(512, UNLIT),
        "cubes that meet, 128": cubes(128),
        "empty, 128": empty(128),
        "experiment canvas, 8": paper.cube(8),
        "experiment canvas, 128": paper.cube(128),
        "experiment canvas, 128, orthographic": paper.cube(128, "orthographic"),
        "experiment canvas, 512": paper.cube(512),
        "experiment triangles, 1": paper.equal_triangles(1),
        "experiment triangles, 16": paper.equal_triangles(16),
        "room that is clipped, 128": room(128),
        "square of 2 triangles, point light, 128": square(1, 128, lights=(LAMP,)),
        "square of 2 triangles, smooth, 128": square(1, 128, evolve(GLOSSY, shading="smooth")),
        "square of 1152 triangles, 128": square(24, 128),
        "teapot, 127 x 95": staged_teapot("flat", (127, 95)),
        "teapot, four lights, 128": evolve(staged_teapot("flat", 128), lights=FOUR_LIGHTS),
        "teapot, four lights, smooth, 128": evolve(staged_teapot("smooth", 128), lights=FOUR_LIGHTS),
        "teapot, inverted, 128": staged_teapot("flat", 128, invert=True),
        "teapot, orthographic, 128": staged_teapot("flat", 128, projection="orthographic"),
    }
    for size in (128, 256):
        for shading in ("flat", "smooth", "unlit"):
            scenes[f"teapot, {shading}, {size}"] = staged_teapot(shading, size)
        scenes[f"teapot, wireframe, {size}"] = staged_teapot("unlit", size, wireframe=True)
    figures = {name: gas(scene) for name, scene in scenes.items()}

    teapot = staged_teapot("flat", 128)
    for function in ("renderCounted", "renderDataURI", "renderSVG"):
        figures[f"teapot, flat, 128, {function}"] = gas(teapot, function)
    figures["teapot, flat, 128, renderTile, the middle quarter"] = gas(teapot, "renderTile", Rectangle(32, 32, 64, 64))
    for svg in (False, True):
        figures[f"Original, cube, 128, {'SVG' if svg else 'BMP'}"] = call(
            "Original", original_call(cube_mesh(), 128, svg)
        ).gas
    return figures | genesis_figures()


def genesis_figures() -> Figures:
    """Seed to piece and seed to picture: the mean of the first pieces of the collection, and one that is dear."""
    figures = {}
    for function in ("generate", "render"):
        selector = artifact("Genesis").selectors[function]
        gas = [call("Genesis", selector + seed_of(number)).gas for number in range(64)]
        figures[f"Genesis, {function}, mean of 64 pieces"] = sum(gas) // len(gas)
        figures[f"Genesis, {function}, the dearest of 64 pieces"] = max(gas)
    return figures


def shared_figures() -> Figures:
    """The scenes of the cost table; nothing if they are not there."""
    return {name: gas(scene) for name, scene in shared.table_scenes().items()}


def take() -> Snapshot:
    """All figures that can be measured here."""
    snapshot = {"contracts": contract_figures(), "scenes": own_figures()}
    if shared.is_there():
        snapshot["scenes of the cost table"] = shared_figures()
    return snapshot


def recorded() -> Snapshot:
    """The figures of gas.json."""
    snapshot: Snapshot = json.loads(FILE.read_text("utf-8")) if FILE.exists() else {}
    return snapshot


def changes(old: Snapshot, new: Snapshot) -> tuple[list[str], list[str]]:
    """What rose or is new, and what fell or is gone, a line each; groups that were not measured are left out."""
    worse, better = [], []
    for group, figures in new.items():
        before = old.get(group, {})
        for name in sorted(before.keys() | figures.keys()):
            was, now = before.get(name), figures.get(name)
            if was is None:
                worse.append(f"{name}: {now:,}, not recorded yet")
            elif now is None:
                better.append(f"{name}: {was:,}, not measured any more")
            elif now != was:
                line = f"{name}: {was:,} -> {now:,} ({now - was:+,}, {(now - was) / was:+.2%})"
                (worse if now > was else better).append(line)
    return worse, better


def main() -> int:
    """The command."""
    old, new = recorded(), take()
    worse, better = changes(old, new)
    print("\n".join([*worse, *better]) or "no figure has changed")
    if not shared.is_there():
        print(f"scenes of the cost table: {shared.SKIPPED}; their figures are kept")
    FILE.write_text(json.dumps({**old, **new}, indent=1, sort_keys=True) + "\n", "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
