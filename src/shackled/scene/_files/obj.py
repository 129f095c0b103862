"""Wavefront OBJ with its MTL materials.

An own reader: trimesh misreads relative vertex numbers, takes vertex 0 for vertex 1, and drops colours that not every
vertex has.
"""

from __future__ import annotations

import io
from array import array
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError, warn
from .._crease import corner_normals, filled
from .._mesh import DEFAULT_COLOR, Mesh
from .._texture import open_image
from .colors import to_bytes
from .content import read_text
from .model import FileWrap, MeshPart, Picture, finite_uvs, tinted
from .polygons import cut
from .weld import weld

ABSENT = -1


def read_obj(path: Path) -> list[MeshPart]:
    """Return the meshes of an OBJ file, all its groups and objects: one for each texture, and one for what has none.

    The colour of a corner is that of its vertex (`v x y z r g b`), else white where it has a texture (`map_Kd`), else
    the diffuse colour (`Kd`) of its material, else light grey. Its normal is that of the file (`vn`), else that of its
    smoothing group (`s`), if the file has any. Materials and textures that cannot be read are left out, of which an
    InputWarning tells.
    """
    obj = _parse(path)
    vertex, texcoord, normal = (np.array(column, dtype=np.int64) for column in (obj.vertex, obj.texcoord, obj.normal))
    positions, normals = _table(obj.positions, 3), _table(obj.normals, 3)
    triangles = cut(positions, obj.sizes, vertex)
    corners, face = triangles[:, :3], triangles[:, 3]
    faces = vertex[corners]
    material, group = (np.array(column, dtype=np.int64)[face] for column in (obj.face_materials, obj.face_groups))
    colors, uvs, pictures, picture = _surfaces(obj, vertex, texcoord, corners, material)
    found = None
    if (normal != ABSENT).any():
        given = normal[corners]
        found = filled(positions, faces, np.where((given == ABSENT)[:, :, None], 0, normals[given]))
    elif group.any():
        found = corner_normals(positions, faces, groups=group)
    parts = []
    for number in np.unique(picture).tolist():
        own = np.flatnonzero(picture == number)
        own_normals = None if found is None else found[own]
        fields, own_uvs = {}, None
        if number != ABSENT:
            fields["texture"], own_uvs = pictures[number].texture(uvs[own], len(pictures))
        parts.append(MeshPart(weld(positions, faces[own], colors[own], own_normals, own_uvs), fields))
    return parts


def write_obj(mesh: Mesh, path: str | Path) -> None:
    """Write positions, colours and, if there are any, normals."""
    lines = ["# Shackled"]
    fractions = mesh.colors / 255
    for (x, y, z), (r, g, b) in zip(mesh.positions.tolist(), fractions.tolist(), strict=True):
        lines.append(f"v {x:.9g} {y:.9g} {z:.9g} {r:.4g} {g:.4g} {b:.4g}")
    corner = "{0}"
    if mesh.normals is not None:
        corner = "{0}//{0}"
        lines += [f"vn {x:.6g} {y:.6g} {z:.6g}" for x, y, z in mesh.normals.tolist()]
    for face in (mesh.faces + 1).tolist():
        lines.append("f " + " ".join(corner.format(number) for number in face))
    Path(path).write_text("\n".join(lines) + "\n", encoding="ascii")


@dataclass(frozen=True)
class _Material:
    color: tuple[float, float, float]
    texture: Path | None = None
    wrap: FileWrap = "repeat"


