"""Everything that can be handed in to `load` and `render`, and what can be set of its look."""

from __future__ import annotations

import re
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
import trimesh
from attrs import evolve

import shackled
from shackled import Background, Camera, Fog, InputError, Light, Mesh, Object, Rim, Scene, Tone, load, render, replace
from shackled.datasets._pieces import require
from shackled.scene import Hemisphere, read_mesh
from shackled.scene._arithmetic import rotate
from shackled.scene._look import look_at
from shackled.scene._settings import SETTINGS, LookOptions
from shackled.scene._staging import signed_volume

BALL = trimesh.creation.icosphere(subdivisions=1)
MESH = Mesh(BALL.vertices, BALL.faces)


# ---- what is drawn ----


@pytest.mark.parametrize(
    "thing",
    [
        MESH,
        (BALL.vertices, BALL.faces),
        [BALL.vertices.tolist(), BALL.faces.tolist()],
        (BALL.vertices, BALL.faces, "#c8c8c8"),
        trimesh.Trimesh(BALL.vertices, BALL.faces, process=False),
        look_at(MESH, {}),
    ],
    ids=["mesh", "arrays", "lists", "colours", "trimesh", "scene"],
)
def test_a_mesh_in_many_forms(thing: Any) -> None:
    assert load(thing) == look_at(MESH, {})


def test_a_mesh_file(tmp_path: Path) -> None:
    BALL.export(tmp_path / "ball.obj")
    expected = render(look_at(read_mesh(tmp_path / "ball.obj"), {}))
    assert render(tmp_path / "ball.obj") == render(str(tmp_path / "ball.obj")) == expected


def test_objects_and_pieces() -> None:
    pair = [Object(MESH), Object(MESH, position=(3, 0, 0), rotation=(0, 20, 0))]
    assert load(pair) == load(tuple(pair)) == Scene(pair)
    assert load([MESH, MESH]) == Scene([Object(MESH), Object(MESH)])
    assert load(pair[0]) == Scene(pair[0])
    assert load(pair, (64, 32)) == Scene(pair, width=64, height=32)
    # pieces as large and as smooth as meshes; else they are scenes of their own
    cube = require("cube").make()
    assert load(require("cube")) == load("cube") == evolve(cube, width=256, height=256, antialias=True)
    assert load("cube", 128, antialias=False) == cube
    assert load("icons/coin").antialias
    assert load(scene := load("cube")) is scene


def middles(scene: Scene) -> Any:
    return [each.world_positions().mean(axis=0).round(2).tolist() for each in scene.objects]


def test_lists_of_meshes_and_objects_stay_in_their_places() -> None:
    away = trimesh.Trimesh(np.add(BALL.vertices, (4, 0, 0)), BALL.faces, process=False)
    for pair in (
        [Object(MESH), Object(MESH, position=(4, 0, 0))],
        [(BALL.vertices, BALL.faces), (away.vertices.tolist(), away.faces.tolist(), "red")],
        [MESH, (away.vertices, away.faces)],
        (BALL, Object(MESH, position=(4, 0, 0))),
        [trimesh.Scene([BALL]), Mesh(away.vertices, away.faces)],
    ):
        scene = load(pair, 40)
        np.testing.assert_allclose(middles(scene), [[0, 0, 0], [4, 0, 0]], atol=0.01)
        assert scene.camera == Scene([Object(MESH), Object(MESH, position=(4, 0, 0))]).camera
        assert (scene.width, scene.height) == (40, 40)


def test_lists_of_models_are_one_model(tmp_path: Path) -> None:
    box = trimesh.creation.box((1, 2, 3))
    box.apply_translation((2, 0, 0))
    BALL.export(tmp_path / "ball.obj")
    box.export(tmp_path / "box.stl")
    files = load([tmp_path / "ball.obj", str(tmp_path / "box.stl")], up_axis="y")
    assert (files.width, files.antialias, len(files.objects)) == (256, True, 2)
    np.testing.assert_allclose(np.linalg.norm(files.world_positions(), axis=1).max(), 1, atol=1e-6)
    one, other = (each.world_positions().mean(axis=0)[0] for each in files.objects)
    np.testing.assert_allclose(other - one, 2 * files.objects[0].scale, atol=1e-6)
    assert load([BALL, box]).width == 256
    # among others they are shaded alike, and stay where they are
    mixed = load([tmp_path / "ball.obj", Object(MESH, position=(0, 5, 0)), tmp_path / "box.stl"], up_axis="y")
    np.testing.assert_allclose(middles(mixed), [[0, 0, 0], [0, 5, 0], [2, 0, 0]], atol=0.01)
    assert mixed.objects[2].material == files.objects[1].material


