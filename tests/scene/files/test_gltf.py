import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from PIL import Image

from mesh_files import Gltf, corner_colors, corner_positions, png
from shackled import load
from shackled.errors import InputError, InputWarning
from shackled.scene import MESH_STAGING, read_mesh, read_model
from shackled.scene._files.model import TEXTURED
from shackled.scene._mesh import DEFAULT_COLOR

POINTS = ((0, 0, 0), (1, 0, 0), (0, 1, 0))


class Triangle(Gltf):
    """A glTF document of one triangle, to which tests add."""

    def __init__(self) -> None:
        super().__init__(scenes=[{"nodes": [0]}], nodes=[{"mesh": 0}], meshes=[{"primitives": [{"attributes": {}}]}])
        self.attribute("POSITION", np.array(POINTS, dtype=np.float32))

    def attribute(self, name: str, values: np.ndarray[Any, Any], normalized: bool = False) -> None:
        self.primitive["attributes"][name] = self.accessor(values, normalized=normalized)

    @property
    def primitive(self) -> dict[str, Any]:
        primitive: dict[str, Any] = self.document["meshes"][0]["primitives"][0]
        return primitive

    def material(self, **values: Any) -> None:
        self.document["materials"] = [{"pbrMetallicRoughness": values}]
        self.primitive["material"] = 0

    def texture(self, image: Image.Image) -> None:
        self.document["images"] = [{"bufferView": self.view(png(image)), "mimeType": "image/png"}]
        self.document["textures"] = [{"source": 0}]


def test_glb_without_material(tmp_path: Path) -> None:
    mesh = read_mesh(Triangle().glb(tmp_path / "model.glb"))
    assert corner_positions(mesh) == [[list(p) for p in POINTS]]
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3]
    assert mesh.normals is None


def test_what_a_material_says_of_its_surface(tmp_path: Path) -> None:
    def surface(**values: Any) -> dict[str, Any]:
        model = Triangle()
        model.material(**values)
        return read_model(model.glb(tmp_path / "model.glb"))[0].material

    plain = read_model(Triangle().glb(tmp_path / "model.glb"))[0].material
    assert plain == surface() == surface(metallicFactor=0) == {}
    rough, glossy = surface(roughnessFactor=1, metallicFactor=0), surface(roughnessFactor=0.2, metallicFactor=0)
    assert rough["specular"] == 0
    assert rough["specular"] < glossy["specular"] < surface(roughnessFactor=0.2)["specular"]
    assert rough["shininess"] < glossy["shininess"] <= 128
    with pytest.warns(InputWarning, match=r"model\.glb: left out: 1 texture of roughness$"):
        assert surface(roughnessFactor=0.2, metallicRoughnessTexture={"index": 0}) == {}
    surface()
    scene = load(tmp_path / "model.glb", shininess=7)
    assert scene.objects[0].material == evolve(MESH_STAGING.material, shading="flat", shininess=7)


def test_an_unlit_material_is_unlit(tmp_path: Path) -> None:
    model = Triangle()
    model.material()
    model.document["materials"][0]["extensions"] = {"KHR_materials_unlit": {}}
    path = model.glb(tmp_path / "model.glb")
    assert load(path).objects[0].material.shading == "unlit"
    assert load(path, shading="flat").objects[0].material.shading == "flat"


def test_normals_of_the_file_make_it_smooth(tmp_path: Path) -> None:
    model = Triangle()
    normals = np.array([[0, 0, 1], [0.6, 0, 0.8], [0, 0.6, 0.8]])
    model.attribute("NORMAL", normals.astype(np.float32))
    thing = load(model.glb(tmp_path / "model.glb")).objects[0]
    assert thing.material.shading == "smooth"
    assert thing.mesh.normals is not None
    np.testing.assert_allclose(thing.mesh.normals[thing.mesh.faces[0]], normals, atol=1e-6)
    assert load(tmp_path / "model.glb", shading="flat").objects[0].material.shading == "flat"


def test_normals_of_the_faces_themselves_leave_it_flat(tmp_path: Path) -> None:
    model = Triangle()
    a, b, c = np.array(POINTS)
    model.attribute("NORMAL", np.array([np.cross(b - a, c - a)] * 3, dtype=np.float32))
    thing = load(model.glb(tmp_path / "model.glb")).objects[0]
    assert (thing.material.shading, thing.mesh.normals) == ("flat", None)