class _Obj:
    """What the lines of a file say, in flat arrays, for there may be millions.

    The corners of all faces are numbered one after the other; vertex, texcoord and normal have an entry for each.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.positions = array("d")
        self.vertex_colors: dict[int, list[float]] = {}
        self.texcoords = array("d")
        self.normals = array("d")
        self.vertex = array("q")
        self.texcoord = array("q")
        self.normal = array("q")
        self.sizes = array("q")
        self.face_lines = array("q")
        self.face_materials = array("q")
        self.face_groups = array("q")
        self.material_numbers: dict[str, int] = {"": 0}
        self.materials: dict[str, _Material] = {}


def _table(values: array[float], width: int) -> NDArray[np.float64]:
    return np.array(values, dtype=np.float64).reshape(-1, width)


def _parse(path: Path) -> _Obj:
    obj = _Obj(path)
    material, group = 0, 0
    text = read_text(path).replace("\\\n", " ")
    for number, line in enumerate(io.StringIO(text), 1):
        words = line.partition("#")[0].split()
        if not words:
            continue
        keyword = words[0]
        try:
            if keyword == "v":
                values = _at_least(3, [float(word) for word in words[1:]])
                if len(values) >= 6:
                    obj.vertex_colors[len(obj.positions) // 3] = values[3:6]
                obj.positions.extend(values[:3])
            elif keyword == "vt":
                values = _at_least(1, [float(word) for word in words[1:]])
                obj.texcoords.extend([*values, 0.0][:2])
            elif keyword == "vn":
                obj.normals.extend(_at_least(3, [float(word) for word in words[1:]])[:3])
            elif keyword == "f":
                _add_face(obj, words[1:])
                obj.face_lines.append(number)
                obj.face_materials.append(material)
                obj.face_groups.append(group)
            elif keyword == "usemtl":
                material = obj.material_numbers.setdefault(" ".join(words[1:]), len(obj.material_numbers))
            elif keyword == "s":
                group = int(words[1]) if words[1:] and words[1].isdecimal() else 0
            elif keyword == "mtllib":
                obj.materials.update(_read_materials(path, line.split(None, 1)[1].strip()))
        except (ValueError, IndexError):
            raise InputError(f"line {number} is not one of an OBJ file: {line.strip()[:60]!r}") from None
    _check_numbers(obj)
    return obj


def _at_least(count: int, values: list[float]) -> list[float]:
    if len(values) < count:
        raise ValueError
    return values


def _add_face(obj: _Obj, corners: list[str]) -> None:
    if len(corners) < 3:
        raise ValueError
    vertices, texcoords, normals = len(obj.positions) // 3, len(obj.texcoords) // 2, len(obj.normals) // 3
    for corner in corners:
        vertex, _, rest = corner.partition("/")
        texcoord, _, normal = rest.partition("/")
        obj.vertex.append(_number(vertex, vertices))
        obj.texcoord.append(_number(texcoord, texcoords) if texcoord else ABSENT)
        obj.normal.append(_number(normal, normals) if normal else ABSENT)
    obj.sizes.append(len(corners))


def _number(word: str, count: int) -> int:
    """Return the number of a vertex from 0; files count from 1, or back from the latest with -1.

    A number out of range becomes `count` or more.
    """
    number = int(word)
    if number > 0:
        return number - 1
    return count + number if -count <= number < 0 else 1 << 40


def _check_numbers(obj: _Obj) -> None:
    if not obj.sizes:
        raise InputError(f"it has no faces ({len(obj.positions) // 3} vertices)")
    for what, keyword, column, count in (
        ("vertex", "v", obj.vertex, len(obj.positions) // 3),
        ("texture coordinate", "vt", obj.texcoord, len(obj.texcoords) // 2),
        ("normal", "vn", obj.normal, len(obj.normals) // 3),
    ):
        bad = np.flatnonzero(np.array(column) >= count)
        if not len(bad):
            continue
        if keyword != "v" and not count:  # some exporters number coordinates and normals that they leave out
            column[:] = array("q", [ABSENT]) * len(column)
            continue
        line = obj.face_lines[int(np.searchsorted(np.cumsum(obj.sizes), bad[0], side="right"))]
        raise InputError(
            f"the face in line {line} names a {what} that does not exist; "
            + (f"there are {keyword} lines 1 to {count}" if count else f"there are no {keyword} lines")
        )


def _surfaces(
    obj: _Obj,
    vertex: NDArray[np.int64],
    texcoord: NDArray[np.int64],
    corners: NDArray[np.int64],
    material: NDArray[np.int64],
) -> tuple[NDArray[np.float64], NDArray[np.float64], list[Picture], NDArray[np.int64]]:
    """Return a colour and texture coordinates for each corner of each triangle, (m, 3, 3) and (m, 3, 2); the images of
    textures, and the number of that of each triangle, (m,), or ABSENT.
    """
    colors = np.empty((len(corners), 3, 3))
    colors[:] = DEFAULT_COLOR
    uvs = np.zeros((len(corners), 3, 2))
    pictures: dict[tuple[Path, FileWrap], tuple[int, Picture]] = {}
    picture = np.full(len(corners), ABSENT)
    has_own = np.zeros(corners.shape, dtype=bool)
    if obj.vertex_colors:
        colored = np.zeros(len(obj.positions) // 3, dtype=bool)
        colored[list(obj.vertex_colors)] = True
        has_own = colored[vertex[corners]]
    for name, number in obj.material_numbers.items():
        if name not in obj.materials:
            continue
        found = obj.materials[name]
        faces = np.flatnonzero(material == number)
        colors[faces] = to_bytes(found.color, largest=1)
        opened = None if found.texture is None or not len(faces) else _open_texture(obj.path, found)
        if opened is not None and found.texture is not None:
            faces = faces[(texcoord[corners[faces]] != ABSENT).all(axis=1) & ~has_own[faces].any(axis=1)]
            uvs[faces] = _table(obj.texcoords, 2)[texcoord[corners[faces]]] * (1, -1) + (0, 1)
            uvs[faces] = finite_uvs(uvs[faces], opened.name)
            colors[faces] = 255
            if not opened.is_varied or opened.is_plain(uvs[faces]):
                colors[faces] = tinted(colors[faces], opened, uvs[faces])
            elif len(faces):
                picture[faces] = pictures.setdefault((found.texture, found.wrap), (len(pictures), opened))[0]
    if obj.vertex_colors:
        vertex_colors = np.zeros((len(obj.positions) // 3, 3))
        vertex_colors[list(obj.vertex_colors)] = list(obj.vertex_colors.values())
        vertex_colors = to_bytes(vertex_colors)
        colors[has_own] = vertex_colors[vertex[corners]][has_own]
    return colors, uvs, [each for _, each in pictures.values()], picture


def _read_materials(path: Path, names: str) -> dict[str, _Material]:
    """Return the materials of the files named in a `mtllib` line: one name, which may have spaces in it, or several."""
    found: dict[str, str] = {}
    missing: dict[str, InputError] = {}
    for name in (names, *names.split()):
        if name not in found and names not in found:
            try:
                found[name] = read_text(path.parent / name.replace("\\", "/"))
            except InputError as error:
                missing[name] = error
    if found:
        missing.pop(names, None)
    for reason in [missing[names]] if names in missing else missing.values():
        warn(f"{path}: its materials are left out: {reason}")
    materials: dict[str, _Material] = {}
    for text in found.values():
        materials.update(_parse_materials(path.parent, text.split("\n")))
    return materials


def _parse_materials(folder: Path, lines: Iterable[str]) -> dict[str, _Material]:
    materials: dict[str, _Material] = {}
    name = ""
    for line in lines:
        keyword, _, rest = line.partition("#")[0].strip().replace("\t", " ").partition(" ")
        rest = rest.strip()
        if keyword == "newmtl":
            name = " ".join(rest.split())
            materials[name] = _Material((1.0, 1.0, 1.0))
        elif keyword == "Kd" and name in materials:
            try:
                red, green, blue = (float(word) for word in rest.split())
            except ValueError:
                continue
            materials[name] = replace(materials[name], color=(red, green, blue))
        elif keyword.lower() == "map_kd" and rest and name in materials:
            # options stand before the name: -s 1 1 1 wood.png
            image = rest.split()[-1] if rest.startswith("-") else rest
            wrap: FileWrap = "clamp" if "-clamp on" in " ".join(rest.split()[:-1]) else "repeat"
            materials[name] = replace(materials[name], texture=folder / image.replace("\\", "/"), wrap=wrap)
    return materials


def _open_texture(path: Path, material: _Material) -> Picture | None:
    assert material.texture is not None
    try:
        image = open_image(material.texture, str(material.texture))
    except InputError as error:
        warn(f"{path}: a texture is left out: {error}")
        return None
    return Picture(image, f"{path}: {material.texture.name}", wraps=(material.wrap, material.wrap))
