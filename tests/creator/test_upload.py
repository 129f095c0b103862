"""Files of strangers: what is good is shown, what is hostile gets a clear message and harms nobody."""

from __future__ import annotations

import asyncio
import base64
import hashlib
import io
import json
import struct
import zipfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image as PillowImage
from PIL.PngImagePlugin import PngInfo

from shackled import InputError, load, render
from shackled.creator import Limits, Pool, PoolError, Size, Source, State, Store, Stored, clean_name
from shackled.errors import InputWarning
from shackled.scene import simplify_scene, write_scene

LIMITS = Limits(triangles=500, all_triangles=1200, reading_seconds=10, unpacked=2**20)

TRIANGLE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


class Visitor:
    """Hands files to a pool that lives in a thread of its own."""

    def __init__(self) -> None:
        self._thread = ThreadPoolExecutor(1)
        self._loop = asyncio.new_event_loop()
        self.pool = self._do(self._open())

    async def _open(self) -> Pool:
        return Pool(1, LIMITS)

    def _do(self, coroutine: Any) -> Any:
        return self._thread.submit(lambda: self._loop.run_until_complete(coroutine)).result(60)

    def upload(self, name: str | None, data: bytes) -> Any:
        return self._do(self.pool.upload("a", name, data))

    def render(self, state: State) -> Any:
        return self._do(self.pool.render("a", state))

    def close(self) -> None:
        self._do(self.pool.close())
        self._thread.submit(self._loop.close)
        self._thread.shutdown()


@pytest.fixture(scope="module")
def visitor() -> Iterator[Visitor]:
    made = Visitor()
    yield made
    made.close()


def zipped(files: dict[str, bytes], packing: int = zipfile.ZIP_DEFLATED) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", packing) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return stream.getvalue()


def gltf(**changes: Any) -> dict[str, Any]:
    """One triangle."""
    data = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], "<f4").tobytes() + np.array([0, 1, 2], "<u2").tobytes()
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 36, "byteOffset": 0},
            {"buffer": 0, "byteLength": 6, "byteOffset": 36},
        ],
        "buffers": [
            {"byteLength": 42, "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}
        ],
    } | changes


def text(document: Any) -> bytes:
    return json.dumps(document).encode()


def glb(document: dict[str, Any]) -> bytes:
    content = text(document)
    content += b" " * (-len(content) % 4)
    return b"glTF" + struct.pack("<IIII", 2, 20 + len(content), len(content), 0x4E4F534A) + content


def scene_document(mesh: Any) -> bytes:
    return text({"objects": [{"mesh": mesh}]})


# ---- what is good ----


def test_a_mesh_is_shown_as_the_command_line_shows_it(visitor: Visitor, tmp_path: Path) -> None:
    upload = visitor.upload("Meine Datei.obj", TRIANGLE)
    (tmp_path / "a.obj").write_bytes(TRIANGLE)
    frame = visitor.render(State(upload.source))
    assert frame.bmp == render(load(tmp_path / "a.obj")).bmp
    assert upload.source == Source("upload", hashlib.sha256(TRIANGLE).hexdigest())
    assert upload.facts.title == "Meine Datei.obj"
    assert upload.notes == ()


def test_a_picture_brings_its_scene(visitor: Visitor) -> None:
    drawn = render("icons/coin", 60)
    picture = drawn.encode(".png")
    upload = visitor.upload("coin.png", picture)
    assert upload.notes == ()
    assert visitor.render(State(upload.source)).bmp == drawn.bmp
    # also in an archive, where it is a texture unless nothing else is there
    assert visitor.upload("a.zip", zipped({"coin.png": picture})).facts.triangles == upload.facts.triangles
    beside = zipped({"wall.png": picture, "roof.png": picture, "a.obj": TRIANGLE})
    assert visitor.upload(None, beside).facts.triangles == 1


def test_the_ground_of_a_picture_is_no_object(visitor: Visitor) -> None:
    drawn = render(load("cube", 16, ground="tan", shadow=True))
    facts = visitor.upload("cube.png", drawn.encode(".png")).facts
    assert (facts.objects, facts.triangles, facts.closed) == (1, 12, True)


