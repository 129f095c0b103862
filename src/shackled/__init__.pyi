from ._load import load, replace
from ._render import animate, render, turntable
from ._version import __version__
from .animation import Animation
from .errors import ChainError, InputError, OutputError, RenderError, ShackledError
from .image import Image
from .parallel.places import Cluster, Nodes, Processes
from .scene._arithmetic import euler
from .scene._camera import Camera
from .scene._effects import Background, Fog, Rim, Tone
from .scene._ground import Ground
from .scene._light import Light
from .scene._mesh import Mesh
from .scene._object import Material, Object
from .scene._scene import Scene
from .scene._texture import Texture
from .web._page import export
from .web._widget import view

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
