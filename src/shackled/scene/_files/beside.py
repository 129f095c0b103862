"""Files that another file names: where they are."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path, PurePosixPath
from typing import TypeVar

import numpy as np
from PIL import Image

from ...errors import InputError, warn
from .._texture import as_rgba, open_image
from .model import FileWrap, Picture

T = TypeVar("T")
Found = tuple[Path, Image.Image]


#: An alpha is a mask if so many of its texels are nearly 0 or 255; of a mask, those below the second number are hidden.
_MASK, _HIDDEN = 0.95, 128


def picture_beside(
    path: Path, folders: Sequence[Path], name: str, wrap: FileWrap = "repeat", alpha: str | None = None
) -> Picture | None:
    """Return the picture that a mesh file names, "" for a white one; None, with an InputWarning, if it cannot be read.

    alpha: the name of the image of its alpha, which has an alpha itself, or is grey.
    """

    def found(name: str, convert: Callable[[Image.Image], Image.Image] | None = None) -> Found:
        return read_beside(folders, name, lambda each: (each, open_image(each, str(each), convert)))

    shown = None
    try:
        shown = found(name) if name else None
    except InputError as error:
        warn(f"{path}: a texture is left out: {error}")
    try:
        if alpha:
            return _with_alpha(path, shown, found(alpha, as_rgba), wrap)
    except InputError as error:
        warn(f"{path}: an alpha is left out: {error}")
    return shown and Picture(shown[1], f"{path}: {shown[0].name}", wraps=(wrap, wrap))


def _with_alpha(path: Path, shown: Found | None, hidden: Found, wrap: FileWrap) -> Picture:
    place, image = shown or (hidden[0], Image.new("RGB", hidden[1].size, "white"))
    own = hidden[1].getchannel("A")
    alpha = (own if own.getextrema() != (255, 255) else hidden[1].convert("L")).resize(image.size)
    image = image.copy()
    image.putalpha(alpha)
    levels = np.asarray(alpha)
    is_mask = ((levels < 16) | (levels > 239)).mean() >= _MASK
    return Picture(image, f"{path}: {place.name}", wraps=(wrap, wrap), cutoff=_HIDDEN if is_mask else 0)


def read_beside(folders: Sequence[Path], name: str, read: Callable[[Path], T]) -> T:
    """Read a file by the name that another file gives it, maybe of the machine of the author: then the file is in one
    of the folders, in any letter case. InputError of the first attempt if none of them succeeds.
    """
    first = None
    for place in dict.fromkeys(_places(folders, name)):
        try:  # not asked first whether it exists: what is told must not depend on files that may not be read
            return read(place)
        except InputError as error:
            first = first or error
    raise first or InputError("it has no name")


def _places(folders: Sequence[Path], name: str) -> Iterator[Path]:
    parts = PurePosixPath(name.replace("\\", "/"))
    for folder in folders:
        yield folder / parts
    for folder in folders:
        if not parts.is_absolute() and ".." not in parts.parts:
            yield from _in_any_case(folder, parts.parts)
        yield folder / parts.name
        yield from _in_any_case(folder, parts.parts[-1:])


def _in_any_case(folder: Path, parts: Sequence[str]) -> Iterator[Path]:
    if not parts:
        yield folder
        return
    try:
        names = sorted(os.listdir(folder))
    except (OSError, ValueError):
        return
    for each in names:
        if each.casefold() == parts[0].casefold():
            yield from _in_any_case(folder / each, parts[1:])
