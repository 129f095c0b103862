"""glTF documents: what they lack, and how their materials are drawn."""

import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from PIL import Image

from mesh_files import POINTS, GltfObject, corner_colors, corner_positions, refusal
from shackled import load
from shackled.errors import InputWarning
from shackled.scene import read_mesh
from shackled.scene._files.mesh_file import read_model
from shackled.scene._staging import MESH_STAGING


def triangle(**material: Any) -> GltfObject:
    file = GltfObject()
    if material:
        file.material(**material)
    return file


def colored(rows: list[list[float]], **material: Any) -> GltfObject:
    file = triangle(**material)
    file.primitive["attributes"]["COLOR_0"] = file.rows(rows)
    return file


def test_what_a_material_says_of_its_surface(tmp_path: Path) -> None:
    def surface(**values: Any) -> dict[str, Any]:
        return read_model(triangle(pbrMetallicRoughness=values).write(tmp_path))[0].material

    assert read_model(triangle().write(tmp_path))[0].material == surface() == surface(metallicFactor=0) == {}
    rough, glossy = surface(roughnessFactor=1, metallicFactor=0), surface(roughnessFactor=0.2, metallicFactor=0)
    assert rough["specular"] == 0
    assert rough["specular"] < glossy["specular"] < surface(roughnessFactor=0.2)["specular"]
    assert rough["shininess"] < glossy["shininess"] <= 128
    with pytest.warns(InputWarning, match=r"model\.gltf: left out: 1 texture of roughness$"):
        assert surface(roughnessFactor=0.2, metallicRoughnessTexture={"index": 0}) == {}
    scene = load(triangle().write(tmp_path), shininess=7)
    assert scene.objects[0].material == evolve(MESH_STAGING.material, shading="flat", shininess=7)


def test_an_unlit_material_is_unlit(tmp_path: Path) -> None:
    path = triangle(extensions={"KHR_materials_unlit": {}}).write(tmp_path)
    assert load(path).objects[0].material.shading == "unlit"
    assert load(path, shading="flat").objects[0].material.shading == "flat"


def test_diffuse_color_of_the_older_material(tmp_path: Path) -> None:
    older = {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0, 0.2, 1, 1]}}
    assert corner_colors(read_mesh(triangle(extensions=older).write(tmp_path))) == [[[0, 124, 255]] * 3]


@pytest.mark.parametrize("is_smooth", [True, False])
def test_normals_make_it_smooth_unless_they_are_those_of_the_faces(tmp_path: Path, is_smooth: bool) -> None:
    file, (a, b, c) = triangle(), POINTS
    flat = [np.cross(b - a, c - a)] * 3
    file.primitive["attributes"]["NORMAL"] = file.rows([[0, 0, 1], [0.6, 0, 0.8], [0, 0.6, 0.8]] if is_smooth else flat)
    thing = load(file.write(tmp_path)).objects[0]
    assert (thing.material.shading, thing.mesh.normals is None) == (("smooth", False) if is_smooth else ("flat", True))


@pytest.mark.parametrize("mode", [None, "OPAQUE", "MASK", "BLEND"])
def test_alpha_is_that_of_materials_that_are_blended(tmp_path: Path, mode: str | None) -> None:
    keys = {} if mode is None else {"alphaMode": mode, "alphaCutoff": 0}
    factor = {"baseColorFactor": [1, 1, 1, 0.4]}
    path = colored([[1, 0, 0, 0.2], [1, 1, 1, 1], [0, 0, 0, 0]], pbrMetallicRoughness=factor, **keys).write(tmp_path)
    (part,) = read_model(path)
    corners = part.mesh.rgba[part.mesh.faces]
    assert corners[0, :, :3].tolist() == [[255, 0, 0], [255, 255, 255], [0, 0, 0]]
    assert corners[0, :, 3].tolist() == ([51, 255, 0] if mode == "BLEND" else [255] * 3)
    assert part.opacity == load(path).objects[0].opacity == (0.4 if mode == "BLEND" else 1)
    assert load(path, opacity=0.7).objects[0].opacity == 0.7
    # both in one where there is one mesh only
    assert read_mesh(path).rgba[:, 3].tolist() == ([20, 102, 0] if mode == "BLEND" else [255] * 3)