@pytest.mark.parametrize("name", ["a.gltf", "a.glb"])
def test_gltf(visitor: Visitor, name: str) -> None:
    document = gltf()
    upload = visitor.upload(name, text(document) if name == "a.gltf" else glb(document))
    assert upload.facts.triangles == 1
    assert visitor.render(State(upload.source)).lit_pixels > 100


def test_a_texture_beside_its_mesh(visitor: Visitor, tmp_path: Path) -> None:
    image = io.BytesIO()
    PillowImage.fromarray(np.random.default_rng(1).integers(0, 256, (300, 9, 3), dtype=np.uint8)).save(image, "PNG")
    corners = b"vt 0 0\nvt 1 0\nvt 0 1\n"
    files = {
        "a.obj": b"mtllib a.mtl\nusemtl a\n" + corners + TRIANGLE.replace(b"f 1 2 3", b"f 1/1 2/2 3/3"),
        "a.mtl": b"newmtl a\nmap_Kd a.png\n",
        "a.png": image.getvalue(),
    }
    upload = visitor.upload(None, zipped(files))
    assert upload.notes == ("the selection: a.png is reduced from 9 x 300 to 8 x 256 texels.",)
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
    with pytest.warns(InputWarning):
        expected = render(load(tmp_path / "a.obj"))
    assert visitor.render(State(upload.source)).bmp == expected.bmp


def test_a_scene_with_its_meshes_inside(visitor: Visitor, tmp_path: Path) -> None:
    scene = load("icons/heart")
    write_scene(scene, tmp_path / "scene.json")
    upload = visitor.upload("scene.json", (tmp_path / "scene.json").read_bytes())
    assert visitor.render(State(upload.source)).bmp == render(scene).bmp


def test_a_zip_of_a_scene_and_its_meshes(visitor: Visitor) -> None:
    toml = b'[[objects]]\nmesh = "meshes/a.obj"\ncolor = "#ff0000"\n'
    upload = visitor.upload(
        "all.zip", zipped({"mine/s.toml": toml, "mine/meshes/a.obj": TRIANGLE, "__MACOSX/mine/._s.toml": b"x"})
    )
    assert upload.facts.title == "all.zip"
    assert upload.facts.triangles == 1


def test_a_zip_of_a_mesh_with_its_texture(visitor: Visitor) -> None:
    stream = io.BytesIO()
    PillowImage.new("RGB", (4, 4), (10, 200, 30)).save(stream, "png")
    obj = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n"
    mtl = b"newmtl m\nmap_Kd a.png\n"
    upload = visitor.upload("tex.zip", zipped({"a.obj": obj, "a.mtl": mtl, "a.png": stream.getvalue()}))
    frame = visitor.render(State(upload.source))
    pixels = np.asarray(PillowImage.open(io.BytesIO(frame.png))).astype(int)
    assert (pixels[..., 1] - pixels[..., 0]).max() > 100
    assert upload.notes == ()


def test_what_is_left_out_is_told(visitor: Visitor) -> None:
    assert visitor.upload("My cube.obj", b"mtllib cube.mtl\n" + TRIANGLE).notes == (
        "My cube.obj: its materials are left out: cube.mtl does not exist.",
    )


@pytest.mark.parametrize("name", ["/etc/passwd", "/etc/no such file", "../../etc/passwd", "../../etc/nothing"])
def test_what_is_told_does_not_depend_on_files_elsewhere(name: str, visitor: Visitor) -> None:
    (note,) = visitor.upload("a.obj", f"mtllib {name}\n".encode() + TRIANGLE).notes
    last = name.rpartition("/")[2]
    assert note.endswith(f" cannot be read: {last} is outside the upload.")


