"""A glTF document: its tables, the bytes that they refer to, and notes of what is left out."""

from __future__ import annotations

import base64
import binascii
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote, unquote_to_bytes

import numpy as np
from numpy.typing import NDArray

from ....base.values import plural
from ....errors import InputError
from ..beside import read_beside
from ..content import parse, read_bytes, read_content
from ..images import Images
from ..model import Picture
from ..table import Table, about

_JSON, _BIN = b"JSON", b"BIN\0"
#: What is not read, and without effect where a file does not require it.
_MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")
#: What is read, has notes of its own, or is without effect on what is drawn.
_KNOWN = {
    "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
}
#: Changes of the surface only, without which the shape is right.
_SURFACES = "KHR_materials_"
#: How many triangles are read, each mesh as often as it is shown; and of how many it does not matter how large the file
#: is. Other files have at least so many bytes for each: those that say little of many would only fill the memory.
MAX_TRIANGLES, _FREE, _BYTES = 1 << 24, 1 << 19, 8


class Document:
    """A document, and what it refers to. decoded: elements of compressed accessors, by their places.

    images, pictures, lost: its images, textures, and the places of those that cannot be had.
    """

    def __init__(self, path: Path) -> None:
        """Read a file. InputError for what asks for another reader."""
        self.path = path
        data = read_content(path)
        self.binary: bytes | None = None
        if data.startswith(b"glTF"):
            data, self.binary = _chunks(data)
        self.keys = Table(parse(path, data.decode("utf-8-sig", errors="replace"), ".json"), "")
        self.decoded: dict[str, NDArray[Any]] = {}
        self.images, self.pictures, self.lost = Images(), dict[str, Picture](), set[str]()
        self._buffers: dict[str, bytes] = {}
        self._triangles = 0
        self._extensions: set[str] = set()
        self._left_out: dict[tuple[str, str], dict[str, int]] = {}
        self._check()

    def _check(self) -> None:
        if "asset" not in self.keys:
            raise InputError("it is no glTF file: asset, with the version of glTF, is missing")
        version = self.keys.table("asset").get("version")
        if not str(version).startswith("2."):
            raise InputError(f"asset.version is {version!r:.20}; glTF 2.0 is read")
        for name in (str(name) for _, name in self.keys.rows("extensionsRequired")):
            if name not in _KNOWN and not name.startswith(_SURFACES):
                raise InputError(f"it requires the extension {name:.60}, which is not read; export it without")
        self.uses(str(name) for _, name in self.keys.rows("extensionsUsed") if str(name) not in _MESHOPT)

    def uses(self, extensions: Any) -> None:
        """Keep the names of extensions, for a note of those that are not known."""
        self._extensions |= set(extensions) - _KNOWN

    def leave_out(self, what: str, where: str, sentence: str = "{}", count: int = 1) -> None:
        """Keep, for a note, that so many things at a place are left out. what: a noun; sentence: around the count."""
        self._left_out.setdefault((what, sentence), {})[where] = count

    def left_out(self) -> list[str]:
        """Return a sentence for each kind of what is left out."""
        found = [
            sentence.format(plural(sum(counts.values()), what)) for (what, sentence), counts in self._left_out.items()
        ]
        if self._extensions:
            names = ", ".join(f"{name:.60}" for name in sorted(self._extensions))
            found.append(f"what {'extension' if len(self._extensions) == 1 else 'extensions'} {names} would change")
        return [f"left out: {each}" for each in found]

    def item(self, keys: Table, key: str, kind: str, default: int | None = None) -> Table:
        """Return the part of this kind that a key names by its number."""
        items = self.keys.get(kind)
        number = keys.index(key, len(items) if isinstance(items, list) else 0, kind, default)
        return Table(items[number], f"{kind}[{number}]")

    def named(self, name: str | int, kind: str, word: str) -> Table:
        """Return the part of this kind with a name, or else a number. InputError, with those there are, if none has."""
        items = self.keys.tables(kind)
        names = [str(item.get("name") or "") for item in items]
        for keys in (names, [str(number) for number in range(len(items))]):
            if str(name) in keys:
                return items[keys.index(str(name))]
        known = ", ".join(f"{number} {each:.40}".strip() for number, each in enumerate(names))
        raise InputError(f"it has no {word} {name!r:.60}; it has {known}" if known else f"it has no {kind}")

    def view(self, view: Table) -> memoryview:
        """Return the bytes of a buffer view."""
        buffer = self.item(view, "buffer", "buffers")
        if buffer.where not in self._buffers:
            inside = self.binary if buffer.where == "buffers[0]" and "uri" not in buffer else None
            self._buffers[buffer.where] = self.resource(buffer) if inside is None else inside
        data = self._buffers[buffer.where]
        start, length = view.whole("byteOffset", 0), view.whole("byteLength")
        if start + length > len(data):
            raise InputError(f"{view.where} needs {start + length:,} bytes of {buffer.where}, which has {len(data):,}")
        return memoryview(data)[start : start + length]

    def show(self, triangles: int) -> None:
        """Count triangles that are shown. InputError if there are too many, or too many for the size of the file."""
        self._triangles += triangles
        size = sum(map(len, self._buffers.values())) + sum(each.nbytes for each in self.decoded.values())
        most = min(MAX_TRIANGLES, max(_FREE, size // _BYTES))
        if self._triangles > most:
            of_what = "" if most == MAX_TRIANGLES else " of a file of its size"
            raise InputError(f"it shows more than {most:,} triangles, the most that are read{of_what}")

    def resource(self, keys: Table) -> bytes:
        """Return what the `uri` of a buffer or image holds."""
        uri, place = keys.get("uri"), keys.place("uri")
        if not isinstance(uri, str):
            raise InputError(f"{place} must name a file or hold data, not {uri!r:.60}")
        if uri.startswith("data:"):
            head, _, payload = uri.partition(",")
            if not head.endswith(";base64"):
                return unquote_to_bytes(payload)
            try:
                # its padding is often left away
                return base64.b64decode(payload.rstrip("=") + "==")
            except (binascii.Error, ValueError):
                raise InputError(f"{place} does not hold valid base64") from None
        with about(place):
            return read_beside([self.path.parent], unquote(uri), read_bytes)


def _chunks(data: bytes) -> tuple[bytes, bytes | None]:
    """Return the JSON and the binary chunk of a GLB file."""
    version, length = struct.unpack("<II", data[4:12].ljust(8, b"\0"))
    if version != 2:
        raise InputError(f"it is of version {version} of GLB; version 2 is read")
    if length > len(data):
        raise InputError(f"it ends after {len(data):,} of its {length:,} bytes")
    found: dict[bytes, bytes] = {}
    at = 12
    while at + 8 <= length:
        size, kind = struct.unpack("<I4s", data[at : at + 8])
        if at + 8 + size > length:
            raise InputError(f"its chunk at byte {at:,} reaches beyond the end of the file")
        found.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    if _JSON not in found:
        raise InputError("it has no JSON chunk")
    # padded by spaces, or wrongly by zeros
    return found[_JSON].rstrip(b"\0"), found.get(_BIN)


#: How long an accessor without data may be.
MAX_ELEMENTS = 1 << 20

_COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def numbers(gltf: Document, keys: Table, key: str, *types: str) -> NDArray[Any]:
    """Return the elements of the accessor that a key names, (n, width); normalized integers as fractions."""
    accessor = gltf.item(keys, key, "accessors")
    width = _WIDTHS[accessor.choice("type", types)]
    values = _elements(gltf, accessor, width)
    if "sparse" in accessor:
        values = _changed(gltf, values, accessor.table("sparse"), _component(accessor))
    if values.dtype.kind in "iu" and accessor.flag("normalized", False):
        return np.maximum(values / np.iinfo(values.dtype).max, -1)
    return values


def _elements(gltf: Document, accessor: Table, width: int) -> NDArray[Any]:
    if accessor.where in gltf.decoded:
        values = gltf.decoded[accessor.where]
        if values.shape[1] != width:
            raise InputError(f"{accessor.where} has {width} numbers in each element, but its data {values.shape[1]}")
        return values
    count = accessor.whole("count")
    if "bufferView" in accessor:
        return _rows(gltf, accessor, _component(accessor), count, width)
    if count > MAX_ELEMENTS:
        raise InputError(f"{accessor.where} has {count:,} elements but no data")
    return np.zeros((count, width), _component(accessor))


def _changed(gltf: Document, values: NDArray[Any], sparse: Table, component: str) -> NDArray[Any]:
    """Return the elements, some of them with other values."""
    count, indices = sparse.whole("count"), sparse.table("indices")
    rows = _rows(gltf, indices, _component(indices), count, 1)[:, 0]
    if count and not 0 <= rows.min() <= rows.max() < len(values):
        raise InputError(f"{sparse.where} changes element {rows.max()}, but there are {len(values)}")
    values = values.copy()
    values[rows.astype(np.int64)] = _rows(gltf, sparse.table("values"), component, count, values.shape[1])
    return values


def _component(keys: Table) -> str:
    kind = keys.whole("componentType")
    if kind not in _COMPONENTS:
        known = ", ".join(map(str, _COMPONENTS))
        raise InputError(f"{keys.place('componentType')} must be one of {known}, not {kind}")
    return _COMPONENTS[kind]


def _rows(gltf: Document, keys: Table, component: str, count: int, width: int) -> NDArray[Any]:
    view = gltf.item(keys, "bufferView", "bufferViews")
    data = gltf.view(view)
    size = np.dtype(component).itemsize
    start, stride = keys.whole("byteOffset", 0), view.whole("byteStride", 0) or size * width
    if stride < size * width:
        raise InputError(f"{view.place('byteStride')} is {stride}, less than an element of {size * width} bytes")
    needed = start + stride * (count - 1) + size * width if count else 0
    if needed > len(data):
        raise InputError(f"{keys.where} needs {needed:,} bytes of {view.where}, which has {len(data):,}")
    return np.ndarray((count, width), component, data, start, (stride, size))


@dataclass(frozen=True)
class Vertices:
    """Those of the vertices of a primitive that its triangles use. count: of all vertices."""

    gltf: Document
    attributes: Table
    used: NDArray[Any]
    count: int

    def values(self, name: str, *types: str) -> NDArray[Any] | None:
        """Return an attribute of them, or None if it is absent."""
        return self.of(self.attributes, name, *types) if name in self.attributes else None

    def of(self, keys: Table, name: str, *types: str) -> NDArray[Any]:
        """Return what a table, such as a morph target, has of them."""
        values = numbers(self.gltf, keys, name, *types)
        if len(values) != self.count:
            raise InputError(f"{name} has {len(values)} values, but POSITION {self.count}")
        return np.asarray(values[self.used])