def test_what_is_blended_is_apart(tmp_path: Path) -> None:
    file = colored([[1, 1, 1, 0.2]] * 3)
    plain = {"attributes": {"POSITION": file.primitive["attributes"]["POSITION"]}}
    factors = [("BLEND", 0.4), ("OPAQUE", 0.4), ("BLEND", 0.4), ("BLEND", 0.6), ("BLEND", 1)]
    file.document["materials"] = [
        {"alphaMode": mode, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, alpha]}} for mode, alpha in factors
    ]
    materials = [{**plain, "material": number} for number in range(5)]
    file.document["meshes"][0]["primitives"] = [*materials, plain, {**file.primitive, "material": 4}]
    parts = read_model(file.write(tmp_path))
    # what is opaque, with or without a material, is one
    found = [(part.opacity, part.mesh.triangles, part.mesh.opacities is None) for part in parts]
    assert found == [(0.4, 2, True), (1, 3, True), (0.6, 1, True), (1, 1, False)]
    scene = tmp_path / "scene.toml"
    scene.write_text('[[objects]]\nmesh = "model.gltf"\n[[objects]]\nmesh = "model.gltf"\nopacity = 0.5\n')
    assert [o.opacity for o in load(scene).objects] == [0.4, 1, 0.6, 1, *[0.5] * 4]


def test_the_part_of_a_texture_that_a_transform_takes(tmp_path: Path) -> None:
    """The example of the extension: the lower left quarter of the image, turned by 90 degrees."""
    file = GltfObject()
    image = Image.new("RGB", (4, 4))
    image.paste((255, 0, 0), (0, 2, 2, 4))
    image.putpixel((0, 3), (0, 255, 0))
    info: dict[str, Any] = file.texture(image)
    file.primitive["attributes"]["TEXCOORD_0"] = file.rows([[0.25, 0.25], [0.75, 0.25], [0.25, 0.75]])
    info["extensions"] = {"KHR_texture_transform": {"offset": [0, 1], "rotation": np.pi / 2, "scale": [0.5, 0.5]}}
    file.material(pbrMetallicRoughness={"baseColorTexture": info})
    file.document["extensionsRequired"] = ["KHR_texture_transform"]
    with pytest.warns(InputWarning):
        mesh = read_mesh(file.write(tmp_path))
    assert corner_colors(mesh) == [[[0, 255, 0], [255, 0, 0], [255, 0, 0]]]


def test_nodes_deep_in_one_another(tmp_path: Path) -> None:
    file = GltfObject()
    file.document["nodes"] = [{"children": [number + 1]} for number in range(5000)] + [{"mesh": 0}]
    assert read_mesh(file.write(tmp_path)).triangles == 1


# ---- what is refused ----


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda glb: glb[:-30], "it ends after {} of its {} bytes"),
        (lambda glb: glb[:12] + b"\xff" + glb[13:], "its chunk at byte 12 reaches beyond the end of the file"),
        (lambda glb: glb[:4] + b"\x03" + glb[5:], "it is of version 3 of GLB; version 2 is read"),
        (lambda glb: b"glTF" + struct.pack("<II", 2, 12), "it has no JSON chunk"),
        (lambda glb: b"\x93garbage" * 40, " is not valid JSON: "),
        (lambda glb: b'{"size": 3}', "it is no glTF file: asset, with the version of glTF, is missing"),
    ],
)
def test_bytes_that_are_no_document(tmp_path: Path, change: Callable[[bytes], bytes], message: str) -> None:
    path = GltfObject().glb(tmp_path / "model.glb")
    whole = path.read_bytes()
    path.write_bytes(change(whole))
    assert refusal(path).startswith(message.format(len(whole) - 30, len(whole)))


ACCESSOR = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
VIEW = {"buffer": 0, "byteLength": 36}
FAR = {"scale": [1e299] * 3}


