import base64
import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from shackled.errors import InputError
from shackled.scene.files import read_mesh
from shackled.scene.mesh import DEFAULT_COLOR, Mesh

POINTS = ((0, 0, 0), (1, 0, 0), (0, 1, 0))
ASCII_STL = "solid s\nfacet normal 0 0 1\nouter loop\n{}endloop\nendfacet\nendsolid s\n"


def corner_colors(mesh: Mesh) -> list[list[list[int]]]:
    colors: list[list[list[int]]] = np.asarray(mesh.colors)[np.asarray(mesh.faces)].tolist()
    return colors


def corner_positions(mesh: Mesh) -> list[list[list[float]]]:
    positions: list[list[list[float]]] = np.asarray(mesh.positions)[np.asarray(mesh.faces)].tolist()
    return positions


def test_stl_in_binary(tmp_path: Path) -> None:
    path = tmp_path / "model.stl"
    triangle = struct.pack("<12fH", 0, 0, 1, *(float(c) for point in POINTS for c in point), 0)
    path.write_bytes(bytes(80) + struct.pack("<I", 2) + 2 * triangle)
    mesh = read_mesh(path)
    assert corner_positions(mesh) == [[list(p) for p in POINTS]] * 2
    assert len(np.asarray(mesh.positions)) == 3
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3] * 2
    assert mesh.normals is None


def test_stl_as_text_with_two_solids(tmp_path: Path) -> None:
    path = tmp_path / "model.STL"
    one = ASCII_STL.format("".join(f"vertex {x} {y} {z}\n" for x, y, z in POINTS))
    path.write_text(one + one.replace("vertex 1 0 0", "vertex 2 0 0"))
    mesh = read_mesh(path)
    assert len(np.asarray(mesh.faces)) == 2
    assert len(np.asarray(mesh.positions)) == 4


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            b"\x00\x01garbage" * 20,
            ": it is neither text nor as long as a binary STL file of so many triangles would be",
        ),
        (
            ASCII_STL.format("vertex 0 0 0\nvertex 1 zero 0\nvertex 0 1 0\n").encode(),
            "is not a STL file that can be read: ",
        ),
        (bytes(84), ": it has no triangles"),
        (bytes(80) + struct.pack("<I", 9) + bytes(50), ": it is neither text nor as long as a binary STL"),
        (ASCII_STL.format("vertex 0 0 0\nvertex 1 nan 0\nvertex 0 1 0\n").encode(), "not a finite number"),
    ],
)
def test_broken_stl_is_told_in_one_line(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "model.stl"
    path.write_bytes(content)
    with pytest.raises(InputError) as error:
        read_mesh(path)
    assert str(error.value).startswith(str(path))
    assert message in str(error.value)
    assert "\n" not in str(error.value)


class Gltf:
    """A glTF document of one triangle, to which tests add."""

    def __init__(self) -> None:
        self.data = b""
        self.document: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {}}]}],
            "bufferViews": [],
            "accessors": [],
        }
        self.attribute("POSITION", np.array(POINTS, dtype=np.float32))

    def attribute(self, name: str, values: np.ndarray[Any, Any], normalized: bool = False) -> None:
        self.primitive["attributes"][name] = self.accessor(values, normalized)

    @property
    def primitive(self) -> dict[str, Any]:
        primitive: dict[str, Any] = self.document["meshes"][0]["primitives"][0]
        return primitive

    def view(self, data: bytes) -> int:
        self.data += bytes(-len(self.data) % 4)
        self.document["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.document["bufferViews"]) - 1

    def accessor(self, values: np.ndarray[Any, Any], normalized: bool = False) -> int:
        kinds = {"f4": 5126, "u1": 5121, "u2": 5123, "u4": 5125}
        shape = {1: "SCALAR"} if values.ndim == 1 else {2: {2: "VEC2", 3: "VEC3", 4: "VEC4"}[values.shape[-1]]}
        self.document["accessors"].append(
            {
                "bufferView": self.view(values.tobytes()),
                "componentType": kinds[values.dtype.str[1:]],
                "count": len(values),
                "type": shape[values.ndim],
                "normalized": normalized,
            }
        )
        return len(self.document["accessors"]) - 1

    def material(self, **values: Any) -> None:
        self.document["materials"] = [{"pbrMetallicRoughness": values}]
        self.primitive["material"] = 0

    def texture(self, image: Image.Image) -> None:
        stream = io.BytesIO()
        image.save(stream, "PNG")
        self.document["images"] = [{"bufferView": self.view(stream.getvalue()), "mimeType": "image/png"}]
        self.document["textures"] = [{"source": 0}]

    def glb(self, path: Path) -> Path:
        self.document["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.document).encode()
        text += b" " * (-len(text) % 4)
        data = self.data + bytes(-len(self.data) % 4)
        length = 12 + 8 + len(text) + 8 + len(data)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, length) + chunks)
        return path

    def gltf(self, path: Path, uri: str | None = None) -> Path:
        uri = uri or "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.document["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        path.write_text(json.dumps(self.document))
        return path


