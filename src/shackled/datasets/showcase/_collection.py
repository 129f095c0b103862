"""The pieces of the showcase."""

from __future__ import annotations

from collections.abc import Callable

from ...scene import Scene
from .. import Piece
from . import _scenes as scenes

#: Name, title and scene of each, in the order in which they are shown.
_SCENES: tuple[tuple[str, str, Callable[[], Scene]], ...] = (
    ("still-life", "Still life with shadows, antialiased", scenes.still_life),
    ("glass", "Glass: opacity and a rim", scenes.glass),
    ("vase", "A texture, and a ground", scenes.vase),
    ("forest", "Fog", scenes.forest),
    ("skull", "An icon with a rim", scenes.skull),
    ("knot", "Linear light and a filmic curve", scenes.knot),
    ("plaster", "Hemisphere light and shadows", scenes.plaster),
    ("shell", "Light from sky and sand", scenes.shell),
    ("wires", "Wires, antialiased", scenes.wires),
    ("cornell-box", "The Cornell box, with shadows, in linear light", scenes.cornell_box),
    ("genesis", "A piece of Genesis, antialiased", scenes.genesis),
    ("rocket", "A turntable, made by a contract", scenes.rocket),
)


def pieces() -> list[Piece]:
    """Return all scenes."""
    return [Piece(f"showcase/{name}", "showcase", title, "MIT", make) for name, title, make in _SCENES]


def find(name: str) -> Piece | None:
    """Return the scene of that name, without the name of the dataset, such as "glass"; None if there is none."""
    return next((piece for piece in pieces() if piece.name == f"showcase/{name}"), None)
