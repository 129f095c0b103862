"""Compression of meshes for storage, to half the size or less. The format: contracts/src/mesh/CompactMesh.sol.

Faces are ordered so that most share an edge with one of the last few, and vertices are numbered in the order of their
first use: a face usually takes one byte, and a vertex as many bits as its coordinates need. Decompression preserves
this order, and nothing else of a mesh changes.
"""

from __future__ import annotations

from collections import defaultdict, deque
from dataclasses import dataclass

from ..errors import InputError
from ..scene._packed import NORMALS, WIDE

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
    columns = list(zip(*(parts.positions[v] for v in order), strict=True)) or [(0,)] * 3
    base = [min(column) for column in columns]
    widths = [(max(column) - low).bit_length() for column, low in zip(columns, base, strict=True)]
    fields = [
        (size, [value - low for value in column]) for size, low, column in zip(widths, base, columns, strict=True)
    ]
    colors = [parts.colors[v] for v in order]
    palette = sorted(set(colors))
    color_bits = (len(palette) - 1).bit_length()
    if 24 * len(palette) + color_bits * len(colors) >= 24 * len(colors) or len(palette) > 0xFFFF:
        palette, color_bits = [], 24
    index = {color: number for number, color in enumerate(palette)}
    fields.append((color_bits, [index.get(color, color) for color in colors]))
    bits = normal_bits if parts.format & NORMALS else 0
    for shift in (22, 12, 2) if bits else ():
        fields.append((bits, [((parts.normals[v] >> shift & 1023) ^ 512) >> (10 - bits) for v in order]))
    sizes = b"".join(map(_two, (len(order), len(parts.faces), len(explicit))))
    head = bytes([COMPACT, parts.format]) + sizes + bytes(widths) + b"".join(map(_three, base))
    head += _two(len(palette)) + bytes([color_bits, bits]) + b"".join(map(_three, palette))
    return head + bytes(codes) + bytes(explicit) + _packed_fields(fields, len(order))


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


def _packed_fields(fields: list[tuple[int, list[int]]], count: int) -> bytes:
    """Concatenate the fields of each vertex, each with its number of bits."""
    bits = "".join(f"{values[k]:0{size}b}" for k in range(count) for size, values in fields if size)
    bits += "0" * (-len(bits) % 8)
    return int(bits, 2).to_bytes(len(bits) // 8, "big") if bits else b""


def _order(faces: list[Face], count: int) -> tuple[list[int], list[int], list[int]]:
    """Return the bytes of the faces, those of explicit indices, and the old numbers of vertices in the new order."""
    beyond: defaultdict[Edge, list[tuple[int, int]]] = defaultdict(list)
    for number, (a, b, c) in enumerate(faces):
        for edge, third in (((a, b), c), ((b, c), a), ((c, a), b)):
            beyond[edge].append((number, third))
    left, unseen = set(range(len(faces))), iter(range(len(faces)))
    new: dict[int, int] = {}
    codes: list[int] = []
    explicit: list[int] = []
    # what the decoder has too: edges of recent faces, reversed, and recent vertices
    edges: deque[Edge] = deque(maxlen=EDGES)
    recent: deque[int] = deque(maxlen=RECENT)

    def low_code(vertex: int) -> int:
        if vertex not in new:
            return 0
        return 1 + recent.index(vertex) if vertex in recent else EXPLICIT

    def cost(choice: tuple[int, int, int]) -> int:
        return {0: 1, EXPLICIT: 2}.get(low_code(choice[2]), 0)

    def use(vertex: int) -> None:
        """Write a vertex that is new, or that is named by its index."""
        if vertex in new:
            back = len(new) - 1 - new[vertex]
            explicit.extend([back] if back < FAR else [FAR, *_two(new[vertex])])
        else:
            new[vertex] = len(new)
        recent.appendleft(vertex)

    while left:
        choices = [
            (place, number, third)
            for place, edge in enumerate(edges)
            for number, third in beyond[edge]
            if number in left
        ]
        if choices:
            place, number, third = min(choices, key=cost)
            b, a = edges[place]
            low = low_code(third)
            codes.append(place << 4 | low)
            if low in (0, EXPLICIT):
                use(third)
            face = a, third, b
        else:
            number = next(filter(left.__contains__, unseen))
            face, low = faces[number], 0
            for bit, vertex in enumerate(face):
                low |= (vertex in new) << bit
                use(vertex)
            codes.append(NO_EDGE << 4 | low)
        left.remove(number)
        edges.appendleft((face[1], face[0]))
        edges.appendleft((face[2], face[1]))
    # vertices that no face uses come last
    return codes, explicit, [*new, *(vertex for vertex in range(count) if vertex not in new)]


def _two(value: int) -> bytes:
    return value.to_bytes(2, "big")


def _three(value: int) -> bytes:
    return value.to_bytes(3, "big")