def test_too_many_triangles_are_simplified(visitor: Visitor, tmp_path: Path) -> None:
    write_obj(tmp_path / "teapot.obj")
    data = (tmp_path / "teapot.obj").read_bytes()
    upload = visitor.upload("teapot.obj", data)
    assert upload.facts.triangles <= 500
    (note,) = upload.notes
    assert note.startswith("The mesh was simplified from 992 to ")
    stored = visitor.pool.store.get(upload.source.name)
    assert stored.simplified_to == 500
    assert stored.data == data
    expected = render(simplify_scene(load(tmp_path / "teapot.obj"), 500))
    assert visitor.render(State(upload.source)).bmp == expected.bmp


def test_a_canvas_that_is_too_large_is_brought_down(visitor: Visitor) -> None:
    mesh = {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]]}
    upload = visitor.upload("a.json", text({"size": [2000, 50], "objects": [{"mesh": mesh}]}))
    assert upload.facts.defaults.size == Size(1024, 25)
    assert upload.notes == ("The picture was reduced from 2000 x 50 to 1024 x 25 pixels.",)


def write_obj(path: Path) -> None:
    mesh = load("teapot").objects[0].mesh
    lines = [f"v {x} {y} {z}" for x, y, z in mesh.positions.tolist()]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in mesh.faces.tolist()]
    path.write_text("\n".join(lines))


# ---- what is not ----


def deep_nodes(count: int) -> dict[str, Any]:
    """Each node has the next one twice: 2^count triangles in a few bytes."""
    nodes: list[dict[str, Any]] = [{"children": [number + 1, number + 1]} for number in range(count)]
    return gltf(nodes=[*nodes, {"mesh": 0}])


def bomb() -> bytes:
    stream = io.BytesIO()
    PillowImage.new("L", (20000, 20000)).save(stream, "png")
    return stream.getvalue()


def lying_zip() -> bytes:
    """An archive that says that its file is small."""
    data = bytearray(zipped({"a.obj": b"v 0 0 0\n" * 400_000}))
    at = data.rindex(b"PK\x01\x02")
    data[at + 24 : at + 28] = struct.pack("<I", 100)
    return bytes(data)


def linked_zip() -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        entry = zipfile.ZipInfo("a.obj")
        entry.external_attr = 0o120777 << 16
        archive.writestr(entry, "/etc/passwd")
    return stream.getvalue()


def photograph(**options: Any) -> bytes:
    stream = io.BytesIO()
    PillowImage.new("RGB", (3, 2)).save(stream, "PNG", **options)
    return stream.getvalue()


def scene_bomb() -> bytes:
    texts = PngInfo()
    texts.add_text("shackled", "0" * 9_000_000, zip=True)
    return photograph(pnginfo=texts)


