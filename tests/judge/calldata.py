"""What the calldata of `render(Scene)` says, as float64 numbers: docs/calling.md describes the format."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import eth_abi
import numpy as np
from numpy.typing import NDArray

from shackled.artifacts import artifact

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

UNLIT, FLAT, SMOOTH = 0, 1, 2
POINT = 1
CULL_BACKFACES, WIREFRAME, TWO_SIDED = 1, 2, 4
#: Kinds of records.
SPOT, OPACITY, ANTIALIAS, HEMISPHERE, RIM, FOG, TONE, TEXTURE, OPACITIES, SHADOW, GROUND, EMISSION, ALPHA = range(1, 14)
#: Rules of a shadow: which faces of culled objects cast it.
ALL_FACES, TURNED_AWAY, TURNED_TOWARD = 1, 2, 3


@dataclass(frozen=True)
class Frame:
    """The camera: its position, its axes (right, up, forward as rows), pixels per unit, and the canvas."""

    eye: Array
    axes: Array
    perspective: bool
    focal: float
    near: float
    width: int
    height: int

    def to_camera(self, points: Array) -> Array:
        """Convert points of the world to (right, up, distance)."""
        return np.asarray((points - self.eye) @ self.axes.T)

    def to_eye(self, points: Array) -> Array:
        """Return the ways (n, 3) from points of the world to the eye."""
        return self.eye - points if self.perspective else np.broadcast_to(-self.axes[2], points.shape)

    def divisor(self, points: Array) -> Array:
        """Return by what a projection divides points in camera space."""
        return np.asarray(points[..., 2] if self.perspective else np.ones(points.shape[:-1]))

    def project(self, points: Array) -> Array:
        """Project points in camera space: columns and rows in pixels, from the top left corner of the canvas."""
        scale = self.focal / self.divisor(points)
        return np.stack([self.width / 2 + points[..., 0] * scale, self.height / 2 - points[..., 1] * scale], axis=-1)

    def unproject(self, places: Array, distance: Array) -> Array:
        """Return the points of the world (n, 3) that are seen at places (n, 2) in pixels, at distances (n, 1)."""
        beside = (places - [self.width / 2, self.height / 2]) * [1, -1] / self.focal
        camera = np.concatenate([beside * (distance if self.perspective else 1), distance], axis=1)
        return np.asarray(self.eye + camera @ self.axes)

    def nearness(self, points: Array) -> Array:
        """Return what is linear on the screen, and larger where a point in camera space is nearer."""
        return np.asarray(1 / points[..., 2] if self.perspective else -points[..., 2])


@dataclass(frozen=True)
class Texture:
    """texels: (height, width, 3), 0..255. alpha: (height, width, 1), or None. cutoff: see docs/light.md."""

    texels: Array
    bilinear: bool
    clamps: bool
    alpha: Array | None = None
    cutoff: int = 0


@dataclass(frozen=True)
class Surface:
    """An object in the world. positions, colors, normals, opacities, uvs: of its vertices; faces: (m, 3).

    first: the number of its first face, counted through all objects. center, fade: of a ground. emission: 0..255.
    """

    first: int
    positions: Array
    colors: Array
    normals: Array
    faces: Integers
    shading: int
    ambient: float
    diffuse: float
    specular: float
    shininess: int
    cull: bool
    is_wire: bool
    two_sided: bool
    opacities: Array
    is_opaque: bool
    uvs: Array | None
    texture: Texture | None
    center: Array
    fade: tuple[float, float] | None
    emission: Array


@dataclass(frozen=True)
class Lamp:
    """A light. vector: where it is, or the direction toward it. cone: of a spot light. color: 0..255."""

    is_point: bool
    vector: Array
    color: Array
    cone: Array | None

    def toward(self, points: Array) -> Array:
        """Return the ways (..., 3) from points to the light."""
        return self.vector - points if self.is_point else np.broadcast_to(self.vector, points.shape)


@dataclass(frozen=True)
class Effects:
    """The effects of a scene; colours are 0..255. power: of the rim. fog: its colour and its two distances."""

    sky: Array
    ground: Array
    rim: Array
    power: int
    fog: tuple[Array, float, float] | None
    exposure: float
    filmic: bool
    gamma: bool


@dataclass(frozen=True)
class World:
    """All that the calldata says. exact: whether the light of each fragment is computed by itself. shadow: the number
    of the light that casts shadows, and the rule; None without.
    """

    frame: Frame
    top: Array
    bottom: Array
    invert: bool
    ambient: Array
    lamps: list[Lamp]
    surfaces: list[Surface]
    effects: Effects
    antialias: bool
    exact: bool
    shadow: tuple[int, int] | None

    def surface_of(self, face: Integers) -> Integers:
        """Return the numbers of the surfaces of faces, which are counted through all objects."""
        return np.searchsorted([s.first for s in self.surfaces], face, side="right") - 1

    def are(self, holds: Callable[[Surface], bool]) -> Booleans:
        """Return for which surfaces something holds."""
        return np.array([holds(s) for s in self.surfaces], bool)


@cache
def scene_type() -> str:
    """Return the ABI type of a scene."""
    function = next(entry for entry in artifact("Renderer").abi if entry.get("name") == "render")
    return type_of(function["inputs"][0])


def type_of(parameter: dict[str, Any]) -> str:
    """Return the ABI type of a parameter."""
    if not parameter["type"].startswith("tuple"):
        return str(parameter["type"])
    return f"({','.join(map(type_of, parameter['components']))}){parameter['type'].removeprefix('tuple')}"


def read(data: bytes) -> World:
    """Read calldata of `render(Scene)`."""
    (scene,) = eth_abi.decode([scene_type()], data[4:])  # type: ignore[attr-defined]
    (width, height), camera, (top, bottom), invert, ambient, lights, objects, extensions = scene
    records = _records(extensions)
    eye, target, up, projection, half_height, near = camera
    back = unit(_q32(eye) - _q32(target))
    right = unit(np.cross(unit(_q32(up)), back))
    axes = np.array([right, np.cross(back, right), -back])
    frame = Frame(
        _q32(eye), axes, projection == 0, height / 2 / float(_q32(half_height)), float(_q32(near)), width, height
    )
    cones = {i: _q32(np.frombuffer(content, ">i8")) for (kind, i), content in records.items() if kind == SPOT}
    lamps = [
        Lamp(kind == POINT, _q32(vector), _rgb(color), cones.get(i)) for i, (kind, vector, color) in enumerate(lights)
    ]
    surfaces: list[Surface] = []
    first = 0
    for i, each in enumerate(objects):
        surfaces.append(_surface(each, first, {kind: content for (kind, j), content in records.items() if j == i}))
        first += len(surfaces[-1].faces)
    shadows = [(i, content[-1]) for (kind, i), content in records.items() if kind == SHADOW]
    return World(
        frame,
        _rgb(top),
        _rgb(bottom),
        bool(invert),
        _rgb(ambient),
        lamps,
        surfaces,
        _effects({kind: content for (kind, _), content in records.items()}),
        any(kind >= ANTIALIAS for kind, _ in records),
        any(kind > ANTIALIAS for kind, _ in records),
        shadows[0] if shadows else None,
    )


def _records(data: bytes) -> dict[tuple[int, int], bytes]:
    """The contents of records by kind and index."""
    found = {}
    while data:
        kind, index, size = data[0], int.from_bytes(data[1:3], "big"), int.from_bytes(data[3:5], "big")
        size *= 1 if kind < TEXTURE else 32
        found[kind, index], data = data[5 : 5 + size], data[5 + size :]
    return found


def _effects(records: dict[int, bytes]) -> Effects:
    tone = records.get(TONE, (1 << 16).to_bytes(4, "big") + b"\0")
    numbers = {kind: np.frombuffer(content, np.uint8).astype(np.float64) for kind, content in records.items()}
    hemisphere, rim = numbers.get(HEMISPHERE, np.zeros(6)), numbers.get(RIM, np.array([0, 0, 0, 1]))
    fog = None
    if FOG in records:
        near, far = _q32(np.frombuffer(records[FOG][3:], ">i8")).tolist()
        fog = numbers[FOG][:3], near, far
    return Effects(
        hemisphere[:3],
        hemisphere[3:],
        rim[:3],
        int(rim[3]),
        fog,
        exposure=int.from_bytes(tone[:4], "big") / 2.0**16,
        filmic=bool(tone[4] & 1),
        gamma=bool(tone[4] & 2),
    )


def _surface(each: Any, first: int, records: dict[int, bytes]) -> Surface:
    mesh, position, rotation, scale, (shading, ambient, diffuse, specular, shininess), flags = each
    points, colors, normals, faces = unpack(mesh)
    turn = rotation_matrix(_q32(rotation))
    center = _q32(position)
    opacities = np.ones(len(points))
    if OPACITY in records:
        opacities *= int.from_bytes(records[OPACITY], "big") / 2.0**24
    if OPACITIES in records:
        opacities *= np.frombuffer(records[OPACITIES], np.uint8)[: len(points)] / 255
    fade = None
    if GROUND in records and OPACITY not in records and OPACITIES not in records:
        inner, outer = _q32(np.frombuffer(records[GROUND][:16], ">i8")).tolist()
        fade = inner, outer
    texture, uvs = _texture(records[TEXTURE], len(points)) if TEXTURE in records else (None, None)
    if texture is not None and ALPHA in records:
        image = _texture(records[ALPHA][1:], 0)[0]
        texture = replace(texture, alpha=image.texels[..., 2:], cutoff=records[ALPHA][0])
    return Surface(
        first,
        center + float(_q32(scale)) * points @ turn.T,
        colors,
        normals @ turn.T,
        faces,
        shading,
        float(_q32(ambient)),
        float(_q32(diffuse)),
        float(_q32(specular)),
        shininess,
        bool(flags & CULL_BACKFACES),
        bool(flags & WIREFRAME),
        bool(flags & TWO_SIDED),
        opacities,
        not {OPACITY, OPACITIES, GROUND, ALPHA} & set(records),
        uvs,
        texture,
        center,
        fade,
        _rgb(int.from_bytes(records.get(EMISSION, b""), "big")),
    )


def _texture(record: bytes, vertices: int) -> tuple[Texture, Array]:
    flags, width, height, bits = record[0], record[1] + 1, record[2] + 1, record[3]
    colors = 1 << bits if bits <= 8 else 0
    palette = np.frombuffer(record, np.uint8, 3 * colors, 4).reshape(-1, 3)
    begin, size = 4 + 3 * colors, (width * height * bits + 7) // 8
    texels = np.frombuffer(record, np.uint8, size, begin)
    if colors:
        planes = np.unpackbits(texels)[: width * height * bits].reshape(-1, bits)
        texels = palette[planes @ (1 << np.arange(bits)[::-1])]
    uvs = np.frombuffer(record, np.uint8, 6 * vertices, begin + size).reshape(-1, 2, 3).astype(np.int64)
    words = uvs @ np.array([1 << 16, 1 << 8, 1])
    signed = (words ^ 1 << 23) - (1 << 23)
    image = texels.reshape(height, width, 3).astype(np.float64)
    return Texture(image, bool(flags & 1), bool(flags & 2)), signed / 2.0**16


def unpack(mesh: bytes) -> tuple[Array, Array, Array, Integers]:
    """Unpack a mesh: positions, colours, normals (zero where there are none) and faces."""
    kind, count = mesh[0], int.from_bytes(mesh[1:3], "big")
    size = 3 if kind & 2 else 2
    width = 3 * size + 3 + 4 * (kind & 1)
    rows = np.frombuffer(mesh, np.uint8, count * width, 5).reshape(count, width)
    points = np.zeros((count, 3), np.int64)
    for byte in range(size):
        points = points << 8 | rows[:, byte : 3 * size : size]
    points = (points ^ 1 << 8 * size - 1) - (1 << 8 * size - 1)
    normals = np.zeros((count, 3), np.int64)
    if kind & 1:
        words = np.ascontiguousarray(rows[:, -4:]).view(">u4").astype(np.int64)
        normals = np.hstack([words >> 22, words >> 12, words >> 2]) & 1023
        normals = (normals ^ 512) - 512
    faces = np.frombuffer(mesh, ">u2", offset=5 + rows.size).astype(np.int64).reshape(-1, 3)
    colors = rows[:, 3 * size : 3 * size + 3]
    return points.astype(np.float64), colors.astype(np.float64), normals / 511, faces


def rotation_matrix(quaternion: Array) -> Array:
    """Return the matrix of a quaternion (x, y, z, w) of any length: the images of the axes are its columns."""
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.asarray(np.eye(3) + 2 * w * cross + 2 * cross @ cross)


def unit(v: Array) -> Array:
    """Return unit vectors along the last axis; zero for zero."""
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.asarray(np.divide(v, length, out=np.zeros_like(v), where=length > 0))


def _q32(value: Any) -> Array:
    return np.array(value, dtype=np.float64) / 2.0**32


def _rgb(color: int) -> Array:
    return np.array([color >> 16, color >> 8 & 0xFF, color & 0xFF], dtype=np.float64)
