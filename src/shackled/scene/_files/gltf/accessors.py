"""Numbers in the buffers of a glTF document."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....errors import InputError
from ..table import Table
from .document import Document

#: How long an accessor without data may be.
MAX_ELEMENTS = 1 << 24

_COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def numbers(gltf: Document, keys: Table, key: str, *types: str) -> NDArray[Any]:
    """Return the elements of the accessor that a key names, (n, width); normalized integers as fractions."""
    accessor = gltf.item(keys, key, "accessors")
    width = _WIDTHS[accessor.choice("type", types)]
    values = _elements(gltf, accessor, width)
    if "sparse" in accessor:
        values = _changed(gltf, values, accessor.table("sparse"), _component(accessor))
    if values.dtype.kind in "iu" and accessor.flag("normalized", False):
        return np.maximum(values / np.iinfo(values.dtype).max, -1)
    return values


def _elements(gltf: Document, accessor: Table, width: int) -> NDArray[Any]:
    if accessor.where in gltf.decoded:
        values = gltf.decoded[accessor.where]
        if values.shape[1] != width:
            raise InputError(f"{accessor.where} has {width} numbers in each element, but its data {values.shape[1]}")
        return values
    count = accessor.whole("count")
    if "bufferView" in accessor:
        return _rows(gltf, accessor, _component(accessor), count, width)
    if count > MAX_ELEMENTS:
        raise InputError(f"{accessor.where} has {count:,} elements but no data")
    return np.zeros((count, width), _component(accessor))


def _changed(gltf: Document, values: NDArray[Any], sparse: Table, component: str) -> NDArray[Any]:
    """Return the elements, some of them with other values."""
    count, indices = sparse.whole("count"), sparse.table("indices")
    rows = _rows(gltf, indices, _component(indices), count, 1)[:, 0]
    if count and not 0 <= rows.min() <= rows.max() < len(values):
        raise InputError(f"{sparse.where} changes element {rows.max()}, but there are {len(values)}")
    values = values.copy()
    values[rows.astype(np.int64)] = _rows(gltf, sparse.table("values"), component, count, values.shape[1])
    return values


def _component(keys: Table) -> str:
    kind = keys.whole("componentType")
    if kind not in _COMPONENTS:
        known = ", ".join(map(str, _COMPONENTS))
        raise InputError(f"{keys.place('componentType')} must be one of {known}, not {kind}")
    return _COMPONENTS[kind]


def _rows(gltf: Document, keys: Table, component: str, count: int, width: int) -> NDArray[Any]:
    view = gltf.item(keys, "bufferView", "bufferViews")
    data = gltf.view(view)
    size = np.dtype(component).itemsize
    start, stride = keys.whole("byteOffset", 0), view.whole("byteStride", 0) or size * width
    if stride < size * width:
        raise InputError(f"{view.place('byteStride')} is {stride}, less than an element of {size * width} bytes")
    needed = start + stride * (count - 1) + size * width if count else 0
    if needed > len(data):
        raise InputError(f"{keys.where} needs {needed:,} bytes of {view.where}, which has {len(data):,}")
    return np.ndarray((count, width), component, data, start, (stride, size))
