"""Third-party models: their metadata, and their pieces."""

from __future__ import annotations

import io
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...scene._look import stage
from ...scene._mesh import Mesh
from ...scene._object import Material, Object
from ...scene._scene import Scene
from ...scene._staging import contrasting, painted
from .._drawing import cache_folder, keep
from .._pieces import Piece
from . import builtin

#: Incremented when `prepare` or the format of its files changes, so that caches are not reused.
VERSION = 2

MATERIAL = Material("smooth", 0.3, 0.8, 0.35, 24)


@dataclass(frozen=True)
class Model:
    """An entry of models.toml, which documents the fields."""

    name: str
    title: str
    author: str
    licence: str
    commercial: bool
    address: str
    checksum: str
    rotation: Sequence[float] = (0, 0, 0)
    color: str | None = None
    azimuth: float = 30
    elevation: float = 20
    cap: bool = False
    inside_out: bool = False
    cull: bool | None = None
    crease: float | None = None

    @property
    def kept(self) -> Path:
        """The path of the cleaned and simplified mesh, which may not be there."""
        return cache_folder() / "models" / f"{self.name}.v{VERSION}.npz"

    def piece(self) -> Piece:
        """Return the piece, whether it has been fetched or not."""
        terms = self.licence, self.scene, self.commercial, self.author
        return Piece(self.name, "common", self.title, *terms, ready=lambda: self.kept.is_file())

    def scene(self) -> Scene:
        """Return the scene, in the colours of its file if there are any; InputError if it has not been fetched."""
        if not self.kept.is_file():
            raise InputError(f"{self.name} has not been fetched; run: shackled datasets fetch {self.name}")
        mesh = load_mesh(self.kept, self.name)
        if self.color is not None and len(np.unique(mesh.colors, axis=0)) == 1:
            mesh = painted(mesh, self.color)
        return stage(
            mesh,
            material=MATERIAL,
            background=contrasting([Object(mesh)]),
            azimuth=self.azimuth,
            elevation=self.elevation,
            half_height=0.3,
            cull=self.cull,
            crease=self.crease,
        )


@cache
def models() -> dict[str, Model]:
    entries = tomllib.loads(files(__package__).joinpath("models.toml").read_text("utf-8"))
    return {name: Model(name=name, **entry) for name, entry in entries.items()}


def model(name: str) -> Model:
    """Return the model of that name; InputError if there is none."""
    if name not in models():
        raise InputError(f"there is no model {name!r} to fetch; there are {', '.join(models())}")
    return models()[name]


def pieces() -> list[Piece]:
    """Return the built-in pieces, then all models, whether they have been fetched or not."""
    return [*builtin.pieces(), *(each.piece() for each in models().values())]


def save_mesh(mesh: Mesh, path: Path) -> None:
    """Write a prepared mesh. OSError if it cannot be written."""
    stream = io.BytesIO()
    positions, faces = mesh.positions.astype(np.float32), mesh.faces.astype(np.uint16)
    np.savez_compressed(stream, positions=positions, faces=faces, colors=mesh.colors)
    keep(path, stream.getvalue())


def load_mesh(path: Path, name: str) -> Mesh:
    """Load a mesh that `save_mesh` wrote."""
    try:
        with np.load(io.BytesIO(path.read_bytes()), allow_pickle=False) as data:
            return Mesh(data["positions"], data["faces"], data["colors"])
    except Exception as error:  # broken files raise errors of any class
        raise InputError(
            f"{path} cannot be read ({type(error).__name__}); delete it and run: shackled datasets fetch {name}"
        ) from None
