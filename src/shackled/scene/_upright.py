"""Which axis of a model points up: y, as in glTF and most programs of animation, or z, as in CAD."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ..base.checks import Floats, Ints, vector
from ..errors import InputError, warn
from ._arithmetic import from_euler, unit
from ._fields import AXES, Axis
from ._files.content import format_of
from ._files.model import MeshPart
from ._mesh import face_normals, faces_of_all

_ROTATIONS: dict[Axis, tuple[int, int, int]] = {"x": (0, 0, 90), "y": (0, 0, 0), "z": (-90, 0, 0)}

#: Files that have z up by convention, and those that have one axis or the other.
_Z_UP, _EITHER = (".stl",), (".obj", ".ply")

#: The share of the ground under a model that must be a flat base for the model to stand on it.
_BASE = 0.1
#: How flat a base is, as a share of the height, and as the cosine of the angle of its faces.
_FLAT, _LEVEL = 0.01, 0.99
#: Along z, the least height by the largest side, and the largest top by the base: reliefs and letters, which face the
#: viewer, are flatter, or have a front like their back.
_HEIGHT, _TOP = 0.5, 0.5

#: Points are at an end within this share of the height; what they span, as a share of the cross section, on which a
#: model rests, and how many times what others span; and how many times as high as wide a tall model is.
_TOUCH, _REST, _BETTER, _TALL = 0.02, 0.2, 3.0, 1.4


def upright(axis: Axis) -> Floats:
    """Return the rotation that turns an axis to +y."""
    return vector(from_euler(_ROTATIONS[axis]), size=4)


def turned_up(direction: ArrayLike) -> Floats:
    """Return the shortest rotation that turns a direction to +y. InputError for (0, 0, 0)."""
    given = vector(direction, "`up`")
    if not given.any():
        raise InputError("`up` must not be (0, 0, 0)")
    x, y, z = unit(given)
    # straight down has no shortest way
    return vector(unit(np.array([-z, 0, x, 1 + y])) if y > -1 else (1, 0, 0, 0), size=4)


def axis_of_format(path: Path) -> Axis:
    """Return the axis that points up in files of a format: z for STL files, y for others."""
    return "z" if format_of(path) in _Z_UP else "y"


def axis_of_file(path: Path, parts: Sequence[MeshPart]) -> Axis:
    """Return the axis of a mesh file that points up; an InputWarning tells if it is not y, or seems wrong."""
    axis = axis_of_format(path)
    if axis != "y":
        warn(f"{path} is read as {axis} up; `up_axis` y keeps it as it is")
    elif format_of(path) in _EITHER:
        meshes = [part.mesh for part in parts]
        positions = np.concatenate([mesh.positions for mesh in meshes])
        base = base_axis(positions, faces_of_all(meshes))
        if base == "z":
            warn(f"{path} is read as y up, but stands on a flat base along z; `up_axis` z turns it upright")
        elif base is None and _rests_along_z(positions):
            warn(f"{path} is read as y up, but may be meant to stand along z; `up_axis` z turns it upright")
    return axis


@np.errstate(all="ignore")
def _rests_along_z(positions: Floats) -> bool:
    """Return whether a model would rest on its lower end along z much better than on either end along y, or is a tall
    box along z. Reliefs and letters, which face the viewer, are flatter.
    """
    low, sizes = positions.min(axis=0), np.ptp(positions, axis=0)
    if not 0 < sizes.min() <= sizes.max() < np.inf or sizes[2] < _HEIGHT * sizes.max():
        return False

    def contact(axis: int, end: float) -> float:
        """Return the share of the cross section that the points at an end span."""
        touching = positions[np.abs(positions[:, axis] - end) <= _TOUCH * sizes[axis]]
        return float(np.delete(np.ptp(touching, axis=0) / sizes, axis).prod())

    along_z, along_y = contact(2, low[2]), max(contact(1, low[1]), contact(1, low[1] + sizes[1]))
    return along_z >= _REST and (along_z >= _BETTER * along_y or bool(sizes[2] >= _TALL * sizes[:2].max()))


def base_axis(positions: Floats, faces: Ints) -> Axis | None:
    """Return the axis along which a model stands on a flat base, if it does so along one of y and z only."""
    sizes = np.ptp(positions, axis=0)
    if not 0 < sizes.max() < np.inf:
        return None
    corners = (positions - positions.min(axis=0))[faces] / sizes.max()
    sizes /= sizes.max()
    normals = face_normals(corners)
    areas = np.linalg.norm(normals, axis=1)
    found: list[Axis] = []
    for axis in (1, 2):
        heights, height = corners[:, :, axis], sizes[axis]
        # either side may be the outer one
        is_level = (np.abs(normals[:, axis]) >= _LEVEL * areas) & (areas > 0)
        base = areas[is_level & (heights.max(axis=1) <= _FLAT * height)].sum() / 2
        top = areas[is_level & (heights.min(axis=1) >= (1 - _FLAT) * height)].sum() / 2
        if height > 0 and base > _BASE * np.delete(sizes, axis).prod():
            found.append(AXES[axis])
    # `base`, `top` and `height` are along z
    if found == ["z"] and (height < _HEIGHT or top > _TOP * base):
        return None
    return found[0] if len(found) == 1 else None
