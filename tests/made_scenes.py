"""Scenes made by hand, and those that the original was measured with."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from attrs import evolve

from original_scenes import OBJECTS, documents, genesis_document, object_document
from pictures import UNLIT
from shackled import Background, Camera, Light, Material, Mesh, Object, Scene
from shackled.bench.scenes import GLOSSY, SUN, turned_cube
from shackled.datasets import teapot
from shackled.scene import original_scene, vertex_normals


def scenes_of_the_original() -> dict[str, Callable[[], Scene]]:
    """Those of the kinds that the original was measured with, and objects, each in three materials."""

    found: dict[str, Callable[[], Scene]] = {}
    for name in OBJECTS:
        made = partial(original_scene, object_document(name))
        found[f"{name}, as it is"] = made
        found[f"{name}, smooth, point light"] = lambda made=made: smooth(made())  # type: ignore[misc]
        found[f"{name}, unlit"] = lambda made=made: unlit(made())  # type: ignore[misc]
    for number in range(24):
        found[f"genesis {number}"] = lambda n=number: solid(original_scene(genesis_document(n)))  # type: ignore[misc]
    for name in ("cube perspective 128", "cube orthographic 128", "quad", "unlit ball", "highlight from left"):
        found[name] = lambda name=name: solid(original_scene(documents()[name]))  # type: ignore[misc]
    found["quad, frontal point light"] = lambda: frontal(original_scene(documents()["quad"]))
    return found


def smooth(scene: Scene) -> Scene:
    """The scene with interpolated normals, and a point light above to the right, on the eye's side of the object."""
    (thing,) = scene.objects
    points = thing.mesh.positions * thing.scale + thing.position
    low, high = points.min(axis=0), points.max(axis=0)
    light = (low + high) / 2 + (high - low).max() * np.array([1.0, 1.0, 1.5])
    material = Material("smooth", ambient=0.3, diffuse=0.7, specular=0.5, shininess=20)
    return evolve(scene, objects=[evolve(thing, material=material)], lights=[Light("point", light)])


def solid(scene: Scene) -> Scene:
    """The scene without wireframe, which is drawn by rules of its own."""
    return evolve(scene, objects=[evolve(o, wireframe=False) for o in scene.objects])


def unlit(scene: Scene) -> Scene:
    """The scene without light."""
    return evolve(scene, objects=[evolve(o, material=Material("unlit")) for o in scene.objects], lights=[])


def frontal(scene: Scene) -> Scene:
    """The scene with the highlight of a point light in its middle."""
    material = Material("flat", ambient=0.3, diffuse=0.7, specular=0.5, shininess=20)
    objects = [evolve(o, material=material) for o in scene.objects]
    return evolve(scene, objects=objects, lights=[Light("point", (0, 0, -1500))])


GREYS = ((100, 100, 100),) * 3
WHITE, RED, GREEN, BLUE = (255, 255, 255), (255, 60, 40), (60, 255, 90), (70, 110, 255)

LIGHTS = (
    Light("directional", (1, 2, 2), WHITE),
    Light("point", (-8, 6, 4), RED),
    Light("directional", (-2, 0.5, 1), BLUE),
    Light("point", (5, 1, 6), GREEN),
)


def teapot_scene(lights: int = 1, first: int = 0, *, distance: float = 9.0, **material: Any) -> Scene:
    """The teapot with some of the four lights."""
    look = Material("smooth", **{"ambient": 0.25, "diffuse": 0.6, "specular": 0.5, "shininess": 30} | material)
    return Scene(
        [Object(painted(teapot(5)), position=(0, -1.4, 0), material=look)],
        Camera(eye=(0.2 * distance, 0.35 * distance, 0.92 * distance), target=(0, 0, 0)),
        lights=[LIGHTS[(first + i) % 4] for i in range(lights)],
        background=Background((20, 30, 60), (200, 210, 220)),
    )


