"""Find the opacity of a fragment of an object whose vertices have opacities of their own."""

from __future__ import annotations

from .clipper import value_of
from .fragment_light import corrected
from .mesh import Mesh
from .primitive_assembly import Triangle
from .registers import Registers
from .scene_errors import Reverted
from .structs import Scene

#: The kind of the record: a byte for each vertex of an object, and zeros up to a whole word.
OPACITIES = 9
#: What a fragment hides that is opaque, Q10.
FULL = 255 << 10


def check_opacities(content: bytes, index: int, scene: Scene) -> None:
    """Check the content of a record."""
    if index >= len(scene.objects):
        raise Reverted("ExtensionIndex", kind=OPACITIES, index=index, count=len(scene.objects))
    vertices = int.from_bytes(scene.objects[index].mesh[1:3], "big")
    expected = max(vertices + -vertices % 32, 32)
    if len(content) != expected:
        raise Reverted("ExtensionSize", kind=OPACITIES, index=index, expected=expected, actual=len(content))


def set_triangle(triangle: Triangle, mesh: Mesh, r: Registers) -> None:
    """Set the opacities of the vertices of a triangle, 0..255 as Q16."""
    content = r.opacities
    if content is not None:

        def read(vertex: int) -> tuple[int]:
            return (content[vertex] << 16,)

        corners = (triangle.a, triangle.b, triangle.c)
        (r.opacity_0,), (r.opacity_1,), (r.opacity_2,) = (
            value_of(each, triangle.face, mesh, read, r) for each in corners
        )


def opacity_at(depth: int, s: int, t: int, r: Registers) -> int:
    """Return the opacity of a fragment, Q24; parameters as for `color_at`."""
    s, t = corrected(depth, s, t, r)
    to_1, to_2 = (each - r.opacity_0 >> 6 for each in (r.opacity_1, r.opacity_2))
    own = (r.opacity_0 << 18) + to_1 * s + to_2 * t >> 24
    return r.object_opacity * min(max(own, 0), FULL) // FULL
