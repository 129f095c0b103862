"""No small file takes much: each is read in a process with a limit of memory and of time."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from mesh_files import GltfObject
from shackled import InputError, load
from shackled.errors import InputWarning
from shackled.scene._files import beside
from shackled.scene._texture import open_image

MEMORY, SECONDS = 1_000_000_000, 20
CODE = """
import resource, sys, warnings
warnings.simplefilter("ignore")
import shackled
for path in sys.argv[2:]:
    used = resource.getrusage(resource.RUSAGE_SELF)
    seconds = int(used.ru_utime + used.ru_stime) + int(sys.argv[1])
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, -1))
    try:
        print(sum(thing.mesh.triangles for thing in shackled.load(path).objects))
    except shackled.InputError as error:
        print(error)
# The most memory of this program: `ru_maxrss` would begin with that of the process that started it.
print(next(line.split()[1] for line in open("/proc/self/status") if line.startswith("VmHWM")))
"""
OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.01 0.01\nvt 0.99 0.01\nvt 0.01 0.99\nvt 0 0\nvt 1 0\nvt 0 1\n"
TOO_MANY = "it shows more than 524,288 triangles, the most that are read of a file of its size"


def read(*paths: Path) -> list[str]:
    """Return what becomes of each file: the number of triangles, or why it is refused. Each has the time for itself."""
    command = [sys.executable, "-c", CODE, str(SECONDS), *map(str, paths)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr
    *said, kilobytes = done.stdout.splitlines()
    assert int(kilobytes) * 1024 < MEMORY
    return said


def obj(path: Path, images: list[str], corners: str) -> Path:
    path.with_suffix(".mtl").write_text("".join(f"newmtl m{k}\nmap_Kd {each}\n" for k, each in enumerate(images)))
    faces = "".join(f"usemtl m{number}\nf {corners}\n" for number in range(len(images)))
    path.write_text(f"mtllib {path.stem}.mtl\n{OBJ}{faces}")
    return path


def test_a_large_texture(tmp_path: Path) -> None:
    """A black one, and one with a white texel, which is seen, or not; and each by many names."""
    image, files = Image.new("L", (8192, 8192)), []
    for kind in ("black", "dotted"):
        image.save(tmp_path / f"{kind}.png", compress_level=1)
        names = [f"{'./' * number}{kind}.png" for number in range(12)]
        files += [
            obj(tmp_path / f"{kind} part.obj", names[:1], "1/1 2/2 3/3"),
            obj(tmp_path / f"{kind} whole.obj", names[:1], "1/4 2/5 3/6"),
            obj(tmp_path / f"{kind} names.obj", names, "1/1 2/2 3/3"),
        ]
        image.putpixel((0, 0), 255)
    assert read(*files) == ["1", "1", "12"] * 2


def test_many_large_textures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Together they may be opened so often, and no more are opened."""
    monkeypatch.setattr("shackled.scene._files.images._KEPT", 100)
    monkeypatch.setattr("shackled.scene._files.images._MOST_OPENED", 700)
    opened: list[Path] = []

    def counted(place: Path, *more: Any) -> Image.Image:
        opened.append(place)
        return open_image(place, *more)

    monkeypatch.setattr(beside, "open_image", counted)
    for number in range(20):
        Image.effect_noise((10, 10), 64).save(tmp_path / f"{number}.png")
    few, many = (obj(tmp_path / f"{n}.obj", [f"{k}.png" for k in range(n)], "1/4 2/5 3/6") for n in (4, 20))
    assert load(few).triangles == 4
    opened.clear()
    with pytest.warns(InputWarning), pytest.raises(InputError, match="its textures have too many pixels together"):
        load(many)
    assert len(opened) == 8


def instanced(path: Path, primitives: int, count: int) -> Path:
    made = GltfObject()
    made.document["meshes"] = [{"primitives": [made.primitive] * primitives}]
    places = made.rows(np.arange(count)[:, None] * (1, 0, 0))
    made.node["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}
    return made.gltf(path)


def on_many_nodes(path: Path) -> Path:
    made = GltfObject()
    made.primitive["indices"] = made.rows([0, 1, 2] * 20_000, "u2")
    made.document |= {"nodes": [{"mesh": 0}] * 20_000, "scenes": [{"nodes": list(range(20_000))}]}
    return made.gltf(path)


def of_many_nodes(path: Path) -> Path:
    """Write a file whose nodes hang on each other in a row."""
    made = GltfObject()
    made.document["nodes"] = [{"children": [number + 1]} for number in range(100_000)] + [{"mesh": 0}]
    return made.gltf(path)


def test_a_mesh_in_many_places(tmp_path: Path) -> None:
    too_many = [instanced(tmp_path / "a.gltf", 50, 200_000), on_many_nodes(tmp_path / "b.gltf")]
    right = [instanced(tmp_path / "c.gltf", 2, 50_000), of_many_nodes(tmp_path / "d.gltf")]
    assert read(*too_many, *right) == [*(f"{path}: {TOO_MANY}" for path in too_many), "100000", "1"]
