"""Compression of meshes for storage, to half the size or less. The format: contracts/src/mesh/CompactMesh.sol.

Faces are ordered so that most share an edge with one of the last few, and vertices are numbered in the order of their
first use: a face usually takes one byte, and a vertex as many bits as its coordinates need. Decompression preserves
this order, and nothing else of a mesh changes.
"""

from __future__ import annotations

from collections import defaultdict, deque
from dataclasses import dataclass

from ..errors import InputError
from ..scene import NORMALS, WIDE

#: First byte of a compact mesh. Packed meshes begin with 0 to 3.
COMPACT = 0x10

#: Number of recent edges and vertices that a face may refer to.
EDGES = 15
RECENT = 14
#: Upper half of a face's byte: no shared edge. Lower half: 0 is the next new vertex, 1 to 14 a recent one, 15 an
#: explicit index.
NO_EDGE = 15
EXPLICIT = 15
#: An explicit index is a distance from the newest vertex in a byte, or this byte and the number in two.
FAR = 255

Face = tuple[int, int, int]
Edge = tuple[int, int]


@dataclass(frozen=True)
class Parts:
    """The parts of a packed mesh. positions: coordinates plus half their range, so that they begin at 0."""

    format: int
    positions: list[tuple[int, int, int]]
    colors: list[int]
    normals: list[int]
    faces: list[Face]


def compact(packed: bytes, normal_bits: int = 10) -> bytes:
    """Compress a packed mesh.

    normal_bits: bits of each coordinate of a normal, 4 to 10; 10 is lossless.
    """
    if not 4 <= normal_bits <= 10:
        raise InputError(f"a coordinate of a normal can be stored in 4 to 10 bits, not {normal_bits}")
    parts = split_mesh(packed)
    codes, explicit, order = _order(parts.faces, len(parts.positions))
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
    bits = 0
    if parts.format & NORMALS:
        bits = normal_bits
        normals = [parts.normals[v] for v in order]
        for shift in (22, 12, 2):
            values = tuple(((normal >> shift & 1023) ^ 512) >> (10 - bits) for normal in normals)
            fields.append((bits, values))
    header = bytes([COMPACT, parts.format])
    header += b"".join(_two(value) for value in (len(order), len(parts.faces), len(explicit)))
    header += bytes(widths) + b"".join(value.to_bytes(3, "big") for value in base)
    header += _two(len(palette)) + bytes([color_bits, bits])
    return b"".join(
        [
            header,
            *(color.to_bytes(3, "big") for color in palette),
            bytes(codes),
            bytes(explicit),
            _packed_fields(fields, len(order)),
        ]
    )


def vertex_order(packed: bytes) -> list[int]:
    """Return the numbers that vertices of a packed mesh had before `compact`, in their order after it."""
    parts = split_mesh(packed)
    return _order(parts.faces, len(parts.positions))[2]


def split_mesh(packed: bytes) -> Parts:
    """Split a packed mesh into its parts. Raises InputError if it is invalid."""
    if len(packed) < 5 or packed[0] > NORMALS + WIDE:
        raise InputError("these bytes are not a packed mesh")
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
    """Concatenate the fields of each vertex, each with its number of bits."""
    texts = ["".join(f"{values[k]:0{size}b}" for size, values in fields if size) for k in range(count)]
    bits = "".join(texts)
    bits += "0" * (-len(bits) % 8)
    return int(bits, 2).to_bytes(len(bits) // 8, "big") if bits else b""


class _Recent:
    """State that the decoder has too: edges of recent faces, reversed; recent vertices; number of vertices."""

    def __init__(self) -> None:
        self.edges: deque[Edge] = deque(maxlen=EDGES)
        self.vertices: deque[int] = deque(maxlen=RECENT)
        self.count = 0

    def push(self, face: Face) -> None:
        a, b, c = face
        self.edges.appendleft((b, a))
        self.edges.appendleft((c, b))

    def add(self) -> int:
        """Return the number of the next new vertex."""
        self.count += 1
        self.vertices.appendleft(self.count - 1)
        return self.count - 1


def _order(faces: list[Face], count: int) -> tuple[list[int], list[int], list[int]]:
    """Return the bytes of the faces, those of explicit indices, and the old numbers of vertices in the new order."""
    beyond: defaultdict[Edge, list[tuple[int, int]]] = defaultdict(list)
    for number, (a, b, c) in enumerate(faces):
        for edge, third in (((a, b), c), ((b, c), a), ((c, a), b)):
            beyond[edge].append((number, third))
    left = [True] * len(faces)
    new: dict[int, int] = {}
    order: list[int] = []
    codes: list[int] = []
    explicit: list[int] = []
    recent = _Recent()
    start = 0

    def add(vertex: int) -> None:
        new[vertex] = recent.add()
        order.append(vertex)

    def refer(vertex: int) -> None:
        back = recent.count - 1 - new[vertex]
        explicit.extend([back] if back < FAR else [FAR, *_two(new[vertex])])
        recent.vertices.appendleft(new[vertex])

    def low_code(vertex: int) -> int:
        if vertex not in new:
            return 0
        number = new[vertex]
        if number in recent.vertices:
            return 1 + recent.vertices.index(number)
        return EXPLICIT

    for _ in faces:
        best: tuple[int, int, int, int] | None = None
        for place, (a, b) in enumerate(recent.edges):
            for number, third in beyond[order[a], order[b]]:
                if left[number]:
                    low = low_code(third)
                    cost = 2 if low == EXPLICIT else 1 if low == 0 else 0
                    if best is None or cost < best[0]:
                        best = cost, place, number, third
        if best is not None:
            _, place, number, third = best
            a, b = recent.edges[place]
            low = low_code(third)
            codes.append(place << 4 | low)
            if low == 0:
                add(third)
            elif low == EXPLICIT:
                refer(third)
            face = b, new[third], a
        else:
            while not left[start]:
                start += 1
            number = start
            corners = faces[number]
            low = 0
            for bit, vertex in enumerate(corners):
                low |= (vertex in new) << bit
                (refer if vertex in new else add)(vertex)
            codes.append(NO_EDGE << 4 | low)
            face = new[corners[0]], new[corners[1]], new[corners[2]]
        left[number] = False
        recent.push(face)
    # vertices that no face uses come last
    order += [vertex for vertex in range(count) if vertex not in new]
    return codes, explicit, order


def _two(value: int) -> bytes:
    return value.to_bytes(2, "big")
