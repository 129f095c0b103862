"""Meshes as they are kept on chain, in half of the bytes or less; contracts/src/mesh/CompactMesh.sol has the format.

Faces are told in an order in which each mostly shares an edge with one of the last few, and vertices in the order in
which faces first name them: so a face takes one byte, and a vertex as many bits as its numbers need. A mesh comes back
with its vertices, its faces and the corners of each face in that order, and otherwise as it was.
"""

from __future__ import annotations

from collections import defaultdict, deque
from dataclasses import dataclass

from ..errors import InputError
from ..scene import NORMALS, WIDE

#: The first byte of a mesh that is stored in this way. Packed meshes begin with 0 to 3.
COMPACT = 0x10
HEADER_SIZE = 24

#: Edges and vertices that a face may refer to.
EDGES = 15
RECENT = 14
#: In the upper half of a face's byte: no edge. In the lower half: 0 is the next vertex, 1 to 14 one of the last ones,
#: 15 a vertex that is told.
NO_EDGE = 15
TOLD = 15
#: A vertex is told by how far it lies back, in a byte, or by this and its number in two.
FAR = 255

Face = tuple[int, int, int]
Edge = tuple[int, int]


@dataclass(frozen=True)
class Parts:
    """A packed mesh taken apart. positions: as numbers from 0, the coordinate plus half the range."""

    format: int
    positions: list[tuple[int, int, int]]
    colors: list[int]
    normals: list[int]
    faces: list[Face]

    @property
    def lane(self) -> int:
        """Bits of a coordinate."""
        return 24 if self.format & WIDE else 16


def compact(packed: bytes, normal_bits: int = 10) -> bytes:
    """Return the bytes that are stored for a packed mesh.

    normal_bits: of each coordinate of a normal, 4 to 10; with 10 nothing is lost.
    """
    if not 4 <= normal_bits <= 10:
        raise InputError(f"a coordinate of a normal can be kept in 4 to 10 bits, not {normal_bits}")
    parts = take_apart(packed)
    codes, told, order = _order(parts.faces, len(parts.positions))
    positions = [parts.positions[v] for v in order]
    columns = list(zip(*positions, strict=True)) or [(0,)] * 3
    base = [min(column) for column in columns]
    widths = [(max(column) - low).bit_length() for column, low in zip(columns, base, strict=True)]
    colors = [parts.colors[v] for v in order]
    palette = sorted(set(colors))
    color_bits = (len(palette) - 1).bit_length()
    if 24 * len(palette) + color_bits * len(colors) >= 24 * len(colors) or len(palette) > 0xFFFF:
        palette, color_bits = [], 24
    index = {color: number for number, color in enumerate(palette)}
    fields = [
        (size, tuple(value - low for value in column)) for size, low, column in zip(widths, base, columns, strict=True)
    ]
    fields.append((color_bits, tuple(index.get(color, color) for color in colors)))
    kept = 0
    if parts.format & NORMALS:
        kept = normal_bits
        normals = [parts.normals[v] for v in order]
        for shift in (22, 12, 2):
            values = tuple(((normal >> shift & 1023) ^ 512) >> (10 - kept) for normal in normals)
            fields.append((kept, values))
    header = bytes([COMPACT, parts.format])
    header += b"".join(_two(value) for value in (len(order), len(parts.faces), len(told)))
    header += bytes(widths) + b"".join(value.to_bytes(3, "big") for value in base)
    header += _two(len(palette)) + bytes([color_bits, kept])
    return b"".join(
        [
            header,
            *(color.to_bytes(3, "big") for color in palette),
            bytes(codes),
            bytes(told),
            _packed_fields(fields, len(order)),
        ]
    )


