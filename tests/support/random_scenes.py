"""Random scenes of many kinds, each from its kind and a seed, as a user might send them; and calls that are wrong."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import ArrayLike, NDArray

from judge.pieces import pieces_of
from judge.visibility import seen
from judge.world import World
from picture import CENTER
from pictures import call_data
from shackled import Background, Camera, Fog, Light, Material, Mesh, Object, Rim, Scene, Texture, Tone, load
from shackled.datasets import pieces
from shackled.datasets.common import shapes
from shackled.scene import Hemisphere
from shackled.scene._arithmetic import rotate
from shackled.scene._codec import Rectangle
from shackled.scene._fields import FILTERS, WRAPS, Shading
from shackled.scene._in_range import in_range
from shackled.scene._mesh import vertex_normals
from shackled.scene._staging import signed_volume

Array = NDArray[np.float64]
Rng = np.random.Generator

SHADINGS: tuple[Shading, ...] = ("unlit", "flat", "smooth")
MODELS = ("teapot", "cornell-box", "torus-knot", "spring", "seashell", "klein-bottle", "moebius-strip", "genesis/5")
GROUND = 60.0
#: How many scenes are tried until something is seen.
TRIALS = 20
#: Half the extents of meshes of whole numbers, as they are typed by hand, and up to the most of a mesh.
SMALL_NUMBERS, WIDE = (1, 2, 3, 5, 10, 50, 500), 2**23 - 1


def random_scene(kind: str, seed: int) -> Scene:
    """Return the scene of a kind and a seed."""
    return next(_scenes(kind, seed))


def _scenes(kind: str, seed: int) -> Iterator[Scene]:
    """The scene of a kind and a seed, and others that may be taken in its place."""
    rng = np.random.default_rng([zlib.crc32(kind.encode()), seed])
    while True:
        scene = KINDS[kind](rng)
        yield evolve(scene, objects=[evolve(o, two_sided=bool(rng.random() < 0.4)) for o in scene.objects])


@dataclass(frozen=True)
class Case:
    """A scene on a small canvas, in numbers that the contracts take as they are; and a part of it."""

    scene: Scene
    tile: Rectangle


@lru_cache(500)
def random_case(seed: int, kind: str | None = None) -> Case:
    """Return the case of a seed, of any kind or of one; then something is seen in nearly all."""
    rng = np.random.default_rng(seed)
    name = kind or list(KINDS)[rng.integers(len(KINDS))]
    width, height = rng.integers(16, 64, 2).tolist()
    choice = rng.random()
    if choice < 0.1:
        # as thin as a canvas can be
        width, height = [(width % 3 + 1, 3 * height), (3 * width, height % 3 + 1)][rng.integers(2)]
    elif choice < 0.13:
        # of several bands
        width, height = int(rng.integers(300, 1025)), int(rng.integers(50, 70))
    x, y = int(rng.integers(width)), int(rng.integers(height))
    tile = Rectangle(x, y, int(rng.integers(1, width - x + 1)), int(rng.integers(1, height - y + 1)))
    for drawn in islice(_scenes(name, seed), TRIALS if kind else 1):
        scene = evolve(drawn, width=width, height=height)
        scene = _in_range(scene) if kind == "wild" else in_range(scene)
        if not kind or is_anything_seen(scene):
            break
    return Case(scene, tile)


def is_anything_seen(scene: Scene) -> bool:
    """Whether any pixel shows an object by its centre, as the judge finds it."""
    world = World(call_data("render", scene))
    there = (pieces_of(world, i) for i, each in enumerate(world.objects) if each.opacities.any())
    return any(seen(pieces, world.camera, CENTER).covers.any() for pieces in there)


# ---- kinds ----


def _plain(rng: Rng) -> Scene:
    """One to three objects that are seen, from outside, from within, or from far away."""
    unit = 10.0 ** rng.uniform(-3, 4) if rng.random() < 0.5 else 1.0
    return _scene_of(rng, [_object(rng, unit) for _ in range(rng.choice([1, 2, 3], p=[0.7, 0.2, 0.1]))])


def _scene_of(rng: Rng, objects: list[Object]) -> Scene:
    """The objects in some light, seen by a camera that looks toward one of them."""
    seen = objects[rng.integers(len(objects))]
    return Scene(
        objects,
        _camera(rng, seen),
        [_light(rng, seen) for _ in range(rng.choice(5, p=[0.08, 0.5, 0.2, 0.1, 0.12]))],
        Background(_color(rng), _color(rng)),
        ambient_light=(255, 255, 255) if rng.random() < 0.7 else _color(rng),
        invert=bool(rng.random() < 0.1),
        **_canvas(rng),
    )


def _canvas(rng: Rng) -> dict[str, Any]:
    width, height = rng.integers(16, 160, 2).tolist() if rng.random() < 0.2 else [int(rng.integers(48, 129))] * 2
    return {"width": width, "height": height}


def _sampled(rng: Rng, scene: Scene) -> Scene:
    """Antialiased, most often."""
    return evolve(scene, antialias=bool(rng.random() < 0.7))


def _effects(rng: Rng, scene: Scene) -> Scene:
    """Some effects, at least one; the fog is about the objects. Some objects emit light."""
    forward = scene.camera.target - scene.camera.eye
    depths = (scene.world_positions() - scene.camera.eye) @ forward / np.linalg.norm(forward)
    low, high = max(float(depths.min(initial=0)), 0.0), max(float(depths.max(initial=0)), 1e-6)
    near = low + rng.uniform(0, 0.5) * (high - low)
    exposure = float(rng.choice([1, rng.uniform(0.3, 2), 64, 2.0**-16], p=[0.25, 0.65, 0.05, 0.05]))
    every: dict[str, Any] = {
        "hemisphere": Hemisphere(_color(rng), _color(rng)),
        "rim": Rim(_color(rng), int(rng.integers(1, 17))),
        "fog": Fog(_color(rng), near, near + rng.uniform(0.2, 1) * (high - low) + 1e-6 * high),
        "tone": Tone(exposure, bool(rng.random() < 0.5), bool(rng.random() < 0.7)),
    }
    chosen = [name for name in every if rng.random() < 0.5] or ["rim"]
    if rng.random() < 0.5:
        lights = [evolve(o.material, emission=_color(rng)) for o in scene.objects]
        objects = [evolve(o, material=material) for o, material in zip(scene.objects, lights, strict=True)]
        scene = evolve(scene, objects=objects)
    return evolve(scene, **{name: every[name] for name in chosen})


def _maybe_effects(rng: Rng, scene: Scene) -> Scene:
    return _effects(rng, scene) if rng.random() < 0.25 else scene


def _textures(rng: Rng) -> Scene:
    """Textures of random texels; sometimes with effects."""
    scene = _plain(rng)
    return _maybe_effects(rng, evolve(scene, objects=[_with_texture(rng, o) for o in scene.objects]))


def _cards(rng: Rng) -> Scene:
    """Textures with an alpha, first those cut off at some level, then blended ones, and solids behind them."""
    objects = []
    for _ in range(rng.integers(1, 4)):
        width, height = rng.uniform(0.4, 1.2, 2)
        corners = [(-width, -height, 0), (width, -height, 0), (width, height, 0), (-width, height, 0)]
        is_box = rng.random() < 0.3
        mesh = _box(rng.uniform(0.3, 1, 3)) if is_box else Mesh(corners, [(0, 1, 2), (0, 2, 3)])
        mesh = evolve(mesh, colors=_colors(rng, mesh))
        thing = Object(mesh, 0.5 * rng.normal(size=3), rng.normal(size=4), material=_material(rng), cull=is_box)
        objects.append(_with_texture(rng, thing, has_alpha=True))
    objects.sort(key=lambda o: o.material.texture is not None and o.material.texture.cutoff == 0)
    solids = [_solid(rng, rng.uniform(0.3, 0.8)) for _ in range(rng.integers(0, 3))]
    return _maybe_effects(rng, _sampled(rng, _scene_of(rng, solids + objects)))


def _glass(rng: Rng) -> Scene:
    """Objects with opacities of their own or of their vertices, and others, before, behind and within."""
    objects = [_object(rng, 1.0) for _ in range(rng.integers(2, 6))]
    half = [_see_through(rng, o) for o in objects[::2]]
    order = rng.permutation(len(objects))
    objects = [*half, *objects[1::2]]
    return _sampled(rng, _scene_of(rng, [objects[i] for i in order]))


def _wires(rng: Rng) -> Scene:
    """Wireframes among other objects; some of them are glass."""
    scene = _plain(rng)
    objects = [evolve(o, wireframe=bool(i == 0 or rng.random() < 0.5)) for i, o in enumerate(scene.objects)]
    if rng.random() < 0.3:
        objects[0] = evolve(objects[0], opacity=rng.uniform(0.2, 1))
    return _maybe_effects(rng, _sampled(rng, evolve(scene, objects=objects)))


def _slivers(rng: Rng) -> Scene:
    """Meshes of thin triangles: fans, needles, and meshes that are pressed flat."""
    objects = []
    for _ in range(rng.integers(1, 4)):
        thing, choice = _object(rng, 1.0), rng.random()
        if choice < 0.4:
            mesh = evolve(thing.mesh, positions=thing.mesh.positions * 2.0 ** -rng.uniform(0, 9, 3))
        elif choice < 0.7:
            mesh = _fan(rng)
        else:
            start = rng.uniform(-1, 1, (40, 1, 3)) + 0.02 * rng.normal(size=(40, 3, 3))
            mesh = _soup_of(start + rng.normal(size=(40, 1, 3)) * rng.random((40, 3, 1)))
        objects.append(evolve(thing, mesh=evolve(mesh, colors=_colors(rng, mesh)), cull=bool(rng.random() < 0.3)))
    return _maybe_effects(rng, _sampled(rng, _scene_of(rng, objects)))


def _bent(rng: Rng) -> Scene:
    """A few large triangles at any angle to the eye, whose normals are far apart; many are clipped."""
    mesh = _soup_of(rng.normal(size=(int(rng.integers(1, 5)), 3, 3)))
    normals = vertex_normals(mesh.positions, mesh.faces) + rng.uniform(0, 1) * rng.normal(size=mesh.positions.shape)
    material = evolve(_material(rng), shading="smooth" if rng.random() < 0.8 else "flat")
    mesh = evolve(mesh, normals=normals, colors=_colors(rng, mesh))
    scene = _scene_of(rng, [Object(mesh, material=material, cull=False)])
    return _sampled(rng, evolve(scene, lights=scene.lights or [Light("directional", _direction(rng))]))


def _contacts(rng: Rng) -> Scene:
    """Solids that touch one another, stand in one another, or have faces in the same place."""
    objects, look, y = [], _material(rng), 0.0
    for k in range(rng.integers(2, 5)):
        mesh = _box(rng.uniform(0.3, 1, 3) * 0.8**k)
        below = 0.0 if rng.random() < 0.6 else rng.uniform(0, 0.3)
        place = np.array([0.1 * rng.normal(), y + mesh.positions[:, 1].max() - below, 0.1 * rng.normal()])
        y = place[1] + mesh.positions[:, 1].max()
        objects.append(Object(evolve(mesh, colors=_colors(rng, mesh)), place, material=look, cull=rng.random() < 0.7))
    if rng.random() < 0.6:
        objects.append(evolve(_solid(rng, rng.uniform(0.4, 1)), position=rng.normal(size=3) * 0.4, material=look))
    if rng.random() < 0.3:
        # both sides of a surface, as some programs write them, or the same one twice
        thing = objects[rng.integers(len(objects))]
        faces = thing.mesh.faces[:, :: -1 if rng.random() < 0.7 else 1]
        turned = evolve(thing.mesh, faces=faces, colors=_colors(rng, thing.mesh))
        objects.append(evolve(thing, mesh=turned, cull=bool(rng.random() < 0.5)))
    scene = _sampled(rng, _scene_of(rng, objects))
    if scene.lights and rng.random() < 0.5:
        scene = evolve(scene, lights=[evolve(scene.lights[0], shadow=True), *scene.lights[1:]])
    return scene


def _shadows(rng: Rng) -> Scene:
    """Objects in the shadows of one another, on a ground in most scenes; the lamp may be among them."""
    objects, spread = [], rng.choice([0.3, 1.0, 2.0])
    for _ in range(rng.integers(1, 7)):
        thing, choice = _solid(rng, rng.uniform(0.3, 1.2)), rng.random()
        if choice < 0.2:
            stretch = [(0.03, 1, 0.03), (1, 0.02, 1)][rng.integers(2)]
            thing = evolve(thing, mesh=evolve(thing.mesh, positions=thing.mesh.positions * stretch))
        elif choice < 0.45:
            thing = evolve(_object(rng, 1.0), cull=False)
        place = rng.normal(size=3) * spread
        if rng.random() < 0.4:
            # it stands on the ground
            low = rotate(thing.rotation, thing.scale * thing.mesh.positions)[:, 1].min()
            place[1] = -low
        objects.append(evolve(thing, position=place))
    if rng.random() < 0.85:
        corners = [(-GROUND, 0, -GROUND), (-GROUND, 0, GROUND), (GROUND, 0, GROUND), (GROUND, 0, -GROUND)]
        fade = (3 * GROUND, 4 * GROUND) if rng.random() < 0.5 else (rng.uniform(0, 2), rng.uniform(2, 6))
        ground = Mesh(corners, [(0, 1, 2), (0, 2, 3)], _color(rng))
        objects.append(Object(ground, material=Material("flat", 0.4, 0.7, 0.0), fade=fade))
    distance, toward = rng.uniform(3, 7), _above(rng, 5, 85)
    perspective = rng.random() < 0.7
    camera = Camera(
        distance * _above(rng, 8, 60),
        np.array([0, 0.4, 0]) + 0.2 * rng.normal(size=3),
        projection="perspective" if perspective else "orthographic",
        half_height=1.9 / distance if perspective else rng.uniform(1.5, 2.5),
        near=0.05 if perspective else None,
    )
    lamps = (
        Light("directional", toward, _color(rng)),
        Light("point", toward * rng.uniform(2.5, 6) + [0, 0.2, 0]),
        Light("point", [rng.normal() * 0.15, rng.uniform(0.5, 1.2), rng.normal() * 0.15]),
        Light.spot(toward * 4, -toward, outer_angle=rng.uniform(15, 60)),
    )
    lamp = evolve(lamps[rng.choice(4, p=[0.5, 0.25, 0.15, 0.1])], shadow=True)
    lights = [lamp, *(_light(rng, objects[0]) for _ in range(rng.integers(0, 2)))]
    scene = Scene(objects, camera, lights, Background(_color(rng), _color(rng)), **_canvas(rng))
    return _maybe_effects(rng, scene)


def _models(rng: Rng) -> Scene:
    """Real models, with the look that the command gives to files, and options of it."""
    icons = [piece.name for piece in pieces("icons") if piece.ready()]
    options: dict[str, Any] = {
        "size": int(rng.integers(48, 129)),
        "azimuth": rng.uniform(-180, 180),
        "elevation": rng.uniform(-60, 80),
        "antialias": bool(rng.random() < 0.8),
        "margin": rng.uniform(0, 0.3),
    }
    shading = str(rng.choice(["flat", "smooth", "unlit", "creased"]))
    options |= {"crease": rng.uniform(20, 80)} if shading == "creased" else {"shading": shading}
    if shading != "unlit" and rng.random() < 0.4:
        options |= {"shadow": True, "ground": "tan"}
        options |= {"lights": Light.directional(toward=_direction(rng) + np.array([0, 1.2, 0]))}
    return _maybe_effects(rng, load(str(rng.choice(MODELS if rng.random() < 0.5 else icons)), **options))


def _mixed(rng: Rng) -> Scene:
    """Any of these, with all else that a scene can have."""
    scene = (_plain, _glass, _contacts, _shadows, _textures, _models)[rng.integers(6)](rng)
    objects = list(scene.objects)
    for i, thing in enumerate(objects):
        if thing.fade is None and rng.random() < 0.3:
            objects[i] = _with_texture(rng, thing) if rng.random() < 0.5 else evolve(thing, wireframe=True)
        if thing.fade is None and rng.random() < 0.3:
            objects[i] = evolve(objects[i], opacity=rng.uniform(0.1, 1))
    scene = evolve(scene, objects=objects, invert=bool(rng.random() < 0.2), antialias=True)
    return _effects(rng, scene) if rng.random() < 0.5 else scene


def _wild(rng: Rng) -> Scene:
    """Numbers of any size that the contracts take."""
    objects = []
    for thing in _plain(rng).objects:
        extent = rng.choice([*SMALL_NUMBERS, 30_000, WIDE])
        positions = np.rint(thing.mesh.positions * extent / np.abs(thing.mesh.positions).max())
        normals = vertex_normals(positions, thing.mesh.faces) if thing.mesh.normals is None else thing.mesh.normals
        scale = _power(rng, -32, 4 if extent == WIDE else 12)
        place = _anywhere(rng) if rng.random() < 0.5 else rng.normal(size=3) * 1000
        objects.append(
            evolve(thing, mesh=evolve(thing.mesh, positions=positions, normals=normals), scale=scale, position=place)
        )
    scene = _scene_of(rng, objects)
    camera, is_far = scene.camera, rng.random(4) < [0.3, 0.3, 0.1, 0.3]
    if is_far[0]:
        camera = evolve(camera, half_height=_power(rng, -10, 10))
    if is_far[1] or camera.near is None:
        camera = evolve(camera, near=_power(rng, -32, 26))
    if is_far[2]:
        camera = evolve(camera, eye=_anywhere(rng), target=_anywhere(rng))
    if is_far[3]:
        scene = evolve(scene, lights=[evolve(light, vector=_anywhere(rng)) for light in scene.lights])
    return _in_range(evolve(scene, camera=camera))


#: Functions of a random generator.
KINDS: dict[str, Callable[[Rng], Scene]] = {
    "plain": _plain,
    "antialiased": lambda rng: evolve(_plain(rng), antialias=True),
    "effects": lambda rng: _effects(rng, _plain(rng)),
    "textures": _textures,
    "cards": _cards,
    "glass": _glass,
    "wires": _wires,
    "slivers": _slivers,
    "bent": _bent,
    "contacts": _contacts,
    "shadows": _shadows,
    "models": _models,
    "mixed": _mixed,
    "wild": _wild,
}
#: Those of ordinary numbers, of which every pixel must be right.
TAME = tuple(kind for kind in KINDS if kind != "wild")


# ---- objects ----


def _object(rng: Rng, unit: float) -> Object:
    """Of about a unit, in fractions or in whole numbers."""
    mesh = _mesh(rng)
    positions = mesh.positions * rng.uniform(0.5, 2) + rng.normal(size=3) * 0.1
    if rng.random() < 0.35:
        extent = rng.choice(SMALL_NUMBERS)
        positions = np.rint(positions * extent / np.abs(positions).max()) + extent * rng.integers(-1, 2, 3)
    mesh = Mesh(positions, mesh.faces, _colors(rng, mesh), _normals(rng, positions, mesh.faces))
    # seldom a power of two, so that neither scale nor size are round in any base
    size = unit * (1.0 if rng.random() < 0.2 else rng.uniform(0.5, 2))
    radius = float(np.linalg.norm(positions - positions.mean(axis=0), axis=1).max()) or 1.0
    return Object(
        mesh,
        position=(0, 0, 0) if rng.random() < 0.2 else unit * rng.normal(size=3),
        rotation=(0, 0, 0, 1) if rng.random() < 0.2 else rng.normal(size=4),
        scale=size / radius,
        material=_material(rng),
        cull=bool(rng.random() < 0.5),
    )


def _solid(rng: Rng, radius: float) -> Object:
    """A closed shape, culled."""
    mesh = _closed_mesh(rng)
    if signed_volume(mesh) < 0:
        mesh = evolve(mesh, faces=mesh.faces[:, ::-1])
    scale = radius / float(np.linalg.norm(mesh.positions, axis=1).max())
    mesh = evolve(mesh, colors=_colors(rng, mesh))
    return Object(mesh, rotation=rng.normal(size=4), material=_material(rng), scale=scale)


def _closed_mesh(rng: Rng) -> Mesh:
    made: tuple[Callable[[], Mesh], ...] = (
        lambda: shapes.sphere(int(rng.integers(4, 16)), int(rng.integers(3, 9))),
        lambda: shapes.torus(thickness=rng.uniform(0.1, 0.4), across=int(rng.integers(6, 20)), down=6),
        lambda: shapes.icosphere(int(rng.integers(0, 3))),
        lambda: shapes.cylinder(int(rng.integers(3, 20))),
        lambda: shapes.cone(int(rng.integers(3, 20))),
        lambda: _box(rng.uniform(0.3, 1, 3)),
        shapes.tetrahedron,
        shapes.dodecahedron,
    )
    return made[rng.integers(len(made))]()


def _mesh(rng: Rng) -> Mesh:
    made: tuple[Callable[[], Mesh], ...] = (
        lambda: shapes.moebius_strip(int(rng.integers(5, 30)), 3),
        lambda: _box(rng.uniform(0.3, 1, 3), inward=True),
        lambda: _terrain(rng, int(rng.integers(1, 9))),
        lambda: _fan(rng),
        lambda: _soup(rng),
    )
    return _closed_mesh(rng) if rng.random() < 0.5 else made[rng.integers(len(made))]()


def _box(sides: Array, inward: bool = False) -> Mesh:
    """Each face with corners of its own."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * sides
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.arange(24).reshape(6, 4)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return Mesh(corners[quads].reshape(-1, 3), faces[:, ::-1] if inward else faces)


