"""What must not change the picture, or change it in a known way: shifts, mirrors and orders; and Euler angles."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import ArrayLike, NDArray

from judge import judge
from made_scenes import painted
from pictures import Pixels, chain, covered, draw, on_pixel_grid, pixel_grid_camera, soup, unlit_scene, words
from random_scenes import random_case
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.artifacts import artifact
from shackled.datasets import teapot
from shackled.scene import Hemisphere
from shackled.scene._arithmetic import from_euler, rotate
from shackled.scene._fields import Shading
from shackled.scene._in_range import in_range
from shackled.scene._look import MOST_TWO_SIDED, look_at
from shackled.scene._mesh import vertex_normals
from test_fill_rule import edge_functions

Array = NDArray[np.float64]


def levels(a: Pixels, b: Pixels) -> NDArray[np.int64]:
    """(H, W): by how many levels two pictures differ."""
    return np.asarray(np.abs(a.astype(np.int64) - b).max(axis=2))


@pytest.mark.parametrize("shading", ["unlit", "flat", "smooth"])
@pytest.mark.parametrize(("across", "down"), [(5, 0), (0, -7), (-11, 4)])
def test_a_shift_by_whole_pixels(shading: Shading, across: int, down: int) -> None:
    mesh = painted(teapot(4))
    points = np.rint((mesh.positions - [0, 1.5, 0]) * 8000 / 6.5)
    mesh = evolve(mesh, positions=points, normals=vertex_normals(points, mesh.faces))
    thing = Object(mesh, (37, 11, -5000), material=Material(shading, 0.3, 0.6, 0.5, 20))
    scene = Scene([thing], pixel_grid_camera(64), [Light("directional", (1, 2, 3))], width=64, height=64)
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


@pytest.mark.parametrize("kind", ["plain", "antialiased", "effects", "contacts"])
def test_the_order_of_lights_and_of_objects(kind: str) -> None:
    """Of two surfaces that are equally far the first is seen; each order is right."""
    for seed in range(1, 9):
        scene = random_case(seed, kind).scene
        before = draw(scene)
        assert levels(draw(evolve(scene, lights=scene.lights[::-1])), before).max() <= 1, seed
        for objects in (scene.objects, scene.objects[::-1]):
            assert judge(f"{kind} {seed}", evolve(scene, objects=objects)).faults == []


@pytest.mark.parametrize("kind", ["plain", "antialiased", "effects", "textures"])
def test_the_back_of_what_has_two_sides_looks_like_a_front(kind: str) -> None:
    """What is culled has one side."""
    for seed in range(1, 9):
        scene = random_case(seed, kind).scene
        one, both = ([evolve(o, cull=True, two_sided=sides) for o in scene.objects] for sides in (False, True))
        assert np.array_equal(draw(evolve(scene, objects=one)), draw(evolve(scene, objects=both)))
        scene = evolve(scene, objects=[evolve(o, cull=False, two_sided=True) for o in scene.objects])
        turned = [evolve(o, mesh=inside_out(o.mesh)) for o in scene.objects]
        difference = levels(draw(evolve(scene, objects=turned)), draw(scene))
        # faces that are turned away are moved back a little, which decides at edges
        assert (difference <= 2).mean() > 0.98, seed


#: Fields of the material, of the object, of the scene.
LOOKS: dict[str, tuple[dict[str, Any], dict[str, Any], dict[str, Any]]] = {
    "flat": ({"shading": "flat"}, {}, {}),
    "flat, antialiased": ({"shading": "flat"}, {}, {"antialias": True}),
    "smooth": ({"shading": "smooth"}, {}, {}),
    "smooth, antialiased": ({"shading": "smooth"}, {}, {"antialias": True}),
    "smooth, broad": ({"shading": "smooth", "shininess": 1}, {}, {"antialias": True}),
    "glass": ({"shading": "smooth"}, {"opacity": 0.5}, {}),
    "glass, antialiased": ({"shading": "flat"}, {"opacity": 0.5}, {"antialias": True}),
    "effects": ({"shading": "smooth"}, {}, {"hemisphere": Hemisphere("white", "red")}),
    "effects, flat": ({"shading": "flat"}, {}, {"hemisphere": Hemisphere("white", "red")}),
}


@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("eye", [(0.4, 0.3, 3), (0.1, -0.2, 0.45)])
def test_both_sides_of_a_sheet(look: str, eye: tuple[float, float, float]) -> None:
    """From the front it is as with one side; from behind too, also where faces are clipped."""
    x, y = np.meshgrid(np.linspace(-1, 1, 5), np.linspace(-1, 1, 5))
    points = np.stack([x, y, 0.3 * np.sin(3 * x) * np.cos(2 * y)], axis=2).reshape(-1, 3)
    corner = np.arange(25).reshape(5, 5)[:-1, :-1].reshape(-1, 1)
    faces = np.concatenate([corner + np.array(each) for each in ((0, 1, 6), (0, 6, 5))])
    colors = np.random.default_rng(4).integers(60, 255, (25, 3))
    sheet = Mesh(points, faces, colors, vertex_normals(points, faces))
    material, fields, more = LOOKS[look]
    lights = [Light.directional(toward=(0.3, 0.5, 1)), Light.point((1, 1, 2), color="orange")]
    scene = Scene([], Camera.perspective(eye, (0, 0, 0), fov=50), lights, width=48, height=48, **more)

    def picture(mesh: Mesh, two_sided: bool) -> Pixels:
        thing = Object(mesh, material=Material(**material), cull=False, two_sided=two_sided, **fields)
        return draw(in_range(evolve(scene, objects=[thing])))

    right = picture(sheet, False)
    assert np.array_equal(picture(sheet, True), right)
    # the depths of faces that are turned away, by which colours are divided, are a little less
    assert levels(picture(inside_out(sheet), True), right).max() <= 1
    assert levels(picture(inside_out(sheet), False), right).any()


def inside_out(mesh: Mesh) -> Mesh:
    return evolve(mesh, faces=mesh.faces[:, ::-1], normals=None if mesh.normals is None else -mesh.normals)


def test_large_meshes_have_two_sides_only_if_their_file_says_so() -> None:
    """By default; each vertex would have a second record in memory."""
    corners = np.random.default_rng(1).normal(size=(MOST_TWO_SIDED // 3 + 1, 3, 3))
    large, small = soup(corners), soup(corners[:100])
    for mesh, stated, expected in ((small, False, True), (large, False, False), (large, True, True)):
        (thing,) = look_at([Object(mesh, two_sided=stated)], {}).objects
        assert (thing.cull, thing.two_sided) == (False, expected)
    (thing,) = look_at([Object(large, two_sided=True)], {"two_sided": False}).objects
    assert not thing.two_sided


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