def test_glb_without_material(tmp_path: Path) -> None:
    mesh = read_mesh(Gltf().glb(tmp_path / "model.glb"))
    assert corner_positions(mesh) == [[list(p) for p in POINTS]]
    assert corner_colors(mesh) == [[list(DEFAULT_COLOR)] * 3]
    assert mesh.normals is None


def test_gltf_with_its_data_inside_and_beside(tmp_path: Path) -> None:
    model = Gltf()
    assert corner_positions(read_mesh(model.gltf(tmp_path / "model.gltf"))) == [[list(p) for p in POINTS]]
    (tmp_path / "data.bin").write_bytes(model.data)
    path = model.gltf(tmp_path / "other.gltf", "data.bin")
    assert corner_positions(read_mesh(path)) == [[list(p) for p in POINTS]]


@pytest.mark.parametrize("scale", [1, 257])
def test_vertex_colors_of_8_and_16_bits(tmp_path: Path, scale: int) -> None:
    model = Gltf()
    colors = np.array([[255, 0, 0, 255], [0, 100, 0, 255], [0, 0, 7, 255]]) * scale
    model.attribute("COLOR_0", colors.astype(np.uint8 if scale == 1 else np.uint16), normalized=True)
    assert corner_colors(read_mesh(model.glb(tmp_path / "model.glb"))) == [[[255, 0, 0], [0, 100, 0], [0, 0, 7]]]


def test_material_color_times_vertex_color(tmp_path: Path) -> None:
    model = Gltf()
    model.attribute("COLOR_0", np.array([[1, 1, 1], [0.5, 1, 1], [0, 0, 0]], dtype=np.float32))
    model.material(baseColorFactor=[1, 0.2, 0, 1])
    assert corner_colors(read_mesh(model.glb(tmp_path / "model.glb"))) == [[[255, 51, 0], [128, 51, 0], [0, 0, 0]]]


def test_texture_is_sampled_from_its_top(tmp_path: Path) -> None:
    model = Gltf()
    image = Image.new("RGB", (1, 2), (255, 0, 0))
    image.putpixel((0, 1), (0, 0, 255))
    model.texture(image)
    model.attribute("TEXCOORD_0", np.array([[0, 0], [0, 1], [0, 0.5]], dtype=np.float32))
    model.material(baseColorTexture={"index": 0})
    assert corner_colors(read_mesh(model.glb(tmp_path / "model.glb"))) == [[[255, 0, 0], [0, 0, 255], [128, 0, 128]]]