HOSTILE: dict[str, tuple[str, Any, str]] = {
    "nothing": ("a.obj", b"", "a.obj is empty"),
    "blanks": ("a.obj", b" \n\t", "a.obj is empty"),
    "no name": ("", TRIANGLE, "file: a file without an extension is not supported; supported are .obj, .ply"),
    "wrong extension": ("a.exe", b"MZ", "a.exe: .exe files are not supported; supported are .obj"),
    "another format": ("a.stl", TRIANGLE, "a.stl: it has no triangles"),
    "binary text": ("a.obj", b"v 0 0\0", "a.obj is not a text file"),
    "too large": ("a.obj", b"#" * (8 * 2**20 + 1), "the file is larger than the limit of 8 MB"),
    "not a number": ("a.obj", b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "coordinate that is not a finite number"),
    "infinite": ("a.obj", b"v inf 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "coordinate that is not a finite number"),
    "huge": ("a.obj", b"v 1e308 0 0\nv -1e308 0 0\nv 0 1e308 0\nf 1 2 3\n", "too large or too small to be"),
    "huge scene": (
        "a.json",
        scene_document({"positions": [[1e200, 0, 0], [-1e200, 0, 0], [0, 1e200, 0]], "faces": [[0, 1, 2]]}),
        "too large",
    ),
    "html in a name": ("<img src=x onerror=alert(1)>.obj", b"v 0 0 0\n", "_img src_x onerror_alert(1)_.obj"),
    "path in a name": ("../../etc/pass wd.obj", b"f 9 9 9\n", "pass wd.obj"),
    "huge counts": (
        "a.ply",
        b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
        b"property float z\nelement face 4000000000\nproperty list uchar int vertex_indices\nend_header\n",
        "a.ply",
    ),
    "huge off": ("a.off", b"OFF\n4000000000 4000000000 0\n0 0 0\n", "a.off"),
    "huge stl": ("a.stl", bytes(80) + struct.pack("<I", 2**32 - 1) + bytes(100), "a.stl"),
    "far indices": ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 999999999\n", "a.obj"),
    "no faces": ("a.obj", b"v 0 0 0\n", "a.obj"),
    "deep json": ("a.json", b"[" * 200_000, "a.json is not valid JSON"),
    "no object": ("a.json", b"{}", "a.json has no objects"),
    "many objects": (
        "a.json",
        text({"objects": [{"mesh": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]]}}] * 300}),
        "a.json has 300 objects; the limit is 256",
    ),
    "huge canvas": ("a.json", text({"size": [99999, 99999], "objects": []}), "must be from 1 to"),
    "long numbers": ("a.json", b'{"size": ' + b"9" * 100_000 + b"}", "a.json"),
    "mesh beside": (
        "a.json",
        scene_document("b.obj"),
        "b.obj does not exist in the upload: put the scene and its meshes into a ZIP",
    ),
    "mesh elsewhere": ("a.json", scene_document("/etc/hostname.obj"), "a.json"),
    "mesh above": ("a.toml", b'[[objects]]\nmesh = "../../../../etc/passwd"\n', "a.toml"),
    "accessor without end": (
        "a.glb",
        glb(gltf(accessors=[{"componentType": 5126, "count": 10**12, "type": "VEC3"}] * 2)),
        "a.glb: it declares 2,000,000,000,000 elements; the limit is 8,000,000",
    ),
    "accessor beyond its buffer": (
        "a.gltf",
        text(gltf(accessors=[{"bufferView": 0, "componentType": 5126, "count": 7_000_000, "type": "VEC3"}] * 2)),
        "a.gltf",
    ),
    "billion laughs": ("a.gltf", text(deep_nodes(40)), "has several parents, which glTF does not allow"),
    "one mesh many times": (
        "a.gltf",
        text(
            gltf(
                nodes=[{"mesh": 0}] * 9000,
                meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 0}] * 300}],
            )
        ),
        "it shows 2,700,000 triangles; the limit is 2,000,000",
    ),
    "nodes in a circle": (
        "a.gltf",
        text(gltf(nodes=[{"children": [1]}, {"children": [0]}])),
        "its nodes form a cycle",
    ),
    "nodes in nodes": (
        "a.gltf",
        text(gltf(nodes=[*({"children": [number + 1]} for number in range(5000)), {"mesh": 0}])),
        "its tree of nodes is more than 200 levels deep",
    ),
    "buffer elsewhere": (
        "a.gltf",
        text(gltf(buffers=[{"byteLength": 42, "uri": "/etc/passwd"}])),
        "it refers to '/etc/passwd', which was not uploaded: export it as one .glb",
    ),
    "buffer on the net": (
        "a.glb",
        glb(gltf(buffers=[{"byteLength": 42, "uri": "http://127.0.0.1:9/x.bin"}])),
        "it refers to 'http://127.0.0.1:9/x.bin', which was not uploaded",
    ),
    "image above": (
        "a.gltf",
        text(gltf(images=[{"uri": "..%2F..%2Fsecret.png"}])),
        "it refers to '..%2F..%2Fsecret.png', which was not uploaded",
    ),
    "gltf of strange types": ("a.gltf", text(gltf(nodes={"a": 1}, meshes=[3], accessors="x")), "a.gltf"),
    "cut glb": ("a.glb", b"glTF\x02\0\0\0", "a.glb"),
    "a photograph": ("a.png", photograph, "a.png: the picture carries no scene"),
    "cut off picture": ("a.png", lambda: render("cube", 8).encode(".png")[:300], "a.png: the picture is cut off"),
    "no picture": ("a.png", TRIANGLE, "a.png: it is not a PNG file"),
    "picture with a bomb": ("a.png", scene_bomb, "a.png: its scene has more than 8,000,000 characters"),
    "zip of two pictures": ("a.zip", zipped({"a.png": b"a", "b.png": b"b"}), "has 2 files that could be shown"),
    "not a zip": ("a.zip", b"PK\x03\x04 nothing", "a.zip: the archive"),
    "empty zip": ("a.zip", zipped({}), "a.zip: the archive has no mesh or scene file"),
    "zip bomb": ("a.zip", zipped({"a.obj": bytes(50_000_000)}), "the archive unpacks to 48 MB; the limit is 1 MB"),
    "zip that lies": ("a.zip", lying_zip, "a.zip: the archive"),
    "zip in a zip": ("a.zip", zipped({"b.zip": zipped({"a.obj": TRIANGLE})}), "the archive has no mesh or scene file"),
    "zip of many files": ("a.zip", zipped({f"{n}.txt": b"" for n in range(65)}), "has 65 files; the limit is 64"),
    "zip that climbs": ("a.zip", zipped({"../../a.obj": TRIANGLE}), "whose path leads outside: '../../a.obj'"),
    "zip from the root": ("a.zip", zipped({"/tmp/a.obj": TRIANGLE}), "whose path leads outside: '/tmp/a.obj'"),
    "zip with a drive": ("a.zip", zipped({"C:\\a.obj": TRIANGLE}), "whose path leads outside"),
    "zip with a link": ("a.zip", linked_zip, "the archive has a symbolic link, 'a.obj'"),
    "zip of two meshes": ("a.zip", zipped({"a.obj": TRIANGLE, "b.obj": TRIANGLE}), "has 2 files that could be shown"),
    "zip of long names": ("a.zip", zipped({"a" * 300 + ".obj": TRIANGLE}), "has a file with too long a path"),
    "too much in all": (
        "a.json",
        text({"objects": [{"mesh": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]] * 400}}] * 4}),
        "a.json has 1,600 triangles; the limit is 1,200",
    ),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_a_hostile_file_gets_a_clear_message(case: str, visitor: Visitor) -> None:
    name, data, message = HOSTILE[case]
    with pytest.raises((InputError, PoolError)) as error:
        visitor.upload(name, data() if callable(data) else data)
    told = str(error.value)
    assert message in told
    assert "\n" not in told
    assert "/tmp/shackled" not in told
    assert "fault of ours" not in told
    assert len(told) < 400
    assert visitor.upload("good.obj", TRIANGLE).facts.triangles == 1


