"""Read calls of the Renderer contract."""

from __future__ import annotations

from ..artifacts import artifact
from ..chain import revert_error
from .checks import check_layout
from .structs import Rectangle, Scene, parameters, read_value, size_of, word


def read_call(data: bytes) -> tuple[Scene, Rectangle]:
    """Return the scene of a call that draws one, and the part of its canvas to draw.

    data: the selector and the arguments. Raises RenderError if offsets or lengths lead out of the data.
    """
    selectors = artifact("Renderer").selectors
    is_tile = data[:4] in (selectors["renderTile"], selectors["renderTileCounted"])
    scene_type, tile_type = parameters("renderTile")
    base = 4 + word(data, 4)
    head = 4 + 32 + (size_of(tile_type) if is_tile else 0)
    if len(data) < head or base + size_of(scene_type) > len(data):
        # the contract reverts without data
        raise revert_error(b"", 0)
    check_layout(data, base, scene_type)
    scene: Scene = read_value(data, base, scene_type)
    if not is_tile:
        return scene, Rectangle(0, 0, scene.canvas.width, scene.canvas.height)
    return scene, read_value(data, 4 + 32, tile_type)
