"""Draw the showcase: a PNG file of each scene, a page with all of them, and a contact sheet."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path
from string import Template

from ...whole_file import write_output
from .. import Piece, Thumbnail, figures, sheet
from ._collection import pieces
from ._scenes import SIZE

#: The scene that is drawn as a turntable, its frames, and their duration in milliseconds.
TURNED, FRAMES, DURATION = "showcase/rocket", 16, 90
COLUMNS = 4


def draw_showcase(folder: Path, chosen: Sequence[Piece] = ()) -> Iterator[Thumbnail]:
    """Draw scenes into a folder, which must exist, and yield each when it is done; then index.html and sheet.png.

    chosen: the scenes; all if it is empty. OutputError where the disk is full or fails.
    """
    listed, drawings = chosen or pieces(), {}
    for piece in listed:
        drawing = drawings[piece.name] = _draw(piece)
        write_output(folder / _file(piece), drawing.png)
        yield drawing
    write_output(folder / "index.html", _page(listed, list(drawings.values())).encode())
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


def _file(piece: Piece) -> str:
    return f"{piece.name.partition('/')[2]}.png"


def _page(listed: Sequence[Piece], drawings: Sequence[Thumbnail]) -> str:
    template = Template(files(__package__).joinpath("page.html").read_text("utf-8"))
    cards = []
    for piece, drawing in zip(listed, drawings, strict=True):
        image = f'<img src="{_file(piece)}" width="{SIZE[0]}" height="{SIZE[1]}" alt="{escape(piece.title)}">'
        command = f"shackled render {piece.name}"
        cards.append(
            f"<figure>{image}<figcaption><h2>{escape(piece.title)}</h2><p>{figures(drawing)}</p>"
            f"<code>{escape(command)}</code></figcaption></figure>"
        )
    return template.substitute(cards="\n".join(cards))
