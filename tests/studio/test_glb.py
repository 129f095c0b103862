"""GLB files: the contract against a plain reader, Khronos' validator, trimesh and the package's own reader."""

from __future__ import annotations

import base64
import io
import json
import re
import struct
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from attrs import evolve
from eth_abi.abi import decode
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from tools.ledger import World, call_data

import gltf_reader
from shackled import Camera, Light, Material, Mesh, Object, RenderError, Scene, load
from shackled.artifacts import artifact
from shackled.datasets import pieces, teapot
from shackled.deploy._contract import local_chain
from shackled.ethereum._encoding import word
from shackled.scene._arithmetic import from_euler
from shackled.scene._codec import encode_scene
from shackled.scene._in_range import in_range
from shackled.scene._packed import pack
from shackled.studio import store_scene
from shackled.studio._compact_mesh import compact
from shackled.studio._storage import scene_struct, store_mesh

MODULES = Path(__file__).resolve().parents[2] / "web" / "node_modules"
HERE = Path(__file__).resolve().parent

POT = Mesh(np.round(np.asarray(teapot(2).positions) * 100), teapot(2).faces)
TENT = Mesh([[-90, 0, 0], [90, 0, 0], [0, 150, 40]], [[0, 1, 2]], [[255, 0, 0], [0, 128, 3], [10, 0, 255]])
WIDE = Mesh(np.asarray(TENT.positions) * 40_000, [[0, 1, 2], [0, 2, 1]], TENT.colors)
SMOOTH, FLAT, UNLIT = (Material(shading) for shading in ("smooth", "flat", "unlit"))
SCENE = Scene(
    [
        Object(POT, (0.1, -100, -1e-9), material=SMOOTH),
        Object(TENT, (50, 20, 200), from_euler((10, 30, -40)), 0.5, cull=False, opacity=0.25),
        Object(WIDE, (-1 / 3, 1e7, 0), from_euler((0, 180, 0)), 1 / 40_000, UNLIT),
        Object(TENT, material=SMOOTH, wireframe=True),
    ],
    Camera((200, 250, 900), (0, 40, 0)),
    [Light("spot", (300, 500, 900), (255, 240, 200), (-300, -500, -900), 5, 20)],
    width=48,
    height=40,
)


def call(scene: Scene, function: str = "encode") -> bytes:
    return answer(artifact("GlbEncoder").selectors[function] + word(32) + encode_scene(in_range(scene)))


def answer(data: bytes) -> bytes:
    """The file that the contract makes for the data of a call."""
    return bytes(decode(["bytes"], local_chain().call("GlbEncoder", data).output)[0])


def linear(colors: NDArray[np.uint8]) -> NDArray[np.uint16]:
    """sRGB (IEC 61966-2-1) as 16 bits."""
    c = np.asarray(colors) / 255
    return np.round(np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4) * 65535).astype("<u2")


def packed_normals(mesh: Mesh) -> NDArray[np.float64]:
    packed = pack(mesh, True)
    stride, count = 13 if packed[0] == 1 else 16, len(mesh.positions)
    rows = np.frombuffer(packed, np.uint8, count * stride, 5).reshape(count, stride)[:, -4:]
    words = np.ascontiguousarray(rows).view(">u4").astype(np.int64)
    parts = ((words >> np.array([22, 12, 2]) & 1023 ^ 512) - 512).astype(np.float64)
    parts[~parts.any(axis=1)] = 0, 0, 1
    return np.asarray(parts / np.linalg.norm(parts, axis=1, keepdims=True))


