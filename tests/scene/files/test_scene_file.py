import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shackled import Background, Camera, Fog, Light, Material, Mesh, Object, Rim, Scene, Tone, load
from shackled.errors import InputError
from shackled.scene import Hemisphere, rotate
from shackled.scene._camera import DEFAULT_HALF_HEIGHT
from shackled.scene._files.written import write_scene
from shackled.scene._staging import BACKGROUND

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"

TOML = """
size = [320, 200]
invert = true
antialias = true
ambient_light = "#102030"
hemisphere = { sky = "#010203", ground = [4, 5, 6] }
rim = { color = "white", power = 5 }
fog = { color = "gray", near = 2, far = 9.5 }
tone = { exposure = 1.5, filmic = true, gamma = true }

[background]
top = [1, 2, 3]
bottom = "#ffffff"

[camera]
eye = [0, 2, 5]
target = [0, 0.5, 0]
up = [0, 0, -1]
fov = 90
near = 0.25

[[lights]]
kind = "directional"
direction = [-1, 2, 3]
color = "#ffcc00"

[[lights]]
kind = "point"
position = [4, 5, 6]

[[lights]]
kind = "spot"
position = [7, 8, 9]
direction = [0, -1, 0]
outer_angle = 30

[[objects]]
mesh = "parts/one.obj"
position = [1, 2, 3]
rotation = [90, 0, 0]
scale = 2.5
color = [9, 8, 7]
cull = false
wireframe = true
opacity = 0.25
material = { shading = "smooth", ambient = 0.1, diffuse = 0.2, specular = 0.3, shininess = 44 }

[[objects]]
mesh = "parts/one.obj"
rotation = { axis = [0, 0, 2], angle = 90 }
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "one.obj").write_text(TRIANGLE)
    return tmp_path


def scene_of(folder: Path, **document: Any) -> Scene:
    path = folder / "scene.json"
    path.write_text(json.dumps(document))
    return load(path)


def thing(**keys: Any) -> dict[str, Any]:
    return {"mesh": "parts/one.obj", **keys}


def test_every_key_in_toml(folder: Path) -> None:
    (folder / "scene.toml").write_text(TOML)
    scene = load(folder / "scene.toml")
    assert (scene.width, scene.height, scene.ambient_light) == (320, 200, (16, 32, 48))
    assert (scene.invert, scene.antialias) == (True, True)
    assert (scene.hemisphere, scene.rim) == (Hemisphere((1, 2, 3), (4, 5, 6)), Rim("white", 5))
    assert (scene.fog, scene.tone) == (Fog("gray", 2, 9.5), Tone(1.5, True, True))
    assert (scene.background.top, scene.background.bottom) == ((1, 2, 3), (255, 255, 255))
    camera = scene.camera
    assert [v.tolist() for v in (camera.eye, camera.target, camera.up)] == [
        [0, 2, 5],
        [0, 0.5, 0],
        [0, 0, -1],
    ]
    assert (camera.projection, camera.near) == ("perspective", 0.25)
    assert camera.half_height == pytest.approx(1)
    assert [(light.kind, light.vector.tolist(), light.color) for light in scene.lights] == [
        ("directional", [-1, 2, 3], (255, 204, 0)),
        ("point", [4, 5, 6], (255, 255, 255)),
        ("spot", [7, 8, 9], (255, 255, 255)),
    ]
    assert scene.lights[2] == Light("spot", (7, 8, 9), (255, 255, 255), (0, -1, 0), 0, 30)
    first, second = scene.objects
    assert first.position.tolist() == [1, 2, 3]
    np.testing.assert_allclose(rotate(first.rotation, [0, 1, 0]), [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(rotate(second.rotation, [1, 0, 0]), [0, 1, 0], atol=1e-12)
    assert first.mesh.colors.tolist() == [[9, 8, 7]] * 3
    assert (first.scale, first.cull, first.wireframe) == (2.5, False, True)
    assert first.material == Material("flat", 0.1, 0.2, 0.3, 44)
    assert (first.opacity, second.opacity) == (0.25, 1)
    assert (second.scale, second.cull, second.wireframe, second.material) == (1, True, False, Material())


def test_json_has_the_same_keys(folder: Path) -> None:
    import tomllib

    (folder / "scene.toml").write_text(TOML)
    assert load(folder / "scene.toml") == scene_of(folder, **tomllib.loads(TOML))


def test_what_is_written_loads_as_the_same(tmp_path: Path) -> None:
    mesh = Mesh(np.array([[0, 0, 0], [1 / 3, 0, 0], [0, 1e-9, 1e9]]), [[0, 1, 2]], [[1, 2, 3], [4, 5, 6], [7, 8, 9]])
    smooth = Mesh(mesh.positions, mesh.faces, mesh.colors, [[0, 0, 1], [0, 1, 0], [1, 0, 0]])
    scene = Scene(
        [
            Object(mesh, (1, 2, 3), (0.1, 0.2, 0.3, 0.4), 0.7, Material("unlit"), False, True, 0.125),
            Object(smooth, material=Material("smooth", 1, 2, 3, 4)),
        ],
        Camera((1, 2, 3), (4, 5, 6), (0, 0, 1), "orthographic", 12.5, -3),
        [
            Light("point", (1, 2, 3), (4, 5, 6)),
            Light("directional", (1, 0, 0)),
            Light("spot", (1, 2, 3), (4, 5, 6), (0, 0, 1), 7, 8),
        ],
        Background((1, 2, 3), (4, 5, 6)),
        (10, 20, 30),
        True,
        17,
        19,
        True,
        Hemisphere("red"),
        Rim("green", 16),
        Fog("blue", 0, 1e-9),
        Tone(0, True),
    )
    write_scene(scene, tmp_path / "scene.json")
    assert load(tmp_path / "scene.json") == scene
    write_scene(Scene([]), tmp_path / "empty.json")
    assert load(tmp_path / "empty.json") == Scene([])


def test_defaults_show_all_that_is_there(folder: Path) -> None:
    scene = scene_of(folder, objects=[thing(), thing(position=[40, 0, 0], scale=3)])
    assert (scene.width, scene.height, scene.background) == (128, 128, BACKGROUND)
    assert len(scene.lights) == 1
    points = np.concatenate([o.position + o.scale * o.mesh.positions for o in scene.objects])
    back = scene.camera.eye - scene.camera.target
    back /= np.linalg.norm(back)
    right = np.cross(scene.camera.up, back)
    right /= np.linalg.norm(right)
    seen = points - scene.camera.eye
    depth = -seen @ back
    assert (depth > 0).all()
    assert (np.abs(seen @ right) < DEFAULT_HALF_HEIGHT * depth).all()
    assert (np.abs(seen @ np.cross(back, right)) < DEFAULT_HALF_HEIGHT * depth).all()


def test_no_lights_and_one_background_color(folder: Path) -> None:
    scene = scene_of(folder, lights=[], background="#010203", objects=[thing()])
    assert scene.lights == ()
    assert scene.background == Background((1, 2, 3))


def test_orthographic_cameras(folder: Path) -> None:
    placed = scene_of(folder, objects=[thing()], camera={"projection": "orthographic"}).camera
    assert (placed.projection, placed.half_height < 1) == ("orthographic", True)
    wide = scene_of(folder, objects=[thing()], camera={"projection": "orthographic", "half_height": 7}).camera
    assert (wide.half_height, wide.target.tolist()) == (7, placed.target.tolist())


def test_rotation_as_quaternion(folder: Path) -> None:
    rotation = scene_of(folder, objects=[thing(rotation={"quaternion": [0, 0, 3, 4]})]).objects[0].rotation
    assert rotation.tolist() == [0, 0, 3, 4]


@pytest.mark.parametrize(
    ("document", "message"),
    [
        ({"object": []},
         "unknown key 'object'; known are size, camera, objects, tone, creator, background, invert, antialias, "
         "lights, ambient_light, hemisphere, rim, fog, ground"),
        ({"hemisphere": "white"}, "hemisphere must be a table with keys of sky, ground, not 'white'"),
        ({"hemisphere": {"ground": "white"}}, "hemisphere.sky must be red, green and blue from 0 to 255, #rgb, "
         "#rrggbb, or the name of a colour, not None"),
        ({"rim": {"color": "white", "power": 17}},
         "rim: the power of a rim must be a whole number from 1 to 16, not 17"),
        ({"fog": {"color": "white", "near": 2}}, "fog.far must be a number, not None"),
        ({"fog": {"color": "white", "near": 2, "far": 1}},
         "fog: the near distance of the fog, 2, must be below its far distance, 1"),
        ({"tone": {"exposure": 65}}, "tone.exposure must be a finite number from 0 to 64, not 65.0"),
        ({"tone": {"gamma": 2.2}}, "tone.gamma must be true or false, not 2.2"),
        ({"antialias": 4}, "antialias must be true or false, not 4"),
        ({"objects": {}}, "objects must be a list, not {}"),
        ({"objects": [3]},
         "objects[0] must be a table with keys of mesh, position, rotation, up_axis, scale, material, fade, crease, "
         "color, cull, two_sided, wireframe, opacity, not 3"),
        ({"objects": [{}]}, "objects[0] needs a mesh: the path of a file, relative to the scene file"),
        ({"objects": [thing(colour="#fff")]},
         "unknown key 'colour' in objects[0]; known are mesh, position, rotation, up_axis, scale, "
         "material, fade, crease, color, cull, two_sided, wireframe, opacity"),
        ({"objects": [thing(color="#fffff")]},
         "objects[0].color must be red, green and blue from 0 to 255, #rgb, #rrggbb, or the name of a colour, not "
         "'#fffff'"),
        ({"objects": [thing(color="#fff8")]},
         "objects[0].color must be opaque, not '#fff8'; an Object has an opacity"),
        ({"objects": [thing(material={"shininess": 12.5})]},
         "objects[0].material.shininess must be a whole number, at least 0, not 12.5"),
        ({"objects": [thing(material={"shininess": 129})]},
         "objects[0].material.shininess must be a whole number from 1 to 128, not 129"),
        ({"objects": [thing(color=[1, 2, 256])]},
         "objects[0].color must be red, green and blue from 0 to 255, not [1, 2, 256]"),
        ({"objects": [thing(scale="2")]}, "objects[0].scale must be a number, not '2'"),
        ({"objects": [thing(scale=-1)]},
         "objects[0]: the scale of an object must be a finite number, at least 0, not -1.0"),
        ({"objects": [thing(position=[1, 2, "3"])]}, "objects[0].position must be 3 numbers, not [1, 2, '3']"),
        ({"objects": [thing(rotation={"axis": [0, 0, 1]})]},
         "objects[0].rotation must have a quaternion, or an axis and an angle in degrees"),
        ({"objects": [thing(rotation={"axis": [0, 0, 0], "angle": 3})]},
         "objects[0].rotation: the axis of a rotation must not be zero"),
        ({"objects": [thing(rotation={"quaternion": [0, 0, 0, 0]})]},
         "objects[0]: the rotation of an object must not be the zero quaternion; the identity is (0, 0, 0, 1)"),
        ({"objects": [thing(), thing(material={"shine": 3})]},
         "unknown key 'shine' in objects[1].material; known are texture, shading, ambient, diffuse, specular, "
         "shininess, emission"),
        ({"objects": [thing(material={"shading": "gouraud"})]},
         "objects[0].material.shading must be one of unlit, flat, smooth, not 'gouraud'"),
        ({"objects": [thing(material={"diffuse": 5})]},
         "objects[0].material.diffuse must be a finite number from 0 to 4, not 5.0"),
        ({"objects": [thing(cull="yes")]}, "objects[0].cull must be true or false, not 'yes'"),
        ({"objects": [{"mesh": {"positions": [[0, 0, 0]], "faces": [[0, 0, 1]]}}]},
         "objects[0].mesh: face 0 names the vertices [0, 0, 1], but they are numbered 0 to 0"),
        ({"objects": [{"mesh": {"positions": [[0, 0, 0]], "faces": [[0, 0, 0.5]]}}]},
         "objects[0].mesh: objects[0].mesh.faces[0] must be three whole numbers, not [0, 0, 0.5]"),
        ({"size": 0}, "size: the width of a picture must be from 1 to 2048 pixels, not 0"),
        ({"size": [10, 3000]}, "size: the height of a picture must be from 1 to 2048 pixels, not 3000"),
        ({"size": "big"}, "size must be a number of pixels, or width and height, not 'big'"),
        ({"lights": [{"kind": "area"}]}, "lights[0].kind must be one of directional, point, spot, not 'area'"),
        ({"lights": [{"kind": "spot"}]}, "lights[0] must have a position, as its kind is spot"),
        ({"lights": [{"kind": "spot", "position": [0, 0, 0]}]}, "lights[0] must have a direction, as its kind is spot"),
        (
            {"lights": [{"kind": "point", "position": [0, 0, 0], "outer_angle": 3}]},
            "lights[0] must have no outer_angle, as its kind is point",
        ),
        (
            {"lights": [{"kind": "spot", "position": [0, 0, 0], "direction": [0, 1, 0], "inner_angle": 50}]},
            "lights[0]: the inner_angle of a spot light, 50, must not be above its outer_angle, 45",
        ),
        ({"lights": [{"kind": "point", "direction": [1, 0, 0]}]},
         "lights[0] must have a position, as its kind is point"),
        ({"lights": [{"kind": "directional", "direction": [0, 0, 0]}]},
         "lights[0]: the direction of a light must not be zero"),
        ({"lights": [{"kind": "point", "position": [0, 0, 0]}] * 5}, "a scene has up to 4 lights, not 5"),
        ({"camera": {"eye": [0, 0, 5]}},
         "camera.eye needs a camera.target; without both the camera is placed so that all is seen"),
        ({"camera": {"eye": [0, 0, 5], "target": [0, 0, 5]}}, "camera: eye and target are the same point"),
        ({"camera": {"eye": [0, 0, 5], "target": [0, 0, 0], "up": [0, 0, 0]}}, "camera: up must not be (0, 0, 0)"),
        ({"camera": {"fov": 50, "half_height": 1}},
         "camera.fov and camera.half_height exclude each other: give one of them"),
        ({"camera": {"fov": 180}},
         "camera.fov must be a finite number from 0.2 to 179.8, not 180.0"),
        ({"camera": {"projection": "fisheye"}},
         "camera.projection must be one of perspective, orthographic, not 'fisheye'"),
        ({"camera": {"near": 0}},
         "camera: the camera's near distance must be above 0 for a perspective camera, not 0.0"),
        ({"camera": {"zoom": 2}},
         "unknown key 'zoom' in camera; known are projection, eye, target, up, azimuth, elevation, "
         "margin, fov, half_height, near"),
        ({"background": {"middle": 3}}, "unknown key 'middle' in background; known are top, bottom"),
    ],
)  # fmt: skip
def test_what_is_wrong_says_where(folder: Path, document: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as error:
        scene_of(folder, **document)
    assert str(error.value) == f"{folder / 'scene.json'}: {message}"


def test_a_missing_mesh_names_both_files(folder: Path) -> None:
    with pytest.raises(InputError) as error:
        scene_of(folder, objects=[{"mesh": "lost.ply"}])
    assert str(error.value) == f"{folder / 'scene.json'}: objects[0].mesh: {folder / 'lost.ply'} does not exist"


def test_the_example_of_the_documentation(tmp_path: Path) -> None:
    text = (Path(__file__).parents[3] / "docs" / "scene-files.md").read_text()
    example = text.split("```toml\n", 1)[1].split("```", 1)[0]
    (tmp_path / "scene.toml").write_text(example)
    for name in ("teapot.obj", "floor.obj"):
        (tmp_path / name).write_text(TRIANGLE)
    assert len(load(tmp_path / "scene.toml").objects) == 2
