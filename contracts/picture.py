"""The whole renderer in one file: what a picture of the contracts is, by its definition, in float64.

    python contracts/picture.py CALL PICTURE      the calldata of `render(Scene)`, and a .ppm file

It needs NumPy only and shares nothing with the package. The contracts compute the same numbers in integers, many of
them at once, and approximate some; this file computes each by itself, in the order of the stages: calldata, camera and
vertices, triangles, fragments, light, shadows. `docs/explain.md` walks through it; `docs/calling.md` describes the
bytes. Lengths are in units of the world, colours are 0..255, light is 0..1 and brighter.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace as Record
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Where samples lie in a pixel, from its centre, in pixels: one, or four with antialiasing.
CENTER, SAMPLES = np.zeros((1, 2)), np.array([(-1, -3), (3, -1), (-3, 1), (1, 3)]) / 8
SUBPIXELS = 256  # corners of triangles are rounded to these parts of a pixel
#: The fields `projection` and `shading`, the flags of an object, and the kinds of records.
PERSPECTIVE, POINT, UNLIT, FLAT, SMOOTH, CULL_BACKFACES, WIREFRAME, TWO_SIDED = 0, 1, 0, 1, 2, 1, 2, 4
SPOT, OPACITY, ANTIALIAS, HEMISPHERE, RIM, FOG, TONE, TEXTURE, OPACITIES, SHADOW, GROUND, EMISSION, ALPHA = range(1, 14)
GLASS = {OPACITY, OPACITIES, ALPHA}
#: Rules of a shadow: which faces of culled objects cast it.
ALL_FACES, TURNED_AWAY, TURNED_TOWARD = 1, 2, 3


def draw(call: bytes) -> NDArray[np.uint8]:
    """Return the pixels, (height, width, 3), rows from the top, of calldata of `render(Scene)`."""
    scene = read(call)
    height, width, count = scene.camera.height, scene.camera.width, len(scene.samples)
    background = scene.top + np.arange(height)[:, None] / max(height - 1, 1) * (scene.bottom - scene.top)
    colors = np.broadcast_to(background[:, None, None], (height, width, count, 3)).copy()
    nearness, shadow = np.full((height, width, count), -np.inf), Shadow(scene)
    # translucent objects after the others, each as one layer: of an object, a sample shows the nearest surface only
    for solid in sorted(scene.objects, key=lambda each: each.is_glass):
        layer = np.zeros((height, width, count, 4))
        for triangle in triangles(solid, scene.camera, count > 1):
            fill(scene, solid, shadow, triangle, nearness, layer)
        colors += layer[..., 3:] * (layer[..., :3] - colors)
    picture = colors.mean(axis=2)
    return np.asarray(np.floor((255 - picture if scene.invert else picture) + 0.5), np.uint8)


# ---- calldata ----


def read(call: bytes) -> Record:
    """Return the scene of calldata of `render(Scene)`; raise ValueError if it is cut off. Other checks are not made."""
    data = call[4:]

    def part(at: int, size: int) -> bytes:
        if not 0 <= at <= at + size <= len(data):
            raise ValueError(f"not the calldata of render(Scene): it has no {size} bytes at {at + 4}")
        return data[at : at + size]

    def words(at: int, count: int) -> list[int]:
        return [int.from_bytes(part(place, 32), "big", signed=True) for place in range(at, at + 32 * count, 32)]

    def content(at: int) -> bytes:
        return part(at + 32, *words(at, 1))

    (scene,) = words(0, 1)
    width, height, *view, projection, half_height, near, top, bottom, invert, ambient = words(scene, 18)
    lights, objects, extensions = (scene + offset for offset in words(scene + 32 * 18, 3))
    records = dict(records_of(content(extensions)))
    effects = {kind: record for (kind, _), record in records.items()}
    lamps = []
    for i in range(*words(lights, 1)):
        kind, *vector, color = words(lights + 32 + 160 * i, 5)
        # of a spot light: its axis, and the cosines between which it fades
        cone = q32(np.frombuffer(records[SPOT, i], ">i8")) if (SPOT, i) in records else None
        shadow = records.get((SHADOW, i), b"\0")[-1]
        lamps.append(Record(is_point=kind == POINT, vector=q32(vector), color=rgb(color), cone=cone, shadow=shadow))
    solids = []
    for i, offset in enumerate(words(objects + 32, *words(objects, 1))):
        mesh, *fields = words(objects + 32 + offset, 15)
        own = {kind: record for (kind, j), record in records.items() if j == i and kind not in (SPOT, SHADOW)}
        solids.append(object_of(content(objects + 32 + offset + mesh), fields, own))
    tone, rim, fog = effects.get(TONE, bytes([0, 1, 0, 0, 0])), effects.get(RIM, bytes([0, 0, 0, 1])), effects.get(FOG)
    return Record(
        camera=Camera(q32(view), projection, half_height / 2**32, near / 2**32, width, height),
        top=rgb(top), bottom=rgb(bottom), invert=invert == 1, ambient_light=rgb(ambient), lights=lamps, objects=solids,
        shadow_light=next((lamp for lamp in lamps if lamp.shadow), None),
        samples=SAMPLES if any(kind >= ANTIALIAS for kind in effects) else CENTER,
        has_effects=any(kind > ANTIALIAS for kind in effects),
        hemisphere=np.reshape([*effects.get(HEMISPHERE, bytes(6))], (2, 3)), rim=np.array([*rim[:3]]), rim_power=rim[3],
        fog=None if fog is None else (np.array([*fog[:3]]), *q32(np.frombuffer(fog[3:], ">i8"))),
        exposure=int.from_bytes(tone[:4], "big") / 2**16, filmic=bool(tone[4] & 1), gamma=bool(tone[4] & 2),
    )  # fmt: skip


def records_of(data: bytes) -> Iterator[tuple[tuple[int, int], bytes]]:
    """Yield kind and index of records, and their content, whose size is in bytes, or in words for later kinds."""
    while data:
        size = int.from_bytes(data[3:5], "big") * (1 if data[0] < TEXTURE else 32)
        yield (data[0], int.from_bytes(data[1:3], "big")), data[5 : 5 + size]
        data = data[5 + size :]


def object_of(mesh: bytes, fields: list[int], records: dict[int, bytes]) -> Record:
    """Return an object: its mesh, vertices and faces, placed in the world; its material, and what its records say."""
    kind, count, size = mesh[0], int.from_bytes(mesh[1:3], "big"), 3 if mesh[0] & 2 else 2
    rows = np.frombuffer(mesh, f"({3 * size + 3 + 4 * (kind & 1)},)u1", count, 5)  # a vertex each
    *place, scale, shading, ambient, diffuse, specular, shininess, flags = fields
    position, matrix = q32(place[:3]), rotation(q32(place[3:]))
    local = numbers(rows[:, : 3 * size].reshape(count, 3, size))
    packed = np.ascontiguousarray(rows[:, -4:]).view(">u4").astype(np.int64)
    normals = (np.hstack([packed >> 22, packed >> 12, packed >> 2]) & 1023 ^ 512) - 512.0 if kind & 1 else 0 * local
    opacities = np.full(count, int.from_bytes(records.get(OPACITY, bytes([1, 0, 0, 0])), "big") / 2**24)
    if OPACITIES in records:
        opacities *= np.frombuffer(records[OPACITIES], np.uint8)[:count] / 255
    texture, uvs = texture_of(records[TEXTURE], count) if TEXTURE in records else (None, np.zeros((count, 2)))
    if texture is not None and ALPHA in records:
        texture.alpha, texture.cutoff = texture_of(records[ALPHA][1:], 0)[0].texels[..., 2:], records[ALPHA][0]
    fades = GROUND in records and not records.keys() & {OPACITY, OPACITIES}  # between two distances from its position
    fade = q32(np.frombuffer(records[GROUND][:16], ">i8")) if fades else None
    return Record(
        points=position + local @ matrix.T * (scale / 2**32), colors=rows[:, 3 * size : 3 * size + 3].astype(float),
        normals=normals @ matrix.T, faces=np.frombuffer(mesh, ">u2", -1, 5 + rows.size).astype(np.int64).reshape(-1, 3),
        position=position, shading=shading, ambient=ambient / 2**32, diffuse=diffuse / 2**32, specular=specular / 2**32,
        shininess=shininess, culls=bool(flags & CULL_BACKFACES), is_wire=bool(flags & WIREFRAME),
        two_sided=bool(flags & TWO_SIDED), opacities=opacities, uvs=uvs, texture=texture,
        fade=fade, emission=rgb(int.from_bytes(records.get(EMISSION, b""), "big")),
        is_glass=bool(records.keys() & GLASS), is_opaque=not records.keys() & {*GLASS, GROUND},
    )  # fmt: skip


def texture_of(data: bytes, count: int) -> tuple[Record, Array]:
    """Return a texture, of colours or of numbers of colours in a palette, and the coordinates of `count` vertices."""
    flags, width, height, bits = data[0], data[1] + 1, data[2] + 1, data[3]
    begin = 4 + (3 << bits if bits <= 8 else 0)
    size = (width * height * bits + 7) // 8
    texels = np.frombuffer(data, np.uint8, size, begin)
    if bits <= 8:
        digits = np.unpackbits(texels)[: width * height * bits].reshape(-1, bits)
        texels = np.frombuffer(data, np.uint8, 3 << bits, 4).reshape(-1, 3)[digits @ (1 << np.arange(bits)[::-1])]
    uvs = numbers(np.frombuffer(data, np.uint8, 6 * count, begin + size).reshape(count, 2, 3)) / 2**16
    image = texels.reshape(height, width, 3).astype(float)
    return Record(texels=image, alpha=None, cutoff=0, bilinear=bool(flags & 1), clamps=bool(flags & 2)), uvs


def numbers(data: NDArray[np.uint8]) -> Array:
    """Return signed numbers from their bytes, the last axis."""
    size = data.shape[-1]
    values = data.astype(np.int64) @ (1 << 8 * np.arange(size)[::-1])
    return np.asarray((values ^ 1 << 8 * size - 1) - (1 << 8 * size - 1), float)


def q32(values: ArrayLike) -> Array:
    """Return fixed-point numbers of 32 bits after the binary point."""
    return np.array(values, float) / 2**32


def rgb(color: int) -> Array:
    """Return red, green and blue of 0xRRGGBB."""
    return np.array([color >> 16, color >> 8 & 255, color & 255], float)


# ---- camera and vertices ----


class Camera:
    """In its space, x points right, y down as rows do, and z forward: the distance."""

    def __init__(self, view: Array, projection: int, half_height: float, near: float, width: int, height: int) -> None:
        """Find the axes. view: (9,), the eye, the target, and what is up; half_height: of the view, at distance 1."""
        self.eye, target, up = view.reshape(3, 3)
        back = unit(self.eye - target)
        right = unit(np.cross(unit(up), back))
        self.axes = np.array([right, -np.cross(back, right), -back])
        self.is_perspective, self.near, self.width, self.height = projection == PERSPECTIVE, near, width, height
        self.center, self.focal = np.array([width, height]) / 2, height / 2 / half_height

    def seen(self, points: Array) -> Array:
        """Return points of the world in the space of the camera."""
        return np.asarray((points - self.eye) @ self.axes.T)

    def project(self, seen: Array) -> Array:
        """Return columns and rows (..., 2) in pixels, rounded."""
        on_screen = self.center + self.focal * seen[..., :2] / (seen[..., 2:] if self.is_perspective else 1)
        return np.floor(SUBPIXELS * on_screen + 0.5) / SUBPIXELS

    def nearness(self, seen: Array) -> Array:
        """Return what is linear on the screen, and larger where a point is nearer."""
        return np.asarray(1 / seen[..., 2] if self.is_perspective else -seen[..., 2])

    def toward(self, points: Array) -> Array:
        """Return the ways (..., 3) from points to the eye."""
        return self.eye - points if self.is_perspective else np.broadcast_to(-self.axes[2], points.shape)


# ---- triangles ----


def triangles(solid: Record, camera: Camera, antialias: bool) -> Iterator[Record]:
    """Yield what of the faces is beyond the near plane and not culled, counter-clockwise as it is seen.

    face: (3,) numbers of vertices. weights: (3, 3) of these for each corner. screen: (3, 2) in pixels.
    """
    drawn: set[Any] = set()
    for face in solid.faces:
        corners = camera.seen(solid.points[face])
        for weights in clipped(corners[:, 2] - camera.near):
            seen = weights @ corners
            screen, near = camera.project(seen), camera.nearness(seen)
            area = cross(screen[1] - screen[0], screen[2] - screen[0])
            is_back = bool(area > 0)  # rows run down
            if area == 0 or (solid.culls and is_back):
                continue
            order = [0, 2, 1] if is_back and not solid.is_wire else [0, 1, 2]
            made = Record(face=face, weights=weights[order], screen=screen[order], near=near[order], is_back=is_back)
            yield from wires(made, antialias, drawn) if solid.is_wire else [made]


def clipped(beyond: Array) -> Iterator[Array]:
    """Yield the parts of a face where `beyond`, (3,) at its corners, is not negative, as weights (3, 3) of them."""
    polygon = []
    for i, j in ((0, 1), (1, 2), (2, 0)):
        if beyond[i] >= 0:
            polygon.append(np.eye(3)[i])
        if (beyond[i] >= 0) != (beyond[j] >= 0):
            part = beyond[i] / (beyond[i] - beyond[j])
            polygon.append((1 - part) * np.eye(3)[i] + part * np.eye(3)[j])
    yield from (np.array([polygon[0], *pair]) for pair in pairwise(polygon[1:]))


def wires(made: Record, antialias: bool, drawn: set[Any]) -> Iterator[Record]:
    """Yield the edges of a face, each a strip of one pixel, as two triangles; an edge that several faces share once."""
    for i, j in ((0, 1), (1, 2), (2, 0)):
        way, edge = made.screen[j] - made.screen[i], frozenset([tuple(made.screen[i]), tuple(made.screen[j])])
        # along an edge of the face, and not of the cut, the weight of one corner is zero
        is_edge = ((made.weights[i] == 0) & (made.weights[j] == 0)).any()
        if not is_edge or not way.any() or edge in drawn:
            continue
        drawn.add(edge)
        if antialias:
            aside = np.array([-way[1], way[0]]) / np.hypot(*way) / 2
        else:  # one pixel in each column, or in each row
            aside = np.array([0, 0.5] if abs(way[0]) >= abs(way[1]) else [0.5, 0])
        ends = np.array([i, i, j, j])
        strip = made.screen[ends] + np.outer([-1, 1, 1, -1], aside)
        for part in ([0, 1, 2], [0, 2, 3]):
            turn = part if cross(*(strip[part[1:]] - strip[part[0]])) < 0 else part[::-1]
            own = ends[turn]
            near = made.near[own]
            yield Record(face=made.face, weights=made.weights[own], screen=strip[turn], near=near, is_back=False)


# ---- fragments ----


def fill(scene: Record, solid: Record, shadow: Shadow, triangle: Record, nearness: Array, layer: Array) -> None:
    """Draw a triangle into `layer`, colours and opacities of samples, where it covers them and is nearest."""
    screen, near, samples, size = triangle.screen, triangle.near, scene.samples, nearness.shape[1::-1]
    low = np.clip(np.floor(screen.min(axis=0) - 1), 0, size).astype(int)
    high = np.clip(np.ceil(screen.max(axis=0) + 1), 0, size).astype(int)
    window = np.s_[low[1] : high[1], low[0] : high[0]]
    y, x = np.mgrid[window]
    centers = np.stack([x, y], axis=-1)[..., None, :] + 0.5
    edges = edge_functions(screen, centers + samples)
    way = np.roll(screen, 1, 0) - np.roll(screen, -1, 0)
    # what lies on an edge belongs to the triangle for which it is a left or a top edge
    owns = (way[:, 1] > 0) | ((way[:, 1] == 0) & (way[:, 0] < 0))
    covers = ((edges > 0) | ((edges == 0) & owns)).all(axis=-1)
    area = edge_functions(screen, screen[0]).sum()
    depth = edges @ near / area
    if triangle.is_back:  # a front face in the same place is seen: the back is deeper by its change over 1/64 pixel
        along = edge_functions(screen, np.array([[0.0, 0], [1, 0], [0, 1]])) @ near / area
        depth -= np.abs(along[1:] - along[0]).sum() / 64
    visible = covers & (depth > nearness[window])
    pixels = visible.any(axis=-1)
    if not pixels.any():
        return
    # the colour is computed once for each pixel, in the middle of the samples that the triangle covers
    covered = covers[pixels]
    middle = centers[pixels][:, 0] + covered @ samples / covered.sum(axis=1, keepdims=True)
    weights = weights_at(scene.camera, triangle, middle)
    lit, dark, opacity = shade(scene, solid, np.broadcast_to(triangle.face, weights.shape), weights)
    color = np.broadcast_to(lit[:, None], (*covered.shape, 3))
    if shadow.light is not None and solid.shading != UNLIT and not solid.is_wire:
        places = (centers[pixels] + samples).reshape(-1, 2)
        at = weights_at(scene.camera, triangle, places) @ solid.points[triangle.face]
        color = np.where(shadow.on(at).reshape(covered.shape)[..., None], dark[:, None], color)
    # a texel of alpha 0 hides nothing; a vertex of opacity 0 hides what is behind it in its own object, or drawn later
    shown = visible[pixels] & ((opacity > 0) | (solid.texture is None))[:, None]
    new = np.concatenate([color, np.broadcast_to(opacity[:, None, None], (*covered.shape, 1))], axis=-1)
    layer[window][pixels] = np.where(shown[..., None], new, layer[window][pixels])
    nearness[window][pixels] = np.where(shown, depth[pixels], nearness[window][pixels])


def edge_functions(screen: Array, at: Array) -> Array:
    """Return (..., 3) how far places are within the edge across from each corner, times the length of the edge."""
    begin, end = np.roll(screen, -1, 0), np.roll(screen, 1, 0)
    return -cross(end - begin, at[..., None, :] - begin)


def weights_at(camera: Camera, triangle: Record, places: Array) -> Array:
    """Return the weights (n, 3) of the vertices of the face at places (n, 2), right in perspective."""
    edges = edge_functions(triangle.screen, places) * (triangle.near if camera.is_perspective else 1)
    return np.asarray(edges / edges.sum(axis=-1, keepdims=True) @ triangle.weights)


# ---- light ----


def shade(scene: Record, solid: Record, faces: Integers, weights: Array) -> tuple[Array, Array, Array]:
    """Return the colours (n, 3) of points with all lights, and without that which casts shadows; and opacities (n,).

    faces, weights: (n, 3), the vertices of the face of each point, and their weights.
    """
    point, base, opacity = surface(solid, faces, weights)
    if solid.shading == UNLIT:
        lit = dark = light(scene, base)
    else:
        normal, view = normals(scene, solid, faces, weights), unit(scene.camera.toward(point))
        cosines = [cosines_of(lamp, point, normal, view) for lamp in scene.lights]
        lit, dark = radiance(scene, solid, base, normal, dot(normal, view), cosines)
    return colored(scene, solid, lit, point), colored(scene, solid, dark, point), opacity


def surface(solid: Record, faces: Integers, weights: Array) -> tuple[Array, Array, Array]:
    """Return points of the world (n, 3), their own colours (n, 3) and opacities (n,)."""
    point, base = mix(solid.points[faces], weights), mix(solid.colors[faces], weights)
    opacity = np.clip(mix(solid.opacities[faces][..., None], weights)[:, 0], 0, 1)
    if solid.texture is not None:
        texel, alpha = texture_at(solid.texture, mix(solid.uvs[faces], weights))
        base, opacity = base * texel / 255, opacity * alpha
    if solid.fade is not None:
        inner, outer = solid.fade
        away = ((point - solid.position) ** 2).sum(axis=1)
        opacity = opacity * np.clip((outer**2 - away) / (outer**2 - inner**2), 0, 1)
    return point, base, opacity


def normals(scene: Record, solid: Record, faces: Integers, weights: Array) -> Array:
    """Return the unit normals (n, 3) of points: of the faces, or interpolated between the vertices."""
    a, b, c = solid.points[faces].transpose(1, 0, 2)
    across = np.cross(b - a, c - a)
    normal = unit(mix(solid.normals[faces], weights) if solid.shading == SMOOTH else across)
    is_turned = dot(across, scene.camera.toward(a)) < 0
    return np.where(is_turned, -normal, normal) if solid.two_sided and not solid.is_wire else normal


def cosines_of(lamp: Record, point: Array, normal: Array, view: Array) -> tuple[Array, Array, Array]:
    """Return which part of a light reaches points, N.L and N.H, (n, 1) each; H is the direction between L and V."""
    way = unit(toward(lamp, point))
    return through_cone(lamp, way), dot(normal, way), dot(normal, unit(way + view))


def toward(lamp: Record, points: Array) -> Array:
    """Return the ways (..., 3) from points to a light."""
    return np.asarray(lamp.vector - points if lamp.is_point else np.broadcast_to(lamp.vector, points.shape))


def through_cone(lamp: Record, way: Array) -> Array:
    """Return which part of a light points (n, 3) the ways to it get: all, but in cones (glTF's KHR_lights_punctual)."""
    if lamp.cone is None:
        return np.ones((len(way), 1))
    *axis, inner, outer = lamp.cone
    return np.asarray(np.clip((dot(-unit(axis), way) - outer) / max(inner - outer, 2.0**-10), 0, 1) ** 2)


def radiance(
    scene: Record, solid: Record, base: Array, normal: Array, facing: Array, cosines: list[Any], grazing: Any = 0
) -> tuple[Array, Array]:
    """Return the light (n, 3) of points by Blinn and Phong: with all lights, and without that which casts shadows.

    facing: N.V (n, 1). cosines: of each light, see `cosines_of`. grazing: highlights are where N.L is above it.
    """
    base, (sky, ground) = light(scene, base), light(scene, scene.hemisphere)
    ambient = light(scene, scene.ambient_light) + ground + (sky - ground) * (1 + normal[:, 1:2]) / 2
    lit = base * solid.ambient * ambient + light(scene, scene.rim) * (1 - np.clip(facing, 0, 1)) ** scene.rim_power
    dark = lit
    for lamp, (part, n_l, n_h) in zip(scene.lights, cosines, strict=True):
        gloss = np.clip(n_h, 0, 1) ** solid.shininess * (n_l > grazing)
        more = light(scene, lamp.color) * part * (base * solid.diffuse * np.maximum(n_l, 0) + solid.specular * gloss)
        lit, dark = lit + more, dark if lamp.shadow else dark + more
    return lit, dark


def colored(scene: Record, solid: Record, x: Array, point: Array) -> Array:
    """Return the colours 0..255 of the light of points: emission, exposure, tone curves, then fog."""
    x = (x + light(scene, solid.emission)) * scene.exposure
    if scene.filmic:
        x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
    x = np.clip(x, 0, 1)
    if scene.gamma:
        x = np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
    if scene.fog is None:
        return np.asarray(255 * x)
    color, near, far = scene.fog
    distance = scene.camera.seen(point)[:, 2:]
    return np.asarray(255 * x + (color - 255 * x) * np.clip((distance - near) / max(far - near, 2**-32), 0, 1))


def light(scene: Record, color: Array) -> Array:
    """Return a colour 0..255 as light 0..1: with gamma, decoded from sRGB."""
    x = np.maximum(color / 255, 0) if scene.gamma else color / 255
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4) if scene.gamma else x