def compare(glb: bytes, scene: Scene, fitted: bool = False) -> None:
    """What a plain reader finds is the scene; the normals are those that the renderer has."""
    document, binary = gltf_reader.split(glb)
    objects = (scene if fitted else in_range(scene)).objects
    assert struct.unpack_from("<4sII", glb) == (b"glTF", 2, len(glb))
    assert document["asset"] == {"version": "2.0", "generator": "Shackled"}
    assert (document["scene"], document["scenes"]) == (0, [{"nodes": list(range(len(objects)))}])
    extended = any("extensions" in surface for surface in document["materials"])
    assert document.get("extensionsUsed") == (["KHR_materials_unlit"] if extended else None)
    parts = zip(objects, document["nodes"], document["meshes"], document["materials"], strict=True)
    for number, (o, node, mesh, surface) in enumerate(parts):
        unlit = o.wireframe or o.material.shading == "unlit"
        pbr: dict[str, Any] = {"metallicFactor": 0, "roughnessFactor": 0.8}
        expected: dict[str, Any] = {"pbrMetallicRoughness": pbr}
        if o.opacity < 1:
            expected |= {"alphaMode": "BLEND"}
            pbr |= {"baseColorFactor": [1, 1, 1, pytest.approx(o.opacity)]}
        expected |= {} if o.cull else {"doubleSided": True}
        assert surface == expected | ({"extensions": {"KHR_materials_unlit": {}}} if unlit else {})
        assert node == {
            "mesh": number,
            "translation": pytest.approx(list(o.position), abs=1e-9),
            "rotation": pytest.approx(list(o.rotation / np.linalg.norm(o.rotation)), abs=1e-6),
            "scale": [pytest.approx(o.scale, rel=1e-4, abs=2e-10)] * 3,
        }
        (primitive,) = mesh["primitives"]
        assert (primitive["material"], primitive.get("mode", 4)) == (number, 1 if o.wireframe else 4)
        found = {
            name: np.array(gltf_reader.elements(document, [binary], at))
            for name, at in {**primitive["attributes"], "indices": primitive["indices"]}.items()
        }
        assert np.array_equal(found["POSITION"], o.mesh.positions.astype("<f4"))
        assert np.array_equal(np.rint(found["COLOR_0"] * 65535)[:, :3], linear(o.mesh.colors))
        assert (found["COLOR_0"][:, 3] == 1).all()
        faces = o.mesh.faces[:, [0, 1, 1, 2, 2, 0]] if o.wireframe else o.mesh.faces
        assert np.array_equal(found["indices"].ravel(), faces.ravel())
        assert ("NORMAL" in found) == (o.material.shading == "smooth" and not unlit)
        if "NORMAL" in found:
            assert np.abs(found["NORMAL"] - packed_normals(o.mesh)).max() < 1e-6


def assert_valid(files: list[bytes], folder: Path) -> None:
    """Khronos' validator finds nothing."""
    if not (MODULES / "gltf-validator").is_dir():
        pytest.skip("needs gltf-validator: npm ci in web/")
    (folder / "files").write_bytes(b"".join(len(each).to_bytes(4, "big") + each for each in files))
    subprocess.run(["node", HERE / "validate_glb.mjs", MODULES, folder / "files", folder / "reports"], check=True)
    reports = json.loads((folder / "reports").read_text("utf-8"))
    assert len(reports) == len(files)
    for issues in (report["issues"] for report in reports):
        assert issues["numErrors"] == issues["numWarnings"] == 0, issues["messages"]


def test_a_scene_of_every_kind(tmp_path: Path) -> None:
    glb = call(SCENE)
    compare(glb, SCENE)
    assert_valid([glb], tmp_path)
    assert call(SCENE, "dataURI") == b"data:model/gltf-binary;base64," + base64.b64encode(glb)


@st.composite
def scenes(draw: st.DrawFn) -> Scene:
    rng = np.random.default_rng(draw(st.integers(0, 2**32)))
    objects = []
    for _ in range(draw(st.integers(1, 3))):
        count, size = draw(st.integers(3, 9)), draw(st.sampled_from([3, 300, 32_767, 8_000_000]))
        positions = rng.integers(-size, size + 1, (count, 3))
        faces = [rng.permutation(count)[:3] for _ in range(draw(st.integers(1, 5)))]
        objects.append(
            Object(
                Mesh(positions, faces, rng.integers(0, 256, (count, 3))),
                rng.normal(0, 10.0 ** rng.integers(-3, 6), 3),
                rng.normal(0, 1, 4),
                10.0 ** rng.uniform(-3, 0),
                draw(st.sampled_from([SMOOTH, FLAT, UNLIT])),
                cull=draw(st.booleans()),
                wireframe=draw(st.booleans()),
                opacity=draw(st.sampled_from([0.0, 0.5, 1.0])),
            )
        )
    return Scene(objects)


@settings(max_examples=60)
@given(scenes())
def test_any_scene(scene: Scene) -> None:
    compare(call(scene), scene)


def test_the_longest_document() -> None:
    """Numbers of the most characters fit the room that is set aside for each object."""
    far = -(2.0**26) + 2**-31
    mesh = evolve(WIDE, positions=[[-8_388_607, -8_388_600, -8_388_601], [8_388_607] * 3, [-1, -2, -8_388_602]])
    rotation, scale = (-0.7071067811, -0.1234567, -0.4321111, -0.54), 0.1234567891
    scene = Scene([Object(mesh, (far, far, far), rotation, scale, SMOOTH, cull=False, opacity=0.3333333)] * 40)
    glb = call(scene)
    compare(glb, scene)
    assert struct.unpack_from("<I", glb, 12)[0] < 512 + 1536 * 40


