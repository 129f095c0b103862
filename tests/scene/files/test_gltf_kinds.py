"""One small file of each kind of glTF that people have: what is drawn of it, and what is told."""

import base64
import copy
import math
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from mesh_files import POINTS, refusal
from mesh_files import GltfObject as File
from shackled import load
from shackled.errors import InputError, InputWarning
from shackled.scene._files.mesh_file import read_model
from shackled.scene._files.model import MeshPart
from shackled.scene._from_trimesh import part_of

Values = NDArray[Any]


@pytest.fixture
def file() -> File:
    """A triangle on a node."""
    return File()


def read(file: File, folder: Path, *notes: str, **pose: Any) -> list[MeshPart]:
    """The parts of a file, of which exactly these notes are told."""
    path = file.write(folder)
    if not notes:
        return read_model(path, **pose)
    with pytest.warns(InputWarning) as told:
        parts = read_model(path, **pose)
    assert [str(warning.message) for warning in told] == [f"{path}: left out: {note}" for note in notes]
    return parts


def corners(file: File, folder: Path, *notes: str, **pose: Any) -> Values:
    (part,) = read(file, folder, *notes, **pose)
    return part.mesh.positions[part.mesh.faces]


def about_z(degrees: float) -> list[float]:
    half = math.radians(degrees) / 2
    return [0, 0, math.sin(half), math.cos(half)]


def matrix_about_z(degrees: float) -> Values:
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def times(matrix: Values, points: Any) -> Values:
    return np.array([(matrix @ [*point, 1])[:3] for point in points])


# ---- skins ----


def test_a_skin_takes_the_place_of_its_joints_only(file: File, tmp_path: Path) -> None:
    file.node.update(translation=[50, 60, 70], scale=[9, 9, 9])
    file.skin([{"translation": [1, 2, 3]}])
    np.testing.assert_allclose(corners(file, tmp_path), [np.add(POINTS, (1, 2, 3))], atol=1e-6)
    # without joints at the vertices it is a mesh like any
    del file.primitive["attributes"]["JOINTS_0"]
    np.testing.assert_allclose(corners(file, tmp_path), [np.add(9 * POINTS, (50, 60, 70))], atol=1e-4)


def test_joints_are_where_all_nodes_above_them_put_them(file: File, tmp_path: Path) -> None:
    bindings = [np.linalg.inv(matrix_about_z(20)), np.eye(4)]
    file.skin([{}, {"rotation": about_z(70)}], bindings, [[0, 1, 0, 0]] * 3, [[0, 1, 0, 0], [1, 0, 0, 0], [3, 1, 0, 0]])
    # an arm that is in no scene
    file.document["nodes"].append({"translation": [0, 0, 5], "children": [1]})
    file.document["scenes"][0]["nodes"] = [0, 2]
    up = np.eye(4)
    up[2, 3] = 5
    first, second = up @ bindings[0], matrix_about_z(70)
    # weights add up to 1
    blends = [second, first, 0.75 * first + 0.25 * second]
    wanted = [times(blend, [point])[0] for blend, point in zip(blends, POINTS, strict=True)]
    np.testing.assert_allclose(corners(file, tmp_path), [wanted], atol=1e-6)


def test_more_than_four_joints_and_normals(file: File, tmp_path: Path) -> None:
    file.primitive["attributes"]["NORMAL"] = file.rows([[1, 0, 0]] * 3)
    joints = [{"translation": [number, 0, 0], "rotation": about_z(90)} for number in range(5)]
    file.skin(joints, None, [[0, 1, 2, 3]] * 3, [[0.2, 0, 0, 0]] * 3)
    file.primitive["attributes"] |= {
        "JOINTS_1": file.rows([[4, 0, 0, 0]] * 3, "u1"),
        "WEIGHTS_1": file.rows([[0.8, 0, 0, 0]] * 3),
    }
    (part,) = read(file, tmp_path)
    wanted = np.add(times(matrix_about_z(90), POINTS), (0.2 * 0 + 0.8 * 4, 0, 0))
    np.testing.assert_allclose(part.mesh.positions[part.mesh.faces], [wanted], atol=1e-6)
    np.testing.assert_allclose(np.asarray(part.mesh.normals), [[0, 1, 0]] * len(part.mesh.positions), atol=1e-6)


