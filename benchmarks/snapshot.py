"""Take the gas snapshot: exact figures in git, so that the cost of every change is visible.

    python -m benchmarks.snapshot

measures everything and rewrites gas.json; what changed is printed. The figures of scenes that are not there are kept.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

from attrs import evolve

from shackled import Camera, Light
from shackled.artifacts import RENDERER, artifact
from shackled.bench import scenes as paper
from shackled.bench._deploy import deployment_gas
from shackled.bench._measure import call, gas
from shackled.bench.scenes import GLOSSY, SUN, UNLIT, cube_mesh, square, turned_cube
from shackled.datasets.genesis import seed_of
from shackled.deploy._contract import STANDARD
from shackled.scene._codec import Rectangle

from . import read_figures, run_main, shared, unit_costs, write_figures
from .original.documents import call_data, document, mesh_keys
from .scenes import LAMP, cubes, empty, room, staged_teapot

FILE = Path(__file__).with_name("gas.json")
recorded = partial(read_figures, FILE)

Figures = dict[str, int]
Snapshot = dict[str, Figures]

ORTHOGRAPHIC = Camera(projection="orthographic", half_height=1000)
FOUR_LIGHTS = (
    SUN,
    LAMP,
    Light("directional", (-3, 1, 2), (255, 120, 60)),
    Light("point", (-400, -300, -1500), (60, 120, 255)),
)

#: Toward the upper right; power 2,000 at a distance of 50, as in the original's pieces.
ORIGINAL_LIGHT = {
    "lightSpecPower": 2000,
    "lightPos": [40, 30, 0],
    "lightColDiff": [1] * 3,
    "lightColAmbi": [0] * 3,
}


def own_figures() -> Figures:
    """Measure scenes that need no file."""
    scenes = {
        "cube, 128": turned_cube(128),
        "cube, 512": turned_cube(512),
        "cube, orthographic, 128": evolve(turned_cube(128), camera=ORTHOGRAPHIC),
        "cube, point light, 128": turned_cube(128, lights=(LAMP,)),
        "cube, unlit, 512": turned_cube(512, UNLIT),
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
        "teapot, orthographic, 128": staged_teapot("flat", 128, orthographic=True),
    }
    for size in (128, 256):
        for shading in ("flat", "smooth", "unlit"):
            scenes[f"teapot, {shading}, {size}"] = staged_teapot(shading, size)
        scenes[f"teapot, wireframe, {size}"] = staged_teapot("unlit", size, wireframe=True)
    for name in ("cubes that meet", "teapot, flat", "teapot, smooth", "teapot, unlit", "teapot, wireframe"):
        scenes[f"{name}, antialiased, 128"] = evolve(scenes[f"{name}, 128"], antialias=True)
    figures = {name: gas(scene) for name, scene in scenes.items()}

    teapot = staged_teapot("flat", 128)
    for function in ("renderCounted", "renderDataURI", "renderSVG"):
        figures[f"teapot, flat, 128, {function}"] = gas(teapot, function)
    figures["teapot, flat, 128, renderTile, the middle quarter"] = gas(teapot, "renderTile", Rectangle(32, 32, 64, 64))
    cube = document(128, ORIGINAL_LIGHT, **mesh_keys(cube_mesh()))
    for svg in (False, True):
        figures[f"Original, cube, 128, {'SVG' if svg else 'BMP'}"] = call("Original", call_data(cube, svg)).gas
    return figures | genesis_figures()


def genesis_figures() -> Figures:
    """Measure generation and picture of the first pieces: the mean, and the most expensive one."""
    figures = {}
    for function in ("generate", "render"):
        selector = artifact("Genesis").selectors[function]
        gas = [call("Genesis", selector + seed_of(number)).gas for number in range(64)]
        figures[f"Genesis, {function}, mean of 64 pieces"] = sum(gas) // len(gas)
        figures[f"Genesis, {function}, the dearest of 64 pieces"] = max(gas)
    return figures


def shared_figures() -> Figures:
    """Measure the scenes of the cost table; nothing if they are missing."""
    return {name: gas(scene) for name, scene in shared.table_scenes().items()}


def contract_figures() -> Figures:
    """Measure each contract that `shackled deploy` puts on a chain: bytes of its code, gas of its deployment."""
    figures = {"all that draws, code size": sum(len(artifact(name).runtime) for name in RENDERER)}
    for name in sorted(STANDARD):
        figures[f"{name} code size"] = len(artifact(name).runtime)
        figures[f"{name} deployment"] = deployment_gas(name)
    return figures


def take() -> Snapshot:
    """Measure all figures."""
    snapshot = {"contracts": contract_figures(), "scenes": own_figures(), "unit costs": unit_costs.figures()}
    if shared.is_there():
        snapshot["scenes of the cost table"] = shared_figures()
    return snapshot


def changes(old: Snapshot, new: Snapshot) -> tuple[list[str], list[str]]:
    """Return what rose or is new, and what fell or is gone, a line each; groups that were not measured are skipped."""
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
    """Measure, print the changes and write gas.json."""
    old, new = recorded(), take()
    worse, better = changes(old, new)
    print("\n".join([*worse, *better]) or "no figure has changed")
    if not shared.is_there():
        print(f"scenes of the cost table: {shared.SKIPPED}; their figures are kept")
    write_figures(FILE, {**old, **new}, sort_keys=True)
    return 0


if __name__ == "__main__":
    run_main(main)
