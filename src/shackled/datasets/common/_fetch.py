"""Download and preparation of models.

A file is downloaded under a name that ends in .part, and renamed if its checksum is right, so that files in the cache
are always complete. An interrupted download continues where it stopped, if the server can do that.
"""

from __future__ import annotations

import errno
import hashlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ...errors import FetchError, InputError
from ...scene import MAX_BYTES, about
from .. import cache_folder
from ._clean import prepare
from ._models import Model, save_mesh
from ._unpack import read_model

#: Timeouts in seconds: of a connection, and between parts of the file.
TIMEOUT = (10, 30)
#: Bytes that are read and written at a time.
CHUNK = 1 << 13

#: Called with the bytes downloaded so far, and the size of the file, None if it is not known.
Progress = Callable[[int, int | None], None]


def _no_progress(here: int, whole: int | None) -> None:
    pass


def fetch(model: Model, again: bool = False, progress: Progress = _no_progress) -> bool:
    """Download a model unless it is in the cache, and prepare it; return whether anything was done.

    again: prepare it again, replacing a file of the user. FetchError if it cannot be downloaded or written.
    """
    prepared = model.prepared()
    if not again and model.kept() is not None:
        return False
    _keep(model, download(model, progress), prepared)
    model.prepared(own=True).unlink(missing_ok=True)
    return True


def take(model: Model, path: Path) -> bool:
    """Prepare a model from a local file instead of a download; return whether it is the published file.

    InputError if it is not a readable mesh.
    """
    if not path.is_file():
        raise InputError(
            f"{path} {'is no file' if path.exists() else 'does not exist'}; a mesh file or archive is needed"
        )
    same = checksum(path, model.checksum) == model.checksum
    _keep(model, path, model.prepared(own=not same))
    if same:
        model.prepared(own=True).unlink(missing_ok=True)
    return same


def checksum(path: Path, like: str) -> str:
    """Return the checksum of a file, of the kind of another: "sha256:..." or "git-blob:..."."""
    kind = like.partition(":")[0]
    digest = hashlib.sha256()
    if kind == "git-blob":
        digest = hashlib.sha1(f"blob {path.stat().st_size}\0".encode(), usedforsecurity=False)
    with path.open("rb") as file:
        while data := file.read(CHUNK):
            digest.update(data)
    return f"{kind}:{digest.hexdigest()}"


def _keep(model: Model, path: Path, prepared: Path) -> None:
    mesh = read_model(path, model.member)
    with about(str(path)):
        mesh = prepare(mesh, model.rotation, model.cap, model.inside_out)
    with _on_disk(model):
        save_mesh(mesh, prepared)


# ---- the download ----


def download(model: Model, progress: Progress = _no_progress) -> Path:
    """Return the path of the published file, from the cache or from the first address that has it."""
    place = model.original
    with _on_disk(model):
        if place.is_file() and checksum(place, model.checksum) == model.checksum:
            return place
        place.unlink(missing_ok=True)
        place.parent.mkdir(parents=True, exist_ok=True)
    failures: list[FetchError] = []
    for address in model.addresses:
        try:
            with _on_disk(model):
                _download(model, address, progress)
            return place
        except FetchError as error:
            failures.append(error)
    raise failures[-1]


def _download(model: Model, address: str, progress: Progress) -> None:
    """Download the file from an address, from where that was cut, and move it to its place if its checksum is right."""
    part = _part(model)
    resumed = part.is_file() and part.stat().st_size > 0
    _transfer(model, address, part, progress)
    found = checksum(part, model.checksum)
    if found != model.checksum and resumed:
        # what was there may have been the beginning of something else
        part.unlink()
        _transfer(model, address, part, progress)
        found = checksum(part, model.checksum)
    if found != model.checksum:
        part.unlink()
        raise FetchError(
            f"{model.name}: what {address} sends is not the file that was expected: its checksum is {found}"
            f" instead of {model.checksum}"
        )
    part.replace(model.original)


def _transfer(model: Model, address: str, part: Path, progress: Progress) -> None:
    """Download the missing part of the file."""
    import requests

    name = model.name
    here = part.stat().st_size if part.is_file() else 0
    headers = {"Accept-Encoding": "identity"}
    if here:
        headers["Range"] = f"bytes={here}-"
    whole, answered = model.size, False
    try:
        with requests.get(address, headers=headers, stream=True, timeout=TIMEOUT) as response:
            answered = True
            if response.status_code == 416:  # there is no more than what is here
                if whole is None or here == whole:
                    return
                part.unlink()
                raise FetchError(f"{name}: {address} sent {here:,} bytes instead of {whole:,}; run it again")
            if response.status_code not in (200, 206):
                raise FetchError(f"{name}: {address} answers {response.status_code} {response.reason}")
            goes_on = response.status_code == 206 and response.headers.get("Content-Range", "").startswith(
                f"bytes {here}-"
            )
            if not goes_on:
                here = 0
            with part.open("ab" if goes_on else "wb") as file:
                for data in response.iter_content(CHUNK):
                    here += len(data)
                    if here > (MAX_BYTES if whole is None else whole):
                        file.close()
                        part.unlink()
                        raise FetchError(f"{name}: {address} sends more than the {whole or MAX_BYTES:,} bytes expected")
                    _write(file, data)
                    progress(here, whole)
    except requests.exceptions.ConnectTimeout:
        raise FetchError(f"{name}: no answer from {_host(address)} within {TIMEOUT[0]} seconds") from None
    except (
        requests.exceptions.ConnectionError,
        requests.exceptions.ChunkedEncodingError,
        requests.exceptions.Timeout,
    ):
        if answered:
            raise _cut(model, here) from None
        raise FetchError(
            f"{name}: {_host(address)} cannot be reached; is there a network?"
            f" A file that you have goes in with: shackled datasets fetch {name} --from FILE"
        ) from None
    except requests.exceptions.RequestException as error:
        raise FetchError(f"{name}: {address} cannot be fetched: {type(error).__name__}") from None
    if whole is not None and here < whole:
        raise _cut(model, here)


def _cut(model: Model, here: int) -> FetchError:
    of = "" if model.size is None else f" of {model.size:,}"
    return FetchError(
        f"{model.name}: the connection was cut after {here:,}{of} bytes; run it again to go on from there"
    )


def _part(model: Model) -> Path:
    """Return the path of an unfinished download."""
    return model.original.with_name(f"{model.original.name}.part")


def _write(file: Any, data: bytes) -> None:
    file.write(data)


def _host(address: str) -> str:
    return address.split("/")[2]


@contextmanager
def _on_disk(model: Model) -> Iterator[None]:
    """Raise a FetchError for errors of the disk."""
    try:
        yield
    except OSError as error:
        folder = cache_folder()
        if error.errno in (errno.ENOSPC, errno.EDQUOT):
            _part(model).unlink(missing_ok=True)
            raise FetchError(f"{model.name}: the disk is full: no space for it in {folder}") from None
        raise FetchError(f"{model.name}: the cache {folder} cannot be used: {error.strerror or error}") from None