def _terrain(rng: Rng, side: int) -> Mesh:
    """A field of squares about the origin, y up."""
    heights = rng.uniform(0, rng.uniform(0, 2), (side + 1, side + 1)) * rng.integers(0, 2)
    x, z = (grid.ravel() for grid in np.meshgrid(np.arange(side + 1.0), np.arange(side + 1.0), indexing="ij"))
    a = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    b, c, d = a + 1, a + side + 2, a + side + 1
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return Mesh(np.stack([x - side / 2, heights.ravel(), z - side / 2], axis=1) * 2 / side, faces)


def _fan(rng: Rng) -> Mesh:
    """Long thin triangles around a point."""
    sides = int(rng.integers(3, 100))
    angles = np.sort(rng.uniform(0, 2 * np.pi, sides))
    rim = np.stack([np.cos(angles), np.sin(angles), rng.uniform(-0.2, 0.2, sides)], axis=1)
    numbers = np.arange(sides) + 1
    return Mesh(np.vstack([np.zeros(3), rim]), np.stack([0 * numbers, numbers, np.roll(numbers, -1)], axis=1))


def _soup(rng: Rng) -> Mesh:
    """Triangles of many sizes, anywhere."""
    count = int(rng.integers(1, 30))
    corners = rng.normal(size=(count, 3, 3)) * 2.0 ** -rng.uniform(0, 4, (count, 1, 1))
    return _soup_of(rng.uniform(-1, 1, (count, 1, 3)) + corners)


