"""shackled datasets"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Sequence
from functools import partial
from itertools import groupby, islice
from pathlib import Path
from typing import Any

from ..base.checks import choice
from ..base.whole_file import check_output_file, write_output
from ..datasets._drawing import PieceCost, cost, draw_all, page, sheet
from ..datasets._pieces import DATASETS, Piece, pieces
from ..datasets.common import _fetch
from ..datasets.common._models import model
from ..errors import InputError
from .option import argument, option
from .progress import LateBar

#: The most pieces of a dataset in a gallery without --all; only Genesis has more.
SHOWN = 48

DATASET = argument(f"{', '.join(DATASETS)}; all by default.", "DATASET", parse=partial(choice, choices=DATASETS))


def list_(
    dataset: str | None = DATASET,
    as_json: bool = option("--json", "Print a list of JSON objects."),
    every: bool = option("--all", "List each Genesis piece."),
) -> None:
    """List the pieces with their triangles, gas at 128 x 128, and licence."""
    rows = [(piece, cost(piece)) for piece in pieces(dataset)]
    if as_json:
        print(json.dumps([_object(piece, figures) for piece, figures in rows], ensure_ascii=False))
        return
    for name, group in groupby(rows, lambda row: row[0].dataset):
        members = list(group)
        print(f"{name}: {len(members):,} pieces")
        lines = [_summary(members)] if name == "genesis" and not every else [_line(*row) for row in members]
        a, b, c, d, _ = (max(map(len, column)) for column in zip(*lines, strict=True))
        for piece, triangles, gas, title, terms in lines:
            print(f"  {piece:{a}}  {triangles:>{b}} triangles  {gas:>{c}} gas  {title:{d}}  {terms}")


def _object(piece: Piece, figures: PieceCost) -> dict[str, Any]:
    return {
        "name": piece.name,
        "dataset": piece.dataset,
        "title": piece.title,
        "triangles": figures.triangles,
        "gas": figures.gas,
        "licence": piece.licence,
        "commercial": piece.commercial,
        "credit": piece.credit,
        "fetched": piece.ready(),
    }


def _line(piece: Piece, figures: PieceCost) -> tuple[str, str, str, str, str]:
    triangles = "-" if figures.triangles is None else f"{figures.triangles:,}"
    gas = "-" if figures.gas is None else f"{figures.gas:,}"
    to_fetch = "" if piece.ready() else f"; run: shackled datasets fetch {piece.name}"
    return piece.name, triangles, gas, piece.title, f"{piece.terms}{to_fetch}"


def _summary(rows: Sequence[tuple[Piece, PieceCost]]) -> tuple[str, str, str, str, str]:
    def span(values: Iterable[int | None]) -> str:
        known = [value for value in values if value is not None]
        return f"{min(known):,} to {max(known):,}" if known else "-"

    (first, _), (last, _) = rows[0], rows[-1]
    triangles, gas = span(figures.triangles for _, figures in rows), span(figures.gas for _, figures in rows)
    return f"{first.name} .. {last.name}", triangles, gas, "", first.licence


def fetch(
    names: tuple[str, ...] = argument("Names of models, as in `shackled datasets list`.", "NAME", required=True),
    source: Path | None = option("--from", "A copy of the published file, to use instead of a download.", "FILE"),
) -> None:
    """Download third-party models, clean and simplify them, and store the result."""
    if source is not None and len(names) != 1:
        raise InputError("--from needs exactly one NAME")
    for each in [model(name) for name in names]:
        piece = each.piece()
        print(piece.notice, file=sys.stderr)
        with LateBar(f"fetching {each.name}"):
            _fetch.fetch(each, source)
        name, triangles, gas, *_ = _line(piece, cost(piece))
        print(f"{name}: {triangles} triangles, {gas} gas; shackled render {name}")


def gallery(
    output: Path = option("-o --output", "Output file, .html or .png.", "FILE", default=Path("gallery.html")),
    dataset: str | None = DATASET,
    every: bool = option("--all", f"Show all Genesis pieces instead of {SHOWN}."),
    jobs: int | None = option("--jobs", "Number of worker processes; one per core by default.", min=1),
) -> None:
    """Render all pieces into a self-contained HTML page or a contact sheet. Finished pictures are cached."""
    is_page = output.suffix.lower() == ".html"
    if not is_page and output.suffix.lower() != ".png":
        raise InputError(f"the gallery {output} must end in .html or .png")
    check_output_file(output, "gallery")
    names = DATASETS if dataset is None else (dataset,)
    shown = [piece for name in names for piece in islice(pieces(name), None if every else SHOWN)]
    ready = [piece for piece in shown if piece.ready()]
    drawings = {}
    with LateBar("drawing") as bar:
        for drawing in draw_all(ready, processes=jobs):
            drawings[drawing.name] = drawing
            bar.set(len(drawings), len(ready))
    write_output(output, page(shown, drawings).encode() if is_page else sheet(shown, drawings))
    print(f"{output}: {len(shown if is_page else ready):,} pieces")