def test_lists_of_names_are_a_row() -> None:
    names = ["cube", "teapot", "icons/diamond"]
    scene = load(names, (64, 32), color="#f00")
    counts = [len(load(name).objects) for name in names]
    assert len(scene.objects) == sum(counts)
    starts = np.cumsum([0, *counts])
    boxes = [Scene(scene.objects[a:b]).bounds[:, 0] for a, b in pairwise(starts.tolist())]
    widths = [np.ptp(box) for box in boxes]
    for (_, right), (left, _) in pairwise(boxes):
        np.testing.assert_allclose(left - right, 0.2 * max(widths))
    np.testing.assert_allclose(boxes[0][0], -boxes[-1][1])
    assert (scene.objects[0].mesh.colors == (255, 0, 0)).all()
    # one alone has nothing to stand beside
    near = load([Object(MESH, position=(0, 3, 0)), require("cube")])
    np.testing.assert_array_equal(near.objects[1].position, load("cube").objects[0].position)


def test_lists_of_scenes_have_one_camera() -> None:
    one, other = load("cube"), load("teapot")
    assert load([one, one]) == replace(one, objects=one.objects * 2)
    both = load([one, Object(MESH, position=(0, 2, 0))])
    assert (both.camera, both.lights, len(both.objects)) == (one.camera, one.lights, 2)
    with pytest.raises(InputError) as error:
        load([one, other])
    words = "give a list of their objects, [*one.objects, *other.objects]"
    assert re.fullmatch(f"the scenes of the list differ in camera, .*: {re.escape(words)}", str(error.value))
    assert len(load([*one.objects, *other.objects]).objects) == 2
    wide = replace(one, width=64)
    with pytest.raises(InputError, match=r"^the scenes of the list differ in width: "):
        load([one, wide])
    assert load([one, wide], 32).width == 32


@pytest.mark.parametrize(
    ("things", "message"),
    [
        ([MESH, 5], "[1]: a path, the name of a piece, a Mesh, (vertices, faces), a Scene or a mesh of trimesh is"),
        (["cube", "nothing.obj"], "[1]: nothing.obj does not exist"),
        (["cube", "teapo"], "[1]: teapo does not exist, and there is no piece 'teapo'; did you mean teapot?"),
        ([["cube"], MESH], "[0]: a list must not hold lists: give one list of all members"),
        ([MESH, (BALL.vertices,)], "[1]: vertices and faces are needed, not 1 parts"),
        (BALL.vertices, "a path, the name of a piece, a Mesh, (vertices, faces), a Scene or a mesh of trimesh is"),
        ("https://x.invalid/a.glb", "https://x.invalid/a.glb is an address of the web: download the file first"),
    ],
    ids=lambda value: str(value)[:30],
)
def test_what_is_no_list_of_inputs(things: Any, message: str) -> None:
    with pytest.raises(InputError) as error:
        load(things)
    assert str(error.value).startswith(message)
    assert "\n" not in str(error.value)


def test_scenes_of_trimesh() -> None:
    turned = np.eye(4)
    turned[:3, :3], turned[:3, 3] = rotate(shackled.euler(30, -50, 70), np.eye(3)).T, (1, 0, 0)
    stretched = np.diag([1.0, 2.0, -1.0, 1.0])
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box(), transform=turned)
    scene.add_geometry(BALL, transform=stretched)
    objects = load(scene).objects
    expected = [each.bounds for each in scene.dump()]
    assert len(objects) == 2
    for found, box in zip(objects, expected, strict=True):
        points = found.world_positions()
        np.testing.assert_allclose([points.min(axis=0), points.max(axis=0)], box, atol=1e-12)
    # the mirrored one is seen from outside still
    assert signed_volume(objects[1].mesh) > 0


