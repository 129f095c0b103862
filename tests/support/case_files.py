"""Files that the table of cases names by how they are made: each function writes one into a folder and returns it."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

#: A square that fills the picture of `test_cases.PLAIN`, in OBJ.
SQUARE = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"


def square_obj(folder: Path) -> Path:
    """Write a square without a colour."""
    path = folder / "square.obj"
    path.write_text(SQUARE)
    return path


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