BASES = {
    "a.obj": TRIANGLE + b"vn 0 0 1\nvt 0 0\nmtllib a.mtl\nusemtl m\n",
    "a.ply": b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    b"element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "a.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "a.stl": bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0),
    "a.glb": glb(gltf()),
    "a.gltf": text(gltf()),
    "a.json": scene_document({"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "faces": [[0, 1, 2]]}),
    "a.toml": b'size = [32, 32]\n[[objects]]\nmesh = "a.obj"\nscale = 2.5\n[camera]\nfov = 40\n',
    "a.zip": zipped({"a.obj": TRIANGLE, "b/c.mtl": b"newmtl m"}),
}


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_no_damage_is_more_than_a_message(visitor: Visitor, data: st.DataObject) -> None:
    """Files with a few bytes changed, cut or put in are read, or refused in one line."""
    name = data.draw(st.sampled_from(sorted(BASES)))
    content = bytearray(BASES[name])
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(content)))
        length = data.draw(st.integers(0, 3))
        content[at : at + length] = data.draw(
            st.binary(max_size=3) | st.sampled_from([b"9999999", b"-1", b"nan", b"["])
        )
    with suppress(InputError):
        visitor.upload(name, bytes(content))


def test_files_that_are_handed_in_together(visitor: Visitor) -> None:
    """Nobody made an archive of them: what is said is of the files."""
    read = visitor.upload(None, zipped({"chair.mtl": b"newmtl m", "my chair.obj": b"mtllib chair.mtl\n" + TRIANGLE}))
    assert read.facts.title == "my chair.obj"
    assert visitor.pool.store.get(read.source.name).name == "my chair.zip"
    scene = visitor.upload(None, zipped({"s.toml": b'[[objects]]\nmesh = "a.obj"\n', "a.obj": TRIANGLE}))
    assert scene.facts.title == "s.toml"
    assert visitor.upload("set.zip", zipped({"a.obj": TRIANGLE})).facts.title == "set.zip"
    with pytest.raises(InputError) as error:
        visitor.upload(None, zipped({"a.obj": TRIANGLE, "b.obj": TRIANGLE}))
    assert str(error.value) == "the selection has 2 files that could be shown (a.obj, b.obj); include only one"
    with pytest.raises(InputError) as error:
        visitor.upload(None, zipped({"a.obj": b"f 1 2 3", "a.mtl": b"newmtl m"}))
    assert "zip" not in str(error.value)


