"""What may be seen at each sample: every triangle that some place within 0.04 pixels of it may show.

Each sample is looked at in nine places: its own, and eight around it. Depths count as equal if a shift of a surface by
0.04 pixels makes them so. All triangles are compared with all places of the blocks of pixels that they reach.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from picture import SUBPIXELS, Array, Camera, Integers

from .pieces import Pieces
from .world import Booleans

#: How far samples are moved, in pixels.
TOLERANCE = 0.04
AROUND = TOLERANCE * np.array([(0.0, 0.0), *((np.cos(t), np.sin(t)) for t in np.arange(8) * np.pi / 4)])
#: Depths that differ by less than this part of them are equal.
SAME_DEPTH = 2.0**-21
#: Side of a block of pixels; pairs of a piece and a block that are looked at together.
BLOCK, CHUNK = 4, 192


@dataclass(frozen=True)
class Seen:
    """What pieces show, without what else is there.

    floor: (pixels, samples, 9) how near they are at least, in each place; -inf where they may leave it free.
    The other fields have a row for each sample and each piece that may be there: its number; the number of the pixel,
    and of the sample in it; its nearness, and the most that a shift can make of it; whether it is at the sample itself;
    where the pixel's colour is computed, in pixels.
    """

    floor: Array
    piece: Integers
    pixel: Integers
    sample: Integers
    nearness: Array
    most: Array
    covers: Booleans
    center: Array

    @property
    def rows(self) -> list[Any]:
        """All fields but the floor."""
        return [getattr(self, each.name) for each in fields(self)[1:]]

    def chosen(self, rows: Booleans) -> Seen:
        """Return some of the rows."""
        return Seen(self.floor, *(values[rows] for values in self.rows))


def seen(pieces: Pieces, camera: Camera, places: Array) -> Seen:
    """Find what pieces show at places (n, 2) of each pixel."""
    across, down = -(-camera.width // BLOCK), -(-camera.height // BLOCK)
    numbers, blocks = _pairs(pieces, across, down)
    lines = _lines(pieces)
    corner = BLOCK * SUBPIXELS * np.stack([blocks % across, blocks // across], axis=1)
    inner = np.stack(np.meshgrid(np.arange(BLOCK), np.arange(BLOCK)), axis=-1).reshape(-1, 1, 1, 2) + 0.5
    moved = SUBPIXELS * (inner + places[:, None] + AROUND)
    own = moved[:, :, 0].reshape(-1, 2)
    shift, least, most = _depths(pieces)
    least_edges = pieces.slack * np.linalg.norm(lines[:, :3, :2], axis=2)
    lowest = np.full((across * down, moved.size // 2), -np.inf)
    rows = []
    for start in range(0, len(numbers), CHUNK):
        part = slice(start, start + CHUNK)
        number, block = numbers[part], blocks[part]
        local = lines[number]
        local[:, :, 2] += np.einsum("pij,pj->pi", local[:, :, :2], corner[part])
        values = local[:, :4] @ _columns(moved.reshape(-1, 2))
        covers = (values[:, :3] >= least_edges[number, :, None]).all(axis=1)
        depth = np.maximum(values[:, 3] - shift[number, None], least[number, None])
        depth = np.where(covers, depth - SAME_DEPTH * np.abs(depth), -np.inf)
        firsts = np.flatnonzero(np.diff(block, prepend=-1))
        np.maximum(lowest[block[firsts]], np.maximum.reduceat(depth, firsts, axis=0), out=depth[: len(firsts)])
        lowest[block[firsts]] = depth[: len(firsts)]
        rows.append(_near(pieces, number, local @ _columns(own), shift, least, most, start))
    pair, place, nearness, high, covers = (
        (np.concatenate(each) for each in zip(*rows, strict=True))
        if rows
        else (np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0), np.empty(0), np.empty(0, bool))
    )
    at = np.rint(own[place] / SUBPIXELS - 0.5 - places[place % len(places)]) + corner[pair] / SUBPIXELS
    floor = lowest.reshape(down, across, BLOCK, BLOCK, len(places), 9).swapaxes(1, 2)
    floor = floor.reshape(down * BLOCK, across * BLOCK, len(places), 9)[: camera.height, : camera.width]
    column, row = at.astype(np.int64).T
    found = Seen(
        np.ascontiguousarray(floor).reshape(-1, len(places), 9),
        numbers[pair],
        row * camera.width + column,
        place % len(places),
        nearness,
        high,
        covers,
        at + 0.5,
    )
    return found.chosen((column < camera.width) & (row < camera.height))


def _near(
    pieces: Pieces, number: Integers, values: Array, shift: Array, least: Array, most: Array, start: int
) -> tuple[Integers, Integers, Array, Array, Booleans]:
    """Where pieces may be: pair, place, nearness, the most of it, and whether they are there.

    values: (pairs, 7, places) of the lines of the pieces. Of slivers, the depth is taken along the edges within reach:
    across them it changes too much.
    """
    edges, depth, along = values[:, :3], values[:, 3], values[:, 4:]
    inside = (edges >= 0).all(axis=1)
    length = np.linalg.norm(np.roll(pieces.corners[number], 1, 1) - np.roll(pieces.corners[number], -1, 1), axis=2)
    aside = edges / np.maximum(length, 1e-9)[..., None]
    reach = np.sqrt(np.maximum((TOLERANCE * SUBPIXELS) ** 2 - aside**2, 0))
    low, high = np.maximum(along - reach, 0), np.minimum(along + reach, length[..., None])
    met = (reach > 0) & (low <= high)
    ends = pieces.nearness[number]
    begin = np.roll(ends, -1, 1)[..., None]
    rise = (np.roll(ends, 1, 1)[..., None] - begin) / np.maximum(length, 1e-9)[..., None]
    on_edges = np.where(met, begin + np.maximum(rise * low, rise * high), -np.inf).max(axis=1)
    wide = pieces.height[number] >= 2 * TOLERANCE
    nearest = np.where(inside, np.clip(depth, least[number, None], most[number, None]), on_edges)
    high_depth = np.where(
        wide[:, None], np.minimum(depth + shift[number, None], most[number, None]), np.maximum(nearest, on_edges)
    )
    pair, place = np.nonzero(inside | met.any(axis=1))
    nearness, high_depth = nearest[pair, place], high_depth[pair, place]
    return (
        np.asarray(start + pair),
        place,
        nearness,
        high_depth + SAME_DEPTH * np.abs(high_depth),
        _owned(pieces, number, edges)[pair, place],
    )


def _owned(pieces: Pieces, number: Integers, edges: Array) -> Booleans:
    """Whether places are in pieces; those on an edge, if it is a left or a top one."""
    way = np.roll(pieces.corners[number], 1, 1) - np.roll(pieces.corners[number], -1, 1)
    owns = (way[..., 1] > 0) | ((way[..., 1] == 0) & (way[..., 0] < 0))
    return np.asarray(((edges > 0) | ((edges == 0) & owns[..., None])).all(axis=1))


def _pairs(pieces: Pieces, across: int, down: int) -> tuple[Integers, Integers]:
    """Pieces and the numbers of the blocks that they reach, in the order of the blocks."""
    size = BLOCK * SUBPIXELS
    margin = TOLERANCE * SUBPIXELS
    low = np.clip(np.floor((pieces.corners.min(axis=1) - margin) / size), 0, [across, down]).astype(np.int64)
    high = np.clip(np.floor((pieces.corners.max(axis=1) + margin) / size) + 1, 0, [across, down]).astype(np.int64)
    count = np.maximum(high - low, 0)
    total = count.prod(axis=1)
    numbers = np.repeat(np.arange(len(total)), total)
    within = np.arange(len(numbers)) - np.repeat(np.cumsum(total) - total, total)
    column = low[numbers, 0] + within % np.maximum(count[numbers, 0], 1)
    row = low[numbers, 1] + within // np.maximum(count[numbers, 0], 1)
    # those of which the whole block is beyond an edge are left out
    lines = _lines(pieces)[:, :3]
    lengths = np.maximum(np.linalg.norm(lines[:, :, :2], axis=2), 1e-9)
    middle = size * (np.stack([column, row], axis=1) + 0.5)
    value = np.einsum("pij,pj->pi", lines[numbers, :, :2], middle) + lines[numbers, :, 2]
    most = value + np.abs(lines[:, :, :2]).sum(axis=2)[numbers] * size / 2
    kept = (most >= -margin * lengths[numbers]).all(axis=1)
    numbers, blocks = numbers[kept], (row * across + column)[kept]
    order = np.argsort(blocks, kind="stable")
    return numbers[order], blocks[order]


def _lines(pieces: Pieces) -> Array:
    """(n, 7, 3) functions of column, row, 1 in sub-pixels: three edges, each across from a corner and positive within,
    the nearness, and the distances along the edges from where they begin.
    """
    begin, end = np.roll(pieces.corners, -1, 1), np.roll(pieces.corners, 1, 1)
    way = end - begin
    across = np.stack([way[..., 1], -way[..., 0]], axis=-1)
    length = np.maximum(np.linalg.norm(way, axis=2, keepdims=True), 1e-9)
    edges = np.concatenate([across, -(across * begin).sum(axis=2, keepdims=True)], axis=2)
    along = np.concatenate([way, -(way * begin).sum(axis=2, keepdims=True)], axis=2) / length
    depth = np.einsum("ni,nij->nj", pieces.nearness / pieces.area()[:, None], edges)
    return np.concatenate([edges, depth[:, None], along], axis=1)


def _depths(pieces: Pieces) -> tuple[Array, Array, Array]:
    """What a shift changes of the nearness, and the least and the most of it."""
    slope = np.linalg.norm(_lines(pieces)[:, 3, :2], axis=1)
    return TOLERANCE * SUBPIXELS * slope, pieces.nearness.min(axis=1), pieces.nearness.max(axis=1)


def _columns(places: Array) -> Array:
    return np.vstack([places.T, np.ones(len(places))])
