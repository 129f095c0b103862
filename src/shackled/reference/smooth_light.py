"""Light smooth surfaces by one lamp: products of vectors that are quadratic over a triangle.

Normals N are interpolated between the vertices, and so are the directions L to the light and the half vectors H, which
turn little within a triangle. A fragment takes N * N, N * L and N * H from differences, and

    diffuse = N * L / |N|,  specular = ((N * H)^2 / N * N)^(shininess / 2)

The contract says how far that is from the light at the fragment itself.
"""

from __future__ import annotations

from . import quadratic
from .fragment_shader import ray_of
from .layout import LANE_85, MIDDLE_LANE_85
from .primitive_assembly import Triangle
from .registers import Registers
from .roots import sqrt
from .vertex_shader import SmoothVertex, Vertex
from .words import MASK, divide, divide_signed, signed

#: Half the range of a lane of 85 bits, for vectors of Q20.
VECTOR_BIAS = 0x100000000000000000000080000000000000000000040000000

UNBOUNDED_LIGHT, AFFINE_LIGHT, STEEP_LIGHT = 0, 1, 2

#: Three and a half levels, as 12 times as much (Q50) and as 32 times (Q30): see the contract.
LEVELS_12, LEVELS_32 = 1 << 49, 0x55555555


def product(a: int, b: int) -> int:
    """Return the scalar product of two vectors in lanes, one of them reversed."""
    return signed((a * b) << 1) >> 171


def products(n: int, r: int, light: int, m: int, half: int) -> int:
    """Return lanes n * r, n * light, m * half, of reversed r, light and half; n and m are Q30, sums Q20."""
    square, diffuse, specular = product(n, r) >> 40, product(n, light) >> 30, product(m, half) >> 30
    return (square << 170) + (diffuse << 85) + specular


def set_light(triangle: Triangle, size: int, registers: Registers) -> int:
    """Set the quadratic products of a triangle. size: the sum of the squares of two edges.

    Returns UNBOUNDED_LIGHT if they may be too far from the light of each fragment; AFFINE_LIGHT if the depths of the
    vertices are so near to each other that colours may be interpolated linearly, else STEEP_LIGHT.
    """
    r = registers
    if size >= r.smooth_reach_3:
        return UNBOUNDED_LIGHT
    vertices = (triangle.a, triangle.b, triangle.c)
    for vertex in vertices:
        if vertex.smooth is None:
            vertex.smooth = smooth_vertex(vertex, r)
    corners = [vertex.smooth for vertex in vertices if vertex.smooth and vertex.smooth.is_bounded]
    if len(corners) < 3:
        return UNBOUNDED_LIGHT
    weights = [1024, 1024, 1024]
    if not r.frame_is_orthographic:
        # depths divided by the greatest
        depths = [vertex.attributes >> 168 for vertex in vertices]
        weights = [divide(depth << 10, max(depths)) for depth in depths]
        if min(weights) < 980 and r.lights[0].is_point:
            # the change of depth, as long as it would be on the screen
            size += divide((1024 - min(weights)) << 32, (min(weights) + 1) * r.ray_step) ** 2
    normals = [weight * vertex.normal for weight, vertex in zip(weights, vertices, strict=True)]
    turned = [weight * corner.reversed for weight, corner in zip(weights, corners, strict=True)]
    a, b, c = (
        products(n, t, corner.light, n, corner.half_reversed)
        for n, t, corner in zip(normals, turned, corners, strict=True)
    )
    edges, changes = [], 0
    pairs = ((0, 1), (0, 2), (1, 2))
    for i, j in pairs:
        # products of the changes from one vertex to another
        n, u, v = normals[j] - normals[i], corners[i], corners[j]
        half, half_reversed = v.half - u.half, v.half_reversed - u.half_reversed
        changes = max(changes, product(half, half_reversed))
        edges.append(products(n, turned[j] - turned[i], v.light - u.light, n - (half << 9), half_reversed))
    # three times the least N * N: that of the vertices less a third of the largest square of a change
    most = max(map(signed, edges)) >> 170
    least = 3 * (signed(min(signed(a), signed(b), signed(c))) >> 170) - most
    if least <= 3 << 18:
        return UNBOUNDED_LIGHT
    # where H turns fast, a fourth of the reach
    reach = r.smooth_reach >> (0 if all(corner.is_open for corner in corners) else 2)
    if size >= reach or changes * r.half_slope * ((3 << 20) - least) > least * LEVELS_12:
        if size >= r.smooth_reach_3 or changes >= 3 << 37:
            return UNBOUNDED_LIGHT
        skew = 0
        for edge, (i, j) in enumerate(pairs):
            middle = middle_vertex(vertices[i], vertices[j], r)
            if not middle.smooth or not middle.smooth.is_bounded:
                return UNBOUNDED_LIGHT
            added, bend = correction(normals[i], normals[j], corners[i], corners[j], middle.smooth)
            edges[edge] += added
            skew = max(skew, bend)
        place = middle_vertex(vertices[0], middle, r).smooth
        assert place
        # 16 times the products at (1/2, 1/4, 1/4), and the error of N * H there
        inner = 8 * a + 4 * (b + c) - 2 * (edges[0] + edges[1]) - edges[2]
        error = 4 * (product(2 * normals[0] + normals[1] + normals[2], place.half_reversed) >> 30) - inner
        error = _size(_lowest(error)) + skew
        if error * r.half_slope * ((3 << 20) + least) > least * LEVELS_32:
            # not near the highlight
            nodes = [(inner, 4), *((value, 0) for value in (a, b, c))]
            nodes += [(2 * (u + v) - edge, 2) for u, v, edge in zip((a, a, b), (b, c, c), edges, strict=True)]
            if max(_square(*node) for node in nodes) + (most + (changes >> 20) >> 2) >= r.far_from_highlight:
                return UNBOUNDED_LIGHT
    ab, ac, bc = edges
    coefficients = quadratic.Coefficients(a, b - a - ab, c - a - ac, ab, ab + ac - bc, ac)
    r.quadratic = quadratic.differences(triangle.a, triangle.b, triangle.c, 0, coefficients)
    # colours of up to 255 may differ without limit where depths differ by at most 12 / 255: see shading.is_affine
    return STEEP_LIGHT if min(weights) < 980 else AFFINE_LIGHT


