"""Wavefront OBJ with its MTL materials.

An own reader: trimesh misreads relative vertex numbers, takes vertex 0 for vertex 1, and drops colours that not every
vertex has.
"""

from __future__ import annotations

import io
import math
import re
from array import array
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError, warn
from ...values import plural
from .._crease import corner_normals, filled
from .._mesh import DEFAULT_COLOR, Mesh
from .._texture import to_bytes
from .beside import picture_beside
from .content import read_text
from .model import REPLACED, Look, MeshPart, Picture, replaced, split, under
from .mtl import Map, ObjMaterial, material_name, read_materials
from .polygons import cut

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

ABSENT = -1

#: A comment behind numbers, of which one may be -1.#IND.
_COMMENT = re.compile(r"#(?!IND|INF|[QS]NAN)")
#: What C libraries of Windows write in place of a number, and Python does not read.
_NO_NUMBER = re.compile(r"[-+]?(?:1\.#\w+|nan\(\w*\))", re.IGNORECASE)
#: Lines whose backslash at the end belongs to a comment or a name.
_OF_NAMES = re.compile(r"\s*(?:#|(?:usemtl|mtllib|g|o)\s.*\S\\\s*$)")
#: ZBrush's colours of vertices, in comments: mask, red, green and blue, two hexadecimal digits each.
_POLYPAINT = "#MRGB"
#: Statements with nothing to draw.
_SILENT = frozenset(("g", "o", "mg", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"))
#: What of the shape is left out, by its statement.
_SHAPES = {
    "p": ("point", "points"),
    "l": ("line", "lines"),
    "f": ("face of fewer than 3 corners", "faces of fewer than 3 corners"),
    "curv": ("curve", "curves"),
    "surf": ("curved surface", "curved surfaces"),
}
#: So many kinds of other statements are named.
_MOST_STATEMENTS = 8


class ObjLines:
    """What the lines of a file say, in flat arrays, for there may be millions.

    The corners of all faces are numbered one after the other; vertex, texcoord and normal have an entry for each.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.positions = array("d")
        self.vertex_colors: dict[int, list[float]] = {}
        self.polypaint = bytearray()
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
        self.materials: dict[str, ObjMaterial] = {}
        self.has_library = False
        #: how many statements of a kind are not read
        self.left_out: Counter[str] = Counter()

    def line_of(self, corner: int) -> int:
        """Return the line of the face that a corner belongs to."""
        return self.face_lines[int(np.searchsorted(np.cumsum(self.sizes), corner, side="right"))]


@dataclass(frozen=True)
class ObjFaces:
    """The faces of a file that can be drawn. vertex, texcoord, normal: of each corner, or ABSENT."""

    positions: Floats
    texcoords: Floats
    normals: Floats
    vertex: Ints
    texcoord: Ints
    normal: Ints
    sizes: Ints
    material: Ints
    group: Ints


def read_lines(path: Path) -> ObjLines:
    """Return the lines of a file. InputError for one that is of no OBJ file."""
    obj = ObjLines(path)
    material, group = 0, 0
    lines = enumerate(io.StringIO(read_text(path) + "\n"), 1)
    for number, line in lines:
        while "\\" in line and line.rstrip().endswith("\\") and not _OF_NAMES.match(line):
            line = line.rstrip()[:-1] + " " + next(lines, (0, ""))[1]
        words = (_COMMENT.split(line)[0] if "#" in line else line).split()
        if not words:
            if line.startswith(_POLYPAINT):
                _add_polypaint(obj, line)
            continue
        keyword = words[0]
        try:
            if keyword == "v":
                values = _numbers(words, 3)
                if len(values) >= 6:
                    obj.vertex_colors[len(obj.positions) // 3] = values[3:6]
                obj.positions.extend(values[:3])
            elif keyword == "vt":
                obj.texcoords.extend([*_numbers(words, 1), 0.0][:2])
            elif keyword == "vn":
                obj.normals.extend(_numbers(words, 3)[:3])
            elif keyword == "f" and len(words) > 3:
                _add_face(obj, words[1:])
                obj.face_lines.append(number)
                obj.face_materials.append(material)
                obj.face_groups.append(group)
            elif keyword == "usemtl":
                material = obj.material_numbers.setdefault(material_name(line), len(obj.material_numbers))
            elif keyword == "s":
                group = int(words[1]) if words[1:] and words[1].isdecimal() else 0
            elif keyword == "mtllib":
                obj.has_library = True
                obj.materials.update(read_materials(path, line))
            elif keyword not in _SILENT:
                obj.left_out[keyword] += len(words) - 1 if keyword == "p" else 1
        except ValueError:
            raise InputError(f"line {number} is not one of an OBJ file: {line.strip()[:60]!r}") from None
    return obj


def _numbers(words: list[str], least: int) -> list[float]:
    """Return the numbers behind a keyword, NaN for those that are none. ValueError for other words, or too few."""
    try:
        values = [float(word) for word in words[1:]]
    except ValueError:
        values = [math.nan if _NO_NUMBER.fullmatch(word) else float(word) for word in words[1:]]
    if len(values) < least:
        raise ValueError
    return values


def _add_polypaint(obj: ObjLines, line: str) -> None:
    try:
        levels = bytes.fromhex(line[len(_POLYPAINT) :])
    except ValueError:  # a comment after all
        return
    obj.polypaint += levels[: len(levels) // 4 * 4]


def _add_face(obj: ObjLines, corners: list[str]) -> None:
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


def drawn_faces(obj: ObjLines) -> ObjFaces:
    """Return the faces with finite coordinates. InputError if there are none, or one names a vertex that is not there.

    InputWarnings tell of what is left out.
    """
    _tell_of_statements(obj)
    positions, texcoords, normals = (
        np.array(column, dtype=np.float64).reshape(-1, width)
        for column, width in ((obj.positions, 3), (obj.texcoords, 2), (obj.normals, 3))
    )
    vertex, sizes, material, group = (
        np.array(column, dtype=np.int64) for column in (obj.vertex, obj.sizes, obj.face_materials, obj.face_groups)
    )
    bad = np.flatnonzero(vertex >= len(positions))
    if len(bad):
        raise InputError(
            f"the face in line {obj.line_of(bad[0])} names a vertex that does not exist; "
            + (f"there are v lines 1 to {len(positions)}" if len(positions) else "there are no v lines")
        )
    texcoord = _present(obj, obj.texcoord, texcoords, "texture coordinates (vt)", "has no texture")
    normal = _present(obj, obj.normal, normals, "normals (vn)", "has computed ones")
    finite = np.asarray(np.isfinite(positions).all(axis=1), dtype=bool)
    owner = np.repeat(np.arange(len(sizes)), sizes)
    kept = np.ones(len(sizes), dtype=bool)
    kept[owner[np.flatnonzero(~finite[vertex])]] = False
    if kept.any():  # otherwise the mesh tells what is wrong
        positions[~finite] = 0
        corners = kept[owner]
        vertex, texcoord, normal = vertex[corners], texcoord[corners], normal[corners]
        sizes, material, group = sizes[kept], material[kept], group[kept]
        lost = len(kept) - len(sizes)
        if lost:
            warn(f"{obj.path}: {plural(lost, 'face')} left out, with coordinates that are not finite numbers")
    return ObjFaces(positions, texcoords, normals, vertex, texcoord, normal, sizes, material, group)


def _tell_of_statements(obj: ObjLines) -> None:
    """Warn of statements that are left out. InputError if there are no faces."""
    shapes = [plural(obj.left_out[keyword], *names) for keyword, names in _SHAPES.items() if obj.left_out[keyword]]
    if not obj.sizes and shapes:
        raise InputError(
            f"it has no faces, only {', '.join(shapes)}; only faces are drawn, such as those of thin tubes in place of"
            " lines and of small balls in place of points"
        )
    if not obj.sizes:
        raise InputError(f"it has no faces ({len(obj.positions) // 3} vertices)")
    others = [
        plural(count, f"statement {keyword[:20]!r}", f"statements {keyword[:20]!r}")
        for keyword, count in obj.left_out.most_common(_MOST_STATEMENTS)
        if keyword not in _SHAPES
    ]
    for left_out in (shapes, others):
        if left_out:
            warn(f"{obj.path}: {', '.join(left_out)} left out; only faces are drawn")


def _present(obj: ObjLines, column: array[int], values: Floats, what: str, instead: str) -> Ints:
    """Return the numbers of values of corners, ABSENT for a value that does not exist or is not finite."""
    numbers = np.array(column, dtype=np.int64)
    if not len(values):  # some exporters number coordinates and normals that they leave out
        return np.full_like(numbers, ABSENT)
    usable = np.append(np.isfinite(values).all(axis=1), False)
    bad = (numbers != ABSENT) & ~usable[np.minimum(numbers, len(values))]
    if bad.any():
        warn(
            f"{obj.path}: {plural(int(bad.sum()), 'corner')} with {what} that do not exist or are not finite, first in"
            f" line {obj.line_of(int(bad.argmax()))}; the face {instead}"
        )
    return np.where(bad, ABSENT, numbers)


#: So many images fit along a triangle in a contract, and so far away is it drawn, if they repeat.
_SPAN, _FAR = 100, 1e6
#: So many materials that are missing are named.
_MOST_NAMED = 5

#: What parts of a model differ in: the image of their texture, opacity and emission.
_Look = tuple[Map | None, float, tuple[int, ...]]
_PLAIN: _Look = (None, 1.0, (0, 0, 0))


def read_obj(path: Path) -> list[MeshPart]:
    """Return the meshes of an OBJ file, all its groups and objects: one for each texture, opacity and emission.

    The colour of a corner is white where it has a texture (`map_Kd`, or else `map_Ka`), else that of its vertex
    (`v x y z r g b`, or ZBrush's `#MRGB`), else the diffuse colour (`Kd`) of its material, else light grey. Its normal
    is that of the file (`vn`), else that of its smoothing group (`s`), if the file has any. InputWarnings tell what is
    left out, such as materials and textures that cannot be read.
    """
    obj = read_lines(path)
    drawn = drawn_faces(obj)
    triangles = cut(drawn.positions, drawn.sizes, drawn.vertex)
    corners, face = triangles[:, :3], triangles[:, 3]
    faces = drawn.vertex[corners]
    surfaces = _Surfaces(obj, drawn, corners, face)
    normal, group, found = drawn.normal[corners], drawn.group[face], None
    if (normal != ABSENT).any():
        found = filled(drawn.positions, faces, np.where((normal == ABSENT)[:, :, None], 0, drawn.normals[normal]))
    elif group.any():
        found = corner_normals(drawn.positions, faces, groups=group)
    looks = [
        Look(surfaces.pictures[image] if image else None, {"emission": emission} if any(emission) else {}, opacity)
        for image, opacity, emission in surfaces.looks
    ]
    return split(drawn.positions, faces, surfaces.colors, found, surfaces.uvs, surfaces.look, looks)


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


class _Surfaces:
    """Colours and texture coordinates of the corners of triangles, (m, 3, 3) and (m, 3, 2); and their looks.

    looks: with their numbers. look: that of each triangle, (m,).
    """

    def __init__(self, obj: ObjLines, drawn: ObjFaces, corners: Ints, face: Ints) -> None:
        """Take the numbers of the corners of triangles, (m, 3), and those of their faces, (m,)."""
        self.obj = obj
        # the last row is that of ABSENT
        self.texcoords = np.append(drawn.texcoords, [[np.nan, np.nan]], axis=0)
        self.texcoord, material = drawn.texcoord[corners], drawn.material[face]
        self.colors = np.full((*corners.shape, 3), DEFAULT_COLOR, dtype=np.float64)
        self.uvs = np.zeros((*corners.shape, 2))
        self.pictures: dict[Map, Picture | None] = {}
        self.looks: dict[_Look, int] = {_PLAIN: 0}
        self.look = np.zeros(len(corners), dtype=np.int64)
        #: how many of a thing there are, and what of it is left out
        self.notes: Counter[tuple[str, str]] = Counter()
        painted, own_colors = _vertex_colors(obj, len(drawn.positions))
        self.has_own, self.own_colors = painted[drawn.vertex[corners]], own_colors[drawn.vertex[corners]]
        self.colors[self.has_own] = self.own_colors[self.has_own]
        lost = []
        for name, number in obj.material_numbers.items():
            triangles = np.flatnonzero(material == number)
            if len(triangles) and name in obj.materials:
                self._take(obj.materials[name], triangles)
            elif len(triangles) and name:
                lost.append(name)
        named = ", ".join(repr(name[:40]) for name in lost[:_MOST_NAMED])
        if obj.materials:
            self.notes["material", f"that no material file has, drawn in light grey: {named}"] = len(lost)
        elif not obj.has_library:  # otherwise a warning tells that it is not read
            self.notes["material", f"left out, for no line mtllib names their file: {named}"] = len(lost)
        for (thing, note), count in self.notes.items():
            if count:
                warn(f"{obj.path}: {plural(count, thing)} {note}")

    def _take(self, material: ObjMaterial, own: Ints) -> None:
        """Give triangles their material."""
        self.notes.update((f"{each[:20]} statement", "of its materials left out") for each in sorted(material.left_out))
        self.notes["material", "with an opacity of 0, of which nothing is visible"] += material.opacity == 0
        has_own = self.has_own[own]
        self.colors[own] = np.where(has_own[:, :, None], self.own_colors[own], to_bytes(material.color, largest=1))
        emission = tuple(int(level) for level in to_bytes(material.emission, largest=1))
        self.look[own] = self._number((None, material.opacity, emission))
        picture = self._picture(material.texture)
        if picture is None:
            return
        with np.errstate(all="ignore"):
            uvs = (self.texcoords[self.texcoord[own]] * material.scale + material.offset) * (1, -1) + (0, 1)
            is_near = np.abs(uvs) <= (_SPAN if picture.wraps[0] == "clamp" else _FAR)
            has_place = is_near.all(axis=(1, 2)) & (np.ptp(uvs, axis=1) <= _SPAN).all(axis=1)
        self.notes["triangle", "without usable texture coordinates drawn without texture"] += int((~has_place).sum())
        textured, uvs = own[has_place], uvs[has_place]
        self.uvs[textured] = uvs
        needs_it = True
        if material.image is not None:  # else only an alpha
            self.notes["triangle", REPLACED] += replaced(self.colors[own[has_place & has_own.any(axis=1)]])
            self.colors[textured], needs_it = under(picture, uvs, self.colors[textured])
        if needs_it:
            self.look[textured] = self._number((material.texture, material.opacity, emission))

    def _number(self, look: _Look) -> int:
        return self.looks.setdefault(look, len(self.looks))

    def _picture(self, image: Map | None) -> Picture | None:
        """Return the picture of an image; None, with a warning, if it cannot be read."""
        if image is None:
            return None
        if image not in self.pictures:
            self.pictures[image] = picture_beside(self.obj.path, image.folders, image.name, image.wrap, image.alpha)
        return self.pictures[image]


def _vertex_colors(obj: ObjLines, count: int) -> tuple[NDArray[np.bool_], Floats]:
    """Return which of so many vertices have a colour, (n,), and the colours, (n, 3), 0..255."""
    painted, colors = np.zeros(count, dtype=bool), np.zeros((count, 3))
    levels = np.frombuffer(bytes(obj.polypaint), dtype=np.uint8).reshape(-1, 4)[:count]
    painted[: len(levels)], colors[: len(levels)] = True, levels[:, 1:]
    if obj.vertex_colors:
        numbers = np.array(list(obj.vertex_colors))
        values = np.array(list(obj.vertex_colors.values()))
        finite = np.isfinite(values).all(axis=1)
        painted[numbers[finite]] = True
        colors[numbers[finite]] = to_bytes(values[finite])
        if not finite.all():
            warn(f"{obj.path}: {plural(int((~finite).sum()), 'colour')} of vertices left out, not finite numbers")
    return painted, colors
