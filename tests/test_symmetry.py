"""What must not change the picture, or change it in a known way: shifts, mirrors, and who does the transforms."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import ArrayLike, NDArray

from made_scenes import flat, painted, teapot_scene
from pictures import (
    UNLIT,
    Pixels,
    chain,
    covered,
    draw,
    on_pixel_grid,
    pixel_grid_camera,
    unlit_scene,
    words,
)
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.artifacts import artifact
from shackled.datasets import teapot
from shackled.scene import from_euler, rotate, vertex_normals
from shackled.scene._arithmetic import multiply
from test_fill_rule import edge_functions

Array = NDArray[np.float64]


def levels(a: Pixels, b: Pixels) -> NDArray[np.int64]:
    """(H, W): by how many levels two pictures differ."""
    difference: NDArray[np.int64] = np.abs(a.astype(np.int64) - b).max(axis=2)
    return difference


def on_grid(size: float = 4000.0) -> Mesh:
    """The teapot with whole coordinates and normals."""
    mesh = painted(teapot(4))
    points = mesh.positions
    points = np.rint((points - [0, 1.5, 0]) * size / 6.5)
    return evolve(mesh, positions=points, normals=vertex_normals(points, mesh.faces))


SHINY = Material("smooth", 0.3, 0.6, 0.5, 20)


@pytest.mark.parametrize("shading", ["unlit", "flat", "smooth"])
@pytest.mark.parametrize(("across", "down"), [(5, 0), (0, -7), (-11, 4)])
def test_a_shift_by_whole_pixels(shading: str, across: int, down: int) -> None:
    sun = Light("directional", (1, 2, 3))
    thing = Object(on_grid(8000.0), (37, 11, -5000), material=evolve(SHINY, shading=shading))
    scene = Scene([thing], pixel_grid_camera(64), [sun], width=64, height=64)
    moved = evolve(thing, position=(37 + 256 * across, 11 - 256 * down, -5000))
    before, after = draw(scene), draw(evolve(scene, objects=[moved]))
    expected = np.roll(before, (down, across), axis=(0, 1))
    assert np.count_nonzero(before.any(axis=2)) > 200
    assert levels(after, expected).max() <= 1


def test_a_mirrored_scene_gives_a_mirrored_picture() -> None:
    rng = np.random.default_rng(1)
    size = 32
    for _ in range(40):
        corners = rng.integers(-1000, 9000, (3, 2))
        if (edge_functions(corners, size, size) == 0).any():
            # an edge through the centre of a pixel belongs to one side only
            continue
        colors = rng.integers(0, 256, (3, 3))
        pictures = []
        for mirrored in (corners, [256 * size, 0] + corners * [-1, 1], [0, 256 * size] + corners * [1, -1]):
            mesh = Mesh(on_pixel_grid(mirrored, size, size), [[0, 1, 2]], colors)
            scene = unlit_scene(mesh, pixel_grid_camera(size), size)
            pictures.append((draw(scene), covered(scene)))
        (picture, mask), (across, across_mask), (upside_down, upside_down_mask) = pictures
        assert (across_mask == mask[:, ::-1]).all()
        assert (upside_down_mask == mask[::-1]).all()
        assert levels(across, picture[:, ::-1]).max() <= 1
        assert levels(upside_down, picture[::-1]).max() <= 1


@pytest.mark.parametrize("shading", ["unlit", "flat", "smooth"])
def test_a_mirrored_teapot(shading: str) -> None:
    mesh = on_grid(6000.0)
    light = Light("point", (3000, 4000, 1000), (255, 240, 220))
    material = evolve(SHINY, shading=shading)
    scene = Scene([Object(mesh, (217, -131, -9000), material=material)], Camera(near=1), [light], width=64, height=64)
    points, normals = mesh.positions, mesh.normals
    mirror = np.array([-1, 1, 1])
    turned = Mesh(points * mirror, mesh.faces[:, ::-1], mesh.colors, normals * mirror)
    other = evolve(
        scene,
        objects=[Object(turned, (-217, -131, -9000), material=material)],
        lights=[Light("point", (-3000, 4000, 1000), (255, 240, 220))],
    )
    difference = levels(draw(scene)[:, ::-1], draw(other))
    # where two surfaces are equally far, and where an edge goes through a centre, either may be seen
    assert (difference <= 1).mean() > 0.999


# ---- transforms ----


def moved(mesh: Mesh, o: Object, unit: float = 1.0) -> Mesh:
    """The mesh where the object puts it, in multiples of a unit."""
    points = o.position + rotate(o.rotation, o.scale * mesh.positions)
    return evolve(mesh, positions=np.rint(points / unit), normals=rotate(o.rotation, np.asarray(mesh.normals)))


def merged(meshes: list[Mesh]) -> Mesh:
    """One mesh of many."""
    parts = [[np.asarray(getattr(m, name)) for m in meshes] for name in ("positions", "faces", "colors", "normals")]
    firsts = np.cumsum([0] + [len(p) for p in parts[0]])
    parts[1] = [faces + first for faces, first in zip(parts[1], firsts, strict=False)]
    positions, faces, colors, normals = (np.concatenate(p) for p in parts)
    return Mesh(positions, faces, colors, normals)


@pytest.mark.parametrize("shading", ["unlit", "flat", "smooth"])
def test_objects_with_transforms_equal_one_merged_mesh(shading: str) -> None:
    mesh = on_grid(2048.0)
    material = evolve(SHINY, shading=shading)
    quarter = (0, 1, 0, 1), (1, 0, 0, 1), (0, 0, 3, 0), (0.5, 0.5, 0.5, 0.5)
    things = [
        Object(mesh, (900 * i - 1400, 500 * (i % 2) - 200, -6000 - 300 * i), rotation, scale, material)
        for i, (rotation, scale) in enumerate(zip(quarter, (1.0, 0.5, 1.0, 2.0), strict=True))
    ]
    # the halves of odd coordinates are not whole
    one = Object(merged([moved(mesh, o, 0.5) for o in things]), scale=0.5, material=material)
    lights = [Light("point", (4000, 5000, 0)), Light("directional", (-1, 1, 2), (90, 120, 255))]
    scene = Scene(things, Camera(near=1), lights, width=96, height=72)
    difference = levels(draw(scene), draw(evolve(scene, objects=[one])))
    assert (difference <= 1).mean() > 0.999


@pytest.mark.parametrize("seed", range(4))
def test_rotation_on_chain_is_rotation(seed: int) -> None:
    rng = np.random.default_rng(seed)
    mesh = on_grid(2048.0)
    thing = Object(mesh, (100, -50, -5000), rng.normal(size=4), 1.3, material=Material("unlit"))
    # in the finest steps that 24 bits hold
    one = Object(moved(mesh, thing, 2**-9), scale=2**-9, material=Material("unlit"))
    scene = Scene([thing], Camera(near=1), width=96, height=96)
    difference = levels(draw(scene), draw(evolve(scene, objects=[one])))
    # vertices may come to lie 1/256 of a pixel apart
    assert (difference <= 1).mean() > 0.997
    assert np.median(difference) == 0


def test_the_length_of_a_rotation_does_not_matter() -> None:
    scene = teapot_scene()
    mesh = on_grid(2048.0)
    pictures = []
    for length in (1, -1, 2, 0.125):
        thing = Object(mesh, (0, 0, -4000), length * np.array([0.5, -0.25, 0.125, 1]), material=SHINY)
        pictures.append(draw(evolve(scene, objects=[thing], camera=Camera(near=1), width=48, height=48)))
    assert all((picture == pictures[0]).all() for picture in pictures)
    assert pictures[0].std() > 10


@pytest.mark.parametrize("projection", ["perspective", "orthographic"])
def test_a_camera_moved_with_its_scene_sees_the_same(projection: str) -> None:
    scene = flat(teapot_scene(4))
    half_height = 3.5 if projection == "orthographic" else 0.45
    scene = evolve(scene, camera=evolve(scene.camera, projection=projection, half_height=half_height))
    turn, shift = np.array([0.1, 0.7, -0.3, 0.6]), np.array([40.0, -30.0, 25.0])

    def carried(place: ArrayLike) -> Array:
        return np.asarray(rotate(turn, place) + shift)

    camera = scene.camera
    other = evolve(
        scene,
        camera=evolve(camera, eye=carried(camera.eye), target=carried(camera.target), up=rotate(turn, camera.up)),
        objects=[evolve(o, position=carried(o.position), rotation=multiply(turn, o.rotation)) for o in scene.objects],
        lights=[
            evolve(w, vector=carried(w.vector) if w.kind == "point" else rotate(turn, w.vector)) for w in scene.lights
        ],
    )
    first, second = (chain().draw(s).bmp for s in (scene, other))
    difference = np.abs(np.frombuffer(first, np.uint8).astype(int) - np.frombuffer(second, np.uint8))
    assert (difference <= 1).mean() > 0.995


# ---- Euler angles ----


def euler_on_chain(degrees: ArrayLike) -> Array:
    angles = np.asarray(degrees, dtype=np.float64).tolist()
    data = artifact("Renderer").selectors["eulerRotation"] + words(*(round(a * 2**32) for a in angles))
    output = chain().call("Renderer", data).output
    parts = [int.from_bytes(output[at : at + 32], "big", signed=True) for at in range(0, 128, 32)]
    return np.array(parts) / 2**32


def axis_matrix(axis: int, degrees: float) -> Array:
    """The rotation about an axis, counter-clockwise as seen from where it points."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    out = np.eye(3)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    out[j, j], out[j, k], out[k, j], out[k, k] = c, -s, s, c
    return out


