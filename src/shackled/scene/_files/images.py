"""The images that a file names: how many of their pixels are kept, and looked at."""

from __future__ import annotations

from collections.abc import Callable, Hashable

from PIL import Image

from ...errors import InputError

#: The pixels of the images that are kept open at a time, of which there is at least one.
_KEPT = 1 << 26
#: How many pixels may be opened for a file, each as often as it is opened, and compared with their neighbours.
_MOST_OPENED, _MOST_COMPARED = 1 << 30, 1 << 25


class Images:
    """The images of a file. Those that are used last are kept; others are opened again when they are needed."""

    def __init__(self) -> None:
        """Begin without any."""
        self._kept: dict[Hashable, Image.Image] = {}
        self._opened = self._compared = 0

    def open(self, key: Hashable, read: Callable[[], Image.Image]) -> Image.Image:
        """Return the image of a key, which `read` opens. InputError if all that were opened are too large together."""
        image = self._kept.pop(key, None)
        if image is None:
            if self._opened > _MOST_OPENED:
                raise InputError("its textures have too many pixels together; reduce them")
            image = read()
            self._opened += image.width * image.height
        self._kept[key] = image
        while len(self._kept) > 1 and sum(each.width * each.height for each in self._kept.values()) > _KEPT:
            del self._kept[next(iter(self._kept))]
        return image

    def compares(self, pixels: int) -> bool:
        """Return whether so many more pixels may be compared with their neighbours."""
        self._compared += pixels
        return self._compared <= _MOST_COMPARED
