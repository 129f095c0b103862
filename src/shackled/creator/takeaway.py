"""What a visitor takes home: the picture in several formats, and ways to make it again without the Creator."""

from __future__ import annotations

from dataclasses import dataclass

from .._render import render
from ..chain import EmbeddedChain
from ..errors import InputError
from ..gas import render_call
from ..image import Image
from ..scene import encode_scene_file
from .cast_command import cast_command
from .film import enlarged, png
from .picture import File
from .python_program import python_program
from .solidity_contract import solidity_contract
from .store import Stored
from .subject import Subject

#: How many times as large a PNG may be.
SCALES = tuple(range(1, 9))
#: Pixels a side, at most.
MAX_PNG = 4096


@dataclass(frozen=True)
class Kind:
    """Something to take home. name: as `Pool.take` knows it. is_text: whether it can be shown and copied.

    extension: what follows the name of the picture in that of the file.
    """

    name: str
    title: str
    extension: str
    media_type: str
    is_text: bool
    help: str


KINDS: tuple[Kind, ...] = (
    Kind("png", "PNG", ".png", "image/png", False, "The picture, each pixel as a square of 1 to 8 pixels."),
    Kind("bmp", "BMP", ".bmp", "image/bmp", False, "The bytes as the contract returned them."),
    Kind("svg", "SVG", ".svg", "image/svg+xml", False, "Sharp at any size; what the contract's renderSVG returns."),
    Kind("scene", "Scene file", ".json", "application/json", False, "All of it, meshes too, for shackled render."),
    Kind("file", "The uploaded file", "", "application/octet-stream", False, "As it was handed in."),
    Kind("calldata", "Calldata", ".hex", "text/plain", True, "The data of the call render(Scene), in hexadecimal."),
    Kind("cast", "cast call", ".sh", "text/x-shellscript", True, "Where the contracts are deployed."),
    Kind(
        "cast-anywhere",
        "cast call, nothing deployed",
        "-anywhere.sh",
        "text/x-shellscript",
        True,
        "The code of the contracts comes along, as a state override.",
    ),
    Kind("python", "Python", ".py", "text/x-python", True, "Makes the same picture, and checks that it does."),
    Kind("solidity", "Solidity", ".sol", "text/plain", True, "A contract that holds the scene and draws it."),
)


def kind_of(name: str) -> Kind:
    """The kind of that name; InputError if there is none."""
    for kind in KINDS:
        if kind.name == name:
            return kind
    raise InputError(f"there is nothing of the kind {name!r:.40} to take; there are {', '.join(k.name for k in KINDS)}")


def make(name: str, subject: Subject, chain: EmbeddedChain, scale: int = 1) -> File:
    """A file of one of the kinds. scale: of a PNG. InputError if there is no such thing."""
    kind = kind_of(name)
    if name == "file":
        return uploaded(subject.stored)
    return File(subject.stem + kind.extension, kind.media_type, _content(kind, subject, chain, scale))


def uploaded(stored: Stored | None) -> File:
    """The file itself, as it was handed in. InputError if there is none."""
    if stored is None:
        raise InputError("the picture is not made of a file that was handed in")
    return File(stored.name, kind_of("file").media_type, stored.data)


def _content(kind: Kind, subject: Subject, chain: EmbeddedChain, scale: int) -> bytes:
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
    if name == "python":
        return python_program(subject, image).encode()
    if name == "solidity":
        return solidity_contract(subject, image).encode()
    return image.encode(kind.extension)


def _png(image: Image, scale: int) -> bytes:
    if scale not in SCALES:
        raise InputError(f"a PNG can be {SCALES[0]} to {SCALES[-1]} times as large, not {scale!r:.20}")
    if max(image.width, image.height) * scale > MAX_PNG:
        raise InputError(f"a PNG can have up to {MAX_PNG:,} pixels a side: choose a smaller scale than {scale}")
    return png(enlarged(image.pixels, scale), 6)
