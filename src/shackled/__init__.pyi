from ._load import load, replace
from ._render import animate, render, turntable
from ._version import __version__
from .animation import Animation
from .errors import ChainError, InputError, OutputError, RenderError, ShackledError
from .image import Image
from .parallel.places import Cluster, Nodes, Processes
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
