"""Values that are quadratic functions of the place on the screen, three in a word: signed lanes of 85 bits.

A smooth function that is fitted at the corners and at the middles of the edges of a triangle (the P2 element) is off by
third-order terms only.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from .words import divide_signed

if TYPE_CHECKING:
    from .vertex_shader import Vertex


class Coefficients(NamedTuple):
    """value = one + s * by_s + t * by_t + s^2 * by_ss + s * t * by_st + t^2 * by_tt.

    s and t are the barycentric coordinates of the second and the third vertex. Any Q format, Qn.
    """

    one: int
    by_s: int
    by_t: int
    by_ss: int
    by_st: int
    by_tt: int


class Differences(NamedTuple):
    """The value at column 0 of the first row, and its first and second differences to the next column and row: Qn+48.

    Words are taken modulo 2^256: lanes that overflow are right again at each pixel whose own value fits its lane.
    """

    start: int
    dx: int
    dy: int
    dxx: int
    dxy: int
    dyy: int

    def at(self, x: int, y: int) -> int:
        """Return the value in column `x`, `y` rows below the first."""
        along = x * self.dx + (x * (x - 1) >> 1) * self.dxx
        return self.start + along + y * (self.dy + x * self.dxy) + (y * (y - 1) >> 1) * self.dyy


def from_nodes(a: int, b: int, c: int, ab: int, ac: int, bc: int) -> Coefficients:
    """Return the coefficients from the values at the vertices and at the middles of the edges."""
    # along an edge: value = a + s * (b - a) + s * (1 - s) * (4 * ab - 2 * (a + b))
    ab = 4 * ab - 2 * (a + b)
    ac = 4 * ac - 2 * (a + c)
    bc = 4 * bc - 2 * (b + c)
    return Coefficients(a, b - a + ab, c - a + ac, -ab, bc - ab - ac, -ac)


def differences(a: Vertex, b: Vertex, c: Vertex, top: int, f: Coefficients) -> Differences:
    """Return the differences of a quadratic function over a triangle, from row `top` on."""
    x = a.x
    xb, yb, xc, yc = b.x - x, b.y - a.y, c.x - x, c.y - a.y
    # from the first vertex to the centres of the row
    y = (top << 8) - a.y
    area = xc * yb - xb * yc
    # change of s and t per pixel, Q24
    sx, tx = -divide_signed(yc << 32, area), divide_signed(yb << 32, area)
    sy, ty = divide_signed(xc << 32, area), -divide_signed(xb << 32, area)
    # s and t at column 0 of the first row, Q24
    s, t = (sy * y - sx * x) >> 8, (ty * y - tx * x) >> 8
    value = (f.one << 48) + s * ((f.by_s << 24) + s * f.by_ss + t * f.by_st) + t * ((f.by_t << 24) + t * f.by_tt)
    by_s = (f.by_s << 24) + 2 * s * f.by_ss + t * f.by_st
    by_t = (f.by_t << 24) + 2 * t * f.by_tt + s * f.by_st
    xx = sx * sx * f.by_ss + tx * tx * f.by_tt + sx * tx * f.by_st
    yy = sy * sy * f.by_ss + ty * ty * f.by_tt + sy * ty * f.by_st
    return Differences(
        value,
        xx + sx * by_s + tx * by_t,
        yy + sy * by_s + ty * by_t,
        2 * xx,
        2 * (sx * sy * f.by_ss + tx * ty * f.by_tt) + (sx * ty + tx * sy) * f.by_st,
        2 * yy,
    )
