"""Draw the showcase: a PNG file of each scene, and a contact sheet."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from ...whole_file import write_output
from .. import Piece, Thumbnail, sheet
from ._scenes import SIZE, pieces

#: The scene that is drawn as a turntable, its frames, and their duration in milliseconds.
TURNED, FRAMES, DURATION = "showcase/rocket", 16, 90
COLUMNS = 4


def draw_showcase(folder: Path, chosen: Sequence[Piece] = ()) -> Iterator[Thumbnail]:
    """Draw scenes into a folder, which must exist, and yield each when it is done; then sheet.png.

    chosen: the scenes; all if it is empty. OutputError where the disk is full or fails.
    """
    listed, drawings = chosen or pieces(), {}
    for piece in listed:
        drawing = drawings[piece.name] = _draw(piece)
        write_output(folder / f"{piece.name.partition('/')[2]}.png", drawing.png)
        yield drawing
    write_output(folder / "sheet.png", sheet(listed, drawings, SIZE, min(COLUMNS, len(listed))))


def _draw(piece: Piece) -> Thumbnail:
    from ..._render import render
    from ...studio import make_apng

    scene = piece.make()
    if piece.name == TURNED:
        film = make_apng(scene, FRAMES, DURATION, scale=SIZE[0] // scene.width)
        return Thumbnail(piece.name, scene.triangles, film.gas, film.content)
    image = render(scene)
    return Thumbnail(piece.name, scene.triangles, image.gas, image.encode(".png"))
