"""Mesh files that tests write and read back, and a glTF document to which they add."""

from __future__ import annotations

import base64
import io
import json
import struct
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from shackled.scene import Mesh, read_mesh

#: The codes of kinds of numbers in glTF, and the types by how many of them there are.
CODES = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


def read(path: Path, content: str | bytes) -> Mesh:
    """Write a file, and return its mesh."""
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return read_mesh(path)


def read_with_notes(path: Path, content: str | bytes) -> tuple[Mesh, list[str]]:
    """Write a file, and return its mesh, and the notes without the path that each begins with."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        mesh = read(path, content)
    notes = [str(each.message) for each in told]
    assert all(note.startswith(f"{path}: ") and "\n" not in note for note in notes)
    return mesh, [note.removeprefix(f"{path}: ") for note in notes]


def corner_colors(mesh: Mesh) -> list[list[list[int]]]:
    """Return the colours of the corners of all faces."""
    colors: list[list[list[int]]] = mesh.colors[mesh.faces].tolist()
    return colors


def corner_positions(mesh: Mesh) -> list[list[list[float]]]:
    """Return the positions of the corners of all faces."""
    positions: list[list[list[float]]] = mesh.positions[mesh.faces].tolist()
    return positions


class Gltf:
    """A glTF document whose data are in one buffer."""

    def __init__(self, **document: Any) -> None:
        """Take the tables of the document."""
        self.data = b""
        self.document: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "bufferViews": [],
            "accessors": [],
            **document,
        }

    def view(self, data: bytes) -> int:
        """Add bytes, and return the number of their view."""
        self.data += bytes(-len(self.data) % 4)
        self.document["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.document["bufferViews"]) - 1

    def accessor(self, values: NDArray[Any], **more: Any) -> int:
        """Add rows of numbers, or single ones, and return the number of their accessor."""
        self.document["accessors"].append(
            {
                "bufferView": self.view(values.tobytes()),
                "componentType": CODES[values.dtype.str[1:]],
                "count": len(values),
                "type": TYPES[1 if values.ndim == 1 else values.shape[-1]],
                **more,
            }
        )
        return len(self.document["accessors"]) - 1

    def glb(self, path: Path) -> Path:
        """Write a binary file."""
        self.document["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.document).encode()
        text += b" " * (-len(text) % 4)
        data = self.data + bytes(-len(self.data) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
        return path

    def gltf(self, path: Path, uri: str | None = None) -> Path:
        """Write a file in text, with its data inside, or at a URI."""
        uri = uri or "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.document["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        path.write_text(json.dumps(self.document))
        return path


def png(pixels: NDArray[np.uint8] | Image.Image) -> bytes:
    """Return a PNG file of pixels."""
    stream = io.BytesIO()
    (pixels if isinstance(pixels, Image.Image) else Image.fromarray(pixels)).save(stream, "PNG")
    return stream.getvalue()
