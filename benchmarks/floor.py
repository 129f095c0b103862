"""The least gas that a scene can need, by a count of the instructions of each stage; good to about 15 %."""

from __future__ import annotations

from shackled import Scene

from .workload import Workload

VERTEX = 250
FACE = 150
TRIANGLE = 900
LIT_TRIANGLE = 900
ROW = 153
TESTED_PIXEL = 74
#: Of a visible pixel that is lit for itself: by directional lights with a constant half vector, or by a point light.
DIRECTIONAL_PIXEL = 300
POINT_PIXEL = 680
#: Memory of a depth of 8 bytes, of which there are no more than a band has.
DEPTH_MEMORY = 2.75
BAND_PIXELS = 16384


def floor_of(scene: Scene, work: Workload) -> dict[str, int]:
    """By the names of stages in `stages`; a stage that is not there needs nothing."""
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
