"""The parts of a scene as values: what is equal, what is taken, and what is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import shackled
from shackled import Background, Camera, InputError, Light, Material, Mesh, Object, Scene, load, render
from shackled.parallel import Where
from shackled.scene.simplify import simplify
from shackled.scene.staging import Look

CORNERS, FACES = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.5)], [(0, 1, 2)]
MESH = Mesh(CORNERS, FACES)


def scene(**changes: Any) -> Scene:
    return replace(Scene([Object(MESH)], Camera((0, 0, 5)), [Light("point", (1, 2, 3))]), **changes)


# ---- what is equal ----


@pytest.mark.parametrize(
    ("make", "changes"),
    [
        (Camera, {"eye": (0, 0, 1), "half_height": 0.5, "near": 0.25, "projection": "orthographic"}),
        (lambda: Light("point", (1, 2, 3)), {"vector": (1, 2, 4), "color": (255, 255, 254), "kind": "directional"}),
        (
            lambda: Mesh(CORNERS, FACES),
            {"positions": np.ones((3, 3)), "faces": [(0, 2, 1)], "colors": np.ones((3, 3), int), "normals": CORNERS},
        ),
        (
            lambda: Object(Mesh(CORNERS, FACES)),
            {
                "mesh": Mesh(CORNERS[::-1], FACES),
                "position": (0, 0, 1),
                "rotation": (1, 0, 0, 0),
                "scale": 2.0,
                "material": Material("smooth"),
                "cull": False,
            },
        ),
        (
            lambda: scene(),
            {"objects": [], "camera": Camera(), "lights": [], "ambient_light": (1, 2, 3), "invert": True, "width": 7},
        ),
        (Material, {"ambient": 0.25, "shading": "smooth"}),
        (Background, {"top": (1, 2, 3)}),
    ],
    ids=["camera", "light", "mesh", "object", "scene", "material", "background"],
)
def test_values_are_equal_if_all_is(make: Any, changes: dict[str, Any]) -> None:
    one, other = make(), make()
    assert one == other
    assert one == one
    assert hash(one) == hash(other)
    assert one != "something else"
    assert one in [other]
    for name, value in changes.items():
        changed = replace(other, **{name: value})
        assert one != changed
        assert changed != one
        assert changed == replace(one, **{name: value})


def test_zeros_of_either_sign_are_equal() -> None:
    one, other = Camera(eye=(0.0, 0, 0)), Camera(eye=(-0.0, 0, 0))
    assert one == other
    assert hash(one) == hash(other)


# ---- numbers ----


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
    with pytest.raises(InputError, match=r"^face 1 names the vertices \[.*\], but they are numbered 0 to 2$"):
        Mesh(CORNERS, [(0, 1, 2), face])


def test_whole_numbers_in_floats_are_faces() -> None:
    faces = np.asarray(Mesh(CORNERS, np.array(FACES, float)).faces)
    assert faces.dtype == np.int64
    assert faces.tolist() == [[0, 1, 2]]


def test_a_dark_mesh_of_a_scene_file_stays_dark(tmp_path: Any) -> None:
    """Its colours are whole numbers, none above 1."""
    from shackled.scene.files.scene_file import write_scene

    dark = scene(objects=[Object(Mesh(CORNERS, FACES, [(1, 0, 1), (0, 0, 0), (1, 1, 1)]))])
    write_scene(dark, tmp_path / "dark.json")
    assert load(tmp_path / "dark.json") == dark


def test_dark_colours_of_the_original_stay_dark(tmp_path: Any) -> None:
    document = {
        "canvasDim": 8,
        "verts": CORNERS,
        "faces": FACES,
        "cols": [(1, 0, 0)] * 3,
        "backgroundColor": [(1, 0, 0), (0, 1, 1)],
    }
    (tmp_path / "dark.json").write_text(json.dumps(document), "utf-8")
    dark = load(tmp_path / "dark.json")
    assert dark.background == Background((1, 0, 0), (0, 1, 1))
    assert np.asarray(dark.objects[0].mesh.colors).tolist() == [[1, 0, 0]] * 3


def test_integers_of_numpy_are_sizes() -> None:
    image = render(scene(), size=np.int64(16))  # type: ignore[arg-type]
    assert image.pixels.shape == (16, 16, 3)
    small = render(scene(), size=np.array([9, 5]), tile=np.uint8(4), gas_limit=np.int64(10**9))  # type: ignore[arg-type]
    assert small.pixels.shape == (5, 9, 3)
    sides = scene(width=np.int16(9), height=np.uint8(7))
    assert (type(sides.width), sides.width, sides.height) == (int, 9, 7)
    assert simplify(MESH, np.int64(5)) is MESH  # type: ignore[arg-type]
    where = Where(jobs=np.int64(2), tile=(np.int64(3), np.int64(4)))  # type: ignore[arg-type]
    assert (type(where.jobs), [type(side) for side in where.tile or ()]) == (int, [int, int])
    for wrong in (True, 16.0, "16", np.float64(16), np.bool_(True)):
        with pytest.raises(InputError):
            render(scene(), size=wrong)  # type: ignore[arg-type]


def test_numbers_in_strings_are_numbers() -> None:
    """Or nothing: not strings that fail later."""
    assert Camera(half_height="0.5", near="1") == Camera(half_height=0.5, near=1)  # type: ignore[arg-type]
    assert Material(ambient="1") == Material(ambient=1)  # type: ignore[arg-type]
    assert Object(MESH, scale="2") == Object(MESH, scale=2)  # type: ignore[arg-type]


# ---- kinds ----


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Object(None), "the mesh of an object must be a shackled.Mesh, not None"),  # type: ignore[arg-type]
        (
            lambda: Object(MESH, material={"ambient": 1}),  # type: ignore[arg-type]
            "the material of an object must be a shackled.Material, not {'ambient': 1}",
        ),
        (
            lambda: Scene([Object(MESH), MESH]),  # type: ignore[list-item]
            "objects[1] of a scene must be a shackled.Object, not <Mesh 3 vertices, 1",
        ),
        (lambda: Scene(Object(MESH)), "the objects of a scene must be a list, not Object("),  # type: ignore[arg-type]
        (lambda: scene(lights=[Camera()]), "lights[0] of a scene must be a shackled.Light, not Camera("),
        (lambda: scene(camera=None), "the camera of a scene must be a shackled.Camera, not None"),
        (lambda: scene(background=(0, 0, 0)), "the background of a scene must be a shackled.Background, not (0, 0, 0)"),
        (lambda: render(MESH), "a Scene, the path of a file or the name of a piece is needed, not <Mesh 3 vertices"),  # type: ignore[arg-type]
        (lambda: load((CORNERS, FACES)), "a Scene, the path of a file or the name of a piece is needed, not ([("),  # type: ignore[arg-type]
        (lambda: load("x.obj", look=5), "the look of a mesh must be a shackled.Look, not 5"),  # type: ignore[arg-type]
        (lambda: load("cube", Look()), "cube says itself how it looks: leave out the look, which is for mesh files"),
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
    assert repr(load("cube")) == "<Scene 128 x 128, 1 object, 12 triangles, 1 light>"
    assert len(repr(load("teapot").objects[0])) < 400
    assert shackled.OutputError.__mro__[1] is OSError