def test_joints_that_mirror_leave_the_outside_outside(file: File, tmp_path: Path) -> None:
    file.primitive["attributes"]["NORMAL"] = file.rows([[0, 0, 1]] * 3)
    file.skin([{"scale": [-1, 1, 1]}])
    a, b, c = corners(file, tmp_path)[0]
    assert np.cross(b - a, c - a)[2] > 0


def test_broken_skins(file: File, tmp_path: Path) -> None:
    file.skin([{}], None, [[0, 3, 0, 0]] * 3, [[1, 0, 0, 0]] * 3)
    # a joint without weight may be any
    np.testing.assert_allclose(corners(file, tmp_path), [POINTS])
    few = file.rows(np.zeros((0, 16)))
    file.document["accessors"][few]["bufferView"] = 0
    for change, message in (
        ({"joints": []}, "a vertex hangs on joint 0, but skins[0] has 0"),
        ({"joints": [8]}, "skins[0].joints[0] is 8, which is no node"),
        ({"inverseBindMatrices": few}, "skins[0] has 1 joints, but 0 inverseBindMatrices"),
    ):
        other = copy.deepcopy(file)
        other.document["skins"][0] |= change
        assert refusal(other.write(tmp_path)).startswith(f"meshes[0].primitives[0]: {message}")


# ---- morph targets ----


def test_weights_of_the_node_come_before_those_of_the_mesh(file: File, tmp_path: Path) -> None:
    file.primitive["attributes"]["NORMAL"] = file.rows([[0, 0, 1]] * 3)
    moves = np.array([[0, 0, 1], [0, 2, 0], [3, 0, 0]], dtype="f4")
    # one vertex only, in a sparse accessor without any other data
    sparse = {
        "count": 1,
        "indices": {"bufferView": file.view(b"\2"), "componentType": 5121},
        "values": {"bufferView": file.view(np.array([[0, 0, 8]], dtype="f4").tobytes())},
    }
    file.document["accessors"].append({"componentType": 5126, "count": 3, "type": "VEC3", "sparse": sparse})
    file.primitive["targets"] = [
        {"POSITION": file.rows(moves), "NORMAL": file.rows([[0, 1, -1]] * 3)},
        {"POSITION": len(file.document["accessors"]) - 3},
    ]
    np.testing.assert_allclose(corners(file, tmp_path), [POINTS])
    file.document["meshes"][0]["weights"] = [0.5, 0]
    np.testing.assert_allclose(corners(file, tmp_path), [POINTS + 0.5 * moves])
    (part,) = read(file, tmp_path)
    half = math.sqrt(0.5)
    np.testing.assert_allclose(np.asarray(part.mesh.normals), [[0, half, half]] * 3, atol=1e-6)
    file.node["weights"] = [0, 1]
    np.testing.assert_allclose(corners(file, tmp_path), [np.add(POINTS, ((0, 0, 0), (0, 0, 0), (0, 0, 8)))])
    file.primitive["targets"][1]["COLOR_0"] = file.primitive["targets"][0]["POSITION"]
    corners(file, tmp_path, "what 1 morph target would change besides positions and normals")


# ---- animations ----


CUBIC = np.polynomial.Polynomial([3, -2, 5, -1])
SLOPE = CUBIC.deriv()


