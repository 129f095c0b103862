"""Random scenes, up to the bounds of the contracts, and scenes of the original: the judge finds no wrong pixel.

`make fuzz` judges more of them; tests/evm/test_scenes.py runs them in several EVMs.
"""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from attrs import evolve
from benchmarks.shared import FOLDER

from judge import judge, judge_pixels, render
from original_scenes import documents
from pictures import Pixels, call, call_data, chain, draw, dynamic
from random_scenes import KINDS, Kind, broken_call, random_case
from shackled import Camera, Light, Material, Mesh, Object, RenderError, Scene, load
from shackled.artifacts import artifact
from shackled.image import decode_bmp
from shackled.scene import Rectangle, rotate
from shackled.scene._files.original import original_scene

SEEDS = 100
#: One in so many wild scenes may be wrong somewhere: their numbers are as large or as small as any may be.
WILD = 20


def draw_checked(scene: Scene, tile: Rectangle) -> tuple[Pixels, int]:
    """The pixels of a scene, of which a tile is a part, and how many are covered."""
    output = call("renderCounted", scene).output
    pixels = decode_bmp(dynamic(output), scene.width, scene.height)
    part = pixels[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]
    assert (draw(scene, tile) == part).all(), tile
    return pixels, int.from_bytes(output[64:96], "big")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("first", [1, 1 + SEEDS])
def test_random_scenes(kind: Kind, first: int) -> None:
    faults, drawn = [], []
    for seed in range(first, first + SEEDS):
        case = random_case(seed, (kind,))
        pixels, lit = draw_checked(case.scene, case.tile)
        drawn.append(lit > 0)
        faults += judge_pixels(f"{kind} {seed}", pixels, render(call_data("render", case.scene))).faults[:1]
    assert len(faults) <= (SEEDS / WILD if kind == "wild" else 0), faults
    # nearly all of them show something
    assert np.mean(drawn) >= 0.95


@pytest.mark.parametrize("seed", [170])
def test_a_scene_that_a_faulty_contract_draws_wrongly(seed: int) -> None:
    """170: changes of depth that leave their lane, in an EffectsEngine that takes their eighths from the lane alone."""
    assert judge(str(seed), random_case(seed).scene).faults == []


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
    """What is no scene is refused with an error of the interface; all else is a picture."""
    outcomes: Counter[str] = Counter()
    for seed in range(1, 501):
        data = broken_call(seed, call_data("renderCounted", random_case(seed).scene))
        try:
            found = dynamic(chain().call("Renderer", data).output)[:2].decode()
        except RenderError as error:
            found = str(error).partition("(")[0]
        outcomes[found] += 1
    assert outcomes.pop("BM") > 50
    assert outcomes.pop("the contract refused: the data of the call is not a scene that is encoded correctly") > 5
    names = {name for name, _ in artifact("Renderer").errors.values()}
    assert {text.removeprefix("the contract refused: ") for text in outcomes} <= names
    assert len(outcomes) > 20


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
