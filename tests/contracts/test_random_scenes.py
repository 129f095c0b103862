"""Random scenes, up to the bounds of the contracts, and scenes of the original: the judge finds no wrong pixel.

`make fuzz` judges more of them; tests/evm/test_scenes.py runs them in several EVMs.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from attrs import evolve
from benchmarks.shared import FOLDER

from judge import Verdict, judge, judge_pixels, render
from judge.verdict import MANY
from original_scenes import documents
from pictures import Pixels, call, call_data, draw, dynamic
from random_scenes import KINDS, random_case
from shackled import Camera, Light, Material, Mesh, Object, Scene, load
from shackled.image import decode_bmp
from shackled.scene._arithmetic import rotate
from shackled.scene._codec import Rectangle
from shackled.scene._files.original import original_scene

#: Of each kind, the seeds of small pictures that are judged.
SEEDS = range(1, 51)
#: How many pixels of scenes are wrong: a lamp is very close to a flat face; numbers are as large or as small as any may
#: be.
KNOWN = {("glass", 5): 4}
KNOWN |= {("wild", 11): 1, ("wild", 12): 97, ("wild", 31): 3, ("wild", 34): 1, ("wild", 47): 174}


def draw_checked(scene: Scene, tile: Rectangle) -> tuple[Pixels, int]:
    """The pixels of a scene, of which a tile is a part, and how many are covered."""
    output = call("renderCounted", scene).output
    pixels = decode_bmp(dynamic(output), scene.width, scene.height)
    part = pixels[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]
    assert (draw(scene, tile) == part).all(), tile
    return pixels, int.from_bytes(output[64:96], "big")


@pytest.mark.parametrize("kind", KINDS)
def test_random_scenes(kind: str) -> None:
    whole, lit, wrong = Verdict(), 0, {}
    for seed in SEEDS:
        case = random_case(seed, kind)
        pixels, count = draw_checked(case.scene, case.tile)
        lit += count > 0
        verdict = judge_pixels(f"{kind} {seed}", pixels, render(call_data("render", case.scene)))
        if verdict.faults:
            wrong[kind, seed] = verdict.far + verdict.outside
        else:
            whole += verdict
    assert wrong == {key: count for key, count in KNOWN.items() if key[0] == kind}
    assert whole.is_near, whole
    assert whole.worst <= MANY
    # nearly all of them show something
    assert lit >= 0.95 * len(SEEDS)


def test_random_scenes_are_of_all_sorts() -> None:
    scenes = [random_case(seed, kind).scene for kind in ("plain", "glass", "wild") for seed in range(1, 101)]
    objects = [o for scene in scenes for o in scene.objects]
    corners = [np.abs(o.mesh.positions).max() for o in objects]
    whites = [(o.mesh.colors == 255).all() for o in objects]
    bright = [max(o.material.ambient, o.material.diffuse, o.material.specular) > 1 for o in objects]
    far = [np.linalg.norm(s.world_positions() - s.camera.eye, axis=1).min() > 16 * size(s) for s in scenes]
    at_surface = [from_surface(s, w) <= 2.0**-8 for s in scenes for w in s.lights if w.kind != "directional"]
    for sort in (np.array(corners) <= 5, whites, bright, far, at_surface):
        assert np.mean(sort) > 0.08


def size(scene: Scene) -> float:
    """Of the largest object: the distance of its farthest vertex."""
    return max(o.scale * float(np.linalg.norm(o.mesh.positions, axis=1).max()) for o in scene.objects)


def from_surface(scene: Scene, light: Light) -> float:
    """How far a light is from the plane of a face that it is above, against the size of the face; the least of all."""
    found = [np.inf]
    for o in scene.objects:
        points = o.position + rotate(o.rotation, o.scale * o.mesh.positions)
        a, b, c = np.moveaxis(points[o.mesh.faces], 1, 0)
        normal, away = np.cross(b - a, c - a), light.vector - a
        area = np.linalg.norm(normal, axis=1)
        near = np.linalg.norm(away, axis=1) < 2 * np.sqrt(area)
        found += (np.abs((normal * away).sum(axis=1))[near] / area[near] ** 1.5).tolist()
    return min(found)


def test_a_scene_that_a_faulty_contract_draws_wrongly() -> None:
    """Its depths change by more than their lane holds: an EffectsEngine took their eighths from the lane alone."""
    assert judge("lanes", load(Path(__file__).parents[1] / "support" / "lanes.json")).faults == []


@pytest.mark.parametrize(
    "material",
    [None, Material("smooth", 0.2, 0.7, 0.5, 20), Material("flat", 0.2, 0.7, 0.5, 20)],
    ids=lambda material: material.shading if material else "as it is",
)
def test_scenes_as_the_original_was_measured_with(material: Material | None) -> None:
    for name, document in documents().items():
        scene = original_scene(document)
        if material:
            objects = [evolve(each, material=material) for each in scene.objects]
            scene = evolve(scene, objects=objects, lights=[Light("point", (500, 800, 0))])
        assert judge(name, scene).faults == []


TRIANGLE = Mesh([[-30000, -30000, 0], [30000, -30000, 0], [0, 30000, 0]], [[0, 1, 2]], normals=[[0, 0, 1]] * 3)


@pytest.mark.parametrize("shading", ["unlit", "flat", "smooth"])
@pytest.mark.parametrize("kind", ["point", "directional"])
def test_a_depth_that_rounds_to_zero(shading: str, kind: str) -> None:
    far = Object(TRIANGLE, (0, 0, -(2**25)), scale=2**6, material=Material(shading), cull=False)
    light = Light(kind, (0, 0, 2**25))
    scene = Scene([far], Camera(near=2.0**-32), [light], width=64, height=64)
    found = judge_pixels("far", draw(scene), render(call_data("render", scene)))
    assert found.faults == []
    assert found.interior == 8


@pytest.mark.parametrize(("width", "height"), [(2048, 27), (27, 2048), (2048, 256)])
@pytest.mark.parametrize("shading", ["unlit", "flat", "smooth"])
def test_large_canvases(width: int, height: int, shading: str) -> None:
    mesh = evolve(TRIANGLE, colors=np.eye(3, dtype=np.uint8) * 255)
    obj = Object(mesh, (0, 0, -1000), (0.3, 0.5, 0, 1), 0.02, Material(shading))
    lights = [Light("directional", (1, 1, 1)), Light("directional", (-1, 0, 1), (255, 90, 0))]
    scene = Scene([obj], Camera(near=1.0), lights, width=width, height=height)
    pixels, _ = draw_checked(scene, Rectangle(width // 3, height // 3, width // 2, height // 2))
    found = judge_pixels("large", pixels, render(call_data("render", scene)))
    assert found.faults == []
    assert found.worst <= 1


def test_models_of_the_original() -> None:
    paths = sorted(FOLDER.glob("obj_*.json"))
    if not paths:
        pytest.skip(f"there are no scenes of the original in {FOLDER}: set SHACKLED_SHARED")
    for path in paths:
        assert judge(path.stem, load(path)).faults == []
