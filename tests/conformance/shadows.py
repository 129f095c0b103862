"""Shadows against rays: random scenes, whose samples are lit or dark as a ray from each to the light finds it.

    python -m conformance.shadows --count 200

prints, for each kind of scene, how many pixels differ. A pixel is interior if its samples and those around show one
surface, and wrong if another share of them is lit than by the rays.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from dataclasses import dataclass

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from pictures import draw
from random_scenes import box_shape, fan_shape, patch_shape, soup_shape
from shackled import Camera, Light, Material, Mesh, Object, Scene
from shackled.scene import fit, signed_volume

Array = NDArray[np.float64]
Rng = np.random.Generator

KINDS = (
    "model",
    "model, point light",
    "light at 5 degrees",
    "thin",
    "contact",
    "interpenetrating",
    "soup",
    "light inside",
    "caster outside",
    "open",
)
SOLIDS = ("ball", "torus", "box")
#: Without ambient light and highlights, so that what is dark is black.
MATTE = Material("flat", ambient=0.0, diffuse=1.0, specular=0.0)
#: How far a wrong pixel may be from the edge of a shadow, in pixels.
NEAR_EDGE = 1.5
GROUND = 60.0
#: The places of the samples in a pixel, from its centre.
PLACES = ((-1 / 8, -3 / 8), (3 / 8, -1 / 8), (-3 / 8, 1 / 8), (1 / 8, 3 / 8))
#: Half of what a sample is of a pixel; levels that a pixel must have without shadows to be compared.
TOLERANCE, LEAST = 0.125, 24


def torus(rng: Rng) -> tuple[Array, NDArray[np.int64]]:
    """A closed torus with bumps."""
    n, m, r, bumps = int(rng.integers(8, 20)), int(rng.integers(5, 9)), rng.uniform(0.15, 0.5), rng.uniform(0, 0.2)
    a, b = 2 * np.pi * np.arange(n)[:, None] / n, 2 * np.pi * np.arange(m)[None] / m
    rr = r * (1 + bumps * np.sin(5 * a) * np.cos(3 * b))
    ring = 1 + rr * np.cos(b)
    points = np.stack([ring * np.cos(a), rr * np.sin(b) + 0 * a, -ring * np.sin(a)], -1).reshape(-1, 3) / (1 + r)
    i, j = (part.ravel() for part in np.mgrid[:n, :m])
    corners = i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
    return points, np.vstack([np.stack([corners[k] for k in each], 1) for each in ((0, 1, 2), (0, 2, 3))])


def ball(rng: Rng) -> tuple[Array, NDArray[np.int64]]:
    """A closed sphere with hills, without degenerate faces."""
    rings, sides, hills = int(rng.integers(5, 10)), int(rng.integers(6, 14)), rng.uniform(0, 0.3)
    theta, phi = np.pi * np.arange(1, rings)[:, None] / rings, 2 * np.pi * np.arange(sides)[None] / sides
    k = rng.integers(2, 6, 3)
    r = 1 + hills * np.sin(k[0] * theta) * np.cos(k[1] * phi + k[2])
    points = np.stack(
        [r * np.sin(theta) * np.cos(phi), r * np.cos(theta) + 0 * phi, -r * np.sin(theta) * np.sin(phi)], -1
    )
    last = (rings - 1) * sides
    faces = []
    for j in range(sides):
        following = (j + 1) % sides
        faces += [(last, j, following), (last + 1, last - sides + following, last - sides + j)]
        for i in range(rings - 2):
            a, b, c, d = (row * sides + column for row in (i, i + 1) for column in (j, following))
            faces += [(a, c, d), (a, d, b)]
    return np.vstack([points.reshape(-1, 3), [[0, 1, 0], [0, -1, 0]]]), np.array(faces)


def shape(rng: Rng, name: str) -> tuple[Array, NDArray[np.int64], bool]:
    """Positions, faces, and whether they are closed."""
    if name in ("soup", "fan", "patch"):
        return *{"soup": soup_shape, "fan": fan_shape, "patch": patch_shape}[name](rng), False
    points, faces = {"ball": ball, "torus": torus}.get(name, box_shape)(rng)
    if name == "plate":
        points = points * [1, 0.02, 1]
    if name == "stick":
        points = points / np.abs(points).max(axis=0) * [0.03, 1, 0.03]
    outward = signed_volume(Mesh(points, faces)) > 0
    return points, faces if outward else faces[:, ::-1], True


def turned(rng: Rng, most: float) -> Array:
    """A rotation by up to this angle."""
    v = rng.normal(size=3)
    x, y, z = v / np.linalg.norm(v)
    angle = rng.uniform(0, most)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k)


def random_scene(seed: int, size: int) -> Scene:
    """A scene whose only light casts shadows; its last object is a ground, if it has one."""
    rng = np.random.default_rng([16, seed])
    kind = KINDS[seed % len(KINDS)]
    objects: list[Object] = []

    def add(names: tuple[str, ...], scale: float, at: object, most: float = np.pi, rests: bool = False) -> float:
        points, faces, closed = shape(rng, names[rng.integers(len(names))])
        points = points * scale @ turned(rng, most).T
        if rests:
            points = points - [0, points[:, 1].min(), 0]
        points = points + np.asarray(at)
        objects.append(Object(Mesh(points, faces, (255, 255, 255)), material=MATTE, cull=closed))
        return float(points[:, 1].max())

    if kind in KINDS[:3]:
        for _ in range(rng.integers(1, 4)):
            add(SOLIDS, rng.uniform(0.5, 1.2), [rng.normal() * 1.2, 0, rng.normal() * 1.2], rests=rng.random() < 0.7)
    elif kind == "thin":
        for _ in range(rng.integers(3, 8)):
            place = [rng.normal(), rng.uniform(0, 0.8), rng.normal()]
            add(("stick", "plate", "fan", "stick"), rng.uniform(0.5, 1.3), place, rng.choice([0.2, 3.0]))
    elif kind == "contact":
        y = 0.0
        for k in range(rng.integers(1, 4)):
            y = add(
                ("box",), rng.uniform(0.6, 1.2) * 0.8 ** (k + 1), [0.1 * rng.normal(), y, 0.1 * rng.normal()], 0, True
            )
        add(SOLIDS, 0.6, [1.3, 0, 0.3], rests=True)
    elif kind == "interpenetrating":
        for _ in range(rng.integers(2, 5)):
            add(SOLIDS, rng.uniform(0.6, 1.1), rng.normal(size=3) * 0.4 + [0, rng.uniform(-0.2, 0.8), 0])
    elif kind == "soup":
        for _ in range(rng.integers(1, 3)):
            add(("soup", "soup", "fan"), rng.uniform(1, 2), [rng.normal() / 2, rng.uniform(0.5, 1.5), rng.normal() / 2])
    elif kind == "light inside":
        for _ in range(rng.integers(3, 7)):
            a = rng.uniform(0, 2 * np.pi)
            place = [1.5 * np.cos(a), rng.uniform(0, 1), 1.5 * np.sin(a)]
            add((*SOLIDS, "stick", "plate"), rng.uniform(0.3, 0.7), place, rests=rng.random() < 0.5)
    elif kind == "caster outside":
        add(SOLIDS, 0.8, [0, 0, 0], rests=True)
        add((*SOLIDS, "plate", "soup"), 1.0, [3.0, 2.0, 0.5])
    else:
        add(("patch",), 1.5, [0, 0.4, 0], 0.3)
        for _ in range(rng.integers(1, 3)):
            add((*SOLIDS, "fan"), rng.uniform(0.3, 0.8), rng.normal(size=3) * 0.6 + [0, 1, 0])
    if rng.random() < 0.88:
        corners = [(-GROUND, 0, -GROUND), (-GROUND, 0, GROUND), (GROUND, 0, GROUND), (GROUND, 0, -GROUND)]
        mesh = Mesh(corners, [(0, 1, 2), (0, 2, 3)], (255, 255, 255))
        objects.append(Object(mesh, material=MATTE, fade=(3 * GROUND, 4 * GROUND)))
    projection = "perspective" if rng.random() < (0.2 if kind == "open" else 0.7) else "orthographic"
    a, e, distance = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(8, 60)), rng.uniform(3, 7)
    eye = distance * np.array([np.cos(e) * np.cos(a), np.sin(e), np.cos(e) * np.sin(a)])
    half = (1.9 / distance if rng.random() < 0.7 else 0.8) if projection == "perspective" else rng.uniform(1.5, 2.5)
    near = 0.05 if projection == "perspective" else None
    camera = Camera(eye, np.array([0, 0.4, 0]) + 0.2 * rng.normal(size=3), (0, 1, 0), projection, half, near)
    return Scene(objects, camera, [_light(rng, kind)], "#203040", width=size, height=size)


def _light(rng: Rng, kind: str) -> Light:
    elevation = np.radians(5 if kind == KINDS[2] else rng.choice([rng.uniform(15, 85), rng.uniform(35, 65)]))
    azimuth = rng.uniform(0, 2 * np.pi)
    if kind == "caster outside":
        azimuth, elevation = rng.normal() * 0.2, np.radians(rng.uniform(25, 45))
    level = np.cos(elevation)
    direction = np.array([level * np.cos(azimuth), np.sin(elevation), level * np.sin(azimuth)])
    if kind == "light inside":
        return Light("point", [rng.normal() * 0.15, rng.uniform(0.5, 1.2), rng.normal() * 0.15], shadow=True)
    may_be_point = kind not in (KINDS[0], KINDS[2], "caster outside")
    if kind == KINDS[1] or (may_be_point and rng.random() < 0.4):
        return Light("point", direction * rng.uniform(2.5, 6) + [0, 0.2, 0], shadow=True)
    return Light("directional", direction, shadow=True)


# ---- rays ----


@dataclass(frozen=True)
class Truth:
    """What rays find at a place of each pixel, (H * W,).

    face: the number of the face that is seen, counted through all objects, -1 for none. facing: whether it is turned
    to the light. dark: whether it gets no light. inner: whether the surface goes on in all neighbours.
    """

    face: NDArray[np.int64]
    facing: NDArray[np.bool_]
    dark: NDArray[np.bool_]
    inner: NDArray[np.bool_]


def unit(v: Array) -> Array:
    """The direction of a vector."""
    return np.asarray(v / np.linalg.norm(v))


def trace(scene: Scene, place: tuple[float, float]) -> Truth:
    """What rays find in a scene that is fitted, through this place of each pixel, from its centre."""
    corners = np.concatenate([o.world_positions()[o.mesh.faces] for o in scene.objects])
    cull = np.concatenate([np.full(len(o.mesh.faces), o.cull) for o in scene.objects])
    casts = np.flatnonzero(np.concatenate([np.full(len(o.mesh.faces), o.fade is None) for o in scene.objects]))
    camera, size = scene.camera, scene.width
    forward = unit(camera.target - camera.eye)
    right = unit(np.cross(forward, camera.up))
    columns, rows = (((np.arange(size) + 0.5 + each) / size * 2 - 1) * camera.half_height for each in place)
    x, y = (part.ravel()[:, None] for part in np.meshgrid(columns, -rows))
    aside = x * right + y * np.cross(right, forward)
    perspective = camera.projection == "perspective"
    begin = np.broadcast_to(camera.eye, aside.shape) if perspective else camera.eye + aside
    ray = forward + aside if perspective else np.broadcast_to(forward, aside.shape)
    least = (camera.near or 0.0) if perspective else -np.inf
    face, distance = nearest(begin, ray, corners, cull, least)
    point = begin + ray * np.where(face < 0, 0, distance)[:, None]
    light = scene.lights[0]
    toward = np.broadcast_to(light.vector, point.shape) if light.kind == "directional" else light.vector - point
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[face]
    normal = np.where((np.einsum("ij,ij->i", normal, ray) > 0)[:, None], -normal, normal)
    facing = (face >= 0) & (np.einsum("ij,ij->i", normal, toward) > 0)
    lit = np.flatnonzero(facing)
    dark = (face >= 0) & ~facing
    most = np.inf if light.kind == "directional" else 1.0
    dark[lit] = is_hit(point[lit], toward[lit], corners, casts, face[lit], most)
    numbers = np.concatenate([[-1], np.arange(len(corners))])[face + 1]
    return Truth(face, facing, dark, _inner(numbers.reshape(size, size), corners).ravel() & (face >= 0))


def nearest(
    begin: Array, ray: Array, corners: Array, cull: NDArray[np.bool_], least: float
) -> tuple[NDArray[np.int64], Array]:
    """The face that each ray meets first, and where."""
    face, best = np.full(len(begin), -1), np.full(len(begin), np.inf)
    for number, (a, b, c) in enumerate(corners):
        t, meets, cosine = _meet(begin, ray, a, b, c)
        closer = meets & (t > least) & (t < best) & ((cosine < 0) | ~cull[number])
        face[closer], best[closer] = number, t[closer]
    return face, best


def is_hit(
    begin: Array, ray: Array, corners: Array, casts: NDArray[np.int64], own: NDArray[np.int64], most: float
) -> NDArray[np.bool_]:
    """Whether a ray meets any face but its own."""
    found = np.zeros(len(begin), bool)
    for number in casts:
        t, meets, _ = _meet(begin, ray, *corners[number])
        found |= meets & (t > 1e-9) & (t < most) & (own != number)
    return found


def _meet(begin: Array, ray: Array, a: Array, b: Array, c: Array) -> tuple[Array, NDArray[np.bool_], Array]:
    u, v = b - a, c - a
    n = np.cross(u, v)
    cosine = ray @ n
    scale = 1 / np.where(cosine == 0, 1, cosine)
    away = begin - a
    q = np.cross(away, ray)
    s, t = -(q @ v) * scale, (q @ u) * scale
    return -(away @ n) * scale, (cosine != 0) & (s >= 0) & (t >= 0) & (s + t <= 1), cosine


def _inner(face: NDArray[np.int64], corners: Array) -> NDArray[np.bool_]:
    """Pixels at least a pixel and a half from what shows another surface: faces without a common place."""
    size = len(face)
    shares = np.zeros((len(corners) + 1, len(corners) + 1), bool)
    shares[:-1, :-1] = (corners[:, None, :, None] == corners[None, :, None]).all(-1).any((2, 3))
    edge = np.zeros((size, size), bool)
    for dy, dx in ((0, 1), (1, 0), (1, 1), (1, -1)):
        here = face[: size - dy, max(-dx, 0) : size - max(dx, 0)]
        there = face[dy:, max(dx, 0) : size + min(dx, 0)]
        other = (here != there) & ~shares[here, there]
        edge[: size - dy, max(-dx, 0) : size - max(dx, 0)] |= other
        edge[dy:, max(dx, 0) : size + min(dx, 0)] |= other
    wide = np.pad(edge, 1)
    near = [wide[i : i + size, j : j + size] for i in range(3) for j in range(3)]
    return np.asarray(np.logical_not(np.any(near, axis=0)))


# ---- comparison ----


@dataclass(frozen=True)
class Shaded:
    """Pixels of a scene: those seen, those in a shadow that is cast, and interior ones that are wrong; of these those
    farther than NEAR_EDGE from the edge of a shadow, and how far the farthest is.
    """

    seen: int
    shadow: int
    wrong: int
    far: int
    distance: float


def compare(scene: Scene) -> Shaded:
    """Compare what the contracts draw with rays."""
    fitted = fit(scene)
    truths = [trace(fitted, place) for place in PLACES]
    ours = draw(fitted).reshape(-1, 3)[:, 0].astype(float)
    unshaded = [evolve(light, shadow=False) for light in scene.lights]
    plain = draw(fit(evolve(scene, lights=unshaded, hemisphere=(0, 0, 0)))).reshape(-1, 3)[:, 0].astype(float)
    dark, facing, inner, face = (
        np.array([getattr(truth, name) for truth in truths]) for name in ("dark", "facing", "inner", "face")
    )
    comparable = inner.all(axis=0) & facing.all(axis=0) & (face == face[0]).all(axis=0) & (plain >= LEAST)
    share = ours / np.maximum(plain, 1)
    wrong = np.flatnonzero(comparable & (np.abs(share - (~dark).mean(axis=0)) > TOLERANCE))
    distances = [_to_edge(face[0] >= 0, dark, int(at), scene.width) for at in wrong]
    return Shaded(
        int((face[0] >= 0).sum()),
        int((dark & facing).any(axis=0).sum()),
        len(wrong),
        sum(each > NEAR_EDGE for each in distances),
        max(distances, default=0.0),
    )


def _to_edge(seen: NDArray[np.bool_], dark: NDArray[np.bool_], at: int, size: int) -> float:
    """The distance of a pixel from the nearest one that has a sample of the other kind."""
    if dark[:, at].any() and not dark[:, at].all():
        return 0.0
    other = np.flatnonzero(seen & (dark != dark[0, at]).any(axis=0))
    y, x = np.divmod(other, size)
    return float(np.sqrt((y - at // size) ** 2 + (x - at % size) ** 2).min(initial=np.inf)) - 0.5


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--count", type=int, default=200, help="how many scenes")
    parser.add_argument("--seed", type=int, default=0, help="the first")
    parser.add_argument("--size", type=int, default=96, help="of the pictures, in pixels")
    arguments = parser.parse_args()
    sums: defaultdict[str, NDArray[np.int64]] = defaultdict(lambda: np.zeros(5, np.int64))
    worst = 0.0
    for seed in range(arguments.seed, arguments.seed + arguments.count):
        found = compare(random_scene(seed, arguments.size))
        worst = max(worst, found.distance)
        sums[KINDS[seed % len(KINDS)]] += (1, found.seen, found.shadow, found.wrong, found.far)
        if found.far:
            print(f"seed {seed}: {found}", flush=True)
    print("kind, scenes, pixels seen, in shadow, interior and wrong, those beyond 1.5 pixels of an edge")
    for kind, row in sums.items():
        print(f"{kind:20s}", *(f"{value:10,}" for value in row))
    total = np.sum(list(sums.values()), axis=0)
    print("all", *(f"{value:,}" for value in total), f"worst {worst:.1f}")


if __name__ == "__main__":
    main()
