"""Files that another file names: where they are."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path, PurePosixPath
from typing import TypeVar

from ...errors import InputError, warn
from .._texture import open_image
from .model import FileWrap, Picture

T = TypeVar("T")


def picture_beside(path: Path, folders: Sequence[Path], name: str, wrap: FileWrap = "repeat") -> Picture | None:
    """Return the picture that a mesh file names, as `read_beside`; None, with an InputWarning, if it cannot be read."""
    try:
        place, image = read_beside(folders, name, lambda each: (each, open_image(each, str(each))))
    except InputError as error:
        warn(f"{path}: a texture is left out: {error}")
        return None
    return Picture(image, f"{path}: {place.name}", wraps=(wrap, wrap))


def read_beside(folders: Sequence[Path], name: str, read: Callable[[Path], T]) -> T:
    """Read a file by the name that another file in the first of the folders gives it.

    It may be that of the machine of the author: then the file is in one of the folders, in any letter case. InputError
    of the first attempt if none of them succeeds.
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