def texture_at(texture: Record, uvs: Array) -> tuple[Array, Array]:
    """Return the colours (n, 3) and opacities (n,) of a texture at coordinates (n, 2), from its upper left corner."""
    size = np.array(texture.texels.shape[1::-1])
    alpha = np.full((size[1], size[0], 1), 255.0) if texture.alpha is None else texture.alpha
    image, place = np.concatenate([texture.texels, alpha], axis=-1), uvs * size

    def texel(at: Array) -> Array:
        column, row = (np.clip(at, 0, size - 1) if texture.clamps else at % size).astype(int).T
        return np.asarray(image[row, column])

    if texture.bilinear:
        first, found = np.floor(place - 0.5), np.zeros((len(uvs), 4))
        part = place - 0.5 - first
        for corner in np.ndindex(2, 2):
            found += np.where(corner, part, 1 - part).prod(axis=1, keepdims=True) * texel(first + corner)
    else:
        found = texel(np.floor(place))
    # 1e-6: of float64
    return found[:, :3], found[:, 3] / 255 if texture.cutoff == 0 else 1.0 * (found[:, 3] >= texture.cutoff - 1e-6)


# ---- shadows ----


class Shadow:
    """What the light that casts shadows does not reach: points behind a face, between its sides seen from the light."""

    def __init__(self, scene: Record) -> None:
        """Find the planes (n, 4, 4) of the faces that cast shadows, positive inside of the shadow."""
        self.light, planes = scene.shadow_light, []
        for solid in scene.objects if self.light is not None else ():
            for corners in solid.points[solid.faces] if solid.is_opaque and not solid.is_wire else ():
                ways = toward(self.light, corners)
                normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
                side = np.sign(normal @ ways[0])
                spared = {TURNED_AWAY: 1, TURNED_TOWARD: -1}.get(self.light.shadow) if solid.culls else None
                if side in (0, spared):
                    continue
                inward = unit(side * np.array([*np.cross(ways, np.roll(corners, -1, 0) - corners), -normal]))
                planes.append(np.column_stack([inward, -(inward * corners[[0, 1, 2, 0]]).sum(axis=1)]))
        self.planes = np.reshape(planes, (-1, 4, 4))
        self.slack = 2.0**-30 * max((np.abs(each.points).max(initial=0) for each in scene.objects), default=1)

    def on(self, points: Array) -> NDArray[np.bool_]:
        """Return which points (n, 3) are in shadow."""
        inside = points @ self.planes[..., :3].transpose(0, 2, 1) + self.planes[:, None, :, 3] > self.slack
        return np.asarray(inside.all(axis=2).any(axis=0))


