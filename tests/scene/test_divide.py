"""Meshes of more vertices or triangles than a contract takes."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve
from numpy.typing import NDArray

from mesh_files import sheet
from shackled import Image, Material, Mesh, Object, Scene, Texture, load, render
from shackled.datasets.common import shapes
from shackled.scene import decode
from shackled.scene._codec import render_call
from shackled.scene._in_range import in_range
from shackled.scene._look import look_at

MOST = 65_535


def grid(columns: int, rows: int, shift: int = 0) -> Mesh:
    """A sheet of squares, with whole coordinates, a colour and a place on a texture for each vertex."""
    x, y, faces = sheet(columns, rows)
    colors = np.stack([x % 256, y % 256, (x + y) % 256], axis=1)
    uvs = np.stack([x / columns, y / rows], axis=1)
    return Mesh(np.stack([x, y, shift + x % 3], axis=1), faces, colors, uvs=uvs)


def corners(objects: tuple[Object, ...], name: str) -> NDArray[np.float64]:
    return np.concatenate([getattr(each.mesh, name)[each.mesh.faces] for each in objects])


@pytest.mark.parametrize("mesh", [grid(300, 110), grid(300, 250), grid(40_000, 1)], ids=["faces", "both", "long"])
def test_parts_are_the_whole(mesh: Mesh) -> None:
    thing = Object(mesh, (1, 2, 3), (0, 30, 0), 2, Material("smooth", texture=Texture(np.zeros((2, 2, 3), np.uint8))))
    (whole,), parts = look_at(Scene([thing]), {}).objects, in_range(Scene([thing])).objects
    assert len(parts) == max(-(-mesh.triangles // MOST), -(-len(mesh.positions) // MOST))
    for part in parts:
        assert part.mesh.triangles <= MOST
        assert len(np.unique(part.mesh.faces)) == len(part.mesh.positions) <= MOST
        assert evolve(part, mesh=whole.mesh, position=thing.position) == evolve(
            whole, rotation=part.rotation, scale=part.scale
        )
    assert all(np.array_equal(part.position, parts[0].position) for part in parts)
    for name in ("positions", "colors", "uvs"):
        np.testing.assert_array_equal(corners(parts, name), corners((whole,), name))
    # as they are without the cut
    normals = np.cross(*np.moveaxis(mesh.positions[mesh.faces[:, 1:]] - mesh.positions[mesh.faces[:, :1]], 1, 0))
    sums = np.zeros_like(mesh.positions)
    np.add.at(sums, mesh.faces, normals[:, None])
    expected = sums / np.linalg.norm(sums, axis=1, keepdims=True)
    np.testing.assert_allclose(corners(parts, "normals"), expected[mesh.faces], atol=1e-9)


def test_a_call_with_parts_is_read_again() -> None:
    scene = Scene([grid(300, 120), grid(3, 3, shift=9)])
    call = render_call(scene)
    again = decode(call)
    assert [each.mesh.triangles for each in again.objects] == [MOST, 72_000 - MOST, 18]
    assert render_call(again) == call


SOLID = shapes.cylinder(24)
LOOKS = {
    "default": {},
    "smooth": {"shading": "smooth", "crease": 180},
    "flat": {"shading": "flat"},
    "wires": {"wireframe": True},
    "shadows": {"shadow": True, "ground": "white"},
    "fog": {"fog": "white", "rim": "red"},
}


@pytest.mark.parametrize("look", LOOKS.values(), ids=LOOKS)
def test_the_picture_is_that_of_the_whole(look: dict[str, object], monkeypatch: pytest.MonkeyPatch) -> None:
    scene = look_at(SOLID, {"size": (64, 64)})
    scene = load(scene, **look)  # type: ignore[arg-type]
    expected = render(scene)
    monkeypatch.setattr("shackled.scene._in_range.MAX_FACES", 11)
    monkeypatch.setattr("shackled.scene._in_range.MAX_VERTICES", 14)
    assert len(in_range(scene).objects) > 5
    found: Image = render(scene)
    assert expected.covered_pixels
    difference = np.abs(found.pixels.astype(int) - expected.pixels)
    # cuts through antialiased smooth surfaces are open edges, where more samples are taken
    assert difference.max() <= (8 if scene.objects[0].material.shading == "smooth" else 0)
    assert difference.mean() < 0.1
