"""No small file takes much: each is read in a process with a limit of memory and of time."""

from __future__ import annotations

import base64
import json
import resource
import struct
import subprocess
import sys
import zlib
from pathlib import Path
from typing import Any

import pytest

MEMORY, SECONDS = 1_000_000_000, 20
CODE = """
import resource, sys, warnings
warnings.simplefilter("ignore")
import shackled
try:
    print(sum(thing.mesh.triangles for thing in shackled.load(sys.argv[1]).objects))
except shackled.InputError as error:
    print(error)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.01 0.01\nvt 0.99 0.01\nvt 0.01 0.99\nvt 0 0\nvt 1 0\nvt 0 1\n"


def png(path: Path, side: int = 8192, first: int = 0) -> None:
    """Write a grey picture of one colour, but for its first texel."""
    packer = zlib.compressobj(9)
    data = packer.compress(bytes([0, first]) + bytes(side - 1))
    data += b"".join(packer.compress(bytes(1 + side)) for _ in range(side - 1)) + packer.flush()

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def read(path: Path) -> str:
    """Return what becomes of a file: the number of triangles, or why it is refused."""

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))

    command = [sys.executable, "-c", CODE, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300, preexec_fn=limit)
    assert done.returncode == 0, done.stderr
    said, kilobytes = done.stdout.splitlines()
    assert int(kilobytes) * 1024 < MEMORY
    return said


def obj(folder: Path, materials: list[str], corners: str) -> Path:
    (folder / "a.mtl").write_text("".join(f"newmtl m{k}\n{each}\n" for k, each in enumerate(materials)))
    faces = "".join(f"usemtl m{number}\nf {corners}\n" for number in range(len(materials)))
    (folder / "a.obj").write_text(f"mtllib a.mtl\n{OBJ}{faces}")
    return folder / "a.obj"


@pytest.mark.parametrize("first", [0, 255])
@pytest.mark.parametrize("corners", ["1/1 2/2 3/3", "1/4 2/5 3/6"])
def test_one_large_texture(tmp_path: Path, first: int, corners: str) -> None:
    png(tmp_path / "big.png", first=first)
    assert read(obj(tmp_path, ["map_Kd big.png"], corners)) == "1"


@pytest.mark.parametrize("first", [0, 255])
def test_a_large_texture_by_many_names(tmp_path: Path, first: int) -> None:
    png(tmp_path / "big.png", first=first)
    assert read(obj(tmp_path, [f"map_Kd {'./' * number}big.png" for number in range(12)], "1/1 2/2 3/3")) == "12"


def gltf(path: Path, data: bytes, counts: tuple[int, ...], **document: Any) -> Path:
    """Write a document whose accessors are rows of three floats one after the other, the last one 16-bit indices."""
    views, accessors, at = [], [], 0
    for count in counts:
        views.append({"buffer": 0, "byteOffset": at, "byteLength": 12 * count})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": count, "type": "VEC3"})
        at += 12 * count
    if at < len(data):
        views.append({"buffer": 0, "byteOffset": at, "byteLength": len(data) - at})
        accessor = {"bufferView": len(views) - 1, "componentType": 5123, "count": (len(data) - at) // 2}
        accessors.append(accessor | {"type": "SCALAR"})
    buffer = {"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}
    tables = {"asset": {"version": "2.0"}, "buffers": [buffer], "bufferViews": views, "accessors": accessors}
    path.write_text(json.dumps(tables | document))
    return path


TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
TOO_MANY = "it shows more than 524,288 triangles, the most that are read of a file of its size"


def instanced(path: Path, primitives: int, count: int) -> Path:
    places = b"".join(struct.pack("<3f", number, 0, 0) for number in range(count))
    node = {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}
    meshes = [{"primitives": [{"attributes": {"POSITION": 0}}] * primitives}]
    return gltf(path, TRIANGLE + places, (3, count), meshes=meshes, nodes=[node], scenes=[{"nodes": [0]}])


def test_many_instances(tmp_path: Path) -> None:
    assert read(instanced(tmp_path / "a.gltf", 50, 200_000)).endswith(TOO_MANY)
    assert read(instanced(tmp_path / "b.gltf", 2, 50_000)) == "100000"


def test_a_mesh_on_many_nodes(tmp_path: Path) -> None:
    indices = struct.pack("<60000H", *[0, 1, 2] * 20_000)
    meshes = [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}]
    places = {"nodes": [{"mesh": 0}] * 20_000, "scenes": [{"nodes": list(range(20_000))}]}
    assert read(gltf(tmp_path / "a.gltf", TRIANGLE + indices, (3,), meshes=meshes, **places)).endswith(TOO_MANY)


def test_many_nodes_in_a_row(tmp_path: Path) -> None:
    nodes = [{"children": [number + 1]} for number in range(100_000)] + [{"mesh": 0}]
    meshes = [{"primitives": [{"attributes": {"POSITION": 0}}]}]
    assert read(gltf(tmp_path / "a.gltf", TRIANGLE, (3,), meshes=meshes, nodes=nodes, scenes=[{"nodes": [0]}])) == "1"