def _soup_of(corners: Array) -> Mesh:
    """A mesh of (n, 3, 3) corners."""
    return Mesh(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))


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


def _normals(rng: Rng, positions: Array, faces: NDArray[Any]) -> Array | None:
    choice = rng.random()
    if choice < 0.5:
        return None
    return vertex_normals(positions, faces) + rng.normal(size=positions.shape) * (2.0 if choice < 0.6 else 0.2)


def _material(rng: Rng) -> Material:
    shading = SHADINGS[rng.choice(3, p=[0.15, 0.5, 0.35])]
    if rng.random() < 0.25:
        return Material(shading, 0.3, 0.75, 0.3, 24)
    most = 4.0 if rng.random() < 0.25 else 1.0
    ambient, diffuse, specular = (float(rng.choice([0.0, 1.0, *rng.uniform(0, most, 4)])) for _ in range(3))
    shininess = int(rng.choice([1, 2, 3, 5, 10, 20, 33, 64, 127, 128]))
    return Material(shading, ambient, diffuse, specular, shininess)


def _with_texture(rng: Rng, o: Object, has_alpha: bool = False) -> Object:
    """The object with a texture, whose coordinates go around the mesh as on a box, up to a few times."""
    height, width = rng.integers(1, 17, 2).tolist()
    palette = rng.integers(0, 256, (int(rng.choice([1, 2, 3, 5, 16, 17, 400])), 3), dtype=np.uint8)
    pixels = palette[rng.integers(0, len(palette), (height, width))]
    texture = Texture(pixels, FILTERS[rng.integers(2)], WRAPS[rng.integers(2)])
    if has_alpha:
        alpha = rng.choice([0, 90, 170, 255], (height, width)) if rng.random() < 0.5 else pixels[..., 0]
        texture = evolve(texture, alpha=alpha, cutoff=int(rng.integers(2) * rng.integers(1, 256)))
    points = o.mesh.positions - o.mesh.positions.mean(axis=0)
    uvs = points @ rng.normal(size=(3, 2)) / (np.abs(points).max() or 1.0) * rng.choice([0.5, 1, 3])
    mesh = evolve(o.mesh, uvs=uvs + rng.normal(size=2))
    return evolve(o, mesh=mesh, material=evolve(o.material, texture=texture))