def painted(mesh: Mesh) -> Mesh:
    """The mesh with colours that change along its axes."""
    points = mesh.positions
    part = (points - points.min(axis=0)) / np.maximum(np.ptp(points, axis=0), 1e-9)
    return evolve(mesh, colors=np.rint(80 + 150 * part).astype(int))


def flat(scene: Scene) -> Scene:
    """The scene with the normals of faces."""
    return evolve(scene, objects=[evolve(o, material=evolve(o.material, shading="flat")) for o in scene.objects])


def ground(
    material: Material, lights: list[Light], size: float = 4000.0, step: int = 1, half_height: float = 0.466
) -> Scene:
    """A plane from beneath the eye to the horizon, of 2 step^2 triangles."""
    line = np.linspace(-1, 1, step + 1)
    x, z = (v.ravel() for v in np.meshgrid(line, line))
    points = size * np.stack([x, 0 * x, -z], axis=1)
    grid = np.arange((step + 1) ** 2).reshape(step + 1, step + 1)
    a, b, c, d = (v.ravel() for v in (grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]))
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    mesh = Mesh(points, faces, normals=vertex_normals(points, faces))
    mesh = evolve(mesh, colors=np.stack([200 + 50 * x, 120 + 100 * z, 150 - 100 * x], axis=1).astype(int))
    camera = Camera(eye=(0, 10, 0), target=(0, 6, -20), near=0.5, half_height=half_height)
    return Scene([Object(mesh, material=material)], camera, lights, Background((90, 120, 250)))


def big_triangles(material: Material, lights: list[Light]) -> Scene:
    """Three triangles that come close to the eye and reach far beyond the picture."""
    points = np.array(
        [
            [[-60, -8, -2], [90, -20, -30], [-5, 70, -100]],
            [[-3, -3, -1.5], [3, -2, -60], [-2, 5, -12]],
            [[40, -40, 5], [30, 50, -80], [-10, 4, -90]],
        ],
        dtype=np.float64,
    )
    colors = [[255, 40, 30], [30, 250, 60], [40, 80, 255], [250, 250, 30], [30, 240, 240], [230, 40, 250]]
    colors += [[200, 200, 200], [0, 0, 0], [255, 255, 255]]
    mesh = Mesh(points.reshape(-1, 3), np.arange(9).reshape(-1, 3), colors)
    mesh = evolve(mesh, normals=vertex_normals(mesh.positions, mesh.faces))
    return Scene([Object(mesh, material=material, cull=False)], Camera(near=0.5), lights)


