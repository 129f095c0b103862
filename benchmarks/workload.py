"""What there is to do in a scene, counted by the reference renderer."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any
from unittest.mock import patch

from shackled import Scene, reference
from shackled.artifacts import artifact
from shackled.reference import fragment_shader, rasterizer
from shackled.scene import encode


@dataclass
class Workload:
    """Sums over all objects.

    drawn: triangles left after culling and clipping. rows: of them, also where they cover no pixel. tested: pixels
    whose depths are compared. lit: pixels of the picture that any triangle covers. canvas: all its pixels.
    """

    vertices: int
    faces: int
    drawn: int
    rows: int
    tested: int
    lit: int
    canvas: int


def workload_of(scene: Scene) -> Workload:
    """Draws the scene and counts."""
    data = encode(artifact("Renderer").selectors["renderCounted"], scene)
    with _counting() as counts:
        picture = reference.draw_call(data)
    return Workload(
        vertices=sum(len(o.mesh.positions) for o in scene.objects),
        faces=scene.triangles,
        drawn=picture.triangles,
        rows=counts["rows"],
        tested=counts["tested"],
        lit=picture.lit_pixels,
        canvas=scene.width * scene.height,
    )


@contextmanager
def _counting() -> Iterator[dict[str, int]]:
    """Counts what the rasterizer hands on while the context is open."""
    counts = {"rows": 0, "tested": 0}
    halves_of = rasterizer.halves_of

    def count(triangle: Any, registers: Any) -> Iterator[tuple[int, int, int, int, int]]:
        counts["rows"] += min(triangle.bottom, registers.band_bottom) - max(triangle.top, registers.band_top)
        for half in halves_of(triangle, registers):
            spans = fragment_shader.spans_between(*half, registers)
            counts["tested"] += sum(end - begin for _, begin, end, *_ in spans)
            yield half

    with patch.object(rasterizer, "halves_of", count):
        yield counts