def test_gltf_with_its_data_inside_and_beside(tmp_path: Path) -> None:
    model = Triangle()
    assert corner_positions(read_mesh(model.gltf(tmp_path / "model.gltf"))) == [[list(p) for p in POINTS]]
    (tmp_path / "data.bin").write_bytes(model.data)
    path = model.gltf(tmp_path / "other.gltf", "data.bin")
    assert corner_positions(read_mesh(path)) == [[list(p) for p in POINTS]]


@pytest.mark.parametrize("scale", [1, 257])
def test_vertex_colors_of_8_and_16_bits(tmp_path: Path, scale: int) -> None:
    model = Triangle()
    colors = np.array([[255, 0, 0, 255], [0, 100, 0, 255], [0, 0, 7, 255]]) * scale
    model.attribute("COLOR_0", colors.astype(np.uint8 if scale == 1 else np.uint16), normalized=True)
    assert corner_colors(read_mesh(model.glb(tmp_path / "model.glb"))) == [[[255, 0, 0], [0, 168, 0], [0, 0, 46]]]


def test_material_color_times_vertex_color(tmp_path: Path) -> None:
    model = Triangle()
    model.attribute("COLOR_0", np.array([[1, 1, 1], [0.5, 1, 1], [0, 0, 0]], dtype=np.float32))
    model.material(baseColorFactor=[1, 0.2, 0, 1])
    assert corner_colors(read_mesh(model.glb(tmp_path / "model.glb"))) == [[[255, 124, 0], [188, 124, 0], [0, 0, 0]]]


@pytest.mark.parametrize("mode", [None, "OPAQUE", "MASK", "BLEND"])
def test_alpha_is_that_of_materials_that_are_blended(tmp_path: Path, mode: str | None) -> None:
    model = Triangle()
    model.attribute("COLOR_0", np.array([[1, 0, 0, 0.2], [1, 1, 1, 1], [0, 0, 0, 0]], dtype=np.float32))
    model.material(baseColorFactor=[1, 1, 1, 0.4])
    if mode is not None:
        model.document["materials"][0] |= {"alphaMode": mode, "alphaCutoff": 0}
    path = model.glb(tmp_path / "model.glb")
    (part,) = read_model(path)
    corners = part.mesh.rgba[part.mesh.faces]
    assert corners[0, :, :3].tolist() == [[255, 0, 0], [255, 255, 255], [0, 0, 0]]
    assert corners[0, :, 3].tolist() == ([51, 255, 0] if mode == "BLEND" else [255] * 3)
    assert part.opacity == (0.4 if mode == "BLEND" else 1)
    assert load(path).objects[0].opacity == part.opacity
    assert load(path, opacity=0.7).objects[0].opacity == 0.7
    # both in one where there is one mesh only
    assert read_mesh(path).rgba[:, 3].tolist() == ([20, 102, 0] if mode == "BLEND" else [255] * 3)


def test_what_is_blended_is_apart(tmp_path: Path) -> None:
    model = Triangle()
    model.attribute("COLOR_0", np.array([[1, 1, 1, 0.2]] * 3, dtype=np.float32))
    plain = {"attributes": {"POSITION": model.primitive["attributes"]["POSITION"]}}
    factors = [("BLEND", 0.4), ("OPAQUE", 0.4), ("BLEND", 0.4), ("BLEND", 0.6), ("BLEND", 1)]
    model.document["materials"] = [
        {"alphaMode": mode, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, alpha]}} for mode, alpha in factors
    ]
    materials = [{**plain, "material": number} for number in range(5)]
    model.document["meshes"][0]["primitives"] = [*materials, plain, {**model.primitive, "material": 4}]
    parts = read_model(model.glb(tmp_path / "model.glb"))
    # what is opaque, with or without a material, is one
    found = [(part.opacity, part.mesh.triangles, part.mesh.opacities is None) for part in parts]
    assert found == [(0.4, 2, True), (1, 3, True), (0.6, 1, True), (1, 1, False)]
    scene = tmp_path / "scene.toml"
    scene.write_text('[[objects]]\nmesh = "model.glb"\n[[objects]]\nmesh = "model.glb"\nopacity = 0.5\n')
    assert [o.opacity for o in load(scene).objects] == [0.4, 1, 0.6, 1, *[0.5] * 4]


