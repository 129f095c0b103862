"""Pictures with effects, and of glass, against `float64`, which is the judge of what OpenGL does not have."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from attrs import evolve

import float64
from pictures import Pixels, call_data, draw
from shackled import Fog, Rim, Scene, Tone
from shackled.scene import Hemisphere, fit

from .antialiasing import SAMPLES
from .compare import GRAZING, Result, outside
from .neighbours import around, interior, uniform

#: Levels by which a pixel that shows one triangle may be off: dark ones with gamma, of which linear values are small.
MOST = 4.0


def compare_effects(name: str, scene: Scene, draw: Callable[[Scene], Pixels] = draw) -> Result:
    """Compare the pixels that show one triangle, and behind it one of each object that is seen through others, as their
    neighbours do, of a scene with effects. What is not opaque is to be blended in the order of depths.

    Where a light grazes a surface, rounding decides on which side of the limit of its highlight a pixel is.
    """
    objects = [o for o in scene.objects if not o.wireframe]
    call = call_data("render", scene := fit(evolve(scene, objects=objects)))
    ours, expected = draw(scene), float64.render_call(call, by_depth=True)
    # samples at the border of the canvas may show what is beyond
    inner = np.pad(interior(expected.triangle)[1:-1, 1:-1], 1)
    for layer in expected.layers:
        inner &= uniform(layer)
    error = np.abs(ours - expected.exact)
    if (error[inner] > MOST).any():
        # a sliver may cover a sample, but no centre
        for place in SAMPLES.tolist():
            seen = float64.render_call(call, by_depth=True, place=tuple(place)).layers
            inner &= np.all([np.equal(*layers) for layers in zip(expected.layers, seen, strict=True)], axis=0)
    if (error[inner] > MOST).any():
        both = [around(float64.render_call(call, grazing, True).exact) for grazing in (-GRAZING, GRAZING)]
        error = np.minimum(error, outside(ours, np.concatenate(both)))
    largest = error.max(axis=2)
    far = np.argwhere(inner & (largest > MOST))
    faults = []
    if len(far):
        row, column = max(far, key=lambda place: float(largest[tuple(place)]))
        faults.append(
            f"{name}: {len(far)} interior pixels are off by more than {MOST:g} levels; pixel ({column}, {row}) is "
            f"{ours[row, column].tolist()} in place of {expected.exact[row, column].round(1).tolist()}"
        )
    return Result(
        scenes=1,
        empty=int(not (expected.triangle >= 0).any()),
        pixels=int((expected.triangle >= 0).sum()),
        interior=int(inner.sum()),
        error=float(error[inner].sum()),
        worst=float(largest[inner].max(initial=0.0)),
        faults=faults,
    )


def with_effects(scene: Scene, seed: int) -> Scene:
    """The scene with some effects, at least one; its fog is about the objects."""
    rng = np.random.default_rng([13, seed])
    forward = scene.camera.target - scene.camera.eye
    depths = (scene.world_positions() - scene.camera.eye) @ forward / np.linalg.norm(forward)
    low, high = max(float(depths.min(initial=0)), 0.0), max(float(depths.max(initial=0)), 1e-6)
    near = low + rng.uniform(0, 0.5) * (high - low)
    chosen = rng.random(4) < 0.5
    chosen[rng.integers(4)] = True
    color = rng.integers(0, 256, (4, 3))
    return evolve(
        scene,
        hemisphere=Hemisphere(color[0], color[1]) if chosen[0] else None,
        rim=Rim(color[2], int(rng.integers(1, 17))) if chosen[1] else None,
        fog=Fog(color[3], near, near + rng.uniform(0.2, 1) * (high - low) + 1e-6 * high) if chosen[2] else None,
        tone=Tone(rng.uniform(0.3, 2), bool(rng.random() < 0.5), bool(rng.random() < 0.7)) if chosen[3] else None,
    )
