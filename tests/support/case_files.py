"""Files that rows of cases.toml name by `make`: rows of FILES, and functions that write one into a folder."""

from __future__ import annotations

import gzip
import io
import struct
import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from PIL import Image

from mesh_files import GltfObject, png

#: A square that fills the picture of `test_cases.PLAIN`, in several formats, and its corners and faces.
POINTS = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
SQUARE = f"{POINTS}f 1 2 3 4\n"
OFF = "OFF\n4 1 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n"
CORNERS = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], "<f4")
FACES = ((0, 1, 2), (0, 2, 3))
PLY = CORNERS.tobytes() + struct.pack("<B4i", 4, *range(4))
RED, BLUE = (png(Image.new("RGB", (4, 4), color)) for color in ("red", "blue"))

Content = str | bytes


def data(content: Content) -> bytes:
    return content.encode() if isinstance(content, str) else content


def ply(rows: Content = PLY, vertices: int = 4, faces: int = 1, names: str = "xyz", comment: str = "") -> bytes:
    """Return a PLY file, of text if its rows are text."""
    encoding = "ascii" if isinstance(rows, str) else "binary_little_endian"
    properties = "".join(f"property float {name}\n" for name in names)
    head = f"ply\nformat {encoding} 1.0\n{comment}element vertex {vertices}\n{properties}element face {faces}\n"
    return f"{head}property list uchar int vertex_indices\nend_header\n".encode() + data(rows)


def stl(*more: bytes) -> bytes:
    """Return the square as binary STL, and more facets."""
    facets = [struct.pack("<12fH", 0, 0, 1, *CORNERS[list(face)].ravel(), 0) for face in FACES] + [*more]
    return b"made by hand".ljust(80) + struct.pack("<I", len(facets)) + b"".join(facets)


def zipped(name: str) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr(name, SQUARE)
    return stream.getvalue()


def jpeg() -> bytes:
    stream = io.BytesIO()
    Image.new("RGB", (8, 8), "red").save(stream, "JPEG")
    return stream.getvalue()


def halves(materials: str) -> dict[str, Content]:
    """Return an OBJ file whose left half has the material a, and whose right half has b."""
    points = "v -1 -1 0\nv 0 -1 0\nv 0 1 0\nv -1 1 0\nv 1 -1 0\nv 1 1 0\nvt 0 0\n"
    faces = "usemtl a\nf 1/1 2/1 3/1 4/1\nusemtl b\nf 2/1 5/1 6/1 3/1\n"
    return {"m.mtl": materials, "x.obj": f"mtllib m.mtl\n{points}{faces}"}


def of_material(material: str, corners: str = "vt 0 0\nusemtl a\nf 1/1 2/1 3/1 4/1\n") -> dict[str, Content]:
    """Return a square of a material."""
    return {"m.mtl": f"newmtl a\n{material}\n", "x.obj": f"mtllib m.mtl\n{POINTS}{corners}"}


def textured(name: str, image: str) -> dict[str, Content]:
    """Return a square whose material names an image so, and the image."""
    corners = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3 4/4\n"
    return {image: RED, **of_material(f"map_Kd {name}", corners)}


def tiles() -> dict[str, Content]:
    """Return two squares with the tiles 1001 and 1012 of a texture."""
    corners = "v -1 -1 0\nv 0 -1 0\nv 1 -1 0\nv 1 1 0\nv 0 1 0\nv -1 1 0\n"
    places = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 1 1\nvt 2 1\nvt 2 2\nvt 1 2\n"
    faces = "usemtl a\nf 1/1 2/2 5/3 6/4\nf 2/5 3/6 4/7 5/8\n"
    images = {"wood.1001.png": RED, "wood.1012.png": BLUE}
    return images | {"m.mtl": "newmtl a\nmap_Kd wood.<UDIM>.png\n", "x.obj": f"mtllib m.mtl\n{corners}{places}{faces}"}


