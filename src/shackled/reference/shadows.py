"""Find which parts of which faces one light does not reach.

Every face that casts a shadow is four half-spaces, exact in integers: its three sides as seen from the light, and what
lies behind it. On the surface of another face each of them becomes a linear function of the place on the canvas.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from . import layout, transform, vertex_shader
from .effect_records import ALL, GROUND, SHADOW, TURNED
from .extensions import OPACITY, Records
from .mesh import Mesh, open_mesh
from .opacities import OPACITIES
from .registers import Registers
from .roots import sqrt
from .scene_errors import Reverted
from .shadow_table import DARK, LIT, Edge, Entry, Table
from .structs import CULL_BACKFACES, FLAT, POINT, SMOOTH, UNLIT, WIREFRAME, Canvas, Scene
from .vector import Vector, cross, normalize, scale, subtract, to_matrix, transposed_times
from .view import View
from .words import divide, divide_signed

#: The farthest place that casts a shadow has coordinates of so many bits in the space of the light.
COORDINATE_BITS = 19
#: Coordinates are divided into so many ranges, to find what may shade a face.
BUCKETS = 128
#: The first and the last range of x, y and z.
Box = tuple[int, int, int, int, int, int]
EVERYWHERE = (0, BUCKETS - 1) * 3
#: A point light with a greater slope across what casts shadows is among that.
WIDEST = 2 << 16
#: The functions of a face with coordinates of this magnitude, or a greater one, have factors of fewer bits.
NARROW, WIDE_BITS = 1 << 26, 60
Plane = tuple[int, int, int, int]
#: Bits of the coordinates of corners that are made where polygons are cut.
VALUE_BITS = 83
#: Bits of the distances of vertices, and of other homogeneous coordinates.
DISTANCE_BITS, CLIP_BITS = 38, 60
#: Places on the canvas: whole numbers with so many bits below the pixel; in sub-pixels they are below 2 to this.
POINT_BITS, GUARD = 20, 22
Point = tuple[int, int]
#: Bits of the change of the function of an edge per eighth of a pixel.
EDGE_BITS = 40


@dataclass(frozen=True)
class Frame:
    """The space of the light.

    z points toward a directional light, and from a point light to what casts shadows. Its origin is the middle of
    what casts shadows, or the point light.

    axes: times 2^64 / radius. low, factor: of the ranges into which coordinates are divided. sides: of a point light,
    the sides of a cube around it that have ranges of their own: 6 where it is among what casts shadows, else 1.
    """

    is_point: bool
    origin: Vector
    axes: tuple[Vector, Vector, Vector]
    radius: int
    low: Vector
    factor: Vector
    sides: int = 1

    def place(self, v: Vector) -> Vector:
        """Return a place of the world."""
        v = subtract(v, self.origin)
        x, y, z = (self._along(axis, v) for axis in self.axes)
        return x, y, z

    @staticmethod
    def _along(axis: Vector, v: Vector) -> int:
        return (axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2] + (1 << 76)) >> 77

    def direction(self, v: Vector) -> Vector:
        """Return a direction of the world, a unit vector, of length 2^COORDINATE_BITS or less."""
        scaled = v[0] * self.radius >> 32, v[1] * self.radius >> 32, v[2] * self.radius >> 32
        x, y, z = (self._along(axis, scaled) for axis in self.axes)
        return x, y, z

    def bucket(self, axis: int, value: int) -> int:
        """Return the range of a coordinate."""
        return min(max((value - self.low[axis]) * self.factor[axis] >> 32, 0), BUCKETS - 1)

    def boxes(self, corners: Sequence[Vector]) -> list[Box | None]:
        """Return the ranges of a face on each side of the cube; None where it is not on it."""
        if not self.is_point:
            return [self._box(corners)]
        if self.sides == 1:
            is_beside = any(4 * z <= max(abs(x), abs(y)) for x, y, z in corners)
            return [EVERYWHERE if is_beside else self._box([slopes(each) for each in corners])]
        main = [main_side(each) for each in corners]
        if None not in main and len(set(main)) == 1:
            return [self._box([slopes(turned(c, k)) for c in corners]) if k == main[0] else None for k in range(6)]
        return [self._box_on([turned(each, k) for each in corners]) for k in range(6)]

    def _box(self, places: Sequence[Vector]) -> Box:
        x, y, z = (sorted(self.bucket(axis, place[axis]) for place in places) for axis in range(3))
        return x[0], x[-1], y[0], y[-1], z[0], z[-1]

    def _box_on(self, corners: Sequence[Vector]) -> Box | None:
        """Return the ranges on a side of the cube of a face that is on several."""
        far = max(z for _, _, z in corners)
        outside = any(all(s * place[axis] > place[2] for place in corners) for axis in (0, 1) for s in (1, -1))
        if far <= 0 or outside:
            return None
        if min(z for _, _, z in corners) > 0:
            return self._box([slopes(each) for each in corners])
        return 0, BUCKETS - 1, 0, BUCKETS - 1, self.bucket(2, -far), BUCKETS - 1


def slopes(place: Vector) -> Vector:
    """Return x / z and y / z, and how near a place is to a point light."""
    x, y, z = place
    return divide_signed(x << 16, z), divide_signed(y << 16, z), -z


def turned(place: Vector, side: int) -> Vector:
    """Return a place with the axis of a side of the cube in place of z: z, -z, x, -x, y, -y."""
    axis = (2, 0, 1)[side // 2]
    return place[(axis + 1) % 3], place[(axis + 2) % 3], -place[axis] if side % 2 else place[axis]


def main_side(place: Vector) -> int | None:
    """Return the side of the cube on which a place is; None for the light itself."""
    far = max(map(abs, place))
    return next((k for k in range(6) if turned(place, k)[2] == far), None) if far else None


@dataclass
class Face:
    """A face in the space of the light.

    corners: their places. boxes: the ranges of its coordinates: see Frame.boxes. normal: the cross product of two
    sides. side: positive if it is turned to the light, 0 if it is seen edge-on.
    """

    object: int
    number: int
    corners: tuple[Vector, Vector, Vector]
    boxes: list[Box | None]
    normal: Vector
    side: int
    planes: list[Plane] = field(default_factory=list)


def shadow_of(records: Records) -> tuple[int, int] | None:
    """Return the light that casts shadows, and which faces of culled objects do; None if there is none."""
    return next(
        ((index, int.from_bytes(content, "big")) for (kind, index), content in records.items() if kind == SHADOW), None
    )


def cast(scene: Scene, view: View, registers: Registers) -> Table | None:
    """Return what the light of the SHADOW record does not reach; None if there is no such record."""
    records = registers.records
    found = shadow_of(records)
    if found is None:
        return None
    light, rule = found
    meshes = [open_mesh(each.mesh) for each in scene.objects]
    for index, mesh in enumerate(meshes):
        for number, corners in enumerate(mesh.faces):
            if max(corners) >= len(mesh.positions):
                raise Reverted("IndexOutOfRange", object=index, face=number, vertexCount=len(mesh.positions))
    worlds = [world_places(scene, index, mesh) for index, mesh in enumerate(meshes)]
    casting = [casts(scene, index, records) for index in range(len(meshes))]
    table = Table(light, [[LIT] * len(mesh.faces) for mesh in meshes])
    points = [place for world, yes in zip(worlds, casting, strict=True) if yes for place in world]
    if not points:
        return table
    frame = frame_of(scene, light, points)
    faces = [
        face_of(frame, index, number, [places[k] for k in corners])
        for index, (mesh, world) in enumerate(zip(meshes, worlds, strict=True))
        for places in [[frame.place(each) for each in world]]
        for number, corners in enumerate(mesh.faces)
    ]
    casters = [each for each in faces if casting[each.object] and is_caster(scene, each, rule)]
    eye = frame.direction(view.forward) if view.orthographic else frame.place(scene.camera.eye)
    for face in faces:
        if receives(scene, face, eye, view.orthographic) and not turns_away(scene, light, face, meshes[face.object]):
            table.faces[face.object][face.number] = shade(scene, face, casters, meshes[face.object], view, registers)
    return table


def casts(scene: Scene, index: int, records: Records) -> bool:
    """Return whether an object casts a shadow: not wires, what is not opaque, and what shall not."""
    is_wire = scene.objects[index].flags & WIREFRAME
    return not is_wire and not any((kind, index) in records for kind in (OPACITY, OPACITIES, GROUND))


def world_places(scene: Scene, index: int, mesh: Mesh) -> list[Vector]:
    """Return the vertices of an object in the world."""
    thing = scene.objects[index]
    columns = [scale(column, thing.scale) for column in to_matrix(thing.rotation)]
    places = []
    for x, y, z in mesh.positions:
        i, j, k = (
            x * columns[0][axis] + y * columns[1][axis] + z * columns[2][axis] + thing.position[axis]
            for axis in range(3)
        )
        places.append((i, j, k))
    return places


def frame_of(scene: Scene, light: int, points: Sequence[Vector]) -> Frame:
    """Return the space of a light. points: of what casts shadows, in the world."""
    low, high = (tuple(f(axis) for axis in zip(*points, strict=True)) for f in (min, max))
    middle = tuple(a + b >> 1 for a, b in zip(low, high, strict=True))
    is_point = scene.lights[light].kind == POINT
    vector = scene.lights[light].vector
    half = (length_of(subtract(high, low)) >> 1) + 1
    sides = 1
    if is_point:
        origin = vector
        reach = tuple(max(abs(a - o), abs(b - o)) for a, b, o in zip(low, high, origin, strict=True))
        radius = length_of(reach) + 1
        z = normalize(subtract(middle, origin))
        if not any(z):
            z = (0, 0, 1 << 32)
        # the cone around the sphere around what casts shadows
        size = (half << COORDINATE_BITS) // radius + 2
        distance = (length_of(subtract(middle, origin)) << COORDINATE_BITS) // radius
        across = (size << 16) // (distance - size) + 1 if distance > size else WIDEST + 1
        if across > WIDEST:
            across, lowest, depth, sides = 1 << 16, 1 << COORDINATE_BITS, 1 << COORDINATE_BITS, 6
        else:
            lowest, depth = distance + size, 2 * size
        lows, sizes = (-across, -across, -lowest), (2 * across, 2 * across, depth)
    else:
        origin, radius, z = middle, half, normalize(vector)
        most = 1 << COORDINATE_BITS
        lows, sizes = (-most,) * 3, (2 * most,) * 3
    x = normalize(cross(z, (0, 1 << 32, 0) if abs(z[1]) < 3 << 30 else (1 << 32, 0, 0)))
    i, j, k = (divided(axis, radius) for axis in (x, cross(z, x), z))
    f, g, h = ((BUCKETS << 32) // each for each in sizes)
    return Frame(is_point, origin, (i, j, k), radius, lows, (f, g, h), sides)


def divided(axis: Vector, radius: int) -> Vector:
    """Return 2^64 / radius times a vector."""
    x, y, z = (divide_signed(value << 64, radius) for value in axis)
    return x, y, z


def length_of(v: Iterable[int]) -> int:
    """Return the length of a vector."""
    return sqrt(sum(k * k for k in v))


def face_of(frame: Frame, index: int, number: int, corners: Sequence[Vector]) -> Face:
    """Return a face in the space of the light."""
    a, b, c = corners
    normal = product(subtract(b, a), subtract(c, a))
    side = -inner(normal, a) if frame.is_point else normal[2]
    planes = planes_of((a, b, c), normal, side, frame.is_point) if side else []
    return Face(index, number, (a, b, c), frame.boxes(corners), normal, side, planes)


def planes_of(corners: tuple[Vector, Vector, Vector], normal: Vector, side: int, is_point: bool) -> list[Plane]:
    """Return the sides, each opposite to a corner, and what lies behind: x, y, z and a constant of each.

    All are positive in the shadow.
    """
    planes: list[Plane] = []
    sign = 1 if side > 0 else -1
    for k in range(3):
        p, q = corners[(k + 1) % 3], corners[(k + 2) % 3]
        if is_point:
            # the side of what is turned to the light is negative, that of a point light is behind its plane
            x, y, z = (-sign * value for value in product(p, q))
            planes.append((x, y, z, 0))
        else:
            x, y = sign * (p[1] - q[1]), sign * (q[0] - p[0])
            planes.append((x, y, 0, -(x * p[0] + y * p[1])))
    x, y, z = (-sign * value for value in normal)
    planes.append((x, y, z, -inner((x, y, z), corners[0])))
    return planes


def product(a: Vector, b: Vector) -> Vector:
    """Return the cross product of whole numbers."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def inner(a: Vector, b: Vector) -> int:
    """Return the scalar product of whole numbers."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def is_caster(scene: Scene, face: Face, rule: int) -> bool:
    """Return whether a face of an object that casts a shadow does so."""
    if face.side == 0:
        return False
    if rule == ALL or not scene.objects[face.object].flags & CULL_BACKFACES:
        return True
    return (face.side > 0) == (rule == TURNED)


def receives(scene: Scene, face: Face, eye: Vector, orthographic: bool) -> bool:
    """Return whether a face may be seen on the side that the light reaches.

    eye: in the space of the light; for an orthographic camera the direction in which it looks.
    """
    thing = scene.objects[face.object]
    if thing.material.shading == UNLIT or thing.flags & WIREFRAME or face.side == 0:
        return False
    seen = -inner(face.normal, eye) if orthographic else inner(face.normal, subtract(eye, face.corners[0]))
    slack = 4 * sum(map(abs, face.normal))
    if thing.flags & CULL_BACKFACES and seen < -slack:
        return False
    # the light of smooth shading may be positive on faces that are turned away
    return thing.material.shading != FLAT or -slack <= seen <= slack or (seen > 0) == (face.side > 0)


def turns_away(scene: Scene, light: int, face: Face, mesh: Mesh) -> bool:
    """Return whether all normals of a smooth face that is turned away point away from a directional light."""
    thing, lamp = scene.objects[face.object], scene.lights[light]
    if face.side > 0 or thing.material.shading != SMOOTH or not thing.flags & CULL_BACKFACES or lamp.kind == POINT:
        return False
    toward = transposed_times(to_matrix(thing.rotation), normalize(lamp.vector))
    normals = mesh.normals or []
    return all(sum(a * b for a, b in zip(normals[k], toward, strict=True)) <= 0 for k in mesh.faces[face.number])


def may_shade(caster: Face, face: Face) -> bool:
    """Return whether the ranges of a face let it shade another."""
    return any(a and b and overlaps(a, b) for a, b in zip(caster.boxes, face.boxes, strict=True))


def overlaps(caster: Box, face: Box) -> bool:
    """Return whether ranges overlap, and the first are not all behind the others."""
    left, right, low, high, _, near = caster
    x, x_end, y, y_end, z, _ = face
    return right >= x and left <= x_end and high >= y and low <= y_end and near >= z


def values(plane: Plane, corners: Iterable[Vector]) -> tuple[int, int, int]:
    """Return a function at the corners of a face."""
    a, b, c = (inner(plane[:3], place) + plane[3] for place in corners)
    return a, b, c


def shrunk(planes: Sequence[Plane]) -> list[Plane]:
    """Return functions divided by a power of two, so that factors have WIDE_BITS bits, and constants 22 more."""
    shift = max(max(max(abs(x), abs(y), abs(z), abs(w) >> 22).bit_length() for x, y, z, w in planes) - WIDE_BITS, 0)
    return [(x >> shift, y >> shift, z >> shift, w >> shift) for x, y, z, w in planes]


def shade(scene: Scene, face: Face, casters: Iterable[Face], mesh: Mesh, view: View, registers: Registers) -> Entry:
    """Return LIT, DARK, or the edges of what shades parts of a face."""
    outlines: Outlines | None = None
    is_wide = any(not -NARROW <= value < NARROW for corner in face.corners for value in corner)
    own = shrunk(face.planes[:3]) + shrunk(face.planes[3:]) if is_wide else face.planes
    for caster in casters:
        if caster is face or not may_shade(caster, face):
            continue
        heights = values(own[3], caster.corners)
        if min(heights) >= 0:
            continue
        a, b, c = sides = [values(plane, caster.corners) for plane in own[:3]]
        if any(max(side) <= 0 for side in sides):
            continue
        if not is_wide:
            # what is in front of the face is in front of all that is inside its sides
            planes = caster.planes[:3] if max(heights) <= 0 else caster.planes
            lanes = [values(plane, face.corners) for plane in planes]
            if any(max(lane) <= 0 for lane in lanes):
                continue
            if all(min(lane) >= 0 for lane in lanes):
                return DARK
        if outlines is None:
            outlines = Outlines(scene.canvas, *canvas_places(scene, face, mesh, view, registers))
        outlines.add(list(zip(a, b, c, strict=True)), heights, face.side > 0, caster.side > 0)
    return (outlines.edges() if outlines else []) or LIT


def canvas_places(
    scene: Scene, face: Face, mesh: Mesh, view: View, registers: Registers
) -> tuple[list[Vector], list[Point] | None]:
    """Return the corners of a face on the canvas: column and row in sub-pixels, and the distance, by which both are
    multiplied; and column and row alone, None if a corner is nearer than the near plane or far beyond the canvas.
    """
    thing = scene.objects[face.object]
    transform.set_matrix(view, thing, to_matrix(thing.rotation), registers)
    clip = [vertex_shader.clip_coordinates(mesh, k, registers)[:3] for k in mesh.faces[face.number]]
    bias = layout.PIXEL_BIAS << 8
    distances = [1 << 32 if view.orthographic else w for _, _, w in clip]
    limit = 1 << layout.GUARD_BITS
    if all(
        w >= registers.near and max(x, y) < d * limit and min(x, y) >= 0
        for (x, y, w), d in zip(clip, distances, strict=True)
    ):
        shift = 32 if view.orthographic else max(max(distances).bit_length() - DISTANCE_BITS, 0)
        points = [(divide(x, w) - bias, divide(y, w) - bias) for (x, y, _), w in zip(clip, distances, strict=True)]
        weights = [w >> shift for w in distances]
        return [(x * w, y * w, w) for (x, y), w in zip(points, weights, strict=True)], points
    places = [(x - bias * d, y - bias * d, d) for (x, y, _), d in zip(clip, distances, strict=True)]
    shift = max(max(abs(k) for place in places for k in place).bit_length() - CLIP_BITS, 0)
    return [(x >> shift, y >> shift, w >> shift) for x, y, w in places], None


class Outlines:
    """The edges of all shadows on a face.

    A sample is in a shadow if more of them begin than end to the left of it. Where two shadows meet, one ends and
    the other begins: neither edge is kept.
    """

    def __init__(self, canvas: Canvas, places: list[Vector], points: list[Point] | None) -> None:
        """Take the corners of the face: see canvas_places."""
        self.places = places
        self.determinant = inner(product(places[0], places[1]), places[2])
        self.top, self.bottom, self.right = 0, 4 * canvas.height, canvas.width << POINT_BITS
        if points is not None:
            low, high = (f(y for _, y in points) for f in (min, max))
            self.top = max(first_row((low - 2) << 12), 0)
            self.bottom = min(first_row((high + 2) << 12), self.bottom)
            self.right = min(self.right, (max(x for x, _ in points) + 2 << 12) + (1 << POINT_BITS))
        #: By the places of both ends, the upper first: how many more shadows begin at an edge than end.
        self.counts: dict[tuple[Point, Point], int] = {}

    def add(self, corners: list[Vector], heights: tuple[int, int, int], face_is_turned: bool, is_turned: bool) -> None:
        """Add the shadow of a face.

        corners: of what casts it, by their sides of the face that receives it. heights: above 0 behind that.
        """
        if self.determinant == 0:
            return
        if max(heights) > 0:
            corners = clipped(corners, [-height for height in heights])
        if not all(map(self._is_plain, corners)):
            corners = clipped(corners, [sum(corner) for corner in corners])
            for axis in (0, 1):
                for sign in (1, -1):
                    places = [self._place(corner) for corner in corners]
                    corners = clipped(corners, [(place[2] << GUARD) + sign * place[axis] for place in places])
        points = [self._point(corner) for corner in corners]
        is_flipped = face_is_turned ^ is_turned ^ (self.determinant < 0)
        for k, b in enumerate(points):
            self._add_edge(*((b, points[k - 1]) if is_flipped else (points[k - 1], b)))

    def _add_edge(self, a: Point, b: Point) -> None:
        first, end = sorted(min(max(first_row(y), self.top), self.bottom) for _, y in (a, b))
        if first == end or min(a[0], b[0]) > self.right:
            return
        is_down = a[1] < b[1]
        key = (a, b) if is_down else (b, a)
        self.counts[key] = self.counts.get(key, 0) + (-1 if is_down else 1)

    def _place(self, sides: Vector) -> Vector:
        x, y, w = (sum(side * place[k] for side, place in zip(sides, self.places, strict=True)) for k in range(3))
        return x, y, w

    def _is_plain(self, sides: Vector) -> bool:
        x, y, w = self._place(sides)
        return sum(sides) > 0 and w > 0 and max(abs(x), abs(y)) <= w << GUARD

    def _point(self, sides: Vector) -> Point:
        x, y, w = self._place(sides)
        return (divide_signed(x << 12, w), divide_signed(y << 12, w)) if w else (0, 0)

    def edges(self) -> list[Edge]:
        """Return the edges that are left, ordered by the first row of pixels."""
        found = []
        for (a, b), count in self.counts.items():
            top, bottom = (min(max(first_row(y), self.top), self.bottom) for _, y in (a, b))
            dx, dy = b[0] - a[0], b[1] - a[1]
            x, y, constant = dy << 17, -dx << 17, a[1] * dx - a[0] * dy
            shift = max(max(x, abs(y)).bit_length() - EDGE_BITS, 0)
            edge = Edge(top, bottom, 1 if count > 0 else -1, x >> shift, y >> shift, constant >> shift)
            found += [edge] * abs(count)
        return sorted(found, key=lambda each: each.top >> 2)


def first_row(y: int) -> int:
    """Return the first row of samples that is not above a place."""
    return y + (5 << 17) - 1 >> 18


def clipped(corners: list[Vector], distances: Sequence[int]) -> list[Vector]:
    """Return the part of a convex polygon that is not below 0 in a distance."""
    found = []
    for k, (b, q) in enumerate(zip(corners, distances, strict=True)):
        a, p = corners[k - 1], distances[k - 1]
        if (p < 0) != (q < 0):
            # the same for both faces that share the edge
            (i, m), (o, n) = ((a, p), (b, q)) if q < 0 else ((b, q), (a, p))
            x, y, z = (outer * m - inside * n for outer, inside in zip(o, i, strict=True))
            shift = max(max(abs(x), abs(y), abs(z)).bit_length() - VALUE_BITS, 0)
            found.append((x >> shift, y >> shift, z >> shift))
        if q >= 0:
            found.append(b)
    return found
