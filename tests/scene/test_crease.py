"""Normals that are smooth except across creases."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from mesh_files import sheet
from shackled import Material, Mesh, Object, Scene, load, replace
from shackled.datasets.common import shapes
from shackled.scene import stage
from shackled.scene._crease import creased
from shackled.scene._simplify import simplify_scene


def made(mesh: trimesh.Trimesh) -> Mesh:
    return Mesh(mesh.vertices, mesh.faces)


def corners(mesh: Mesh) -> NDArray[np.float64]:
    assert mesh.normals is not None
    return mesh.normals[mesh.faces]


CUBE = made(trimesh.creation.box())
CYLINDER = made(trimesh.creation.cylinder(1, 2, sections=32))


def test_the_side_of_a_cylinder_is_smooth_and_its_caps_are_hard() -> None:
    mesh = creased(CYLINDER)
    assert len(mesh.positions) == len(CYLINDER.positions) + 2 * 32
    assert mesh.triangles == CYLINDER.triangles
    for points, normals in zip(mesh.positions[mesh.faces], corners(mesh), strict=True):
        if np.ptp(points[:, 2]) == 0:
            np.testing.assert_array_equal(normals, [[0, 0, np.sign(points[0, 2])]] * 3)
        else:
            np.testing.assert_allclose(normals, points * (1, 1, 0), atol=1e-6)


def test_the_angle_decides() -> None:
    """An edge of the angle itself is smooth."""
    prisms = {sides: made(trimesh.creation.cylinder(1, 2, sections=sides)) for sides in (8, 9, 10)}
    assert [creased(prism).normals is None for prism in prisms.values()] == [True, False, False]
    assert [creased(prisms[8], degrees).normals is None for degrees in (44.9, 45)] == [True, False]


def test_a_mesh_of_hard_edges_stays_as_it_is() -> None:
    assert creased(CUBE) is CUBE
    split = Mesh(CUBE.positions[CUBE.faces].reshape(-1, 3), np.arange(36).reshape(-1, 3), normals=np.ones((36, 3)))
    flat = creased(split)
    assert (flat.normals, len(flat.positions), flat.triangles) == (None, 8, 12)


@pytest.mark.parametrize(("subdivisions", "error"), [(1, 0.1), (2, 0.05), (3, 0.01)])
def test_a_round_mesh_has_no_splits(subdivisions: int, error: float) -> None:
    ball = made(trimesh.creation.icosphere(subdivisions=subdivisions))
    mesh = creased(ball)
    assert len(mesh.positions) == len(ball.positions)
    np.testing.assert_allclose(corners(mesh), mesh.positions[mesh.faces], atol=error)
    assert creased(ball, 0).normals is None


def test_every_edge_is_smooth_at_180_degrees() -> None:
    cube = load(Scene([Object(CUBE)]), smooth=True, crease=180).objects[0].mesh
    assert cube == load(CUBE, crease=180).objects[0].mesh == creased(CUBE, 180)
    assert len(cube.positions) == 8
    np.testing.assert_allclose(corners(cube), cube.positions[cube.faces] / np.sqrt(0.75), atol=1e-6)
    # and where an object says so by itself
    smooth = Object(CUBE, material=Material("smooth"))
    assert load(Scene([smooth]), smooth=True, size=9).objects == (smooth,)


def test_colors_do_not_break_the_surface() -> None:
    ball = trimesh.creation.icosphere(subdivisions=2)
    split = Mesh(ball.vertices[ball.faces].reshape(-1, 3), np.arange(3 * len(ball.faces)).reshape(-1, 3))
    spotted = replace(split, colors=np.repeat(np.arange(len(ball.faces)) % 2 * 255, 9).reshape(-1, 3))
    found = creased(spotted)
    np.testing.assert_array_equal(corners(found), corners(creased(made(ball))))
    assert len(creased(split).positions) == len(ball.vertices)
    assert (found.colors[found.faces] == spotted.colors[spotted.faces]).all()


def test_a_crease_that_ends_within_a_surface_is_smoothed_unless_it_is_sharp() -> None:
    def tent(height: float) -> Mesh:
        """A sheet with a short ridge that begins at its border."""
        x, y, faces = sheet(4, 4)
        return Mesh(np.stack([x, y, np.where((x == 2) & (y <= 1), height, 0)], axis=1), faces)

    smooth = creased(tent(0.45))
    assert smooth.normals is not None
    assert len(smooth.positions) == 25
    assert creased(tent(2.0)).normals is None


def test_triangles_without_an_area_do_not_matter() -> None:
    extra = Mesh(CYLINDER.positions, [*CYLINDER.faces.tolist(), [0, 0, 1], [2, 2, 2]])
    assert len(creased(extra).positions) == len(creased(CYLINDER).positions)
    flat = creased(Mesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]]))
    assert flat.normals is None


def test_a_simplified_mesh_keeps_its_creases() -> None:
    ball = trimesh.creation.icosphere(subdivisions=4)
    dome = creased(Mesh(np.maximum(ball.vertices, (-2, -2, 0)), ball.faces))
    (simple,) = simplify_scene(Scene([Object(dome, material=Material("smooth"))]), 400).objects
    assert simple.mesh.triangles <= 400
    below = (simple.mesh.positions[simple.mesh.faces][:, :, 2] == 0).all(axis=1)
    # without creases, the normals at the rim would lean outward
    assert (corners(simple.mesh)[below][:, :, 2] < -0.99).mean() > 0.95


def test_the_look_of_a_mesh() -> None:
    assert load(CUBE).objects[0].material.shading == "flat"
    round_one = load(CYLINDER).objects[0]
    assert round_one.material.shading == "smooth"
    assert round_one.mesh == creased(CYLINDER)
    ball = shapes.sphere()
    assert load(ball).objects[0].mesh is ball
    assert load(ball, crease=30).objects[0].mesh == creased(ball, 30)
    assert load(CYLINDER, shading="flat").objects[0].mesh is CYLINDER


def in_a_scene_file(mesh: Mesh, folder: Path) -> Object:
    trimesh.Trimesh(mesh.positions, mesh.faces, process=False).export(folder / "mesh.obj")
    path = folder / "scene.toml"
    # without it, a note tells that a cylinder along z lies on its side
    upright = '[[objects]]\nmesh = "mesh.obj"\nup_axis = "y"\n'
    path.write_text(upright)
    assert load(path).objects[0].material == Material("flat")
    path.write_text(f'{upright}material = {{ shading = "smooth" }}\n')
    return load(path).objects[0]


WAYS: dict[str, Callable[[Mesh, Path], Object]] = {
    "mesh": lambda mesh, folder: load(mesh, shading="smooth").objects[0],
    "plain mesh": lambda mesh, folder: stage(mesh, shading="smooth").objects[0],
    "scene": lambda mesh, folder: load(Scene([Object(mesh)]), shading="smooth").objects[0],
    "unlit": lambda mesh, folder: load(Object(mesh, material=Material("unlit")), smooth=True).objects[0],
    "scene file": in_a_scene_file,
    "preset": lambda mesh, folder: load(Scene([Object(mesh)]), preset="studio").objects[0],
}


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
def test_a_flat_mesh_that_becomes_smooth_keeps_its_creases(way: Callable[[Mesh, Path], Object], tmp_path: Path) -> None:
    """By whatever asks for it."""
    cube = way(CUBE, tmp_path)
    assert (cube.material.shading, cube.mesh.normals) == ("flat", None)
    assert cube.mesh.triangles == 12
    round_one = way(CYLINDER, tmp_path)
    assert round_one.material.shading == "smooth"
    assert len(round_one.mesh.positions) == len(creased(CYLINDER).positions)
    # normals that are given stay
    if way is not in_a_scene_file:
        given = Mesh(CUBE.positions, CUBE.faces, normals=CUBE.positions)
        assert np.array_equal(way(given, tmp_path).mesh.normals, CUBE.positions)  # type: ignore[arg-type]
        assert way(given, tmp_path).material.shading == "smooth"


def of_hull(points: NDArray[np.float64]) -> Mesh:
    """The faces of the convex hull of a few points in general position."""
    faces = []
    for each in itertools.combinations(range(len(points)), 3):
        a, b, c = points[list(each)]
        heights = (points - a) @ np.cross(b - a, c - a)
        if (heights < 1e-12).all():
            faces.append(each)
        elif (heights > -1e-12).all():
            faces.append(each[::-1])
    return Mesh(points, faces)


def random_ball(count: int) -> NDArray[np.float64]:
    points = np.random.default_rng(3).normal(size=(count, 3))
    return np.asarray(points / np.linalg.norm(points, axis=1, keepdims=True))


def lumps() -> Mesh:
    """A coarse figure: a ball of 320 faces whose vertices are nearer or farther."""
    ball = trimesh.creation.icosphere(subdivisions=2)
    return Mesh(ball.vertices * np.random.default_rng(5).uniform(0.8, 1.2, (len(ball.vertices), 1)), ball.faces)


@pytest.mark.parametrize("count", [10, 20, 40])
def test_hulls_of_few_faces_are_flat(count: int) -> None:
    hull = of_hull(random_ball(count))
    assert hull.triangles <= 100
    assert creased(hull).normals is None
    assert creased(hull, 40).normals is not None


def test_single_sharp_edges_of_a_figure_are_smooth() -> None:
    figure = lumps()
    count = len(figure.positions)
    assert len(creased(figure, 40).positions) > 1.2 * count
    assert count <= len(creased(figure).positions) < 1.05 * count


def test_a_figure_has_no_parts_of_facets_but_solids_keep_their_edges() -> None:
    hull, figure = of_hull(random_ball(20) + np.array([5, 0, 0])), lumps()
    solid = Mesh(CYLINDER.positions + np.array([0, 5, 0]), CYLINDER.faces)
    x, y, _ = creased(shapes.joined(figure, hull, solid)).positions.T
    assert (x > 3).sum() < 40
    assert (y > 3).sum() == len(creased(CYLINDER).positions)


def test_solids_of_rounded_coordinates_keep_their_edges() -> None:
    """Though no two of their triangles are in one plane."""
    box = trimesh.creation.box().subdivide().subdivide()
    noisy = Mesh(box.vertices + np.random.default_rng(2).uniform(-0.002, 0.002, box.vertices.shape), box.faces)
    found = corners(creased(noisy))
    assert len(found) > 100
    assert np.abs(found).max(axis=2).min() > 0.98


def test_a_needle_has_no_direction_of_its_own() -> None:
    ball = trimesh.creation.icosphere(subdivisions=3)
    a, b, c = ball.faces[100]
    # a narrow face that stands on an edge
    middle = ball.vertices[[a, b]].mean(axis=0)
    tip = middle + 0.04 * np.linalg.norm(ball.vertices[a] - ball.vertices[b]) * middle / np.linalg.norm(middle)
    new = len(ball.vertices)
    (other,) = [i for i, face in enumerate(ball.faces.tolist()) if i != 100 and {a, b} <= set(face)]
    d = next(each for each in ball.faces[other].tolist() if each not in (a, b))
    rest = np.delete(ball.faces, [100, other], axis=0)
    faces = np.concatenate([rest, [(a, new, c), (new, b, c), (b, a, d), (a, b, new)]])
    mesh = Mesh(np.concatenate([ball.vertices, [tip]]), faces)
    found = corners(creased(mesh))
    outward = mesh.positions[mesh.faces] / np.linalg.norm(mesh.positions[mesh.faces], axis=2, keepdims=True)
    assert len(creased(mesh, 40).positions) > len(mesh.positions)
    assert len(creased(mesh).positions) == len(mesh.positions)
    assert (found * outward).sum(axis=2).min() > 0.9
