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

from ..errors import VerificationError
from ..image import Image
from ..untrusted import plain, read_json
from ..whole_file import write_output

#: Maximum size of a `tokenURI` in bytes; marketplaces do not show longer ones.
MAX_LENGTH = 100_000
#: Media types that wallets show, and Pillow's names of them.
PICTURES = {"image/png": "PNG", "image/bmp": "BMP"}
#: The last chunk of every PNG.
PNG_END = bytes.fromhex("0000000049454e44ae426082")
#: Maximum side of a picture, in pixels.
MAX_SIDE = 4096

Trait = str | int | float | bool


@dataclass(frozen=True, eq=False)
class Metadata:
    """The metadata of a token.

    traits: values by name, in their order. media_type: "image/png" or "image/bmp". picture: file in `image`; None if
    there is none. document: the whole JSON. length: size of the `tokenURI`, in bytes.
    """

    name: str
    description: str
    traits: dict[str, Trait]
    media_type: str | None
    picture: bytes | None
    document: dict[str, Any]
    length: int

    @property
    def pixels(self) -> NDArray[np.uint8]:
        """The picture, (H, W, 3) uint8, rows from the top. Raises VerificationError if it is missing or damaged."""
        if self.picture is None or self.media_type is None:
            raise VerificationError(f"{self.name} has no picture")
        return decode_picture(self.picture, self.media_type)

    @property
    def extension(self) -> str:
        """Extension of the picture's format: ".png" or ".bmp"."""
        return f".{(self.media_type or 'image/png').partition('/')[2]}"

    def save(self, path: Path) -> None:
        """Write the picture: the bytes of the token if the extension is that of its format, else the same pixels."""
        content = self.picture
        if content is None or path.suffix.lower() != self.extension:
            content = Image(self.pixels).encode(path.suffix)
        write_output(path, content)


def read_token_uri(uri: str, max_length: int = MAX_LENGTH) -> Metadata:
    """Parse a `tokenURI`. Raises VerificationError if it is invalid, or longer than `max_length` bytes."""
    document = _document(uri, max_length)
    name, description = _text(document, "name"), _text(document, "description")
    image, label = _text(document, "image"), plain(name)[:60]
    media_type, picture = read_data_uri(image, f"the image of {label}")
    if media_type not in PICTURES:
        raise VerificationError(f"the image of {label} has the type {media_type}, not one of {', '.join(PICTURES)}")
    metadata = Metadata(
        name=name,
        description=description,
        traits=_traits(document, label),
        media_type=media_type,
        picture=picture,
        document=document,
        length=len(uri.encode()),
    )
    decode_picture(picture, media_type)
    return metadata


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


def decode_picture(picture: bytes, media_type: str) -> NDArray[np.uint8]:
    """Decode a PNG or BMP to (H, W, 3) uint8. Raises VerificationError if it is damaged, transparent, or too large."""
    whole = (
        picture.endswith(PNG_END) if media_type == "image/png" else picture[2:6] == len(picture).to_bytes(4, "little")
    )
    if not whole:
        raise VerificationError(
            f"the picture of the token is not a complete {media_type}: it does not end where it should"
        )
    try:
        with PillowImage.open(io.BytesIO(picture), formats=[PICTURES[media_type]]) as opened:
            if max(opened.size) > MAX_SIDE:
                raise VerificationError(f"the picture of the token has {opened.size[0]} x {opened.size[1]} pixels")
            opened.load()
            if opened.has_transparency_data:
                raise VerificationError("the picture of the token has transparent pixels")
            return np.array(opened.convert("RGB"))
    except (OSError, ValueError, SyntaxError) as error:
        raise VerificationError(f"the picture of the token is not a complete {media_type}: {error}") from None


def shrink(pixels: NDArray[np.uint8], width: int, height: int) -> NDArray[np.uint8] | None:
    """Undo the enlargement of a picture of `width` x `height` pixels to squares; None if it is not one."""
    factor = pixels.shape[1] // width
    if factor == 0 or pixels.shape[:2] != (height * factor, width * factor):
        return None
    small = pixels[::factor, ::factor]
    whole = small.repeat(factor, axis=0).repeat(factor, axis=1)
    return small if np.array_equal(whole, pixels) else None


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
        document = read_json(content.decode(), object_pairs_hook=_once, parse_constant=_no_number)
        # this reader accepts lone surrogates and huge numbers, which most others do not
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


def _no_number(text: str) -> Any:
    raise ValueError(f"{text} is not a number")


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
        kind, value = (
            (attribute.get("trait_type"), attribute.get("value")) if isinstance(attribute, dict) else (None, None)
        )
        if not isinstance(kind, str) or not isinstance(value, str | int | float | bool):
            raise VerificationError(f"an attribute of {name} has no trait_type and value: {plain(str(attribute))[:80]}")
        if kind in traits:
            raise VerificationError(f"{name} has the attribute {plain(kind)[:60]} twice")
        traits[kind] = value
    return traits
