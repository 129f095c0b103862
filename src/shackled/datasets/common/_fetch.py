"""Download, unpacking and preparation of models."""

from __future__ import annotations

import hashlib
import io
import tempfile
import warnings
import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from xml.etree import ElementTree

import numpy as np

from ...errors import FetchError, InputError, InputWarning
from ...scene import MAX_BYTES, READERS, Mesh, about, read_mesh, weld
from .. import cache_folder, keep
from ._clean import prepare
from ._models import Model, save_mesh

MODEL_3MF = "3D/3dmodel.model"
#: Timeouts in seconds: of a connection, and between parts of the file.
TIMEOUT = (10, 30)
#: Bytes that are read at a time.
CHUNK = 1 << 13

#: Called with the bytes downloaded so far, and the size of the file, None if it is not known.
Progress = Callable[[int, int | None], object]


def fetch(model: Model, again: bool = False, progress: Progress = lambda here, whole: None) -> bool:
    """Download a model unless it is in the cache, and prepare it; return whether anything was done.

    again: prepare it again, replacing a file of the user. FetchError if it cannot be downloaded or written.
    """
    if not again and model.kept() is not None:
        return False
    _save(model, _prepared(model, download(model, progress)))
    return True


def take(model: Model, path: Path) -> bool:
    """Prepare a model from a local file instead of a download; return whether it is the published file.

    InputError if it is not a readable mesh.
    """
    if not path.is_file():
        wrong = "is no file" if path.exists() else "does not exist"
        raise InputError(f"{path} {wrong}; a mesh file or archive is needed")
    mesh = _prepared(model, path)
    same = checksum(path.read_bytes(), model.checksum) == model.checksum
    _save(model, mesh, own=not same)
    return same


def checksum(data: bytes, like: str) -> str:
    """Return the checksum of a file, of the kind of another: "sha256:..." or "git-blob:..."."""
    kind = like.partition(":")[0]
    digest = hashlib.sha256(data)
    if kind == "git-blob":
        digest = hashlib.sha1(b"blob %d\0" % len(data) + data, usedforsecurity=False)
    return f"{kind}:{digest.hexdigest()}"


def _prepared(model: Model, path: Path) -> Mesh:
    mesh = read_model(path)
    with about(str(path)):
        return prepare(mesh, model.rotation, model.cap, model.inside_out)


def _save(model: Model, mesh: Mesh, own: bool = False) -> None:
    with _on_disk(model):
        save_mesh(mesh, model.prepared(own))
        if not own:
            model.prepared(own=True).unlink(missing_ok=True)


def download(model: Model, progress: Progress = lambda here, whole: None) -> Path:
    """Return the path of the published file, from the cache or from its address."""
    place = model.original
    with _on_disk(model):
        if not place.is_file() or checksum(place.read_bytes(), model.checksum) != model.checksum:
            keep(place, _download(model, progress))
    return place


def _download(model: Model, progress: Progress) -> bytes:
    import requests

    name, address, size = model.name, model.address, model.size
    host, most = address.split("/")[2], MAX_BYTES if size is None else size
    data = b""
    try:
        with requests.get(address, stream=True, timeout=TIMEOUT) as response:
            if response.status_code != 200:
                raise FetchError(f"{name}: {address} answers {response.status_code} {response.reason}")
            for part in response.iter_content(CHUNK):
                data += part
                if len(data) > most:
                    raise FetchError(f"{name}: {address} sends more than the {most:,} bytes expected")
                progress(len(data), size)
            is_cut = size is not None and len(data) < size
    except requests.exceptions.RequestException as error:
        if not data:
            raise FetchError(
                f"{name}: {host} cannot be reached ({type(error).__name__}); is there a network?"
                f" A file that you have goes in with: shackled datasets fetch {name} --from FILE"
            ) from None
        is_cut = True
    if is_cut:
        raise FetchError(f"{name}: the connection was cut after {len(data):,} bytes; run it again")
    found = checksum(data, model.checksum)
    if found != model.checksum:
        raise FetchError(
            f"{name}: what {address} sends is not the file that was expected: its checksum is {found}"
            f" instead of {model.checksum}"
        )
    return data


@contextmanager
def _on_disk(model: Model) -> Iterator[None]:
    """Raise a FetchError for errors of the disk."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or error
        raise FetchError(f"{model.name}: the cache {cache_folder()} cannot be used: {reason}") from None


def read_model(path: Path) -> Mesh:
    """Read the mesh of a mesh file, a 3MF, or the largest mesh file in a zip archive.

    Materials and textures are ignored without a warning, since only the mesh of a model is fetched. InputError, one
    line that begins with the path, for anything that is wrong with the file.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", InputWarning)
        try:
            with path.open("rb") as file:
                if file.read(4) != b"PK\3\4":
                    return read_mesh(path)
            with zipfile.ZipFile(path) as archive:
                return _from_zip(path, archive)
        except (OSError, EOFError, zipfile.BadZipFile, zlib.error, RuntimeError) as error:
            reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
            raise InputError(f"{path} cannot be read: {reason}") from None


def _from_zip(path: Path, archive: zipfile.ZipFile) -> Mesh:
    sizes = {each.filename: each.file_size for each in archive.infolist()}
    meshes = [name for name in sizes if PurePosixPath(name).suffix.lower() in READERS]
    if not meshes and MODEL_3MF not in sizes:
        raise InputError(f"{path} contains no mesh file; known are {', '.join(READERS)}")
    name = MODEL_3MF if MODEL_3MF in sizes else max(meshes, key=lambda each: (sizes[each], each))
    with archive.open(name) as file:
        data = file.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise InputError(f"{path} unpacks to more than {MAX_BYTES >> 20} MB, the most that is read")
    if name == MODEL_3MF:
        return _read_3mf(path, data)
    with tempfile.TemporaryDirectory() as folder:
        unpacked = Path(folder, f"model{PurePosixPath(name).suffix}")
        unpacked.write_bytes(data)
        try:
            return read_mesh(unpacked)
        except InputError as error:
            raise InputError(str(error).replace(str(unpacked), f"{path}: {name}")) from None


def _read_3mf(path: Path, model: bytes) -> Mesh:
    """Read all meshes of a 3MF, each in its own coordinates."""
    positions: list[list[float]] = []
    faces: list[list[int]] = []
    first = 0
    try:
        for _, element in ElementTree.iterparse(io.BytesIO(model), events=("end",)):
            kind = element.tag.rpartition("}")[2]
            if kind == "vertex":
                positions.append([float(element.attrib[axis]) for axis in ("x", "y", "z")])
            elif kind == "triangle":
                faces.append([first + int(element.attrib[corner]) for corner in ("v1", "v2", "v3")])
            elif kind == "mesh":
                first = len(positions)
            if kind in ("vertex", "triangle", "mesh"):
                element.clear()
        if not faces:
            raise ValueError("it has no triangles")
        return weld(np.array(positions), np.array(faces))
    except (InputError, KeyError, ValueError, ElementTree.ParseError) as error:
        raise InputError(f"{path} is not a 3MF file that can be read: {error}") from None
