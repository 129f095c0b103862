"""Reading of meshes from any file, including archives."""

from __future__ import annotations

import gzip
import io
import lzma
import tarfile
import tempfile
import warnings
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from typing import Protocol
from xml.etree import ElementTree

import numpy as np

from ...errors import InputError, InputWarning
from ...scene import MAX_BYTES, READERS, Mesh, read_mesh, weld

#: What the kinds of packed files begin with; a tar has its mark further behind.
ZIP, GZIP, XZ, BZIP2 = b"PK\3\4", b"\x1f\x8b", b"\xfd7zXZ", b"BZh"
TAR_MARK = (257, b"ustar")

MODEL_3MF = "3D/3dmodel.model"

_BROKEN = (OSError, EOFError, zipfile.BadZipFile, tarfile.TarError, zlib.error, lzma.LZMAError, RuntimeError)


class _Readable(Protocol):
    def read(self, size: int, /) -> bytes: ...


def read_model(path: Path, member: str | None = None) -> Mesh:
    """Read the mesh of a mesh file, a 3MF, a gzipped mesh file, or a mesh file in a zip or tar archive.

    member: the file in the archive; None for the largest mesh file of a known kind. Materials and textures are ignored
    without a warning, since only the mesh of a model is fetched. InputError, one line that begins with the path, for
    anything that is wrong with the file.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", InputWarning)
        return _read(path, member)


def _read(path: Path, member: str | None) -> Mesh:
    try:
        with path.open("rb") as file:
            head = file.read(512)
        if head.startswith(ZIP):
            return _from_zip(path, member)
        if head.startswith((GZIP, XZ, BZIP2)) or head[TAR_MARK[0] :].startswith(TAR_MARK[1]):
            return _from_tar(path, member)
    except InputError:
        raise
    except _BROKEN as error:
        reason = " ".join(str(getattr(error, "strerror", None) or error or type(error).__name__).split())
        raise InputError(f"{path} cannot be read: {reason}") from None
    return read_mesh(path)


def _from_zip(path: Path, member: str | None) -> Mesh:
    with zipfile.ZipFile(path) as archive:
        sizes = {info.filename: info.file_size for info in archive.infolist() if not info.is_dir()}
        if member is None and MODEL_3MF in sizes:
            return _read_3mf(path, _limited(archive.open(MODEL_3MF), path))
        name = _choose(path, sizes, member)
        with archive.open(name) as file:
            return _read_packed(path, name, file)


def _from_tar(path: Path, member: str | None) -> Mesh:
    with path.open("rb") as file:
        head = file.read(2)
    try:
        archive = tarfile.open(path)  # noqa: SIM115
    except tarfile.ReadError:
        if head != GZIP:
            raise
        # one packed file, "bunny.ply.gz"
        with gzip.open(path) as packed:
            return _read_packed(path, path.stem, packed)
    with archive:
        sizes = {info.name: info.size for info in archive.getmembers() if info.isfile()}
        name = _choose(path, sizes, member)
        opened = archive.extractfile(name)
        assert opened is not None  # it is a file
        with opened:
            return _read_packed(path, name, opened)


def _choose(path: Path, sizes: dict[str, int], member: str | None) -> str:
    if member is not None:
        if member not in sizes:
            raise InputError(f"{path} does not contain {member}")
        return member
    meshes = {name: size for name, size in sizes.items() if PurePosixPath(name).suffix.lower() in READERS}
    if not meshes:
        raise InputError(f"{path} contains no mesh file; known are {', '.join(READERS)}")
    return max(meshes, key=lambda name: (meshes[name], name))


def _read_packed(path: Path, name: str, file: _Readable) -> Mesh:
    suffix = PurePosixPath(name).suffix.lower()
    if suffix not in READERS:
        raise InputError(f"{path} contains {PurePosixPath(name).name}, no mesh file; known are {', '.join(READERS)}")
    data = _limited(file, path)
    with tempfile.TemporaryDirectory() as folder:
        unpacked = Path(folder, f"model{suffix}")
        unpacked.write_bytes(data)
        try:
            return read_mesh(unpacked)
        except InputError as error:
            raise InputError(str(error).replace(str(unpacked), f"{path}: {name}")) from None


def _limited(file: _Readable, path: Path) -> bytes:
    data = file.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise InputError(f"{path} unpacks to more than {MAX_BYTES >> 20} MB, the most that is read")
    return data


def _read_3mf(path: Path, model: bytes) -> Mesh:
    """Read all meshes of a 3MF, each in its own coordinates."""
    positions: list[tuple[float, float, float]] = []
    faces: list[tuple[int, int, int]] = []
    first = 0
    with _as_input_error(path):
        for _, element in ElementTree.iterparse(io.BytesIO(model), events=("end",)):
            kind = element.tag.rpartition("}")[2]
            get = element.attrib.__getitem__
            if kind == "vertex":
                positions.append((float(get("x")), float(get("y")), float(get("z"))))
            elif kind == "triangle":
                faces.append((first + int(get("v1")), first + int(get("v2")), first + int(get("v3"))))
            elif kind == "mesh":
                first = len(positions)
            if kind in ("vertex", "triangle", "mesh"):
                element.clear()
        if not faces:
            raise ValueError("it has no triangles")
        return weld(np.array(positions), np.array(faces))


@contextmanager
def _as_input_error(path: Path) -> Iterator[None]:
    try:
        yield
    except (InputError, KeyError, ValueError, ElementTree.ParseError) as error:
        raise InputError(f"{path} is not a 3MF file that can be read: {error}") from None