def test_euler_rotation() -> None:
    rng = np.random.default_rng(1)
    angles = [[0, 0, 0], [90, 0, 0], [0, 90, 0], [0, 0, 90], [180, 180, 180], [-90, 45, 270], [360, 0, 0], [1e-6, 0, 0]]
    for degrees in [*angles, *rng.uniform(-400, 400, (40, 3)).tolist(), [2.0**25, -(2.0**25), 12345.678]]:
        quaternion = euler_on_chain(degrees)
        matrix = axis_matrix(2, degrees[2]) @ axis_matrix(1, degrees[1]) @ axis_matrix(0, degrees[0])
        assert np.allclose(rotate(quaternion, np.eye(3)), matrix.T, atol=1e-8), degrees
        expected = from_euler(degrees)
        assert min(np.abs(quaternion - expected).max(), np.abs(quaternion + expected).max()) < 1e-8


def test_euler_rotation_of_an_object() -> None:
    """What the contract computes from angles turns an object as they say."""
    mesh = on_grid(2048.0)
    quaternion = euler_on_chain((30, -50, 70))
    thing = Object(mesh, (0, 0, -5000), quaternion, material=UNLIT)
    matrix = axis_matrix(2, 70) @ axis_matrix(1, -50) @ axis_matrix(0, 30)
    points = np.rint(mesh.positions @ matrix.T * 512)
    turned = Object(evolve(mesh, positions=points), (0, 0, -5000), scale=2**-9, material=UNLIT)
    scene = Scene([thing], Camera(near=1), width=64, height=64)
    assert (levels(draw(scene), draw(evolve(scene, objects=[turned]))) <= 1).mean() > 0.997
