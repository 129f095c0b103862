"""Make the scenes with which the original contracts were measured, to the last number, from public files.

    python -m benchmarks.original.recipe FOLDER [--from FILES]

writes FOLDER/scenes/NAME.json. It downloads the models into the cache of `shackled datasets`, unless --from names a
folder that has them. The digests in scenes.json say whether a scene is the one that was measured. With
SHACKLED_SHARED=FOLDER the other measurements of benchmarks/ use the scenes.

Five of the fifteen models of the cost table cannot be made: of `armadillo`, `beast`, `benchy`, `fertility` and
`max-planck` it is not known from which file, or how, they were reduced.
"""

from __future__ import annotations

import argparse
import hashlib
import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from shackled import InputError
from shackled.base.checks import Floats, Ints
from shackled.bench.scenes import cube, equal_triangles
from shackled.datasets._drawing import cache_folder, keep
from shackled.datasets.common._fetch import checksum, download
from shackled.datasets.common._models import Model
from shackled.errors import ShackledError
from shackled.scene._arithmetic import from_euler, rotate

from .. import run_main
from .documents import Document, document, genesis_document, scene_document

DIGESTS = Path(__file__).with_name("scenes.json")
#: Half of the larger of width and height of a model, in units of its scene.
HALF = 800
PIECES = range(64)
SIDES = (8, 16, 32, 64, 128, 256, 512)
#: The original's orthographic camera was measured up to this side.
ORTHOGRAPHIC_SIDE = 128
MODEL_LIGHT = {"lightPos": [-20, 20, 30], "lightDiffPower": 500, "lightSpecPower": 1500}
MODEL_SKY = [[20, 20, 30], [60, 60, 90]]
QUAD = {
    "verts": [[-1300, -1300, 0], [1300, -1300, 0], [1300, 1300, 0], [-1300, 1300, 0]],
    "faces": [[0, 1, 2], [0, 2, 3]],
    "cols": [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]],
}

MODELS = (
    "https://raw.githubusercontent.com/alecjacobson/common-3d-test-models/8a4f8642acaf43f9cd7b67858a1502e1055ef202/data"
)
VTK = "https://raw.githubusercontent.com/pyvista/vtk-data/126ee906165a8b2f984f08259a4a2d32cf3b3409/Data"


@dataclass(frozen=True)
class Source:
    """The file of a model, and how its scenes are made of it.

    checksum: its git-blob or sha256. angles: degrees about x, then y, then z. triangles: at most so many, 0 for all.
    small: whether there is also a scene of 300. aggression: of fast-simplification. merge: whether vertices at one
    place become one first.
    """

    address: str
    checksum: str
    angles: tuple[float, float, float]
    triangles: int = 1000
    small: bool = False
    aggression: int = 5
    merge: bool = False


SOURCES = {
    "beetle": Source(f"{MODELS}/beetle.obj", "git-blob:6ed2169f73a00e1739783e8ec785ec83642d8cf9", (15, -35, 0)),
    "cow": Source(f"{MODELS}/cow.obj", "git-blob:524087bee724ba5cd0f005aeb0d718c10dd6adf4", (10, -35, 0)),
    "fandisk": Source(
        f"{MODELS}/fandisk.obj", "git-blob:787cd6c51a1166efad1f3e00510da71c163037ed", (20, -35, 0), 400, small=True
    ),
    "horse": Source(
        f"{VTK}/horse.ply", "git-blob:9aca62314cab82adc1044378fc7505756ef16cfe", (-90, 60, 0), small=True, aggression=7
    ),
    "nefertiti": Source(
        f"{MODELS}/nefertiti.obj",
        "git-blob:9e6d5d7114a6eab8594b1be03d7a192a7e44938a",
        (-90, 20, 0),
        1198,
        small=True,
        aggression=7,
    ),
    "rocker-arm": Source(f"{MODELS}/rocker-arm.obj", "git-blob:ca4cbc44856776d2beb89843ab403a3b79f21b96", (-60, 0, 20)),
    "spot": Source(f"{MODELS}/spot.obj", "git-blob:87ecce512bdd6f068d5c636268da700643e1761c", (10, 150, 0), small=True),
    "stanford-bunny": Source(
        f"{MODELS}/stanford-bunny.obj", "git-blob:980d8f4642b6ea9c238d130a595246ac2260ee56", (0, 0, 0), small=True
    ),
    "suzanne": Source(
        f"{MODELS}/suzanne.obj",
        "git-blob:5f3e0ae0bd08db59f723a1e263b82f6820c8cb50",
        (0, -25, 0),
        small=True,
        merge=True,
    ),
    "teapot": Source(
        f"{MODELS}/teapot.obj",
        "git-blob:c839837bfc09f5d5bac4aa757fcbd9f16ddd7ec1",
        (20, -30, 0),
        small=True,
        merge=True,
    ),
}
SMALL = 300


