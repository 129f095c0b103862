"""What files of a token need that a token does not have: files from outside, and what marketplaces leave out."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from html.parser import HTMLParser
from typing import Any
from xml.etree import ElementTree

from ..base.untrusted import plain, read_json
from ..errors import VerificationError
from ..tokens._metadata import read_data_uri

#: Addresses within the file itself, or of nothing that is loaded.
INSIDE = re.compile(r"#|data:|blob:|about:|javascript:|$", re.IGNORECASE)
#: Attributes that load what they name; on `LINKS` never, on `link` if `rel` is one of `LOADED`.
LOADING = {"src", "href", "poster", "background"}
LINKS = {"a", "area"}
LOADED = {"stylesheet", "preload", "modulepreload"}
#: Between the addresses of `srcset`.
DESCRIPTOR = re.compile(r"\s+(?:[\d.]+[wxh]\s*)?,?\s*|,\s+")
#: Comments, and addresses that are names.
CSS_UNLOADED = re.compile(r"/\*.*?(?:\*/|\Z)|@namespace[^;]{0,200};", re.DOTALL)
#: The beginnings of addresses suffice.
CSS_ADDRESS = re.compile(r"""(?:url\(\s{0,99}["']?|@import\s{0,99}["'])([^)"']{0,200})""", re.IGNORECASE)
STYLESHEET = re.compile(rb"<\?xml-stylesheet\b[^>]{0,200}?\bhref\s*=\s*[\"']([^\"']{0,200})")
#: Of all addresses in scripts, those that are loaded: others are names or notes.
SCRIPT_ADDRESS = re.compile(
    r"(?:\b(?:from|import)\s{0,99}|\b(?:import|fetch|importScripts|load|open|Worker|WebSocket|EventSource)\(\s{0,99}"
    r"(?:[\"'][A-Z]+[\"'],\s{0,99})?|\.(?:src|href)\s?=\s?)[\"'`]((?:(?:https?:|wss?:)?//|ipfs:)[^\"'`\s]{1,200})"
)
#: What throws an error in the sandbox in which marketplaces show pages, except where `try` handles it.
STORAGE = r"((?:local|session)Storage|indexedDB|document\.cookie)"
STORED = re.compile(
    rf"(?:[=(,.!&|?:;{{}}]\s{{0,9}}|^\s{{0,9}}){STORAGE}\b|\b{STORAGE}\s{{0,9}}(?:\?\.|[.\[=])", re.MULTILINE
)
SCRIPT_UNSTORED = re.compile(
    r"/\*.*?(?:\*/|\Z)|(?:^|\s)//[^\n]*|\btry\s{0,9}\{[^{}]*(?:\{[^{}]*\}[^{}]*)*\}", re.DOTALL | re.MULTILINE
)
#: A length of 0, with its unit.
ZERO = re.compile(r"\s*[-+]?(?:0+\.?0*|\.0+)(?:[a-z]{2,4}|%)?\s*", re.IGNORECASE)
MAP_ADDRESS = re.compile(r"https?://[^\"\s]{1,200}")
#: Elements of HTML in an SVG.
HTML_IN_SVG = ("foreignObject", "iframe", "embed", "object", "audio", "video", "canvas")
CHARSET = re.compile(rb"<meta[^>]+charset", re.IGNORECASE)
#: Bytes in which browsers look for the character encoding.
HEAD = 1024
#: Addresses that one line names, and their letters.
MOST_NAMED, MOST_LETTERS = 3, 60


@dataclass
class Element:
    """An element of SVG or HTML, without namespaces. text: inside it, of scripts and styles."""

    tag: str
    attributes: Mapping[str, str]
    text: str = ""


def svg_problems(root: ElementTree.Element, content: bytes, key: str) -> list[str]:
    """Return what an SVG needs that it does not have, each in one line. key: the field in which it is."""
    elements = _of_svg(root)
    sheets = [each.decode(errors="replace") for each in STYLESHEET.findall(content)]
    found = _outside([*sheets, *_addresses(elements)], key, "the SVG")
    sizes = {name: root.get(name, "") for name in ("width", "height")}
    sizes |= zip(
        ("viewBox width", "viewBox height"), re.split(r"[\s,]+", root.get("viewBox", "").strip())[2:], strict=False
    )
    if nothing := [name for name, size in sizes.items() if ZERO.fullmatch(size)]:
        found.append(f"{key} is an SVG of {nothing[0]} 0, which shows nothing")
    found += _stored(elements, key)
    if key == "animation_url":
        return found
    tags = {each.tag for each in elements}
    attributes = [each for element in elements for each in element.attributes.items()]
    if "script" in tags or any(k.startswith("on") or v.lstrip().startswith("javascript:") for k, v in attributes):
        found.append(f"{key} has a script, which pictures do not run: animate with SVG or CSS, or use animation_url")
    html = next((each for each in HTML_IN_SVG if each in tags), None)
    if html:
        found.append(f"{key} has <{html}>, which marketplaces remove: draw with elements of SVG, such as <text>")
    if key.startswith("image") and tags & {"image", "feImage"}:
        found.append(f"{key} is an SVG with a picture in it, which marketplaces do not show: return the picture itself")
    return found


def html_problems(content: bytes, key: str, media_type: str) -> list[str]:
    """Return what a page needs that it does not have, each in one line. media_type: with its parameters."""
    elements = _Page(content).elements
    found = [*_outside(_addresses(elements), key, "the page"), *_stored(elements, key)]
    is_declared = "charset=" in media_type.lower() or content.startswith((b"\xef\xbb\xbf", b"\xff\xfe", b"\xfe\xff"))
    if not (content.isascii() or is_declared or CHARSET.search(content[:HEAD])):
        found.append(f"{key} has letters beyond ASCII but no charset: begin its head with <meta charset='utf-8'>")
    return found


def gltf_problems(content: bytes, key: str) -> list[str]:
    """Return what a glTF or GLB loads from outside, in one line; nothing if it cannot be read."""
    text = content[20 : 20 + int.from_bytes(content[12:16], "little")] if content[:4] == b"glTF" else content
    try:
        document: Any = read_json(text.decode())
        parts = [*document.get("buffers", []), *document.get("images", [])]
        return _outside([str(each.get("uri", "")) for each in parts], key, "the model")
    except (ValueError, AttributeError, TypeError):
        return []


def _outside(addresses: Iterable[str], key: str, place: str) -> list[str]:
    """Return the line on what is loaded from outside; nothing if nothing is."""
    found = [each for each in dict.fromkeys(map(str.strip, addresses)) if not INSIDE.match(each)]
    more = f" and {len(found) - MOST_NAMED} more" if len(found) > MOST_NAMED else ""
    named = ", ".join(plain(each)[:MOST_LETTERS] for each in found[:MOST_NAMED])
    return [f"{key} loads {named}{more} from outside: put it into {place}"] if found else []


def _stored(elements: Iterable[Element], key: str) -> list[str]:
    """Return the line on what scripts keep in the browser; nothing if they keep nothing."""
    scripts = [each.text for each in elements if each.tag == "script"]
    named = [match for text in scripts for match in STORED.findall(SCRIPT_UNSTORED.sub(" ", text))]
    first = next(("".join(match) for match in named), None)
    why = "which throws an error in the sandbox of marketplaces: leave it out, or catch the error"
    return [f"{key} uses {first}, {why}"] if first else []


def _addresses(elements: Iterable[Element]) -> Iterator[str]:
    """Yield the addresses that elements load, and those that SVGs in their `data:` URIs load."""
    waiting = list(elements)
    for each in waiting:
        for address in _loaded_by(each):
            yield address
            waiting += _inside(address)


def _loaded_by(element: Element) -> Iterator[str]:
    tag, attributes = element.tag, element.attributes
    is_link = tag in LINKS or (tag == "link" and not LOADED.intersection(attributes.get("rel", "").lower().split()))
    for name, value in attributes.items():
        if name in LOADING or (name, tag) == ("data", "object"):
            yield from () if is_link else (value,)
        elif name in ("srcset", "imagesrcset"):
            yield from DESCRIPTOR.split(value.strip())
        else:
            yield from CSS_ADDRESS.findall(value)
    if tag == "style":
        yield from CSS_ADDRESS.findall(CSS_UNLOADED.sub(" ", element.text))
    elif tag == "script":
        is_map = attributes.get("type") == "importmap"
        yield from (MAP_ADDRESS if is_map else SCRIPT_ADDRESS).findall(element.text)


def _inside(uri: str) -> list[Element]:
    """Return the elements of an SVG in a `data:` URI; none if it is another address."""
    try:
        media_type, content = read_data_uri(uri.strip(), "it")
        return _of_svg(ElementTree.fromstring(content)) if media_type == "image/svg+xml" else []
    except (VerificationError, ElementTree.ParseError, ValueError):
        return []


def _of_svg(root: ElementTree.Element) -> list[Element]:
    return [
        Element(_local(each.tag), {_local(name): value for name, value in each.attrib.items()}, each.text or "")
        for each in root.iter()
    ]


def _local(name: str) -> str:
    return name.rpartition("}")[2]


class _Page(HTMLParser):
    """The elements of a page."""

    def __init__(self, content: bytes) -> None:
        super().__init__()
        self.elements: list[Element] = []
        self.feed(content.decode(errors="replace"))
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append(Element(tag, {name.rpartition(":")[2]: value or "" for name, value in attrs}))

    def handle_endtag(self, tag: str) -> None:
        # what follows is not inside
        self.elements.append(Element(f"/{tag}", {}))

    def handle_data(self, data: str) -> None:
        if self.elements:
            self.elements[-1].text += data
