"""Find the colour of a texture at a fragment, as OpenGL does."""

from __future__ import annotations

from dataclasses import dataclass

from .clipper import value_of
from .mesh import Mesh
from .primitive_assembly import Triangle
from .registers import Registers
from .scene_errors import Reverted
from .structs import Scene

#: The kind of the record.
TEXTURE = 8
#: Flags.
BILINEAR, CLAMP = 1, 2
#: Bytes before the palette; bits of a texel that is a colour; bytes of a pair of coordinates.
HEADER, COLOR_BITS, UV_SIZE = 4, 24, 6
ONE_24, HALF_24, ONE_12 = 1 << 24, 1 << 23, 1 << 12


@dataclass(frozen=True)
class Texture:
    """The parts of the content of a record TEXTURE."""

    content: bytes

    @property
    def width(self) -> int:
        """Texels of a row."""
        return self.content[1] + 1

    @property
    def height(self) -> int:
        """Rows."""
        return self.content[2] + 1

    @property
    def bits(self) -> int:
        """Of a texel."""
        return self.content[3]

    @property
    def texels(self) -> int:
        """The place of the texels."""
        return HEADER + (0 if self.bits == COLOR_BITS else 3 << self.bits)

    @property
    def coordinates(self) -> int:
        """The place of the coordinates of vertices."""
        return self.texels + (self.width * self.height * self.bits + 7) // 8

    def texel(self, column: int, row: int) -> tuple[int, int, int]:
        """Return the colour of a texel, 0..255."""
        place = (row * self.width + column) * self.bits
        at = self.texels + (place >> 3)
        red, green, blue = self.content[at : at + 3].ljust(3, b"\0")
        if self.bits != COLOR_BITS:
            number = (red << (place & 7) & 0xFF) >> (8 - self.bits)
            red, green, blue = self.content[HEADER + 3 * number : HEADER + 3 * number + 3]
        return red, green, blue

    def uv(self, vertex: int) -> tuple[int, int]:
        """Return the coordinates of a vertex, Q16."""
        at = self.coordinates + UV_SIZE * vertex
        u, v = (int.from_bytes(self.content[place : place + 3], "big", signed=True) for place in (at, at + 3))
        return u, v

    def sample(self, u: int, v: int) -> tuple[int, int, int]:
        """Return the colour at texture coordinates, Q24, as red, green and blue, Q16, where 255 is one."""
        left, right, x = along(u, self.width, self.content[0])
        above, below, y = along(v, self.height, self.content[0])
        if self.content[0] & BILINEAR == 0:
            sums = [level << 24 for level in self.texel(left, above)]
        else:
            weights = ((ONE_12 - x) * (ONE_12 - y), x * (ONE_12 - y), (ONE_12 - x) * y, x * y)
            places = ((left, above), (right, above), (left, below), (right, below))
            texels = [self.texel(*place) for place in places]
            sums = [sum(w * texel[i] for w, texel in zip(weights, texels, strict=True)) for i in range(3)]
        # Q24 levels times 257 / 2^16; from a half on one more, so that 255 is one
        red, green, blue = ((total := level * 257 >> 24) + (total >> 15) for level in sums)
        return red, green, blue


def check_texture(content: bytes, index: int, scene: Scene) -> None:
    """Check the content of a record TEXTURE of an object."""
    if index >= len(scene.objects):
        raise Reverted("ExtensionIndex", kind=TEXTURE, index=index, count=len(scene.objects))
    if not content:
        raise Reverted("ExtensionSize", kind=TEXTURE, index=index, expected=32, actual=0)
    flags, bits = content[0], content[3]
    if flags > BILINEAR | CLAMP or bits not in (1, 2, 4, 8, COLOR_BITS):
        raise Reverted("TextureFormat", object=index, flags=flags, bits=bits)
    vertices = int.from_bytes(scene.objects[index].mesh[1:3], "big")
    expected = Texture(content).coordinates + UV_SIZE * vertices
    expected += -expected % 32
    if len(content) != expected:
        raise Reverted("ExtensionSize", kind=TEXTURE, index=index, expected=expected, actual=len(content))


def along(x: int, size: int, flags: int) -> tuple[int, int, int]:
    """Return the texel at or before a coordinate (Q24) along a side, that after it, and the part from one to the
    other, Q12.
    """
    x = (min(max(x, 0), ONE_24 - 1) if flags & CLAMP else x % ONE_24) * size
    if flags & BILINEAR == 0:
        return x >> 24, 0, 0
    x -= HALF_24
    first = x >> 24
    part = (x >> 12) & (ONE_12 - 1)
    if flags & CLAMP:
        return max(first, 0), min(first + 1, size - 1), part
    return first % size, (first + 1) % size, part


def set_triangle(triangle: Triangle, mesh: Mesh, r: Registers) -> None:
    """Set the texture coordinates of the vertices of a triangle, Q16."""
    if r.texture is not None:
        read = Texture(r.texture).uv
        r.uvs = [value_of(vertex, triangle.face, mesh, read, r) for vertex in (triangle.a, triangle.b, triangle.c)]


def color_at(s: int, t: int, r: Registers) -> tuple[int, int, int]:
    """Return the colour at barycentric coordinates, Q24, that are correct in perspective: see `Texture.sample`."""
    assert r.texture is not None
    (u0, v0), (u1, v1), (u2, v2) = r.uvs
    u = (u0 << 24) + (u1 - u0) * s + (u2 - u0) * t
    v = (v0 << 24) + (v1 - v0) * s + (v2 - v0) * t
    return Texture(r.texture).sample(u >> 16, v >> 16)
