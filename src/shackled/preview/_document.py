"""What a token returns, which is untrusted: its metadata and pictures, judged as marketplaces read them."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any
from xml.etree import ElementTree

import numpy as np
from PIL import Image as PillowImage
from PIL import UnidentifiedImageError

from ..base.untrusted import plain, read_json
from ..errors import VerificationError
from ..tokens._metadata import MAX_LENGTH, read_data_uri
from ._needs import gltf_problems, html_problems, svg_problems

#: Media types of pictures, and Pillow's names of them; SVG is read as XML.
PICTURES = {
    "image/png": "PNG",
    "image/apng": "PNG",
    "image/gif": "GIF",
    "image/bmp": "BMP",
    "image/jpeg": "JPEG",
    "image/webp": "WEBP",
}
SVG, GLB, GLTF, HTML = "image/svg+xml", "model/gltf-binary", "model/gltf+json", "text/html"
#: The largest side of a picture, and the most pixels of all its frames.
MAX_SIDE = 4096
MAX_PIXELS = 1 << 27
#: What `display_type` may be (OpenSea's metadata standards).
DISPLAY_TYPES = {"number", "boost_number", "boost_percentage", "date"}
#: Greater values of dates are milliseconds, or no dates.
LATEST = 10**11
#: A % that does not escape a byte.
STRAY = re.compile("%(?![0-9a-fA-F]{2})")
#: Keys whose values are text, and what they must match.
TEXTS = {
    "external_url": (r"(https?|web3|ipfs|ar|data):.+", "an address such as https://example.org/1"),
    "background_color": (r"[0-9a-fA-F]{6}", "six hexadecimal digits without #, such as ffcc00"),
}


@dataclass(frozen=True)
class File:
    """A file in a `data:` URI.

    frames: of a picture that moves, else 1. is_empty: whether it is a PNG or BMP, the formats of the renderer, in which
    each row has one colour, as the background has.
    """

    media_type: str
    content: bytes
    frames: int = 1
    is_empty: bool = False


@dataclass
class Document:
    """The metadata of a token. fields: the JSON object. problems: what is wrong, each in one line."""

    name: str = ""
    fields: dict[str, Any] = field(default_factory=dict)
    image: File | None = None
    animation: File | None = None
    problems: list[str] = field(default_factory=list)


def judge(uri: str) -> Document:
    """Read what `tokenURI` returned: all that is right of it, and all that is wrong."""
    found = Document()
    note = found.problems.append
    size = len(uri.encode())
    if size > MAX_LENGTH:
        note(f"the tokenURI has {size:,} bytes; marketplaces show no more than {MAX_LENGTH:,}")
    try:
        media_type, content = _read(uri, "the tokenURI", note)
        if media_type != "application/json":
            raise VerificationError(f"the tokenURI has the type {media_type}, not application/json")
        fields = read_json(content.decode())
        # lone surrogates and NaN, which other readers refuse
        json.dumps(fields, ensure_ascii=False, allow_nan=False).encode()
    except VerificationError as error:
        note(str(error))
        return found
    except UnicodeError as error:
        note(f"the tokenURI is not valid {unicode_fault(error)}")
        return found
    except (ValueError, RecursionError) as error:
        note(f"the tokenURI is not valid JSON: {' '.join(str(error).split())[:120]}")
        return found
    if not isinstance(fields, dict):
        note("the JSON of the tokenURI is not an object")
        return found
    found.fields = fields
    if not isinstance(fields.get("name"), str) or not fields["name"]:
        note("there is no name, which marketplaces show")
    if not isinstance(fields.get("description", ""), str):
        note(f"description must be text, not {plain(json.dumps(fields['description']))[:60]}")
    found.name = plain(fields["name"])[:100] if isinstance(fields.get("name"), str) else ""
    for key, (pattern, wanted) in TEXTS.items():
        value = fields.get(key, "")
        if not isinstance(value, str) or (value and not re.fullmatch(pattern, value, re.DOTALL)):
            note(f"{key} must be {wanted}, not {plain(json.dumps(value))[:60]}")
    found.problems += attribute_problems(fields.get("attributes", []))
    if "image" not in fields and "image_data" not in fields:
        note("there is no image")
    found.image = _file(fields["image"], "image", note) if "image" in fields else None
    if "image_data" in fields and found.image is None:
        found.image = _svg_or_file(fields["image_data"], "image_data", note)
    if "animation_url" in fields:
        found.animation = _file(fields["animation_url"], "animation_url", note)
    return found


def judge_picture(content: bytes | str) -> Document:
    """Read what a function such as `image` or `render` returned: a `data:` URI, an SVG, or the bytes of a picture."""
    found = Document()
    key, note = "the picture", found.problems.append
    if isinstance(content, str):
        found.image = _svg_or_file(content, key, note)
    else:
        found.image = _checked(File(_kind_of(content) or SVG, content), key, note)
    return found


#: What files begin with.
MARKS = {
    b"\x89PNG": "image/png",
    b"GIF8": "image/gif",
    b"BM": "image/bmp",
    b"\xff\xd8": "image/jpeg",
    b"glTF": GLB,
    b"<svg": SVG,
}


def _kind_of(content: bytes) -> str | None:
    """Return the media type of a file by its first bytes; None if they do not tell."""
    if content[:4] == b"RIFF" and content[8:12] == b"WEBP":
        return "image/webp"
    return next((kind for mark, kind in MARKS.items() if content.startswith(mark)), None)


def attribute_problems(attributes: Any) -> list[str]:
    """Return what is wrong with the attributes of a token."""
    if not isinstance(attributes, list):
        return ["attributes must be a list"]
    found = []
    for number, each in enumerate(attributes):
        if not isinstance(each, dict) or "value" not in each:
            found.append(f"attribute {number} has no value: {plain(json.dumps(each))[:60]}")
            continue
        kind, value = each.get("display_type"), each["value"]
        if not isinstance(value, str | int | float | bool):
            found.append(
                f"the value of attribute {number} must be text or a number, not {plain(json.dumps(value))[:60]}"
            )
        if kind is not None and (not isinstance(kind, str) or kind not in DISPLAY_TYPES):
            found.append(f"display_type {plain(json.dumps(kind))[:40]} is none of {', '.join(sorted(DISPLAY_TYPES))}")
        elif kind is not None and (isinstance(value, bool) or not isinstance(value, int | float)):
            found.append(f"attribute {number} has the display_type {kind}, so its value must be a number")
        elif kind == "date" and abs(value) >= LATEST:
            found.append(
                f"attribute {number} is a date after the year 5000: write seconds since 1970, not milliseconds"
            )
    return found


def _read(uri: str, key: str, note: Callable[[str], None]) -> tuple[str, bytes]:
    """Return the media type and the content of a `data:` URI, and note what browsers read in another way."""
    if not uri:
        raise VerificationError(f"{key} is empty")
    head, _, content = uri.partition(",")
    if not head.endswith(";base64"):
        if "#" in content:
            at = uri.index("#", len(head))
            note(f"{key} has a # at position {at}, where browsers end it: write %23, or use Base64")
        stray = STRAY.search(content)
        if stray:
            note(f"{key} has a % at position {len(head) + 1 + stray.start()} without two hexadecimal digits: write %25")
    return read_data_uri(uri, key)


def unicode_fault(error: UnicodeError) -> str:
    """Return what is wrong with text."""
    if isinstance(error, UnicodeDecodeError):
        return f"UTF-8: byte {error.start} is {error.object[error.start]:#04x}"
    return "JSON: it has half of a surrogate pair"


def _svg_or_file(text: Any, key: str, note: Callable[[str], None]) -> File | None:
    if isinstance(text, str) and text.lstrip().startswith("<"):
        return _checked(File(SVG, text.encode()), key, note)
    return _file(text, key, note)


def _file(uri: Any, key: str, note: Callable[[str], None]) -> File | None:
    if not isinstance(uri, str):
        note(f"{key} must be text, not {plain(json.dumps(uri))[:60]}")
        return None
    if key == "animation_url" and re.match(r"(https|ipfs|ar|web3):", uri):
        return None  # not on the chain, or by a gateway: allowed there
    try:
        media_type, content = _read(uri, key, note)
    except VerificationError as error:
        note(str(error))
        return None
    if media_type == HTML and key == "animation_url":
        for problem in html_problems(content, key, uri.partition(",")[0]):
            note(problem)
    return _checked(File(media_type, content), key, note)


def _checked(file: File, key: str, note: Callable[[str], None]) -> File | None:
    """Return the file if it can be decoded."""
    kind, content = file.media_type, file.content
    real = _kind_of(content)
    if real and kind in (*PICTURES, SVG) and PICTURES.get(real) != PICTURES.get(kind):
        note(f"{key} has the type {kind}, but is {real}: write data:{real}")
        return None
    if kind in PICTURES:
        return _picture(file, key, note)
    if kind == SVG:
        try:
            # entities that grow without bound are refused by the parser
            root = ElementTree.fromstring(content)
            if root.tag == "svg":
                raise ValueError("xmlns is missing: write <svg xmlns='http://www.w3.org/2000/svg'>")
            if root.tag != "{http://www.w3.org/2000/svg}svg":
                raise ValueError(f"its root is {plain(root.tag)[:40]}")
        except (ElementTree.ParseError, ValueError) as error:
            note(f"{key} is not a valid {_svg_fault(content, error)}")
            return None
        for problem in svg_problems(root, content, key):
            note(problem)
        return file
    if key != "animation_url":
        note(f"{key} has the type {kind}; marketplaces show {', '.join([*PICTURES, SVG])}")
        return None
    if kind == GLB and (content[:4] != b"glTF" or content[8:12] != len(content).to_bytes(4, "little")):
        note(f"{key} is not a complete GLB")
        return None
    if kind in (GLB, GLTF):
        for problem in gltf_problems(content, key):
            note(problem)
    return file


def _svg_fault(content: bytes, error: Exception) -> str:
    """Return what is wrong with an SVG, in plain words where the parser has none."""
    try:
        content.decode()
    except UnicodeDecodeError as fault:
        return unicode_fault(fault)
    return f"SVG: {error if content else 'it is empty'}"


def _picture(file: File, key: str, note: Callable[[str], None]) -> File | None:
    """Return a picture, all frames of which can be decoded."""
    try:
        with PillowImage.open(io.BytesIO(file.content), formats=[PICTURES[file.media_type]]) as opened:
            if max(opened.size) > MAX_SIDE:
                raise ValueError(
                    f"it has {opened.size[0]} x {opened.size[1]} pixels, more than {MAX_SIDE} along a side"
                )
            frames = int(getattr(opened, "n_frames", 1))
            if frames * opened.width * opened.height > MAX_PIXELS:
                raise ValueError(f"its {frames} frames have more than {MAX_PIXELS:,} pixels together")
            is_empty = PICTURES[file.media_type] in ("PNG", "BMP") and opened.width > 1
            for number in range(frames):
                opened.seek(number)
                opened.load()
                # whether each row has one colour, as the background has
                pixels = np.asarray(opened.convert("RGBA"))
                is_empty = is_empty and bool((pixels == pixels[:, :1]).all())
    except Exception as error:
        # decoders fail in many ways at damaged files, some without words
        said = " ".join(str(error).split())[:100] or type(error).__name__
        said = "it is damaged" if isinstance(error, UnidentifiedImageError) else said
        note(f"{key} is not a complete {file.media_type}: {said}")
        return None
    return File(file.media_type, file.content, frames, is_empty)
