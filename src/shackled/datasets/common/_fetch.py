"""Download and preparation of models."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from ...errors import FetchError, InputError
from ...scene import MAX_BYTES, Mesh, about
from .. import cache_folder, keep
from ._clean import prepare
from ._models import Model, save_mesh
from ._unpack import read_model

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
        raise InputError(
            f"{path} {'is no file' if path.exists() else 'does not exist'}; a mesh file or archive is needed"
        )
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
