"""Metadata of a token from its `tokenURI`, which is untrusted: name, traits, picture."""

from __future__ import annotations

import base64
import binascii
import io
import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote_to_bytes

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from ..base.untrusted import plain, read_json
from ..base.whole_file import write_output
from ..errors import VerificationError
from ..image import Image

#: Maximum size of a `tokenURI` in bytes; marketplaces do not show longer ones.
MAX_LENGTH = 100_000
#: The last chunk of every PNG.
PNG_END = bytes.fromhex("0000000049454e44ae426082")
#: Maximum side of a picture, in pixels.
MAX_SIDE = 4096

Trait = str | int | float | bool


@dataclass(frozen=True, eq=False)
class Metadata:
    """The metadata of a token.

    traits: values by name, in their order. picture: the PNG file in `image`. document: the whole JSON. uri: `tokenURI`.
    """

    name: str
    description: str
    traits: dict[str, Trait]
    picture: bytes
    document: dict[str, Any]
    uri: str

    @property
    def length(self) -> int:
        """Size of the `tokenURI`, in bytes."""
        return len(self.uri.encode())

    @property
    def pixels(self) -> NDArray[np.uint8]:
        """The picture, (H, W, 3) uint8, rows from the top."""
        return decode_picture(self.picture)

    def save(self, path: Path) -> None:
        """Write the picture: the bytes of the token if the extension is .png, else the same pixels."""
        is_png = path.suffix.lower() == ".png"
        write_output(path, self.picture if is_png else Image(self.pixels).encode(path.suffix))


def read_token_uri(uri: str, max_length: int = MAX_LENGTH) -> Metadata:
    """Parse a `tokenURI`. Raises VerificationError if it is invalid, or longer than `max_length` bytes."""
    document = _document(uri, max_length)
    name, description, image = (_text(document, key) for key in ("name", "description", "image"))
    label = plain(name)[:60]
    media_type, picture = read_data_uri(image, f"the image of {label}")
    if media_type != "image/png":
        raise VerificationError(f"the image of {label} has the type {media_type}, not image/png")
    decode_picture(picture)
    return Metadata(name, description, _traits(document, label), picture, document, uri)


def read_data_uri(uri: str, what: str) -> tuple[str, bytes]:
    """Return the media type and the content of a `data:` URI. Raises VerificationError if it is invalid."""
    match = re.match(r"data:([\w.+-]+/[\w.+-]+)((?:;[^;,]*)*),", uri, re.ASCII)
    if not match:
        raise VerificationError(f"{what} is not on the chain: it begins with {uri[:40]!r}, not with data:TYPE,")
    content = uri[match.end() :]
    if not match[2].endswith(";base64"):
        return match[1], unquote_to_bytes(content)
    try:
        return match[1], base64.b64decode(content, validate=True)
    except (binascii.Error, ValueError):
        raise VerificationError(f"{what} is not valid Base64") from None


def decode_picture(picture: bytes) -> NDArray[np.uint8]:
    """Decode a PNG file to (H, W, 3) uint8. Raises VerificationError if it is damaged, transparent, or too large."""
    if not picture.endswith(PNG_END):
        raise VerificationError("the picture of the token is not a complete PNG file: it does not end where it should")
    try:
        with PillowImage.open(io.BytesIO(picture), formats=["PNG"]) as opened:
            if max(opened.size) > MAX_SIDE:
                raise VerificationError(f"the picture of the token has {opened.size[0]} x {opened.size[1]} pixels")
            opened.load()
            if opened.has_transparency_data:
                raise VerificationError("the picture of the token has transparent pixels")
            return np.array(opened.convert("RGB"))
    except (OSError, ValueError, SyntaxError) as error:
        raise VerificationError(f"the picture of the token is not a complete PNG file: {error}") from None


def _document(uri: str, max_length: int) -> dict[str, Any]:
    length = len(uri.encode())
    if length > max_length:
        raise VerificationError(
            f"the tokenURI has {length:,} bytes; wallets and marketplaces show no more than {max_length:,}"
        )
    media_type, content = read_data_uri(uri, "the tokenURI")
    if media_type != "application/json":
        raise VerificationError(f"the tokenURI has the type {media_type}, not application/json")
    try:
        document = read_json(content.decode(), object_pairs_hook=_once)
        # this reader accepts lone surrogates, NaN and huge numbers, which most others do not
        json.dumps(document, ensure_ascii=False, allow_nan=False).encode()
    except (UnicodeDecodeError, ValueError, RecursionError) as error:
        raise VerificationError(f"the tokenURI is not valid JSON: {' '.join(str(error).split())[:100]}") from None
    if not isinstance(document, dict):
        raise VerificationError("the JSON of the tokenURI is not an object")
    return document


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    keys = [key for key, _ in pairs]
    if len(set(keys)) < len(keys):
        raise ValueError(f"{next(key for key in keys if keys.count(key) > 1)!r} occurs twice")
    return dict(pairs)


def _text(document: dict[str, Any], key: str) -> str:
    value = document.get(key)
    if not isinstance(value, str) or not value:
        raise VerificationError(f"the tokenURI has no {key}")
    return value


def _traits(document: dict[str, Any], name: str) -> dict[str, Trait]:
    """Return the list of {"trait_type": ..., "value": ...} as a mapping."""
    attributes = document.get("attributes", [])
    if not isinstance(attributes, list):
        raise VerificationError(f"the attributes of {name} are not a list")
    traits: dict[str, Trait] = {}
    for attribute in attributes:
        given = attribute if isinstance(attribute, dict) else {}
        kind, value = given.get("trait_type"), given.get("value")
        if not isinstance(kind, str) or not isinstance(value, str | int | float | bool):
            raise VerificationError(f"an attribute of {name} has no trait_type and value: {plain(str(attribute))[:80]}")
        if kind in traits:
            raise VerificationError(f"{name} has the attribute {plain(kind)[:60]} twice")
        traits[kind] = value
    return traits