def test_texture_is_sampled_from_its_top(tmp_path: Path) -> None:
    model = Triangle()
    image = Image.new("RGB", (1, 2), (255, 0, 0))
    image.putpixel((0, 1), (0, 0, 255))
    model.texture(image)
    model.attribute("TEXCOORD_0", np.array([[0, 0], [0, 1], [0, 0.5]], dtype=np.float32))
    model.material(baseColorTexture={"index": 0})
    path = model.glb(tmp_path / "model.glb")
    with pytest.warns(InputWarning) as told:
        assert corner_colors(read_mesh(path)) == [[[255, 0, 0], [0, 0, 255], [128, 0, 128]]]
    assert [str(warning.message) for warning in told] == [f"{path}: {TEXTURED}"]


def test_nodes_put_parts_in_their_places(tmp_path: Path) -> None:
    model = Triangle()
    model.attribute("NORMAL", np.array([[0, 0, 1]] * 3, dtype=np.float32))
    model.document["nodes"] = [
        {"children": [1, 2], "translation": [10, 0, 0]},
        {"mesh": 0, "scale": [2, 2, 2]},
        {"mesh": 0, "rotation": [0, 2**-0.5, 0, 2**-0.5]},
    ]
    mesh = read_mesh(model.glb(tmp_path / "model.glb"))
    positions = np.array(corner_positions(mesh))
    normals = np.asarray(mesh.normals)[mesh.faces]
    order = np.argsort(positions[:, 2, 1])
    wanted = [[[10, 0, 0], [10, 0, -1], [10, 1, 0]], [[10, 0, 0], [12, 0, 0], [10, 2, 0]]]
    np.testing.assert_allclose(positions[order], wanted, atol=1e-6)
    np.testing.assert_allclose(normals[order], [[[1, 0, 0]] * 3, [[0, 0, 1]] * 3], atol=1e-6)


def test_a_mirrored_part_is_still_seen_from_outside(tmp_path: Path) -> None:
    model = Triangle()
    model.attribute("NORMAL", np.array([[0, 0, 1]] * 3, dtype=np.float32))
    model.document["nodes"] = [{"mesh": 0, "scale": [-1, 1, 1]}]
    mesh = read_mesh(model.glb(tmp_path / "model.glb"))
    a, b, c = mesh.positions[mesh.faces][0]
    assert np.cross(b - a, c - a).tolist() == [0, 0, 1]
    assert np.asarray(mesh.normals).tolist() == [[0, 0, 1]] * 3


def test_broken_gltf_is_told_in_one_line(tmp_path: Path) -> None:
    whole = Triangle().glb(tmp_path / "whole.glb").read_bytes()
    wrong_index = Triangle()
    wrong_index.primitive["indices"] = wrong_index.accessor(np.array([0, 1, 7], dtype=np.uint16))
    no_mesh = Triangle()
    no_mesh.document["nodes"] = [{}]
    packed = Triangle()
    packed.document["extensionsRequired"] = ["EXT_meshopt_compression"]
    not_finite = Triangle()
    not_finite.attribute("POSITION", np.array([[0, 0, 0], [1, 0, np.nan], [0, 1, 0]], dtype=np.float32))
    beside = Triangle().gltf(tmp_path / "lost.gltf", "missing.bin").read_bytes()
    for name, content, message in [
        ("cut.glb", whole[:-30], ": it ends after 398 of its 428 bytes"),
        ("start.glb", whole[:9], ": it ends within its header"),
        ("chunk.glb", whole[:12] + b"\xff" + whole[13:], ": its chunk at byte 12 reaches beyond the end of the file"),
        ("next.glb", whole[:4] + b"\x03" + whole[5:], ": it is of version 3 of GLB; version 2 is read"),
        ("empty.glb", b"glTF" + struct.pack("<II", 2, 12), ": it has no JSON chunk"),
        ("garbage.glb", b"\x93garbage" * 40, " is not valid JSON: "),
        ("text.gltf", b"{nothing}", " is not valid JSON: "),
        ("deep.gltf", b"[" * 100_000, " is not valid JSON: its brackets are nested more than 200 deep"),
        ("other.gltf", b'{"size": 3}', ": it is no glTF file: asset, with the version of glTF, is missing"),
        ("old.gltf", b'{"asset": {"version": "1.0"}}', ": asset.version is '1.0'; glTF 2.0 is read"),
        ("beside.gltf", beside, f": buffers[0].uri: {tmp_path / 'missing.bin'} does not exist"),
        (
            "index.glb",
            wrong_index.glb(tmp_path / "a").read_bytes(),
            ": meshes[0].primitives[0].indices name vertex 7, but they are numbered 0 to 2",
        ),
        ("none.glb", no_mesh.glb(tmp_path / "a").read_bytes(), ": it has no triangles"),
        ("nan.glb", not_finite.glb(tmp_path / "a").read_bytes(), "not a finite number"),
        (
            "packed.glb",
            packed.glb(tmp_path / "a").read_bytes(),
            "it is compressed with EXT_meshopt_compression, which",
        ),
    ]:
        path = tmp_path / name
        path.write_bytes(content)
        with pytest.raises(InputError) as error:
            read_mesh(path)
        assert str(error.value).startswith(str(path))
        assert message in str(error.value)
        assert "\n" not in str(error.value)


