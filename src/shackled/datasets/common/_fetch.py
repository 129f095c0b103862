"""Download and preparation of models."""

from __future__ import annotations

import hashlib
import io
import re
import tempfile
import warnings
import zipfile
from pathlib import Path

import numpy as np

from ...errors import FetchError, InputError, InputWarning
from ...scene import MAX_BYTES, Mesh, read_mesh, weld
from .. import cache_folder
from ._clean import prepare
from ._models import Model, save_mesh

#: Timeouts in seconds: of a connection, and between parts of the file.
TIMEOUT = (10, 30)
#: Bytes that are read at a time.
CHUNK = 1 << 13


def fetch(model: Model, source: Path | None = None) -> None:
    """Keep the prepared mesh of a model: download it unless it is kept, or read a copy of the published file.

    FetchError if it cannot be downloaded or written; InputError if the copy is none.
    """
    if source is not None:
        try:
            data = source.read_bytes()
        except OSError as error:
            raise InputError(f"{source} cannot be read: {error.strerror}") from None
        if (found := checksum(data, model.checksum)) != model.checksum:
            raise InputError(
                f"{source} is not the published file of {model.name}: its checksum is {found} instead of"
                f" {model.checksum}; a file of your own needs no name: shackled render FILE"
            )
    elif model.kept.is_file():
        return
    else:
        data = download(model)
    mesh = prepare(_read(model, data), model.rotation, model.cap, model.inside_out)
    try:
        save_mesh(mesh, model.kept)
    except OSError as error:
        raise FetchError(
            f"{model.name}: the cache {cache_folder()} cannot be used: {error.strerror or error}"
        ) from None


def checksum(data: bytes, like: str) -> str:
    """Return the checksum of a file, of the kind of another: "sha256:..." or "git-blob:..."."""
    kind = like.partition(":")[0]
    digest = hashlib.sha256(data)
    if kind == "git-blob":
        digest = hashlib.sha1(b"blob %d\0" % len(data) + data, usedforsecurity=False)
    return f"{kind}:{digest.hexdigest()}"


def download(model: Model) -> bytes:
    """Return the published file of a model. FetchError if it cannot be had."""
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
        is_cut = size is not None and len(data) < size
    except requests.exceptions.RequestException as error:
        if not data:
            raise FetchError(
                f"{name}: {host} cannot be reached ({type(error).__name__}); is there a network?"
                f" A copy of the file goes in with: shackled datasets fetch {name} --from FILE"
            ) from None
        is_cut = True
    if is_cut:
        raise FetchError(f"{name}: the connection was cut after {len(data):,} bytes; run it again")
    if (found := checksum(data, model.checksum)) != model.checksum:
        raise FetchError(
            f"{name}: what {address} sends is not the file that was expected: its checksum is {found}"
            f" instead of {model.checksum}"
        )
    return data


def _read(model: Model, data: bytes) -> Mesh:
    """Return the mesh of a published file, of which materials and textures are not needed."""
    suffix = Path(model.address).suffix
    if suffix == ".3mf":
        # of a file that is known to the last byte
        text = zipfile.ZipFile(io.BytesIO(data)).read("3D/3dmodel.model")
        points, faces = (
            np.array(re.findall(rb'<%s %s="(.+?)" %s="(.+?)" %s="(.+?)"' % names, text)).astype(kind)
            for names, kind in (((b"vertex", b"x", b"y", b"z"), float), ((b"triangle", b"v1", b"v2", b"v3"), int))
        )
        return weld(points, faces)
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(action="ignore", category=InputWarning):
        path = Path(folder, f"model{suffix}")
        path.write_bytes(data)
        return read_mesh(path)
