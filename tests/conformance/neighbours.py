"""A pixel and the eight around it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def interior(triangle: NDArray[np.int64]) -> NDArray[np.bool_]:
    """(H, W): pixels that show a triangle, as do their neighbours on the canvas, and the same one."""
    return uniform(triangle) & (triangle >= 0)


def uniform(values: NDArray[np.int64]) -> NDArray[np.bool_]:
    """(H, W): whether the eight neighbours on the canvas have the same value."""
    return np.asarray((around(values) == values).all(axis=0))


def around(values: NDArray[Any]) -> NDArray[Any]:
    """(9, H, W, ...): the values of each pixel and its neighbours."""
    height, width = values.shape[:2]
    padded = np.pad(values, [(1, 1), (1, 1)] + [(0, 0)] * (values.ndim - 2), mode="edge")
    return np.stack([padded[down : down + height, right : right + width] for down in range(3) for right in range(3)])