def _see_through(rng: Rng, o: Object) -> Object:
    """The object with an opacity, opacities of its vertices, or both."""
    points = o.mesh.positions - o.mesh.positions.mean(axis=0)
    levels = (
        rng.random(len(points)) if rng.random() < 0.5 else 0.5 + points @ _direction(rng) / (np.abs(points).max() or 1)
    )
    if rng.random() < 0.2:
        levels = np.rint(levels)
    opacity = float(rng.choice([1.0, rng.uniform(0.2, 1), 0.5, 0.0, 1 - 2.0**-24], p=[0.4, 0.45, 0.05, 0.05, 0.05]))
    own = None if opacity < 1 and rng.random() < 0.5 else np.clip(levels, 0, 1)
    return evolve(o, mesh=evolve(o.mesh, opacities=own), opacity=opacity)


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
        # at times the numbers of an ordinary scene, with all their zeros
        target + distance * (_direction(rng) if rng.random() < 0.8 else np.array([0.0, 0.0, 1.0])),
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
    place = _point(rng, seen) + _size(seen) * 10.0 ** rng.uniform(-2.5, 1) * _direction(rng)
    if rng.random() < 0.6:
        return Light("point", place, color)
    outer = rng.uniform(5, 90)
    toward = _point(rng, seen) - place
    return Light("spot", place, color, toward if toward.any() else (0, 0, -1), outer * rng.random(), outer)


