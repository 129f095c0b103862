"""Random scenes: every feature of the renderer, mixed, on small canvases; and random calls that are wrong."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from conformance.world import World, before_camera, project
from shackled.scene import (
    Background,
    Camera,
    Fog,
    Hemisphere,
    Light,
    Material,
    Mesh,
    Object,
    Rectangle,
    Rim,
    Scene,
    Texture,
    Tone,
    rotate,
    vertex_normals,
)
from shackled.scene._object import Shading
from shackled.scene._texture import FILTERS, WRAPS

Array = NDArray[np.float64]
Rng = np.random.Generator

#: Tame: everything is before the camera and near the canvas. Close: around the camera, through the near plane and far
#: beyond the borders. Wild: of any size and place that the contract takes.
Kind = Literal["tame", "close", "wild"]
KINDS: tuple[Kind, ...] = ("tame", "close", "wild")


@dataclass(frozen=True)
class Case:
    """A scene that can be encoded as it is: in the ranges of the contract, with whole coordinates; and a part of it."""

    scene: Scene
    tile: Rectangle


#: How often a scene is taken as it comes, whether or not anything is seen; and how many are tried otherwise.
AS_IT_COMES = 0.02
TRIALS = 60
#: How often a scene is antialiased.
ANTIALIASED = 0.3
#: How often a scene has effects, and how often it then has each of them.
EFFECTS, EACH_EFFECT = 0.25, 0.5
#: How often a scene has textures.
TEXTURED = 0.2
#: How often a scene has objects whose vertices have opacities.
SEEN_THROUGH = 0.12
#: How often objects of a scene emit light.
EMITTING = 0.08
#: How often a light of a scene casts shadows, and how often there is a ground then.
SHADOWED, GROUNDED = 0.08, 0.5
#: Of canvases of more pixels one in so many may have effects, each fragment of which is computed by itself.
MANY_PIXELS, FEW = 4096, 5


def random_case(seed: int, kinds: tuple[Kind, ...] = KINDS) -> Case:
    """The case of one seed. Something is seen in nearly all."""
    rng = np.random.default_rng(seed)
    kind = kinds[rng.integers(len(kinds))]
    trials = 1 if rng.random() < AS_IT_COMES else TRIALS
    scenes = (_scene(rng, kind) for _ in range(trials))
    scene = next((each for each in scenes if is_anything_seen(each)), None) or _scene(rng, kind)
    x, y = int(rng.integers(scene.width)), int(rng.integers(scene.height))
    tile = Rectangle(x, y, int(rng.integers(1, scene.width - x + 1)), int(rng.integers(1, scene.height - y + 1)))
    # from numbers of its own, so that the scenes of the seeds stay what they are
    antialias = bool(np.random.default_rng([seed, 3]).random() < ANTIALIASED)
    scene = evolve(scene, antialias=antialias)
    if scene.width * scene.height > MANY_PIXELS and seed % FEW:
        return Case(scene, tile)
    scene = evolve(scene, **_effects(np.random.default_rng([seed, 4]), scene))
    scene = _textured(np.random.default_rng([seed, 8]), scene)
    scene = _shadowed(np.random.default_rng([seed, 16]), scene)
    scene = _emitting(np.random.default_rng([seed, 10]), scene)
    scene = _seen_through(np.random.default_rng([seed, 9]), scene)
    scene = _two_sided(np.random.default_rng([seed, 11]), scene)
    return Case(_with_alpha(np.random.default_rng([seed, 12]), scene), tile)


def _effects(rng: Rng, scene: Scene) -> dict[str, Any]:
    """Some effects or none, by the names of their fields; fog is most often about an object."""
    if rng.random() > EFFECTS:
        return {}
    depth = 1000.0
    if scene.objects:
        seen = scene.objects[rng.integers(len(scene.objects))]
        depth = float(np.linalg.norm(seen.position - scene.camera.eye))
    depth *= 2.0 ** float(rng.choice([0, rng.uniform(-20, 20)], p=[0.8, 0.2]))
    near = 0.0 if rng.random() < 0.2 else float(_q32(min(depth * rng.uniform(0, 1.5), 2.0**25)))
    far = float(_q32(min(near + max(depth * 2.0 ** rng.uniform(-8, 1), 2.0**-26), 2.0**26)))
    exposures = [1.0, rng.uniform(0, 4), 64.0, 2.0**-16]
    effects = {
        "hemisphere": Hemisphere(_color(rng), _color(rng)),
        "rim": Rim(_color(rng), int(rng.integers(1, 17))),
        "fog": Fog(_color(rng), near, far),
        "tone": Tone(
            float(rng.choice(exposures, p=[0.3, 0.6, 0.05, 0.05])), bool(rng.random() < 0.5), bool(rng.random() < 0.5)
        ),
    }
    return {name: effect for name, effect in effects.items() if rng.random() < EACH_EFFECT}


def _textured(rng: Rng, scene: Scene) -> Scene:
    """The scene, sometimes with textures on some of its objects."""
    if rng.random() >= TEXTURED:
        return scene
    objects = [_with_texture(rng, o) if rng.random() < 0.8 else o for o in scene.objects]
    return evolve(scene, objects=objects)


def _with_texture(rng: Rng, o: Object) -> Object:
    """The object with a texture of any format, on coordinates of any size."""
    height, width = rng.integers(1, 20, 2).tolist()
    colors = int(rng.choice([1, 2, 3, 5, 16, 17, 400]))
    palette = rng.integers(0, 256, (colors, 3), dtype=np.uint8)
    texture = Texture(
        palette[rng.integers(0, colors, (height, width))],
        FILTERS[rng.integers(len(FILTERS))],
        WRAPS[rng.integers(len(WRAPS))],
    )
    uvs = rng.uniform(-1, 1, (len(o.mesh.positions), 2)) * rng.choice([0.3, 1, 3, 127])
    if rng.random() < 0.3:
        uvs = np.rint(uvs)
    return evolve(o, mesh=evolve(o.mesh, uvs=uvs), material=evolve(o.material, texture=texture))


def _emitting(rng: Rng, scene: Scene) -> Scene:
    """The scene, sometimes with some of its objects emitting light."""
    if rng.random() >= EMITTING:
        return scene
    emissions = [_color(rng) if rng.random() < 0.8 else (0, 0, 0) for _ in scene.objects]
    pairs = zip(scene.objects, emissions, strict=True)
    return evolve(scene, objects=[evolve(o, material=evolve(o.material, emission=each)) for o, each in pairs])


def _two_sided(rng: Rng, scene: Scene) -> Scene:
    """The scene, in which some objects have two sides."""
    return evolve(scene, objects=[evolve(o, two_sided=bool(rng.random() < 0.3)) for o in scene.objects])


def _with_alpha(rng: Rng, scene: Scene) -> Scene:
    """The scene, in which some textures have an alpha, as a mask or blended."""
    objects = []
    for o in scene.objects:
        texture = o.material.texture
        if texture is not None and rng.random() < 0.3:
            alpha = rng.choice(np.array([0, 255, int(rng.integers(256))]), texture.pixels.shape[:2])
            cutoff = int(rng.integers(2) * rng.integers(1, 256))
            o = evolve(o, material=evolve(o.material, texture=evolve(texture, alpha=alpha, cutoff=cutoff)))
        objects.append(o)
    return evolve(scene, objects=objects)


def _seen_through(rng: Rng, scene: Scene) -> Scene:
    """The scene, sometimes with opacities of the vertices of some of its objects."""
    if rng.random() >= SEEN_THROUGH:
        return scene
    objects = [_with_opacities(rng, o) if rng.random() < 0.8 else o for o in scene.objects]
    return evolve(scene, objects=objects)


def _with_opacities(rng: Rng, o: Object) -> Object:
    opacities = rng.random(len(o.mesh.positions))
    if rng.random() < 0.3:
        opacities = np.rint(opacities)
    if rng.random() < 0.3:
        opacities = 0.5 + opacities / 3
    return evolve(o, mesh=evolve(o.mesh, opacities=opacities))


def _shadowed(rng: Rng, scene: Scene) -> Scene:
    """The scene, sometimes with a light that casts shadows, which may be on a ground."""
    if rng.random() >= SHADOWED or not scene.lights:
        return scene
    which = int(rng.integers(len(scene.lights)))
    lights = [evolve(light, shadow=number == which) for number, light in enumerate(scene.lights)]
    objects = list(scene.objects)
    if objects and rng.random() < GROUNDED:
        objects.append(_ground(rng, objects[rng.integers(len(objects))]))
    return evolve(scene, lights=lights, objects=objects)


def _ground(rng: Rng, o: Object) -> Object:
    """A square that fades, below an object or through it."""
    size = o.scale * float(np.abs(o.mesh.positions).max())
    radius = min(max(size * 2.0 ** rng.uniform(0, 6), 2.0**-10), 2.0**22)
    corners = np.array([(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)]) * 1000
    return Object(
        Mesh(corners, [(0, 1, 2), (0, 2, 3)], rng.integers(0, 256, (4, 3))),
        position=_inside(o.position - np.array([0, size * rng.uniform(0, 1.5), 0])),
        scale=float(_q32(min(radius / 1000, 2.0**12))),
        material=Material("flat", ambient=0.5, diffuse=0.5, specular=0.0),
        cull=False,
        fade=tuple(_q32(radius * np.array([rng.uniform(0, 0.9), 1]))),
    )


def _scene(rng: Rng, kind: Kind) -> Scene:
    width, height = _canvas(rng)
    objects = [_object(rng, kind) for _ in range(rng.choice([0, 1, 2, 3], p=[0.02, 0.68, 0.2, 0.1]))]
    return Scene(
        objects=objects,
        camera=_camera(rng, kind, objects),
        lights=[_light(rng, kind, objects) for _ in range(rng.choice(5, p=[0.1, 0.5, 0.2, 0.1, 0.1]))],
        background=Background(_color(rng), _color(rng) if rng.random() < 0.5 else None),
        ambient_light=(255, 255, 255) if rng.random() < 0.5 else _color(rng),
        invert=bool(rng.random() < 0.2),
        width=width,
        height=height,
    )


def plain(scene: Scene) -> Scene:
    """The scene without anti-aliasing, effects, textures, opacities of vertices, shadows and grounds."""
    objects = [
        evolve(o, mesh=evolve(o.mesh, opacities=None), material=evolve(o.material, texture=None))
        for o in scene.objects
        if o.fade is None
    ]
    lights = [evolve(light, shadow=False) for light in scene.lights]
    return evolve(
        scene, objects=objects, lights=lights, antialias=False, hemisphere=None, rim=None, fog=None, tone=None
    )


#: Weights of the corners of a triangle: its middle, and places near corners and edges.
PLACES = ((1, 1, 1), (8, 1, 1), (1, 8, 1), (1, 1, 8), (8, 8, 1), (8, 1, 8), (1, 8, 8))

#: Places in a pixel: its centre, and one of its four samples.
CENTER, SAMPLE = (0.5, 0.5), (0.375, 0.125)


def is_anything_seen(scene: Scene) -> bool:
    """Whether a ray through one of a few pixels meets the triangle on which that pixel was chosen.

    One has to do so through the centre of its pixel, and one through a sample.
    """
    world = before_camera(evolve(scene, objects=[evolve(o, wireframe=False) for o in scene.objects]))
    with np.errstate(all="ignore"):
        return all(any(_meets(world, weights, place) for weights in PLACES) for place in (CENTER, SAMPLE))


def _meets(world: World, weights: tuple[int, int, int], place: tuple[float, float]) -> bool:
    """Whether for any triangle the ray through a place of the pixel of a point of it, by its weights, meets it."""
    corners = world.corners
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    point = np.einsum("nij,i->nj", corners, np.array(weights) / sum(weights))
    pixel = np.floor(project(world, point))
    on_canvas = ((pixel >= 0) & (pixel < [world.width, world.height])).all(axis=1)
    plane = (pixel + place - np.array([world.width, world.height]) / 2) * [1, -1] / world.focal
    way = np.column_stack([plane * world.perspective, np.full(len(plane), -1.0)])
    start = np.column_stack([plane * (not world.perspective), np.zeros(len(plane))])
    slope = (way * normals).sum(axis=1)
    distance = ((corners[:, 0] - start) * normals).sum(axis=1) / slope
    hit = (start + distance[:, None] * way)[:, None] - corners
    turns = (np.cross(np.roll(corners, -1, axis=1) - corners, hit) * normals[:, None]).sum(axis=2)
    met = (turns > 0).all(axis=1) & (distance >= world.near) & ((slope < 0) | ~world.culled)
    return bool((on_canvas & met).any())


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


def _canvas(rng: Rng) -> tuple[int, int]:
    choice = rng.random()
    if choice < 0.05:
        return int(rng.integers(1, 4)), int(rng.integers(1, 200))
    if choice < 0.1:
        return int(rng.integers(1, 200)), int(rng.integers(1, 4))
    if choice < 0.13:
        return int(rng.integers(100, 300)), int(rng.integers(60, 160))
    if choice < 0.16:
        return int(rng.integers(300, 1025)), int(rng.integers(1, 60))
    return int(rng.integers(1, 64)), int(rng.integers(1, 64))


def _camera(rng: Rng, kind: Kind, objects: list[Object]) -> Camera:
    """A camera that looks toward one of the objects, from about where it fills the picture."""
    center, size = np.zeros(3), 1000.0
    if objects:
        seen = objects[rng.integers(len(objects))]
        center = np.asarray(seen.position)
        size = max(seen.scale * float(np.abs(seen.mesh.positions).max()), 2.0**-16)
    perspective = rng.random() < 0.65
    if kind == "tame":
        distance = 3000.0 + 2 * size
    elif kind == "close":
        distance = size * rng.uniform(0, 3)
    else:
        distance = size * 2.0 ** rng.uniform(-4, 4)
    far = rng.random() < 0.1
    if far:
        distance = min(size * 2.0 ** rng.uniform(4, 12), 2.0**25)
    if rng.random() < 0.3:
        # the numbers of an ordinary scene, with all their zeros
        eye, target, up = center + np.array([0, 0, distance]), center, np.array([0.0, 1.0, 0.0])
    else:
        eye, up = center + distance * _direction(rng), _direction(rng)
        target = center + rng.normal(size=3) * size * 0.1
    if perspective:
        half_height = 1 / 2.145 if rng.random() < 0.5 else rng.uniform(0.3, 1.5)
        near = distance * 2.0 ** -rng.uniform(5, 10)
        if far:
            half_height = size / distance * rng.uniform(0.5, 2)
            near = distance - size * rng.uniform(0.5, 2) if rng.random() < 0.5 else near
        elif kind != "tame" and rng.random() < 0.5:
            near = distance * 2.0 ** rng.uniform(-4, 0.5)
    else:
        half_height = size * rng.uniform(0.5, 3)
        near = -(2.0**26) if rng.random() < 0.5 else distance - 2 * size
        if kind != "tame" and rng.random() < 0.5:
            near = distance + size * rng.uniform(-1.5, 0.8)
    if kind == "wild" and rng.random() < 0.3:
        half_height = _spread(rng, -10, 10) if perspective else _spread(rng, -12, 26)
    if kind == "wild" and rng.random() < 0.3:
        near = _spread(rng, -32, 26) if perspective else _signed(rng, -20, 26)
    if kind == "wild" and rng.random() < 0.1:
        eye, target = _place(rng), _place(rng)
    near = min(max(near, 2.0**-32 if perspective else -(2.0**26)), 2.0**26)
    return Camera(
        tuple(_inside(eye)),
        tuple(_inside(target)),
        tuple(_q32(up)),
        "perspective" if perspective else "orthographic",
        float(_q32(np.clip(half_height, 2.0**-10 if perspective else 2.0**-12, 2.0**10 if perspective else 2.0**26))),
        float(_q32(near)),
    )


def _light(rng: Rng, kind: Kind, objects: list[Object]) -> Light:
    """Of any kind; a spot light most often points at an object."""
    light = _plain_light(rng, kind, objects)
    if light.kind != "point" or rng.random() > 0.3:
        return light
    toward = rng.normal(size=3)
    if objects and rng.random() < 0.8:
        toward = np.asarray(objects[rng.integers(len(objects))].position) - light.vector
        toward = toward * rng.choice([1, 1e-4]) + 0.1 * rng.normal(size=3) * np.abs(toward).max()
    toward = _q32(toward)
    outer = float(rng.choice([rng.uniform(0, 60), rng.uniform(0, 180), 180.0, 0.0], p=[0.6, 0.3, 0.05, 0.05]))
    inner = outer * float(rng.choice([0.0, rng.random(), 1.0]))
    direction = toward if toward.any() else (0, 0, -1)
    return evolve(light, kind="spot", direction=direction, inner_angle=inner, outer_angle=outer)


def _plain_light(rng: Rng, kind: Kind, objects: list[Object]) -> Light:
    color = (255, 255, 255) if rng.random() < 0.4 else _color(rng)
    if objects and rng.random() < 0.15:
        return Light("point", _on_surface(rng, objects[rng.integers(len(objects))]), color)
    if rng.random() < 0.5:
        length = 2.0 ** rng.uniform(-20, 20) if kind == "wild" else 1000.0
        return Light("directional", _q32(length * _direction(rng)), color)
    if kind == "wild" and rng.random() < 0.5:
        return Light("point", _place(rng), color)
    return Light("point", _q32(rng.normal(size=3) * 2.0 ** rng.uniform(4, 13)), color)


def _on_surface(rng: Rng, o: Object) -> Array:
    """A corner or another place of a face, or a little above it."""
    corners = o.mesh.positions[o.mesh.faces[rng.integers(o.mesh.triangles)]]
    weights = np.array([1, 0, 0]) if rng.random() < 0.3 else rng.dirichlet([1, 1, 1])
    above = rng.normal(size=3) * np.ptp(corners) * 2.0 ** rng.uniform(-12, -3) * (rng.random() < 0.5)
    return _inside(o.position + rotate(o.rotation, o.scale * (weights @ corners + above)))


def _object(rng: Rng, kind: Kind) -> Object:
    wide = rng.random() < 0.2
    # half the extent of a mesh, in its units
    extent = rng.choice([1, 2, 3, 5, 10, 100, 1000, 30000]) if not wide else 2**23 - 1
    mesh = _mesh(rng, float(extent))
    size = 2.0 ** rng.uniform(8, 11) if kind == "tame" else 2.0 ** rng.uniform(5, 14)
    scale = min(size / extent, 2.0**12)
    position = rng.normal(size=3) * (100 if kind == "tame" else 1000)
    if kind == "wild" and rng.random() < 0.5:
        scale = _spread(rng, -32, 4 if wide else 12) if rng.random() < 0.95 else 0.0
        if rng.random() < 0.5:
            position = _place(rng)
    shadings: tuple[Shading, ...] = ("unlit", "flat", "flat", "smooth", "smooth")
    bright = rng.random() < 0.25
    material = Material(
        shadings[rng.integers(len(shadings))],
        ambient=_coefficient(rng, bright),
        diffuse=_coefficient(rng, bright),
        specular=_coefficient(rng, bright),
        shininess=int(rng.choice([1, 2, 3, 5, 10, 20, 33, 64, 127, 128])),
    )
    return Object(
        mesh,
        position=_q32(position),
        rotation=(0, 0, 0, 1) if rng.random() < 0.3 else _q32(rng.normal(size=4)),
        scale=float(_q32(scale)),
        material=material,
        cull=bool(rng.random() < 0.6),
        wireframe=bool(rng.random() < 0.15),
        opacity=_opacity(rng),
    )


def _opacity(rng: Rng) -> float:
    if rng.random() < 0.8:
        return 1.0
    return float(rng.choice([rng.integers(1 << 24) / (1 << 24), 0.5, 0.0, 1 - 2.0**-24], p=[0.8, 0.1, 0.05, 0.05]))


def _mesh(rng: Rng, extent: float) -> Mesh:
    shapes = (soup_shape, box_shape, sphere_shape, patch_shape, fan_shape)
    positions, faces = shapes[rng.integers(len(shapes))](rng)
    positions = np.rint(positions * extent)
    if rng.random() < 0.05:
        # degenerate faces
        faces[rng.integers(len(faces))] = rng.integers(len(positions))
    if rng.random() < 0.5:
        faces = faces[:, ::-1] if rng.random() < 0.3 else faces[rng.permutation(len(faces))]
    choice = rng.random()
    colors = rng.integers(0, 256, (len(positions), 3))
    if choice < 0.15:
        colors[:] = 255
    elif choice < 0.35:
        colors[:] = colors[0]
    elif choice < 0.5:
        colors = np.where(colors < 128, 0, 255)
    elif choice < 0.6:
        colors = np.minimum(colors[:1] + colors // 8, 255)
    choice = rng.random()
    normals = None
    if choice < 0.2:
        normals = rng.normal(size=positions.shape)
    elif choice < 0.25:
        normals = np.zeros_like(positions)
    elif choice < 0.5:
        normals = vertex_normals(positions, faces) + 0.2 * rng.normal(size=positions.shape)
    return Mesh(positions, faces, colors, normals)


def soup_shape(rng: Rng) -> tuple[Array, NDArray[np.int64]]:
    """Triangles of many sizes, anywhere."""
    count = int(rng.integers(1, 30))
    centers = rng.uniform(-0.5, 0.5, (count, 1, 3))
    corners = centers + rng.uniform(-0.5, 0.5, (count, 3, 3)) * 2.0 ** -rng.uniform(0, 5, (count, 1, 1))
    return corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)


def box_shape(rng: Rng) -> tuple[Array, NDArray[np.int64]]:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * rng.uniform(0.2, 1, 3)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, np.array([(a, b, c) for a, b, c, _ in quads] + [(a, c, d) for a, _, c, d in quads])


def sphere_shape(rng: Rng) -> tuple[Array, NDArray[np.int64]]:
    rings, sides = int(rng.integers(3, 9)), int(rng.integers(3, 12))
    theta = np.pi * np.arange(rings + 1)[:, None] / rings
    phi = 2 * np.pi * np.arange(sides)[None] / sides
    points = np.stack([np.sin(theta) * np.cos(phi), np.cos(theta) + 0 * phi, np.sin(theta) * np.sin(phi)], axis=-1)
    return points.reshape(-1, 3), _grid(rings, sides, closed=True)


def patch_shape(rng: Rng) -> tuple[Array, NDArray[np.int64]]:
    """Hills, whose faces share their edges."""
    n, m = int(rng.integers(1, 8)), int(rng.integers(1, 8))
    points = np.empty((n + 1, m + 1, 3))
    points[..., 0] = np.linspace(-1, 1, n + 1)[:, None]
    points[..., 1] = rng.uniform(-0.3, 0.3, (n + 1, m + 1)) * rng.integers(0, 2)
    points[..., 2] = np.linspace(-1, 1, m + 1)[None]
    return points.reshape(-1, 3), _grid(n, m, closed=False)


def fan_shape(rng: Rng) -> tuple[Array, NDArray[np.int64]]:
    """Long thin triangles around a point."""
    sides = int(rng.integers(3, 40))
    angles = np.sort(rng.uniform(0, 2 * np.pi, sides))
    rim = np.stack([np.cos(angles), np.sin(angles), rng.uniform(-0.2, 0.2, sides)], axis=1)
    numbers = np.arange(sides) + 1
    return np.vstack([np.zeros(3), rim]), np.stack([np.zeros(sides, np.int64), numbers, np.roll(numbers, -1)], axis=1)


def _grid(rows: int, columns: int, closed: bool) -> NDArray[np.int64]:
    """Faces of rows of quadrangles, which meet again at the end if `closed`."""
    stride = columns if closed else columns + 1
    row, column = (part.ravel() for part in np.mgrid[:rows, :columns])
    following = (column + 1) % stride
    a, b = row * stride + column, row * stride + following
    c, d = a + stride, b + stride
    return np.vstack([np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)])


def _color(rng: Rng) -> tuple[int, int, int]:
    red, green, blue = rng.integers(0, 256, 3).tolist()
    return red, green, blue


def _coefficient(rng: Rng, bright: bool) -> float:
    return float(rng.choice([0, 1, rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 4) if bright else 0.5]))


def _direction(rng: Rng) -> Array:
    v = rng.normal(size=3)
    return np.asarray(v / np.linalg.norm(v))


def _place(rng: Rng) -> Array:
    """Anywhere in the space of the contract, near the middle as likely as far out."""
    return _inside(rng.choice([-1, 1], 3) * 2.0 ** rng.uniform(-33, 26.5, 3))


def _inside(v: Array) -> Array:
    """In the space of the contract."""
    return _q32(np.clip(v, -(2.0**26), 2.0**26))


def _spread(rng: Rng, low: float, high: float) -> float:
    """A power of two, sometimes one of the bounds."""
    return float(2.0 ** np.clip(rng.uniform(low - 1, high + 1), low, high))


def _signed(rng: Rng, low: float, high: float) -> float:
    return float(rng.choice([-1, 1])) * _spread(rng, low, high)


def _q32(values: Array | float) -> Array:
    """Rounded to what the contract takes."""
    return np.rint(np.asarray(values, np.float64) * 2.0**32) / 2.0**32