def made_scenes() -> dict[str, Callable[[], Scene]]:
    """Scenes made by hand."""
    near_light = Light("point", (1.2, 1.6, 2.6), WHITE)
    matt = Material("smooth", ambient=0.2, diffuse=0.8, specular=0.0)
    shiny = Material("smooth", ambient=0.2, diffuse=0.6, specular=0.6, shininess=40)
    sun, lamp = Light("directional", (1, 2, -1)), Light("point", (3, 5, -18))
    walls, shiny_walls = evolve(matt, shading="flat"), evolve(shiny, shading="flat")
    found: dict[str, Callable[[], Scene]] = {}
    for count in range(1, 5):
        for first in range(2 if count < 4 else 1):
            kind = "directional" if first == 0 else "point"
            name = f"teapot, {count} lights, {kind} first"
            found[name] = lambda count=count, first=first: teapot_scene(count, first)  # type: ignore[misc]
            found[f"{name}, flat"] = lambda count=count, first=first: flat(teapot_scene(count, first))  # type: ignore[misc]
    for shininess in (1, 2, 5, 128):
        for first, kind in ((0, "directional"), (1, "point")):
            make = lambda s=shininess, f=first: teapot_scene(1, f, shininess=s, specular=0.9)  # noqa: E731
            found[f"teapot, shininess {shininess}, {kind}"] = make
            found[f"teapot, shininess {shininess}, {kind}, flat"] = lambda make=make: flat(make())  # type: ignore[misc]
    found |= {
        "teapot, overexposed": lambda: teapot_scene(2, ambient=1.5, diffuse=2.5, specular=3.0, shininess=10),
        "teapot, coarse mesh": lambda: coarse_teapot(1),
        "teapot, coarse mesh, 4 lights": lambda: coarse_teapot(4),
        "teapot, inverted": lambda: evolve(teapot_scene(2), invert=True),
        "teapot, turned": lambda: turned(teapot_scene(2)),
        "teapot, both sides": lambda: both_sides(teapot_scene(1, 1)),
        "teapot, close point light": lambda: evolve(teapot_scene(), lights=[near_light]),
        "teapot, close point light, flat": lambda: evolve(flat(teapot_scene()), lights=[near_light]),
        "teapot, wide field of view": lambda: wide(teapot_scene(1, 1, distance=3.6)),
        "teapot, wide field of view, 4 lights": lambda: wide(teapot_scene(4, distance=3.6)),
        "teapot, wide field of view, flat": lambda: wide(flat(teapot_scene(1, 1, distance=3.6))),
        "teapot, very near": lambda: teapot_scene(1, 1, distance=3.4),
        "teapot, orthographic": lambda: orthographic(teapot_scene(1)),
        "teapot, orthographic, point light": lambda: orthographic(teapot_scene(1, 1)),
        "teapot, orthographic, 4 lights": lambda: orthographic(teapot_scene(4)),
        "teapot, orthographic, 4 lights, flat": lambda: orthographic(flat(teapot_scene(4))),
        "ground, unlit": lambda: ground(Material("unlit"), []),
        "ground, flat, directional": lambda: ground(shiny_walls, [sun]),
        "ground, flat, point": lambda: ground(shiny_walls, [lamp]),
        "ground, matt, point": lambda: ground(walls, [lamp]),
        "ground, smooth, directional": lambda: ground(shiny, [sun]),
        "ground, smooth, point": lambda: ground(shiny, [lamp]),
        "ground, smooth, both": lambda: ground(shiny, [sun, lamp]),
        "ground of 512 triangles, smooth, point": lambda: ground(shiny, [lamp], 300.0, 16),
        "ground of 512 triangles, unlit": lambda: ground(Material("unlit"), [], 300.0, 16),
        "ground, wide field of view": lambda: ground(shiny_walls, [sun, lamp], half_height=2.5),
        "sliver, unlit": lambda: screen_triangle(
            ((13.6, -67.2), (2.2, 145.7), (16, 80.6)),
            (19.5, 9.6, 32.8),
            ((157, 206, 225), (208, 235, 1), (68, 158, 231)),
        ),
        "triangle whose far and near corners differ most, unlit": lambda: screen_triangle(
            ((60, 5), (5, 100), (120, 100)), (1000, 1099, 917), ((128, 128, 128), (0, 0, 0), (255, 255, 255))
        ),
        "triangle whose top is near, unlit": lambda: screen_triangle(
            ((60, 5), (5, 100), (120, 100)), (100, 10000, 10000), ((112, 112, 112), (100, 100, 100), (100, 100, 100))
        ),
        "sliver, lit, its depth changes much across it": lambda: screen_triangle(
            ((81.8, 21.8), (55.6, 126.9), (75.3, 113.7)),
            (43.4, 45.8, 57.1),
            ((139, 185, 208), (136, 212, 55), (83, 138, 103)),
            evolve(GLOSSY, specular=0.3),
            Light("directional", (-0.2, 0.3, 1)),
        ),
        "triangle lit from behind, directional": lambda: screen_triangle(
            ((67, 31), (19, 48), (65, 60)), (12.7, 11.8, 7.4), GREYS, GLOSSY, Light("directional", (-0.3, 0.5, -0.9))
        ),
        "triangle that hides its point light": lambda: screen_triangle(
            ((10, 10), (120, 60), (30, 120)),
            (8, 7, 15),
            GREYS,
            evolve(GLOSSY, specular=0.9, shininess=2),
            Light("point", (1, -1, -23.4)),
        ),
        "cube": lambda: turned_cube(128),
        "orthographic, shininess 1, grazing": lambda: grazing(1),
        "orthographic, shininess 3, grazing": lambda: grazing(3),
        "teapot, 2 directional lights, flat": lambda: evolve(flat(teapot_scene()), lights=[LIGHTS[0], LIGHTS[2]]),
        "teapot, 2 point lights, flat": lambda: evolve(flat(teapot_scene()), lights=[LIGHTS[1], LIGHTS[3]]),
        "big near triangles, unlit": lambda: big_triangles(Material("unlit"), []),
        "big near triangles, flat": lambda: big_triangles(shiny_walls, [Light("directional", (0.2, 0.5, 1)), lamp]),
        "big near triangles, smooth": lambda: big_triangles(shiny, [Light("directional", (0.2, 0.5, 1)), lamp]),
        "big near triangles, smooth, point": lambda: big_triangles(shiny, [Light("point", (1, 2, 1))]),
    }
    return found


