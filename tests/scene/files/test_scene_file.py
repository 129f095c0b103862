import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mesh_files import refusal
from pictures import projected
from shackled import Background, Fog, Light, Material, Rim, Scene, Tone, load
from shackled.scene import Hemisphere
from shackled.scene._arithmetic import rotate
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

[[objects]]
mesh = "parts/one.obj"
rotation = { quaternion = [0, 0, 3, 4] }
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
    assert [v.tolist() for v in (camera.eye, camera.target, camera.up)] == [[0, 2, 5], [0, 0.5, 0], [0, 0, -1]]
    assert (camera.projection, camera.near) == ("perspective", 0.25)
    assert camera.half_height == pytest.approx(1)
    assert [(light.kind, light.vector.tolist(), light.color) for light in scene.lights] == [
        ("directional", [-1, 2, 3], (255, 204, 0)),
        ("point", [4, 5, 6], (255, 255, 255)),
        ("spot", [7, 8, 9], (255, 255, 255)),
    ]
    assert scene.lights[2] == Light("spot", (7, 8, 9), (255, 255, 255), (0, -1, 0), 0, 30)
    first, second, third = scene.objects
    assert first.position.tolist() == [1, 2, 3]
    np.testing.assert_allclose(rotate(first.rotation, [0, 1, 0]), [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(rotate(second.rotation, [1, 0, 0]), [0, 1, 0], atol=1e-12)
    assert third.rotation.tolist() == [0, 0, 3, 4]
    assert first.mesh.colors.tolist() == [[9, 8, 7]] * 3
    assert (first.scale, first.cull, first.wireframe) == (2.5, False, True)
    assert first.material == Material("flat", 0.1, 0.2, 0.3, 44)
    assert (first.opacity, second.opacity) == (0.25, 1)
    assert (second.scale, second.cull, second.wireframe, second.material) == (1, True, False, Material())


def test_json_has_the_same_keys(folder: Path) -> None:
    (folder / "scene.toml").write_text(TOML)
    assert load(folder / "scene.toml") == scene_of(folder, **tomllib.loads(TOML))


def test_defaults_show_all_that_is_there(folder: Path) -> None:
    scene = scene_of(folder, objects=[thing(), thing(position=[40, 0, 0], scale=3)])
    assert (scene.width, scene.height, scene.background) == (128, 128, BACKGROUND)
    assert (len(scene.lights), scene.objects[0].material) == (1, Material("flat"))
    assert 0.9 < np.abs(projected(scene)).max() < 1


def test_no_lights_and_one_background_color(folder: Path) -> None:
    scene = scene_of(folder, lights=[], background="#010203", objects=[thing()])
    assert scene.lights == ()
    assert scene.background == Background((1, 2, 3))


def test_orthographic_cameras(folder: Path) -> None:
    placed = scene_of(folder, objects=[thing()], camera={"projection": "orthographic"}).camera
    assert (placed.projection, placed.half_height < 1) == ("orthographic", True)
    wide = scene_of(folder, objects=[thing()], camera={"projection": "orthographic", "half_height": 7}).camera
    assert (wide.half_height, wide.target.tolist()) == (7, placed.target.tolist())


#: Ends of messages.
COLORS = "red, green and blue from 0 to 255, #rgb, #rrggbb, or the name of a colour"
TURN = "must have a quaternion, or an axis and an angle in degrees"
SPOT = {"kind": "spot", "position": [0, 0, 0]}


@pytest.mark.parametrize(
    ("document", "message"),
    [
        # kinds of values
        ({"antialias": 4}, "antialias must be true or false, not 4"),
        ({"tone": {"exposure": 65}}, "tone.exposure must be a finite number from 0 to 64, not 65.0"),
        ({"fog": {"color": "white", "near": 2}}, "fog.far must be a number, not None"),
        ({"objects": {}}, "objects must be a list, not {}"),
        ({"objects": [thing(scale="2")]}, "objects[0].scale must be a number, not '2'"),
        ({"objects": [thing(position=[1, 2, "3"])]}, "objects[0].position must be 3 numbers, not [1, 2, '3']"),
        ({"objects": [thing(material={"shininess": 12.5})]},
         "objects[0].material.shininess must be a whole number, at least 0, not 12.5"),
        ({"objects": [thing(material={"shininess": 129})]},
         "objects[0].material.shininess must be a whole number from 1 to 128, not 129"),
        ({"objects": [thing(material={"shading": "gouraud"})]},
         "objects[0].material.shading must be one of unlit, flat, smooth, not 'gouraud'"),
        ({"hemisphere": {"ground": "white"}}, f"hemisphere.sky must be {COLORS}, not None"),
        ({"objects": [thing(color="#fffff")]}, f"objects[0].color must be {COLORS}, not '#fffff'"),
        ({"objects": [thing(color="#fff8")]},
         "objects[0].color must be opaque, not '#fff8'; an Object has an opacity"),
        # keys
        ({"object": []},
         "unknown key 'object'; known are size, objects, camera, lights, background, ambient_light, invert, antialias, "
         "hemisphere, rim, fog, tone, ground, creator"),
        ({"objects": [thing(), thing(material={"shine": 3})]},
         "unknown key 'shine' in objects[1].material; known are shading, ambient, diffuse, specular, "
         "shininess, texture, emission"),
        ({"hemisphere": "white"}, "hemisphere must be a table with keys of sky, ground, not 'white'"),
        # what values are refused together, or by what they become
        ({"rim": {"color": "white", "power": 17}},
         "rim: the power of a rim must be a whole number from 1 to 16, not 17"),
        ({"objects": [thing(scale=-1)]},
         "objects[0]: the scale of an object must be a finite number, at least 0, not -1.0"),
        ({"objects": [thing(rotation={"axis": [0, 0, 1]})]}, f"objects[0].rotation {TURN}"),
        ({"objects": [thing(rotation={"axis": [0, 0, 0], "angle": 3})]},
         "objects[0].rotation: the axis of a rotation must not be zero"),
        ({"objects": [thing(rotation={"quaternion": [0, 0, 0, 1], "angle": 3})]},
         "objects[0].rotation.quaternion and angle exclude each other"),
        ({"size": [10, 3000]}, "size: the height of a picture must be from 1 to 2048 pixels, not 3000"),
        ({"size": "big"}, "size must be a number of pixels, or width and height, not 'big'"),
        # meshes
        ({"objects": [{}]}, "objects[0] needs a mesh: the path of a file, relative to the scene file"),
        ({"objects": [{"mesh": "lost.ply"}]}, "objects[0].mesh: {folder}/lost.ply does not exist"),
        ({"objects": [{"mesh": {"positions": [[0, 0, 0]], "faces": [[0, 0, 1]]}}]},
         "objects[0].mesh: face 0 names the vertices [0, 0, 1], but they are numbered 0 to 0"),
        ({"objects": [{"mesh": {"positions": [[0, 0, 0]], "faces": [[0, 0, 0.5]]}}]},
         "objects[0].mesh: objects[0].mesh.faces[0] must be three whole numbers, not [0, 0, 0.5]"),
        # lights
        ({"lights": [SPOT]}, "lights[0] must have a direction, as its kind is spot"),
        ({"lights": [{"kind": "point", "position": [0, 0, 0], "outer_angle": 3}]},
         "unknown key 'outer_angle' in lights[0]; known are kind, position, color, shadow"),
        ({"lights": [{**SPOT, "direction": [0, 1, 0], "inner_angle": 50}]},
         "lights[0]: the inner_angle of a spot light, 50, must not be above its outer_angle, 45"),
        ({"lights": [{"kind": "point", "position": [0, 0, 0]}] * 5}, "a scene has up to 4 lights, not 5"),
        # cameras
        ({"camera": {"eye": [0, 0, 5]}}, "camera.eye needs a camera.target, too; without any of them, all is seen"),
        ({"camera": {"up": [0, 0, 5]}}, "camera.up needs a camera.eye, too; without any of them, all is seen"),
        ({"camera": {"fov": 50, "half_height": 1}},
         "camera.fov and camera.half_height exclude each other: give one of them"),
        ({"camera": {"projection": "orthographic", "fov": 50}},
         "camera: an orthographic camera has no field of view: give `half_height` instead of `fov`"),
        ({"camera": {"projection": "orthographic", "eye": [0, 0, 5], "target": [0, 0, 0]}},
         "camera: an orthographic camera with an eye needs half_height, in world units"),
        ({"camera": {"near": 0}},
         "camera: the camera's near distance must be above 0 for a perspective camera, not 0.0"),
    ],
)  # fmt: skip
def test_what_is_wrong_says_where(folder: Path, document: dict[str, Any], message: str) -> None:
    told = refusal(folder / "scene.json", json.dumps(document), load)
    assert told == message.replace("{folder}", str(folder))


def test_the_example_of_the_documentation(tmp_path: Path) -> None:
    text = (Path(__file__).parents[3] / "docs" / "scene-files.md").read_text()
    example = text.split("```toml\n", 1)[1].split("```", 1)[0]
    (tmp_path / "scene.toml").write_text(example)
    for name in ("teapot.obj", "floor.obj"):
        (tmp_path / name).write_text(TRIANGLE)
    assert len(load(tmp_path / "scene.toml").objects) == 2