def test_readers_see_the_scene(tmp_path: Path) -> None:
    """trimesh finds its box, and the package itself its colours."""
    import trimesh

    lit = evolve(SCENE, objects=SCENE.objects[:3])
    places = np.concatenate([o.world_positions() for o in in_range(lit).objects])
    model_ = trimesh.load_scene(io.BytesIO(call(lit)), file_type="glb")
    assert len(model_.geometry) == 3
    assert model_.bounds == pytest.approx(np.array([places.min(0), places.max(0)]), rel=1e-5)
    file = tmp_path / "scene.glb"
    file.write_bytes(call(evolve(SCENE, objects=[evolve(SCENE.objects[1], opacity=1.0)])))
    (loaded,) = load(file).objects
    assert np.array_equal(loaded.mesh.colors, TENT.colors)


def test_every_icon_is_valid(tmp_path: Path) -> None:
    assert_valid([call(piece.make()) for piece in pieces("icons")], tmp_path)


def test_the_studio_models_what_it_keeps(tmp_path: Path) -> None:
    world = World()
    studio = world.address("Studio")
    for storing in store_scene(SCENE, studio):
        world.run(studio, storing.data, created=True)
    glb = world.call("Studio", "glb(address)", "0x" + storing.pointer.hex())
    # vertices and faces are in another order when they are kept
    assert gltf_reader.split(glb)[0] == gltf_reader.split(call(SCENE))[0]
    uri = world.call("Studio", "glbDataURI(address)", "0x" + storing.pointer.hex())
    assert uri == "data:model/gltf-binary;base64," + base64.b64encode(glb).decode()
    files = [glb]
    for packed in (pack(POT, True), pack(TENT, False)):
        (storing,) = store_mesh("mesh", compact(packed), studio)
        world.run(studio, storing.data, created=True)
        plain = world.store("storeMesh(bytes)", packed)
        assert storing.content == compact(packed)
        for pointer in (storing.pointer, plain):
            files.append(world.call("Studio", "glb(address)", "0x" + pointer.hex()))
        material = SMOOTH if packed[0] else FLAT
        compare(files[-1], Scene([Object(POT if packed[0] else TENT, material=material, cull=False)]), fitted=True)
    assert_valid(files, tmp_path)
    with pytest.raises(RenderError, match="UnknownMesh"):
        world.call("Studio", "glb(address)", "0x" + world.store("storePart(bytes)", b"\x44").hex())


def changed(change: Any) -> bytes:
    """Data of a call with other objects."""
    kind = scene_struct()
    (values,) = decode([kind], word(32) + encode_scene(in_range(evolve(SCENE, objects=[SCENE.objects[1]]))))
    *others, objects, extensions = values
    return call_data(f"encode({kind})", (*others, [change(objects[0])], extensions))


@pytest.mark.parametrize(
    ("change", "error"),
    [
        (lambda o: (b"\0\0\0\0\0", *o[1:]), "NothingToShow()"),
        (lambda o: (b"\0\0\1\0\0" + bytes(9), *o[1:]), "NothingToShow()"),
        (lambda o: (o[0][:-1], *o[1:]), "MeshLength(object=0"),
        (lambda o: (o[0][:-1] + b"\3", *o[1:]), "IndexOutOfRange(object=0, face=0, vertexCount=3)"),
        (lambda o: (o[0], ((1 << 58) + 1, 0, 0), *o[2:]), "PositionOutOfRange(object=0"),
        (lambda o: (*o[:2], (0, 0, 0, 0), *o[3:]), "RotationIsZero(object=0)"),
        (lambda o: (*o[:4], (2, *o[4][1:]), o[5]), "NoNormals(object=0)"),
    ],
)
def test_what_is_refused(change: Any, error: str) -> None:
    with pytest.raises(RenderError, match=re.escape(error)):
        answer(changed(change))


def test_objects_without_faces_are_left_out(tmp_path: Path) -> None:
    """Opacities stay with their objects."""
    kind = scene_struct()
    scene = evolve(SCENE, objects=[SCENE.objects[at] for at in (2, 1, 0, 1)], lights=[])
    (values,) = decode([kind], word(32) + encode_scene(in_range(scene)))
    objects = list(values[6])
    objects[0], objects[1] = (b"\0\0\1\0\0" + bytes(9), *objects[0][1:]), (bytes(5), *objects[1][1:])
    glb = answer(call_data(f"encode({kind})", (*values[:6], objects, values[7])))
    compare(glb, evolve(in_range(scene), objects=in_range(scene).objects[2:]), fitted=True)
    assert_valid([glb], tmp_path)


def test_a_normal_of_no_length_becomes_one(tmp_path: Path) -> None:
    packed = pack(TENT, True)
    data = changed(lambda o: (packed[:14] + bytes(4) + packed[18:], *o[1:4], (2, *o[4][1:]), o[5]))
    assert_valid([answer(data)], tmp_path)
