"""Mesh files that tests write and read back, and a glTF document to which they add."""

from __future__ import annotations

import base64
import io
import json
import math
import struct
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from shackled.errors import InputError
from shackled.scene import read_mesh
from shackled.scene._files.mesh_file import read_model
from shackled.scene._mesh import Mesh

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


def refusal(path: Path, content: str | bytes | None = None, read: Any = read_model, **options: Any) -> str:
    """Write a file, if its content is given, and return why it is refused: one line, without its path."""
    if content is not None:
        path.write_bytes(content.encode() if isinstance(content, str) else content)
    with pytest.raises(InputError) as error:
        read(path, **options)
    told = str(error.value)
    assert told.startswith(str(path))
    assert "\n" not in told
    return told.removeprefix(str(path)).removeprefix(": ")


def corner_colors(mesh: Mesh) -> Any:
    """Return the colours of the corners of all faces."""
    return mesh.colors[mesh.faces].tolist()


def corner_positions(mesh: Mesh) -> Any:
    """Return the positions of the corners of all faces."""
    return mesh.positions[mesh.faces].tolist()


def sheet(columns: int, rows: int) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return x and y of the corners of a grid of squares, 0..columns and 0..rows, and its faces."""
    x, y = (each.ravel() for each in np.meshgrid(np.arange(columns + 1), np.arange(rows + 1)))
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    faces = corner[:, None] + np.array([0, 1, columns + 2, 0, columns + 2, columns + 1])
    return x, y, faces.reshape(-1, 3)


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


#: A triangle whose corners all differ.
POINTS = np.array([[0, 0, 0], [2, 0, 0], [0, 1, 0.5]], dtype="f4")


class GltfObject(Gltf):
    """A document with one mesh on one node, by default a triangle, to which tests add."""

    def __init__(self, points: Any = POINTS) -> None:
        """Take the positions."""
        super().__init__(nodes=[{"mesh": 0}], scenes=[{"nodes": [0]}])
        del self.document["scene"]
        self.primitive: dict[str, Any] = {"attributes": {"POSITION": self.rows(points)}}
        self.document["meshes"] = [{"primitives": [self.primitive]}]

    @property
    def node(self) -> Any:
        """The node of the mesh."""
        return self.document["nodes"][0]

    def rows(self, values: Any, kind: str = "f4", **more: Any) -> int:
        """Add rows of numbers, or single ones, and return the number of their accessor."""
        array = np.asarray(values, dtype=kind)
        return self.accessor(array.reshape(len(array), math.prod(array.shape[1:])), **more)

    def material(self, **values: Any) -> None:
        """Give the mesh a material."""
        self.document["materials"] = [values]
        self.primitive["material"] = 0

    def texture(self, pixels: Any, mode: str = "RGB") -> dict[str, int]:
        """Add an image and where the corners are on it, and return what a material says of it."""
        image = Image.fromarray(np.asarray(pixels, dtype=np.uint8), mode)
        self.document["images"] = [{"bufferView": self.view(png(image)), "mimeType": "image/png"}]
        self.document["textures"] = [{"source": 0}]
        self.primitive["attributes"]["TEXCOORD_0"] = self.rows([[0, 0], [1, 0], [0, 1]])
        return {"index": 0}

    def skin(self, joints: list[dict[str, Any]], bindings: Any = None, used: Any = None, weights: Any = None) -> None:
        """Add joints to the scene, on which the vertices hang: by default each on the first one."""
        numbers = [len(self.document["nodes"]) + number for number in range(len(joints))]
        self.document["nodes"] += joints
        self.document["scenes"][0]["nodes"] += numbers
        self.node["skin"] = 0
        self.document["skins"] = [{"joints": numbers}]
        if bindings is not None:
            columns = np.asarray(bindings).transpose(0, 2, 1)
            self.document["skins"][0]["inverseBindMatrices"] = self.rows(columns)
        self.primitive["attributes"] |= {
            "JOINTS_0": self.rows([[0, 0, 0, 0]] * 3 if used is None else used, "u1"),
            "WEIGHTS_0": self.rows([[1, 0, 0, 0]] * 3 if weights is None else weights),
        }

    def animation(self, path: str, times: Any, values: Any, node: int = 0, name: str = "Move", **sampler: Any) -> None:
        """Add an animation of one channel."""
        part = {"input": self.rows(times), "output": self.rows(values), **sampler}
        channel = {"sampler": 0, "target": {"node": node, "path": path}}
        animation = {"name": name, "samplers": [part], "channels": [channel]}
        self.document.setdefault("animations", []).append(animation)

    def write(self, folder: Path) -> Path:
        """Write it as text, and return its path."""
        return self.gltf(folder / "model.gltf")


def png(pixels: NDArray[np.uint8] | Image.Image) -> bytes:
    """Return a PNG file of pixels."""
    stream = io.BytesIO()
    (pixels if isinstance(pixels, Image.Image) else Image.fromarray(pixels)).save(stream, "PNG")
    return stream.getvalue()
