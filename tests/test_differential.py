"""The contracts against the reference renderer, byte for byte."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve
from benchmarks.shared import FOLDER

from differential import LEAST_DRAWN, compare, compare_broken, contract_answer, difference, reference_answer
from original_scenes import documents
from pictures import call_data, chain
from random_scenes import KINDS, Kind, random_case
from shackled import Camera, Light, Material, Mesh, Object, Scene, load
from shackled.reference import selector
from shackled.scene import Rectangle, encode, original_scene, rotate

SEEDS = 150


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("first", [1, 1 + SEEDS])
def test_random_scenes(kind: Kind, first: int) -> None:
    found, drawn = {}, []
    for seed in range(first, first + SEEDS):
        found[seed], whole = compare(random_case(seed, (kind,)), chain())
        drawn.append(isinstance(whole, bytes) and int.from_bytes(whole[64:96], "big") > 0)
    assert {seed: text for seed, text in found.items() if text} == {}
    # nearly all of them show something
    assert np.mean(drawn) >= LEAST_DRAWN


def test_random_scenes_are_of_all_sorts() -> None:
    scenes = [random_case(seed).scene for seed in range(1, 301)]
    objects = [o for scene in scenes for o in scene.objects]
    corners = [np.abs(o.mesh.positions).max() for o in objects]
    whites = [(o.mesh.colors == 255).all() for o in objects]
    bright = [max(o.material.ambient, o.material.diffuse, o.material.specular) > 1 for o in objects]
    far = [np.linalg.norm(np.subtract(s.camera.eye, s.camera.target)) > 16 * size(s) for s in scenes if s.objects]
    at_surface = [
        from_surface(s, w) <= 2.0**-8 for s in scenes if s.objects for w in s.lights if w.kind != "directional"
    ]
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


def test_broken_calls() -> None:
    outcomes = {seed: compare_broken(seed, chain()) for seed in range(1, 501)}
    assert {seed: text for seed, (text, _) in outcomes.items() if text} == {}
    errors = {answer.partition("(")[0] for _, answer in outcomes.values() if isinstance(answer, str)}
    assert len(errors) > 12


@pytest.mark.parametrize(
    "material",
    [None, Material("smooth", 0.2, 0.7, 0.5, 20), Material("flat", 0.2, 0.7, 0.5, 20)],
    ids=lambda material: material.shading if material else "as it is",
)
def test_scenes_as_the_original_was_measured_with(material: Material | None) -> None:
    found = {}
    for name, document in documents().items():
        scene = original_scene(document)
        if material:
            objects = [evolve(each, material=material) for each in scene.objects]
            scene = evolve(scene, objects=objects, lights=[Light("point", (500, 800, 0))])
        data = encode(selector("renderCounted"), scene)
        found[name] = difference(contract_answer(chain(), data), reference_answer(data))
    assert {name: text for name, text in found.items() if text} == {}


TRIANGLE = Mesh([[-30000, -30000, 0], [30000, -30000, 0], [0, 30000, 0]], [[0, 1, 2]], normals=[[0, 0, 1]] * 3)


@pytest.mark.parametrize("shading", ["unlit", "flat", "smooth"])
@pytest.mark.parametrize("kind", ["point", "directional"])
def test_a_depth_that_rounds_to_zero(shading: str, kind: str) -> None:
    far = Object(TRIANGLE, (0, 0, -(2**25)), scale=2**6, material=Material(shading), cull=False)
    light = Light(kind, (0, 0, 2**25))
    data = call_data("renderCounted", Scene([far], Camera(near=2.0**-32), [light], width=64, height=64))
    answer = reference_answer(data)
    assert isinstance(answer, bytes)
    assert difference(contract_answer(chain(), data), answer) is None


@pytest.mark.parametrize(("width", "height"), [(2048, 27), (27, 2048), (2048, 256)])
@pytest.mark.parametrize("shading", ["unlit", "flat", "smooth"])
def test_large_canvases(width: int, height: int, shading: str) -> None:
    mesh = evolve(TRIANGLE, colors=np.eye(3, dtype=np.uint8) * 255)
    obj = Object(mesh, (0, 0, -1000), (0.3, 0.5, 0, 1), 0.02, Material(shading))
    lights = [Light("directional", (1, 1, 1)), Light("directional", (-1, 0, 1), (255, 90, 0))]
    scene = Scene([obj], Camera(near=1.0), lights, width=width, height=height)
    tile = Rectangle(width // 3, height // 3, width // 2, height // 2)
    for data in (call_data("renderCounted", scene), call_data("renderTile", scene, tile)):
        assert difference(contract_answer(chain(), data), reference_answer(data)) is None


def test_models_of_the_original() -> None:
    paths = sorted(FOLDER.glob("obj_*.json"))
    if not paths:
        pytest.skip(f"there are no scenes of the original in {FOLDER}: set SHACKLED_SHARED")
    for path in paths:
        data = encode(selector("renderCounted"), load(path))
        assert not difference(contract_answer(chain(), data), reference_answer(data)), path.stem
