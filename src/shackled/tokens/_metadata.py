"""What a `tokenURI` says of a token: its name, its traits, its picture."""

from __future__ import annotations

import base64
import binascii
import io
import json
import re
from dataclasses import dataclass
from typing import Any
from urllib.parse import unquote_to_bytes

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from ..errors import VerificationError
from ..untrusted import plain, read_json

#: Marketplaces cut off, or do not show, what is longer.
MAX_LENGTH = 100_000
#: Pillow's name of each kind of picture that wallets show.
PICTURES = {"image/png": "PNG", "image/bmp": "BMP"}
#: The last chunk of every PNG.
PNG_END = bytes.fromhex("0000000049454e44ae426082")
#: Of a picture, in pixels.
MAX_SIDE = 2048

Trait = str | int | float | bool


@dataclass(frozen=True, eq=False)
class Metadata:
    """What a token says of itself.

    traits: by their names, in the order in which they are told. media_type: "image/png" or "image/bmp".
    picture: the bytes of the file in `image`; None where the token shows none.
    document: all of it, as the JSON has it. length: of the whole `tokenURI`, in bytes.
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
        """The picture, (H, W, 3), rows from the top. VerificationError if there is none, or it is not whole."""
        if self.picture is None or self.media_type is None:
            raise VerificationError(f"{self.name} shows no picture")
        return decode_picture(self.picture, self.media_type)

    @property
    def extension(self) -> str:
        """Of a file with the picture: ".png" or ".bmp"."""
        return f".{(self.media_type or 'image/png').partition('/')[2]}"


def read_token_uri(uri: str) -> Metadata:
    """Return the metadata of a token. VerificationError, one line, where marketplaces would not understand it."""
    document = _document(uri)
    name, description = _text(document, "name"), _text(document, "description")
    image, shown = _text(document, "image"), plain(name)[:60]
    media_type, picture = read_data_uri(image, f"the image of {shown}")
    if media_type not in PICTURES:
        raise VerificationError(f"the image of {shown} is of the type {media_type}, not one of {', '.join(PICTURES)}")
    metadata = Metadata(
        name=name,
        description=description,
        traits=_traits(document, shown),
        media_type=media_type,
        picture=picture,
        document=document,
        length=len(uri.encode()),
    )
    decode_picture(picture, media_type)
    return metadata


def read_data_uri(uri: str, what: str) -> tuple[str, bytes]:
    """Return the media type, without parameters, and the content of a `data:` URI. VerificationError if it is none."""
    match = re.match(r"data:([\w.+-]+/[\w.+-]+)((?:;[^;,]*)*),", uri, re.ASCII)
    if not match:
        raise VerificationError(f"{what} is not kept on the chain: it begins with {uri[:40]!r}, not with data:TYPE,")
    content = uri[match.end() :]
    if not match[2].endswith(";base64"):
        return match[1], unquote_to_bytes(content)
    try:
        return match[1], base64.b64decode(content, validate=True)
    except (binascii.Error, ValueError):
        raise VerificationError(f"{what} is said to be Base64, and is not") from None


def decode_picture(picture: bytes, media_type: str) -> NDArray[np.uint8]:
    """Return the pixels, (H, W, 3), of a PNG or a BMP. VerificationError if it is broken, not opaque, or too large."""
    whole = (
        picture.endswith(PNG_END) if media_type == "image/png" else picture[2:6] == len(picture).to_bytes(4, "little")
    )
    if not whole:
        raise VerificationError(f"the picture of the token is no whole {media_type}: its end is not where it should be")
    try:
        with PillowImage.open(io.BytesIO(picture), formats=[PICTURES[media_type]]) as opened:
            if max(opened.size) > MAX_SIDE:
                raise VerificationError(f"the picture of the token has {opened.size[0]} x {opened.size[1]} pixels")
            opened.load()
            if opened.has_transparency_data:
                raise VerificationError("the picture of the token has transparent pixels")
            return np.array(opened.convert("RGB"))
    except (OSError, ValueError, SyntaxError) as error:
        raise VerificationError(f"the picture of the token is no whole {media_type}: {error}") from None


def shrink(pixels: NDArray[np.uint8], width: int, height: int) -> NDArray[np.uint8] | None:
    """Return the picture of `width` x `height` pixels, each of which became a square; None if they did not."""
    factor = pixels.shape[1] // width
    if factor == 0 or pixels.shape[:2] != (height * factor, width * factor):
        return None
    small = pixels[::factor, ::factor]
    whole = small.repeat(factor, axis=0).repeat(factor, axis=1)
    return small if np.array_equal(whole, pixels) else None


def _document(uri: str) -> dict[str, Any]:
    length = len(uri.encode())
    if length > MAX_LENGTH:
        raise VerificationError(
            f"the tokenURI has {length:,} bytes; wallets and marketplaces show no more than {MAX_LENGTH:,}"
        )
    media_type, content = read_data_uri(uri, "the tokenURI")
    if media_type != "application/json":
        raise VerificationError(f"the tokenURI is of the type {media_type}, not application/json")
    try:
        document = read_json(content.decode(), object_pairs_hook=_once, parse_constant=_no_number)
        # half of a character, and numbers beyond all, are taken by this reader and by few others
        json.dumps(document, ensure_ascii=False, allow_nan=False).encode()
    except (UnicodeDecodeError, ValueError, RecursionError) as error:
        raise VerificationError(f"the tokenURI holds no JSON: {' '.join(str(error).split())[:100]}") from None
    if not isinstance(document, dict):
        raise VerificationError("the tokenURI holds JSON that is no object")
    return document


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    keys = [key for key, _ in pairs]
    if len(set(keys)) < len(keys):
        raise ValueError(f"{next(key for key in keys if keys.count(key) > 1)!r} stands there twice")
    return dict(pairs)


def _no_number(text: str) -> Any:
    raise ValueError(f"{text} is no number")


def _text(document: dict[str, Any], key: str) -> str:
    value = document.get(key)
    if not isinstance(value, str) or not value:
        raise VerificationError(f"the tokenURI has no {key}")
    return value


def _traits(document: dict[str, Any], name: str) -> dict[str, Trait]:
    """Return the marketplaces' list of {"trait_type": ..., "value": ...} as a mapping."""
    attributes = document.get("attributes", [])
    if not isinstance(attributes, list):
        raise VerificationError(f"the attributes of {name} are no list: marketplaces show none of them")
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