def test_a_missing_texture_is_told(tmp_path: Path) -> None:
    model = Triangle()
    model.document["images"] = [{"uri": "missing.png"}]
    model.document["textures"] = [{"source": 0}]
    model.attribute("TEXCOORD_0", np.zeros((3, 2), dtype=np.float32))
    model.material(baseColorTexture={"index": 0})
    path = model.glb(tmp_path / "model.glb")
    with pytest.warns(InputWarning) as told:
        assert corner_colors(read_mesh(path)) == [[[255, 255, 255]] * 3]
    assert [str(warning.message) for warning in told] == [
        f"{path}: a texture is left out: images[0].uri: {tmp_path / 'missing.png'} does not exist"
    ]


def test_the_part_of_a_texture_that_a_transform_takes(tmp_path: Path) -> None:
    """The example of the extension: the lower left quarter of the image, turned by 90 degrees."""
    model = Triangle()
    image = Image.new("RGB", (4, 4))
    image.paste((255, 0, 0), (0, 2, 2, 4))
    image.putpixel((0, 3), (0, 255, 0))
    model.texture(image)
    model.attribute("TEXCOORD_0", np.array([[0.25, 0.25], [0.75, 0.25], [0.25, 0.75]], dtype=np.float32))
    transform = {"offset": [0, 1], "rotation": np.pi / 2, "scale": [0.5, 0.5]}
    model.material(baseColorTexture={"index": 0, "extensions": {"KHR_texture_transform": transform}})
    model.document["extensionsRequired"] = ["KHR_texture_transform"]
    with pytest.warns(InputWarning):
        mesh = read_mesh(model.glb(tmp_path / "model.glb"))
    assert corner_colors(mesh) == [[[0, 255, 0], [255, 0, 0], [255, 0, 0]]]


def test_diffuse_color_of_the_older_material(tmp_path: Path) -> None:
    model = Triangle()
    model.material()
    glossiness = {"diffuseFactor": [0, 0.2, 1, 1]}
    model.document["materials"][0]["extensions"] = {"KHR_materials_pbrSpecularGlossiness": glossiness}
    assert corner_colors(read_mesh(model.glb(tmp_path / "model.glb"))) == [[[0, 124, 255]] * 3]


def refusal(folder: Path, model: Gltf) -> str:
    path = model.gltf(folder / "model.gltf")
    with pytest.raises(InputError) as error:
        read_mesh(path)
    told = str(error.value)
    assert told.startswith(f"{path}: ")
    assert "\n" not in told
    return told.removeprefix(f"{path}: ")


def changed(**keys: Any) -> Gltf:
    model = Triangle()
    model.document |= keys
    return model


