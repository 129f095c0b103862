"""Reading of meshes from any file, including archives."""

from __future__ import annotations

import io
import tempfile
import warnings
import zipfile
import zlib
from pathlib import Path, PurePosixPath
from xml.etree import ElementTree

import numpy as np

from ...errors import InputError, InputWarning
from ...scene import MAX_BYTES, READERS, Mesh, read_mesh, weld

MODEL_3MF = "3D/3dmodel.model"


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