def _point(rng: Rng, seen: Object) -> Array:
    """A place on an object."""
    corners = seen.mesh.positions[seen.mesh.faces[rng.integers(len(seen.mesh.faces))]]
    return np.asarray(seen.position + rotate(seen.rotation, seen.scale * (rng.dirichlet([1, 1, 1]) @ corners)))


def _size(seen: Object) -> float:
    """Half its largest extent."""
    return max(seen.scale * float(np.ptp(seen.mesh.positions, axis=0).max()) / 2, 2.0**-16)


def _direction(rng: Rng) -> Array:
    v = rng.normal(size=3)
    return np.asarray(v / np.linalg.norm(v))


def _above(rng: Rng, low: float, high: float) -> Array:
    """A direction, so many degrees above the ground."""
    azimuth, elevation = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(low, high))
    return np.array([np.cos(elevation) * np.cos(azimuth), np.sin(elevation), np.cos(elevation) * np.sin(azimuth)])


def _color(rng: Rng) -> tuple[int, int, int]:
    red, green, blue = rng.integers(0, 256, 3).tolist()
    return red, green, blue


# ---- numbers up to the bounds of the contracts ----


def _power(rng: Rng, low: float, high: float) -> float:
    """A power of two, sometimes one of the bounds."""
    return float(2.0 ** np.clip(rng.uniform(low - 1, high + 1), low, high))


