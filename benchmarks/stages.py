"""Profile pictures by stage.

    python -m benchmarks.stages FILE ...     any mesh or scene file

As `shackled gas` profiles it, beside the least that each stage could need.
"""

from __future__ import annotations

import argparse

from shackled import Scene, load
from shackled.bench._report import millions, table
from shackled.chain._layout import BAND_PIXELS
from shackled.gas import profile
from shackled.gas._stages import STAGES

from . import Section, run_main, shared
from .scenes import staged_teapot
from .workload import Workload, workload_of

TITLE = "Where the gas goes"

# The least gas for each unit of work, by counting instructions; accurate to about 15 %.
VERTEX = 250
FACE = 150
TRIANGLE = 900
LIT_TRIANGLE = 900
ROW = 153
TESTED_PIXEL = 74
#: A visible pixel that is lit exactly: by directional lights with a constant half vector, or by a point light.
DIRECTIONAL_PIXEL = 300
POINT_PIXEL = 680
#: Memory for a depth of 8 bytes; there are no more than the pixels of a band.
DEPTH_MEMORY = 2.75


def gas_by_stage(scene: Scene) -> dict[str, int]:
    """Return the execution gas of a render by stage; stages without gas are there with 0."""
    return profile(scene).stages()


def floor_of(scene: Scene, work: Workload) -> dict[str, int]:
    """Count the least gas that each stage of a scene can need; one that is not there needs nothing."""
    shadings = {o.material.shading for o in scene.objects}
    floor = {
        "vertex shader": VERTEX * work.vertices,
        "primitive assembly": FACE * work.faces,
        "triangle set-up": TRIANGLE * work.drawn,
        "rows of plain triangles": ROW * work.rows + TESTED_PIXEL * work.tested,
        "calls, bands, memory": round(DEPTH_MEMORY * min(work.canvas, BAND_PIXELS)),
    }
    if scene.lights and "flat" in shadings:
        floor["shading set-up"] = LIT_TRIANGLE * work.drawn
    has_point = any(light.kind != "directional" for light in scene.lights)
    has_highlight = any(o.material.specular > 0 for o in scene.objects if o.material.shading != "unlit")
    if scene.lights and (has_point or has_highlight or "smooth" in shadings) and shadings != {"unlit"}:
        floor["fragment shader"] = (POINT_PIXEL if has_point else DIRECTIONAL_PIXEL) * work.lit
    return floor


def section() -> Section:
    """Make the table of some scenes."""
    return report(_examples())


def report(scenes: dict[str, Scene]) -> Section:
    """Return the stages of each scene, beside their floor, as a table."""
    spent = {name: gas_by_stage(scene) for name, scene in scenes.items()}
    floors = {name: floor_of(scene, workload_of(scene)) for name, scene in scenes.items()}
    totals = [sum(spent[name].values()) for name in scenes]
    lines = [
        [stage, *(f"{millions(spent[name][stage])} / {millions(floors[name].get(stage, 0))}" for name in scenes)]
        for stage in STAGES
    ]
    bottoms = [sum(floors[name].values()) for name in scenes]
    lines.append(["together", *(f"{millions(a)} / {millions(b)}" for a, b in zip(totals, bottoms, strict=True))])
    lines.append(["times the floor", *(f"{a / b:.2f}" for a, b in zip(totals, bottoms, strict=True))])
    data = {name: {"gas": spent[name], "floor": floors[name]} for name in scenes}
    return Section(TITLE, EXPLANATION + table(["gas / floor", *scenes], lines), data)


EXPLANATION = (
    "The gas of every instruction, charged to the stage whose source it comes from, beside the floor: an estimate\n"
    "of the least gas, to about 15%: 250 per vertex, 150 per face, 900 per drawn triangle and 900 more if it is\n"
    "lit by a face normal, 153 per row of a triangle, 74 per tested pixel, 300 (directional lights) or 680 (a\n"
    "point light) per visible pixel that is lit separately, 2.75 for the memory of each pixel of a band of\n"
    "depths. Light that is interpolated over a triangle can cost less. The fragment shader processes the rows and\n"
    "tests the depths of all triangles that are not plain, so its floor and that of the rows belong together.\n\n"
)


def _examples() -> dict[str, Scene]:
    scenes = {f"teapot {shading}": staged_teapot(shading, 128) for shading in ("flat", "smooth")}
    if shared.is_there():
        table_scenes = shared.table_scenes()
        spot = "obj_spot_cull"
        names = [spot, spot + shared.UNLIT_SUFFIX, spot + shared.SMOOTH_SUFFIX, "genesis_000", shared.CUBE]
        scenes |= {name: table_scenes[name] for name in [*names, shared.QUAD + shared.LAMP_SUFFIX]}
    return scenes


def main() -> int:
    """Print the stages of the files that are named."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="files or pieces; none: those of results.md")
    names = parser.parse_args().names
    print(report({name: load(name) for name in names}).text if names else section().text)
    return 0


if __name__ == "__main__":
    run_main(main, has_options=True)