def screen_triangle(
    corners: Sequence[tuple[float, float]],
    distances: Sequence[float],
    colors: Sequence[tuple[int, int, int]],
    material: Material = UNLIT,
    light: Light = SUN,
) -> Scene:
    """One triangle with its corners at these columns and rows, and distances from the eye."""
    column, row = np.array(corners).T
    distance = np.array(distances)
    unit = distance / 64 / 2.145
    points = np.stack([(column - 64) * unit, (64 - row) * unit, -distance], axis=1)
    mesh = Mesh(np.rint(1000 * points), [[0, 1, 2]], colors)
    return Scene([Object(mesh, scale=2**-10, material=material, cull=False)], Camera(near=1), [light])


def grazing(shininess: int) -> Scene:
    """A plane that is seen, and lit, from just above: normal and half vector are nearly at right angles."""
    corners = [[-100, -100, 0], [100, -100, 0], [100, 100, 0], [-100, 100, 0]]
    mesh = Mesh(corners, [[0, 1, 2], [0, 2, 3]], [[30, 60, 90]] * 4)
    material = Material("flat", ambient=0.5, diffuse=0.0, specular=1.0, shininess=shininess)
    camera = Camera(eye=(1000, 0, 12), up=(0, 0, 1), projection="orthographic", half_height=1.2, near=0)
    return Scene([Object(mesh, material=material)], camera, [Light("point", (0, 150, 4))])


def coarse_teapot(lights: int) -> Scene:
    """Of 112 triangles whose normals turn a lot."""
    scene = teapot_scene(lights, 1)
    return evolve(scene, objects=[evolve(scene.objects[0], mesh=painted(teapot(2)))])


def turned(scene: Scene) -> Scene:
    """The objects turned and made half as large again."""
    objects = [evolve(o, rotation=(0.3, -0.5, 0.2, 0.8), scale=1.5 * o.scale) for o in scene.objects]
    return evolve(scene, objects=objects)


def both_sides(scene: Scene) -> Scene:
    """The objects seen from inside as well, with faces that are turned away lit as their normals say."""
    objects = [evolve(o, cull=False) for o in scene.objects]
    return evolve(scene, objects=objects, camera=evolve(scene.camera, near=8.5))


def wide(scene: Scene) -> Scene:
    """The scene with a field of view of 100 degrees, on a wide canvas."""
    return evolve(scene, camera=evolve(scene.camera, half_height=1.19), width=160, height=100)


def orthographic(scene: Scene) -> Scene:
    """The scene with an orthographic camera."""
    return evolve(scene, camera=evolve(scene.camera, projection="orthographic", half_height=3.5))
