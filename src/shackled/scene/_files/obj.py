"""Wavefront OBJ with its MTL materials.

An own reader: trimesh misreads relative vertex numbers, takes vertex 0 for vertex 1, and drops colours that not every
vertex has.
"""

from __future__ import annotations

import io
import re
from array import array
from collections import Counter
from contextlib import suppress
from dataclasses import replace
from math import nan
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...base.checks import Flags, Floats, Ints
from ...base.values import plural
from ...errors import InputError, warn
from .._crease import corner_normals, filled
from .._mesh import DEFAULT_COLOR
from .._texture import to_bytes
from .beside import picture_beside
from .content import read_text, with_points
from .images import Images
from .model import REPLACED, Look, MeshPart, Picture, replaced, split, under
from .mtl import Map, ObjMaterial, material_name, read_materials
from .polygons import cut, whole

ABSENT = -1

#: Lines whose backslash at the end belongs to a comment or a name.
_OF_NAMES = re.compile(r"\s*(?:#|(?:usemtl|mtllib|g|o)\s.*\S\\\s*$)")
#: ZBrush's colours of vertices, in comments: mask, red, green and blue, two hexadecimal digits each.
_POLYPAINT = "#MRGB"
#: Statements with nothing to draw.
_SILENT = frozenset(("g", "o", "mg", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"))
#: What of the shape is left out, by its statement.
_SHAPES = {"p": "point", "l": "line", "f": "incomplete face", "curv": "curve", "surf": "curved surface"}
#: So many kinds of other statements are named.
_MOST_STATEMENTS = 8


class _Lines:
    """What the lines of a file say, in flat arrays, for there may be millions.

    corners: numbers of position, texture coordinates and normal. faces: how many corners each has, its line, and the
    numbers of its material and smoothing group. left_out: how many statements of a kind are not read. bad, bad_lines:
    the first line that is of no OBJ file, in a sentence, and how many there are.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.positions, self.texcoords, self.normals = array("d"), array("d"), array("d")
        self.vertex_colors = dict[int, list[float]]()
        self.polypaint = bytearray()
        self.corners, self.faces = array("q"), array("q")
        self.material_numbers = {"": 0}
        self.materials = dict[str, ObjMaterial]()
        self.has_library = False
        self.left_out = Counter[str]()
        self.bad, self.bad_lines = "", 0


class _Drawn(NamedTuple):
    """The faces of a file that can be drawn, (m, 4), and their corners, (n, 3), with ABSENT for what they have not."""

    positions: Floats
    texcoords: Floats
    normals: Floats
    corners: Ints
    faces: Ints


def _read_lines(path: Path) -> _Lines:
    obj = _Lines(path)
    material, group = 0, 0
    text = with_points(path, read_text(path), "v|vn|vt")
    lines = enumerate(io.StringIO(text + "\n"), 1)
    for number, line in lines:
        while "\\" in line and line.rstrip().endswith("\\") and not _OF_NAMES.match(line):
            line = line.rstrip()[:-1] + " " + next(lines, (0, ""))[1]
        words = line.partition("#")[0].split()
        if not words:
            if line.startswith(_POLYPAINT):
                with suppress(ValueError):  # else a comment after all
                    levels = bytes.fromhex(line[len(_POLYPAINT) :])
                    obj.polypaint += levels[: len(levels) // 4 * 4]
            continue
        keyword, corners = words[0], len(obj.corners)
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
                _add_corners(obj, words[1:])
                obj.faces.extend((len(words) - 1, number, material, group))
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
            obj.bad_lines += 1
            obj.bad = obj.bad or f"line {number} is not one of an OBJ file: {line.strip()[:60]!r}"
            del obj.corners[corners:]
            # what follows keeps its numbers, and faces with this are left out
            {"v": obj.positions, "vt": obj.texcoords, "vn": obj.normals}.get(keyword, array("d")).extend(
                [nan] * (2 if keyword == "vt" else 3)
            )
    return obj


def _numbers(words: list[str], least: int) -> list[float]:
    """Return the numbers behind a keyword. ValueError for other words, or too few."""
    values = [float(word) for word in words[1:]]
    if len(values) < least:
        raise ValueError
    return values


def _add_corners(obj: _Lines, corners: list[str]) -> None:
    vertices, texcoords, normals = len(obj.positions) // 3, len(obj.texcoords) // 2, len(obj.normals) // 3
    for corner in corners:
        vertex, texcoord, normal, *more = f"{corner}//".split("/")
        if any(more):
            raise ValueError
        obj.corners.append(_number(vertex, vertices))
        obj.corners.append(_number(texcoord, texcoords) if texcoord else ABSENT)
        obj.corners.append(_number(normal, normals) if normal else ABSENT)


def _number(word: str, count: int) -> int:
    """Return a number from 0, `count` or more if it is out of range; files count from 1, or from -1 backward."""
    number = int(word)
    if number > 0:
        return number - 1
    return count + number if -count <= number < 0 else 1 << 40


def _drawn_faces(obj: _Lines) -> _Drawn:
    """Return the faces with vertices that exist and are finite. InputError if there are none.

    InputWarnings tell of what is left out.
    """
    if obj.bad and not obj.faces:
        raise InputError(obj.bad)
    _tell_of_statements(obj)
    positions, texcoords, normals = (
        np.array(column, dtype=np.float64).reshape(-1, width)
        for column, width in ((obj.positions, 3), (obj.texcoords, 2), (obj.normals, 3))
    )
    corners = np.array(obj.corners, dtype=np.int64).reshape(-1, 3)
    faces = np.array(obj.faces, dtype=np.int64).reshape(-1, 4)
    owner = np.repeat(np.arange(len(faces)), faces[:, 0])
    kept = whole(obj.path, faces[:, 0], corners[:, 0], len(positions))
    corners, faces = corners[kept[owner]], faces[kept]
    owner = np.repeat(np.arange(len(faces)), faces[:, 0])
    bad = np.flatnonzero(corners[:, 0] >= len(positions))
    if len(bad):
        line = faces[owner[bad[0]], 1]
        raise InputError(f"the face in line {line} names a vertex that is not among the {len(positions)} of the file")
    for column, values, what, instead in (
        (1, texcoords, "texture coordinates (vt)", "has no texture"),
        (2, normals, "normals (vn)", "has computed ones"),
    ):
        usable = np.append(np.isfinite(values).all(axis=1), False)
        numbers = corners[:, column]
        bad = np.flatnonzero((numbers != ABSENT) & ~usable[np.minimum(numbers, len(values))])
        corners[bad, column] = ABSENT
        if len(bad) and len(values):  # some exporters number coordinates and normals that they leave out
            warn(
                f"{obj.path}: {plural(len(bad), 'corner')} with {what} that do not exist or are not finite, first in"
                f" line {faces[owner[bad[0]], 1]}; the face {instead}"
            )
    finite = np.asarray(np.isfinite(positions).all(axis=1))
    kept = np.ones(len(faces), dtype=bool)
    kept[owner[~finite[corners[:, 0]]]] = False
    if obj.bad and not kept.any():
        raise InputError(obj.bad)
    if obj.bad:
        warn(f"{obj.path}: {plural(obj.bad_lines, 'line')} left out, with what they say: {obj.bad}")
    if kept.any():  # otherwise the mesh tells what is wrong
        positions[~finite] = 0
        corners, faces = corners[kept[owner]], faces[kept]
        if lost := int((~kept).sum()):
            warn(f"{obj.path}: {plural(lost, 'face')} left out, with coordinates that are not finite numbers")
    return _Drawn(positions, texcoords, normals, corners, faces)


def _tell_of_statements(obj: _Lines) -> None:
    """Warn of statements that are left out. InputError if there are no faces."""
    shapes = [plural(obj.left_out[keyword], name) for keyword, name in _SHAPES.items() if obj.left_out[keyword]]
    if not obj.faces:
        raise InputError(
            f"it has no faces, only {', '.join(shapes) or plural(len(obj.positions) // 3, 'vertex', 'vertices')}; only"
            " faces are drawn, such as those of thin tubes in place of lines and of small balls in place of points"
        )
    common = obj.left_out.most_common(_MOST_STATEMENTS)
    others = [f"statement {keyword[:20]!r} ({count:,})" for keyword, count in common if keyword not in _SHAPES]
    for left_out in (shapes, others):
        if left_out:
            warn(f"{obj.path}: {', '.join(left_out)} left out; only faces are drawn")


#: So many images fit along a triangle in a contract, and so far away is it drawn, if they repeat.
_SPAN, _FAR = 100, 1e6
#: What stands in the name of an image for the number of its tile: 1001 is that from 0 to 1, 1002 right of it.
_UDIM = "<UDIM>"
#: So many materials that are missing are named.
_MOST_NAMED = 5


def read_obj(path: Path) -> list[MeshPart]:
    """Return the meshes of an OBJ file, all its groups and objects: one for each texture, opacity and emission.

    The colour of a corner is white where it has a texture (`map_Kd`, or else `map_Ka`), else that of its vertex
    (`v x y z r g b`, or ZBrush's `#MRGB`), else the diffuse colour (`Kd`) of its material, else light grey. Its normal
    is that of the file (`vn`), else that of its smoothing group (`s`), if the file has any. InputWarnings tell what is
    left out, such as materials and textures that cannot be read.
    """
    obj = _read_lines(path)
    drawn = _drawn_faces(obj)
    triangles = cut(drawn.positions, drawn.faces[:, 0], drawn.corners[:, 0])
    corners, faces = drawn.corners[triangles[:, :3]], drawn.faces[triangles[:, 3]]
    vertex, normal, group = corners[..., 0], corners[..., 2], faces[:, 3]
    surfaces = _Surfaces(obj, drawn, corners, faces[:, 2])
    normals = None
    if (normal != ABSENT).any():
        normals = filled(drawn.positions, vertex, np.where((normal == ABSENT)[..., None], 0, drawn.normals[normal]))
    elif group.any():
        normals = corner_normals(drawn.positions, vertex, groups=group)
    return split(drawn.positions, vertex, surfaces.colors, normals, surfaces.uvs, surfaces.look, list(surfaces.looks))


class _Surfaces:
    """Colours and texture coordinates of the corners of triangles, (m, 3, 3) and (m, 3, 2); and their looks.

    looks: with their numbers. look: that of each triangle, (m,).
    """

    def __init__(self, obj: _Lines, drawn: _Drawn, corners: Ints, material: Ints) -> None:
        """Take what the corners of triangles name, (m, 3, 3), and the numbers of the materials of triangles, (m,)."""
        self.obj = obj
        # the last row is that of ABSENT
        self.texcoords = np.append(drawn.texcoords, [[np.nan, np.nan]], axis=0)[corners[..., 1]]
        painted, colors = _vertex_colors(obj, len(drawn.positions))
        self.has_own, self.colors = painted[corners[..., 0], None], colors[corners[..., 0]]
        self.uvs = np.zeros((len(corners), 3, 2))
        self.images, self.pictures = Images(), dict[Map, Picture | None]()
        self.looks: dict[Look, int] = {Look(): 0}
        self.look = np.zeros(len(corners), dtype=np.int64)
        #: how many of a thing there are, and what of it is left out
        self.notes: Counter[tuple[str, str]] = Counter()
        self.hidden, lost = 0, []
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
        hidden = [look.opacity == 0 for look in self.looks]
        if not all(np.array(hidden)[self.look]):  # otherwise the opacity of 0 is not meant
            self.notes["material", "with an opacity of 0, of which nothing is visible"] = self.hidden
        for (thing, note), count in self.notes.items():
            if count:
                warn(f"{obj.path}: {plural(count, thing)} {note}")

    def _take(self, material: ObjMaterial, own: Ints) -> None:
        """Give triangles their material."""
        self.notes.update((f"{each[:20]} statement", "of its materials left out") for each in sorted(material.left_out))
        self.hidden += material.opacity == 0
        has_own = self.has_own[own]
        self.colors[own] = np.where(has_own, self.colors[own], to_bytes(material.color, largest=1))
        red, green, blue = to_bytes(material.emission, largest=1).astype(int).tolist()
        look = Look(None, (red, green, blue), material.opacity)
        self.look[own] = self.looks.setdefault(look, len(self.looks))
        image = material.texture
        if image is not None and _UDIM in f"{image.name}{image.alpha}":
            with np.errstate(all="ignore"):
                column, row = np.floor(np.nan_to_num(self.texcoords[own].mean(axis=1))).clip(0, 9).T.astype(int)
            tiles = 1001 + column + 10 * row
            for tile in np.unique(tiles).tolist():
                alpha = image.alpha and image.alpha.replace(_UDIM, str(tile))
                one = replace(image, name=image.name.replace(_UDIM, str(tile)), alpha=alpha)
                shift = np.array([(tile - 1001) % 10, (tile - 1001) // 10])
                self._put(material, one, own[tiles == tile], look, shift)
        elif image is not None:
            self._put(material, image, own, look)

    def _put(self, material: ObjMaterial, image: Map, own: Ints, look: Look, shift: Ints | int = 0) -> None:
        """Give triangles an image of their material. shift: of their texture coordinates."""
        has_own = self.has_own[own]
        if image not in self.pictures:
            found = picture_beside(self.obj.path, image.folders, image.name, self.images, image.wrap, image.alpha)
            self.pictures[image] = found
        picture = self.pictures[image]
        if picture is None:
            return
        with np.errstate(all="ignore"):
            uvs = ((self.texcoords[own] - shift) * material.scale + material.offset) * (1, -1) + (0, 1)
            is_near = np.abs(uvs) <= (_SPAN if picture.wraps[0] == "clamp" else _FAR)
            has_place = is_near.all(axis=(1, 2)) & (np.ptp(uvs, axis=1) <= _SPAN).all(axis=1)
        self.notes["triangle", "without usable texture coordinates drawn without texture"] += int((~has_place).sum())
        textured, uvs = own[has_place], uvs[has_place]
        self.uvs[textured] = uvs
        needs_it = True
        if material.image is not None:  # else only an alpha
            self.notes["triangle", REPLACED] += replaced(self.colors[own[has_place & has_own.any(axis=(1, 2))]])
            self.colors[textured], needs_it = under(picture, uvs, self.colors[textured])
        if needs_it:
            self.look[textured] = self.looks.setdefault(replace(look, picture=picture), len(self.looks))


def _vertex_colors(obj: _Lines, count: int) -> tuple[Flags, Floats]:
    """Return which of so many vertices have a colour, (n,), and the colours, (n, 3), 0..255; light grey for others."""
    painted, colors = np.zeros(count, dtype=bool), np.full((count, 3), DEFAULT_COLOR, dtype=np.float64)
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
