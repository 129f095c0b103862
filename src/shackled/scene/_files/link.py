"""Links of the Creator: a scene file in the fragment of the page's address, compressed."""

from __future__ import annotations

import base64
import binascii
import re
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from attrs import frozen

from ...errors import InputError
from .._scene import Scene
from .content import parse
from .scene_file import scene_of
from .table import about

#: Of the JSON in a link, in bytes. A link is untrusted, and could be a thousand times as large when it is inflated.
MAX_DOCUMENT = 1 << 22

_LINK = re.compile(r"(?:[a-z]+://[^\s#]*)?#1([\w-]*)", re.ASCII | re.IGNORECASE)
_DAMAGED = "the link is damaged, or of an older version of the Creator; copy all of it"


@frozen
class Link:
    """A link, as `#1...` or behind the address of a page. Messages call it "the link", since it can be long."""

    text: str
    #: As those of a path.
    stem = "scene"
    suffix = ""

    def __str__(self) -> str:
        """Return what it is called."""
        return "the link"

    def scene(self) -> Scene:
        """Return its scene. InputError if the link is damaged, or needs a file that was opened on the page."""
        document = parse(Path(str(self)), self._json(), ".json")
        with about(str(self)):
            _check_files(document)
            return scene_of(document, None)

    def _json(self) -> str:
        match = _LINK.fullmatch(self.text)
        digits = match[1] if match else ""
        try:
            packed = base64.b64decode(digits + "=" * (-len(digits) % 4), b"-_", validate=True)
            opener = zlib.decompressobj(-15)
            document = opener.decompress(packed, MAX_DOCUMENT)
            if opener.unconsumed_tail:
                raise InputError(f"the link holds more than {MAX_DOCUMENT:,} bytes")
            if not opener.eof or opener.unused_data:
                raise InputError(_DAMAGED)
            return document.decode("utf-8")
        except (binascii.Error, zlib.error, UnicodeDecodeError):
            raise InputError(_DAMAGED) from None


def link_of(text: str) -> Link | None:
    """Return the link that a text is, if it is one."""
    return Link(text) if _LINK.fullmatch(text) else None


def _check_files(document: Mapping[str, Any]) -> None:
    """Refuse a link with the meshes of files that only the page has opened."""
    objects, page = document.get("objects"), document.get("creator")
    names = page.get("objects") if isinstance(page, Mapping) else None
    for number, each in enumerate(objects if isinstance(objects, list) else []):
        mesh = each.get("mesh") if isinstance(each, Mapping) else None
        if not isinstance(mesh, Mapping) or "file" not in mesh:
            continue
        own = names[number] if isinstance(names, list) and number < len(names) else None
        name = own.get("name") if isinstance(own, Mapping) else None
        raise InputError(
            f"objects[{number}] needs the file {name or mesh['file']!s:.60} that was opened on the page, where a "
            "scene file with it can be saved"
        )