def primitive(**keys: Any) -> list[dict[str, Any]]:
    return [{"primitives": [{"attributes": {"POSITION": 0}, **keys}]}]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"asset": {"version": "1.0"}}, "asset.version is '1.0'; glTF 2.0 is read"),
        ({"asset": {}}, "asset.version is None; glTF 2.0 is read"),
        ({"extensionsRequired": ["KHR_texture_basisu"]},
         "it requires the extension KHR_texture_basisu, which is not read; export it without"),
        ({"accessors": [ACCESSOR | {"type": "VEC9"}]}, "accessors[0].type must be one of VEC3, not 'VEC9'"),
        ({"accessors": [ACCESSOR | {"componentType": 5124}]},
         "accessors[0].componentType must be one of 5120, 5121, 5122, 5123, 5125, 5126, not 5124"),
        ({"accessors": [ACCESSOR | {"count": 1.5}]}, "accessors[0].count must be a whole number, at least 0, not 1.5"),
        ({"accessors": [ACCESSOR | {"count": 4}]}, "accessors[0] needs 48 bytes of bufferViews[0], which has 36"),
        ({"accessors": [{"componentType": 5126, "count": 10**9, "type": "VEC3"}]},
         "accessors[0] has 1,000,000,000 elements but no data"),
        ({"bufferViews": [VIEW | {"byteOffset": 4}]}, "bufferViews[0] needs 40 bytes of buffers[0], which has 36"),
        ({"bufferViews": [VIEW | {"byteStride": 4}]},
         "bufferViews[0].byteStride is 4, less than an element of 12 bytes"),
        ({"bufferViews": []}, "accessors[0].bufferView is 0, but there are 0 bufferViews, numbered from 0"),
        ({"nodes": [{}]}, "it has no triangles"),
        ({"nodes": [{"matrix": [float("nan")] * 16, "mesh": 0}]}, "nodes[0].matrix must be 16 numbers, not [nan, "),
        ({"nodes": [{"rotation": [0, 0, 0, 0], "mesh": 0}]}, "nodes[0]: a rotation must not be the zero"),
        ({"nodes": [{"children": [0]}]}, "nodes[0] hangs on several nodes, or on itself, which glTF does not"),
        ({"nodes": [{"children": [7]}]}, "nodes[0].children[0] is 7, but there are 1 nodes, numbered from 0"),
        ({"scene": 3}, "scene is 3, but there are 1 scenes, numbered from 0"),
        ({"meshes": primitive(mode=7)}, "meshes[0].primitives[0].mode must be from 0 to 6, not 7"),
        ({"meshes": primitive(indices=0)}, "accessors[0].type must be one of SCALAR, not 'VEC3'"),
        # beyond the largest number, and told without other warnings
        ({"nodes": [{"children": [1], "translation": [-1e299, 0, 0], **FAR}, {"mesh": 0, **FAR}]},
         "vertex 0 has a coordinate that is not a finite number"),
    ],
)  # fmt: skip
def test_what_a_document_lacks_is_named(tmp_path: Path, keys: dict[str, Any], message: str) -> None:
    file = GltfObject()
    file.document |= keys
    assert refusal(file.write(tmp_path)).startswith(message)


def test_numbers_that_are_wrong(tmp_path: Path) -> None:
    file = GltfObject()
    file.primitive["indices"] = file.rows([0, 1, 7], "u2")
    message = "it has no triangles that are shown; left out: 1 triangle with vertices that do not exist"
    assert refusal(file.write(tmp_path)) == message
    assert "not a finite number" in refusal(GltfObject([[0, 0, 0], [1, 0, np.nan], [0, 1, 0]]).write(tmp_path))


@pytest.mark.parametrize(
    ("uri", "message"),
    [
        ("missing%20data.bin", "buffers[0].uri: {folder}/missing data.bin does not exist"),
        ("../a.bin", "buffers[0].uri: '../a.bin' is outside of the folder of the file that names it"),
        ("http://127.0.0.1:9/a.bin", "buffers[0].uri: 'http://127.0.0.1:9/a.bin' is outside of the folder of the file"),
        ("data:;base64,A", "buffers[0].uri does not hold valid base64"),
    ],
)
def test_files_beside(tmp_path: Path, uri: str, message: str) -> None:
    path = tmp_path / "model.gltf"
    file = GltfObject()
    (tmp_path / "my data.bin").write_bytes(file.data)
    assert corner_positions(read_mesh(file.gltf(path, "my%20data.bin"))) == [POINTS.tolist()]
    assert refusal(file.gltf(path, uri)).startswith(message.format(folder=tmp_path))


def test_a_mesh_that_is_shown_too_often(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.scene._files.gltf.document.MAX_TRIANGLES", 9)
    file = GltfObject()
    file.document |= {"nodes": [{"mesh": 0}] * 10, "scenes": [{"nodes": list(range(10))}]}
    assert refusal(file.write(tmp_path)) == "it shows more than 9 triangles, the most that are read"
