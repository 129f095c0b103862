"""A 3D renderer whose every computation runs inside Ethereum smart contracts."""

from importlib import import_module
from typing import Any

from attrs import evolve as replace

from ._load import load
from ._on import Cluster, Nodes, Processes
from ._render import animate, render, turntable
from ._version import __version__
from .animation import Animation
from .errors import ChainError, InputError, OutputError, RenderError, ShackledError
from .image import Image
from .scene import (
    Background,
    Camera,
    Fog,
    Ground,
    Light,
    Material,
    Mesh,
    Object,
    Rim,
    Scene,
    Texture,
    Tone,
    euler,
)
from .web import export, view
from .words import INSTEAD

__all__ = [
    "Animation",
    "Background",
    "Camera",
    "ChainError",
    "Cluster",
    "Fog",
    "Ground",
    "Image",
    "InputError",
    "Light",
    "Material",
    "Mesh",
    "Nodes",
    "Object",
    "OutputError",
    "Processes",
    "RenderError",
    "Rim",
    "Scene",
    "ShackledError",
    "Texture",
    "Tone",
    "__version__",
    "animate",
    "euler",
    "export",
    "load",
    "render",
    "replace",
    "turntable",
    "view",
]


#: Packages that are imported when they are first named, as `shackled.gas`.
_PACKAGES = ("artifacts", "bench", "deploy", "ethereum", "gas", "library", "parallel", "preview", "studio", "tokens")


def __getattr__(name: str) -> Any:
    """Import a package when it is named; say what there is in place of what there is not."""
    if name in _PACKAGES:
        return import_module(f".{name}", __name__)
    hint = f"; {INSTEAD[name]}" if name in INSTEAD else ""
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}{hint}", name=name)


def __dir__() -> list[str]:
    """Name what is meant to be used, and not the modules in which it stands."""
    return __all__