def _size(value: int) -> int:
    """Return a number without its sign; one less where it is negative."""
    return value ^ value >> 255


def _lowest(packed: int) -> int:
    """Return the lowest lane."""
    return signed(packed << 171) >> 171


def _square(packed: int, shift: int) -> int:
    """Return the cos^2 of N and H, Q20, from products that are multiplied by 2^shift."""
    cosine = max(_lowest(packed), 0)
    return divide(cosine * cosine, (signed(packed) >> 170) << shift)


def middle_vertex(a: Vertex, b: Vertex, registers: Registers) -> Vertex:
    """Return the vertex in the middle of two, with the normal of the first."""
    depth = (a.attributes >> 168) + (b.attributes >> 168) >> 1
    vertex = Vertex(0, a.x + b.x >> 1, a.y + b.y >> 1, False, False, depth << 168, a.normal)
    vertex.smooth = smooth_vertex(vertex, registers)
    return vertex


def correction(n: int, m: int, a: SmoothVertex, b: SmoothVertex, middle: SmoothVertex) -> tuple[int, int]:
    """Return what to add to the products of the changes along an edge, so that they are right in its middle, and twice
    the skew that remains: see the contract.

    Four times the error there, (N_a + N_b) * (L_a + L_b - 2 L), and the same of H, which is not too short there.
    """
    diffuse = product(n + m, a.light + b.light - 2 * middle.light) >> 30
    bend = a.half_reversed + b.half_reversed - 2 * middle.half_reversed
    specular = product(n + m, bend) >> 30
    turn = a.half_reversed - b.half_reversed
    shortness = product(a.half - b.half, turn) >> 21
    skew = 2 * (_size(product(m - n, bend) >> 30) + _size(product(middle.half, turn) >> 19))
    return (diffuse << 85) + specular + shortness, skew


def smooth_vertex(vertex: Vertex, registers: Registers) -> SmoothVertex:
    """Return what the triangles around a vertex need."""
    r = registers
    # the ray (x, y, 1), Q24
    x, y = ray_of(vertex, r)
    light = r.lights[0]
    lx, ly, lz = light.x, light.y, light.z
    bounded = True
    length = 1 << 24
    if light.is_point:
        # from the vertex to the light, Q16
        z = divide(r.depth_scale, vertex.attributes >> 168)
        px, py, pz = x * z >> 40, y * z >> 40, z >> 16
        lx, ly, lz = lx - px, ly - py, lz - pz
        square = lx * lx + ly * ly + lz * lz
        # nearer than the eye by the root of 5/4 at most
        bounded = 4 * (px * px + py * py + pz * pz) <= 5 * square
        length = sqrt(square)
    lx, ly, lz = (divide_signed(component << 20, length) for component in (lx, ly, lz))
    if r.frame_is_orthographic:
        x = y = 0
    # H = L + V, where V is the reversed ray
    length = sqrt(x * x + y * y + (1 << 48))
    hx, hy, hz = (component - divide_signed(ray << 20, length) for component, ray in ((lx, x), (ly, y), (lz, 1 << 24)))
    square = hx * hx + hy * hy + hz * hz
    # not where the light is ahead of the eye: H turns fast there
    bounded, is_open = bounded and square > 1 << 40, square >= 3 << 40
    length = sqrt(square)
    hx, hy, hz = (divide_signed(component << 20, length) for component in (hx, hy, hz))
    lanes = (vertex.normal + VECTOR_BIAS) & MASK
    reversed_normal = ((lanes & LANE_85) << 170 | lanes >> 170 | (lanes & MIDDLE_LANE_85)) - VECTOR_BIAS
    # the square of the normal, Q40, is from 15/16 to 17/16
    bounded = bounded and 0 <= product(vertex.normal, reversed_normal) - (15 << 36) < 1 << 37
    return SmoothVertex(
        bounded,
        is_open,
        reversed_normal & MASK,
        lz + (ly << 85) + (lx << 170),
        hx + (hy << 85) + (hz << 170),
        hz + (hy << 85) + (hx << 170),
    )
