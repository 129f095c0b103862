"""Checks of untrusted files before they are read: ZIP archives and glTF."""

from __future__ import annotations

import io
import json
import stat
import struct
import zipfile
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import unquote

from ..errors import InputError
from ..scene import PICTURE, READERS, SCENES
from ._store import MEGABYTE, Limits

_CHUNK = 1 << 16
#: Largest number of nested folders, and of characters of a name.
_DEPTH, _NAME = 6, 120


def unpack(data: bytes, folder: Path, limits: Limits, what: str = "the archive") -> Path:
    """Unpack a ZIP archive into a folder; return the path of its scene file, or else of its mesh file.

    InputError if there is not exactly one, or the archive breaks a limit or is damaged. what: its name in messages.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            names = _checked(archive, limits, what)
            left = limits.unpacked
            for name, entry in names.items():
                target = folder.joinpath(*name.parts)
                target.parent.mkdir(parents=True, exist_ok=True)
                left = _extract(archive, entry, target, left, limits.unpacked)
    except (zipfile.BadZipFile, zipfile.LargeZipFile, EOFError, NotImplementedError, RuntimeError, OSError) as error:
        raise InputError(f"{what} cannot be unpacked: {' '.join(str(error).split())[:100]}") from None
    except ValueError as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{what} cannot be unpacked") from None
    except Exception as error:  # zlib.error, LZMAError: each compression has its own
        raise InputError(f"{what} is damaged: {' '.join(str(error).split())[:100]}") from None
    return folder.joinpath(*_main(list(names), what).parts)


def _checked(archive: zipfile.ZipFile, limits: Limits, what: str) -> dict[PurePosixPath, zipfile.ZipInfo]:
    entries = [entry for entry in archive.infolist() if not entry.is_dir()]
    if len(entries) > limits.entries:
        raise InputError(f"{what} has {len(entries):,} files; the limit is {limits.entries}")
    whole = sum(entry.file_size for entry in entries)
    if whole > limits.unpacked:
        raise InputError(
            f"{what} unpacks to {whole / MEGABYTE:,.0f} MB; the limit is {limits.unpacked / MEGABYTE:.0f} MB"
        )
    names: dict[PurePosixPath, zipfile.ZipInfo] = {}
    for entry in entries:
        name = PurePosixPath(entry.filename.replace("\\", "/"))
        if name.is_absolute() or ".." in name.parts or ":" in entry.filename or "\0" in entry.filename:
            raise InputError(f"{what} has a file whose path leads outside: {entry.filename!r:.80}")
        if len(name.parts) > _DEPTH or any(len(part) > _NAME for part in name.parts):
            raise InputError(f"{what} has a file with too long a path: {entry.filename!r:.80}")
        if stat.S_ISLNK(entry.external_attr >> 16):
            raise InputError(f"{what} has a symbolic link, {entry.filename!r:.80}; include the file itself")
        if entry.flag_bits & 1:
            raise InputError(f"{what} is encrypted; pack it without a password")
        if not _is_hidden(name):
            names[name] = entry
    return names


def _extract(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, target: Path, left: int, bound: int) -> int:
    """Unpack a file; return the number of bytes left for others. The size in the archive is not trusted."""
    with archive.open(entry) as packed, target.open("xb") as file:
        while chunk := packed.read(_CHUNK):
            left -= len(chunk)
            if left < 0:
                raise InputError(f"the archive unpacks to more than the limit of {bound / MEGABYTE:.0f} MB")
            file.write(chunk)
    return left


def _main(names: list[PurePosixPath], what: str) -> PurePosixPath:
    # pictures beside a mesh are its textures
    for known in (SCENES, tuple(READERS), (PICTURE,)):
        found = [name for name in names if name.suffix.lower() in known]
        if len(found) == 1:
            return found[0]
        if found:
            shown = ", ".join(str(name) for name in found[:4])
            raise InputError(f"{what} has {len(found)} files that could be shown ({shown:.120}); include only one")
    raise InputError(f"{what} has no mesh or scene file ({', '.join((*READERS, *SCENES, PICTURE))})")


def _is_hidden(name: PurePosixPath) -> bool:
    return name.parts[0] == "__MACOSX" or any(part.startswith(".") for part in name.parts)


# ---- glTF ----

#: Limits of a glTF file: elements of all accessors, nodes, and corners of the triangles of all instances of meshes.
MAX_ELEMENTS = 8_000_000
MAX_NODES = 10_000
MAX_CORNERS = 6_000_000
#: Largest depth of the tree of nodes.
MAX_DEPTH = 200

_JSON_CHUNK = 0x4E4F534A


def check_gltf(path: Path, data: bytes) -> None:
    """Raise InputError if a glTF or GLB file breaks a limit, or refers to a file that was not uploaded with it."""
    document = _document(data)
    if document is None:
        raise InputError("it is not valid glTF: its JSON is damaged or missing")
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
        raise InputError(f"it declares {count:,} elements; the limit is {MAX_ELEMENTS:,}")
    nodes = len(_tables(document, "nodes"))
    if nodes > MAX_NODES:
        raise InputError(f"it has {nodes:,} nodes; the limit is {MAX_NODES:,}")


def _check_nodes(document: dict[str, Any]) -> None:
    """Raise InputError unless the nodes are trees, as glTF requires: shared nodes would multiply their descendants."""
    nodes = _tables(document, "nodes")
    parents = [0] * len(nodes)
    corners = 0
    sizes = [_corners(mesh, document) for mesh in _tables(document, "meshes")]
    for node in nodes:
        for child in _list(node.get("children")):
            if isinstance(child, int) and 0 <= child < len(nodes):
                parents[child] += 1
                if parents[child] > 1:
                    raise InputError(f"its node {child} has several parents, which glTF does not allow")
        mesh = node.get("mesh")
        if isinstance(mesh, int) and 0 <= mesh < len(sizes):
            corners += sizes[mesh]
    if corners > MAX_CORNERS:
        raise InputError(f"it shows {corners // 3:,} triangles; the limit is {MAX_CORNERS // 3:,}")
    level, depth, seen = [i for i, count in enumerate(parents) if not count], 0, 0
    while level:
        seen, depth = seen + len(level), depth + 1
        if depth > MAX_DEPTH:
            raise InputError(f"its tree of nodes is more than {MAX_DEPTH} levels deep")
        level = [
            child
            for node in level
            for child in _list(nodes[node].get("children"))
            if isinstance(child, int) and 0 <= child < len(nodes)
        ]
    if seen < len(nodes):
        raise InputError("its nodes form a cycle")


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
            f"it refers to {uri!r:.60}, which was not uploaded: export it as one .glb, or put all files into a ZIP"
        )


def _tables(document: dict[str, Any], key: str) -> list[dict[str, Any]]:
    return [each if isinstance(each, dict) else {} for each in _list(document.get(key))]


def _list(value: object) -> list[Any]:
    return value if isinstance(value, list) else []


def _whole(value: object) -> int:
    return value if isinstance(value, int) and not isinstance(value, bool) and value > 0 else 0