@pytest.mark.parametrize("alpha", [255, 7])
def test_colours_of_trimesh(alpha: int) -> None:
    rng = np.random.default_rng(3)
    colors, faces = (rng.integers(0, 256, (len(each), 4)).astype(np.uint8) for each in (BALL.vertices, BALL.faces))
    colors[:, 3] = faces[:, 3] = 255
    colors[0, 3] = faces[0, 3] = alpha
    painted = trimesh.Trimesh(BALL.vertices, BALL.faces, vertex_colors=colors, process=False)
    assert Mesh.from_trimesh(painted).rgba.tolist() == colors.tolist()
    mesh = Mesh.from_trimesh(trimesh.Trimesh(BALL.vertices, BALL.faces, face_colors=faces, process=False))
    assert mesh.triangles == len(BALL.faces)
    assert (mesh.rgba[mesh.faces] == faces[:, None]).all()
    with pytest.raises(InputError, match=r"^a trimesh\.Trimesh is needed, not 5"):
        Mesh.from_trimesh(5)


# ---- its look ----


def test_the_keywords_are_those_of_the_table() -> None:
    assert [setting.name for setting in SETTINGS] == ["size", *LookOptions.__annotations__]
    for setting in SETTINGS:
        assert setting.text.endswith(".")
        assert setting.text[0].isupper()
    for name, instead in {
        "lights_": "did you mean lights?",
        "texture": "`color`, `shading`, ",
        "width": "`size` is the side in pixels, or (width, height)",
        "camera": "`eye`, `target`, `up` and `fov` place the camera, `use_camera` takes that of a glTF file",
        "fps": "`duration` is ",
        "alpha": "`transparent` of render leaves out the background",
        "depth": "depths are not returned",
    }.items():
        with pytest.raises(TypeError) as error:
            load(MESH, **{name: 1})  # type: ignore[arg-type]
        assert str(error.value).startswith(f"'{name}' is not a keyword of a look; {instead}")
    with pytest.raises(TypeError, match=r"^'x' is not a keyword of a look; `shackled render --help` lists all$"):
        render(MESH, x=5)  # type: ignore[call-arg]


def test_the_page_lists_all_settings() -> None:
    page = Path(__file__).parent.parent.joinpath("docs", "look.md").read_text("utf-8")
    assert all(f"| `{setting.name}` |" in page for setting in SETTINGS)


@pytest.mark.parametrize(("axis", "up"), [("x", (1, 0, 0)), ("y", (0, 1, 0)), ("z", (0, 0, 1))])
def test_an_axis_of_the_file_points_up(axis: Literal["x", "y", "z"], up: tuple[int, int, int]) -> None:
    """And the scene keeps its hand; `rotate` comes after."""
    (o,) = load(MESH, up_axis=axis).objects
    assert rotate(o.rotation, up) == pytest.approx((0, 1, 0), abs=1e-12)
    (turned,) = load(MESH, up_axis=axis, rotate=(0, 0, 90)).objects
    assert rotate(turned.rotation, up) == pytest.approx((-1, 0, 0), abs=1e-12)
    with pytest.raises(InputError, match=r"^`up_axis` must be one of x, y, z, not 'w'"):
        load(MESH, up_axis="w")  # type: ignore[arg-type]


#: A value for each setting with which the picture of a ball is another.
VALUES: dict[str, Any] = {
    "size": 40,
    "max_triangles": 30,
    "background": ("navy", "white"),
    "invert": True,
    "rotate": (10, 20, 30),
    "up_axis": "z",
    "eye": (1, 1, 4),
    "target": (0.5, 0, 0),
    "up": (1, 1, 0),
    "azimuth": -60,
    "elevation": -40,
    "margin": 0.5,
    "fov": 20,
    "half_height": 0.9,
    "near": 4.5,
    "orthographic": True,
    "preset": "gold",
    "lights": Light.point((2, 2, 2), "orange"),
    "ambient_light": "red",
    "hemisphere": ("skyblue", "tan"),
    "rim": ("white", 2),
    "fog": "white",
    "shadow": True,
    "ground": "tan",
    "exposure": 1.5,
    "filmic": True,
    "gamma": True,
    "shading": "unlit",
    "crease": 20,
    "smooth": True,
    "unlit": True,
    "ambient": 1.0,
    "diffuse": 0.1,
    "specular": 4.0,
    "shininess": 2,
    "emission": "maroon",
    "color": "tomato",
    "cull": False,
    "two_sided": True,
    "wireframe": True,
    "opacity": 0.5,
}