def expand(stored: bytes) -> bytes:
    """Return the packed mesh of what `compact` gave."""
    if len(stored) < HEADER_SIZE or stored[0] != COMPACT:
        raise InputError("these bytes are no compact mesh")
    form = stored[1]
    n, m, e = (int.from_bytes(stored[at : at + 2], "big") for at in (2, 4, 6))
    widths = stored[8:11]
    base = [int.from_bytes(stored[at : at + 3], "big") for at in (11, 14, 17)]
    colors, color_bits, normal_bits = int.from_bytes(stored[20:22], "big"), stored[22], stored[23]
    at = HEADER_SIZE
    palette = [stored[k : k + 3] for k in range(at, at + 3 * colors, 3)]
    at += 3 * colors
    codes = stored[at : at + m]
    at += m
    told = stored[at : at + e]
    at += e
    bits = sum(widths) + color_bits + 3 * normal_bits
    if len(stored) != at + (n * bits + 7) // 8:
        raise InputError("these bytes are no compact mesh: their number is wrong")
    stream = int.from_bytes(stored[at:], "big")
    left = 8 * (len(stored) - at)

    def number(size: int) -> int:
        nonlocal left
        left -= size
        return stream >> left & ((1 << size) - 1)

    lane = 3 if form & WIDE else 2
    result = [bytes([form]), _two(n), _two(m)]
    for _ in range(n):
        for low, size in zip(base, widths, strict=True):
            result.append((low + number(size) ^ 1 << 8 * lane - 1).to_bytes(lane, "big"))
        color = number(color_bits)
        result.append(palette[color] if palette else color.to_bytes(3, "big"))
        if form & NORMALS:
            half = 1 << (9 - normal_bits) if normal_bits < 10 else 0
            x, y, z = (((number(normal_bits) << (10 - normal_bits)) + half) ^ 512 for _ in range(3))
            result.append((x << 22 | y << 12 | z << 2).to_bytes(4, "big"))
    result += [b"".join(map(_two, face)) for face in _faces(codes, told)]
    return b"".join(result)


def take_apart(packed: bytes) -> Parts:
    """Return the parts of a packed mesh. InputError if it is not complete."""
    if len(packed) < 5 or packed[0] > NORMALS + WIDE:
        raise InputError("these bytes are no packed mesh")
    form, n, m = packed[0], int.from_bytes(packed[1:3], "big"), int.from_bytes(packed[3:5], "big")
    size = 3 if form & WIDE else 2
    stride = 3 * size + (7 if form & NORMALS else 3)
    faces = 5 + n * stride
    if len(packed) != faces + 6 * m:
        raise InputError(f"a packed mesh of {n} vertices and {m} faces has {faces + 6 * m} bytes, not {len(packed)}")
    top = 1 << 8 * size - 1
    positions, colors, normals = [], [], []
    for at in range(5, faces, stride):
        x, y, z = (int.from_bytes(packed[k : k + size], "big") ^ top for k in range(at, at + 3 * size, size))
        positions.append((x, y, z))
        colors.append(int.from_bytes(packed[at + 3 * size : at + 3 * size + 3], "big"))
        normals.append(int.from_bytes(packed[at + 3 * size + 3 : at + stride], "big"))
    corners = [int.from_bytes(packed[at : at + 2], "big") for at in range(faces, len(packed), 2)]
    if max(corners, default=-1) >= n:
        raise InputError(f"a face names vertex {max(corners)}, but they are numbered 0 to {n - 1}")
    triples = list(zip(corners[::3], corners[1::3], corners[2::3], strict=True))
    return Parts(form, positions, colors, normals, triples)


