"""Files that the table of cases names by how they are made: each function writes one into a folder and returns it."""

from __future__ import annotations

import gzip
import io
import struct
import zipfile
from pathlib import Path

import numpy as np
from PIL import Image

from mesh_files import GltfObject

#: A square that fills the picture of `test_cases.PLAIN`, as OBJ, and its corners and faces.
SQUARE = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"
CORNERS = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], "<f4")
FACES = ((0, 1, 2), (0, 2, 3))
PLY = "ply\nformat {} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n{}end_header\n"
FACE_OF_PLY = "element face 1\nproperty list uchar int vertex_indices\n"


def written(folder: Path, name: str, content: str | bytes) -> Path:
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def stl(*more: bytes) -> bytes:
    """The square as binary STL, and more facets."""
    facets = [struct.pack("<12fH", 0, 0, 1, *CORNERS[list(face)].ravel(), 0) for face in FACES] + [*more]
    return b"made by hand".ljust(80) + struct.pack("<I", len(facets)) + b"".join(facets)


def ply() -> bytes:
    return (
        PLY.format("binary_little_endian", FACE_OF_PLY).encode() + CORNERS.tobytes() + struct.pack("<B4i", 4, *range(4))
    )


def zipped(name: str) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr(name, SQUARE)
    return stream.getvalue()


def picture(kind: str) -> bytes:
    stream = io.BytesIO()
    Image.new("RGB", (8, 8), "red").save(stream, kind)
    return stream.getvalue()


def square_obj(folder: Path) -> Path:
    return written(folder, "square.obj", SQUARE)


# ---- what hides everything ----


def hidden_materials(folder: Path) -> Path:
    written(folder, "m.mtl", "newmtl a\nKd 1 0 0\nd 0\nnewmtl b\nKd 0 0 1\nTr 1\n")
    left, right = "v -1 -1 0\nv 0 -1 0\nv 0 1 0\nv -1 1 0\n", "v 1 -1 0\nv 1 1 0\n"
    return written(folder, "x.obj", f"mtllib m.mtl\n{left}{right}usemtl a\nf 1 2 3 4\nusemtl b\nf 2 5 6 3\n")


def half_hidden_materials(folder: Path) -> Path:
    path = hidden_materials(folder)
    written(folder, "m.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\nTr 1\n")
    return path


def hidden_gltf(folder: Path) -> Path:
    made = GltfObject(CORNERS)
    made.primitive["indices"] = made.rows(np.ravel(FACES), "u2")
    made.primitive["attributes"]["COLOR_0"] = made.rows([(1, 0, 0, 0)] * 4)
    made.material(alphaMode="BLEND")
    return made.write(folder)


def hidden_map(folder: Path) -> Path:
    Image.new("L", (4, 4), 0).save(folder / "a.png")
    written(folder, "m.mtl", "newmtl a\nKd 1 0 0\nmap_d a.png\n")
    points = SQUARE.partition("f ")[0]
    return written(folder, "x.obj", f"mtllib m.mtl\n{points}vt 0 0\nusemtl a\nf 1/1 2/1 3/1 4/1\n")


# ---- what is not what its name says ----


def zip_obj(folder: Path) -> Path:
    return written(folder, "model.obj", zipped("model.obj"))


def usdz_glb(folder: Path) -> Path:
    return written(folder, "model.glb", zipped("scene.usdc"))


def png_stl(folder: Path) -> Path:
    return written(folder, "model.stl", picture("PNG"))


def jpeg_obj(folder: Path) -> Path:
    return written(folder, "model.obj", picture("JPEG"))


def damaged_stl(folder: Path) -> Path:
    facets = np.random.default_rng(1).normal(size=(40, 12)).astype("<f4")
    whole = stl(*(each.tobytes() + b"\0\0" for each in facets))
    return written(folder, "model.stl", whole.decode("utf-8", errors="replace"))


def damaged_glb(folder: Path) -> Path:
    path = GltfObject(np.random.default_rng(1).normal(size=(90, 3))).glb(folder / "model.glb")
    return written(folder, "model.glb", path.read_bytes().decode("utf-8", errors="replace"))


def ply_stl(folder: Path) -> Path:
    return written(folder, "model.stl", ply())


def stl_obj(folder: Path) -> Path:
    return written(folder, "model.obj", stl())


def glb_ply(folder: Path) -> Path:
    return GltfObject(CORNERS[list(FACES[0])]).glb(folder / "model.ply")


def off_without_extension(folder: Path) -> Path:
    return written(folder, "model", "OFF\n4 1 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n")


def scene_without_extension(folder: Path) -> Path:
    square_obj(folder)
    return written(folder, "model", '# a scene\n[[objects]]\nmesh = "square.obj"\n')