# ---- vectors ----


def mix(values: Array, weights: Array) -> Array:
    """Return values (n, 3, k) of corners, weighted by (n, 3), as (n, k) values of points."""
    return np.asarray(np.einsum("nij,ni->nj", values, weights))


def unit(vectors: ArrayLike) -> Array:
    """Return unit vectors along the last axis; zero for zero."""
    v = np.asarray(vectors, float)
    return np.asarray(v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-300))


def dot(a: Array, b: Array) -> Array:
    """Return (..., 1) dot products."""
    return np.asarray((a * b).sum(axis=-1, keepdims=True))


def cross(a: Array, b: Array) -> Array:
    """Return cross products of vectors of a plane."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def rotation(quaternion: Array) -> Array:
    """Return the matrix of a quaternion (x, y, z, w) of any length: the images of the axes are its columns."""
    x, y, z, w = unit(quaternion)
    turn = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + 2 * w * turn + 2 * turn @ turn)


if __name__ == "__main__":
    try:
        pixels = draw(Path(sys.argv[1]).read_bytes())
        Path(sys.argv[2]).write_bytes(b"P6 %d %d 255\n" % pixels.shape[1::-1] + pixels.tobytes())
    except (ValueError, IndexError, KeyError, OSError) as error:
        sys.exit(f"{' '.join(sys.argv)}: {error}; usage: python contracts/picture.py CALL PICTURE")
