"""Write the meshes of the examples as OBJ files.

python examples/meshes.py                         all of them, in the folder meshes beside this file
python examples/meshes.py --into build teapot     one of them, into another folder
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shackled import Mesh
from shackled.datasets import teapot

Points = NDArray[np.float64]


def teapot_mesh() -> Mesh:
    """Return the Utah teapot, 3.15 high, standing on y = 0: 992 triangles, which any node's read call can draw."""
    return teapot(4)


def fine_teapot() -> Mesh:
    """Return the same with 4,032 triangles."""
    return teapot(8)


def sphere(around: int = 32, down: int = 16) -> Mesh:
    """Return a sphere of radius 1 about the origin."""
    latitude = np.linspace(0, np.pi, down + 1)
    return lathe(np.sin(latitude), np.cos(latitude), around)


def goblet(around: int = 28) -> Mesh:
    """Return a goblet, 2.6 high, standing on y = 0, open at the top."""
    height = np.linspace(1, 0, 21)
    radius = 0.42 + 0.42 * np.sin(2.6 * np.pi * height**0.8 + 0.4) * (1 - 0.55 * height)
    return lathe(np.append(radius, 0), np.append(2.6 * height, 0), around)


def ring(radius: float = 1.0, thickness: float = 0.32, around: int = 40, across: int = 16) -> Mesh:
    """Return a torus that lies on y = 0, about the y axis."""
    u, v = np.meshgrid(*(np.linspace(0, 2 * np.pi, n, endpoint=False) for n in (around, across)), indexing="ij")
    reach = radius + thickness * np.cos(v)
    points = np.stack([reach * np.cos(u), thickness * (1 + np.sin(v)), -reach * np.sin(u)], axis=-1)
    return Mesh(points.reshape(-1, 3), _grid_faces(around, across, closed=True))


def ball() -> Mesh:
    """Return a geodesic sphere of radius 1, 320 triangles, for wireframes."""
    phi = (1 + 5**0.5) / 2
    corners = np.array([(0, s, t * phi) for s in (1, -1) for t in (1, -1)])
    points = [tuple(np.roll(corner, turn)) for turn in range(3) for corner in corners]
    faces = [
        (a, b, c)
        for a in range(12)
        for b in range(a + 1, 12)
        for c in range(b + 1, 12)
        if all(np.isclose(np.linalg.norm(np.subtract(points[p], points[q])), 2) for p, q in ((a, b), (b, c), (c, a)))
    ]
    triangles = np.array([[points[corner] for corner in face] for face in faces])
    for _ in range(2):
        a, b, c = triangles.transpose(1, 0, 2)
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        triangles = np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
        triangles /= np.linalg.norm(triangles, axis=2, keepdims=True)
    outward = np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) > 0
    triangles[~outward] = triangles[~outward][:, ::-1]
    return _welded(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))


def floor(side: int = 12) -> Mesh:
    """Return a chessboard of `side` by `side` squares of side 1, at y = 0, centred at the origin."""
    x, z = (c.reshape(-1) for c in np.meshgrid(np.arange(side), np.arange(side), indexing="ij"))
    places = np.stack([x, z], axis=1)[:, None] + [(0, 0), (0, 1), (1, 1), (1, 0)] - np.array(side / 2)
    positions = np.stack([places[..., 0], np.zeros(places.shape[:2]), places[..., 1]], axis=-1).reshape(-1, 3)
    colors = np.where(((x + z) % 2 == 0)[:, None], (214, 205, 190), (92, 84, 84)).repeat(4, axis=0)
    corners = np.arange(4 * side * side).reshape(-1, 4)
    return Mesh(positions, np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]), colors)


def lathe(radius: Points, height: Points, around: int) -> Mesh:
    """Return the surface of revolution of a profile, given from top to bottom, about the y axis."""
    angle = np.linspace(0, 2 * np.pi, around, endpoint=False)
    points = np.stack(
        [
            radius[:, None] * np.cos(angle),
            np.broadcast_to(height[:, None], (len(height), around)),
            -radius[:, None] * np.sin(angle),
        ],
        axis=-1,
    )
    return _welded(points.reshape(-1, 3), _grid_faces(len(radius), around, closed=False))


def _grid_faces(rows: int, columns: int, closed: bool) -> NDArray[np.int64]:
    """Return two triangles for each cell of a grid. Columns wrap around; rows, too, if `closed`."""
    row, column = np.meshgrid(np.arange(rows if closed else rows - 1), np.arange(columns), indexing="ij")
    below, right = (row + 1) % rows, (column + 1) % columns
    a, b, c, d = (r * columns + q for r, q in ((row, column), (below, column), (below, right), (row, right)))
    return np.stack([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)], axis=-2).reshape(-1, 3)


def _welded(points: Points, faces: NDArray[np.int64]) -> Mesh:
    """Merge points that are equal up to rounding, and remove faces without an area."""
    positions, number = np.unique(np.round(points, 9) + 0.0, axis=0, return_inverse=True)
    one, two, three = (faces := number.reshape(-1)[faces]).T
    return Mesh(positions, faces[(one != two) & (two != three) & (three != one)])


MESHES: dict[str, Callable[[], Mesh]] = {
    "teapot": teapot_mesh,
    "fine-teapot": fine_teapot,
    "sphere": sphere,
    "goblet": goblet,
    "ring": ring,
    "ball": ball,
    "floor": floor,
}


def write_obj(mesh: Mesh, path: Path) -> None:
    """Write positions, colours and, if there are any, normals."""
    lines = []
    for (x, y, z), (r, g, b) in zip(mesh.positions.tolist(), (mesh.colors / 255).tolist(), strict=True):
        lines.append(f"v {x:.9g} {y:.9g} {z:.9g} {r:.4g} {g:.4g} {b:.4g}")
    corner = "{0}"
    if mesh.normals is not None:
        corner = "{0}//{0}"
        lines += [f"vn {x:.6g} {y:.6g} {z:.6g}" for x, y, z in mesh.normals.tolist()]
    lines += ["f " + " ".join(corner.format(number) for number in face) for face in (mesh.faces + 1).tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def main() -> None:
    """Write the meshes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"which: {', '.join(MESHES)}; else all")
    parser.add_argument("--into", type=Path, default=Path(__file__).parent / "meshes", help="the folder")
    arguments = parser.parse_args()
    if unknown := set(arguments.names) - MESHES.keys():
        parser.error(f"there is no mesh {', '.join(sorted(unknown))}; the meshes are {', '.join(MESHES)}")
    arguments.into.mkdir(parents=True, exist_ok=True)
    for name in arguments.names or MESHES:
        mesh = MESHES[name]()
        write_obj(mesh, arguments.into / f"{name}.obj")
        print(f"{arguments.into / name}.obj: {len(mesh.faces):,} triangles")


if __name__ == "__main__":
    main()
