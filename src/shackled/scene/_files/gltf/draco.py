"""Primitives that are compressed with Draco."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....errors import InputError, not_installed
from ..table import Table
from .document import Document

_NAME = "KHR_draco_mesh_compression"


def decompress(gltf: Document, primitive: Table) -> bool:
    """Put what a primitive has in compressed form only in the places of its accessors; return whether it has."""
    attributes, extensions = primitive.table("attributes"), primitive.table("extensions")
    if _NAME not in extensions or "bufferView" in gltf.item(attributes, "POSITION", "accessors"):
        return False
    packed = extensions.table(_NAME)
    points, faces = _decode(bytes(gltf.view(gltf.item(packed, "bufferView", "bufferViews"))), primitive.where)
    names = packed.table("attributes")
    for name in names.values:
        number = names.whole(name)
        if number not in points:
            raise InputError(f"{names.place(name)} is {number}, but its data has {', '.join(map(str, points))}")
        gltf.decoded[gltf.item(attributes, name, "accessors").where] = points[number]
    if "indices" in primitive:
        gltf.decoded[gltf.item(primitive, "indices", "accessors").where] = faces
    return True


def _decode(data: bytes, where: str) -> tuple[dict[int, NDArray[Any]], NDArray[Any]]:
    """Return the attributes by their numbers, (n, width), and the corners of the faces, (m, 1)."""
    try:
        import DracoPy
    except ImportError:
        raise not_installed(f"{where} is compressed with Draco, which", "draco") from None
    try:
        mesh = DracoPy.decode(data)
        attributes = {each["unique_id"]: np.asarray(each["data"]) for each in mesh.attributes}
        faces = np.asarray(mesh.faces, dtype=np.uint32).reshape(-1, 1)
    except Exception as error:  # of classes of its own
        raise InputError(f"{where} holds no data of Draco that can be read: {error}") from None
    return {number: each.reshape(len(each), -1) for number, each in attributes.items()}, faces
