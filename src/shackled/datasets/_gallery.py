"""Galleries: pieces on an HTML page or in a contact sheet."""

from __future__ import annotations

import base64
import io
from collections.abc import Mapping, Sequence
from html import escape
from importlib.resources import files
from string import Template

from PIL import Image as PillowImage
from PIL import ImageDraw, ImageFont

from ._drawing import Thumbnail
from ._piece import Piece

#: Sizes in the contact sheet, in pixels.
CELL, LABEL, GAP = 128, 32, 8
PAPER, INK, FAINT = (250, 250, 248), (20, 22, 28), (110, 114, 122)


def page(pieces: Sequence[Piece], drawings: Mapping[str, Thumbnail]) -> str:
    """Return a self-contained HTML page. Pieces without a drawing are shown with the command that fetches them."""
    template = Template(files(__package__).joinpath("gallery.html").read_text("utf-8"))
    datasets = list(dict.fromkeys(piece.dataset for piece in pieces))
    return template.substitute(
        count=len(pieces),
        choices="\n".join(f'<option value="{escape(name)}">{escape(name)}</option>' for name in datasets),
        cards="\n".join(_card(piece, drawings.get(piece.name)) for piece in pieces),
    )


def sheet(
    pieces: Sequence[Piece], drawings: Mapping[str, Thumbnail], cell: tuple[int, int] = (CELL, CELL), columns: int = 0
) -> bytes:
    """Return a PNG of the drawings in rows, a label under each; pieces without one are left out.

    cell: width and height of a drawing. columns: in a row; 0 for about as many as rows.
    """
    drawn = [(piece, drawings[piece.name]) for piece in pieces if piece.name in drawings]
    columns = columns or max(1, min(len(drawn), round((len(drawn) * (cell[1] + LABEL) / cell[0]) ** 0.5) + 1))
    rows = max(1, -(-len(drawn) // columns))
    width, height = cell[0] + GAP, cell[1] + LABEL + GAP
    picture = PillowImage.new("RGB", (columns * width + GAP, rows * height + GAP), PAPER)
    pen, font = ImageDraw.Draw(picture), ImageFont.load_default(11)
    for number, (piece, drawing) in enumerate(drawn):
        x, y = GAP + number % columns * width, GAP + number // columns * height
        with PillowImage.open(io.BytesIO(drawing.png)) as small:
            picture.paste(small.convert("RGB").resize(cell, PillowImage.Resampling.NEAREST), (x, y))
        pen.text((x, y + cell[1] + 2), _fitting(piece.name, font, cell[0]), INK, font)
        pen.text((x, y + cell[1] + 15), _fitting(figures(drawing, "tri."), font, cell[0]), FAINT, font)
    stream = io.BytesIO()
    picture.save(stream, "png")
    return stream.getvalue()


def _card(piece: Piece, drawing: Thumbnail | None) -> str:
    if drawing is None:
        command = f"shackled datasets fetch {piece.name}"
        image, caption = f'<div class="absent"><code>{escape(command)}</code></div>', "not fetched"
    else:
        data = base64.b64encode(drawing.png).decode()
        image = f'<img src="data:image/png;base64,{data}" alt="{escape(piece.title)}" loading="lazy">'
        caption = figures(drawing)
    terms = piece.licence if piece.commercial else f"{piece.licence} (not for commercial use)"
    credit = f'<p class="credit">{escape(piece.credit)}</p>' if piece.credit else ""
    words = escape(" ".join((piece.name, piece.title, piece.licence, piece.credit)).lower())
    return (
        f'<figure data-dataset="{escape(piece.dataset)}" data-words="{words}">{image}<figcaption>'
        f"<h2>{escape(piece.title)}</h2><code>{escape(piece.name)}</code><p>{escape(caption)}</p>{credit}"
        f'<p class="licence">{escape(terms)}</p></figcaption></figure>'
    )


def figures(drawing: Thumbnail, triangles: str = "triangles") -> str:
    """Return the triangles and the gas of a drawing in words."""
    gas = "" if drawing.gas is None else f", {drawing.gas / 1e6:.1f} M gas"
    return f"{drawing.triangles:,} {triangles}{gas}"


def _fitting(text: str, font: ImageFont.FreeTypeFont | ImageFont.ImageFont, width: int) -> str:
    """Return the text, cut to a width."""
    if font.getlength(text) <= width:
        return text
    while font.getlength(f"{text}…") > width:
        text = text[:-1]
    return f"{text}…"