@pytest.mark.parametrize("name", [setting.name for setting in SETTINGS if setting.part != "file"])
@pytest.mark.parametrize("kind", ["mesh", "scene"])
def test_each_setting_changes_the_scene(name: str, kind: str) -> None:
    thing = MESH if kind == "mesh" else Scene([Object(MESH)])
    plain = load(thing)
    assert name in (*VALUES, "antialias"), f"give {name} a value in VALUES"
    # meshes are antialiased by default, scenes are not
    value: Any = not plain.antialias if name == "antialias" else VALUES[name]
    other = load(thing, **{name: value})
    if (name, kind) == ("smooth", "mesh"):
        assert plain == other  # it is smooth by itself
        return
    assert plain != other
    assert load(thing, **{name: None}) == plain
    # a ball alone has nothing to cast its shadow on, and shows no back
    if name not in ("cull", "shadow", "two_sided"):
        pictures = [render(each, None if name == "size" else 40) for each in (plain, other)]
        assert not np.array_equal(pictures[0].pixels, pictures[1].pixels)


def test_a_scene_keeps_what_is_not_set() -> None:
    scene = Scene([Object(MESH)], Camera((0, 0, 5)), [Light.point((1, 2, 3))], "navy", (9, 9, 9), True, 30, 20, True)
    scene = replace(scene, rim=Rim("red"), fog=Fog("red", 1, 2), tone=Tone(2))
    changed = load(scene, color="red", size=(40, 10))
    assert changed.objects[0].mesh.colors.tolist() == [[255, 0, 0]] * len(MESH.positions)
    for name in ("camera", "lights", "background", "ambient_light", "invert", "antialias", "rim", "fog", "tone"):
        assert getattr(changed, name) == getattr(scene, name)
    assert (changed.width, changed.height) == (40, 10)
    placed = load(scene, azimuth=90, elevation=0)
    assert placed.camera.eye[0] > 2
    np.testing.assert_allclose(placed.camera.eye[1:], 0, atol=0.05)
    assert placed.camera.half_height == scene.camera.half_height
    assert placed.lights == scene.lights


def test_fog_without_distances_is_about_the_objects() -> None:
    for camera in (Camera((0, 0, 5)), Camera((0, 0, 5), projection="orthographic", half_height=2)):
        scene = Scene([Object(MESH, (0, 0, -1)), Object(MESH, (1, 0, 2), scale=0.5)], camera)
        depths = 5 - scene.world_positions()[:, 2]
        found = load(scene, fog="gray").fog
        assert found == Fog("gray", depths.min(), depths.max())
        assert load(scene, fog=("gray", 1, 9.5)).fog == Fog("gray", 1, 9.5)
    assert load(Scene([], Camera((0, 0, 5))), fog="gray").fog == Fog("gray", 0, 1)
    for eye, fog in (((0, 0, 3), Fog("gray", 0, 5)), ((0, 0, -9), Fog("gray", 0, 1))):
        wall = Object(Mesh([(0, 0, -2), (1, 0, -2), (0, 1, 4)], [(0, 1, 2)]))
        assert load(Scene([wall], Camera(eye, (0, 0, -99))), fog="gray").fog == fog


def test_effects_are_removed() -> None:
    plain = Scene([Object(MESH)], Camera((0, 0, 5)))
    scene = load(plain, hemisphere="white", rim="white", fog="white", exposure=2, filmic=True, gamma=True)
    assert scene.tone == Tone(2, True, True)
    assert load(scene, fog="none", gamma=False) == replace(scene, fog=None, tone=Tone(2, True))
    assert load(scene, hemisphere="none", rim="none", fog="none", exposure=1, filmic=False, gamma=False) == plain


