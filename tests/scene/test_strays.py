"""Triangles far away from a model, which decide nothing of its picture."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from shackled import Mesh, load
from shackled.datasets.common.shapes import sphere
from shackled.errors import InputWarning


def test_ground_and_fog_are_those_of_the_model() -> None:
    model = sphere(16)
    positions = np.concatenate([model.positions, [(900, -70, 0), (900, -70, 1e-3), (900, -70 + 1e-3, 0)]])
    with_stray = Mesh(positions, [*model.faces, np.arange(3) + len(model.positions)])
    look: dict[str, Any] = {"ground": "white", "shadow": True, "fog": "white"}
    alone = load(Mesh(model.positions, model.faces), 32, **look)
    with pytest.warns(InputWarning, match="1 triangle so far away"):
        found = load(with_stray, 32, **look)
    assert alone.ground is not None
    assert found.ground == alone.ground.settled(alone.world_positions())
    assert found.fog == alone.fog
