"""What a glTF file claims, before anybody believes it: how much it holds, and from where."""

from __future__ import annotations

import json
import struct
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import unquote

from ..errors import InputError

#: Elements of all accessors, nodes, and corners of all triangles, each mesh as often as it is shown.
MAX_ELEMENTS = 8_000_000
MAX_NODES = 10_000
MAX_CORNERS = 6_000_000
#: How deep nodes may lie in one another.
MAX_DEPTH = 200

_JSON_CHUNK = 0x4E4F534A


def check_gltf(path: Path, data: bytes) -> None:
    """InputError where a glTF or GLB file claims more than there is, or refers to what was not handed in with it."""
    document = _document(data)
    if document is None:
        raise InputError("it holds no glTF that can be read: its JSON is damaged, or missing")
    _check_sizes(document)
    _check_nodes(document)
    for kind in ("buffers", "images"):
        for each in _tables(document, kind):
            _check_uri(each.get("uri"), path)


def _document(data: bytes) -> dict[str, Any] | None:
    if data[:4] == b"glTF":
        if len(data) < 20:
            return None
        length, kind = struct.unpack("<II", data[12:20])
        if kind != _JSON_CHUNK:
            return None
        data = data[20 : 20 + length]
    try:
        document = json.loads(data)
    except (ValueError, RecursionError):
        return None
    return document if isinstance(document, dict) else None


def _check_sizes(document: dict[str, Any]) -> None:
    count = sum(_whole(each.get("count")) for each in _tables(document, "accessors"))
    if count > MAX_ELEMENTS:
        raise InputError(f"it claims {count:,} elements; up to {MAX_ELEMENTS:,} are read")
    nodes = len(_tables(document, "nodes"))
    if nodes > MAX_NODES:
        raise InputError(f"it has {nodes:,} nodes; up to {MAX_NODES:,} are read")


def _check_nodes(document: dict[str, Any]) -> None:
    """Nodes must be a forest, as the standard says: one with several parents would multiply what hangs on it."""
    nodes = _tables(document, "nodes")
    parents = [0] * len(nodes)
    corners = 0
    sizes = [_corners(mesh, document) for mesh in _tables(document, "meshes")]
    for node in nodes:
        for child in _list(node.get("children")):
            if isinstance(child, int) and 0 <= child < len(nodes):
                parents[child] += 1
                if parents[child] > 1:
                    raise InputError(f"its node {child} hangs on several nodes, which glTF does not allow")
        mesh = node.get("mesh")
        if isinstance(mesh, int) and 0 <= mesh < len(sizes):
            corners += sizes[mesh]
    if corners > MAX_CORNERS:
        raise InputError(f"it shows {corners // 3:,} triangles; up to {MAX_CORNERS // 3:,} are read")
    level, depth, seen = [i for i, count in enumerate(parents) if not count], 0, 0
    while level:
        seen, depth = seen + len(level), depth + 1
        if depth > MAX_DEPTH:
            raise InputError(f"its nodes lie in one another more than {MAX_DEPTH} deep")
        level = [
            child
            for node in level
            for child in _list(nodes[node].get("children"))
            if isinstance(child, int) and 0 <= child < len(nodes)
        ]
    if seen < len(nodes):
        raise InputError("its nodes hang on one another in a circle")


def _corners(mesh: dict[str, Any], document: dict[str, Any]) -> int:
    accessors = _tables(document, "accessors")
    total = 0
    for primitive in _tables(mesh, "primitives"):
        attributes = primitive.get("attributes")
        positions = attributes.get("POSITION") if isinstance(attributes, dict) else None
        number = primitive.get("indices", positions)
        if isinstance(number, int) and 0 <= number < len(accessors):
            total += _whole(accessors[number].get("count"))
    return total


def _check_uri(uri: object, path: Path) -> None:
    if not isinstance(uri, str) or uri.startswith("data:"):
        return
    name = PurePosixPath(unquote(uri).replace("\\", "/"))
    inside = not name.is_absolute() and ".." not in name.parts and ":" not in uri
    if not inside or not path.parent.joinpath(*name.parts).is_file():
        raise InputError(
            f"it refers to {uri!r:.60}, which was not handed in: export it as one .glb, or put all files into a zip"
        )


def _tables(document: dict[str, Any], key: str) -> list[dict[str, Any]]:
    return [each if isinstance(each, dict) else {} for each in _list(document.get(key))]


def _list(value: object) -> list[Any]:
    return value if isinstance(value, list) else []


def _whole(value: object) -> int:
    return value if isinstance(value, int) and not isinstance(value, bool) and value > 0 else 0
