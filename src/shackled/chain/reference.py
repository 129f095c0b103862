"""The NumPy renderer in the place of a chain: the same bytes, and no gas."""

from __future__ import annotations

from ..scene.codec import Rectangle
from ..scene.scene import Scene
from .chain import Drawing


class ReferenceChain:
    """The NumPy reference renderer."""

    name = "NumPy reference"

    def draw(self, scene: Scene, tile: Rectangle | None = None) -> Drawing:
        """The picture of a scene, or of a part of its canvas."""
        from .. import reference

        return Drawing(reference.render(scene, tile), None, None)

    def count(self, scene: Scene, tile: Rectangle | None = None) -> tuple[int, int]:
        """The triangles of a scene that survive culling and clipping, and the pixels, of its canvas or of a tile, that
        any of them covers.
        """
        from .. import reference

        return reference.count(scene, tile)
