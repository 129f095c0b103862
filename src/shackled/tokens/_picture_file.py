"""A token's picture as a file."""

from __future__ import annotations

from pathlib import Path

from ..errors import InputError
from ..image import FORMATS, Image
from ..whole_file import write_output
from ._metadata import Metadata


def check_picture_file(path: Path) -> None:
    """InputError if a picture cannot be kept there."""
    if path.suffix.lower() not in FORMATS:
        raise InputError(f"the picture {path} must end in one of {' '.join(FORMATS)}")
    if path.is_dir():
        raise InputError(f"{path} is a folder, not the file of a picture")
    if not path.parent.is_dir():
        raise InputError(f"the folder {path.parent} of the picture {path.name} does not exist")


def save_picture(metadata: Metadata, path: Path) -> None:
    """Writes the picture: the very bytes of the token where the format is that of the token, else the same pixels."""
    content = metadata.picture
    if content is None or path.suffix.lower() != metadata.extension:
        content = Image(metadata.pixels).encode(path.suffix)
    write_picture(path, content)


def write_picture(path: Path, content: bytes) -> None:
    """Writes the bytes of a picture. InputError or OutputError if they cannot be written."""
    write_output(path, content)
