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
from ...scene._files.content import MAX_BYTES
from ...scene._files.mesh_file import read_mesh
from ...scene._mesh import Mesh, weld
from .._drawing import cache_folder
from ._clean import prepare
from ._models import Model, save_mesh

#: Timeouts in seconds: of a connection, and between parts of the file.
TIMEOUT = (10, 30)
#: Bytes that are read at a time.
CHUNK = 1 << 16


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


def checksum(data: bytes | bytearray, like: str) -> str:
    """Return the checksum of a file, of the kind of another: "sha256:..." or "git-blob:..."."""
    kind = like.partition(":")[0]
    digest = hashlib.sha256(data)
    if kind == "git-blob":
        digest = hashlib.sha1(b"blob %d\0" % len(data) + data, usedforsecurity=False)
    return f"{kind}:{digest.hexdigest()}"


def download(model: Model) -> bytes:
    """Return the published file of a model. FetchError if it cannot be had."""
    import requests

    name, address, data = model.name, model.address, bytearray()
    try:
        with requests.get(address, stream=True, timeout=TIMEOUT) as response:
            response.raise_for_status()
            for part in response.iter_content(CHUNK):
                data += part
                if len(data) > MAX_BYTES:
                    raise FetchError(f"{name}: {address} sends more than {MAX_BYTES >> 20} MB")
    except requests.exceptions.RequestException as error:
        reason = str(error) if isinstance(error, requests.exceptions.HTTPError) else type(error).__name__
        raise FetchError(
            f"{name}: {address} cannot be downloaded ({reason}); is there a network? A copy of the file goes in with:"
            f" shackled datasets fetch {name} --from FILE"
        ) from None
    if (found := checksum(data, model.checksum)) != model.checksum:
        raise FetchError(
            f"{name}: what {address} sends is not the file that was expected: its checksum is {found}"
            f" instead of {model.checksum}"
        )
    return bytes(data)


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
