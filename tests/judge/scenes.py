"""What is drawn: random scenes, each from its kind and a seed, as a user might send them; and the built-in pieces."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from typing import Any

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from random_scenes import Kind, random_case
from shackled import Background, Camera, Fog, Light, Material, Mesh, Object, Rim, Scene, Texture, Tone, load
from shackled.datasets import Piece, pieces, require
from shackled.datasets.common import shapes
from shackled.scene import Hemisphere, rotate, vertex_normals
from shackled.scene._object import Shading
from shackled.scene._staging import signed_volume
from shackled.scene._texture import FILTERS, WRAPS

Array = NDArray[np.float64]
Rng = np.random.Generator

#: Sides of the pictures of built-in pieces, in pixels.
SIZES = (128, 512)
SHADINGS: tuple[Shading, ...] = ("unlit", "flat", "smooth")
MODELS = ("teapot", "cornell-box", "torus-knot", "spring", "seashell", "klein-bottle", "moebius-strip", "genesis/5")
GROUND = 60.0


def built_in() -> list[Piece]:
    """Return all pieces that nothing has to be fetched for."""
    return [piece for piece in pieces() if piece.ready()]


def built_in_scene(name: str, size: int) -> Scene:
    """Return a piece on a canvas of another size."""
    return evolve(require(name).make(), width=size, height=size)


def random_scene(kind: str, seed: int) -> Scene:
    """Return the scene of a kind and a seed."""
    if kind in EXTREMES:
        return random_case(seed, (kind,)).scene
    scene = KINDS[kind](np.random.default_rng([zlib.crc32(kind.encode()), seed]))
    # from numbers of its own, so that the scenes of the seeds stay what they are
    two_sided = np.random.default_rng([zlib.crc32(kind.encode()), seed, 2]).random(len(scene.objects)) < 0.4
    return evolve(
        scene, objects=[evolve(o, two_sided=bool(each)) for o, each in zip(scene.objects, two_sided, strict=True)]
    )


# ---- kinds ----


def _plain(rng: Rng) -> Scene:
    """One to three objects that are seen, from outside, from within, or from far away."""
    unit = 10.0 ** rng.uniform(-3, 4) if rng.random() < 0.5 else 1.0
    return _scene_of(rng, [_object(rng, unit) for _ in range(rng.choice([1, 2, 3], p=[0.7, 0.2, 0.1]))])


def _scene_of(rng: Rng, objects: list[Object]) -> Scene:
    """The objects in some light, seen by a camera that looks toward one of them."""
    width, height = _canvas(rng)
    seen = objects[rng.integers(len(objects))]
    return Scene(
        objects,
        _camera(rng, seen),
        [_light(rng, seen) for _ in range(rng.choice(5, p=[0.08, 0.5, 0.2, 0.1, 0.12]))],
        Background(_color(rng), _color(rng)),
        ambient_light=(255, 255, 255) if rng.random() < 0.7 else _color(rng),
        invert=bool(rng.random() < 0.1),
        width=width,
        height=height,
    )


def _antialiased(rng: Rng) -> Scene:
    return evolve(_plain(rng), antialias=True)


def _effects(rng: Rng, scene: Scene | None = None) -> Scene:
    """Some effects, at least one; the fog is about the objects."""
    scene = scene or _plain(rng)
    forward = scene.camera.target - scene.camera.eye
    depths = (scene.world_positions() - scene.camera.eye) @ forward / np.linalg.norm(forward)
    low, high = max(float(depths.min(initial=0)), 0.0), max(float(depths.max(initial=0)), 1e-6)
    near = low + rng.uniform(0, 0.5) * (high - low)
    chosen = rng.random(4) < 0.5
    chosen[rng.integers(4)] = True
    color = rng.integers(0, 256, (4, 3))
    # from numbers of its own, so that the scenes of the seeds stay what they are
    scene = _emitting(np.random.default_rng(color.ravel()), scene)
    return evolve(
        scene,
        hemisphere=Hemisphere(color[0], color[1]) if chosen[0] else None,
        rim=Rim(color[2], int(rng.integers(1, 17))) if chosen[1] else None,
        fog=Fog(color[3], near, near + rng.uniform(0.2, 1) * (high - low) + 1e-6 * high) if chosen[2] else None,
        tone=Tone(rng.uniform(0.3, 2), bool(rng.random() < 0.5), bool(rng.random() < 0.7)) if chosen[3] else None,
    )


def _emitting(rng: Rng, scene: Scene) -> Scene:
    """Sometimes with objects that emit light."""
    if rng.random() < 0.5:
        return scene
    materials = [evolve(o.material, emission=rng.integers(0, 256, 3)) for o in scene.objects]
    return evolve(scene, objects=[evolve(o, material=m) for o, m in zip(scene.objects, materials, strict=True)])


def _textures(rng: Rng) -> Scene:
    """Textures of random texels; sometimes with effects."""
    scene = _plain(rng)
    scene = evolve(scene, objects=[_with_texture(rng, o) for o in scene.objects])
    return _effects(rng, scene) if rng.random() < 0.25 else scene


def _glasses(rng: Rng) -> Scene:
    """Objects with opacities of their own or of their vertices, and others, before, behind and within."""
    objects = [_object(rng, 1.0) for _ in range(rng.integers(1, 4))]
    objects += [_glass(rng, rng.normal(size=3), rng.uniform(0.3, 1.2)) for _ in range(rng.integers(1, 4))]
    order = rng.permutation(len(objects))
    return evolve(_scene_of(rng, [objects[i] for i in order]), antialias=bool(rng.random() < 0.7))


def _wires(rng: Rng) -> Scene:
    """Wireframes among other objects; some of them are glass."""
    scene = _plain(rng)
    objects = [evolve(o, wireframe=bool(i == 0 or rng.random() < 0.5)) for i, o in enumerate(scene.objects)]
    if rng.random() < 0.3:
        objects[0] = evolve(objects[0], opacity=rng.uniform(0.2, 1))
    return evolve(scene, objects=objects, antialias=bool(rng.random() < 0.6))


def _slivers(rng: Rng) -> Scene:
    """Meshes of thin triangles: fans, needles, and meshes that are pressed flat."""
    objects = []
    for _ in range(rng.integers(1, 4)):
        thing = _object(rng, 1.0)
        mesh, choice = thing.mesh, rng.random()
        if choice < 0.4:
            mesh = evolve(mesh, positions=mesh.positions * 2.0 ** -rng.uniform(0, 9, 3))
        elif choice < 0.7:
            mesh = _fan(rng)
        else:
            way = rng.normal(size=(40, 1, 3))
            start = rng.uniform(-1, 1, (40, 1, 3)) + 0.02 * rng.normal(size=(40, 3, 3))
            mesh = _triangles(start + way * rng.random((40, 3, 1)))
        objects.append(evolve(thing, mesh=evolve(mesh, colors=_colors(rng, mesh)), cull=bool(rng.random() < 0.3)))
    scene = evolve(_scene_of(rng, objects), antialias=bool(rng.random() < 0.7))
    return _effects(rng, scene) if rng.random() < 0.2 else scene


def _contacts(rng: Rng) -> Scene:
    """Solids that touch one another, stand in one another, or have faces in the same place."""
    objects, look = [], _material(rng)
    y = 0.0
    for k in range(rng.integers(2, 5)):
        mesh = _box(rng.uniform(0.3, 1, 3) * 0.8**k)
        below = 0.0 if rng.random() < 0.6 else rng.uniform(0, 0.3)
        place = np.array([0.1 * rng.normal(), y + mesh.positions[:, 1].max() - below, 0.1 * rng.normal()])
        y = place[1] + mesh.positions[:, 1].max()
        objects.append(Object(evolve(mesh, colors=_colors(rng, mesh)), place, material=look, cull=rng.random() < 0.7))
    if rng.random() < 0.6:
        objects.append(evolve(_solid(rng, rng.uniform(0.4, 1)), position=rng.normal(size=3) * 0.4, material=look))
    if rng.random() < 0.3:
        # both sides of a surface, as some programs write them
        thing = objects[rng.integers(len(objects))]
        turned = evolve(thing.mesh, faces=thing.mesh.faces[:, ::-1], colors=_colors(rng, thing.mesh))
        objects.append(evolve(thing, mesh=turned, cull=bool(rng.random() < 0.5)))
    scene = evolve(_scene_of(rng, objects), antialias=bool(rng.random() < 0.7))
    if scene.lights and rng.random() < 0.5:
        scene = evolve(scene, lights=[evolve(scene.lights[0], shadow=True), *scene.lights[1:]])
    return scene


def _models(rng: Rng) -> Scene:
    """Real models, with the look that the command gives to files, and options of it."""
    icons = [piece.name for piece in built_in() if piece.dataset == "icons"]
    name = str(rng.choice(MODELS if rng.random() < 0.5 else icons))
    options: dict[str, Any] = {
        "size": int(rng.integers(48, 129)),
        "azimuth": rng.uniform(-180, 180),
        "elevation": rng.uniform(-60, 80),
        "antialias": bool(rng.random() < 0.8),
        "shading": str(rng.choice(["flat", "smooth", "smooth", "unlit"])),
        "margin": rng.uniform(0, 0.3),
    }
    if options["shading"] == "smooth" and rng.random() < 0.3:
        del options["shading"]
        options["crease"] = rng.uniform(20, 80)
    if options["shading" if "shading" in options else "crease"] != "unlit" and rng.random() < 0.4:
        options |= {"shadow": True, "ground": "tan"}
        options |= {"lights": Light.directional(toward=_direction(rng) + np.array([0, 1.2, 0]))}
    scene = load(name, **options)
    return _effects(rng, scene) if rng.random() < 0.25 else scene


#: Solids on a ground, or apart from one another.
LAYOUTS = ("stand", "thin", "contact", "through", "soup", "light inside", "outside", "open")


def _shadows(rng: Rng) -> Scene:
    """Objects in the shadows of one another, on a ground in most scenes."""
    layout = LAYOUTS[rng.integers(len(LAYOUTS))]
    objects: list[Object] = []

    def add(thing: Object, at: Any, rests: bool = False) -> float:
        turned = evolve(thing, position=at, rotation=rng.normal(size=4) if not rests else (0, 0, 0, 1))
        points = turned.position + rotate(turned.rotation, turned.scale * turned.mesh.positions)
        if rests:
            step = np.array([0, at[1] - points[:, 1].min(), 0])
            turned, points = evolve(turned, position=turned.position + step), points + step
        objects.append(turned)
        return float(points[:, 1].max())

    def anywhere(size: float, height: float) -> Array:
        return np.array([rng.normal() * size, rng.uniform(0, height), rng.normal() * size])

    if layout == "stand":
        for _ in range(rng.integers(1, 4)):
            add(_solid(rng, rng.uniform(0.5, 1.2)), anywhere(1.2, 0), rests=bool(rng.random() < 0.7))
    elif layout == "thin":
        for _ in range(rng.integers(3, 8)):
            stretch = [(0.03, 1, 0.03), (1, 0.02, 1)][rng.integers(2)]
            thing = _solid(rng, rng.uniform(0.5, 1.3))
            add(evolve(thing, mesh=evolve(thing.mesh, positions=thing.mesh.positions * stretch)), anywhere(1, 0.8))
    elif layout == "contact":
        y = 0.0
        for k in range(rng.integers(1, 4)):
            box = _painted(rng, _box(rng.uniform(0.4, 1, 3) * 0.8 ** (k + 1)))
            y = add(box, np.array([0.1 * rng.normal(), y, 0.1 * rng.normal()]), rests=True)
        add(_solid(rng, 0.6), np.array([1.3, 0, 0.3]), rests=True)
    elif layout == "through":
        for _ in range(rng.integers(2, 5)):
            add(_solid(rng, rng.uniform(0.6, 1.1)), anywhere(0.4, 0.8))
    elif layout == "soup":
        for mesh in (_soup(rng), _fan(rng))[: rng.integers(1, 3)]:
            add(_painted(rng, mesh, cull=False), anywhere(0.5, 1.5))
    elif layout == "light inside":
        for _ in range(rng.integers(3, 7)):
            a = rng.uniform(0, 2 * np.pi)
            add(_solid(rng, rng.uniform(0.3, 0.7)), np.array([1.5 * np.cos(a), rng.uniform(0, 1), 1.5 * np.sin(a)]))
    elif layout == "outside":
        add(_solid(rng, 0.8), np.zeros(3), rests=True)
        add(_solid(rng, 1.0), np.array([3.0, 2.0, 0.5]))
    else:
        side = int(rng.integers(1, 8))
        add(_painted(rng, _terrain(side, rng.uniform(0, side / 3, (side + 1, side + 1))), False), np.zeros(3))
        add(_solid(rng, rng.uniform(0.3, 0.8)), anywhere(0.6, 1.6))
    if rng.random() < 0.85:
        corners = [(-GROUND, 0, -GROUND), (-GROUND, 0, GROUND), (GROUND, 0, GROUND), (GROUND, 0, -GROUND)]
        fade = (3 * GROUND, 4 * GROUND) if rng.random() < 0.5 else (rng.uniform(0, 2), rng.uniform(2, 6))
        ground = Mesh(corners, [(0, 1, 2), (0, 2, 3)], _color(rng))
        objects.append(Object(ground, material=Material("flat", 0.4, 0.7, 0.0), fade=fade))
    elevation, azimuth, distance = np.radians(rng.uniform(8, 60)), rng.uniform(0, 2 * np.pi), rng.uniform(3, 7)
    eye = distance * _on_sphere(azimuth, elevation)
    perspective = rng.random() < 0.7
    camera = Camera(
        eye,
        np.array([0, 0.4, 0]) + 0.2 * rng.normal(size=3),
        projection="perspective" if perspective else "orthographic",
        half_height=1.9 / distance if perspective else rng.uniform(1.5, 2.5),
        near=0.05 if perspective else None,
    )
    toward = _on_sphere(rng.uniform(0, 2 * np.pi), np.radians(rng.choice([5, rng.uniform(15, 85)])))
    lamp = Light("directional", toward, _color(rng), shadow=True)
    if layout == "light inside":
        lamp = Light("point", [rng.normal() * 0.15, rng.uniform(0.5, 1.2), rng.normal() * 0.15], shadow=True)
    elif rng.random() < 0.4:
        lamp = Light("point", toward * rng.uniform(2.5, 6) + [0, 0.2, 0], shadow=True)
    elif rng.random() < 0.2:
        lamp = evolve(Light.spot(toward * 4, -toward, outer_angle=rng.uniform(15, 60)), shadow=True)
    lights = [lamp, *(_light(rng, objects[0]) for _ in range(rng.integers(0, 2)))]
    width, height = _canvas(rng)
    scene = Scene(objects, camera, lights, Background(_color(rng), _color(rng)), width=width, height=height)
    return _effects(rng, scene) if rng.random() < 0.3 else scene


def _cards(rng: Rng) -> Scene:
    """Textures with an alpha, cut off at some level or blended, on rectangles and boxes, before and behind solids."""
    objects = []
    for _ in range(rng.integers(1, 4)):
        width, height = rng.uniform(0.4, 1.2, 2)
        card = Mesh(
            [(-width, -height, 0), (width, -height, 0), (width, height, 0), (-width, height, 0)], [(0, 1, 2), (0, 2, 3)]
        )
        mesh, cull = (card, False) if rng.random() < 0.7 else (_box(rng.uniform(0.3, 1, 3)), True)
        thing = _with_texture(rng, evolve(_painted(rng, mesh, cull), position=0.5 * rng.normal(size=3)))
        texture = thing.material.texture
        assert texture is not None
        levels = np.array([0, 90, 170, 255])
        alpha = rng.choice(levels, texture.pixels.shape[:2]) if rng.random() < 0.5 else texture.pixels[..., 0]
        texture = evolve(texture, alpha=alpha, cutoff=int(rng.integers(2) * rng.integers(1, 256)))
        thing = evolve(
            thing, material=evolve(thing.material, texture=texture), rotation=rng.normal(size=4) * (1, 1, 1, 4)
        )
        objects.append(thing)
    objects.sort(key=lambda o: o.material.texture is not None and o.material.texture.cutoff == 0)
    objects = [_solid(rng, rng.uniform(0.3, 0.8)) for _ in range(rng.integers(0, 3))] + objects
    scene = evolve(_scene_of(rng, objects), antialias=bool(rng.random() < 0.7))
    return _effects(rng, scene) if rng.random() < 0.2 else scene


def _mixed(rng: Rng) -> Scene:
    """Any of these, with all else that a scene can have."""
    scene = (_plain, _glasses, _contacts, _shadows, _textures, _models)[rng.integers(6)](rng)
    objects = list(scene.objects)
    for i, thing in enumerate(objects):
        if thing.fade is None and rng.random() < 0.3:
            objects[i] = _with_texture(rng, thing) if rng.random() < 0.5 else evolve(thing, wireframe=True)
        if thing.fade is None and rng.random() < 0.3:
            objects[i] = evolve(objects[i], opacity=rng.uniform(0.1, 1))
    scene = evolve(scene, objects=objects, invert=bool(rng.random() < 0.2), antialias=True)
    return _effects(rng, scene) if rng.random() < 0.5 else scene


KINDS: dict[str, Callable[[Rng], Scene]] = {
    "plain": _plain,
    "antialiased": _antialiased,
    "effects": _effects,
    "textures": _textures,
    "glass": _glasses,
    "wires": _wires,
    "slivers": _slivers,
    "contacts": _contacts,
    "shadows": _shadows,
    "models": _models,
    "cards": _cards,
    "mixed": _mixed,
}
#: Kinds of tests/support/random_scenes.py: materials and numbers up to the bounds of the contracts.
EXTREMES: tuple[Kind, ...] = ("tame", "close")


# ---- objects ----


def _painted(rng: Rng, mesh: Mesh, cull: bool = True) -> Object:
    return Object(evolve(mesh, colors=_colors(rng, mesh)), material=_material(rng), cull=cull)


def _solid(rng: Rng, radius: float) -> Object:
    """A closed shape, culled."""
    made = (
        lambda: shapes.sphere(int(rng.integers(6, 20)), int(rng.integers(4, 10))),
        lambda: shapes.torus(thickness=rng.uniform(0.1, 0.4), across=int(rng.integers(6, 24)), down=7),
        lambda: shapes.torus_knot(),
        lambda: shapes.icosphere(int(rng.integers(0, 3))),
        lambda: _box(rng.uniform(0.3, 1, 3)),
        lambda: shapes.dodecahedron(),
    )
    mesh = made[rng.choice(6, p=[0.25, 0.2, 0.05, 0.1, 0.3, 0.1])]()
    if signed_volume(mesh) < 0:
        mesh = evolve(mesh, faces=mesh.faces[:, ::-1])
    return evolve(_painted(rng, mesh), scale=radius / float(np.linalg.norm(mesh.positions, axis=1).max()))


def _triangles(corners: Array) -> Mesh:
    """A mesh of (n, 3, 3) corners."""
    return Mesh(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))


def _fan(rng: Rng) -> Mesh:
    """Long thin triangles around a point."""
    sides = int(rng.integers(3, 200))
    angles = np.sort(rng.uniform(0, 2 * np.pi, sides))
    rim = np.stack([np.cos(angles), np.sin(angles), rng.uniform(-0.2, 0.2, sides)], axis=1)
    numbers = np.arange(sides) + 1
    return Mesh(np.vstack([np.zeros(3), rim]), np.stack([0 * numbers, numbers, np.roll(numbers, -1)], axis=1))


def _on_sphere(azimuth: float, elevation: float) -> Array:
    level = np.cos(elevation)
    return np.array([level * np.cos(azimuth), np.sin(elevation), level * np.sin(azimuth)])


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
    if rng.random() < 0.2:
        return int(rng.integers(16, 160)), int(rng.integers(16, 160))
    size = int(rng.integers(48, 129))
    return size, size


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
    return _triangles(centers + rng.normal(size=(count, 3, 3)) * 2.0 ** -rng.uniform(0, 4, (count, 1, 1)))


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
