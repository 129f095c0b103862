"""The parts of a scene as values: what is equal, what is taken, and what is refused."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import shackled
from shackled import (
    Background,
    Camera,
    Fog,
    InputError,
    Light,
    Material,
    Mesh,
    Object,
    Processes,
    Scene,
    load,
    render,
    replace,
)
from shackled.parallel.places import RenderOptions
from shackled.scene._arithmetic import rotate
from shackled.scene._simplify import simplify

CORNERS, FACES = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.5)], [(0, 1, 2)]
MESH = Mesh(CORNERS, FACES)


def scene(**changes: Any) -> Scene:
    return replace(Scene([Object(MESH)], Camera((0, 0, 5)), [Light("point", (1, 2, 3))]), **changes)


@pytest.mark.parametrize(
    ("make", "changes"),
    [
        (Camera, {"eye": (0, 0, 1), "half_height": 0.5, "near": 0.25, "projection": "orthographic"}),
        (lambda: Light("point", (1, 2, 3)), {"vector": (1, 2, 4), "color": (255, 255, 254), "kind": "directional"}),
        (lambda: Mesh(CORNERS, FACES), {"positions": np.ones((3, 3)), "faces": [(0, 2, 1)], "normals": CORNERS}),
        (lambda: Object(Mesh(CORNERS, FACES)), {"mesh": Mesh(CORNERS[::-1], FACES), "rotation": (1, 0, 0, 0)}),
        (lambda: scene(), {"objects": [], "camera": Camera(), "fog": Fog("white", 1, 2), "width": 7}),
        (lambda: Background("red", "blue"), {"top": (1, 2, 3), "bottom": (1, 2, 3)}),
    ],
    ids=["camera", "light", "mesh", "object", "scene", "background"],
)
def test_values_are_equal_if_all_is(make: Any, changes: dict[str, Any]) -> None:
    one, other = make(), make()
    assert one == other != "something else"
    assert hash(one) == hash(other)
    for name, value in changes.items():
        assert one != replace(other, **{name: value}) == replace(one, **{name: value})


def test_zeros_of_either_sign_are_equal() -> None:
    assert len({Camera(eye=(0.0, 0, 0)), Camera(eye=(-0.0, 0, 0))}) == 1


def test_arrays_cannot_be_written_to() -> None:
    light, camera = Light.spot((1, 2, 3), (0, -1, 0)), Camera()
    thing = Object(Mesh(CORNERS, FACES, normals=CORNERS))
    for copied in (thing, camera, light), pickle.loads(pickle.dumps((thing, camera, light))):
        assert copied == (thing, camera, light)
        (o, view, lamp), mesh = copied, copied[0].mesh
        arrays: list[Any] = [view.eye, view.target, view.up, lamp.vector, lamp.direction, o.position, o.rotation]
        arrays += [mesh.positions, mesh.faces, mesh.colors, mesh.normals]
        assert not any(array.flags.writeable for array in arrays)
    assert copy.copy(thing) is copy.deepcopy(thing) is thing
    mine = np.array(CORNERS)
    kept = Mesh(mine, FACES)
    mine[0] = 7
    assert kept == Mesh(CORNERS, FACES)


def test_a_change_shares_the_arrays_that_stay() -> None:
    assert replace(MESH, colors="red").positions is MESH.positions
    assert replace(MESH, colors="red").faces is MESH.faces


def test_colours_are_bytes_or_fractions() -> None:
    rows = [(0.5, 0.5, 0.9), (1.0, 0.0, 0.25), (0.999, 0.001, 1)]
    expected = [[128, 128, 230], [255, 0, 64], [255, 0, 255]]
    assert np.asarray(Mesh(CORNERS, FACES, rows).colors).tolist() == expected
    assert np.asarray(Mesh(CORNERS, FACES, np.array(rows, np.float32)).colors).tolist() == expected
    # matplotlib's red, green and blue; and almost black in bytes
    assert np.asarray(Mesh(CORNERS, FACES, np.eye(3)).colors).tolist() == (255 * np.eye(3)).tolist()
    assert np.asarray(Mesh(CORNERS, FACES, np.eye(3, dtype=int)).colors).tolist() == np.eye(3).tolist()
    assert np.asarray(Mesh(CORNERS, FACES, [(0.0, 255.0, 7.0)] * 3).colors).tolist() == [[0, 255, 7]] * 3
    for value, color in (((0.5, 0.5, 0.9), (128, 128, 230)), ((1.0, 0.0, 0.0), (255, 0, 0)), ((1, 0, 0), (1, 0, 0))):
        assert Light("point", (1, 2, 3), value).color == color
        assert (Background(value).top, Background(value).bottom) == (color, color)
        assert scene(ambient_light=value).ambient_light == color


def test_colours_are_names_and_may_have_an_opaque_alpha() -> None:
    levels = (255, 99, 71)
    for value in ("Tomato", "ff6347", " #FF6347ff", levels, (*levels, 255), np.array(levels, np.uint8)):
        assert Background(value).top == Light.point((1, 2, 3), value).color == (255, 99, 71)
        assert Mesh(CORNERS, FACES, value).colors.tolist() == [[255, 99, 71]] * 3
    assert Background((1.0, 0.5, 0.0, 1.0)).top == (255, 128, 0)
    rows = [(255, 0, 0, 255), (0, 128, 0, 255), (0, 0, 255, 255)]
    assert Mesh(CORNERS, FACES, ["red", "green", "#0000ff"]) == Mesh(CORNERS, FACES, rows)
    assert scene(background="navy").background == Background((0, 0, 128))
    assert scene(background=("navy", (1.0, 1.0, 1.0))).background == Background((0, 0, 128), (255, 255, 255))
    with pytest.raises(InputError, match=r"^the background colour must be opaque, not \(1, 2, 3, 4\); an Object"):
        Background((1, 2, 3, 4))
    for short, expected in (("#f0a", (255, 0, 170)), ("#F0AF", (255, 0, 170)), ("#123", (17, 34, 51))):
        assert Background(short).top == expected
        assert load("cube", color=short).objects[0].mesh.colors.tolist() == [list(expected)] * 8
    for clear in ("#f0a8", "#ff00aa88", "transparent"):
        with pytest.raises(InputError, match=f"^the background colour must be opaque, not '{clear}'; an Object has"):
            Background(clear)
    for wrong in ("reddish", "", "#12345", "#1234567", "f0a", "#f0g", "#\uff11\uff12\uff13", "#f0", "#f0a\n8"):
        with pytest.raises(InputError, match=r"^the background colour must be .* or the name of a colour, not "):
            Background(wrong)


def test_alpha_of_a_text_is_the_opacity_of_a_vertex() -> None:
    rows = [(255, 0, 170, 136), (17, 34, 51, 255), (0, 0, 0, 0)]
    assert Mesh(CORNERS, FACES, ["#f0a8", "#123", "transparent"]) == Mesh(CORNERS, FACES, rows)
    assert Mesh(CORNERS, FACES, "#ff00aa88") == Mesh(CORNERS, FACES, [rows[0]] * 3)
    assert Mesh(CORNERS, FACES, (255, 0, 170, 136)) == Mesh(CORNERS, FACES, [rows[0]] * 3)


@pytest.mark.parametrize(
    "row", [(0.5, 2, 3), (1.5, 0.5, 0.5), (-0.1, 0, 0), (256, 0, 0), (float("nan"), 0, 0)], ids=str
)
def test_other_fractions_are_no_colours(row: tuple[float, ...]) -> None:
    with pytest.raises(InputError, match=r"^the colour of vertex 1 must be from 0 to 255, in whole numbers unless "):
        Mesh(CORNERS, FACES, [(0, 0, 9), row, (0, 0, 0)])
    with pytest.raises(InputError, match=r"^the background colour must be "):
        Background(row)


@pytest.mark.parametrize("face", [(0.9, 1.2, 2.7), (0, 1.5, 2), (0, 1, float("nan")), (0, 1, -1), (0, 1, 3)], ids=str)
def test_faces_are_whole(face: tuple[float, ...]) -> None:
    rule = "which must be whole numbers|but they are numbered 0 to 2"
    with pytest.raises(InputError, match=rf"^face 1 names the vertices \[.*\], ({rule})$"):
        Mesh(CORNERS, [(0, 1, 2), face])
    assert Mesh(CORNERS, np.array(FACES, float)) == MESH


def test_dark_colours_of_files_stay_dark(tmp_path: Path) -> None:
    """They are whole numbers, none above 1: of a scene file, and of one of the original."""
    path = tmp_path / "dark.json"
    dark = scene(objects=[Object(Mesh(CORNERS, FACES, [(1, 0, 1), (0, 0, 0), (1, 1, 1)]))])
    dark.save(path)
    assert load(path) == dark
    document = {"canvasDim": 8, "verts": CORNERS, "faces": FACES, "cols": [(1, 0, 0)] * 3}
    path.write_text(json.dumps({**document, "backgroundColor": [(1, 0, 0), (0, 1, 1)]}), "utf-8")
    original = load(path)
    assert original.background == Background((1, 0, 0), (0, 1, 1))
    assert original.objects[0].mesh.colors.tolist() == [[1, 0, 0]] * 3


def test_integers_of_numpy_are_sizes() -> None:
    image = render(scene(), size=np.int64(16))  # type: ignore[arg-type]
    assert image.pixels.shape == (16, 16, 3)
    small = render(scene(), size=np.array([9, 5]), tile=np.uint8(4), gas_limit=np.int64(10**9))  # type: ignore[arg-type]
    assert small.pixels.shape == (5, 9, 3)
    sides = scene(width=np.int16(9), height=np.uint8(7))
    assert (type(sides.width), sides.width, sides.height) == (int, 9, 7)
    assert simplify(MESH, np.int64(5)) is MESH  # type: ignore[arg-type]
    bounds = RenderOptions(tile=(np.int64(3), np.int64(4)))  # type: ignore[arg-type]
    jobs = Processes(np.int64(2)).jobs  # type: ignore[arg-type]
    assert (type(jobs), [type(side) for side in bounds.tile or ()]) == (int, [int, int])
    for wrong in (True, 16.0, "16", np.float64(16), np.bool_(True)):
        with pytest.raises(InputError):
            render(scene(), size=wrong)  # type: ignore[arg-type]


def test_numbers_in_strings_are_numbers() -> None:
    """Or nothing: not strings that fail later."""
    assert Camera(half_height="0.5", near="1") == Camera(half_height=0.5, near=1)
    assert Material(ambient="1") == Material(ambient=1)
    assert Object(MESH, scale="2") == Object(MESH, scale=2)


@pytest.mark.parametrize("angles", [(0, 0, 0), (90, 0, 0), (20, -130, 55), (0, 180, 0), (179, 1, 178)], ids=str)
def test_rotations_by_angles_and_by_matrix(angles: tuple[float, ...]) -> None:
    quaternion = shackled.euler(*angles)
    assert (Object(MESH, rotation=angles).rotation == quaternion).all()
    matrix = rotate(quaternion, np.eye(3)).T
    by_matrix = Object(MESH, rotation=matrix)
    np.testing.assert_allclose(rotate(by_matrix.rotation, CORNERS), rotate(quaternion, CORNERS), atol=1e-12)
    whole = np.eye(4)
    whole[:3, :3], whole[:3, 3] = 2.5 * matrix, (1, 2, 3)
    thing = Object.from_matrix(MESH, whole, cull=False)
    expected = (np.column_stack([CORNERS, np.ones(3)]) @ whole.T)[:, :3]
    np.testing.assert_allclose(thing.world_positions(), expected, atol=1e-12)
    assert thing.scale == pytest.approx(2.5)
    assert not thing.cull


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        (np.eye(3), "the matrix of an object must be 4 x 4 finite numbers, not array"),
        (np.diag([1, 2, 1, 1]), "the matrix of an object must scale all axes alike, and have"),
        (np.diag([0, 0, 0, 1]), "the matrix of an object must scale all axes alike, and have"),
        (np.diag([1, 1, -1, 1]), "the matrix of a rotation must have unit columns at right angles, and"),
        (np.eye(4) + np.eye(4, k=-1)[::-1], "the matrix of an object must scale all axes alike, and have"),
    ],
)
def test_matrices_that_are_no_places(matrix: np.ndarray, message: str) -> None:
    with pytest.raises(InputError) as error:
        Object.from_matrix(MESH, matrix)
    assert str(error.value).startswith(message)


def test_counts_and_bounds() -> None:
    pair = Scene([Object(MESH), Object(MESH, position=(10, 0, 0), scale=2)])
    assert (MESH.triangles, pair.triangles) == (1, 2)
    assert pair.bounds.tolist() == [[0, 0, 0], [12, 2, 1]]
    assert Scene([]).bounds.tolist() == [[0, 0, 0]] * 2


def test_objects_alone_are_staged() -> None:
    """They fill the picture, are lit, and stand before a background."""
    place = load("teapot").objects[0]
    for made in (Scene([place]), Scene(place), Scene([place.mesh]), Scene([place, replace(place, position=(3, 0, 0))])):
        assert len(made.lights) == 1
        assert made.background != Background()
        image = render(made)
        assert (image.covered_pixels or 0) > 1500
        assert np.ptp(image.pixels.reshape(-1, 3), axis=0).min() > 100
    assert Scene([place], width=64).camera != Scene([place]).camera
    assert replace(Scene([place]), width=64).camera == Scene([place]).camera
    # what is chosen is not added to
    assert Scene([place], Camera()).lights == ()
    assert Scene([place], lights=[]).camera == Camera()
    assert Scene([place], background="red").camera == Camera()
    assert Scene([]).background == Background()
    with pytest.raises(InputError, match="too large for a camera to be placed"):
        Scene([Mesh([(1e307, 0, 0), (0, 1e300, 0), (0, 0, 0)], FACES)])


ROTATION = "the rotation of an object must be"


def thing(mesh: Any = MESH, **fields: Any) -> Object:
    return Object(mesh, **fields)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: thing(None), "the mesh of an object must be a shackled.Mesh, not None"),
        (lambda: thing(material={"ambient": 1}), "the material of an object must be a shackled.Material, not {'"),
        (lambda: scene(objects=[thing(), Camera()]), "objects[1] of a scene must be a shackled.Object, not Camera("),
        (lambda: scene(objects=5), "the objects of a scene must be an Object, a Mesh or a list of these, not 5"),
        (lambda: scene(objects="cube"), "the objects of a scene must be an Object, a Mesh or a list of these, not 'c"),
        (lambda: scene(lights="white"), "the lights of a scene must be a Light or a list of these, not 'white'"),
        (lambda: thing(rotation=(1, 2)), f"{ROTATION} x, y, z in degrees, a quaternion x, y, z, w, or a 3 x 3 matrix"),
        (lambda: thing(rotation=[(1, 2), 3]), f"{ROTATION} x, y, z in degrees, a quaternion"),
        (lambda: thing(rotation=(1, 2, "x")), f"{ROTATION} 3 numbers, not (1, 2, 'x')"),
        (lambda: thing(fade=(2, 1)), "the distances of the fade of an object must be 0 <= first < second, not (2, 1)"),
        (lambda: scene(lights=[Camera()]), "lights[0] of a scene must be a shackled.Light, not Camera("),
        (lambda: scene(camera=MESH), "the camera of a scene must be a shackled.Camera, not <Mesh 3 vertices"),
        (lambda: scene(background=MESH), "the background colour must be red, green and blue from 0 to 255, not <Mesh"),
        (lambda: Object(MESH, cull="no"), "cull of an object must be True or False, not 'no'"),
        (lambda: load((CORNERS,)), "vertices and faces are needed, not 1 parts: ([("),
        (lambda: load((CORNERS, 5)), "the faces of a mesh must be rows of 3 numbers, not of shape ()"),
    ],
)
def test_wrong_kinds_are_one_clear_error(make: Any, message: str) -> None:
    with pytest.raises(InputError) as error:
        make()
    assert str(error.value).startswith(message)
    assert "\n" not in str(error.value)
    assert len(str(error.value)) < 220


def test_meshes_and_scenes_show_themselves_in_a_line() -> None:
    assert repr(MESH) == "<Mesh 3 vertices, 1 triangle>"
    assert repr(load("cube")) == "<Scene 256x256, 1 object, 12 triangles, 1 light>"
    assert len(repr(load("teapot").objects[0])) < 400
    assert issubclass(shackled.OutputError, OSError)