def test_what_a_document_lacks_is_named(tmp_path: Path) -> None:
    accessor = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
    view = {"buffer": 0, "byteLength": 36}
    for model, message in [
        (changed(asset={"version": "3.0"}), "asset.version is '3.0'; glTF 2.0 is read"),
        (changed(asset={}), "asset.version is None; glTF 2.0 is read"),
        (changed(asset={"version": "2.1", "minVersion": "2.1"}), "asset.minVersion is '2.1'; glTF 2.0 is read"),
        (
            changed(extensionsRequired=["KHR_texture_basisu"]),
            "it requires the extension KHR_texture_basisu, which is not read; export it without",
        ),
        (
            changed(accessors=[accessor | {"type": "VEC9"}]),
            "accessors[0].type must be one of VEC3, not 'VEC9'",
        ),
        (
            changed(accessors=[accessor | {"componentType": 5124}]),
            "accessors[0].componentType must be one of 5120, 5121, 5122, 5123, 5125, 5126, not 5124",
        ),
        (
            changed(accessors=[accessor | {"count": 1.5}]),
            "accessors[0].count must be a whole number, at least 0, not 1.5",
        ),
        (changed(accessors=[accessor | {"count": 4}]), "accessors[0] needs 48 bytes of bufferViews[0], which has 36"),
        (changed(accessors=[{"componentType": 5126, "count": 10**9, "type": "VEC3"}]),
         "accessors[0] has 1,000,000,000 elements but no data"),
        (changed(bufferViews=[view | {"byteOffset": 4}]), "bufferViews[0] needs 40 bytes of buffers[0], which has 36"),
        (changed(bufferViews=[view | {"byteStride": 4}]),
         "bufferViews[0].byteStride is 4, less than an element of 12 bytes"),
        (changed(bufferViews=[]), "accessors[0].bufferView is 0, but there are 0 bufferViews, numbered from 0"),
        (changed(nodes=[{"mesh": 1}]), "nodes[0].mesh is 1, but there are 1 meshes, numbered from 0"),
        (changed(nodes=[{"matrix": [float("nan")] * 16, "mesh": 0}]), "nodes[0].matrix must be 16 numbers, not [nan, "),
        (changed(nodes=[{"rotation": [0, 0, 0, 0], "mesh": 0}]), "nodes[0]: a rotation must not be the zero"),
        (changed(nodes=[{"children": [0]}]), "nodes[0] hangs on several nodes, or on itself, which glTF does not"),
        (changed(nodes=[{"children": [7]}]), "nodes[0].children[0] is 7, but there are 1 nodes, numbered from 0"),
        (changed(scene=3), "scene is 3, but there are 1 scenes, numbered from 0"),
        (changed(meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "mode": 7}]}]),
         "meshes[0].primitives[0].mode must be from 0 to 6, not 7"),
        (changed(meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 0}]}]),
         "accessors[0].type must be one of SCALAR, not 'VEC3'"),
    ]:  # fmt: skip
        assert refusal(tmp_path, model).startswith(message)


def test_coordinates_beyond_floats_are_told_without_other_warnings(tmp_path: Path) -> None:
    model = Triangle()
    model.document["nodes"] = [{"children": [1], "scale": [1e299] * 3}, {"mesh": 0, "scale": [1e299] * 3}]
    model.document["nodes"][0]["translation"] = [-1e299, 0, 0]
    assert "coordinate that is not a finite number" in refusal(tmp_path, model)


def test_files_beside_are_named(tmp_path: Path) -> None:
    for uri, message in [
        ("missing%20data.bin", f"buffers[0].uri: {tmp_path / 'missing data.bin'} does not exist"),
        ("../a.bin", "buffers[0].uri is '../a.bin'; only files in the folder of the glTF file are read"),
        ("http://127.0.0.1:9/a.bin", "buffers[0].uri is 'http://127.0.0.1:9/a.bin'; only files in the folder of the"),
        ("data:;base64,A", "buffers[0].uri does not hold valid base64"),
    ]:
        path = Triangle().gltf(tmp_path / "model.gltf", uri)
        with pytest.raises(InputError) as error:
            read_mesh(path)
        assert str(error.value).startswith(f"{path}: {message}")


def test_nodes_deep_in_one_another(tmp_path: Path) -> None:
    model = Triangle()
    model.document["nodes"] = [{"children": [number + 1]} for number in range(5000)] + [{"mesh": 0}]
    assert len(np.asarray(read_mesh(model.glb(tmp_path / "model.glb")).faces)) == 1


def test_a_mesh_that_is_shown_too_often(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.scene._files.gltf.read.MAX_TRIANGLES", 9)
    model = Triangle()
    model.document["nodes"] = [{"mesh": 0}] * 10
    model.document["scenes"] = [{"nodes": list(range(10))}]
    assert refusal(tmp_path, model) == "it shows more than 9 triangles, the most that are read"
