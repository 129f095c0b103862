"""The picture of a world: for each channel of each pixel, the range in which it may lie.

Opaque surfaces first; then each object that is not, in the order of the scene, of which a sample shows the nearest
surface. A pixel is the mean of its samples. The colour of a triangle in a pixel is computed once, somewhere in it: at
the centre, at a sample or at the middle of the samples that the triangle covers.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from picture import FLAT, Array, Integers

from .fragments import RULES, WHOLES, Fragments, fragments
from .pieces import Pieces, joined, pieces_of
from .shadows import Shadows
from .visibility import AROUND, SAME_DEPTH, Seen, seen
from .wires import seen_wires
from .world import Booleans, World

#: Opacities of texels below this may be taken as 0.
HIDDEN = 1e-4
#: Pixels of which the range is wider, in levels, contain a step: the border of a texel, the end of a highlight.
STEP = 1.0


@dataclass(frozen=True)
class Picture:
    """A picture, and what is seen in it.

    exact: (H, W, 3), as it most likely is. low, high: (H, W, 3), between what it may be. explained: the same with each
    of the RULES. triangle: (H, W) number of the face that is seen at the first sample, counted through all objects; -1
    for the background. lit: whether anything may be seen.
    interior: whether a pixel and its neighbours show one triangle of each layer, without steps.
    shown: (n, 2) numbers of pixels, row by row, and of a face that each may show. free: (H, W) whether a pixel may show
    the background.
    """

    exact: Array
    low: Array
    high: Array
    explained: dict[str, Array]
    triangle: Integers
    lit: Booleans
    interior: Booleans
    shown: Integers
    free: Booleans

    def may_show(self, column: int, row: int) -> Integers:
        """Return the numbers of the faces that a pixel may show, and -1 if it may show the background."""
        faces = np.unique(self.shown[self.shown[:, 0] == row * self.free.shape[1] + column, 1])
        return np.append(faces, -1) if self.free[row, column] else faces

    @property
    def pixels(self) -> NDArray[np.uint8]:
        """The likely picture in whole levels."""
        return np.floor(self.exact + 0.5).astype(np.uint8)


@dataclass
class _Canvas:
    """What is there so far. colors: (1 + rules, 3, pixels, samples, 3), the least, the likely and the most; by the
    formulas, and with each of the rules. floor, ceiling: how near it is at least in each place of a sample, and at most
    in a sample. nearness, triangle: of what is likely.
    """

    colors: Array
    floor: Array
    ceiling: Array
    nearness: Array
    triangle: Integers


def render(data: bytes) -> Picture:
    """Return the picture that calldata of `render(Scene)` asks for."""
    return Composition(World(data)).picture()


class Composition:
    """The layers of a world, one over the other."""

    def __init__(self, world: World) -> None:
        self.world, self.camera, scene = world, world.camera, world.scene
        self.places: Array = scene.samples
        self.shadows = Shadows(world) if scene.shadow_light is not None else None
        height, width = self.camera.height, self.camera.width
        part = (np.arange(height) / max(height - 1, 1))[:, None]
        background = np.repeat(scene.top + (scene.bottom - scene.top) * part, width, axis=0)[None, :, None]
        shape = (height * width, len(self.places))
        full = np.empty((1 + len(RULES), 3, *shape, 3))
        full[:] = background
        self.canvas = _Canvas(
            full,
            np.full((*shape, len(AROUND)), -np.inf),
            np.full(shape, -np.inf),
            np.full(shape, -np.inf),
            np.full(shape, -1),
        )
        #: of each layer, the only face that the samples of a pixel show, -1 for none, -2 where it is not sure
        self.only: list[Integers] = []
        self.shown: list[Integers] = []

    def picture(self) -> Picture:
        """Draw all."""
        objects = self.world.objects
        # a ground fades into what is before it in the scene
        solid: list[list[int]] = [[]]
        for i, each in enumerate(objects):
            if each.fade is not None:
                solid += [[i], []]
            elif each.is_opaque:
                solid[-1].append(i)
        glass = [[i] for i, s in enumerate(objects) if not s.is_opaque and s.fade is None and s.opacities.any()]
        for numbers in filter(None, solid + glass):
            self._draw(numbers)
        shape = (self.camera.height, self.camera.width)
        colors = self.canvas.colors.mean(axis=3).reshape(-1, 3, *shape, 3)
        if self.world.scene.invert:
            colors = 255 - colors[:, ::-1]
        low, exact, high = colors[0]
        only = np.stack([np.full(shape, -1).ravel(), *self.only]).reshape(-1, *shape)
        interior = (only >= 0).any(axis=0) & (only > -2).all(axis=0) & (high - low <= STEP).all(axis=2)
        padded = np.pad(only, [(0, 0), (1, 1), (1, 1)], mode="edge")
        for dy, dx in np.ndindex(3, 3):
            interior &= (padded[:, dy : dy + shape[0], dx : dx + shape[1]] == only).all(axis=0)
        return Picture(
            exact,
            low,
            high,
            dict(zip(RULES, colors[1:, ::2], strict=True)),
            self.canvas.triangle[:, 0].reshape(shape),
            (only != -1).any(axis=0),
            interior,
            np.concatenate([np.empty((0, 2), np.int64), *self.shown]),
            np.isneginf(self.canvas.floor).any(axis=(1, 2)).reshape(shape),
        )

    def _draw(self, numbers: list[int]) -> None:
        """Draw some surfaces at once."""
        canvas, world = self.canvas, self.world
        parts = [pieces_of(world, i) for i in numbers]
        pieces = joined([part[part.is_cut == cut] for part in parts for cut in (False, True)])
        reached, rows = self._visible(pieces)
        floor = reached.floor
        # what is there may hide them, and they what is there
        before = canvas.floor.min(axis=2)[rows.pixel, rows.sample]
        rows = rows.chosen(rows.most >= before)
        found = fragments(world, self.shadows, pieces, rows, reached, self.places)
        rows, found, floor = self._unhidden(pieces, rows, found, floor)
        samples = rows.pixel * len(self.places) + rows.sample
        self.shown.append(np.stack([rows.pixel, pieces.face[rows.piece]], axis=1))
        sure = np.asarray((floor > canvas.ceiling[..., None]).all(axis=2))
        likely = self._likely(pieces, rows, samples)
        for there, color in zip(canvas.colors, found.colors, strict=True):
            _blend(there, color, found.opacity, samples, sure, likely)
        if world.antialias and not world.exact:
            self._widen(pieces, rows, sure)
        flat = canvas.nearness.reshape(-1)
        flat[samples[likely]] = rows.nearness[likely]
        canvas.triangle.reshape(-1)[samples[likely]] = pieces.face[rows.piece[likely]]
        np.maximum.at(canvas.ceiling.reshape(-1), samples, rows.most)
        np.maximum(canvas.floor, floor, out=canvas.floor)
        self.only.append(self._only(pieces.face[rows.piece], rows, sure, found))

    def _unhidden(self, pieces: Pieces, rows: Seen, found: Fragments, floor: Array) -> tuple[Seen, Fragments, Array]:
        """Leave out what hidden texels show; and what may be hidden by one hides nothing for sure."""
        own = self._has_alpha(pieces.face[rows.piece])
        least, _, most = found.opacity[..., 0]
        if not own.any():
            return rows, found, floor
        maybe, kept = own & (least < HIDDEN), np.asarray(~own | (most > 0))
        floor = floor.copy()
        floor[rows.pixel[maybe], rows.sample[maybe]] = -np.inf
        colors, opacity = found.colors[:, :, kept], found.opacity[:, kept]
        return rows.chosen(kept), Fragments(colors, opacity, found.lit[kept], found.dark[kept]), floor

    def _has_alpha(self, face: Integers) -> Booleans:
        has_alpha = self.world.are(lambda s: s.texture is not None and s.texture.alpha is not None)
        return np.asarray(has_alpha[self.world.object_of(face)])

    def _widen(self, pieces: Pieces, rows: Seen, sure: Booleans) -> None:
        """Let pixels that show one smooth surface, and only that, have the colour of any sample there or in the pixels
        around that show it, too: where a surface is steep, a part of it that is hidden a little further may be seen.
        If they show another one, too, any of their samples may show either: depths are those of one triangle.
        """
        smooth = self.world.are(lambda s: s.shading > FLAT and s.is_opaque and not s.is_wire)
        surface = self.world.object_of(pieces.face[rows.piece])
        least, most = np.full(len(sure), len(smooth)), np.full(len(sure), -1)
        np.minimum.at(least, rows.pixel, np.where(smooth[surface], surface, -1))
        np.maximum.at(most, rows.pixel, surface)
        number = np.where((least == most) & sure.all(axis=1), most, -1)
        mixed = np.zeros(len(sure), bool)
        np.logical_or.at(mixed, rows.pixel, smooth[surface])
        mixed &= number < 0
        there, shape = self.canvas.colors[1 + WHOLES], (self.camera.height, self.camera.width)
        for bound, extreme in ((0, np.minimum), (2, np.maximum)):
            colors = getattr(there[bound], extreme.__name__[:3])(axis=1).reshape(*shape, 3)
            found = colors.copy()
            around = np.pad(colors, [(1, 1), (1, 1), (0, 0)], mode="edge")
            same = np.pad(number.reshape(shape), 1, constant_values=-2)
            for dy, dx in np.ndindex(3, 3):
                part = (slice(dy, dy + shape[0]), slice(dx, dx + shape[1]))
                found = np.where((same[part] == number.reshape(shape))[..., None], extreme(found, around[part]), found)
            there[bound, number >= 0] = found.reshape(-1, 1, 3)[number >= 0]
            there[bound, mixed] = colors.reshape(-1, 1, 3)[mixed]

    def _visible(self, pieces: Pieces) -> tuple[Seen, Seen]:
        """All that pieces reach, and of this what others of them do not hide."""
        if not self.world.antialias and pieces.is_wire.any():
            wire = np.flatnonzero(pieces.is_wire)
            fill = np.flatnonzero(~pieces.is_wire)
            first, second = seen(pieces[fill], self.camera, self.places), seen_wires(pieces[wire], self.camera)
            first, second = replace(first, piece=fill[first.piece]), replace(second, piece=wire[second.piece])
            both = (np.concatenate(each) for each in zip(first.rows, second.rows, strict=True))
            found = Seen(np.maximum(first.floor, second.floor), *both)
        else:
            found = seen(pieces, self.camera, self.places)
        nearest = found.floor.min(axis=2)[found.pixel, found.sample]
        # what hidden texels show hides nothing
        rows = found.chosen((found.most >= nearest) | self._has_alpha(pieces.face[found.piece]))
        # where a front and a back face are in the same place, the front face is seen
        front = np.full(found.floor.shape[:2], -np.inf)
        is_front = pieces.front[rows.piece] | pieces.is_wire[rows.piece]
        certain = rows.covers & is_front & ~pieces.doubtful[rows.piece]
        np.maximum.at(front, (rows.pixel[certain], rows.sample[certain]), rows.nearness[certain])
        nearest = front[rows.pixel, rows.sample]
        same = np.isfinite(nearest) & (np.abs(rows.nearness - nearest) <= SAME_DEPTH * np.abs(rows.nearness))
        return found, rows.chosen(is_front | ~same)

    def _likely(self, pieces: Pieces, rows: Seen, samples: Integers) -> Integers:
        """The rows that are most likely seen: the nearest of a sample, the first of those at equal depth."""
        visible = rows.covers & (rows.nearness > self.canvas.nearness[rows.pixel, rows.sample])
        order = np.flatnonzero(visible)
        order = order[np.lexsort((rows.piece[order], -rows.nearness[order], samples[order]))]
        return order[np.diff(samples[order], prepend=-1) > 0]

    def _only(self, face: Integers, rows: Seen, sure: Booleans, found: Fragments) -> Integers:
        """For each pixel, twice the number of the only face that its samples show, and 1 more if they are dark; -1 if
        they show none, -2 if they show several or may show others.
        """
        least, most = np.full(len(sure), np.iinfo(np.int64).max), np.full(len(sure), -1)
        np.minimum.at(least, rows.pixel, np.where(found.lit, 2 * face, 2 * face + 1))
        np.maximum.at(most, rows.pixel, np.where(found.dark, 2 * face + 1, 2 * face))
        return np.where(most < 0, -1, np.where((least == most) & sure.all(axis=1), most, -2))


def _blend(there: Array, color: Array, opacity: Array, samples: Integers, sure: Booleans, likely: Integers) -> None:
    """Lay the colours of rows, and their opacities, over those of samples that are there.

    sure: whether a sample shows any of the rows. likely: the rows that are seen most likely.
    """
    flat = there.reshape(3, -1, 3)
    order = np.argsort(samples, kind="stable")
    if not len(order):
        return
    where = samples[order]
    firsts = np.flatnonzero(np.diff(where, prepend=-1))
    where = where[firsts]
    under = flat[:, samples]
    # opacities and colours are independent of one another
    mixed = np.stack([share * color + (1 - share) * under for share in opacity])
    low = np.minimum.reduceat(mixed[:, 0].min(axis=0)[order], firsts)
    high = np.maximum.reduceat(mixed[:, 2].max(axis=0)[order], firsts)
    certain = sure.ravel()[where, None]
    flat[0, where] = np.where(certain, low, np.minimum(low, flat[0, where]))
    flat[2, where] = np.where(certain, high, np.maximum(high, flat[2, where]))
    flat[1, samples[likely]] = mixed[1, 1, likely]