def textured_gz(folder: Path) -> Path:
    written(folder, "m.mtl", "newmtl a\nKd 1 0 0\n")
    return written(folder, "model.obj.gz", gzip.compress(f"mtllib m.mtl\nusemtl a\n{SQUARE}".encode()))


def stl_gz(folder: Path) -> Path:
    return written(folder, "model.stl.gz", gzip.compress(stl()[:120]) + gzip.compress(stl()[120:]))


def cut_gz(folder: Path) -> Path:
    return written(folder, "model.ply.gz", gzip.compress(ply())[:60])


def endless_gz(folder: Path) -> Path:
    return written(folder, "model.obj.gz", gzip.compress(SQUARE.encode() + bytes(70 << 20), 1))


def utf16_ply(folder: Path) -> Path:
    text = PLY.format("ascii", FACE_OF_PLY) + "".join("{} {} {}\n".format(*point) for point in CORNERS) + "4 0 1 2 3\n"
    return written(folder, "model.ply", text.encode("utf-16"))


def marked_off(folder: Path) -> Path:
    path = off_without_extension(folder)
    return written(folder, "model.off", b"\xef\xbb\xbf" + path.read_bytes())


# ---- numbers, and parts far away ----


def signalling_stl(folder: Path) -> Path:
    return written(folder, "model.stl", stl(b"\x01\x00\xa0\x7f" * 12 + b"\0\0"))


def comma_materials(folder: Path) -> Path:
    written(folder, "m.mtl", "newmtl a\nKd 1,0 0,0 0,0\n")
    return written(folder, "x.obj", f"mtllib m.mtl\nusemtl a\n{SQUARE}")


def far_ply(folder: Path) -> Path:
    points = [*CORNERS.tolist(), (0, 0, 9e6), (0, 0.01, 9e6), (0.01, 0, 9e6)]
    rows = "".join("{} {} {}\n".format(*point) for point in points)
    head = PLY.format("ascii", FACE_OF_PLY.replace("face 1", "face 2")).replace("vertex 4", "vertex 7")
    return written(folder, "model.ply", f"{head}{rows}4 0 1 2 3\n3 4 5 6\n")


# ---- files beside a file ----


def _textured(folder: Path, name: str, image: str) -> Path:
    """Write a square with a texture, whose material file names it so."""
    (folder / "wood.mtl").write_text(f"newmtl wood\nmap_Kd {name}\n")
    Image.new("RGB", (4, 4), "red").save(folder / image)
    path = folder / "square.obj"
    corners = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    faces = "usemtl wood\nf 1/1 2/2 3/3 4/4\n"
    path.write_text("mtllib wood.mtl\n" + SQUARE.replace("f 1 2 3 4\n", "") + corners + faces)
    return path


def escaped_obj(folder: Path) -> Path:
    """Write a square whose texture is named with the escapes and the query of an address."""
    return _textured(folder, "https://a.example/my%20Wood.png?v=2", "my wood.png")


def foreign_ply(folder: Path) -> Path:
    """Write a square whose texture is named by a path of another machine."""
    Image.new("RGB", (4, 4), "red").save(folder / "Wood.PNG")
    head = "ply\nformat ascii 1.0\ncomment TextureFile D:\\\\models\\\\wood.png\nelement vertex 4\n"
    head += "".join(f"property float {name}\n" for name in "xyzst")
    rows = "-1 -1 0 0 0\n1 -1 0 1 0\n1 1 0 1 1\n-1 1 0 0 1\n4 0 1 2 3\n"
    path = folder / "square.ply"
    path.write_text(head + "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + rows)
    return path


def linked_obj(folder: Path) -> Path:
    """Write a square whose texture is a link to a file elsewhere."""
    inner = folder / "inner"
    inner.mkdir()
    path = _textured(inner, "wood.png", "wood.png")
    (inner / "wood.png").rename(folder / "private.png")
    (inner / "wood.png").symlink_to(folder / "private.png")
    return path


def tiles_obj(folder: Path) -> Path:
    """Write two squares with the tiles 1001 and 1012 of a texture."""
    path = _textured(folder, "wood.<UDIM>.png", "wood.1001.png")
    Image.new("RGB", (4, 4), "blue").save(folder / "wood.1012.png")
    corners = "v -1 -1 0\nv 0 -1 0\nv 1 -1 0\nv 1 1 0\nv 0 1 0\nv -1 1 0\n"
    places = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 1 1\nvt 2 1\nvt 2 2\nvt 1 2\n"
    path.write_text(f"mtllib wood.mtl\n{corners}{places}usemtl wood\nf 1/1 2/2 5/3 6/4\nf 2/5 3/6 4/7 5/8\n")
    return path
