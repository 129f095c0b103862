"""Links of the Creator: a scene file in the fragment of the page's address, compressed."""

from __future__ import annotations

import base64
import binascii
import re
import zlib
from pathlib import Path

from attrs import frozen

from ...errors import InputError
from .._scene import Scene
from .content import parse
from .scene_file import SceneOfPiece, Sources, scene_of
from .table import about

#: Of the JSON in a link, in bytes. A link is untrusted, and could be a thousand times as large when it is inflated.
MAX_DOCUMENT = 1 << 22

_LINK = re.compile(r"(?:[a-z]+://[^\s#]*)?#1([\w-]*)", re.ASCII | re.IGNORECASE)


@frozen
class Link:
    """A link, as `#1...` or behind the address of a page. Messages call it "the link", since it can be long."""

    text: str
    #: As those of a path.
    stem = "scene"
    suffix = ""

    def __str__(self) -> str:
        return "the link"

    def scene(self, piece: SceneOfPiece) -> Scene:
        """Return its scene. piece: as in `read_scene`. InputError if the link is damaged, or needs a file."""
        document = parse(Path(str(self)), _inflated(self.text), ".json")
        with about(str(self)):
            return scene_of(document, Sources(piece))


def _inflated(link: str) -> str:
    match = _LINK.fullmatch(link)
    digits = match[1] if match else ""
    opener = zlib.decompressobj(-15)
    try:
        document = opener.decompress(base64.b64decode(digits + "=" * (-len(digits) % 4), b"-_"), MAX_DOCUMENT)
        if opener.unconsumed_tail:
            raise InputError(f"the link holds more than {MAX_DOCUMENT:,} bytes")
        if opener.eof and not opener.unused_data:
            return document.decode("utf-8")
    except (binascii.Error, zlib.error, UnicodeDecodeError):
        pass
    raise InputError("the link is damaged, or of an older version of the Creator; copy all of it")


def link_of(text: str) -> Link | None:
    """Return the link that a text is, if it is one."""
    return Link(text) if _LINK.fullmatch(text) else None
