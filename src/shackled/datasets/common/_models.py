"""Third-party models: their metadata, and their pieces."""

from __future__ import annotations

import io
import tomllib
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...scene import LookOptions, Material, Mesh, Object, Scene, contrasting, painted, stage
from .. import Piece, cache_folder, keep
from . import builtin

#: Incremented when `prepare` or the format of its files changes, so that caches are not reused.
VERSION = 2

MATERIAL = Material("smooth", 0.3, 0.8, 0.35, 24)
OWN_LICENCE = "that of your own file"


@dataclass(frozen=True)
class Model:
    """An entry of models.toml, which documents the fields; `size` is its `bytes`, None if it is not known."""

    name: str
    title: str
    author: str
    licence: str
    commercial: bool
    address: str
    checksum: str
    size: int | None = None
    rotation: list[float] = field(default_factory=lambda: [0, 0, 0])
    color: str | None = None
    azimuth: float = 30
    elevation: float = 20
    cap: bool = False
    inside_out: bool = False
    cull: bool | None = None
    crease: float | None = None

    @property
    def original(self) -> Path:
        """The path of the downloaded file."""
        suffix = Path(self.address).suffix
        return cache_folder() / "originals" / f"{self.name}-{self.checksum.partition(':')[2][:12]}{suffix}"

    def prepared(self, own: bool = False) -> Path:
        """Return the path of the cleaned and simplified mesh. own: of the one from the user's own file."""
        return cache_folder() / "models" / f"{self.name}{'.own' if own else ''}.v{VERSION}.npz"

    def kept(self) -> Path | None:
        """Return the path of the prepared mesh, the user's own before the downloaded one; None if there is none."""
        return next((path for path in (self.prepared(own=True), self.prepared()) if path.is_file()), None)

    def is_own(self) -> bool:
        """Return whether a file of the user replaces the download."""
        return self.prepared(own=True).is_file()

    def piece(self) -> Piece:
        """Return the piece, whether it has been fetched or not."""
        own = self.is_own()
        return Piece(
            self.name,
            "common",
            self.title,
            OWN_LICENCE if own else self.licence,
            self.scene,
            # the terms of a file of the user are not known
            commercial=self.commercial and not own,
            credit="" if own else self.author,
            ready=lambda: self.kept() is not None,
        )

    def scene(self) -> Scene:
        """Return the scene; InputError if the model has not been fetched."""
        path = self.kept()
        if path is None:
            raise InputError(f"{self.name} has not been fetched; run: shackled datasets fetch {self.name}")
        return self.staged(load_mesh(path, self.name))

    def staged(self, mesh: Mesh) -> Scene:
        """Return the scene of a prepared mesh, in the colours of its file if there are any."""
        if self.color is not None and len(np.unique(mesh.colors, axis=0)) == 1:
            mesh = painted(mesh, self.color)
        look = LookOptions(
            background=contrasting([Object(mesh)]),
            azimuth=self.azimuth,
            elevation=self.elevation,
            half_height=0.3,
            cull=self.cull,
        )
        if self.crease is not None:
            look["crease"] = self.crease
        return stage(mesh, material=MATERIAL, **look)


@cache
def models() -> dict[str, Model]:
    """Return all models by name."""
    entries = tomllib.loads(files(__package__).joinpath("models.toml").read_text("utf-8"))
    return {name: Model(name=name, size=entry.pop("bytes", None), **entry) for name, entry in entries.items()}


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
            f"{path} cannot be read ({type(error).__name__}); run: shackled datasets fetch --again {name}"
        ) from None
