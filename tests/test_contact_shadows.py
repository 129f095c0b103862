"""Shadows where surfaces meet: each visible sample is lit or dark by itself, as rays find it."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import NDArray

from conformance.shadows import PLACES, Array, random_scene, trace
from differential import compare
from pictures import chain, draw
from random_scenes import Case
from shackled import Camera, Light, Material, Mesh, Object, Scene, Texture, Tone
from shackled.datasets.common.shapes import sphere
from shackled.scene import Rectangle, fit

SIZE = 64
GRAY, AMBIENT, DIFFUSE = 200.0, 0.2, 0.8
#: A pixel is compared if nothing changes when its samples move by so much of a pixel; levels by which it may differ.
SHIFT, TOLERANCE = 0.04, 1.5

MATTE = Material("flat", AMBIENT, DIFFUSE, 0.0)
SUN = Light("directional", (0, 1, -1), shadow=True)


def box(size: tuple[float, float, float], place: tuple[float, float, float] = (0, 0, 0)) -> Object:
    """A gray box with edges of this size."""
    unit = (np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)) / 2
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)]
    faces += [(2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    return Object(Mesh(unit * size + place, faces, (200, 200, 200)), material=MATTE)


def ball(place: tuple[float, float, float]) -> Object:
    """A gray ball."""
    mesh = sphere(15, 9)
    return Object(
        Mesh(mesh.positions * 0.7 / np.abs(mesh.positions).max() + place, mesh.faces, "#c8c8c8"), material=MATTE
    )


#: It is opaque as far as one sees.
GROUND = Object(
    Mesh([(-40, 0, -40), (-40, 0, 40), (40, 0, 40), (40, 0, -40)], [(0, 1, 2), (0, 2, 3)], "#c8c8c8"),
    material=MATTE,
    fade=(30, 40),
)
PLATE, BLOCK, CROSSING = box((4, 0.4, 4)), box((1, 2, 1), (0, 0.3, 0)), box((0.8, 0.9, 0.7), (0.1, 0.3, 1.0))
LAMP = Light("point", (0.5, 2.5, -2.5), shadow=True)


def scene_of(objects: list[Object], light: Light = SUN) -> Scene:
    """The objects before black, seen from above."""
    return Scene(objects, Camera((0, 3, 4), (0, 0, 0)), [light], "#000000", width=SIZE, height=SIZE, antialias=True)


def right(scene: Scene) -> tuple[Array, NDArray[np.bool_]]:
    """The levels of the pixels of a scene in directional light as rays find them, (H, W), and where they are sure."""
    fitted = fit(scene)
    corners = np.concatenate([o.world_positions()[o.mesh.faces] for o in fitted.objects])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    toward = fitted.lights[0].vector / np.linalg.norm(fitted.lights[0].vector)
    lit = GRAY * (AMBIENT + DIFFUSE * np.maximum(normals @ toward, 0))
    total, sure = np.zeros(SIZE * SIZE), np.ones(SIZE * SIZE, bool)
    for x, y in PLACES:
        levels = []
        for dx, dy in ((0, 0), (SHIFT, 0), (-SHIFT, 0), (0, SHIFT), (0, -SHIFT)):
            found = trace(fitted, (x + dx, y + dy))
            level = np.where(found.dark, GRAY * AMBIENT, lit[found.face])
            levels.append(np.where(found.face < 0, 0, level))
        total += levels[0] / len(PLACES)
        sure &= np.ptp(levels, axis=0) < 1
    return total.reshape(SIZE, SIZE), sure.reshape(SIZE, SIZE)


@pytest.mark.parametrize(
    "scene",
    [
        scene_of([PLATE, BLOCK]),
        scene_of([BLOCK, PLATE]),
        scene_of([PLATE, ball((0, 0.1, 0))]),
        scene_of([ball((0, 0.1, 0)), PLATE]),
        scene_of([ball((0, 0.1, 0)), GROUND]),
        scene_of([BLOCK, PLATE, CROSSING]),
    ],
    ids=["plate, box", "box, plate", "plate, ball", "ball, plate", "ground", "three"],
)
def test_every_pixel(scene: Scene) -> None:
    """Interior pixels, edges and contact lines alike."""
    expected, sure = right(scene)
    drawn = draw(fit(scene))[:, :, 0].astype(float)
    assert sure.mean() > 0.8
    assert (np.abs(expected - np.rint(expected / GRAY) * GRAY) > TOLERANCE).sum() > 500
    wrong = sure & (np.abs(drawn - expected) > TOLERANCE)
    assert not wrong.any(), [(x, y, drawn[y, x], expected[y, x]) for y, x in np.argwhere(wrong)[:5]]


@pytest.mark.parametrize("light", [SUN, LAMP], ids=["directional", "point"])
def test_any_order(light: Light) -> None:
    """A later object may hide samples of a fragment that is partly in shadow: the picture is the same in any order."""
    pictures = [draw(fit(scene_of(list(each), light))) for each in permutations([PLATE, BLOCK, CROSSING])]
    assert all((each == pictures[0]).all() for each in pictures[1:])


def test_contact_line() -> None:
    """The line where a box enters a plate, in the shadow of the box, has the level of the shadow."""
    for objects in ([PLATE, BLOCK], [BLOCK, PLATE]):
        picture = draw(fit(evolve(scene_of(objects), width=96, height=96)))
        assert set(picture[51, 37:59, 0].tolist()) == {40}


@pytest.mark.parametrize("tone", [Tone(gamma=True), Tone(filmic=True)], ids=["gamma", "filmic"])
def test_the_tone_curve_comes_first(tone: Tone) -> None:
    """Pixels at the edge of a shadow are means of what is displayed, as those at outlines are."""
    scene = evolve(scene_of([box((60, 0.4, 60)), box((1, 0.2, 1), (0.2, 6, -4.5))]), tone=tone)
    picture = draw(fit(scene))[:, :, 0]
    dark = np.array([trace(fit(scene), place).dark for place in PLACES]).sum(axis=0).reshape(SIZE, SIZE)
    low, high = (float(picture[dark == count][0]) for count in (4, 0))
    assert high - low > 40
    for count in (1, 2, 3):
        levels = picture[dark == count].astype(float)
        assert len(levels) > 4
        assert (np.abs(levels - (count * low + (4 - count) * high) / 4) <= 1).mean() > 0.9


@pytest.mark.parametrize("seed", range(12))
def test_random_scenes(seed: int) -> None:
    """Contract and reference draw the same, and a tile is that part of the whole, whatever objects are made of."""
    rng = np.random.default_rng([7, seed])
    scene = random_scene(seed, 32)
    objects = list(scene.objects)
    for k in range(0, len(objects), 2):
        mesh = objects[k].mesh
        texture = Texture(rng.integers(0, 256, (3, 4, 3), dtype=np.uint8))
        objects[k] = [
            evolve(objects[k], opacity=0.6),
            evolve(objects[k], mesh=evolve(mesh, opacities=rng.random(len(mesh.positions)))),
            evolve(
                objects[k],
                mesh=evolve(mesh, uvs=rng.random((len(mesh.positions), 2))),
                material=evolve(objects[k].material, texture=texture),
            ),
            evolve(objects[k], material=Material("smooth", specular=0.5)),
        ][seed % 4]
    lights = [*scene.lights, Light.spot((1, 4, 2), (-1, -4, -2))][: 1 + seed % 2]
    tone = Tone(gamma=True) if seed % 3 == 0 else scene.tone
    found, _ = compare(
        Case(fit(evolve(scene, objects=objects, lights=lights, tone=tone)), Rectangle(5, 9, 19, 13)), chain()
    )
    assert found is None
