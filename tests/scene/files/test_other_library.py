"""OBJ, PLY, STL and OFF files of random contents, read by the package and by trimesh, which it does not use itself."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from shackled.scene import read_mesh
from shackled.scene._mesh import DEFAULT_COLOR

Array = NDArray[np.float64]
Polygons = list[list[int]]


def made(seed: int) -> tuple[Array, Polygons, NDArray[np.uint8]]:
    """Vertices, triangles and flat quads among them, and a colour for each vertex."""
    random = np.random.default_rng(seed)
    points: list[Array] = []
    polygons: Polygons = []
    for _ in range(random.integers(1, 9)):
        corner, across, up = random.normal(size=(3, 3)).round(3)
        size = int(random.integers(3, 5))
        polygons.append([len(points) + number for number in range(size)])
        points += [corner, corner + across, corner + across + up, corner + up][:size]
    for _ in range(random.integers(0, 9)):
        polygons.append(random.choice(len(points), 3, replace=False).tolist())
    order = random.permutation(len(polygons))
    colors = random.integers(0, 256, (len(points), 3), dtype=np.uint8)
    return np.array(points), [polygons[number] for number in order], colors


def obj_text(points: Array, polygons: Polygons, colors: NDArray[np.uint8]) -> bytes:
    rows = [f"v {x!r} {y!r} {z!r} {r / 255} {g / 255} {b / 255}" for (x, y, z), (r, g, b) in rows_of(points, colors)]
    return "\n".join([*rows, *("f " + " ".join(str(c + 1) for c in p) for p in polygons), ""]).encode()


def off_text(points: Array, polygons: Polygons, colors: NDArray[np.uint8]) -> bytes:
    rows = [f"{x!r} {y!r} {z!r}" for (x, y, z), _ in rows_of(points, colors)]
    head = ["OFF", f"{len(points)} {len(polygons)} 0"]
    return "\n".join([*head, *rows, *(f"{len(p)} " + " ".join(map(str, p)) for p in polygons), ""]).encode()


def ply_data(encoding: str, points: Array, polygons: Polygons, colors: NDArray[np.uint8]) -> bytes:
    header = (
        f"ply\nformat {encoding} 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n"
        "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        f"element face {len(polygons)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    if encoding == "ascii":
        rows = [f"{x!r} {y!r} {z!r} {r} {g} {b}" for (x, y, z), (r, g, b) in rows_of(points, colors)]
        lists = [" ".join(map(str, [len(p), *p])) for p in polygons]
        return (header + "\n".join([*rows, *lists, ""])).encode()
    order = "<" if "little" in encoding else ">"
    body = b"".join(np.array(p, order + "f8").tobytes() + c.tobytes() for p, c in zip(points, colors, strict=True))
    return header.encode() + body + b"".join(bytes([len(p)]) + np.array(p, order + "i4").tobytes() for p in polygons)


def rows_of(points: Array, colors: NDArray[np.uint8]) -> list[tuple[list[float], list[int]]]:
    return list(zip(points.tolist(), colors.tolist(), strict=True))


def in_order(positions: Array, colors: Array) -> Array:
    """Triangles with their colours, sorted; each begins with its smallest corner and keeps its winding."""
    rows = []
    for corners in np.concatenate([positions.astype(np.float32).astype(float), colors], axis=2):
        first = min(range(3), key=lambda number: tuple(corners[number]))
        rows.append(np.roll(corners, -first, axis=0).reshape(-1).tolist())
    return np.array(sorted(rows))


def seen_here(path: Path) -> Array:
    mesh = read_mesh(path)
    faces = mesh.faces
    return in_order(mesh.positions[faces], mesh.colors[faces].astype(float))


def seen_by_trimesh(path: Path, colored: bool) -> Array:
    mesh: Any = trimesh.load(path, force="mesh", process=False)
    colors = mesh.visual.vertex_colors[:, :3] if colored else np.full((len(mesh.vertices), 3), DEFAULT_COLOR)
    return in_order(mesh.vertices[mesh.faces], colors[mesh.faces].astype(float))


SEEDS = st.integers(0, 2**32 - 1)


@pytest.mark.parametrize("kind", ["obj", "off", "ascii", "binary_little_endian", "binary_big_endian"])
def test_both_see_the_same(kind: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp(kind)

    @settings(max_examples=25, deadline=None)
    @given(SEEDS)
    def compare(seed: int) -> None:
        points, polygons, colors = made(seed)
        if kind in ("obj", "off"):
            path = folder / f"model.{kind}"
            path.write_bytes((obj_text if kind == "obj" else off_text)(points, polygons, colors))
        else:
            path = folder / "model.ply"
            if kind != "ascii":
                # it takes binary files of triangles only
                polygons = [polygon[:3] for polygon in polygons]
            path.write_bytes(ply_data(kind, points, polygons, colors))
        np.testing.assert_array_equal(seen_here(path), seen_by_trimesh(path, kind != "off"))

    compare()


@pytest.mark.parametrize("kind", ["stl", "stl_ascii", "ply", "off", "obj"])
def test_what_the_other_writes_is_read(kind: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp(kind)

    @settings(max_examples=25, deadline=None)
    @given(SEEDS)
    def compare(seed: int) -> None:
        points, polygons, colors = made(seed)
        faces = np.array([polygon[:3] for polygon in polygons])
        colored = kind in ("ply", "obj")
        if not colored:
            colors[:] = DEFAULT_COLOR
        written = trimesh.Trimesh(points, faces, process=False, vertex_colors=colors if colored else None)
        path = folder / f"model.{kind.partition('_')[0]}"
        written.export(path, file_type=kind)
        here = seen_here(path)
        wanted = in_order(points[faces], colors[faces].astype(float))
        np.testing.assert_allclose(here, wanted, atol=1e-6)

    compare()
