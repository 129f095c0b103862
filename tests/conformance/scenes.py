"""What is drawn: random scenes, each from a seed, as a user might send them; and the built-in pieces."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from shackled import Background, Camera, Light, Material, Mesh, Object, Scene, Texture
from shackled.datasets import Piece, pieces, require
from shackled.datasets.common import shapes
from shackled.scene import FILTERS, WRAPS, Shading, rotate, vertex_normals

Array = NDArray[np.float64]
Rng = np.random.Generator

SIZES = (128, 512)
SHADINGS: tuple[Shading, ...] = ("unlit", "flat", "smooth")


def built_in() -> list[Piece]:
    """All pieces that nothing has to be fetched for."""
    return [piece for piece in pieces() if piece.ready()]


def built_in_scene(name: str, size: int) -> Scene:
    """A piece on a canvas of another size."""
    return evolve(require(name).make(), width=size, height=size)


def random_scene(seed: int) -> Scene:
    """The scene of a seed: one to three objects that are seen, from outside, from within, or from far away."""
    rng = np.random.default_rng([12, seed])
    unit = 10.0 ** rng.uniform(-3, 4) if rng.random() < 0.5 else 1.0
    objects = [_object(rng, unit) for _ in range(rng.choice([1, 2, 3], p=[0.7, 0.2, 0.1]))]
    width, height = _canvas(rng)
    seen = objects[rng.integers(len(objects))]
    lights = [_light(rng, seen) for _ in range(rng.choice(5, p=[0.08, 0.5, 0.2, 0.1, 0.12]))]
    return Scene(
        objects,
        _camera(rng, seen),
        lights,
        Background(_color(rng), _color(rng)),
        ambient_light=(255, 255, 255) if rng.random() < 0.7 else _color(rng),
        invert=bool(rng.random() < 0.1),
        width=width,
        height=height,
    )


def textured_scene(seed: int) -> Scene:
    """The scene of a seed with textures of random texels on its objects."""
    rng, scene = np.random.default_rng([13, seed]), random_scene(seed)
    return evolve(scene, objects=[_with_texture(rng, o) for o in scene.objects])


def glass_scene(seed: int) -> Scene:
    """The scene of a seed with convex objects apart from one another, the farthest first, whose vertices have opacities
    of their own; and other things, before, behind and within.
    """
    rng = np.random.default_rng([14, seed])
    places: list[tuple[Array, float]] = []
    glasses = []
    for _ in range(rng.integers(1, 5)):
        center, radius = rng.normal(size=3), rng.uniform(0.3, 1.2)
        if all(np.linalg.norm(center - other) > radius + size for other, size in places):
            places.append((center, radius))
            glasses.append(_glass(rng, center, radius))
    camera = _camera(rng, glasses[0])
    if camera.projection == "perspective":
        nearness = [radius**2 - ((center - camera.eye) ** 2).sum() for center, radius in places]
    else:
        nearness = [-float(center @ (camera.target - camera.eye)) for center, _ in places]
    things = [_object(rng, 1.0) for _ in range(rng.integers(1, 4))]
    width, height = _canvas(rng)
    return Scene(
        [*things, *(glasses[i] for i in np.argsort(nearness))],
        camera,
        [_light(rng, glasses[0]) for _ in range(rng.integers(4))],
        Background(_color(rng), _color(rng)),
        width=width,
        height=height,
    )


def _glass(rng: Rng, center: Array, radius: float) -> Object:
    """A convex object that fills a sphere."""
    made: list[Callable[[], Mesh]] = [
        shapes.sphere,
        shapes.cone,
        shapes.cylinder,
        shapes.dodecahedron,
        lambda: shapes.icosphere(int(rng.integers(0, 3))),
        lambda: _box(rng.uniform(0.3, 3, 3)),
    ]
    mesh = made[rng.integers(len(made))]()
    points = mesh.positions - (mesh.positions.min(axis=0) + mesh.positions.max(axis=0)) / 2
    size = float(np.linalg.norm(points, axis=1).max())
    opacities = rng.random(len(points)) if rng.random() < 0.5 else 0.5 + points @ rng.normal(size=3) / (2 * size)
    if rng.random() < 0.2:
        opacities = np.rint(opacities)
    return Object(
        evolve(mesh, positions=points, colors=_colors(rng, mesh), opacities=np.clip(opacities, 0, 1)),
        position=center,
        rotation=rng.normal(size=4),
        scale=radius / size,
        material=_material(rng),
        cull=bool(rng.random() < 0.6),
        opacity=float(rng.choice([1.0, rng.uniform(0.2, 1)])),
    )


def _with_texture(rng: Rng, o: Object) -> Object:
    """The object with a texture, whose coordinates go around the mesh as on a box, up to a few times."""
    height, width = rng.integers(1, 9, 2).tolist()
    pixels = rng.integers(0, 256, (height, width, 3), dtype=np.uint8)
    texture = Texture(pixels, FILTERS[rng.integers(2)], WRAPS[rng.integers(2)])
    points = o.mesh.positions - o.mesh.positions.mean(axis=0)
    uvs = points @ rng.normal(size=(3, 2)) / (np.abs(points).max() or 1.0) * rng.choice([0.5, 1, 3]) + rng.normal(
        size=2
    )
    return evolve(o, mesh=evolve(o.mesh, uvs=uvs), material=evolve(o.material, texture=texture))


def _canvas(rng: Rng) -> tuple[int, int]:
    choice = rng.random()
    if choice < 0.1:
        return int(rng.integers(40, 300)), int(rng.integers(40, 300))
    size = SIZES[int(choice > 0.8)]
    return size, size


# ---- objects ----


def _object(rng: Rng, unit: float) -> Object:
    whole = rng.random() < 0.35
    mesh = (_whole_mesh if whole else _mesh)(rng)
    positions = mesh.positions
    radius = float(np.linalg.norm(positions - positions.mean(axis=0), axis=1).max())
    # seldom a power of two, so that neither scale nor size are round in any base
    size = unit * (1.0 if rng.random() < 0.2 else rng.uniform(0.5, 2))
    mesh = evolve(mesh, colors=_colors(rng, mesh))
    mesh = evolve(mesh, normals=_normals(rng, mesh))
    return Object(
        mesh,
        position=(0, 0, 0) if rng.random() < 0.2 else unit * rng.normal(size=3),
        rotation=(0, 0, 0, 1) if rng.random() < 0.2 else rng.normal(size=4),
        scale=size / radius,
        material=_material(rng),
        cull=bool(rng.random() < 0.5),
    )


def _whole_mesh(rng: Rng) -> Mesh:
    """Of small whole numbers, as they are typed by hand."""
    scale = int(rng.choice([1, 1, 1, 2, 3, 5, 10, 50, 500]))
    choice = rng.integers(4)
    if choice == 0:
        mesh = _box(rng.integers(1, 4, 3))
    elif choice == 1:
        mesh = Mesh([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    elif choice == 2:
        mesh = Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    else:
        side = int(rng.integers(2, 7))
        mesh = _terrain(side, rng.integers(0, 3, (side + 1, side + 1)).astype(float))
    return evolve(mesh, positions=mesh.positions * scale + scale * rng.integers(-1, 2, 3))


def _mesh(rng: Rng) -> Mesh:
    made: list[Callable[[], Mesh]] = [
        shapes.sphere,
        shapes.torus,
        shapes.torus_knot,
        shapes.moebius_strip,
        shapes.superellipsoid,
        shapes.cone,
        shapes.cylinder,
        shapes.dodecahedron,
        lambda: shapes.icosphere(int(rng.integers(0, 3))),
        lambda: _terrain(side := int(rng.integers(1, 9)), rng.uniform(0, rng.uniform(0, 2), (side + 1, side + 1))),
        lambda: _box(rng.uniform(0.3, 3, 3)),
        lambda: _box(rng.uniform(0.3, 3, 3), inward=True),
        lambda: _soup(rng),
    ]
    mesh = made[rng.integers(len(made))]()
    return evolve(mesh, positions=mesh.positions * rng.uniform(0.5, 2) + rng.normal(size=3) * 0.1)


def _box(sides: NDArray[np.int64] | Array, inward: bool = False) -> Mesh:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * sides
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    # each face with corners of its own
    points = corners[quads].reshape(-1, 3)
    faces = np.arange(24).reshape(6, 4)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return Mesh(points, faces[:, ::-1] if inward else faces)


def _terrain(side: int, heights: Array) -> Mesh:
    """A field of squares about the origin, y up."""
    x, z = (grid.ravel() for grid in np.meshgrid(np.arange(side + 1.0), np.arange(side + 1.0), indexing="ij"))
    points = np.stack([x - side // 2, heights.ravel(), z - side // 2], axis=1)
    a = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    b, c, d = a + 1, a + side + 2, a + side + 1
    return Mesh(points, np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]))


def _soup(rng: Rng) -> Mesh:
    """Triangles of many sizes, anywhere."""
    count = int(rng.integers(1, 30))
    centers = rng.uniform(-1, 1, (count, 1, 3))
    corners = centers + rng.normal(size=(count, 3, 3)) * 2.0 ** -rng.uniform(0, 4, (count, 1, 1))
    return Mesh(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


def _colors(rng: Rng, mesh: Mesh) -> NDArray[np.int64]:
    count, choice = len(mesh.positions), rng.random()
    if choice < 0.25:
        return np.full((count, 3), 255)
    if choice < 0.5:
        return np.tile(_color(rng), (count, 1))
    if choice < 0.75:
        return np.asarray(rng.integers(0, 256, (count, 3)))
    if choice < 0.85:
        return np.asarray(255 * rng.integers(0, 2, (count, 3)))
    return np.asarray(np.clip(rng.integers(0, 256, 3) + rng.integers(-20, 21, (count, 3)), 0, 255))


def _normals(rng: Rng, mesh: Mesh) -> Array | None:
    positions = mesh.positions
    choice = rng.random()
    if choice < 0.5:
        return None
    normals = vertex_normals(positions, mesh.faces)
    return normals + rng.normal(size=positions.shape) * (2.0 if choice < 0.6 else 0.2)


def _material(rng: Rng) -> Material:
    shading = SHADINGS[rng.choice(3, p=[0.15, 0.5, 0.35])]
    if rng.random() < 0.25:
        return Material(shading, 0.3, 0.75, 0.3, 24)
    most = 4.0 if rng.random() < 0.25 else 1.0
    ambient, diffuse, specular = (float(rng.choice([0.0, 1.0, *rng.uniform(0, most, 4)])) for _ in range(3))
    shininess = int(rng.choice([1, 2, 3, 5, 10, 20, 33, 64, 127, 128]))
    return Material(shading, ambient, diffuse, specular, shininess)


# ---- camera and lights ----


def _camera(rng: Rng, seen: Object) -> Camera:
    """Toward a point of an object."""
    target, size = _point(rng, seen), _size(seen)
    target = target + rng.normal(size=3) * size * 0.1
    perspective = rng.random() < 0.7
    choice = rng.random()
    if choice < 0.6:
        distance = size * rng.uniform(1.2, 5)
    elif choice < 0.85:
        # close, and within
        distance = size * rng.uniform(0.1, 1.2)
    else:
        distance = size * 10.0 ** rng.uniform(0.7, 3)
    near = None
    if rng.random() < 0.5:
        near = max(distance - size * rng.uniform(0.5, 2), distance * 10.0 ** -rng.uniform(0, 4))
    if perspective:
        wide = size / distance * rng.uniform(0.5, 1.5)
        half_height = float(np.clip(wide, 2.0**-10, 2.0) if rng.random() < 0.7 or choice >= 0.85 else 1 / 2.145)
    else:
        half_height = size * rng.uniform(0.3, 1.5)
    return Camera(
        target + distance * _direction(rng),
        target,
        (0, 1, 0) if rng.random() < 0.5 else _direction(rng),
        "perspective" if perspective else "orthographic",
        half_height,
        near,
    )


def _light(rng: Rng, seen: Object) -> Light:
    color = (255, 255, 255) if rng.random() < 0.5 else _color(rng)
    if rng.random() < 0.5:
        return Light("directional", _direction(rng), color)
    # from far away to close above a surface
    distance = _size(seen) * 10.0 ** rng.uniform(-1.5, 1)
    place = _point(rng, seen) + distance * _direction(rng)
    if rng.random() < 0.75:
        return Light("point", place, color)
    outer = rng.uniform(5, 90)
    toward = _point(rng, seen) - place
    return Light("spot", place, color, toward if toward.any() else (0, 0, -1), outer * rng.random(), outer)


def _point(rng: Rng, seen: Object) -> Array:
    """A place on an object."""
    faces = seen.mesh.faces
    corners = seen.mesh.positions[faces[rng.integers(len(faces))]]
    point = rng.dirichlet([1, 1, 1]) @ corners
    return np.asarray(seen.position + rotate(seen.rotation, seen.scale * point))


def _size(seen: Object) -> float:
    """Half its largest extent."""
    return seen.scale * float(np.ptp(seen.mesh.positions, axis=0).max()) / 2


def _direction(rng: Rng) -> Array:
    v = rng.normal(size=3)
    return np.asarray(v / np.linalg.norm(v))


def _color(rng: Rng) -> tuple[int, int, int]:
    red, green, blue = rng.integers(0, 256, 3).tolist()
    return red, green, blue