#: The contents of files by their names, of which the last one is given.
FILES: dict[str, Mapping[str, Content]] = {
    "square_obj": {"square.obj": SQUARE},
    "hidden_materials": halves("newmtl a\nKd 1 0 0\nd 0\nnewmtl b\nKd 0 0 1\nTr 1\n"),
    "half_hidden_materials": halves("newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\nTr 1\n"),
    "hidden_map": {"a.png": png(Image.new("L", (4, 4), 0)), **of_material("Kd 1 0 0\nmap_d a.png")},
    "half_hidden_map": {
        "red.png": RED,
        "a.png": png(Image.new("L", (4, 4), 0)),
        **halves("newmtl a\nmap_Kd red.png\nnewmtl b\nmap_Kd red.png\nmap_d a.png\n"),
    },
    "zip_obj": {"model.obj": zipped("model.obj")},
    "usdz_glb": {"model.glb": zipped("scene.usdc")},
    "png_stl": {"model.stl": RED},
    "jpeg_obj": {"model.obj": jpeg()},
    "ply_stl": {"model.stl": ply()},
    "stl_obj": {"model.obj": stl()},
    "off_without_extension": {"model": OFF},
    "scene_without_extension": {"square.obj": SQUARE, "model": '# a scene\n[[objects]]\nmesh = "square.obj"\n'},
    "textured_gz": {
        "m.mtl": "newmtl a\nKd 1 0 0\n",
        "model.obj.gz": gzip.compress(f"mtllib m.mtl\nusemtl a\n{SQUARE}".encode(), mtime=0),
    },
    "stl_gz": {"model.stl.gz": gzip.compress(stl()[:120], mtime=0) + gzip.compress(stl()[120:], mtime=0)},
    "cut_gz": {"model.ply.gz": gzip.compress(ply(), mtime=0)[:60]},
    "utf16_ply": {"model.ply": ply("-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n").decode().encode("utf-16")},
    "marked_off": {"model.off": b"\xef\xbb\xbf" + OFF.encode()},
    "signalling_stl": {"model.stl": stl(b"\x01\x00\xa0\x7f" * 12 + b"\0\0")},
    "comma_materials": of_material("Kd 1,0 0,0 0,0"),
    "far_ply": {
        "model.ply": ply(
            "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n0 0 9e6\n0 .01 9e6\n.01 0 9e6\n4 0 1 2 3\n3 4 5 6\n", vertices=7, faces=2
        )
    },
    # with the escapes and the query of an address
    "escaped_obj": textured("https://a.example/my%20Wood.png?v=2", "my wood.png"),
    # by a path of another machine
    "foreign_ply": {
        "Wood.PNG": RED,
        "square.ply": ply(
            "-1 -1 0 0 0\n1 -1 0 1 0\n1 1 0 1 1\n-1 1 0 0 1\n4 0 1 2 3\n",
            names="xyzst",
            comment="comment TextureFile D:\\\\models\\\\wood.png\n",
        ),
    },
    "tiles_obj": tiles(),
}


def written(folder: Path, files: Mapping[str, Content]) -> Path:
    """Write files, and return the path of the last one."""
    for name, content in files.items():
        (folder / name).write_bytes(data(content))
    return folder / [*files][-1]


def hidden_gltf(folder: Path) -> Path:
    made = GltfObject(CORNERS)
    made.primitive["indices"] = made.rows(np.ravel(FACES), "u2")
    made.primitive["attributes"]["COLOR_0"] = made.rows([(1, 0, 0, 0)] * 4)
    made.material(alphaMode="BLEND")
    return made.write(folder)


def glb_ply(folder: Path) -> Path:
    return GltfObject(CORNERS[list(FACES[0])]).glb(folder / "model.ply")


def damaged_stl(folder: Path) -> Path:
    facets = np.random.default_rng(1).normal(size=(40, 12)).astype("<f4")
    whole = stl(*(each.tobytes() + b"\0\0" for each in facets))
    return written(folder, {"model.stl": whole.decode("utf-8", errors="replace")})


def damaged_glb(folder: Path) -> Path:
    path = GltfObject(np.random.default_rng(1).normal(size=(90, 3))).glb(folder / "model.glb")
    return written(folder, {"model.glb": path.read_bytes().decode("utf-8", errors="replace")})


def endless_gz(folder: Path) -> Path:
    return written(folder, {"model.obj.gz": gzip.compress(SQUARE.encode() + bytes(70 << 20), 1)})


def linked_obj(folder: Path) -> Path:
    """Write a square whose texture is a link to a file elsewhere."""
    inner = folder / "inner"
    inner.mkdir()
    path = written(inner, textured("wood.png", "wood.png"))
    (inner / "wood.png").rename(folder / "private.png")
    (inner / "wood.png").symlink_to(folder / "private.png")
    return path
