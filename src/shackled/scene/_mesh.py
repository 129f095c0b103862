"""Triangle meshes with a colour per vertex."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from attrs import field, frozen
from numpy.typing import ArrayLike, NDArray

from ..base.checks import Floats, Ints, Number, channels, fixed, rgba
from ..base.synonyms import with_synonyms
from ..base.values import Value, checked, plural, with_names
from ..errors import InputError
from ._arithmetic import units

#: Limits of the contracts, which count vertices and faces in 16 bits.
MAX_VERTICES = 65535
MAX_FACES = 65535

DEFAULT_COLOR = (200, 200, 200)

#: How many corners are taken at once, so that not all of a large mesh are Python objects at the same time.
_AT_ONCE = 1 << 16
#: One colour, or one for each vertex.
Colors = ArrayLike | str | Sequence[str]


def _floats(values: ArrayLike, name: str, expected: str) -> Floats:
    try:
        return fixed(values, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} must be {expected}") from None


def _rows(rows: NDArray[Number], name: str, width: int = 3) -> NDArray[Number]:
    if rows.size == 0:
        return rows.reshape(0, width)
    if rows.ndim != 2 or rows.shape[1] != width:
        raise InputError(f"{name} must be rows of {width} numbers, not of shape {rows.shape}")
    return rows


def _table(values: ArrayLike, name: str = "a table", width: int = 3) -> Floats:
    return _rows(_floats(values, name, f"rows of {width} numbers"), name, width)


def _optional_table(values: ArrayLike | None, name: str = "a table", width: int = 3) -> Floats | None:
    return None if values is None else _table(values, name, width)


def _faces(values: ArrayLike) -> Ints:
    name = "the faces of a mesh"
    if not isinstance(values, np.ndarray) or values.dtype != np.int64:
        values = _floats(values, name, "rows of 3 numbers")
    if values.ndim == 2 and values.shape[1] == 4:
        values = values[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    rows = _rows(values, name)
    bad = np.flatnonzero(~((rows % 1 == 0) & (np.abs(rows) < 2**53)).all(axis=1))
    if len(bad):
        named = ", ".join(f"{number:.17g}" for number in rows[bad[0]])
        raise InputError(f"face {bad[0]} names the vertices [{named}], which must be whole numbers")
    return fixed(rows, np.int64)


def _opacities(values: ArrayLike | None) -> Floats | None:
    """Return (n,) multiples of 1/255, or None where all of them are 1."""
    if values is None:
        return None
    name, expected = "the opacities of a mesh", "numbers, one for each vertex"
    row = _floats(values, name, expected)
    if row.ndim != 1:
        raise InputError(f"{name} must be {expected}, not of shape {row.shape}")
    bad = np.flatnonzero(~((row >= 0) & (row <= 1)))
    if len(bad):
        raise InputError(f"the opacity of vertex {bad[0]} must be from 0 to 1, not {row[bad[0]]:g}")
    return _of_levels(np.rint(row * 255))


def _of_levels(levels: NDArray[Any]) -> Floats | None:
    return None if (levels == 255).all() else fixed(levels / 255, np.float64)


def _colors(values: Colors | None) -> NDArray[np.uint8]:
    """Return (n, 3) or, with alpha, (n, 4) colours; (3,) or (4,) for one of all vertices."""
    name = "the colours of a mesh"
    if values is None:
        values = DEFAULT_COLOR
    if isinstance(values, np.ndarray) and values.dtype == np.uint8 and values.ndim == 2 and values.shape[1] in (3, 4):
        return fixed(values, np.uint8)
    if isinstance(values, str):
        return fixed(rgba(values, "the colour of a mesh"), np.uint8)
    if isinstance(values, list | tuple) and any(isinstance(each, str) for each in values):
        values = [rgba(each, f"the colour of vertex {number}") for number, each in enumerate(values)]
    levels = _floats(channels(values), name, "rows of 3 numbers")
    if levels.ndim == 1 and levels.size:
        return fixed(rgba(values, "the colour of a mesh"), np.uint8)
    if levels.ndim != 2 or levels.shape[1] != 4:
        levels = _rows(levels, name)
    bad = np.flatnonzero(~((levels >= 0) & (levels <= 255) & (levels % 1 == 0)).all(axis=1))
    if len(bad):
        found = ", ".join(f"{level:g}" for level in levels[bad[0]])
        raise InputError(
            f"the colour of vertex {bad[0]} must be from 0 to 255, in whole numbers unless all colours are from 0 "
            f"to 1, not [{found}]"
        )
    return fixed(levels, np.uint8)


@with_synonyms()
@frozen(field_transformer=with_names, repr=False)
class Mesh(Value):
    """A triangle mesh; counter-clockwise faces are seen from the front.

    positions: (n, 3) float; also given as `vertices`. faces: (m, 3) int, vertex numbers; also (m, 4), each cut in two.
    colors: (n, 3), red, green and blue of each vertex, 0..255; None for light grey. Also given as floats 0..1, with an
        alpha, which becomes the opacities, as a list of "#rgb", "#rgba", "#rrggbb", "#rrggbbaa" or names, or as one
        of these for the whole mesh.
    normals: (n, 3) float, or None; computed for smooth shading if they are absent.
    uvs: (n, 2) float, or None: where each vertex is on a texture, from its upper left corner (0, 0) to its lower right
        one (1, 1), as in glTF. Corners of faces with different ones need vertices of their own.
    opacities: (n,) float, or None: what each vertex hides of what is behind it, from 0, nothing, to 1; rounded to
        multiples of 1/255, and None where all are 1. They are multiplied with the opacity of the object.

    A Mesh may exceed the limits of the contracts; `render` divides it.
    """

    positions: Floats = field(converter=_table, metadata=checked("the positions of a mesh"))
    faces: Ints = field(converter=_faces)
    colors: NDArray[np.uint8] = field(default=None, converter=_colors)
    normals: Floats | None = field(default=None, converter=_optional_table, metadata=checked("the normals of a mesh"))
    uvs: Floats | None = field(
        default=None,
        converter=_optional_table,
        metadata=checked("the texture coordinates of a mesh", 2),
    )
    opacities: Floats | None = field(default=None, converter=_opacities)

    def __attrs_post_init__(self) -> None:
        count = len(self.positions)
        if count == 0 or len(self.faces) == 0:
            raise InputError(f"a mesh needs vertices and faces; this one has {count} and {len(self.faces)}")
        bad = np.flatnonzero(~np.isfinite(self.positions).all(axis=1))
        if len(bad):
            found = self.positions[bad[0]].tolist()
            raise InputError(f"vertex {bad[0]} has a coordinate that is not a finite number: {found}")
        bad = np.flatnonzero(((self.faces < 0) | (self.faces >= count)).any(axis=1))
        if len(bad):
            named = self.faces[bad[0]].tolist()
            raise InputError(f"face {bad[0]} names the vertices {named}, but they are numbered 0 to {count - 1}")
        if self.colors.ndim == 1:
            object.__setattr__(self, "colors", fixed(np.tile(self.colors, (count, 1)), np.uint8))
        if self.colors.shape[1] == 4:
            opacities = _of_levels(self.colors[:, 3])
            if opacities is not None and self.opacities is not None:
                raise InputError("a mesh has opacities, or colours with an alpha below 255, not both")
            object.__setattr__(self, "colors", fixed(self.colors[:, :3], np.uint8))
            object.__setattr__(self, "opacities", opacities if self.opacities is None else self.opacities)
        for name, values in (("colours", self.colors), ("opacities", self.opacities)):
            if values is not None and len(values) != count:
                raise InputError(f"a mesh of {count} vertices needs as many {name}, not {len(values)}")
        for name, values in (("a finite normal", self.normals), ("finite texture coordinates", self.uvs)):
            if values is not None and (len(values) != count or not np.isfinite(values).all()):
                raise InputError(f"a mesh needs {name} for each of its {count} vertices, not {len(values)}")

    @classmethod
    def from_trimesh(cls, mesh: Any) -> Mesh:
        """Return the mesh of a trimesh.Trimesh, with the colours of its vertices, faces or texture.

        InputError if it is something else, or empty.
        """
        if not is_trimesh(mesh) or not hasattr(mesh, "faces") or not hasattr(mesh, "vertices"):
            raise InputError(f"a trimesh.Trimesh is needed, not {mesh!r:.60}")
        visual: Any = getattr(mesh, "visual", None)
        kind, channels = getattr(visual, "kind", None), 4
        if kind == "texture":
            # of a texture, or of a material, whose alpha may have no meaning
            visual, channels = visual.to_color(), 3
            kind = visual.kind
        if kind == "face":
            colors = np.asarray(visual.face_colors, dtype=np.uint8)[..., :channels]
            return weld(mesh.vertices, mesh.faces, np.repeat(colors[:, None], 3, axis=1))
        own = np.asarray(visual.vertex_colors, dtype=np.uint8)[..., :channels] if kind == "vertex" else None
        return cls(mesh.vertices, mesh.faces, own)

    @property
    def rgba(self) -> NDArray[np.uint8]:
        """The colours with the opacities as alpha, (n, 4), 0..255."""
        levels = 255.0 if self.opacities is None else np.rint(self.opacities * 255)[:, None]
        return np.hstack([self.colors, np.broadcast_to(levels, (len(self.colors), 1)).astype(np.uint8)])

    @property
    def vertices(self) -> Floats:
        """The positions."""
        return self.positions

    @property
    def triangles(self) -> int:
        """The number of faces."""
        return len(self.faces)

    def __repr__(self) -> str:
        vertices = plural(len(self.positions), "vertex", "vertices")
        return f"<Mesh {vertices}, {plural(self.triangles, 'triangle')}>"


def proper(faces: Ints) -> Ints:
    """Return the numbers of the faces, (m, 3), that have three different vertices."""
    a, b, c = faces.T
    return np.flatnonzero((a != b) & (b != c) & (c != a))


def without_slivers(faces: Ints) -> Ints:
    """Return the faces, (m, 3), that have three different vertices."""
    return faces[proper(faces)]


def faces_of_all(meshes: Iterable[Mesh]) -> Ints:
    """Return the faces of several meshes, (m, 3), whose vertices are numbered one mesh after the other."""
    begin, faces = 0, [np.empty((0, 3), np.int64)]
    for mesh in meshes:
        faces.append(mesh.faces + begin)
        begin += len(mesh.positions)
    return np.concatenate(faces)


def part_of_faces(mesh: Mesh, faces: Ints) -> Mesh:
    """Return some faces, (k, 3), of a mesh, with the vertices that they use."""
    used, corners = np.unique(faces, return_inverse=True)
    normals, uvs = (None if each is None else each[used] for each in (mesh.normals, mesh.uvs))
    return Mesh(mesh.positions[used], corners.reshape(-1, 3), mesh.rgba[used], normals, uvs)


def components(links: Ints, count: int) -> Ints:
    """Return, for each of `count` vertices, the least number among those that links connect it with, (count,).

    links: (n, k) int, the numbers of k vertices that are connected, such as the faces of a mesh.
    """
    label = np.arange(count)
    while True:
        least = label[links].min(axis=1)
        new = label.copy()
        for column in links.T:
            # also of what the vertex belongs to, or a chain would take a round for each of its links
            np.minimum.at(new, label[column], least)
            np.minimum.at(new, column, least)
        new = new[new]
        if np.array_equal(new, label):
            return label
        label = new


def face_normals(corners: Floats) -> Floats:
    """Return the normals of faces, whose length is twice their area, (m, 3). corners: (m, 3, 3)."""
    a, b, c = corners.transpose(1, 0, 2)
    return np.cross(b - a, c - a)


def vertex_normals(positions: Floats, faces: Ints) -> Floats:
    """Return unit normals, (n, 3): the mean of the faces around each vertex, weighted by area; zero where none are."""
    normals, each = np.zeros_like(positions), face_normals(positions[faces])
    for corner in range(3):
        np.add.at(normals, faces[:, corner], each)
    return units(normals)


def weld(
    positions: ArrayLike,
    faces: ArrayLike,
    colors: ArrayLike | None = None,
    normals: ArrayLike | None = None,
    uvs: ArrayLike | None = None,
) -> Mesh:
    """Return a mesh with one vertex for each distinct position, colour, normal and texture coordinate that a face uses.

    positions: (n, 3) float. faces: (m, 3) int, numbers of positions. colors: (m, 3, 3), the colour 0..255 of each
    corner of each face, or (m, 3, 4) with alpha; None for light grey. normals: (m, 3, 3) float likewise, or None. uvs:
    (m, 3, 2) float likewise. InputError as in `Mesh`.
    """
    checked = Mesh(positions, faces)
    points, corners = checked.positions, checked.faces
    parts = [
        points[corners],
        *(np.asarray(each, dtype=np.float64) for each in (colors, normals, uvs) if each is not None),
    ]
    # + 0.0: no -0.0
    rows = np.ascontiguousarray(np.concatenate(parts, axis=2).reshape(3 * len(corners), -1) + 0.0)
    keys = rows.view(np.dtype((np.void, rows.itemsize * rows.shape[1]))).ravel()
    numbers: dict[Any, int] = {}
    welded = np.empty(len(rows), dtype=np.int64)
    for start in range(0, len(rows), _AT_ONCE):
        part = [numbers.setdefault(key, len(numbers)) for key in keys[start : start + _AT_ONCE].tolist()]
        welded[start : start + _AT_ONCE] = part
    unique = rows[np.unique(welded, return_index=True)[1]]
    columns = iter(np.split(unique, np.cumsum([each.shape[2] for each in parts])[:-1], axis=1))
    places = next(columns)
    levels, *others = (None if each is None else next(columns) for each in (colors, normals, uvs))
    return Mesh(places, welded.reshape(-1, 3), None if levels is None else levels.astype(np.uint8), *others)


def is_trimesh(value: object) -> bool:
    # its arrays are its own, too
    return type(value).__module__.partition(".")[0] == "trimesh" and not isinstance(value, np.ndarray)
