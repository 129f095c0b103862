"""Files to download: the picture in several formats, and programs that render it without the Creator."""

from __future__ import annotations

from dataclasses import dataclass

from .._render import render
from ..chain import EmbeddedChain
from ..errors import InputError
from ..gas import render_call
from ..image import Image, png_options
from ..scene import encode_scene_file
from ..web import make_page
from ._picture import File, enlarged, png
from ._programs import Subject, cast_command, python_program
from ._solidity import solidity_contract
from ._store import Stored

#: Factors by which a PNG can be enlarged.
SCALES = tuple(range(1, 9))
#: Largest number of pixels a side of a PNG.
MAX_PNG = 4096


@dataclass(frozen=True)
class FileKind:
    """A kind of file. extension: appended to the name of the picture. is_text: whether it can be shown and copied."""

    name: str
    title: str
    extension: str
    media_type: str
    is_text: bool
    help: str


KINDS: tuple[FileKind, ...] = (
    FileKind(
        "png",
        "PNG",
        ".png",
        "image/png",
        False,
        "The picture, each pixel enlarged to a square of 1 to 8 pixels; with the scene, if it takes at most 64 KB.",
    ),
    FileKind("bmp", "BMP", ".bmp", "image/bmp", False, "The bytes as returned by the contract."),
    FileKind(
        "svg", "SVG", ".svg", "image/svg+xml", False, "Sharp at any size; as returned by the contract's renderSVG."
    ),
    FileKind(
        "scene", "Scene file", ".json", "application/json", False, "The scene with its meshes, for shackled render."
    ),
    FileKind("page", "Page", ".html", "text/html", False, "A page of one file that shows the scene in any browser."),
    FileKind("file", "The uploaded file", "", "application/octet-stream", False, "The file as you uploaded it."),
    FileKind("calldata", "Calldata", ".hex", "text/plain", True, "The data of the call render(Scene), in hexadecimal."),
    FileKind(
        "cast", "cast call", ".sh", "text/x-shellscript", True, "For a chain on which the contracts are deployed."
    ),
    FileKind(
        "cast-anywhere",
        "cast call, nothing deployed",
        "-anywhere.sh",
        "text/x-shellscript",
        True,
        "Sends the code of the contracts, as a state override.",
    ),
    FileKind("python", "Python", ".py", "text/x-python", True, "Renders the same picture, and checks the result."),
    FileKind("solidity", "Solidity", ".sol", "text/plain", True, "A contract that contains the scene and renders it."),
)


def kind_of(name: str) -> FileKind:
    """Return the kind of that name. InputError if there is none."""
    for kind in KINDS:
        if kind.name == name:
            return kind
    raise InputError(f"there is no download of the kind {name!r:.40}; there are {', '.join(k.name for k in KINDS)}")


def make_file(name: str, subject: Subject, chain: EmbeddedChain, scale: int = 1) -> File:
    """Make a file. name: of its kind. scale: of a PNG. InputError if the kind or scale is not possible."""
    kind = kind_of(name)
    if name == "file":
        return uploaded(subject.stored)
    return File(subject.stem + kind.extension, kind.media_type, _content(kind, subject, chain, scale))


def uploaded(stored: Stored | None) -> File:
    """Return the uploaded file. InputError if there is none."""
    if stored is None:
        raise InputError("the picture is not of an uploaded file")
    return File(stored.name, kind_of("file").media_type, stored.data)


def _content(kind: FileKind, subject: Subject, chain: EmbeddedChain, scale: int) -> bytes:
    name, scene = kind.name, subject.scene
    if name == "scene":
        return encode_scene_file(scene)
    if name == "calldata":
        return f"0x{render_call(scene).hex()}\n".encode()
    if name in ("cast", "cast-anywhere"):
        return cast_command(subject, chain, everything=name == "cast-anywhere").encode()
    image = render(scene, on=chain)
    if name == "png":
        return _png(image, scale)
    if name == "page":
        return make_page(image, subject.facts.title, subject.facts.notice)
    if name == "python":
        return python_program(subject, image).encode()
    if name == "solidity":
        return solidity_contract(subject, image).encode()
    return image.encode(kind.extension)


def _png(image: Image, scale: int) -> bytes:
    if scale not in SCALES:
        raise InputError(f"the scale of a PNG must be from {SCALES[0]} to {SCALES[-1]}, not {scale!r:.20}")
    if max(image.width, image.height) * scale > MAX_PNG:
        raise InputError(f"a PNG can have up to {MAX_PNG:,} pixels a side: choose a scale below {scale}")
    return png(enlarged(image.pixels, scale), 6, **png_options(image))
