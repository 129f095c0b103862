"""A small glTF file with animations, in text."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mesh_files import GltfObject

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])


def write(path: Path, **more: Any) -> None:
    """Write a red square that goes from x = -6 to 6 in two seconds, and one that turns in four: Slide and Spin."""
    file, half = GltfObject(SQUARE), float(np.sqrt(0.5))
    file.primitive["indices"] = file.rows([0, 1, 2, 0, 2, 3], "u2")
    file.material(pbrMetallicRoughness={"baseColorFactor": [1, 0, 0, 1]}, doubleSided=True)
    file.animation("translation", [0, 2], [[-6, 0, 0], [6, 0, 0]], name="Slide")
    file.animation("rotation", [0, 4], [[0, 0, 0, 1], [0, 0, half, half]], name="Spin")
    file.document |= more
    file.gltf(path)
