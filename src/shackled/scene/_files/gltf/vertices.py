"""Vertices of primitives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....errors import InputError
from ..table import Table
from .accessors import numbers
from .document import Document


@dataclass(frozen=True)
class Vertices:
    """Those of the vertices of a primitive that its triangles use. count: of all vertices."""

    gltf: Document
    attributes: Table
    used: NDArray[Any]
    count: int

    def values(self, name: str, *types: str) -> NDArray[Any] | None:
        """Return an attribute of them, or None if it is absent."""
        return self.of(self.attributes, name, *types) if name in self.attributes else None

    def of(self, keys: Table, name: str, *types: str) -> NDArray[Any]:
        """Return what a table, such as a morph target, has of them."""
        values = numbers(self.gltf, keys, name, *types)
        if len(values) != self.count:
            raise InputError(f"{name} has {len(values)} values, but POSITION {self.count}")
        return np.asarray(values[self.used])
