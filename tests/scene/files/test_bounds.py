"""No small file takes much: each is read in a process with a limit of memory and of time."""

from __future__ import annotations

import resource
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mesh_files import GltfObject

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


def png(path: Path, first: int = 0, side: int = 8192) -> None:
    """Write a black picture, but for its first texel."""
    image = Image.new("L", (side, side))
    image.putpixel((0, 0), first)
    image.save(path)


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


TOO_MANY = "it shows more than 524,288 triangles, the most that are read of a file of its size"


def instanced(path: Path, primitives: int, count: int) -> Path:
    made = GltfObject()
    made.document["meshes"] = [{"primitives": [made.primitive] * primitives}]
    places = made.rows(np.arange(count)[:, None] * (1, 0, 0))
    made.node["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}
    return made.gltf(path)


def test_many_instances(tmp_path: Path) -> None:
    assert read(instanced(tmp_path / "a.gltf", 50, 200_000)).endswith(TOO_MANY)
    assert read(instanced(tmp_path / "b.gltf", 2, 50_000)) == "100000"


def test_a_mesh_on_many_nodes(tmp_path: Path) -> None:
    made = GltfObject()
    made.primitive["indices"] = made.rows([0, 1, 2] * 20_000, "u2")
    made.document |= {"nodes": [{"mesh": 0}] * 20_000, "scenes": [{"nodes": list(range(20_000))}]}
    assert read(made.write(tmp_path)).endswith(TOO_MANY)


def test_many_nodes_in_a_row(tmp_path: Path) -> None:
    made = GltfObject()
    made.document["nodes"] = [{"children": [number + 1]} for number in range(100_000)] + [{"mesh": 0}]
    assert read(made.write(tmp_path)) == "1"