def test_files_of_the_server_are_out_of_reach(visitor: Visitor, tmp_path: Path) -> None:
    """A material file and a texture that are there, named by an upload, leave no trace in the picture."""
    PillowImage.new("RGB", (2, 2), (255, 0, 0)).save(tmp_path / "red.png")
    (tmp_path / "red.mtl").write_text(f"newmtl m\nKd 1 0 0\nmap_Kd {tmp_path}/red.png\n")
    obj = f"mtllib {tmp_path}/red.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n".encode()
    (tmp_path / "there.obj").write_bytes(obj)
    there = render(load(tmp_path / "there.obj")).pixels.astype(int)
    assert (there[..., 0] - there[..., 1]).max() > 100
    frame = visitor.render(State(visitor.upload("a.obj", obj).source))
    pixels = np.asarray(PillowImage.open(io.BytesIO(frame.png))).astype(int)
    assert (pixels[..., 0] - pixels[..., 1]).max() < 40
    for path in (tmp_path / "there.obj", tmp_path / "absent.obj"):
        with pytest.raises(InputError) as error:
            visitor.upload("a.json", scene_document(str(path)))
        assert "1 0 0" not in str(error.value)


def test_a_texture_that_explodes_is_left_out(visitor: Visitor) -> None:
    obj = b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n"
    files = {"a.obj": obj, "a.mtl": b"newmtl m\nmap_Kd a.png\n", "a.png": bomb()}
    upload = visitor.upload("bomb.zip", zipped(files, zipfile.ZIP_DEFLATED))
    assert upload.facts.triangles == 1


@pytest.mark.parametrize(
    ("name", "cleaned"),
    [
        ("teapot.obj", "teapot.obj"),
        ("C:\\Users\\me\\té a (1).PLY", "té a (1).PLY"),
        ("../../../etc/passwd", "passwd"),
        ("<script>alert('x')</script>.obj", "script_.obj"),
        ("a\u202ejbo.exe\n.obj", "a_jbo.exe_.obj"),
        ("a" * 500 + ".obj", "a" * 60 + ".obj"),
        ("", "file"),
        (None, "None"),
        ("\0.obj", "_.obj"),
    ],
)
def test_names_are_tidied(name: Any, cleaned: str) -> None:
    assert clean_name(name) == cleaned


def test_the_store_forgets_what_was_not_used() -> None:
    store = Store(100)
    facts: Any = None
    for number in range(4):
        store.put(str(number), Stored("a", bytes(30), facts, None, b""))
        if number:
            store.get("0")
    assert [str(number) in store for number in range(4)] == [True, False, True, True]
    assert store.size == 90
    store.put("5", Stored("a", bytes(1000), facts, None, b""))
    assert len(store) == 1
    with pytest.raises(InputError, match="is not in the memory of this server: open it again"):
        store.get("0")
