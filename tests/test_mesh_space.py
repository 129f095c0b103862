"""Flat faces are lit in the space of their mesh: from the same place whatever its unit is."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve

from judge import judge
from judge.verdict import MANY
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.bench.scenes import cube_mesh

LOOK = Material("flat", 0.2, 0.6, 0.6, 30)

#: What one writes down first: few vertices, all of them small whole numbers. By name the mesh, its middle and half its
#: size.
SMALL: dict[str, tuple[Mesh, tuple[float, float, float], float]] = {
    f"cube of +-{n}": (cube_mesh(n), (0, 0, 0), n) for n in (1, 2, 3, 5, 10, 50)
} | {
    "square of 0..1": (
        Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]),
        (0.5, 0.5, 0),
        0.5,
    ),
    "tetrahedron": (
        Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]),
        (0.3, 0.3, 0.3),
        0.5,
    ),
}


def view(mesh: Mesh, middle: tuple[float, float, float], size: float, angle: float, *, orthographic: bool) -> Scene:
    """The mesh from a direction, with a lamp near it and another that is farther away than the eye, in units of which
    its size is one third.
    """
    unit = 3.3 / size
    eye = 12.1 * np.array([np.sin(angle), 0.7 * np.cos(1.7 * angle), np.cos(angle)])
    camera = Camera(eye=tuple(eye), target=(0, 0, 0), near=0.5)
    if orthographic:
        camera = evolve(camera, projection="orthographic", half_height=5.0)
    place = tuple(-unit * np.asarray(middle))
    lamp, far = Light("point", (2.1, 5.3, 4.7)), Light("point", tuple(1.3 * eye + [1, 2, 3]), (90, 60, 200))
    thing = Object(mesh, place, scale=unit, material=LOOK, cull=False)
    return Scene([thing], camera, [lamp, far], width=64, height=64)


@pytest.mark.parametrize("orthographic", [False, True], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("name", SMALL)
def test_meshes_of_small_whole_numbers(name: str, orthographic: bool) -> None:
    mesh, middle, size = SMALL[name]
    pixels = 0
    for angle in (0.4, 1.9, 3.6, 5.5):
        verdict = judge(f"{name}, {angle}", view(mesh, middle, size, angle, orthographic=orthographic))
        pixels += verdict.interior
        assert verdict.faults == []
        assert verdict.worst <= MANY, angle
    assert pixels > 500


def test_the_unit_of_a_mesh_makes_no_difference() -> None:
    """The same cube as whole numbers and as fractions; either is sent with a scale of its own."""
    errors = []
    for size in (1.0, 1.01, 3.0, 0.7):
        scene = view(cube_mesh(1), (0, 0, 0), 1, 0.7, orthographic=False)
        (thing,) = scene.objects
        positions = thing.mesh.positions * size
        thing = evolve(thing, mesh=evolve(thing.mesh, positions=positions), scale=thing.scale / size)
        errors.append(judge(f"cube of {size}", evolve(scene, objects=[thing])).worst)
    assert max(errors) <= MANY


@pytest.mark.parametrize("distance", [30, 1000, 3000, 5500])
def test_from_far_away_with_the_near_plane_close_to_the_object(distance: int) -> None:
    scene = view(cube_mesh(1), (0, 0, 0), 1, 0.7, orthographic=False)
    eye = distance * np.array([0.48, 0.6, 0.64])
    camera = Camera(tuple(eye), (0, 0, 0), half_height=6 / distance, near=distance - 6)
    (thing,) = scene.objects
    scene = evolve(scene, camera=camera, objects=[evolve(thing, material=evolve(LOOK, shininess=120))])
    scene = evolve(scene, lights=[Light("directional", (1, 0.5, 0.9)), Light("point", (20, 30, 25))])
    verdict = judge(f"from {distance}", scene)
    assert verdict.faults == []
    assert verdict.interior > 500
    assert verdict.worst <= MANY
