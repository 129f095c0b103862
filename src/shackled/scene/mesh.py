"""Triangles with a colour per vertex."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..checks import channels
from ..errors import InputError
from .value import Value, plural

#: What a contract takes: vertices and faces are counted in 16 bits.
MAX_VERTICES = 65535
MAX_FACES = 65535

DEFAULT_COLOR = (200, 200, 200)


@dataclass(frozen=True, eq=False)
class Mesh(Value):
    """A triangle mesh; counter-clockwise faces are seen from the front.

    positions: (n, 3) float. faces: (m, 3) int, vertex numbers. colors: (n, 3) whole numbers 0..255 or floats 0..1, kept
    as the former; None for light grey.
    normals: (n, 3) float, or None; needed for smooth shading, where the codec computes them if they are absent.

    A Mesh may be larger than a contract takes; `render` says so.
    """

    positions: ArrayLike
    faces: ArrayLike
    colors: ArrayLike | None = None
    normals: ArrayLike | None = None

    def __post_init__(self) -> None:
        positions = _table(self.positions, "the positions of a mesh")
        faces = _table(self.faces, "the faces of a mesh")
        if len(positions) == 0 or len(faces) == 0:
            raise InputError(f"a mesh needs vertices and faces; this one has {len(positions)} and {len(faces)}")
        bad = np.flatnonzero(~np.isfinite(positions).all(axis=1))
        if len(bad):
            raise InputError(
                f"vertex {bad[0]} has a coordinate that is not a finite number: {positions[bad[0]].tolist()}"
            )
        bad = np.flatnonzero(((faces % 1 != 0) | (faces < 0) | (faces >= len(positions))).any(axis=1))
        if len(bad):
            named = ", ".join(f"{number:.17g}" for number in faces[bad[0]])
            raise InputError(
                f"face {bad[0]} names the vertices [{named}], but they are numbered 0 to {len(positions) - 1}"
            )
        colors = np.full((len(positions), 3), DEFAULT_COLOR) if self.colors is None else self.colors
        colors = _table(channels(colors), "the colours of a mesh")
        if len(colors) != len(positions):
            raise InputError(f"a mesh of {len(positions)} vertices needs as many colours, not {len(colors)}")
        bad = np.flatnonzero(~((colors >= 0) & (colors <= 255) & (colors % 1 == 0)).all(axis=1))
        if len(bad):
            found = ", ".join(f"{level:g}" for level in colors[bad[0]])
            raise InputError(
                f"the colour of vertex {bad[0]} must be from 0 to 255, in whole numbers unless all colours are from 0 "
                f"to 1, not [{found}]"
            )
        object.__setattr__(self, "positions", positions)
        object.__setattr__(self, "faces", faces.astype(np.int64))
        object.__setattr__(self, "colors", colors.astype(np.uint8))
        if self.normals is not None:
            normals = _table(self.normals, "the normals of a mesh")
            if len(normals) != len(positions) or not np.isfinite(normals).all():
                raise InputError(
                    f"a mesh needs a finite normal for each of its {len(positions)} vertices, not {len(normals)}"
                )
            object.__setattr__(self, "normals", normals)

    def __repr__(self) -> str:
        """A line."""
        vertices, triangles = len(np.asarray(self.positions)), len(np.asarray(self.faces))
        return f"<Mesh {plural(vertices, 'vertex', 'vertices')}, {plural(triangles, 'triangle')}>"


def vertex_normals(positions: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """(n, 3) unit normals: the mean of the faces around each vertex, weighted by area; zero where there is none."""
    corners = positions[faces]
    face_normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(positions)
    for corner in range(3):
        np.add.at(normals, faces[:, corner], face_normals)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    units: NDArray[np.float64] = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    return units


def _table(values: ArrayLike, name: str) -> NDArray[np.float64]:
    try:
        result = np.array(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} must be rows of 3 numbers") from None
    if result.size == 0:
        return result.reshape(0, 3)
    if result.ndim != 2 or result.shape[1] != 3:
        raise InputError(f"{name} must be rows of 3 numbers, not of shape {result.shape}")
    return result