def documents(files: Path | None = None) -> Iterator[tuple[str, Document]]:
    """Yield the scenes by name. files: the folder of the models; they are downloaded without.

    InputError at the end if models are missing.
    """
    for side in SIDES:
        yield f"cube_persp_{side}", scene_document(cube(side))
        if side <= ORTHOGRAPHIC_SIDE:
            yield f"cube_orth_{side}", scene_document(cube(side, "orthographic"))
        yield f"empty_{side}", document(side, {}, verts=[[0, 0, 0]], faces=[], cols=[[0, 0, 0]])
    for side in (32, 64, 128):
        yield f"onetri_{side}", document(side, {})
    for count in range(1, 17):
        yield f"tris_{count:02}", scene_document(equal_triangles(count))
    yield "fullquad_128", document(128, {}, **QUAD)
    for number in PIECES:
        yield f"genesis_{number:03}", genesis_document(number)
    missing: list[str] = []
    for name, source in SOURCES.items():
        try:
            path = file_of(name, source, files)
        except ShackledError as error:
            missing.append(str(error).partition(" A copy")[0])
            continue
        mesh = geometry(path, source.merge)
        for kind, most in {"obj": source.triangles, **({"small": SMALL} if source.small else {})}.items():
            for cull in (True, False):
                yield (
                    f"{kind}_{name}_{'cull' if cull else 'nocull'}",
                    model_document(*reduced(*mesh, most, source.aggression), source.angles, cull),
                )
    if missing:
        raise InputError(
            f"the scenes of {len(missing)} of {len(SOURCES)} models are left out: {missing[0]}; "
            "files that you have: --from FOLDER"
        )


def file_of(name: str, source: Source, files: Path | None) -> Path:
    """Return the file of a model, whose checksum is right; InputError otherwise."""
    path = (files or cache_folder() / "originals") / source.address.rpartition("/")[2]
    if files is None and not path.is_file():
        keep(path, download(Model(name, name, "", "", False, source.address, source.checksum)))
    if not path.is_file():
        raise InputError(f"{path} does not exist; it is {source.address}")
    if (found := checksum(path.read_bytes(), source.checksum)) != source.checksum:
        raise InputError(f"{path} is not {source.address}: its checksum is {found} instead of {source.checksum}")
    return path


def geometry(path: Path, merge: bool) -> tuple[Floats, Ints]:
    """Read the vertices and triangles of a file in their own order, which decides what the simplification keeps."""
    from trimesh import Trimesh, load_mesh

    if path.suffix != ".obj":
        read = load_mesh(path, process=False)
        return np.asarray(read.vertices), np.asarray(read.faces)
    positions, faces = [], []
    for kind, *fields in (line.split() for line in path.read_text("utf-8").splitlines() if line.strip()):
        if kind == "v":
            positions.append([float(field) for field in fields[:3]])
        elif kind == "f":
            corners = [int(field.partition("/")[0]) - 1 for field in fields]
            faces.append(corners[:3])
            if len(corners) == 4:
                faces.append([*corners[2:], corners[0]])
    if merge:
        merged = Trimesh(positions, faces, process=True)
        return np.asarray(merged.vertices), np.asarray(merged.faces)
    return np.array(positions), np.array(faces)


def reduced(positions: Floats, faces: Ints, most: int, aggression: int) -> tuple[Floats, Ints]:
    """Simplify a mesh to at most so many triangles."""
    from fast_simplification import simplify

    if len(faces) <= most:
        return positions, faces
    kept, found = simplify(positions.astype(np.float32), faces.astype(np.int32), target_count=most, agg=aggression)
    return kept.astype(float), found


def model_document(positions: Floats, faces: Ints, angles: tuple[float, float, float], cull: bool) -> Document:
    """Return the scene of a mesh, turned, centred, on whole coordinates, in the colours of its normals."""
    turned = rotate(from_euler(angles), positions)
    turned = turned - (turned.min(axis=0) + turned.max(axis=0)) / 2
    whole = np.rint(turned * (HALF / np.abs(turned[:, :2]).max()))
    colors = np.rint(100 + 90 * vertex_normals(whole, faces))
    keys = {"verts": whole.astype(int).tolist(), "faces": faces.tolist(), "cols": colors.astype(int).tolist()}
    return document(128, MODEL_LIGHT, **keys, backgroundColor=MODEL_SKY, backfaceCulling=cull)


def vertex_normals(positions: Floats, faces: Ints) -> Floats:
    """Return the mean normal of the triangles around each vertex, weighted by their angles there."""
    total = np.zeros(positions.shape)
    for corner in range(3):
        here, following, previous = (positions[faces[:, (corner + step) % 3]] for step in range(3))
        sides = _units(following - here), _units(previous - here)
        angles = np.arccos(np.clip((sides[0] * sides[1]).sum(axis=1), -1, 1))
        np.add.at(total, faces[:, corner], angles[:, None] * _units(np.cross(*sides)))
    return _units(total)


def _units(vectors: Floats) -> Floats:
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0))


def digest(scene: Document) -> str:
    """Return the beginning of the SHA-256 of a scene."""
    return hashlib.sha256(json.dumps(scene, sort_keys=True).encode()).hexdigest()[:16]


def digests() -> dict[str, str]:
    """Return the digests of the scenes that were measured, by name: those of all that can be made."""
    found: dict[str, str] = json.loads(DIGESTS.read_text("utf-8"))
    return found


def main() -> int:
    """Write the scenes; return 1 if one is not that which was measured."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--from", dest="files", type=Path, help="a folder that has the files of the models")
    arguments = parser.parse_args()
    scenes = arguments.folder / "scenes"
    scenes.mkdir(parents=True, exist_ok=True)
    known, other = digests(), []
    for name, scene in documents(arguments.files):
        (scenes / f"{name}.json").write_text(json.dumps(scene) + "\n", "utf-8")
        if known[name] != digest(scene):
            other.append(name)
    print(f"{len(known)} scenes in {scenes}, {len(known) - len(other)} of them as they were measured")
    print("".join(f"{name} is another scene; fast-simplification 0.2.0 was used then\n" for name in other), end="")
    return bool(other)


if __name__ == "__main__":
    run_main(main, has_options=True)
