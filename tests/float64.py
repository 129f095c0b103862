"""A renderer in float64, written from the formulas that pictures are to follow, not from how contracts compute them.

It reads the same calldata as the contracts, so that both see the same numbers. Every triangle is projected, cut at the
near plane and rasterised by evaluating the edge functions at the centre of every pixel, with the top-left rule; what is
seen is then shaded pixel by pixel:

    colour = surface * (ambient * A + sum_i diffuse * max(0, N.L_i) * C_i)
           + sum_i specular * max(0, N.H_i)^shininess * C_i

C_i is the colour of a light, times what its cone lets through if it is a spot light. Objects that are not opaque are
drawn after the others: colour * opacity + what is there * (1 - opacity), where each is seen first. Opacities of
vertices are interpolated as colours are.

A hemisphere adds ground + (sky - ground) * (1 + N.y) / 2 to A. A rim adds its colour * (1 - max(0, N.V))^power. With
gamma, surface, A, C_i, hemisphere and rim are linear values, decoded from sRGB. The sum times the exposure, cut off at
white or compressed by the filmic curve, and encoded as sRGB with gamma, is the colour, which fog then covers by the
distance along the line of sight. Of antialiased pictures, only pixels that show one triangle can be compared.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import eth_abi
import numpy as np
from numpy.typing import NDArray

from shackled.artifacts import artifact
from shackled.scene import Scene, encode

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

UNLIT, FLAT, SMOOTH = 0, 1, 2
CULL_BACKFACES, WIREFRAME = 1, 2
POINT = 1

#: Projected vertices are laid on a grid of so many steps a pixel, as by the contracts, so that coverage is the same.
SUBPIXELS = 256.0


@dataclass(frozen=True)
class Picture:
    """A picture, and what is seen in it.

    pixels: (H, W, 3) uint8. exact: the same before it was rounded.
    triangle: (H, W) number of the triangle that is seen, counted through all objects; -1 for the background.
    layers: (H, W) the same of all that is drawn one over the other: what is opaque, and each object that is not.
    corners: (n, 3) numbers of the vertices of each triangle, counted through all objects.
    is_smooth: (n,) whether its normals are interpolated.
    """

    pixels: NDArray[np.uint8]
    exact: Array
    triangle: Integers
    layers: list[Integers]
    corners: Integers
    is_smooth: NDArray[np.bool_]


@dataclass(frozen=True)
class _Frame:
    """The camera: its place, its axes (right, up, back as rows), and pixels per unit.

    place: which point of each pixel is drawn, in columns and rows from the centre.
    """

    eye: Array
    axes: Array
    perspective: bool
    focal: float
    near: float
    width: int
    height: int
    place: tuple[float, float]

    def to_camera(self, points: Array) -> Array:
        """Points of the world as (right, up, distance)."""
        out: Array = (points - self.eye) @ self.axes.T
        return out


@dataclass(frozen=True)
class _Effects:
    """The effects of a scene; colours are 0..1, and linear with gamma.

    sky, ground, rim: light. power: of the rim. fog: its colour, as it is shown, and its two distances; None without.
    """

    sky: Array
    ground: Array
    rim: Array
    power: int = 1
    fog: tuple[Array, float, float] | None = None
    exposure: float = 1.0
    filmic: bool = False
    gamma: bool = False

    def light(self, color: Array) -> Array:
        """A colour 0..255 as light 0..1."""
        return decoded(color / 255) if self.gamma else color / 255

    def toned(self, radiance: Array) -> Array:
        """The colour 0..255 of light 0..1."""
        x = radiance * self.exposure
        if self.filmic:
            x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
        x = np.clip(x, 0, 1)
        return 255 * (encoded(x) if self.gamma else x)

    def fogged(self, color: Array, distance: Array) -> Array:
        """A colour at a distance from the eye, (n, 1)."""
        if self.fog is None:
            return color
        hue, near, far = self.fog
        return color + (hue - color) * np.clip((distance - near) / (far - near), 0, 1)


def decoded(values: Array) -> Array:
    """Linear values of sRGB, both 0..1."""
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def encoded(values: Array) -> Array:
    """The sRGB of linear values, both 0..1."""
    return np.where(values <= 0.0031308, values * 12.92, 1.055 * values ** (1 / 2.4) - 0.055)


@dataclass(frozen=True)
class _Surface:
    """An object in the world. positions, colors, normals, opacities (n, 1): of its vertices; faces: (m, 3)."""

    positions: Array
    colors: Array
    normals: Array
    faces: Integers
    material: tuple[int, float, float, float, int]
    cull: bool
    opacities: Array

    @property
    def is_opaque(self) -> bool:
        """Whether nothing is seen through it."""
        return bool((self.opacities == 1).all())


def render(scene: Scene) -> Picture:
    """The picture of a scene in the numbers that the contracts get for it."""
    return render_call(encode(artifact("Renderer").selectors["render"], scene))


def render_call(
    data: bytes, grazing: float = 0.0, by_depth: bool = False, place: tuple[float, float] = (0.0, 0.0)
) -> Picture:
    """The picture that calldata of `render(Scene)` asks for. There must be no wireframe in it.

    grazing: highlights are where N.L is above it. by_depth: of objects that are not opaque, the farther are drawn first
    in every pixel, whatever their order in the scene is, and all of them. place: as in _Frame.
    """
    (scene,) = eth_abi.decode([scene_type()], data[4:])  # type: ignore[attr-defined]
    (width, height), camera, (top, bottom), invert, ambient, lights, objects, extensions = scene
    cones, opacities, of_vertices, effects = _extensions(extensions)
    lamps = [(*light, cones.get(i)) for i, light in enumerate(lights)]
    frame = _frame(camera, width, height, place)
    surfaces = [_surface(o, opacities.get(i, 1.0), of_vertices.get(i)) for i, o in enumerate(objects)]
    picture = _background(_rgb(top), _rgb(bottom), width, height)
    shape = (height, width)
    triangle, depth = np.full(shape, -1, np.int64), np.full(shape, -np.inf)
    firsts = np.cumsum([0] + [len(surface.faces) for surface in surfaces])
    # all that is opaque at once, then one after the other
    opaque = [i for i, surface in enumerate(surfaces) if surface.is_opaque]
    passes = [opaque, *([i] for i in range(len(surfaces)) if i not in opaque and opacities.get(i, 1.0) > 0)]
    layers, fragments = [], []
    for numbers in passes:
        own_depth = depth.copy() if by_depth and numbers is not opaque else depth
        drawn, bary = _rasterise(frame, surfaces, numbers, own_depth)
        triangle[drawn >= 0] = drawn[drawn >= 0]
        layers.append(drawn)
        for i in numbers:
            surface, first = surfaces[i], firsts[i]
            seen = (drawn >= first) & (drawn < first + len(surface.faces))
            if seen.any():
                face, weights = drawn[seen] - first, bary[seen]
                color = _shade(frame, surface, face, weights, _rgb(ambient), lamps, effects, grazing)
                opacity = _mix(surface.opacities[surface.faces[face]], weights)
                fragments.append((seen, own_depth, np.clip(color, 0, 255), opacity))
    if by_depth:
        _blend_by_depth(picture, fragments)
    else:
        for seen, _, color, opacity in fragments:
            picture[seen] = color * opacity + np.clip(picture[seen], 0, 255) * (1 - opacity)
    if invert:
        picture = 255 - np.clip(picture, 0, 255)
    exact = np.clip(picture, 0, 255)
    offsets = np.cumsum([0] + [len(s.positions) for s in surfaces])
    corners = [s.faces + offset for s, offset in zip(surfaces, offsets, strict=False)]
    smooth = [np.full(len(s.faces), s.material[0] == SMOOTH) for s in surfaces]
    return Picture(
        pixels=np.floor(exact + 0.5).astype(np.uint8),
        exact=exact,
        triangle=triangle,
        layers=layers,
        corners=np.concatenate([np.empty((0, 3), np.int64), *corners]),
        is_smooth=np.concatenate([np.empty(0, bool), *smooth]),
    )


def _blend_by_depth(picture: Array, fragments: list[tuple[NDArray[np.bool_], Array, Array, Array]]) -> None:
    """Draws fragments, the farthest first in each pixel: where they are and their depths, (H, W); their colours, (n,
    3), and opacities, (n, 1).
    """
    shape = (len(fragments), *picture.shape[:2])
    depths, colors, opacities = np.full(shape, -np.inf), np.zeros((*shape, 3)), np.zeros((*shape, 1))
    for i, (seen, depth, color, opacity) in enumerate(fragments):
        depths[i][seen], colors[i][seen], opacities[i][seen] = depth[seen], color, opacity
    order = np.argsort(depths, axis=0, kind="stable")[..., None]
    colors, opacities = np.take_along_axis(colors, order, axis=0), np.take_along_axis(opacities, order, axis=0)
    for color, opacity in zip(colors, opacities, strict=True):
        picture[:] = color * opacity + picture * (1 - opacity)


# ---- what the calldata says ----


@cache
def scene_type() -> str:
    function = next(entry for entry in artifact("Renderer").abi if entry.get("name") == "render")
    return type_of(function["inputs"][0])


def type_of(parameter: dict[str, Any]) -> str:
    if not parameter["type"].startswith("tuple"):
        return str(parameter["type"])
    return f"({','.join(map(type_of, parameter['components']))}){parameter['type'].removeprefix('tuple')}"


def _q32(value: Any) -> Array:
    return np.array(value, dtype=np.float64) / 2.0**32


def _rgb(color: int) -> Array:
    return np.array([color >> 16, color >> 8 & 0xFF, color & 0xFF], dtype=np.float64)


def _frame(camera: Any, width: int, height: int, place: tuple[float, float]) -> _Frame:
    eye, target, up, projection, half_height, near = camera
    back = _unit(_q32(eye) - _q32(target))
    right = _unit(np.cross(_unit(_q32(up)), back))
    axes = np.array([right, np.cross(back, right), -back])
    focal = height / 2 / float(_q32(half_height))
    return _Frame(_q32(eye), axes, projection == 0, focal, float(_q32(near)), width, height, place)


def _extensions(data: bytes) -> tuple[dict[int, Array], dict[int, float], dict[int, bytes], _Effects]:
    """The cones of lights (where each points, the cosines of its angles), the opacities of objects and those of their
    vertices, by index; and the effects of the scene.
    """
    cones, opacities, of_vertices, effects = {}, {}, dict[int, bytes](), dict[int, bytes]()
    while data:
        kind, index, size = data[0], int.from_bytes(data[1:3], "big"), int.from_bytes(data[3:5], "big")
        size *= 1 if kind < 8 else 32
        content, data = data[5 : 5 + size], data[5 + size :]
        if kind == 1:
            cones[index] = _q32(np.frombuffer(content, ">i8"))
        elif kind == 2:
            opacities[index] = int.from_bytes(content, "big") / 2.0**24
        elif kind == 9:
            of_vertices[index] = content
        else:
            effects[kind] = content
    return cones, opacities, of_vertices, _effects(effects)


def _effects(records: dict[int, bytes]) -> _Effects:
    """The effects of records by their kinds."""
    tone = records.get(7, (1 << 16).to_bytes(4, "big") + b"\0")
    gamma = bool(tone[4] & 2)
    numbers = {kind: np.frombuffer(content, np.uint8).astype(np.float64) for kind, content in records.items()}
    light = _Effects(np.zeros(3), np.zeros(3), np.zeros(3), gamma=gamma).light
    hemisphere, rim = numbers.get(4, np.zeros(6)), numbers.get(5, np.array([0, 0, 0, 1]))
    fog = None
    if 6 in records:
        near, far = _q32(np.frombuffer(records[6][3:], ">i8")).tolist()
        fog = numbers[6][:3], near, far
    return _Effects(
        sky=light(hemisphere[:3]),
        ground=light(hemisphere[3:]),
        rim=light(rim[:3]),
        power=int(rim[3]),
        fog=fog,
        exposure=int.from_bytes(tone[:4], "big") / 2.0**16,
        filmic=bool(tone[4] & 1),
        gamma=gamma,
    )


def _surface(o: Any, opacity: float, of_vertices: bytes | None) -> _Surface:
    mesh, position, rotation, scale, (shading, ambient, diffuse, specular, shininess), flags = o
    assert not flags & WIREFRAME
    points, colors, normals, faces = unpack(mesh)
    turn = rotation_matrix(_q32(rotation))
    opacities = np.full((len(points), 1), opacity)
    if of_vertices is not None:
        opacities[:, 0] *= np.frombuffer(of_vertices, np.uint8)[: len(points)] / 255
    return _Surface(
        positions=_q32(position) + float(_q32(scale)) * points @ turn.T,
        colors=colors,
        normals=normals @ turn.T,
        faces=faces,
        material=(shading, float(_q32(ambient)), float(_q32(diffuse)), float(_q32(specular)), shininess),
        cull=bool(flags & CULL_BACKFACES),
        opacities=opacities,
    )


def unpack(mesh: bytes) -> tuple[Array, Array, Array, Integers]:
    """Positions, colours, normals (zero where there are none) and faces of a packed mesh."""
    kind, count = mesh[0], int.from_bytes(mesh[1:3], "big")
    size = 3 if kind & 2 else 2
    rows = np.frombuffer(mesh, np.uint8, count * (3 * size + 3 + 4 * (kind & 1)), 5).reshape(count, -1)
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
    """Of a quaternion (x, y, z, w) of any length: the images of the axes are its columns."""
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    out: Array = np.eye(3) + 2 * w * cross + 2 * cross @ cross
    return out


def _unit(v: Array) -> Array:
    """Unit vectors along the last axis; zero for zero."""
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    unit: Array = np.divide(v, length, out=np.zeros_like(v), where=length > 0)
    return unit


# ---- which triangle is seen where ----


def _rasterise(frame: _Frame, surfaces: list[_Surface], numbers: list[int], depth: Array) -> tuple[Integers, Array]:
    """The triangle that each pixel shows of some surfaces, and its weights (H, W, 3), perspective-correct.

    depth: of what is there; larger is nearer.
    """
    shape = (frame.height, frame.width)
    triangle, weights = np.full(shape, -1, np.int64), np.zeros((*shape, 3))
    for chosen in numbers:
        surface, number = surfaces[chosen], sum(len(each.faces) for each in surfaces[:chosen])
        corners = frame.to_camera(surface.positions)[surface.faces]
        kept = [_clip(frame, face) for face in corners]
        # what had to be cut comes after the rest of its object
        for is_cut in (False, True):
            for index, (face, pieces) in enumerate(zip(corners, kept, strict=True)):
                if is_cut == (face[:, 2] < frame.near).any():
                    for piece in pieces:
                        _draw(frame, face, piece, surface.cull, number + index, triangle, weights, depth)
    return triangle, weights


def _clip(frame: _Frame, face: Array) -> list[Array]:
    """What of a face is not nearer than the near plane, as triangles: (3, 3) weights of the corners each."""
    inside = face[:, 2] - frame.near
    if (inside >= 0).all():
        return [np.eye(3)]
    if (inside < 0).all():
        return []
    polygon = []
    for i in range(3):
        j = (i + 1) % 3
        if inside[i] >= 0:
            polygon.append(np.eye(3)[i])
        if (inside[i] >= 0) != (inside[j] >= 0):
            part = inside[i] / (inside[i] - inside[j])
            polygon.append((1 - part) * np.eye(3)[i] + part * np.eye(3)[j])
    return [np.array([polygon[0], polygon[i], polygon[i + 1]]) for i in range(1, len(polygon) - 1)]


def _draw(
    frame: _Frame,
    face: Array,
    piece: Array,
    cull: bool,
    number: int,
    triangle: Integers,
    weights: Array,
    depth: Array,
) -> None:
    """Draws a piece of a face where it is nearer than what is there."""
    points = piece @ face
    divisor = points[:, 2] if frame.perspective else np.ones(3)
    x = frame.width / 2 + frame.focal * points[:, 0] / divisor
    y = frame.height / 2 - frame.focal * points[:, 1] / divisor
    # in steps, relative to the place in the first pixel
    x = np.floor((x - 0.5 - frame.place[0]) * SUBPIXELS + 0.5)
    y = np.floor((y - 0.5 - frame.place[1]) * SUBPIXELS + 0.5)
    area = (x[2] - x[0]) * (y[1] - y[0]) - (x[1] - x[0]) * (y[2] - y[0])
    if area == 0 or (cull and area < 0):
        return
    order = [0, 1, 2]
    if area < 0:
        order = [0, 2, 1]
        x, y, points, piece, divisor = x[order], y[order], points[order], piece[order], divisor[order]
        area = -area
    (left, right), (top, bottom) = _pixels_within(x, frame.width), _pixels_within(y, frame.height)
    if left >= right or top >= bottom:
        return
    column, row = SUBPIXELS * np.arange(left, right)[None], SUBPIXELS * np.arange(top, bottom)[:, None]
    inside = np.ones((bottom - top, right - left), bool)
    screen = []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        # the edge across from corner i; positive within
        edge = (column - x[j]) * (y[k] - y[j]) + (row - y[j]) * (x[j] - x[k])
        screen.append(edge / area)
        # rows run down and corners counter-clockwise: a left edge goes down, a top edge to the left
        owned = y[k] > y[j] or (y[k] == y[j] and x[k] < x[j])
        inside &= edge >= 0 if owned else edge > 0
    flat = np.stack(screen, axis=-1)
    # linear on the screen: 1 / distance of a perspective camera, -distance of an orthographic one
    nearness = flat @ (1 / divisor) if frame.perspective else -(flat @ points[:, 2])
    window = np.s_[top:bottom, left:right]
    wins = inside & (nearness > depth[window])
    depth[window][wins] = nearness[wins]
    triangle[window][wins] = number
    correct = flat / divisor
    correct /= correct.sum(axis=-1, keepdims=True)
    weights[window][wins] = (correct @ piece)[wins]


def _pixels_within(steps: Array, size: int) -> tuple[int, int]:
    """The first pixel whose centre is not before all of these places, and the one after the last such, of a canvas."""
    first, last = np.ceil(steps.min() / SUBPIXELS), np.floor(steps.max() / SUBPIXELS)
    return int(np.clip(first, 0, size)), int(np.clip(last + 1, 0, size))


# ---- the colour of what is seen ----


def _background(top: Array, bottom: Array, width: int, height: int) -> Array:
    part = (np.arange(height) / max(height - 1, 1))[:, None, None]
    return np.array(np.broadcast_to(top + (bottom - top) * part, (height, width, 3)))


def _shade(
    frame: _Frame,
    surface: _Surface,
    face: Integers,
    weights: Array,
    ambient_light: Array,
    lights: Any,
    effects: _Effects,
    grazing: float,
) -> Array:
    """The colours of points of a surface; `face` (n,) and `weights` (n, 3) say which."""
    radiance = _radiance(frame, surface, face, weights, ambient_light, lights, effects, grazing)
    point = _mix(surface.positions[surface.faces[face]], weights)
    return effects.fogged(effects.toned(radiance), frame.to_camera(point)[:, 2:])


def _radiance(
    frame: _Frame,
    surface: _Surface,
    face: Integers,
    weights: Array,
    ambient_light: Array,
    lights: Any,
    effects: _Effects,
    grazing: float,
) -> Array:
    """The light of the points, 0..1 and brighter."""
    corners = surface.faces[face]
    color = effects.light(_mix(surface.colors[corners], weights))
    shading, ambient, diffuse, specular, shininess = surface.material
    if shading == UNLIT:
        return color
    places = surface.positions[corners]
    point = _mix(places, weights)
    if shading == FLAT:
        normal = _unit(np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]))
    else:
        normal = _unit(_mix(surface.normals[corners], weights))
    # the direction to the eye
    view = _unit(frame.eye - point) if frame.perspective else np.broadcast_to(-frame.axes[2], point.shape)
    upward = (1 + normal[:, 1:2]) / 2
    hemisphere = effects.ground + (effects.sky - effects.ground) * upward
    modulate = ambient * (effects.light(ambient_light) + hemisphere)
    add = effects.rim * (1 - np.maximum(0, _dot(normal, view))) ** effects.power
    for kind, vector, hue, cone in lights:
        toward = _unit(_q32(vector) - point if kind == POINT else np.broadcast_to(_q32(vector), point.shape))
        facing = _dot(normal, toward)
        through = np.ones_like(facing) if cone is None else _through(cone, toward)
        gloss = np.maximum(0, _dot(normal, _unit(toward + view))) ** shininess
        modulate = modulate + diffuse * np.maximum(0, facing) * through * effects.light(_rgb(hue))
        add = add + specular * np.where(facing > grazing, gloss, 0) * through * effects.light(_rgb(hue))
    radiance: Array = color * modulate + add
    return radiance


def _through(cone: Array, toward: Array) -> Array:
    """What a spot light lets through its cone, by glTF's KHR_lights_punctual; `toward` the light."""
    inner, outer = cone[3], cone[4]
    part = (_dot(-_unit(cone[:3]), toward) - outer) / max(inner - outer, 2.0**-10)
    out: Array = np.clip(part, 0, 1) ** 2
    return out


def _mix(values: Array, weights: Array) -> Array:
    """(n, 3, 3) values of the corners as (n, 3) values of the points."""
    mixed: Array = np.einsum("nij,ni->nj", values, weights)
    return mixed


def _dot(a: Array, b: Array) -> Array:
    product: Array = (a * b).sum(axis=-1, keepdims=True)
    return product