@pytest.mark.parametrize(
    ("method", "times", "values", "wanted"),
    [
        ("LINEAR", [1, 2, 4], [1, 5, -1], {0: 1, 1: 1, 1.5: 3, 2: 5, 3: 2, 9: -1}),
        ("STEP", [0, 1], [2, 4], {0: 2, 0.99: 2, 1: 4, 5: 4}),
        # a cubic with these values and tangents
        ("CUBICSPLINE", [1, 3], [each(t) for t in (1, 3) for each in (SLOPE, CUBIC, SLOPE)],
         {t: CUBIC(t) for t in (1, 1.3, 2, 2.9, 3)}),
    ],
)  # fmt: skip
def test_between_keyframes(
    file: File, tmp_path: Path, method: str, times: list[float], values: list[float], wanted: dict[float, float]
) -> None:
    # in place of the matrix, which counts at rest
    file.node["matrix"] = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 7, 7, 1]
    file.animation("translation", times, [[x, 0, 0] for x in values], interpolation=method)
    for time, x in wanted.items():
        found = corners(file, tmp_path, animation="Move", time=time)
        np.testing.assert_allclose(found, [np.add(POINTS, (x, 0, 0))], atol=1e-5)
    np.testing.assert_allclose(corners(file, tmp_path), [POINTS + 7])


def test_rotations_turn_evenly_on_the_shorter_way(file: File, tmp_path: Path) -> None:
    there = about_z(150)
    for end in (there, [-each for each in there]):
        file.animation("rotation", [0, 1], [about_z(0), end])
        for share in (0.1, 0.5, 0.75):
            found = corners(file, tmp_path, animation=len(file.document["animations"]) - 1, time=share)
            np.testing.assert_allclose(found, [times(matrix_about_z(150 * share), POINTS)], atol=1e-6)


def test_weights_and_joints_are_animated(file: File, tmp_path: Path) -> None:
    file.primitive["targets"] = [{"POSITION": file.rows([[0, 0, each]] * 3)} for each in (1, 10)]
    file.animation("weights", [0, 1], [0, 0, 1, 0.5])
    np.testing.assert_allclose(corners(file, tmp_path, time=0.5), [np.add(POINTS, (0, 0, 0.5 + 2.5))], atol=1e-6)
    file.skin([{}])
    file.animation("translation", [0, 1], [[0, 0, 0], [4, 0, 0]], node=1, name="1")
    np.testing.assert_allclose(
        corners(file, tmp_path, animation="1", time=0.25), [np.add(POINTS, (1, 0, 0))], atol=1e-6
    )
    path = file.write(tmp_path)
    still, moved = (load(path, animation=1, time=time).objects[0] for time in (0.0, 1.0))
    assert still.position[0] != moved.position[0]


def test_animations_that_are_not_there(file: File, tmp_path: Path) -> None:
    assert refusal(file.write(tmp_path), time=1) == "it has no animations"
    for name in ("Walk", ""):
        file.animation("translation", [0, 1], [[0, 0, 0], [4, 0, 0]], name=name)
    file.animation("translation", [1, 0], [[0, 0, 0], [4, 0, 0]])
    file.animation("translation", [0, 1], [[0, 0, 0], [4, 0, 0]], interpolation="CUBICSPLINE")
    for animation, message in (
        ("Run", "it has no animation 'Run'; it has 0 Walk, 1, 2 Move, 3 Move"),
        (4, "it has no animation 4; it has 0 Walk, 1, 2 Move, 3 Move"),
        (2, "animations[2].samplers[0].input must be times in ascending order"),
        (3, "animations[3].samplers[0] has 2 values for 2 keyframes of CUBICSPLINE"),
    ):
        assert refusal(file.write(tmp_path), animation=animation) == message
    file.document["animations"][1]["channels"].append({"sampler": 0, "target": {"path": "pointer"}})
    corners(file, tmp_path, "1 channel of the animation", animation="1")


# ---- nodes ----