def _anywhere(rng: Rng) -> Array:
    """Near the middle as likely as far out."""
    return np.asarray(rng.choice([-1, 1], 3) * 2.0 ** rng.uniform(-33, 26.5, 3))


def _in_range(scene: Scene) -> Scene:
    """The scene whose meshes are of whole numbers, with all others rounded to what the contracts take."""

    def rounded(values: ArrayLike, least: float = -(2.0**26), most: float = 2.0**26) -> Array:
        return np.asarray(np.rint(np.clip(values, least, most) * 2.0**32) / 2.0**32)

    camera, is_perspective = scene.camera, scene.camera.projection == "perspective"
    camera = Camera(
        rounded(camera.eye),
        rounded(camera.target),
        rounded(camera.up),
        camera.projection,
        float(rounded(camera.half_height, *((2.0**-10, 2.0**10) if is_perspective else (2.0**-12, 2.0**26)))),
        float(rounded(camera.near or 0.0, 2.0**-32 if is_perspective else -(2.0**26))),
    )
    lights = []
    for light in scene.lights:
        cone: dict[str, Any] = {} if light.direction is None else {"direction": rounded(light.direction * 2.0**10)}
        vector = rounded(light.vector)
        lights.append(evolve(light, vector=vector if vector.any() else (0, 0, 1), **cone))
    objects = [
        evolve(o, position=rounded(o.position), rotation=rounded(o.rotation), scale=float(rounded(o.scale, 0, 2.0**12)))
        for o in scene.objects
    ]
    return evolve(scene, camera=camera, lights=lights, objects=objects)


