"""Reading an untrusted file within limits, in a process of its own; see `_sandbox`."""

from __future__ import annotations

import hashlib
import pickle
import re
import unicodedata
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from .._load import load
from ..errors import InputError, InputWarning
from ..scene import PICTURE, READERS, SCENES, Scene, resize, simplify_scene
from ._controls import MAX_SIDE
from ._sandbox import upload_folder
from ._scene import describe
from ._state import Source
from ._store import MEGABYTE, Limits, Stored
from ._untrusted import check_gltf, unpack

#: Extensions of the files that can be uploaded.
ACCEPTED = (*READERS, *SCENES, PICTURE, ".zip")

#: Name of files that were uploaded together, until it is known which of them is shown.
TOGETHER = "the selection"

MAX_OBJECTS = 256
MAX_TITLE = 60


def read_upload(name: str | None, data: bytes, limits: Limits) -> tuple[str, Stored, tuple[str, ...]]:
    """Return the SHA-256 of a file, what is kept of it, and notes about changes, one sentence each.

    name: of the file; its extension gives the format. None: an archive of files that were uploaded together, which gets
    the name of the one that is shown. InputError if the file cannot be shown.
    """
    title = TOGETHER if name is None else clean_name(name)
    extension = ".zip" if name is None else Path(title).suffix.lower()
    if extension not in ACCEPTED:
        kind = f"{extension} files are" if extension else "a file without an extension is"
        raise InputError(f"{title}: {kind} not supported; supported are {', '.join(ACCEPTED)}")
    if not data.strip():
        raise InputError(f"{title} is empty")
    if len(data) > limits.upload:
        raise InputError(f"{title} is larger than the limit of {limits.upload / MEGABYTE:g} MB")
    notes: list[str] = []
    scene, main = _load(title, extension, data, limits, notes)
    if name is None:
        title = clean_name(main)
    scene, simplified_to = _bounded(scene, title, limits, notes)
    largest = max(scene.width, scene.height)
    if largest > MAX_SIDE:
        sides = max(1, scene.width * MAX_SIDE // largest), max(1, scene.height * MAX_SIDE // largest)
        notes.append(f"The picture was reduced from {scene.width} x {scene.height} to {sides[0]} x {sides[1]} pixels.")
        scene = resize(scene, sides)
    sha256 = hashlib.sha256(data).hexdigest()
    source = Source("upload", sha256)
    with np.errstate(all="ignore"):
        try:
            facts = describe(source, scene, title)
            pickled = pickle.dumps(scene, pickle.HIGHEST_PROTOCOL)
        except InputError:
            raise InputError(f"{title}: its coordinates are too large or too small to be shown") from None
    stored_as = f"{Path(title).stem}.zip" if name is None else title
    return sha256, Stored(stored_as, pickled, facts, simplified_to, b""), tuple(notes)


def clean_name(name: Any) -> str:
    """Return the last part of a path; characters other than letters, digits and simple punctuation become "_"."""
    text = unicodedata.normalize("NFC", str(name)[:4096]).replace("\\", "/").rsplit("/", 1)[-1]
    text = "".join(c if c.isalnum() or c in " ._-()+" else "_" for c in text).strip(" .")
    stem, dot, extension = text.rpartition(".")
    if not dot:
        stem, extension = text, ""
    stem = re.sub("_+", "_", stem)[:MAX_TITLE].strip() or "file"
    return f"{stem}{dot}{extension[:10]}"


def _load(title: str, extension: str, data: bytes, limits: Limits, notes: list[str]) -> tuple[Scene, str]:
    """Return the scene of a file, and the name of the file; of an archive, the name of the file in it."""
    with upload_folder() as inside:
        # this name is replaced in the messages of readers
        path = inside / f"upload{extension}"
        try:
            if extension == ".zip":
                path = unpack(data, inside, limits, TOGETHER if title == TOGETHER else "the archive")
            else:
                path.write_bytes(data)
            if path.suffix.lower() in (".gltf", ".glb"):
                check_gltf(path, path.read_bytes())
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always", InputWarning)
                scene = load(path)
            messages = [str(each.message) for each in caught if issubclass(each.category, InputWarning)]
            notes += [f"{_message(message, title, path, inside)}." for message in dict.fromkeys(messages)]
            return scene, path.name
        except InputError as error:
            raise InputError(_message(str(error), title, path, inside)) from None


def _message(message: str, title: str, path: Path, inside: Path) -> str:
    """Return a message with the title in place of the path of the temporary file."""
    message = message.replace(str(path), title).replace(f"{inside}/", "").replace(str(inside), "")
    if path.suffix.lower() in SCENES and message.endswith("does not exist"):
        message += " in the upload: put the scene and its meshes into a ZIP"
    return message if message.startswith(title) else f"{title}: {message}"


def _bounded(scene: Scene, title: str, limits: Limits, notes: list[str]) -> tuple[Scene, int | None]:
    if len(scene.objects) > MAX_OBJECTS:
        raise InputError(f"{title} has {len(scene.objects):,} objects; the limit is {MAX_OBJECTS}")
    if not scene.objects:
        raise InputError(f"{title} has no objects")
    before = [o.mesh.triangles for o in scene.objects]
    simplified_to = None
    if max(before) > limits.triangles:
        simplified_to = limits.triangles
        try:
            scene = simplify_scene(scene, limits.triangles)
        except InputError as error:
            raise InputError(f"{title}: {error}") from None
    after = scene.triangles
    if simplified_to is not None:
        notes.append(f"The mesh was simplified from {sum(before):,} to {after:,} triangles, which is the limit.")
    if after > limits.all_triangles:
        raise InputError(f"{title} has {after:,} triangles; the limit is {limits.all_triangles:,}")
    return scene, simplified_to
