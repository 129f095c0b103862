from ._codec import encode
from ._decode import decode
from ._effects import Hemisphere
from ._files.mesh_file import read_mesh
from ._look import stage
from ._presets import PRESETS
from ._staging import view_axes

__all__ = [
    "PRESETS",
    "Hemisphere",
    "decode",
    "encode",
    "read_mesh",
    "stage",
    "view_axes",
]
