"""The colours that triangles may have in pixels.

The colour of a triangle in a pixel is computed once, somewhere in it: at its centre, at a sample, or at the middle of
the samples that the triangle covers. Only whether a light with shadows reaches it is decided for each sample.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from picture import FLAT, SUBPIXELS, UNLIT, Array, Integers, mix

from .light import colors
from .pieces import Pieces
from .shadows import Shadows
from .visibility import AROUND, TOLERANCE, Seen
from .world import Booleans, World

#: Where pictures may differ from the formulas; docs/conformance.md has a row for each.
#: slivers: a triangle of less than a pixel may have another colour.
#: backs: a face that is seen from the side that is turned away from the light is not in shadow.
#: fans: a clipped face is drawn as several triangles; a pixel on an edge between them has a fragment of each.
#: wires: the line of sight to a wire is that of another point of it.
#: wholes: a pixel inside a smooth surface has the colour of the triangle that covers its first sample, or of a part of
#: the surface next to it that is hidden.
RULES = ("slivers", "backs", "fans", "wires", "wholes")
#: The number of the last one.
WHOLES = RULES.index("wholes")
#: The guard band, in pixels: faces that leave it are clipped.
GUARD_BAND = (-1536, 2560)
#: Antialiased triangles of less height, in pixels, have the colour of their first vertex if they are not smooth and the
#: scene has no effects.
SLIVER = 1 / 16


@dataclass(frozen=True)
class Fragments:
    """For each row of what is seen: its colours (1 + rules, 3, n, 3) and opacity (3, n, 1), the least, the likely and
    the most; by the formulas, and with each of the rules. Whether the light with shadows may reach it, and may not.
    """

    colors: Array
    opacity: Array
    lit: Booleans
    dark: Booleans


def fragments(
    world: World, shadows: Shadows | None, pieces: Pieces, rows: Seen, reached: Seen, places: Array
) -> Fragments:
    """Return the colours of rows; `reached` are those of all samples that pieces may cover, also hidden ones, and
    `places` those of the samples.
    """
    pixels = np.int64(world.camera.width * world.camera.height)
    keys, key = np.unique(rows.piece * pixels + rows.pixel, return_inverse=True)
    count, piece = len(keys), keys // pixels
    center = np.zeros((count, 2))
    center[key] = rows.center
    # a wire of about 45 degrees is looked at in its column and in its row
    second = np.flatnonzero((rows.center != center[key]).any(axis=1))
    place, owner = [center, rows.center[second]], [np.arange(count), key[second]]
    if len(places) > 1 and count:
        other = reached.piece * pixels + reached.pixel
        which = np.minimum(np.searchsorted(keys, other), count - 1)
        known = keys[which] == other
        which, covers = which[known], reached.covers[known]
        samples = (reached.center + places[reached.sample])[known]
        covered = np.bincount(which[covers], minlength=count)
        part = np.flatnonzero((covered > 0) & (covered < len(places)))
        middle = np.stack([np.bincount(which[covers], samples[covers, axis], count) for axis in (0, 1)], axis=1)
        edge = covered[which] < len(places)
        place += [samples[edge], middle[part] / covered[part, None]]
        owner += [which[edge], part]
    at, to = np.concatenate(place), np.concatenate(owner)
    # only at the centre of the pixel, colours are computed outside of the triangle
    inside = np.arange(len(at)) >= count
    surface = world.object_of(pieces.face)
    textured = world.are(lambda s: s.texture is not None)
    near = np.flatnonzero(textured[surface[piece[to]]])
    at = np.concatenate([at, (at[near, None] + AROUND[1:]).reshape(-1, 2)])
    to, inside = (np.concatenate([each, np.repeat(each[near], len(AROUND) - 1)]) for each in (to, inside))
    weights = pieces.weights_at(piece[to], at, inside)
    faceted = world.are(lambda s: s.shading <= FLAT) & (world.antialias and not world.exact)
    thin = np.flatnonzero((pieces.height[piece] < SLIVER) & faceted[surface[piece]])
    weights = np.concatenate([weights, pieces.weights[piece[thin]].reshape(-1, 3)])
    parts = [places[list(part)].mean(axis=0) for size in (1, 2, 3) for part in combinations(range(len(places)), size)]
    offsets = (np.unique(parts, axis=0)[:, None] + AROUND[[0, 1, 3, 5, 7]]).reshape(-1, 2)
    low, high = (SUBPIXELS * edge for edge in GUARD_BAND)
    clipped = pieces.is_cut | ((pieces.corners < low) | (pieces.corners >= high)).any(axis=(1, 2))
    fan = np.flatnonzero(textured[surface[piece]] & clipped[piece] & (len(places) > 1))
    owner_of_fan = np.repeat(fan, len(offsets))
    within = (center[fan, None] + offsets).reshape(-1, 2)
    weights = np.concatenate([weights, pieces.weights_at(piece[owner_of_fan], within, np.ones(len(within), bool))])
    end, to = len(to), np.concatenate([to, np.repeat(thin, 3), owner_of_fan])
    points, formulas = np.arange(len(to)), np.arange(end)
    slivers, fans = points[: len(to) - len(within)], np.delete(points, slice(end, end + 3 * len(thin)))
    shaded = _shaded(world, surface[piece[to]], pieces.face[piece[to]], weights)
    wire = np.flatnonzero(pieces.is_wire[piece[to[:end]]])
    to_wire = to[wire]
    # plain wires are looked at on the line, but drawn at centres
    row, column = np.divmod(keys[to_wire] % pixels, world.camera.width)
    spots = at[wire] if world.antialias else np.stack([column, row], axis=1) + 0.5
    beside = _shaded(world, surface[piece[to_wire]], pieces.face[piece[to_wire]], weights[wire], spots)
    wires, to = np.append(formulas, len(to) + np.arange(len(wire))), np.concatenate([to, to_wire])
    lit, dark, opacity = (np.concatenate(both, axis=1) for both in zip(shaded, beside, strict=True))
    may_be_lit, may_be_dark = _reached(world, shadows, pieces, rows, places, surface)
    unseen = may_be_lit if shadows is None else may_be_lit | shadows.backs[pieces.face[rows.piece]]
    colors = []
    for rule, chosen in enumerate((formulas, slivers, formulas, fans, wires, formulas)):
        reach = unseen if rule == 2 else may_be_lit
        both = [_extent(values[:, chosen], to[chosen], count)[:, key] for values in (lit, dark)]
        colors.append(_either(both[0], both[1], reach, may_be_dark))
    return Fragments(np.stack(colors), _extent(opacity[:, fans], to[fans], count)[:, key], may_be_lit, may_be_dark)


def _shaded(
    world: World, surface: Integers, face: Integers, weights: Array, places: Array | None = None
) -> tuple[Array, Array, Array]:
    """Colours (3, n, 3), lit and dark, and opacities (3, n, 1) of points. places: see `colors`."""
    lit, dark, opacity = np.zeros((3, len(face), 3)), np.zeros((3, len(face), 3)), np.ones((3, len(face), 1))
    for number in np.unique(surface):
        chosen = np.flatnonzero(surface == number)
        spots = None if places is None else places[chosen]
        found = colors(world, world.objects[number], face[chosen] - world.firsts[number], weights[chosen], spots)
        lit[:, chosen], dark[:, chosen], opacity[:, chosen, 0] = found
    return lit, dark, opacity


def _extent(values: Array, owner: Integers, count: int) -> Array:
    """The least, the likely and the most of the points of each owner; the first points are the likely ones."""
    order = np.argsort(owner, kind="stable")
    firsts = np.searchsorted(owner[order], np.arange(count))
    if not count:
        return values
    low, high = np.minimum.reduceat(values[0, order], firsts), np.maximum.reduceat(values[2, order], firsts)
    return np.stack([low, values[1, :count], high])


def _either(lit: Array, dark: Array, may_be_lit: Booleans, may_be_dark: Booleans) -> Array:
    """What a range is where it may be one of two."""
    low = np.where(may_be_dark[:, None], np.where(may_be_lit[:, None], np.minimum(lit[0], dark[0]), dark[0]), lit[0])
    high = np.where(may_be_lit[:, None], np.where(may_be_dark[:, None], np.maximum(lit[2], dark[2]), lit[2]), dark[2])
    return np.stack([low, np.where(may_be_lit[:, None], lit[1], dark[1]), high])


def _reached(
    world: World, shadows: Shadows | None, pieces: Pieces, rows: Seen, places: Array, surface: Integers
) -> tuple[Booleans, Booleans]:
    """Whether the light with shadows may reach the samples, and whether it may not."""
    own = rows.center + places[rows.sample]
    lit, dark = np.ones(len(own), bool), np.zeros(len(own), bool)
    if shadows is None:
        return lit, dark
    shaded = world.are(lambda s: s.shading != UNLIT and not s.is_wire)
    chosen = np.flatnonzero(shaded[surface[rows.piece]])
    # in blocks of the canvas, so that few faces shade those that are looked at together
    chosen = chosen[np.lexsort((*(own[chosen].T // 8), surface[rows.piece[chosen]]))]
    piece = rows.piece[chosen]
    face, which = pieces.face[piece], surface[piece]
    points = []
    for move in ((0.0, 0.0), (TOLERANCE, 0.0), (0.0, TOLERANCE)):
        weights = pieces.weights_at(piece, own[chosen] + move, np.zeros(len(piece), bool))
        found = np.zeros((len(piece), 3))
        for number in np.unique(which):
            each, part = world.objects[number], which == number
            found[part] = mix(each.points[each.faces[face[part] - world.firsts[number]]], weights[part])
        points.append(found)
    lit[chosen], dark[chosen] = shadows.on(points[0], points[1] - points[0], points[2] - points[0], face)
    return lit, dark
