"""A token without its files, for the page and for other programs."""

from __future__ import annotations

from typing import Any

from ._preview import Token


def summary(token: Token) -> dict[str, Any]:
    """Return number, gas, name, problems, and the media types of the files."""
    document = token.document
    return {
        "number": token.number,
        "gas": token.gas,
        "bytes": token.bytes,
        "name": document.name,
        "problems": token.problems,
        "image": document.image.media_type if document.image else None,
        "animation": document.animation.media_type if document.animation else None,
        "frames": max((file.frames for file in (document.image, document.animation) if file), default=0),
    }
