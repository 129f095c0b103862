"""Files that another file names: where they are."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path, PurePosixPath
from typing import TypeVar
from urllib.parse import unquote

from PIL import Image

from ...errors import InputError, warn
from .._texture import as_rgb, open_image, with_alpha
from .images import FileImage, Images
from .model import FileWrap, Picture

T = TypeVar("T")
#: The place of an image, and the image.
Found = tuple[Path, FileImage]

#: What a message says of a name that leads elsewhere.
OUTSIDE = "is outside of the folder of the file that names it; only files in that folder are read"
#: An alpha is a mask if so many of its texels are nearly 0 or 255; of a mask, those below the second number are hidden.
_MASK, _HIDDEN = 0.95, 128


def picture_beside(
    path: Path,
    folders: Sequence[Path],
    name: str,
    images: Images,
    wrap: FileWrap = "repeat",
    alpha: str | None = None,
) -> Picture | None:
    """Return the picture that a mesh file names, "" for a white one; None, with an InputWarning, if it cannot be read.

    images: of the file. alpha: the name of the image of its alpha, which has an alpha itself, or is grey.
    """

    def found(name: str, convert: Callable[[Image.Image], Image.Image]) -> Found:
        def read(place: Path) -> Found:
            return place, images.image((place, convert), partial(open_image, place, str(place), convert))

        return read_beside(folders, name, read)

    shown = None
    try:
        shown = found(name, as_rgb) if name else None
    except InputError as error:
        warn(f"{path}: a texture is left out: {error}")
    try:
        if alpha:
            return _with_alpha(path, images, shown, found(alpha, _alpha_of), wrap)
    except InputError as error:
        warn(f"{path}: an alpha is left out: {error}")
    return shown and Picture(shown[1], f"{path}: {shown[0].name}", wraps=(wrap, wrap))


def _alpha_of(image: Image.Image) -> Image.Image:
    """Return the alpha of an image, or how bright it is if it has none."""
    image = with_alpha(image)
    return image.getchannel("A") if image.mode == "RGBA" else image.convert("L")


def _with_alpha(path: Path, images: Images, shown: Found | None, hidden: Found, wrap: FileWrap) -> Picture:
    def read() -> Image.Image:
        alpha = hidden[1].open()
        image = shown[1].open().copy() if shown else Image.new("RGB", alpha.size, "white")
        image.putalpha(alpha.resize(image.size))
        return image

    place = (shown or hidden)[0]
    image = images.image((place, hidden[0]), read)
    levels = image.open().getchannel("A").histogram()
    is_mask = sum(levels[:16] + levels[240:]) / sum(levels) >= _MASK
    return Picture(image, f"{path}: {place.name}", wraps=(wrap, wrap), cutoff=_HIDDEN if is_mask else 0)


def read_beside(folders: Sequence[Path], name: str, read: Callable[[Path], T]) -> T:
    """Read a file by the name that another file gives it, maybe an address or a path of the machine of the author.

    Then the file is in one of the folders, in any letter case. Nothing is read outside of the last folder. InputError
    of the first attempt if none of them succeeds.
    """
    first = None
    for place in dict.fromkeys(_places(folders, name)):
        try:  # not asked first whether it exists: what is told must not depend on files that may not be read
            return read(inside(folders[-1], place, name))
        except InputError as error:
            first = first or error
    raise first or InputError("it has no name")


def inside(folder: Path, place: Path, name: str) -> Path:
    """Return a place for which `is_inside`. Otherwise InputError with its name."""
    if not is_inside(folder, place):
        raise InputError(f"{name!r:.80} {OUTSIDE}")
    return place


def is_inside(folder: Path, place: Path) -> bool:
    """Return whether a place is in a folder, or in folders there, links resolved."""
    try:  # the first of these does not look at what may not be read
        return all(Path(each(place)).is_relative_to(each(folder)) for each in (os.path.abspath, os.path.realpath))
    except ValueError:  # a NUL
        return False


def _places(folders: Sequence[Path], name: str) -> Iterator[Path]:
    name = name.replace("\\", "/")
    for spelling in dict.fromkeys((name, unquote(name), unquote(re.sub(r"[?#].*", "", name)))):
        # a drive or a scheme begins a name of another machine
        parts = PurePosixPath(re.sub(r"^[A-Za-z][\w+.-]*:(?=/)", "", spelling))
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