def _packed_fields(fields: list[tuple[int, tuple[int, ...]]], count: int) -> bytes:
    """Return the numbers of each vertex in so many bits each, one after the other."""
    texts = ["".join(f"{values[k]:0{size}b}" for size, values in fields if size) for k in range(count)]
    bits = "".join(texts)
    bits += "0" * (-len(bits) % 8)
    return int(bits, 2).to_bytes(len(bits) // 8, "big") if bits else b""


class _Recent:
    """What both sides remember: the edges of the last faces, as a face beyond them would begin; the last vertices that
    were new or told; and how many were new.
    """

    def __init__(self) -> None:
        self.edges: deque[Edge] = deque(maxlen=EDGES)
        self.vertices: deque[int] = deque(maxlen=RECENT)
        self.met = 0

    def push(self, face: Face) -> None:
        a, b, c = face
        self.edges.appendleft((b, a))
        self.edges.appendleft((c, b))

    def meet(self) -> int:
        """Return the next new vertex."""
        self.met += 1
        self.vertices.appendleft(self.met - 1)
        return self.met - 1

    def tell(self, vertex: int) -> int:
        """Return a vertex that was told."""
        self.vertices.appendleft(vertex)
        return vertex


def _order(faces: list[Face], count: int) -> tuple[list[int], list[int], list[int]]:
    """Return the bytes of the faces, those of the vertices that are told, and the old numbers of vertices in the new
    order.
    """
    beyond: defaultdict[Edge, list[tuple[int, int]]] = defaultdict(list)
    for number, (a, b, c) in enumerate(faces):
        for edge, third in (((a, b), c), ((b, c), a), ((c, a), b)):
            beyond[edge].append((number, third))
    left = [True] * len(faces)
    new: dict[int, int] = {}
    order: list[int] = []
    codes: list[int] = []
    told: list[int] = []
    recent = _Recent()
    start = 0

    def meet(vertex: int) -> None:
        new[vertex] = recent.meet()
        order.append(vertex)

    def tell(vertex: int) -> None:
        back = recent.met - 1 - new[vertex]
        told.extend([back] if back < FAR else [FAR, *_two(new[vertex])])
        recent.tell(new[vertex])

    def low_code(vertex: int) -> int:
        if vertex not in new:
            return 0
        number = new[vertex]
        if number in recent.vertices:
            return 1 + recent.vertices.index(number)
        return TOLD

    for _ in faces:
        best: tuple[int, int, int, int] | None = None
        for place, (a, b) in enumerate(recent.edges):
            for number, third in beyond[order[a], order[b]]:
                if left[number]:
                    low = low_code(third)
                    cost = 2 if low == TOLD else 1 if low == 0 else 0
                    if best is None or cost < best[0]:
                        best = cost, place, number, third
        if best is not None:
            _, place, number, third = best
            a, b = recent.edges[place]
            low = low_code(third)
            codes.append(place << 4 | low)
            if low == 0:
                meet(third)
            elif low == TOLD:
                tell(third)
            face = b, new[third], a
        else:
            while not left[start]:
                start += 1
            number = start
            corners = faces[number]
            low = 0
            for bit, vertex in enumerate(corners):
                low |= (vertex in new) << bit
                (tell if vertex in new else meet)(vertex)
            codes.append(NO_EDGE << 4 | low)
            face = new[corners[0]], new[corners[1]], new[corners[2]]
        left[number] = False
        recent.push(face)
    # vertices that no face names come last
    order += [vertex for vertex in range(count) if vertex not in new]
    return codes, told, order


def _faces(codes: bytes, told: bytes) -> list[Face]:
    """Return the faces of their bytes."""
    recent = _Recent()
    at = 0

    def read() -> int:
        nonlocal at
        if told[at] == FAR:
            at += 3
            return recent.tell(int.from_bytes(told[at - 2 : at], "big"))
        at += 1
        return recent.tell(recent.met - 1 - told[at - 1])

    result: list[Face] = []
    for code in codes:
        place, low = code >> 4, code & 15
        if place == NO_EDGE:
            first, second, third = (read() if low >> bit & 1 else recent.meet() for bit in range(3))
            face = first, second, third
        else:
            a, b = recent.edges[place]
            if 0 < low <= RECENT:
                c = recent.vertices[low - 1]
            elif low == TOLD:
                c = read()
            else:
                c = recent.meet()
            face = b, c, a
        result.append(face)
        recent.push(face)
    return result


def _two(value: int) -> bytes:
    return value.to_bytes(2, "big")
