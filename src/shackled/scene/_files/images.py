"""The images that a file names: how many of their pixels are kept, and looked at."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import cached_property
from typing import Any, cast
from weakref import WeakValueDictionary

from PIL import Image

from ...errors import InputError
from .._texture import reduced

#: The pixels of the images that are kept open at a time, of which there is at least one.
_KEPT = 1 << 26
#: How many pixels may be opened for a file, each as often as it is opened, and compared with each other.
_MOST_OPENED, _MOST_COMPARED = 5 << 27, 1 << 27


class Images:
    """The images of a file. Those that are used last are kept; others are opened again when they are needed."""

    def __init__(self) -> None:
        # weak, for each knows of these: a cycle would hold the pixels for longer than the file is read
        self._all = WeakValueDictionary[Hashable, FileImage]()
        self._kept: dict[Hashable, Image.Image] = {}
        self._opened = self._compared = 0

    def image(self, key: Hashable, read: Callable[[], Image.Image]) -> FileImage:
        """Return the image of a key, RGB or RGBA, which `read` opens: now, and whenever it is needed again."""
        image = self._all.get(key) or FileImage(self, key, read)
        self._all[key] = image
        return image

    def open(self, key: Hashable, read: Callable[[], Image.Image]) -> Image.Image:
        """Return the pixels of an image. InputError if all that were opened are too large together."""
        opened = self._kept.pop(key, None)
        if opened is None:
            if self._opened > _MOST_OPENED:
                raise InputError("its textures have too many pixels together; reduce them")
            opened = read()
            self._opened += opened.width * opened.height
        self._kept[key] = opened
        while len(self._kept) > 1 and sum(each.width * each.height for each in self._kept.values()) > _KEPT:
            del self._kept[next(iter(self._kept))]
        return opened

    def compares(self, pixels: int) -> bool:
        """Return whether so many more pixels may be compared with each other."""
        self._compared += pixels
        return self._compared <= _MOST_COMPARED


class FileImage:
    """An image of a file, and what stays known of it while it is not open. has_alpha: whether it is RGBA, not RGB."""

    def __init__(self, images: Images, key: Hashable, read: Callable[[], Image.Image]) -> None:
        self.images, self._key, self._read = images, key, read
        self._texel: Image.Image | None = None  # all of it, if it has one colour
        self._reduced: dict[int, Image.Image] = {}
        opened = self.open()
        self.size, self.has_alpha = opened.size, opened.mode == "RGBA"

    def open(self) -> Image.Image:
        """Return its pixels, or one of them if it has one colour."""
        return self._texel or self.images.open(self._key, self._read)

    @cached_property
    def is_varied(self) -> bool:
        """Whether it has more than one colour, or an alpha."""
        if self.has_alpha or not is_plain(opened := self.open()):
            return True
        self._texel = opened.crop((0, 0, 1, 1))
        return False

    def reduced(self, side: int) -> Image.Image:
        """Return it with at most `side` pixels along each side."""
        if side not in self._reduced:
            self._reduced[side] = reduced(self.open(), side)
        return self._reduced[side]


def is_plain(image: Image.Image) -> bool:
    """Return whether an image, RGB, has one colour."""
    return all(low == high for low, high in cast(Any, image.getextrema()))