# ---- calls that are wrong ----

#: Words on both sides of the bounds of the contract.
BOUNDS = (0, 1, 2, 3, 4, 31, 32, 128, 129, 2048, 2049, 0xFFFFFF, 0x1000000, 1 << 20, 1 << 22, 1 << 42, 4 << 32, 1 << 58)
SHIFTS = (64, 128, 255)


def broken_call(seed: int, data: bytes) -> bytes:
    """A call in which one or two words or bytes are wrong, or the end is missing."""
    rng = np.random.default_rng([seed, 1])
    changed = bytearray(data)
    for _ in range(rng.integers(1, 3)):
        choice = rng.random()
        # most often in the numbers before the meshes, or in the extensions at the end
        words = len(changed) // 32
        place = 4 + 32 * int(
            rng.integers(min(words, 60)) if rng.random() < 0.7 else rng.integers(max(words - 6, 0), words)
        )
        if choice < 0.4:
            changed[place : place + 32] = _bound(rng).to_bytes(32, "big")
        elif choice < 0.7:
            word = int.from_bytes(changed[place : place + 32], "big") + int(rng.integers(-40, 41))
            changed[place : place + 32] = (word % (1 << 256)).to_bytes(32, "big")
        elif choice < 0.9:
            changed[rng.integers(place, min(place + 64, len(changed)))] = rng.integers(256)
        else:
            changed = changed[: rng.integers(40, len(changed) + 1)]
    return bytes(changed)


def _bound(rng: Rng) -> int:
    words = (*BOUNDS, *(1 << shift for shift in SHIFTS))
    value = words[rng.integers(len(words))] + int(rng.integers(-1, 2))
    return (-value if rng.random() < 0.3 else value) % (1 << 256)
