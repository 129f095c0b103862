"""The scene in a PNG file: a chunk with the call that renders it. docs/scene-files.md documents the chunk."""

from __future__ import annotations

import hashlib
import zlib
from binascii import Error, unhexlify
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ...errors import InputError
from .._codec import render_call
from .._decode import decode
from .._scene import Scene
from .content import read_content
from .table import about

#: The extension of pictures that carry their scene.
PICTURE = ".png"

#: The kind of the chunk, and its keyword; and all chunks of text.
CHUNK, KEYWORD = b"zTXt", b"shackled"
TEXTS = (CHUNK, b"tEXt", b"iTXt")
#: The chunk that is written in place of one that is too large: its keyword, before the SHA-256 of its text.
DIGEST, DIGEST_KEYWORD = b"tEXt", b"shackled-sha256"
#: The most bytes of the chunk, and characters of its text, that are written unless asked for. Pillow opens no picture
#: with more characters.
MAX_CHUNK, MAX_TEXT = 64 * 1024, 2**20
#: The most characters that are written or read at all; libpng passes over more.
LONGEST_TEXT = 8_000_000

_SIGNATURE = b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True)
class SceneChunk:
    """A chunk zTXt with a scene. data: of the chunk, after its length and kind. characters: of its text.

    digest: the data of the chunk that is written instead where this one is not.
    """

    data: bytes
    characters: int
    digest: bytes

    @property
    def is_small(self) -> bool:
        """Whether it is written unless the caller decides."""
        return len(self.data) <= MAX_CHUNK and self.characters <= MAX_TEXT

    def check(self) -> None:
        """Raise an InputError if it cannot be written at all."""
        if self.characters > LONGEST_TEXT:
            raise InputError(
                f"the scene is too large for a PNG file: {self.characters:,} characters, of which there may be"
                f" {LONGEST_TEXT:,}; Scene.save writes it as .json"
            )


def scene_chunk(scene: Scene) -> SceneChunk:
    """Return the chunk with a scene; the same bytes for the same scene and version of zlib."""
    text = b"0x" + render_call(scene).hex().encode()
    digest = DIGEST_KEYWORD + b"\0" + hashlib.sha256(text).hexdigest().encode()
    return SceneChunk(KEYWORD + b"\0\0" + zlib.compress(text), len(text), digest)


def shows_scene(path: Path, scene: Scene, has_alpha: bool) -> bool:
    """Return whether a file is a whole PNG file that says that it shows a scene, with an alpha channel or without."""
    wanted = scene_chunk(scene)
    try:
        chunks = list(_chunks(path.read_bytes()))
    except (OSError, InputError):
        return False
    # the colour type is byte 9 of IHDR: 6 has alpha
    is_alike = chunks[0][0] == b"IHDR" and (chunks[0][1][9:10] == b"\6") == has_alpha
    return is_alike and ((CHUNK, wanted.data) in chunks or (DIGEST, wanted.digest) in chunks)


def read_picture(path: Path) -> Scene:
    """Return the scene that a PNG file carries. InputError, with the path, if there is none. Pixels are not read."""
    data = read_content(path)
    with about(str(path)):
        found = [each for each in _chunks(data) if each[0] in TEXTS and each[1].startswith(KEYWORD + b"\0")]
        kinds = [kind for kind, _ in found]
        if kinds != [CHUNK]:
            has = b", ".join(kinds).decode() or "none"
            raise InputError(f"the picture carries no scene: it needs one chunk zTXt with it, and has {has}")
        content = found[0][1]
        call = _call(content[len(KEYWORD) + 1 :])
        with about("the chunk shackled"):
            return decode(call)


def _chunks(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yield kind and content of the chunks of a PNG file; what follows its end is passed over."""
    if not data.startswith(_SIGNATURE):
        raise InputError("it is not a PNG file")
    kind, place = b"", len(_SIGNATURE)
    while kind != b"IEND":
        size = int.from_bytes(data[place : place + 4], "big")
        kind, end = data[place + 4 : place + 8], place + 8 + size
        if end + 4 > len(data):
            raise InputError("the picture is cut off")
        if zlib.crc32(memoryview(data)[place + 4 : end]) != int.from_bytes(data[end : end + 4], "big"):
            raise InputError(f"the picture is damaged: the checksum of its chunk {kind!r} is wrong")
        yield kind, data[place + 8 : end]
        place = end + 4


def _call(content: bytes) -> bytes:
    """Return the call in a compressed text. content: the method of compression, and the text."""
    inflater = zlib.decompressobj()
    try:
        text = inflater.decompress(content[1:], LONGEST_TEXT + 1)
        if len(text) > LONGEST_TEXT:
            raise InputError(f"its scene has more than {LONGEST_TEXT:,} characters, the most that are read")
        if content[:1] == b"\0" and text.startswith(b"0x") and inflater.eof and not inflater.unused_data:
            return unhexlify(text[2:])
    except (zlib.error, Error):
        pass
    raise InputError("its chunk shackled holds no scene: it must be 0x and the call in hexadecimal, deflated")
