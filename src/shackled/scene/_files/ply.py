"""PLY, the Stanford polygon format."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError, warn
from ...values import plural
from .._mesh import DEFAULT_COLOR
from .beside import picture_beside
from .content import read_bytes
from .model import REPLACED, Look, MeshPart, Picture, finite_uvs, given_normals, replaced, split, under
from .ply_elements import Element, read_elements
from .polygons import cut

#: The names of texture coordinates, which go to the right and up.
_COORDINATES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
#: What ends a strip of triangles.
_END = -1
#: The number of a texture that there is not.
_NONE = -1

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


def read_ply(path: Path) -> list[MeshPart]:
    """Return the meshes of a PLY file: one for each texture, and one for what has none.

    A corner has the colour of its texture, else that of its face if faces have colours, else that of its vertex, else
    light grey. Where all faces have the same colour, those of vertices come first. An InputWarning tells what is left
    out.
    """
    elements, textures = read_elements(read_bytes(path))
    vertex = elements.get("vertex", Element("vertex", 0))
    face = next((elements[name] for name in ("face", "tristrips") if name in elements and elements[name].count), None)
    positions = vertex.table("x", "y", "z")
    if face is None and positions is not None:
        raise InputError(
            f"it has {plural(vertex.count, 'point')} and no faces, so there is no surface to draw; a program such as"
            " MeshLab makes one of points"
        )
    polygons = None if face is None else face.lists("vertex_indices", "vertex_index")
    if face is None or positions is None or polygons is None:
        raise InputError(
            "a mesh needs an element vertex with x, y and z, and an element face with a list vertex_indices; this file"
            f" has the elements {', '.join(elements) or 'none'}"
        )
    sizes, numbers = polygons[0], _whole(polygons[1])
    is_strips = face.name == "tristrips"
    if is_strips:
        numbers = _strips(sizes, numbers)
        sizes = np.full(len(numbers) // 3, 3)
    triangles = cut(positions, sizes, numbers)
    corners, polygon = numbers[triangles[:, :3]], triangles[:, 3]
    colors = _colors(path, vertex, Element("face", 0) if is_strips else face, corners, polygon)
    normals = given_normals(vertex.table("nx", "ny", "nz"), positions, corners, str(path))
    pictures = _pictures(path, textures)
    picture, uvs = np.full(len(corners), _NONE), np.zeros((len(corners), 3, 2))
    if pictures:
        picture, uvs = _textured(path, vertex, face, sizes, triangles, corners)
        _paint(path, pictures, picture, uvs, colors)
    _tell_what_is_left(path, elements, face)
    # the last one is that of _NONE
    looks = [*(Look(pictures.get(number)) for number in range(len(textures))), Look()]
    return split(positions, corners, colors, normals, uvs, picture, looks)


def _whole(numbers: Array) -> Ints:
    bad = np.flatnonzero(numbers % 1 != 0)
    if len(bad):
        raise InputError(f"the numbers of vertices must be whole, not {numbers[bad[0]]}")
    return numbers.astype(np.int64)


def _strips(sizes: Ints, numbers: Ints) -> Ints:
    """Return the corners of the triangles of strips, three for each, without those of no area that join strips."""
    numbers = np.insert(numbers, np.cumsum(sizes), _END)
    place = np.arange(len(numbers))
    start = np.maximum.accumulate(np.where(numbers == _END, place, -1)) + 1
    triangles = np.stack([numbers[:-2], numbers[1:-1], numbers[2:]], axis=1)
    odd = (place - start)[:-2] % 2 == 1
    triangles[odd] = triangles[odd][:, [1, 0, 2]]
    a, b, c = triangles.T
    kept: Ints = triangles[(triangles != _END).all(axis=1) & (a != b) & (b != c) & (c != a)]
    return kept.reshape(-1)


def _colors(path: Path, vertex: Element, face: Element, corners: Ints, polygon: Ints) -> Array:
    """Return the colours of corners with alpha, (m, 3, 4). polygon: (m,) the row of `face` for each triangle."""
    of_faces, of_vertices = face.colors(), vertex.colors()
    if of_faces is not None and (of_vertices is None or (of_faces != of_faces[0]).any()):
        if of_vertices is not None:
            warn(f"{path}: the colours of its vertices are left out, for its faces have colours")
        return np.repeat(of_faces[polygon][:, None], 3, axis=1)
    if of_vertices is not None:
        return of_vertices[corners]
    return np.full((*corners.shape, 4), (*DEFAULT_COLOR, 255.0))


def _pictures(path: Path, names: list[str]) -> dict[int, Picture]:
    pictures = {}
    for number, name in enumerate(names):
        if found := picture_beside(path, [path.parent], name):
            pictures[number] = found
    return pictures


def _textured(
    path: Path, vertex: Element, face: Element, sizes: Ints, triangles: Ints, corners: Ints
) -> tuple[Ints, Array]:
    """Return the number of the texture of each triangle, (m,), and the coordinates of its corners, (m, 3, 2).

    The coordinates of corners, a list texcoord of faces, come before those of vertices.
    """
    polygon = triangles[:, 3]
    numbers = face.table("texnumber")
    picture = np.zeros(len(triangles), np.int64) if numbers is None else numbers[polygon, 0].astype(np.int64)
    uvs = np.zeros((*corners.shape, 2))
    of_corners = face.lists("texcoord")
    of_vertices = next((found for names in _COORDINATES if (found := vertex.table(*names)) is not None), None)
    if of_corners is not None:
        whole = of_corners[0] == 2 * sizes
        flat = np.zeros((sizes.sum(), 2))
        flat[np.repeat(whole, sizes)] = of_corners[1][np.repeat(whole, of_corners[0])].reshape(-1, 2)
        uvs = flat[triangles[:, :3]]
        picture[~whole[polygon]] = _NONE
    elif of_vertices is not None:
        uvs = of_vertices[corners]
    else:
        warn(f"{path}: its texture is left out, for it has no texture coordinates")
        picture[:] = _NONE
    return picture, finite_uvs(uvs, str(path)) * (1, -1) + (0, 1)


def _paint(path: Path, pictures: dict[int, Picture], picture: Ints, uvs: Array, colors: Array) -> None:
    """Give the triangles with a texture its colours; those that do not need it then have none."""
    picture[~np.isin(picture, list(pictures))] = _NONE
    if count := replaced(colors[picture != _NONE]):
        warn(f"{path}: {plural(count, 'triangle')} {REPLACED}")
    for number, opened in pictures.items():
        faces = np.flatnonzero(picture == number)
        colors[faces], needs_it = under(opened, uvs[faces], colors[faces])
        if not needs_it:
            picture[faces] = _NONE


def _tell_what_is_left(path: Path, elements: dict[str, Element], face: Element) -> None:
    left = [f"{each.name} ({each.count:,})" for each in elements.values() if each.count and not each.used]
    left += [
        f"{p.name} of {each.name}"
        for each in elements.values()
        if each.used
        for p in each.properties
        if p.name not in each.used
    ]
    if left:
        warn(f"{path}: of its elements are left out: {', '.join(left)}")
