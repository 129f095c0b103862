"""Wavefront OBJ with its MTL materials.

An own reader: trimesh misreads relative vertex numbers, takes vertex 0 for vertex 1, and drops colours that not every
vertex has.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...errors import warn
from ...values import plural
from .._crease import corner_normals, filled
from .._mesh import DEFAULT_COLOR, Mesh
from .beside import picture_beside
from .colors import to_bytes
from .model import REPLACED, Look, MeshPart, Picture, replaced, split, under
from .mtl import Map, ObjMaterial
from .obj_lines import ABSENT, Floats, Ints, ObjFaces, ObjLines, drawn_faces, read_lines
from .polygons import cut

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