def test_instances(file: File, tmp_path: Path) -> None:
    file.node["translation"] = [0, 0, 1]
    attributes = {
        "TRANSLATION": file.rows([[1, 0, 0], [0, 2, 0]]),
        "SCALE": file.rows([[1, 1, 1], [3, 3, 3]]),
        "ROTATION": file.rows(np.rint(32767 * np.array([about_z(0), about_z(90)])), "i2", normalized=True),
    }
    file.node["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    file.document["extensionsUsed"] = file.document["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    wanted = [np.add(POINTS, (1, 0, 1)), np.add(3 * times(matrix_about_z(90), POINTS), (0, 2, 1))]
    np.testing.assert_allclose(corners(file, tmp_path), wanted, atol=1e-3)
    attributes["SCALE"] = file.rows([[1, 1, 1]])
    assert "must have as many elements in each, not [1, 2]" in refusal(file.write(tmp_path))


def test_what_is_hidden_is_not_drawn(file: File, tmp_path: Path) -> None:
    hidden = {"extensions": {"KHR_node_visibility": {"visible": False}}, "children": [2]}
    file.document["nodes"] += [hidden, {"mesh": 0}]
    file.document["scenes"][0]["nodes"] = [0, 1]
    file.document["extensionsUsed"] = ["KHR_node_visibility"]
    assert len(corners(file, tmp_path)) == 1
    hidden["extensions"] = {"KHR_node_visibility": {"visible": True}}
    assert len(corners(file, tmp_path)) == 2


# ---- materials ----


def test_what_glows(file: File, tmp_path: Path) -> None:
    file.material(emissiveFactor=[1, 0.2, 0])
    assert read(file, tmp_path)[0].material == {"emission": (255, 124, 0)}
    file.document["materials"][0]["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}
    file.document["extensionsUsed"] = ["KHR_materials_emissive_strength"]
    assert read(file, tmp_path)[0].material == {"emission": (255, 231, 0)}
    thing = load(file.write(tmp_path)).objects[0]
    assert thing.material.emission == (255, 231, 0)
    scene = tmp_path / "scene.toml"
    scene.write_text('[[objects]]\nmesh = "model.gltf"\n[[objects]]\nmesh = "model.gltf"\nmaterial.emission = "red"\n')
    assert [thing.material.emission for thing in load(scene).objects] == [(255, 231, 0), (255, 0, 0)]
    plain = {"attributes": dict(file.primitive["attributes"])}
    file.document["meshes"][0]["primitives"].append(plain)
    assert len(read(file, tmp_path)) == 2


def test_a_texture_that_glows(file: File, tmp_path: Path) -> None:
    info = file.texture([[(255, 0, 0), (0, 0, 255)]] * 2, "RGB")
    file.material(emissiveFactor=[1, 1, 1], emissiveTexture=info)
    assert read(file, tmp_path, "1 emissive texture")[0].material == {}
    # nothing else is seen of what is black
    file.document["materials"][0]["pbrMetallicRoughness"] = {"baseColorFactor": [0, 0, 0, 1]}
    (part,) = read(file, tmp_path)
    assert part.material["shading"] == "unlit"
    assert part.material["texture"].pixels[0].tolist() == [[255, 0, 0], [0, 0, 255]]


def test_two_sides(file: File, tmp_path: Path) -> None:
    file.material(doubleSided=True)
    file.document["meshes"][0]["primitives"].append({"attributes": dict(file.primitive["attributes"])})
    assert [part.two_sided for part in read(file, tmp_path)] == [True, False]
    # in a scene file it counts unless the object says something else
    for given, expected in (("", [True, False]), ("two_sided = false", [False, False])):
        scene = tmp_path / "scene.toml"
        scene.write_text(f'[[objects]]\nmesh = "model.gltf"\n{given}\n')
        assert [each.two_sided for each in load(scene).objects] == expected


@pytest.mark.parametrize(
    ("keys", "cutoff"),
    [
        ({"alphaMode": "OPAQUE"}, None),
        ({"alphaMode": "MASK"}, 128),
        ({"alphaMode": "MASK", "alphaCutoff": 0.2}, 51),
        ({"alphaMode": "MASK", "alphaCutoff": 0}, None),
        ({"alphaMode": "BLEND"}, 0),
    ],
)
def test_alpha_of_textures(tmp_path: Path, keys: dict[str, Any], cutoff: int | None) -> None:
    """Hidden texels have the colours of visible neighbours."""
    file = File()
    info = file.texture([[(255, 0, 0, 255), (0, 0, 255, 7), (9, 9, 9, 0)]] * 2, "RGBA")
    file.material(pbrMetallicRoughness={"baseColorTexture": info}, **keys)
    (part,) = read(file, tmp_path)
    texture = part.material["texture"]
    levels = None if cutoff is None else [[255, 7, 0]] * 2
    assert (texture.alpha if texture.alpha is None else texture.alpha.tolist(), texture.cutoff) == (levels, cutoff or 0)
    hidden = [9, 9, 9] if cutoff is None else [128, 0, 128]
    assert texture.pixels[0].tolist() == [[255, 0, 0], [0, 0, 255], hidden]
    file = File()
    info = file.texture([[(255, 0, 0, 255), (0, 0, 255, 255)]] * 2, "RGBA")
    file.material(pbrMetallicRoughness={"baseColorTexture": info}, **keys)
    assert read(file, tmp_path)[0].material["texture"].alpha is None


def test_a_cutoff_of_texture_and_factor(file: File, tmp_path: Path) -> None:
    """The alpha of a texel is multiplied by that of the factor."""
    info = file.texture([[(255, 0, 0, 255), (0, 0, 255, 7)]] * 2, "RGBA")
    file.material(alphaMode="MASK", pbrMetallicRoughness={"baseColorTexture": info, "baseColorFactor": [1, 1, 1, 0.8]})
    assert read(file, tmp_path)[0].material["texture"].cutoff == 160


def test_what_trimesh_knows_of_a_material(file: File, tmp_path: Path) -> None:
    info = file.texture([[(255, 0, 0, 255), (0, 0, 255, 7)]] * 2, "RGBA")
    file.material(
        alphaMode="MASK", doubleSided=True, emissiveFactor=[1, 0.2, 0], pbrMetallicRoughness={"baseColorTexture": info}
    )
    mesh: Any = trimesh.load(file.write(tmp_path), force="mesh")
    part = part_of(mesh)
    assert part.two_sided
    assert part.material["emission"] == [255, 124, 0]
    assert part.material["texture"].alpha.tolist() == [[255, 7]] * 2
    assert part.material["texture"].cutoff == 128
    assert load(mesh).objects[0].material.emission == (255, 124, 0)


def test_alpha_below_the_cutoff(file: File, tmp_path: Path) -> None:
    file.material(alphaMode="MASK", pbrMetallicRoughness={"baseColorFactor": [1, 1, 1, 0.3]})
    assert refusal(file.write(tmp_path)) == "it has no triangles that are shown"
    file.document["materials"][0]["alphaCutoff"] = 0.2
    read(file, tmp_path)
    file.primitive["attributes"]["COLOR_0"] = file.rows([[1, 1, 1, 1], [1, 1, 1, 1], [1, 1, 1, 0.5]])
    read(file, tmp_path, "the alpha of vertices of 1 primitive")


def test_surfaces_that_are_not_drawn(file: File, tmp_path: Path) -> None:
    info = file.texture([[(255, 0, 0), (0, 0, 255)]] * 2, "RGB")
    file.material(
        normalTexture=info,
        occlusionTexture=info,
        pbrMetallicRoughness={"metallicRoughnessTexture": info},
        extensions={"KHR_materials_transmission": {"transmissionFactor": 1}},
    )
    file.document["extensionsUsed"] = ["KHR_materials_transmission", "KHR_materials_clearcoat", "ODD_thing"]
    would = "what extensions KHR_materials_clearcoat, KHR_materials_transmission, ODD_thing would change"
    read(file, tmp_path, "1 normal texture", "1 occlusion texture", "1 texture of roughness", would)


# ---- other parts ----


def test_what_else_is_left_out(file: File, tmp_path: Path) -> None:
    light = {"extensions": {"KHR_lights_punctual": {"light": 0}}}
    file.document["nodes"] += [{"camera": 0}, light, light]
    file.document["scenes"] = [{"nodes": [0, 1, 2, 3]}, {"nodes": [0]}]
    file.document["meshes"][0]["primitives"] += [{**file.primitive, "mode": mode} for mode in (0, 1, 3)]
    file.document["extensionsUsed"] = ["KHR_lights_punctual"]
    notes = (
        "1 other scene",
        "3 primitives of points or lines",
        "1 camera; `use_camera` takes one, with the lights",
        "2 lights",
    )
    read(file, tmp_path, *notes)
    del file.document["meshes"][0]["primitives"][0]
    told = "; ".join(["it has no triangles that are shown", *(f"left out: {note}" for note in notes)])
    assert refusal(file.write(tmp_path)) == told


def test_the_camera_and_the_lights_of_a_file(file: File, tmp_path: Path) -> None:
    lights: list[dict[str, Any]] = [
        {"type": "directional", "intensity": 0.5, "color": [1, 0, 0]},
        {"type": "point", "intensity": 36},
        {"type": "spot", "spot": {"outerConeAngle": math.radians(30)}, "intensity": 9},
    ]
    file.document["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    file.document["cameras"] = [
        {"type": "perspective", "perspective": {"yfov": math.radians(40), "znear": 0.25}},
        {"type": "orthographic", "name": "Front", "orthographic": {"xmag": 9, "ymag": 3, "znear": 0, "zfar": 9}},
    ]
    # 6 before the middle of the triangle, turned by a quarter
    place = {"translation": [1, 0.5, 6.25], "rotation": about_z(90)}
    file.document["nodes"] += [
        {"camera": 1, **place},
        {"camera": 0, **place},
        *({**place, "extensions": {"KHR_lights_punctual": {"light": number}}} for number in range(3)),
    ]
    file.document["scenes"][0]["nodes"] += [1, 2, 3, 4, 5]
    path = file.write(tmp_path)
    scene = load(path, use_camera=0)
    np.testing.assert_allclose(scene.objects[0].world_positions()[scene.objects[0].mesh.faces], [POINTS])
    camera = scene.camera
    assert (camera.projection, camera.near) == ("perspective", 0.25)
    assert camera.half_height == pytest.approx(math.tan(math.radians(20)))
    found = [camera.eye, camera.target - camera.eye, camera.up]
    np.testing.assert_allclose(found, [(1, 0.5, 6.25), (0, 0, -1), (-1, 0, 0)], atol=1e-9)
    # 36 / 6^2 = 1 is the brightest; 0.5 and 9 / 36 are 188 and 137 in sRGB
    assert [(light.kind, light.color) for light in scene.lights] == [
        ("point", (255, 255, 255)),
        ("directional", (188, 0, 0)),
        ("spot", (137, 137, 137)),
    ]
    _, sun, spot = scene.lights
    np.testing.assert_allclose(np.array([sun.vector, spot.direction]), [(0, 0, 1), (0, 0, -1)], atol=1e-9)
    assert spot.outer_angle == pytest.approx(30)
    front = load(path, 32, use_camera="Front", color="red")
    assert (front.camera.projection, front.camera.half_height, front.width) == ("orthographic", 3, 32)
    with pytest.raises(InputError, match=r"model\.gltf: it has no camera 'Back'; it has 0, 1 Front$"):
        load(path, use_camera="Back")
    # scaled to nothing, as hidden ones often are
    file.document["nodes"] += [file.document["nodes"][5] | {"scale": [0, 0, 0]}] * 3
    file.document["scenes"][0]["nodes"] += [6, 7, 8]
    with pytest.warns(InputWarning, match=r"left out: 2 lights, the weakest: 4 are drawn$"):
        assert len(load(file.write(tmp_path), use_camera=0).lights) == 4


def test_primitives_that_lack_something(file: File, tmp_path: Path) -> None:
    info = file.texture([[(255, 0, 0), (0, 0, 255)]] * 2, "RGB")
    file.material(pbrMetallicRoughness={"baseColorTexture": info})
    del file.primitive["attributes"]["TEXCOORD_0"]
    file.document["meshes"][0]["primitives"].append({"attributes": {}})
    (part,) = read(file, tmp_path, "the texture of 1 primitive without coordinates", "1 primitive without positions")
    assert part.mesh.colors.tolist() == [[255, 255, 255]] * 3
    np.testing.assert_allclose(part.mesh.positions[part.mesh.faces], [POINTS])


def test_base64_without_padding(file: File, tmp_path: Path) -> None:
    file.data += b"\0" * 2
    uri = "data:application/octet-stream;base64," + base64.b64encode(file.data).decode()
    assert uri.endswith("=")
    (part,) = read_model(file.gltf(tmp_path / "model.gltf", uri.rstrip("=")))
    np.testing.assert_allclose(part.mesh.positions, POINTS)


@pytest.mark.parametrize("name", ["EXT_meshopt_compression", "KHR_draco_mesh_compression"])
def test_compression_that_is_not_needed(file: File, tmp_path: Path, name: str) -> None:
    file.document["extensionsUsed"] = [name]
    file.document["bufferViews"][0]["extensions"] = {"EXT_meshopt_compression": {"buffer": 9}}
    file.primitive["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 9, "attributes": {"POSITION": 0}}}
    np.testing.assert_allclose(corners(file, tmp_path), [POINTS])


def draco_file(data: bytes) -> File:
    file = File()
    file.document["accessors"] = [
        {"componentType": 5126, "count": 4, "type": "VEC3"},
        {"componentType": 5123, "count": 6, "type": "SCALAR"},
        {"componentType": 5121, "count": 4, "type": "VEC3", "normalized": True},
    ]
    file.primitive |= {
        "attributes": {"POSITION": 0, "COLOR_0": 2},
        "indices": 1,
        "extensions": {
            "KHR_draco_mesh_compression": {
                "bufferView": file.view(data),
                "attributes": {"POSITION": 1, "COLOR_0": 0},
            }
        },
    }
    file.document["extensionsUsed"] = file.document["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return file


def test_draco_needs_a_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "DracoPy", None)
    told = refusal(draco_file(b"anything").write(tmp_path))
    assert re.fullmatch(r".*compressed with Draco, .* not installed: pip install 'shackled\[draco\]'", told)


def test_compression_by_draco(tmp_path: Path) -> None:
    draco = pytest.importorskip("DracoPy")
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.5]], dtype="f4")
    faces = np.array([[0, 1, 2], [2, 1, 3]], dtype="u4")
    colors = np.array([[255, 0, 0]] * 4, dtype="u1")
    data = draco.encode(points, faces, quantization_bits=20, colors=colors)
    (part,) = read(draco_file(data), tmp_path)
    found = {tuple(map(tuple, np.round(each, 4).tolist())) for each in part.mesh.positions[part.mesh.faces]}
    turns = [{tuple(map(tuple, np.roll(points[f], k, 0).tolist())) for k in range(3)} for f in faces]
    assert len(found) == 2
    assert all(found & each for each in turns)
    assert part.mesh.colors.tolist() == [[255, 0, 0]] * len(part.mesh.positions)
    assert "holds no data of Draco that can be read" in refusal(draco_file(data[:30]).write(tmp_path))