def test_looks_in_other_words() -> None:
    assert load(MESH, hemisphere="red").hemisphere == Hemisphere("red")
    assert load(MESH, hemisphere=((1, 2, 3), "tan")).hemisphere == Hemisphere((1, 2, 3), "tan")
    assert load(MESH, rim=(1, 2, 3)).rim == Rim((1, 2, 3))
    assert load(MESH, rim=((1, 2, 3), 9)).rim == Rim((1, 2, 3), 9)
    assert load(MESH, fog=((1, 2, 3), 0, 9)).fog == Fog((1, 2, 3), 0, 9)
    assert load(MESH, smooth=True) == load(MESH, shading="smooth")
    assert load(MESH, unlit=True) == load(MESH, shading="unlit")
    assert load(MESH, smooth=False) == load(MESH)
    assert load(MESH, rotate=(0, 30, 0)) == load(MESH, rotate=shackled.euler(0, 30, 0))
    assert load(MESH, background="red").background == Background("red")
    assert load(MESH, fov=50).camera.half_height == Camera.perspective(fov=50).half_height


@pytest.mark.parametrize(
    ("look", "message"),
    [
        ({"fov": 40, "half_height": 1}, "`fov` and `half_height` exclude each other: give one of them"),
        ({"azimuth": 40, "eye": (1, 2, 3)}, "`azimuth` and `eye` exclude each other: give one of them"),
        ({"fov": 40, "orthographic": True}, "an orthographic camera has no field of view: give `half_height` instead"),
        ({"smooth": True, "unlit": True}, "the shading cannot be smooth and unlit at once"),
        ({"opacity": 2}, "`opacity` must be a finite number from 0 to 1, not 2"),
        ({"hemisphere": "bluish"}, "`hemisphere` must be red, green and blue from 0 to 255, #rgb, #rrggbb, or "),
        ({"rim": ("white", 0)}, "the power of a rim must be a whole number from 1 to 16, not 0"),
        ({"fog": ("white", 4, 3)}, "the near distance of the fog, 4, must be below its far distance, 3"),
        ({"shininess": 2.5}, "`shininess` must be a whole number from 1 to 128, not 2.5"),
        ({"crease": 30, "shading": "flat"}, "`crease` is for smooth shading, and excludes flat"),
        ({"max_triangles": 0}, "`max_triangles` must be a whole number, at least 1, not 0"),
        ({"size": "big"}, "`size` must be one number or (width, height), not 'big'"),
        ({"size": (1.5, 2)}, "`size` must be whole numbers, not (1.5, 2)"),
        ({"eye": "here"}, "`eye` must be 3 numbers, not 'here'"),
        ({"rotate": (1, 2, float("nan"))}, "`rotate` must be 3 finite numbers, not (1, 2, nan)"),
        ({"rotate": (0, 0, 0, 0)}, "`rotate` must not be the zero quaternion"),
        ({"lights": "white"}, "the lights of a scene must be a Light or a list of these, not 'white'"),
        ({"cull": "yes"}, "`cull` must be True or False, not 'yes'"),
        ({"animation": "Walk"}, "`animation` is for what is read of one glTF file"),
        ({"animation": 1.5}, "`animation` must be a name, or a number from 0, not 1.5"),
        ({"time": -1}, "`time` must be a finite number, at least 0, not -1"),
        ({"shading": "toon"}, "`shading` must be one of unlit, flat, smooth, not 'toon'"),
        ({"lights": [Light.point((1, 2, 3))] * 5}, "a scene has up to 4 lights, not 5"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_what_makes_no_look(look: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as error:
        render("cube", 16, **look) if "size" not in look else render("cube", **look)
    assert str(error.value).startswith(message)


# ---- the package ----


def test_the_names_of_the_package() -> None:
    assert dir(shackled) == sorted(shackled.__all__)
    assert len(shackled.__all__) <= 31
    for name in shackled.__all__:
        assert hasattr(shackled, name)
    # no module is hidden by a function of its name
    for name in shackled.__all__:
        assert not (Path(shackled.__file__).parent / f"{name}.py").exists()


# ---- from anywhere ----


@pytest.mark.parametrize("name", ["deep.toml", "deep.json"])
def test_files_are_read_from_deep_in_a_call_stack(name: str, tmp_path: Path) -> None:
    """The limit of recursion belongs to who calls, and is left alone."""
    (tmp_path / name).write_text("size = 8" if name.endswith("toml") else '{"size": 8}', "utf-8")
    before = sys.getrecursionlimit()

    def read(depth: int) -> Scene:
        return load(tmp_path / name) if depth == 0 else read(depth - 1)

    sys.setrecursionlimit(5000)
    try:
        assert read(1500).width == 8
        assert sys.getrecursionlimit() == 5000
    finally:
        sys.setrecursionlimit(before)