def test_nodes_put_parts_in_their_places(tmp_path: Path) -> None:
    model = Gltf()
    model.attribute("NORMAL", np.array([[0, 0, 1]] * 3, dtype=np.float32))
    model.document["nodes"] = [
        {"children": [1, 2], "translation": [10, 0, 0]},
        {"mesh": 0, "scale": [2, 2, 2]},
        {"mesh": 0, "rotation": [0, 2**-0.5, 0, 2**-0.5]},
    ]
    mesh = read_mesh(model.glb(tmp_path / "model.glb"))
    positions = np.array(corner_positions(mesh))
    normals = np.asarray(mesh.normals)[np.asarray(mesh.faces)]
    order = np.argsort(positions[:, 2, 1])
    wanted = [[[10, 0, 0], [10, 0, -1], [10, 1, 0]], [[10, 0, 0], [12, 0, 0], [10, 2, 0]]]
    np.testing.assert_allclose(positions[order], wanted, atol=1e-6)
    np.testing.assert_allclose(normals[order], [[[1, 0, 0]] * 3, [[0, 0, 1]] * 3], atol=1e-6)


def test_a_mirrored_part_is_still_seen_from_outside(tmp_path: Path) -> None:
    model = Gltf()
    model.attribute("NORMAL", np.array([[0, 0, 1]] * 3, dtype=np.float32))
    model.document["nodes"] = [{"mesh": 0, "scale": [-1, 1, 1]}]
    mesh = read_mesh(model.glb(tmp_path / "model.glb"))
    a, b, c = np.asarray(mesh.positions)[np.asarray(mesh.faces)][0]
    assert np.cross(b - a, c - a).tolist() == [0, 0, 1]
    assert np.asarray(mesh.normals).tolist() == [[0, 0, 1]] * 3


def test_broken_gltf_is_told_in_one_line(tmp_path: Path) -> None:
    whole = Gltf().glb(tmp_path / "whole.glb").read_bytes()
    wrong_index = Gltf()
    wrong_index.primitive["indices"] = wrong_index.accessor(np.array([0, 1, 7], dtype=np.uint16))
    no_mesh = Gltf()
    no_mesh.document["nodes"] = [{}]
    packed = Gltf()
    packed.document["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    not_finite = Gltf()
    not_finite.attribute("POSITION", np.array([[0, 0, 0], [1, 0, np.nan], [0, 1, 0]], dtype=np.float32))
    beside = Gltf().gltf(tmp_path / "lost.gltf", "missing.bin").read_bytes()
    for name, content, message in [
        ("cut.glb", whole[:-30], "is not a GLB file that can be read: "),
        ("garbage.glb", b"\x93garbage" * 40, "is not a GLB file that can be read: "),
        ("text.gltf", b"{nothing}", "is not a GLTF file that can be read: "),
        ("old.gltf", b'{"asset": {"version": "1.0"}}', "is not a GLTF file that can be read: only GLTF 2"),
        ("beside.gltf", beside, "is not a GLTF file that can be read: "),
        ("index.glb", wrong_index.glb(tmp_path / "a").read_bytes(), "face 0 names the vertices [0, 1, 7]"),
        ("none.glb", no_mesh.glb(tmp_path / "a").read_bytes(), ": it has no triangles"),
        ("nan.glb", not_finite.glb(tmp_path / "a").read_bytes(), "not a finite number"),
        (
            "packed.glb",
            packed.glb(tmp_path / "a").read_bytes(),
            "it is compressed with KHR_draco_mesh_compression, which",
        ),
    ]:
        path = tmp_path / name
        path.write_bytes(content)
        with pytest.raises(InputError) as error:
            read_mesh(path)
        assert str(error.value).startswith(str(path))
        assert message in str(error.value)
        assert "\n" not in str(error.value)


def test_nothing_is_printed(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    model = Gltf()
    model.document["images"] = [{"uri": "missing.png"}]
    model.document["textures"] = [{"source": 0}]
    model.attribute("TEXCOORD_0", np.zeros((3, 2), dtype=np.float32))
    model.material(baseColorTexture={"index": 0})
    assert corner_colors(read_mesh(model.glb(tmp_path / "model.glb"))) == [[[255, 255, 255]] * 3]
    assert capfd.readouterr() == ("", "")
